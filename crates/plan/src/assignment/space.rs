//! Moves and scales starts and goals so that partners in the best assignment are near each other. Rows and columns are
//! the two sets of places that are matched.
//!
//! With as many rows as columns, the sum of squared distances of an assignment differs only by a constant from −2 Σ row
//! · column. Here Σ row · column is the sum of the dot products of partners. That sum does not change when columns are
//! scaled by m along an axis and rows by 1/m. Moving either set changes it by a constant. Therefore both sets are
//! centred and scaled to the same spread, and the same assignment stays optimal. Partners are then near each other, and
//! few edges besides those to the nearest neighbours matter. This holds even if robots from a band along the floor's
//! edge spread over the whole floor.

use lightbots_base::Vec2;

/// Length that is added to the spread of each set, metres, so that thin sets are not stretched without bound.
const THIN_M: f64 = 1e-6;
/// Largest factor by which a set is stretched along an axis.
const MOST: f64 = 1e3;

/// Returns rows and columns moved and scaled to the same centre and, as far as [`MOST`] allows, to the same spread
/// along each axis. If their numbers differ, both are returned unchanged.
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

/// Returns the mean place and the standard deviation along each axis, metres.
fn measure(places: &[Vec2]) -> (Vec2, Vec2) {
    let count = places.len() as f64;
    let centre = places.iter().fold(Vec2::ZERO, |sum, &at| sum + at) / count;
    let squares = places.iter().fold(Vec2::ZERO, |sum, &at| {
        let off = at - centre;
        sum + Vec2::new(off.x * off.x, off.y * off.y)
    });
    (centre, Vec2::new((squares.x / count).sqrt(), (squares.y / count).sqrt()))
}
