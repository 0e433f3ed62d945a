//! Something stands in a robot's way: all hold, whoever is near is asked for a sign of life, and what stands there is
//! driven around.

use crate::desk::Desk;
use crate::event::Trouble;
use crate::fleet::Robot;
use crate::run::{Run, Seat};
use lightbots_base::{Instant, Span, Vec2, wrap};
use lightbots_wire::{Blocked, Command, Topic};

/// Who is so near to a blocked robot, metres, by what was heard last, is asked for a sign of life.
const NEAR_M: f64 = 0.5;
/// Who does not answer within this, link times on top, is silent.
const ANSWER: Span = Span::from_millis(800);
/// Those who are asked are asked again this often.
const ASK: Span = Span::from_millis(90);
/// What blocks a robot for so long is there to stay …
const STAYS: Span = Span::from_millis(1_500);
/// … unless it may be a late robot or a silent one: that is dropped first, and this much time is left for it.
const LATER: Span = Span::from_millis(500);
/// A robot that is blocked more often than this in a run drops out itself.
const BLOCKS_MAX: u8 = 3;
/// The most obstacles that are remembered.
const FOUND_MAX: usize = 32;
/// Whoever brakes for something falls behind at most so long before it says that it is blocked.
const BRAKES: Span = Span::from_millis(150);
/// A place so near to where a robot sees something may be what it sees, metres.
const SAME_M: f64 = 0.035;
/// Places of a way nearer to each other than this follow on each other, metres.
const NEXT_M: f64 = 0.03;
/// Into so many parts the way between them is cut.
const PARTS: u32 = 8;
/// Error of a sighting along the line of sight, 1 sigma, metres: the sensor's 1 mm and the error of the robot's own place.
const FAR_ERROR_M: f64 = 0.002;
/// Error of a sighting across the line of sight, 1 sigma, metres: sensors are 45 degrees apart, at 55 mm.
const ASIDE_ERROR_M: f64 = 0.018;
/// How far beside its path a robot dies, 1 sigma, metres.
const PATH_ERROR_M: f64 = 0.002;
/// The same where several robots see it: those that ran into it have pushed it.
const PUSHED_ERROR_M: f64 = 0.008;
/// Robots that run into a dead one push it at most so far off its path, metres: 40 mm were seen in a fleet of 200.
const PUSHED_M: f64 = 0.1;
/// A sighting is one of a robot whose place is known where that is as far away, but for this, metres, …
const KNOWN_FAR_M: f64 = 0.008;
/// … and in the same direction, but for this, radians: half the angle between two sensors.
const KNOWN_ASIDE: f64 = 0.4;
/// Places are tried this far apart, metres, …
const SEARCH_STEP_M: f64 = 0.001;
/// … and this many steps to each side of the middle of all sightings.
const SEARCH_STEPS: i32 = 25;

/// A gap is taken for at least this, metres: nobody can plan a way out of a contact.
const GAP_MIN_M: f64 = 0.0015;

/// Where the other's centre is that a robot sees in its way, if that is a robot; stage metres.
fn seen_by(robot: &Robot, contact_m: f64) -> Option<Vec2> {
    let (at, blocked) = (robot.at?, robot.blocked?);
    Some(at + Vec2::unit(blocked.towards) * (contact_m + blocked.gap_m.max(GAP_MIN_M)))
}

/// Something a robot sees in its way, stage metres.
#[derive(Clone, Copy, Debug)]
struct Sighting {
    /// Where the robot stands that sees it.
    from: Vec2,
    /// Where the other's centre is, if it is a robot.
    there: Vec2,
}

impl Sighting {
    /// The place in the direction of another that is as far away as what was seen.
    fn at_range(&self, towards: Vec2) -> Vec2 {
        let direction = (towards - self.from).normalized();
        direction.map_or(self.there, |unit| self.from + unit * self.from.distance(self.there))
    }

    /// Whether it is explained by a robot that is known to stand at a place.
    fn is_of(&self, at: Vec2) -> bool {
        let (seen, known) = (self.there - self.from, at - self.from);
        let aside = wrap(seen.angle() - known.angle()).abs();
        (seen.length() - known.length()).abs() < KNOWN_FAR_M && aside < KNOWN_ASIDE
    }
}

