//! Starting places for shows without `starts`.

use lightbots_base::{Limits, Vec2};

use crate::{Obstacle, Show, Stage, robots_needed};

/// Distances between neighbouring robots, and between rows, for robots of the size of an Elisa-3, metres. They are
/// tried in this order, until no row is beyond the front edge of the floor; otherwise the last one is used. The original
/// system uses 0.1 m. 0.06 m leaves 6 mm between rims, twice `PROVABLE_GAP_M`.
const STEPS_M: [f64; 3] = [0.1, 0.08, 0.06];
/// Distance from the back edge of the floor to the first row, for robots of the size of an Elisa-3, metres. At most a
/// quarter of the floor's depth is used. The original system has y = 1.3 m on a floor of 3 m.
const FIRST_ROW_M: f64 = 0.2;
/// Least distance from a side edge to the centre of a robot in a row, for robots of the size of an Elisa-3, metres. A
/// floor that is narrower than twice this distance gets one column in its middle. The original system has x = −1.45 m
/// on a floor of 3 m.
const SIDE_M: f64 = 0.05;
/// Longest row, metres: five times the widest valid floor, which is 200 m (`MOST_SIDE_M`). Bounds the number of columns
/// for hostile widths.
const USABLE_MAX_M: f64 = 1e3;
/// Largest factor by which distances grow for robots larger than an Elisa-3. Bounds them for invalid shows: the largest
/// radius that validation allows, 1 m, has the factor 37.
const SIZE_MAX: f64 = 100.0;
/// Least clearance between a waiting robot's rim and a no-go area, metres. More than `PROVABLE_GAP_M`, so that the
/// drive from the starting place can be proven free of contact.
const OBSTACLE_GAP_M: f64 = 0.01;
/// Largest number of rows without a free place. Once there are more, the remaining places are put in one column without
/// a check of no-go areas. The largest valid floor, 200 m deep, has only 3,333 rows 0.06 m apart.
const FULL_ROWS_MAX: usize = 10_000;
/// Largest number of comparisons of a place with a no-go area. After that, the remaining places are put in one column
/// without a check. The bound is ten times what `MAX_PIXELS` free places and `MAX_OBSTACLES` areas need; it limits the
/// time for hostile shows.
const COMPARISONS_MAX: usize = 200_000_000;

/// Starting places of `count` robots, stage metres: rows along the back edge of the floor, where y is largest. Each
/// row is centred and runs from left to right. On the original system's floor, 3 m by 3 m, thirty places have y = 1.3 m
/// and begin at x = −1.45 m.
///
/// For robots up to the size of an Elisa-3, neighbours and rows are 0.1 m apart. If the floor is too small, they are
/// closer, down to 0.06 m. The first row is 0.2 m from the back edge, or a quarter of the floor's depth if that is
/// less. For larger robots, these distances grow with the radius, at most by a factor of 100.
///
/// Places on or close to no-go areas are left out, unless hardly any place is free. If the floor is still too small,
/// the last rows are beyond the front edge. The list always has `count` places.
pub fn back_rows(stage: &Stage, count: usize) -> Vec<Vec2> {
    let size = (stage.limits.radius_m / Limits::ELISA_3.radius_m).clamp(1.0, SIZE_MAX);
    let [wide_m, medium_m, narrow_m] = STEPS_M;
    let front_edge_m = -stage.depth_m / 2.0 + stage.limits.radius_m;
    for step_m in [wide_m, medium_m] {
        let places = rows(stage, count, step_m, size);
        if places.iter().all(|place| place.y >= front_edge_m) {
            return places;
        }
    }
    rows(stage, count, narrow_m, size)
}

/// Places where the robots of a show wait before the first frame, stage metres: the show's `starts`, or else
/// [`back_rows`].
pub fn starting_places(show: &Show) -> Vec<Vec2> {
    show.starts.clone().unwrap_or_else(|| back_rows(&show.stage, robots_needed(show)))
}

