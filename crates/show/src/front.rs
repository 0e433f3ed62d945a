//! Where robots wait before a show that does not say where.

use lightbots_base::{Limits, Vec2};

use crate::{Obstacle, Stage};

/// How far apart robots wait if the floor has room, metres.
const STEP_M: f64 = 0.1;
/// From the front edge of the floor to the first row, metres.
const FIRST_ROW_M: f64 = 0.2;
/// From the side edges to the first and last robot of a row, metres.
const SIDE_M: f64 = 0.05;
/// Spots times obstacles that are looked at: far more than shows need whose robots fit on their floor.
const MOST_LOOKS: usize = 200_000_000;

/// Where `count` robots wait before a show: in rows along the front edge, that is the one with the largest y, 0.1 m
/// apart, the first row 0.2 m from the edge, further rows behind it, each from left to right and the last one centred.
/// On the original's floor of 3 m by 3 m the first thirty stand on y = 1.3 m from x = −1.45 m. Places on obstacles
/// are left out.
///
/// Robots larger than an Elisa-3 get as much more room. Always `count` places: rows get closer, down to 60 mm for an
/// Elisa-3, where the floor is small, and where that is not enough they
/// go on beyond its edge, which [`validate`](crate::validate) reports.
pub fn front_rows(stage: &Stage, count: usize) -> Vec<Vec2> {
    let size = (stage.limits.radius_m / Limits::ELISA_3.radius_m).clamp(1.0, 100.0);
    for step_m in [STEP_M, 0.08] {
        let places = rows(stage, count, step_m, size);
        let far_edge_m = -stage.depth_m / 2.0 + stage.limits.radius_m;
        if places.iter().all(|place| place.y >= far_edge_m) {
            return places;
        }
    }
    rows(stage, count, 0.06, size)
}

/// Rows for robots that are `size` times as large as an Elisa-3, for which `step_m` is stated.
fn rows(stage: &Stage, count: usize, step_m: f64, size: f64) -> Vec<Vec2> {
    let (step_m, side_m, first_row_m) = (step_m * size, SIDE_M * size, FIRST_ROW_M * size);
    // A floor that is no floor gets a single file, so that there are places to complain about.
    let usable_m =
        if stage.width_m.is_finite() { (stage.width_m - 2.0 * side_m).clamp(0.0, 1e3) } else { 0.0 };
    let columns = (usable_m / step_m + 1e-9) as usize + 1;
    let first_y = if stage.depth_m.is_finite() {
        stage.depth_m / 2.0 - first_row_m.min(stage.depth_m / 4.0)
    } else {
        0.0
    };
    let mut places = Vec::with_capacity(count);
    let mut row = 0;
    let (mut left_out, mut looks) = (0, MOST_LOOKS);
    while places.len() < count {
        let y = first_y - row as f64 * step_m;
        let in_row = columns.min(count - places.len());
        let left = -((in_row - 1) as f64) * step_m / 2.0;
        let spots = (0..in_row).map(|column| Vec2::new(tidy(left + column as f64 * step_m), tidy(y)));
        let before = places.len();
        places.extend(spots.filter(|spot| is_free(stage, *spot)));
        // Rows full of obstacles are passed over, but not without end.
        left_out += usize::from(places.len() == before);
        row += 1;
        looks = looks.saturating_sub(in_row * stage.obstacles.len());
        if left_out > 10_000 || looks == 0 {
            let at = places.len();
            places.extend((at..count).map(|nth| Vec2::new(0.0, first_y - (row + nth) as f64 * step_m)));
        }
    }
    places
}

fn is_free(stage: &Stage, spot: Vec2) -> bool {
    let reach_m = stage.limits.radius_m + 0.01;
    stage.obstacles.iter().all(|obstacle| obstacle.gap_m(spot) >= reach_m)
}

/// Tenths of millimetres, so that places read well in files.
fn tidy(metres: f64) -> f64 {
    (metres * 1e4).round() / 1e4 + 0.0
}

impl Obstacle {
    /// From a place to the nearest point of the obstacle, metres; 0 or less on it.
    pub fn gap_m(&self, from: Vec2) -> f64 {
        match *self {
            Self::Disc { at, radius_m } => at.distance(from) - radius_m,
            Self::Rect { min, max } => {
                let dx = (min.x - from.x).max(from.x - max.x).max(0.0);
                let dy = (min.y - from.y).max(from.y - max.y).max(0.0);
                Vec2::new(dx, dy).length()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thirty_wait_where_the_originals_do() {
        let places = front_rows(&Stage::default(), 30);
        assert_eq!(places.len(), 30);
        for (nth, place) in places.iter().enumerate() {
            assert!(place.distance(Vec2::new(-1.45 + 0.1 * nth as f64, 1.3)) < 1e-9);
        }
    }

    #[test]
    fn more_stand_behind_and_the_last_row_is_centred() {
        let places = front_rows(&Stage::default(), 32);
        assert_eq!(places[30], Vec2::new(-0.05, 1.2));
        assert_eq!(places[31], Vec2::new(0.05, 1.2));
    }

    #[test]
    fn large_robots_wait_farther_apart_and_off_the_edge() {
        let limits = Limits { radius_m: 0.1, ..Limits::default() };
        let stage = Stage { width_m: 6.0, depth_m: 6.0, limits, ..Stage::default() };
        let places = front_rows(&stage, 30);
        assert!(places.iter().all(|place| place.x.abs() <= 2.9 && place.y.abs() <= 2.9), "{places:?}");
        let pairs =
            places.iter().enumerate().flat_map(|(i, a)| places[..i].iter().map(move |b| a.distance(*b)));
        assert!(pairs.fold(f64::INFINITY, f64::min) > 0.3);
    }

    #[test]
    fn rows_leave_obstacles_free() {
        let wall = Obstacle::Rect { min: Vec2::new(-1.5, 1.0), max: Vec2::new(1.0, 1.5) };
        let stage = Stage { obstacles: vec![wall], ..Stage::default() };
        let places = front_rows(&stage, 40);
        assert_eq!(places.len(), 40);
        assert!(places.iter().all(|place| wall.gap_m(*place) >= 0.027));
    }

    #[test]
    fn any_stage_gives_that_many_places() {
        for (width_m, depth_m) in
            [(0.0, 0.0), (f64::NAN, 1.0), (1.0, f64::INFINITY), (-3.0, -3.0), (1e300, 1.0)]
        {
            let everywhere = Obstacle::Disc { at: Vec2::ZERO, radius_m: 1e9 };
            let stage = Stage { width_m, depth_m, obstacles: vec![everywhere], ..Stage::default() };
            assert_eq!(front_rows(&stage, 7).len(), 7);
        }
    }
}
