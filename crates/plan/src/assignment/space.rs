//! A space in which an assignment looks like a short one.
//!
//! With as many rows as columns, the squared ways of an assignment differ from −2 Σ row · column only by a constant.
//! That product does not change when columns are scaled by m along an axis and rows by 1/m, and moving either set
//! changes it by a constant. So both sets are centred and brought to the same spread: the same assignment is optimal,
//! but partners are now near each other, and a few nearest neighbours are nearly all edges that matter, even when a
//! band along the floor's edge spreads over the whole floor.

use lightbots_base::Vec2;

/// Sets thinner than this, metres, are not stretched to more than [`MOST`] times.
const THIN_M: f64 = 1e-6;
const MOST: f64 = 1e3;

/// Rows and columns moved and scaled to the same centre and spread. Sets of unequal size are returned as they are.
pub(super) fn common(rows: &[Vec2], columns: &[Vec2]) -> (Vec<Vec2>, Vec<Vec2>) {
    if rows.len() != columns.len() || rows.is_empty() {
        return (rows.to_vec(), columns.to_vec());
    }
    let ((row_centre, row_spread), (column_centre, column_spread)) = (measure(rows), measure(columns));
    let factor = |row: f64, column: f64| ((row + THIN_M) / (column + THIN_M)).sqrt().clamp(1.0 / MOST, MOST);
    let (mx, my) = (factor(row_spread.x, column_spread.x), factor(row_spread.y, column_spread.y));
    let moved = |places: &[Vec2], centre: Vec2, mx: f64, my: f64| {
        places.iter().map(|&at| Vec2::new((at.x - centre.x) * mx, (at.y - centre.y) * my)).collect()
    };
    (moved(rows, row_centre, 1.0 / mx, 1.0 / my), moved(columns, column_centre, mx, my))
}

/// The mean place and the standard deviation along each axis.
fn measure(places: &[Vec2]) -> (Vec2, Vec2) {
    let count = places.len() as f64;
    let centre = places.iter().fold(Vec2::ZERO, |sum, &at| sum + at) / count;
    let squares = places.iter().fold(Vec2::ZERO, |sum, &at| {
        let off = at - centre;
        sum + Vec2::new(off.x * off.x, off.y * off.y)
    });
    (centre, Vec2::new((squares.x / count).sqrt(), (squares.y / count).sqrt()))
}
