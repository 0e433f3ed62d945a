//! Corridors around paths: a place that is far from a corridor is far from the path in it, which is quick to check.

use lightbots_base::Vec2;
use lightbots_base::shape::{point_to_segment, segment_to_segment};

/// A corridor around places of a path: all of them are within `bulge_m` metres of the straight line from the first to
/// the last.
pub(super) struct Corridor {
    from: Vec2,
    to: Vec2,
    bulge_m: f64,
}

impl Corridor {
    /// Makes the corridor around these places, which are in the order of the path. Panics if there are none.
    pub fn around(places: &[Vec2]) -> Self {
        let (from, to) = (places[0], places[places.len() - 1]);
        let bulge_m = places.iter().map(|&place| point_to_segment(place, from, to)).fold(0.0, f64::max);
        Self { from, to, bulge_m }
    }

    /// Lower bound of the distance of `place` from the path through the corridor's places, metres; may be negative.
    pub fn distance_m(&self, place: Vec2) -> f64 {
        point_to_segment(place, self.from, self.to) - self.bulge_m
    }

    /// Whether a place of one corridor's path may be nearer than `reach_m` metres to a place of the other's.
    pub fn is_near(&self, other: &Self, reach_m: f64) -> bool {
        let lines_m = segment_to_segment((self.from, self.to), (other.from, other.to));
        lines_m < reach_m + self.bulge_m + other.bulge_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seeded::Seeded;

    #[test]
    fn what_is_far_from_a_corridor_is_far_from_its_path() {
        let mut dice = Seeded::new(3);
        let mut between =
            |reach_m: f64| Vec2::new(dice.between(-reach_m, reach_m), dice.between(-reach_m, reach_m));
        let (mut far, mut near) = (0, 0);
        for _ in 0..2_000 {
            let [path, other] = [0, 1].map(|_| {
                let (from, step) = (between(0.3), between(0.02));
                (0..20).map(|at| from + step * f64::from(at) + between(0.004)).collect::<Vec<_>>()
            });
            let of = |place: Vec2, path: &[Vec2]| {
                path.windows(2)
                    .map(|line| point_to_segment(place, line[0], line[1]))
                    .fold(f64::INFINITY, f64::min)
            };
            let (corridor, places) = (Corridor::around(&path), Corridor::around(&other));
            let apart_m = other.iter().map(|&place| of(place, &path)).fold(f64::INFINITY, f64::min);
            for &place in &other {
                assert!(corridor.distance_m(place) <= of(place, &path) + 1e-12);
            }
            assert!(corridor.is_near(&places, 0.065) || apart_m >= 0.065);
            far += usize::from(!corridor.is_near(&places, 0.065));
            near += usize::from(corridor.is_near(&places, 0.065) && apart_m < 0.065);
        }
        assert!(far > 500 && near > 300, "{far} far, {near} near");
    }
}