/// Rows of `count` places, stage metres, without those on or close to no-go areas. Robots are `size` times as large as
/// an Elisa-3. `step_m` is the distance between neighbours for an Elisa-3, metres.
fn rows(stage: &Stage, count: usize, step_m: f64, size: f64) -> Vec<Vec2> {
    let (step_m, side_m, first_row_m) = (step_m * size, SIDE_M * size, FIRST_ROW_M * size);
    // A floor without a finite width gets a single column, so that validation can report the places.
    let usable_m =
        if stage.width_m.is_finite() { (stage.width_m - 2.0 * side_m).clamp(0.0, USABLE_MAX_M) } else { 0.0 };
    let columns = (usable_m / step_m + 1e-9) as usize + 1;
    let first_y = if stage.depth_m.is_finite() {
        stage.depth_m / 2.0 - first_row_m.min(stage.depth_m / 4.0)
    } else {
        0.0
    };
    let mut places = Vec::with_capacity(count);
    let mut row = 0;
    let (mut full_rows, mut comparisons_left) = (0, COMPARISONS_MAX);
    while places.len() < count {
        let y = first_y - row as f64 * step_m;
        let in_row = columns.min(count - places.len());
        let left = -((in_row - 1) as f64) * step_m / 2.0;
        let spots = (0..in_row).map(|column| Vec2::new(tidy(left + column as f64 * step_m), tidy(y)));
        let before = places.len();
        places.extend(spots.filter(|spot| is_free(stage, *spot)));
        // Rows without a free place are skipped, up to a bound.
        full_rows += usize::from(places.len() == before);
        row += 1;
        comparisons_left = comparisons_left.saturating_sub(in_row * stage.obstacles.len());
        if full_rows > FULL_ROWS_MAX || comparisons_left == 0 {
            let left = count - places.len();
            places.extend((0..left).map(|nth| Vec2::new(0.0, first_y - (row + nth) as f64 * step_m)));
        }
    }
    places
}

fn is_free(stage: &Stage, spot: Vec2) -> bool {
    let reach_m = stage.limits.radius_m + OBSTACLE_GAP_M;
    stage.obstacles.iter().all(|obstacle| obstacle.gap_m(spot) >= reach_m)
}

/// Rounds metres to tenths of a millimetre, so that places read well in files.
fn tidy(metres: f64) -> f64 {
    (metres * 1e4).round() / 1e4 + 0.0
}

impl Obstacle {
    /// Distance from a place to the nearest point of the no-go area, metres. Within a disc it is negative, within a
    /// rectangle 0.
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
        let places = back_rows(&Stage::default(), 30);
        assert_eq!(places.len(), 30);
        for (nth, place) in places.iter().enumerate() {
            assert!(place.distance(Vec2::new(-1.45 + 0.1 * nth as f64, 1.3)) < 1e-9);
        }
    }

    #[test]
    fn more_stand_behind_and_the_last_row_is_centred() {
        let places = back_rows(&Stage::default(), 32);
        assert_eq!(places[30], Vec2::new(-0.05, 1.2));
        assert_eq!(places[31], Vec2::new(0.05, 1.2));
    }

    #[test]
    fn large_robots_wait_farther_apart_and_off_the_edge() {
        let limits = Limits { radius_m: 0.1, ..Limits::default() };
        let stage = Stage { width_m: 6.0, depth_m: 6.0, limits, ..Stage::default() };
        let places = back_rows(&stage, 30);
        assert!(places.iter().all(|place| place.x.abs() <= 2.9 && place.y.abs() <= 2.9), "{places:?}");
        let pairs =
            places.iter().enumerate().flat_map(|(i, a)| places[..i].iter().map(move |b| a.distance(*b)));
        assert!(pairs.fold(f64::INFINITY, f64::min) > 0.3);
    }

    #[test]
    fn rows_leave_obstacles_free() {
        let wall = Obstacle::Rect { min: Vec2::new(-1.5, 1.0), max: Vec2::new(1.0, 1.5) };
        let stage = Stage { obstacles: vec![wall], ..Stage::default() };
        let places = back_rows(&stage, 40);
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
            assert_eq!(back_rows(&stage, 7).len(), 7);
        }
    }

    #[test]
    fn places_without_room_are_one_column_without_gaps() {
        let everywhere = Obstacle::Rect { min: Vec2::new(-1e6, -1e6), max: Vec2::new(1e6, 1.25) };
        let stage = Stage { obstacles: vec![everywhere], ..Stage::default() };
        let places = back_rows(&stage, 80);
        let column = &places[49..];
        assert!(places[48].y > 1.2 && column[0].y < 1.2, "the first row is full");
        assert!(column.windows(2).all(|pair| (pair[0].y - pair[1].y - 0.06).abs() < 1e-9), "{column:?}");
    }
}
