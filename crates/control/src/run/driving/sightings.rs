//! Locates robots that fell silent, by what the proximity sensors of other robots see in their paths (sightings).

use crate::robot::KnownRobot;
use lightbots_base::{Vec2, wrap};

/// Two sightings may be of one robot if they are closer to each other than this, metres. The same holds for a sighting
/// and the place of a robot.
pub(crate) const SAME_M: f64 = 0.035;
/// Places that follow each other in a list are neighbours on one path if they are closer to each other than this,
/// metres.
const NEXT_M: f64 = 0.03;
/// Number of parts into which a path is cut between two neighbouring places.
const PARTS: u32 = 8;

/// Standard deviations for the place of a robot that others see, metres. With smaller ones the estimate jumps from
/// sighting to sighting. With larger ones a robot that was pushed is still placed on its path.
struct Sigma {
    /// Of a sighting along the line of sight: 1 mm for the sensor, and the error of the place of the robot that sees.
    range_m: f64,
    /// Of a sighting across the line of sight: sensors are 45 degrees apart, at 55 mm.
    bearing_m: f64,
    /// Of the distance of a dead robot from its path, if only one robot sees it.
    path_m: f64,
    /// Of the distance of a dead robot from its path, if several robots see it: those that ran into it have pushed it.
    pushed_m: f64,
}

/// Standard deviations (1 sigma).
const SIGMA: Sigma = Sigma { range_m: 0.002, bearing_m: 0.018, path_m: 0.002, pushed_m: 0.008 };

/// Largest distance by which robots push a dead one off its path, metres: 40 mm were measured in a fleet of 200. A
/// sighting farther from the path is of something else.
const PUSHED_M: f64 = 0.05;
/// Largest difference, metres, between the range of a sighting and the distance to a robot with a known place. Up to
/// this difference (4 sigma) the sighting may be of that robot.
const KNOWN_RANGE_M: f64 = 0.008;
/// Largest error in bearing at which a sighting may be of a robot with a known place, radians: the angle between two
/// sensors. With a larger value, a silent robot that is seen is taken for a known one. With a smaller value, a silent
/// robot is located where a known one stands, and plans lead through its real place.
const KNOWN_BEARING: f64 = 0.8;
/// Largest error of a sighting's bearing, radians: half the angle between two sensors.
const BEARING: f64 = 0.4;
/// Distance between neighbouring places on the search grid, metres.
const SEARCH_STEP_M: f64 = 0.001;
/// Number of grid steps to each side of the mean of a group of sightings. This covers the error of a sensor's bearing.
const SEARCH_STEPS: i32 = 25;
/// Least gap between two rims that a sighting is taken to have, metres. With less, the two robots would touch in the
/// plan, and the planner finds no path out of a contact.
const GAP_MIN_M: f64 = 0.0015;

/// The centre of what a robot sees in its path, stage metres, if what it sees is a robot. `contact_m`: distance between
/// the centres of two robots that touch. `None` if the robot reports no place or sees nothing.
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
    /// The place at the range of the sighting, in the direction from the seeing robot to `towards`.
    fn at_range(&self, towards: Vec2) -> Vec2 {
        let direction = (towards - self.from).normalized();
        direction.map_or(self.there, |unit| self.from + unit * self.from.distance(self.there))
    }

    /// Distance between `place` and what was seen, metres, after the bearing of the sighting is turned towards `place`
    /// by at most `BEARING`.
    fn off_m(&self, place: Vec2) -> f64 {
        let (seen, there) = (self.there - self.from, place - self.from);
        let aside = wrap(there.angle() - seen.angle()).clamp(-BEARING, BEARING);
        (self.from + Vec2::unit(seen.angle() + aside) * seen.length()).distance(place)
    }

    /// Whether the sighting may be of a robot on the path through `places`, or pushed off that path by less than
    /// `PUSHED_M`.
    pub fn is_near_any(&self, places: &[Vec2]) -> bool {
        samples(places).any(|place| self.off_m(place) < PUSHED_M)
    }

    /// Whether the sighting may be of a robot that stands at `at`, within the errors of range and bearing.
    pub fn is_of(&self, at: Vec2) -> bool {
        let (seen, known) = (self.there - self.from, at - self.from);
        let aside = wrap(seen.angle() - known.angle()).abs();
        (seen.length() - known.length()).abs() < KNOWN_RANGE_M && aside < KNOWN_BEARING
    }
}

/// Where a robot that fell silent on its path may stand, by sightings near the path. Empty if no sighting is near it.
/// `places` are samples of the path. Sightings that are close together form a group, and each group gives one place.
/// The place may lie beside the path, because other robots may have pushed the robot. A group may have a single
/// sighting that is not close to the place. Then two more places are added: the sighting itself, and one halfway to it.
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

/// Replaces the places where a silent robot may stand by those where other robots see something near these places. If
/// they see nothing there, `places` stays as it is.
pub(crate) fn narrow(places: &mut Vec<Vec2>, sightings: &[Sighting]) {
    let seen = located(places, sightings);
    if !seen.is_empty() {
        *places = seen;
    }
}

/// The most likely place of a robot, given a group of sightings and its path: least squares on a grid with steps of
/// [`SEARCH_STEP_M`].
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

/// Samples of the path through these places: the places themselves, and more between neighbours on the path.
fn samples(places: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    places.iter().copied().chain(between(places))
}

/// Places that cut the path between each two neighbours into [`PARTS`] equal parts.
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
