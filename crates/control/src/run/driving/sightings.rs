//! Locates silent robots by what other robots see in their paths.

use crate::robot::KnownRobot;
use lightbots_base::{Vec2, wrap};

/// Distance within which the place of a robot and a sighting, or two sightings, may be of one robot, metres.
pub(crate) const SAME_M: f64 = 0.035;
/// Places of a path that are closer to each other than this are neighbours on it, metres.
const NEXT_M: f64 = 0.03;
/// Number of parts into which the path between two neighbours is cut.
const PARTS: u32 = 8;

/// Standard deviations for the place of a robot that others see, metres. Smaller ones make the estimate jump from
/// sighting to sighting. Larger ones leave the robot where its path says, though it was pushed.
struct Sigma {
    /// Of a sighting along the line of sight: 1 mm of the sensor, and the error of the robot's own place.
    range_m: f64,
    /// Of a sighting across the line of sight: sensors are 45 degrees apart, at 55 mm.
    bearing_m: f64,
    /// Of a dead robot beside its path.
    path_m: f64,
    /// Of a dead robot beside its path, if several robots see it: those that ran into it have pushed it.
    pushed_m: f64,
}

/// Standard deviations (1 sigma).
const SIGMA: Sigma = Sigma { range_m: 0.002, bearing_m: 0.018, path_m: 0.002, pushed_m: 0.008 };

/// Largest distance by which robots push a dead one off its path, metres: 40 mm were measured in a fleet of 200. A
/// sighting farther off is of something else.
const PUSHED_M: f64 = 0.05;
/// Largest difference in range at which a robot that reported its place explains a sighting, metres: 4 sigma.
const KNOWN_RANGE_M: f64 = 0.008;
/// Largest error in bearing at which a robot whose place is known explains a sighting, radians: the angle between two
/// sensors. Above, what is seen of a silent robot is taken for a known one. Below, a silent robot is located where a
/// known one stands, and driven through.
const KNOWN_BEARING: f64 = 0.8;
/// Largest error in bearing of a sighting, radians: half the angle between two sensors.
const BEARING: f64 = 0.4;
/// Distance between two places that are tried, metres.
const SEARCH_STEP_M: f64 = 0.001;
/// Number of steps to each side of the mean of all sightings: farther than a sensor's bearing is off.
const SEARCH_STEPS: i32 = 25;
/// Least gap that a sighting is taken to have, metres: the planner finds no path out of a contact.
const GAP_MIN_M: f64 = 0.0015;

/// The centre of what a robot sees in its path, if that is a robot; stage metres. `None` if it reports no place or
/// sees nothing.
pub(crate) fn seen_by(robot: &KnownRobot, contact_m: f64) -> Option<Vec2> {
    let (at, blocked) = (robot.reported.at?, robot.reported.blocked?);
    Some(at + Vec2::unit(blocked.towards) * (contact_m + blocked.gap_m.max(GAP_MIN_M)))
}

/// Something that a robot sees in its path, stage metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sighting {
    /// Where the robot that sees stands.
    pub from: Vec2,
    /// Centre of what it sees, if that is a robot.
    pub there: Vec2,
}

impl Sighting {
    /// The place in the direction of `towards` at the distance of the sighting.
    fn at_range(&self, towards: Vec2) -> Vec2 {
        let direction = (towards - self.from).normalized();
        direction.map_or(self.there, |unit| self.from + unit * self.from.distance(self.there))
    }

    /// Least distance between a place and what was seen, metres, if the bearing of the sighting is off by up to
    /// `BEARING`.
    fn off_m(&self, place: Vec2) -> f64 {
        let (seen, there) = (self.there - self.from, place - self.from);
        let aside = wrap(there.angle() - seen.angle()).clamp(-BEARING, BEARING);
        (self.from + Vec2::unit(seen.angle() + aside) * seen.length()).distance(place)
    }

    /// Whether a robot on the path through these places, or pushed off that path, explains the sighting.
    pub fn is_near_any(&self, places: &[Vec2]) -> bool {
        samples(places).any(|place| self.off_m(place) < PUSHED_M)
    }

    /// Whether a robot that stands at a place explains the sighting.
    pub fn is_of(&self, at: Vec2) -> bool {
        let (seen, known) = (self.there - self.from, at - self.from);
        let aside = wrap(seen.angle() - known.angle()).abs();
        (seen.length() - known.length()).abs() < KNOWN_RANGE_M && aside < KNOWN_BEARING
    }
}

/// Where a robot that fell silent on its path stands: one place for each group of sightings near the path, of which
/// `places` are samples. A robot that was run into stands beside its path, and a sensor measures range much better
/// than bearing. If only one robot sees it far from the estimate, places up to the sighting itself are added.
fn located(places: &[Vec2], sightings: &[Sighting]) -> Vec<Vec2> {
    let path: Vec<Vec2> = samples(places).collect();
    let mut left: Vec<Sighting> = sightings.iter().filter(|seen| seen.is_near_any(places)).copied().collect();
    let mut found = Vec::new();
    // Two groups are two robots, or one robot that is seen from two sides with wrong bearings: both places count.
    while let Some(first) = left.first().copied() {
        let (group, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|seen| seen.there.distance(first.there) < SAME_M);
        left = others;
        let place = fused(&path, &group);
        found.push(place);
        if let [alone] = group[..]
            && alone.there.distance(place) > SIGMA.range_m * 2.0
        {
            found.extend([alone.at_range(place.lerp(alone.there, 0.5)), alone.there]);
        }
    }
    found
}

