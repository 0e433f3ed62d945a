//! How much room a plan leaves each robot.

use lightbots_base::{Span, Vec2};
use lightbots_plan::Path;

/// Robots are looked at this often: two that pass at full speed come 1 mm nearer in between.
const STEP: Span = Span::from_millis(40);
/// Steps at most: longer paths are sampled less often. Over 30,000 steps no robot moves by a millimetre in one.
const MOST_STEPS: i64 = 30_000;
/// More room than this is as good as any, metres.
const AMPLE_M: f64 = 0.04;
/// Among more robots than this everybody is told the least room of all: looking at each would hold the show up.
const MOST: usize = 1000;

/// `[path]`: how far its rim stays from those of all others by plan, metres; infinite where that is more than 40 mm.
/// `standing` are discs that do not move meanwhile, `least_m` what the plan leaves to the closest two of all; 0: nobody
/// knows.
pub(crate) fn rooms(paths: &[(usize, Path)], standing: &[Vec2], least_m: f64, contact_m: f64) -> Vec<f64> {
    if least_m <= 0.0 {
        return vec![0.0; paths.len()];
    }
    if paths.len() > MOST {
        return vec![least_m; paths.len()];
    }
    let near_m = contact_m + AMPLE_M;
    let mut least = vec![f64::INFINITY; paths.len()];
    let longest = paths.iter().map(|(_, path)| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
    let mut at: Vec<(Vec2, usize)> = standing.iter().map(|&place| (place, usize::MAX)).collect();
    at.extend(paths.iter().enumerate().map(|(index, (_, path))| (path.start, index)));
    // At the end of the last step all stand.
    let every = STEP.max(Span(longest.0 / MOST_STEPS));
    for step in 0..=longest.0 / every.0 + 1 {
        for (place, index) in &mut at {
            if let Some((_, path)) = paths.get(*index) {
                *place = path.as_ref().at(every * step).position;
            }
        }
        // Hardly anything changes its turn from step to step.
        at.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        for (turn, &(place, index)) in at.iter().enumerate() {
            for &(other, other_index) in at[turn + 1..].iter().take_while(|next| next.0.x - place.x < near_m)
            {
                let apart = place.distance(other);
                if apart < near_m {
                    for one in [index, other_index] {
                        if let Some(known) = least.get_mut(one) {
                            *known = known.min(apart - contact_m);
                        }
                    }
                }
            }
        }
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Piece;

    fn straight(from: Vec2, to: Vec2) -> Path {
        Path { start: from, pieces: vec![Piece::straight(from, to, Span::from_millis(4_000))] }
    }

    #[test]
    fn room_is_to_the_nearest_wherever_it_is_met() {
        let along = |y| straight(Vec2::new(0.0, y), Vec2::new(1.0, y));
        let back = straight(Vec2::new(1.0, 0.07), Vec2::new(0.0, 0.07));
        let paths = [(0, along(0.0)), (1, back), (2, along(0.5)), (3, along(1.0))];
        let rooms = rooms(&paths, &[Vec2::new(0.5, 0.58)], 0.016, 0.054);
        assert!((rooms[0] - 0.016).abs() < 0.001 && rooms[0] == rooms[1], "{rooms:?}");
        assert!((rooms[2] - 0.026).abs() < 0.001 && rooms[3] == f64::INFINITY, "{rooms:?}");
    }

    #[test]
    fn in_a_large_crowd_everybody_has_the_least_room_of_all() {
        let far = |index: usize| Vec2::new(index as f64, 0.0);
        let paths: Vec<_> = (0..=MOST).map(|index| (index, straight(far(index), far(index)))).collect();
        assert!(rooms(&paths, &[], 0.007, 0.054).iter().all(|&room| room == 0.007));
    }

    #[test]
    fn where_the_plan_knows_none_there_is_none() {
        let paths = [(0, straight(Vec2::ZERO, Vec2::new(1.0, 0.0)))];
        assert_eq!(rooms(&paths, &[], 0.0, 0.054), [0.0]);
    }
}