/// Where a robot stands that fell silent on its path, of which `places` are known: one place for each group of sightings
/// near the path, as a robot that was run into stands beside it. How far away it is, a sensor tells much better than in
/// which direction. Where only one robot sees it, the path tells that, unless it was pushed: then all places between what
/// the path and what the sensor says are kept clear.
fn located(places: &[Vec2], sightings: &[Sighting]) -> Vec<Vec2> {
    let mut path: Vec<Vec2> = places.to_vec();
    path.extend(between(places));
    let near_path = |seen: &&Sighting| path.iter().any(|place| place.distance(seen.there) < PUSHED_M);
    let mut left: Vec<Sighting> = sightings.iter().filter(near_path).copied().collect();
    let mut found = Vec::new();
    // Two groups are two robots, or one that is seen from two sides in wrong directions: both places are kept clear.
    while let Some(first) = left.first().copied() {
        let (group, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|seen| seen.there.distance(first.there) < SAME_M);
        left = others;
        let place = fused(&path, &group);
        found.push(place);
        if let [alone] = group[..]
            && alone.there.distance(place) > FAR_ERROR_M * 2.0
        {
            found.extend([alone.at_range(place.lerp(alone.there, 0.5)), alone.there]);
        }
    }
    found
}

/// The place that explains a group of sightings and a path best, by steps of [`SEARCH_STEP_M`].
fn fused(path: &[Vec2], group: &[Sighting]) -> Vec2 {
    let middle = group.iter().fold(Vec2::ZERO, |sum, seen| sum + seen.there) / group.len() as f64;
    let path_error_m = if group.len() == 1 { PATH_ERROR_M } else { PUSHED_ERROR_M };
    let cost = |place: Vec2| {
        let seen = |seen: &Sighting| {
            let far_m = place.distance(seen.from) - seen.from.distance(seen.there);
            (far_m / FAR_ERROR_M).powi(2) + (place.distance(seen.there) / ASIDE_ERROR_M).powi(2)
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

/// Places on the stretches of a path between those that are known.
fn between(places: &[Vec2]) -> impl Iterator<Item = Vec2> + '_ {
    let stretches = places.windows(2).filter(|pair| pair[0].distance(pair[1]) < NEXT_M);
    stretches
        .flat_map(|pair| (1..PARTS).map(|part| pair[0].lerp(pair[1], f64::from(part) / f64::from(PARTS))))
}

/// Whether a robot fell behind its path and not because something stood in its way.
fn lags(known: &Seat) -> bool {
    let unhindered = |late: Instant| {
        known.blocked.is_none_or(|blocked| late + BRAKES < blocked)
            && known.hindered.is_none_or(|at| at < late)
    };
    known.late.is_some_and(unhindered)
}

impl Run {
    /// A driving robot says what stands in its way, or that nothing does.
    pub fn hear_block(&mut self, desk: &mut Desk, now: Instant, seat: usize, blocked: Option<Blocked>) {
        if blocked.is_none() {
            self.seats[seat].blocked = None;
            return;
        }
        if self.seats[seat].blocked.is_some() {
            return;
        }
        self.seats[seat].blocked = Some(now);
        if self.seats[seat].late.is_none_or(|late| now <= late + BRAKES) {
            self.seats[seat].hindered = Some(now);
        }
        if self.seats[seat].late.is_none() {
            self.mark_late(desk, now, seat, Trouble::Blocked);
        }
        let Some(at) = desk.fleet.robot(self.seats[seat].robot).at else { return };
        for other in 0..self.seats.len() {
            let known = &self.seats[other];
            let robot = desk.fleet.robot(known.robot);
            let near = robot.at.is_some_and(|place| place.distance(at) < NEAR_M);
            let awaited = self.is_awaited(other) && !known.arrived && !robot.is_original();
            if near && awaited && other != seat && known.probed.is_none() {
                desk.outbox.say(Topic::Robot(robot.id), &[Command::Status]);
                self.seats[other].probed = Some(now);
                self.seats[other].asked = now;
            }
        }
    }

    /// Looks after a seat that was asked for a sign of life. Whether it dropped out.
    pub fn watch_probed(&mut self, desk: &mut Desk, now: Instant, seat: usize) -> bool {
        let Some(since) = self.seats[seat].probed else { return false };
        let robot = desk.fleet.robot(self.seats[seat].robot);
        if robot.heard > since {
            self.seats[seat].probed = None;
        } else if now - since > ANSWER + self.round_trip * 2 {
            self.drop_out(desk, now, seat, Trouble::Silent);
            return true;
        } else if now - self.seats[seat].asked >= ASK {
            desk.outbox.say(Topic::Robot(robot.id), &[Command::Status]);
            self.seats[seat].asked = now;
        }
        false
    }

    /// Looks after a blocked robot. After a while what blocks it is there to stay, and all is planned anew around it.
    pub fn watch_blocked(&mut self, desk: &mut Desk, now: Instant, seat: usize, since: Instant) {
        if now - since > STAYS
            && let Some(culprit) = self.late_at(desk, seat)
        {
            self.drop_out(desk, now, culprit, Trouble::Late);
            return;
        }
        let suspect = |known: &Seat| known.probed.is_some() || lags(known);
        let suspected = self.seats.iter().any(|known| !known.out && !known.arrived && suspect(known));
        let bound = if suspected { desk.config.late_bound + LATER } else { STAYS };
        if now - since <= bound {
            return;
        }
        let known = &mut self.seats[seat];
        known.blocks = known.blocks.saturating_add(1);
        if known.blocks > BLOCKS_MAX {
            self.drop_out(desk, now, seat, Trouble::Blocked);
            return;
        }
        let seen = seen_by(desk.fleet.robot(known.robot), self.show.stage.limits.contact_m());
        self.found.extend(seen.filter(|_| self.found.len() < FOUND_MAX));
        self.narrow_again(desk);
        self.bound.begins(self.reached_by(now));
        self.recover(desk, now);
    }

    /// A late robot that stands where a blocked one sees something, and was late before anything blocked it: one that
    /// stands still sees those coming who drive on. One that stands because its fixes stay away has its reason.
    fn late_at(&self, desk: &Desk, seat: usize) -> Option<usize> {
        let contact_m = self.show.stage.limits.contact_m();
        let there = seen_by(desk.fleet.robot(self.seats[seat].robot), contact_m)?;
        (0..self.seats.len()).find(|&other| {
            let known = &self.seats[other];
            lags(known)
                && !known.unsure
                && !known.out
                && desk.fleet.robot(known.robot).at.is_some_and(|at| at.distance(there) < SAME_M)
        })
    }

    /// Of the places where a silent robot may stand, those where others see something, if they see any.
    pub fn narrow(&self, desk: &Desk, places: &mut Vec<Vec2>) {
        let seen = located(places, &self.sightings(desk));
        if !seen.is_empty() {
            *places = seen;
        }
    }

    /// Where silent robots stand, by what others see of them since.
    fn narrow_again(&mut self, desk: &Desk) {
        for seat in 0..self.seats.len() {
            let mut ghost = std::mem::take(&mut self.seats[seat].ghost);
            if self.seats[seat].out && !ghost.is_empty() {
                self.narrow(desk, &mut ghost);
                self.seats[seat].likely.clone_from(&ghost);
            }
            self.seats[seat].ghost = ghost;
        }
    }

    /// What blocked robots see that is no robot whose place is known.
    fn sightings(&self, desk: &Desk) -> Vec<Sighting> {
        let contact_m = self.show.stage.limits.contact_m();
        let known: Vec<Vec2> = self
            .seats
            .iter()
            .filter(|known| !known.out)
            .filter_map(|k| desk.fleet.robot(k.robot).at)
            .collect();
        let blocked = self.seats.iter().filter(|known| known.blocked.is_some() && !known.out);
        let sighting = |known: &Seat| {
            let robot = desk.fleet.robot(known.robot);
            let (from, there) = (robot.at?, seen_by(robot, contact_m)?);
            Some(Sighting { from, there })
        };
        let strange = |seen: &Sighting| !known.iter().any(|at| seen.is_of(*at));
        blocked.filter_map(sighting).filter(strange).collect()
    }

    /// A new drive, or none: nobody is blocked.
    pub fn forget_blocks(&mut self) {
        for known in &mut self.seats {
            (known.blocked, known.probed) = (None, None);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path along x, known every 13 mm.
    fn path() -> Vec<Vec2> {
        (0..8).map(|step| Vec2::new(0.013 * f64::from(step), 0.0)).collect()
    }

    /// A sighting of what stands at a place, seen off by an angle.
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
    fn what_a_known_robot_explains_is_no_sighting_of_a_silent_one() {
        let seen = sighting(Vec2::ZERO, Vec2::new(0.06, 0.0), 0.3);
        assert!(seen.is_of(Vec2::new(0.062, 0.0)));
        assert!(!seen.is_of(Vec2::new(0.062, -0.03)) && !seen.is_of(Vec2::new(0.08, 0.0)));
    }
}