/// Replaces the places where a silent robot may stand by those where other robots see something near. If they see
/// nothing there, the places stay.
pub(crate) fn narrow(places: &mut Vec<Vec2>, sightings: &[Sighting]) {
    let seen = located(places, sightings);
    if !seen.is_empty() {
        *places = seen;
    }
}

/// The most likely place by a group of sightings and a path: least squares on a grid of [`SEARCH_STEP_M`].
fn fused(path: &[Vec2], group: &[Sighting]) -> Vec2 {
    let middle = group.iter().fold(Vec2::ZERO, |sum, seen| sum + seen.there) / group.len() as f64;
    let path_error_m = if group.len() == 1 { SIGMA.path_m } else { SIGMA.pushed_m };
    let cost = |place: Vec2| {
        let seen = |seen: &Sighting| {
            let far_m = place.distance(seen.from) - seen.from.distance(seen.there);
            (far_m / SIGMA.range_m).powi(2) + (place.distance(seen.there) / SIGMA.bearing_m).powi(2)
        };
        let off_m = path.iter().map(|at| at.distance(place)).fold(f64::INFINITY, f64::min);
        group.iter().map(seen).sum::<f64>() + (off_m / path_error_m).powi(2)
    };
    let steps = -SEARCH_STEPS..=SEARCH_STEPS;
    let around =
        steps.clone().flat_map(|x| steps.clone().map(move |y| Vec2::new(f64::from(x), f64::from(y))));
    let tried = around.map(|step| middle + step * SEARCH_STEP_M);
    tried.min_by(|a, b| cost(*a).total_cmp(&cost(*b))).unwrap_or(middle)
}

/// Samples of the path through these places: the places, and those between neighbours on the path.
fn samples(places: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    places.iter().copied().chain(between(places))
}

/// Places between neighbours on a path, at equal parts.
fn between(places: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    let stretches = places.windows(2).filter(|pair| pair[0].distance(pair[1]) < NEXT_M);
    stretches
        .flat_map(|pair| (1..PARTS).map(|part| pair[0].lerp(pair[1], f64::from(part) / f64::from(PARTS))))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path along x, sampled every 13 mm.
    fn path() -> Vec<Vec2> {
        (0..8).map(|step| Vec2::new(0.013 * f64::from(step), 0.0)).collect()
    }

    /// A sighting of what stands at a place, with a bearing that is off by an angle, radians.
    fn sighting(from: Vec2, stands: Vec2, off: f64) -> Sighting {
        let there = from + Vec2::unit((stands - from).angle() + off) * from.distance(stands);
        Sighting { from, there }
    }

    #[test]
    fn one_sighting_is_set_right_by_the_path() {
        let (from, stands) = (Vec2::new(0.02, 0.05), Vec2::new(0.045, 0.0));
        for off in [-0.3, 0.0, 0.3] {
            let seen = sighting(from, stands, off);
            let found = located(&path(), &[seen]);
            assert!(found[0].distance(stands) < 0.008, "{off}: {found:?}");
            assert_eq!(found.len(), if off == 0.0 { 1 } else { 3 }, "{found:?}");
        }
        assert!(located(&path(), &[sighting(from, Vec2::new(0.02, 0.2), 0.0)]).is_empty());
    }

    #[test]
    fn two_sightings_find_a_robot_that_was_pushed_off_its_path() {
        let stands = Vec2::new(0.045, 0.015);
        let behind = sighting(Vec2::new(-0.012, 0.02), stands, 0.2);
        let beside = sighting(Vec2::new(0.05, -0.042), stands, -0.2);
        let found = located(&path(), &[behind, beside]);
        assert_eq!(found.len(), 1);
        assert!(found[0].distance(stands) < 0.004, "{found:?}");
    }

    #[test]
    fn what_no_push_explains_leaves_a_silent_robot_where_it_is() {
        let stands = Vec2::new(0.0, 0.1);
        for (from, there, moves) in [
            (Vec2::new(0.075, 0.0), Vec2::new(0.005, 0.0), false),
            (Vec2::new(0.075, 0.08), Vec2::new(0.005, 0.08), true),
            (Vec2::new(0.0, 0.03), Vec2::new(0.05, 0.08), true),
        ] {
            let mut places = vec![stands];
            narrow(&mut places, &[Sighting { from, there }]);
            assert_eq!(places != [stands], moves, "{there:?}: {places:?}");
        }
    }

    #[test]
    fn what_a_known_robot_explains_is_no_sighting_of_a_silent_one() {
        let seen = sighting(Vec2::ZERO, Vec2::new(0.06, 0.0), 0.3);
        assert!(seen.is_of(Vec2::new(0.062, 0.0)));
        assert!(!seen.is_of(Vec2::new(0.062, -0.03)) && !seen.is_of(Vec2::new(0.08, 0.0)));
    }
}
