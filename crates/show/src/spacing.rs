//! Pairs of close places. A grid finds them, so that not all pairs of places are compared.

use lightbots_base::Vec2;

/// Two places that are close to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloseApproach {
    /// Index of one place in the list of places; less than `second`.
    pub first: usize,
    /// Index of the other place.
    pub second: usize,
    /// Distance between the places, metres.
    pub gap_m: f64,
}

/// All pairs of places closer to each other than `reach_m` (metres, positive), ordered by their indices. The search
/// ends after the first place whose pairs bring the number to `most` or more; further pairs are then missing. Places
/// with a coordinate that is not finite, or beyond ±`FARTHEST_M`, are left out.
pub fn close_pairs(places: &[Vec2], reach_m: f64, most: usize) -> Vec<CloseApproach> {
    let cells = sorted_cells(places, reach_m);
    let mut pairs = Vec::new();
    // Cells are sorted by row, then column. A place is compared with the rest of its cell, the cell to the right, and
    // the three cells above, which begin at `above`.
    let mut above = 0;
    for (nth, &(row, column, index)) in cells.iter().enumerate() {
        let beside = cells[nth + 1..].iter().take_while(|cell| cell.0 == row && cell.1 <= column + 1);
        while above < cells.len() && (cells[above].0, cells[above].1) < (row + 1, column - 1) {
            above += 1;
        }
        let over = cells[above..].iter().take_while(|cell| cell.0 == row + 1 && cell.1 <= column + 1);
        for &(_, _, other) in beside.chain(over) {
            let gap_m = places[index].distance(places[other]);
            if gap_m < reach_m {
                pairs.push(CloseApproach { first: index.min(other), second: index.max(other), gap_m });
            }
        }
        if pairs.len() >= most {
            break;
        }
    }
    pairs.sort_by_key(|pair| (pair.first, pair.second));
    pairs
}

/// Largest magnitude of a coordinate of a place that is compared, metres: five times the largest floor. Numbers of the
/// grid's rows would overflow far beyond it.
const FARTHEST_M: f64 = 1e3;

/// Row and column of the grid cell of each place, and the index of the place, sorted. Places beyond `FARTHEST_M` are
/// left out. A cell has the side `reach_m`.
fn sorted_cells(places: &[Vec2], reach_m: f64) -> Vec<(i64, i64, usize)> {
    let cell = |metres: f64| (metres / reach_m).floor() as i64;
    let near = |place: &Vec2| place.x.abs() <= FARTHEST_M && place.y.abs() <= FARTHEST_M;
    let mut cells: Vec<_> = (places.iter().enumerate())
        .filter(|(_, place)| near(place))
        .map(|(index, place)| (cell(place.y), cell(place.x), index))
        .collect();
    cells.sort_unstable();
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random places in a square of 1 m, the same at every run.
    fn scattered(count: usize) -> Vec<Vec2> {
        let mut state = 7u64;
        let mut next =
            move || (lightbots_base::random::congruential(&mut state) >> 11) as f64 / (1u64 << 53) as f64;
        (0..count).map(|_| Vec2::new(next() - 0.5, next() - 0.5)).collect()
    }

    #[test]
    fn the_grid_finds_what_comparing_all_finds() {
        let places = scattered(300);
        let mut expected = Vec::new();
        for second in 0..places.len() {
            for first in 0..second {
                let gap_m = places[first].distance(places[second]);
                if gap_m < 0.057 {
                    expected.push(CloseApproach { first, second, gap_m });
                }
            }
        }
        expected.sort_by_key(|pair| (pair.first, pair.second));
        assert!(expected.len() > 100);
        assert_eq!(close_pairs(&places, 0.057, usize::MAX), expected);
    }

    #[test]
    fn a_search_ends_early_where_all_places_are_the_same() {
        let pairs = close_pairs(&[Vec2::ZERO; 20_000], 0.057, 100);
        assert!((100..40_000).contains(&pairs.len()));
    }

    #[test]
    fn places_that_are_not_finite_or_too_far_are_left_out() {
        let places = [Vec2::new(f64::NAN, 0.0), Vec2::new(1e300, 1e300), Vec2::new(1e300, 1e300)];
        assert_eq!(close_pairs(&places, 0.057, 10), []);
    }
}
