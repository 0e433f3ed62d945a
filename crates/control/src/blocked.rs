//! Something stands in a robot's way: all hold, whoever is near is asked for a sign of life, and what stands there is
//! driven around.

use crate::desk::Desk;
use crate::event::Trouble;
use crate::fleet::Robot;
use crate::run::{Run, Seat};
use lightbots_base::{Instant, Span, Vec2};
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
/// What a robot says of something in its way is wrong by about so much in distance and across, metres.
const FAR_ERROR_M: f64 = 0.001;
const ASIDE_ERROR_M: f64 = 0.008;

/// A gap is taken for at least this, metres: nobody can plan a way out of a contact.
const GAP_MIN_M: f64 = 0.0015;

/// Where the other's centre is that a robot sees in its way, if that is a robot; stage metres.
fn seen_by(robot: &Robot, contact_m: f64) -> Option<Vec2> {
    let (at, blocked) = (robot.at?, robot.blocked?);
    Some(at + Vec2::unit(blocked.towards) * (contact_m + blocked.gap_m.max(GAP_MIN_M)))
}

/// Where on a way, of which these places are known, something most likely stands that a robot at `at` sees `there`: how
/// far away it is, a sensor tells much better than in which direction.
fn likeliest(places: &[Vec2], at: Vec2, there: Vec2) -> Option<Vec2> {
    let between = places.windows(2).filter(|pair| pair[0].distance(pair[1]) < NEXT_M);
    let between = between
        .flat_map(|pair| (1..PARTS).map(|part| pair[0].lerp(pair[1], f64::from(part) / f64::from(PARTS))));
    let far_m = at.distance(there);
    let off = |place: &Vec2| {
        let (away_m, aside_m) = (place.distance(at) - far_m, place.distance(there));
        (away_m / FAR_ERROR_M).powi(2) + (aside_m / ASIDE_ERROR_M).powi(2)
    };
    let near = |place: &Vec2| place.distance(there) < SAME_M;
    places.iter().copied().chain(between).filter(near).min_by(|a, b| off(a).total_cmp(&off(b)))
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
        let contact_m = self.show.stage.limits.contact_m();
        let blocked = self.seats.iter().filter(|known| known.blocked.is_some() && !known.out);
        let mut seen = Vec::new();
        for robot in blocked.map(|known| desk.fleet.robot(known.robot)) {
            let (Some(at), Some(there)) = (robot.at, seen_by(robot, contact_m)) else { continue };
            // The path says in which direction, the sensor how far.
            if let Some(likeliest) = likeliest(places, at, there)
                && let Some(towards) = (likeliest - at).normalized()
            {
                seen.push(at + towards * at.distance(there));
            }
        }
        if !seen.is_empty() {
            *places = seen;
        }
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

    #[test]
    fn how_far_something_is_finds_it_on_a_way_whose_direction_is_seen_badly() {
        // A way along x, known every 13 mm; what stands on it is seen 10° off.
        let places: Vec<Vec2> = (0..8).map(|step| Vec2::new(0.013 * f64::from(step), 0.0)).collect();
        let (at, stands) = (Vec2::new(0.02, 0.05), Vec2::new(0.045, 0.0));
        for off in [-0.17, 0.0, 0.17] {
            let there = at + Vec2::unit((stands - at).angle() + off) * at.distance(stands);
            let found = likeliest(&places, at, there).unwrap();
            assert!(found.distance(stands) < 0.004, "{off}: {found:?}");
        }
        assert_eq!(likeliest(&places, at, Vec2::new(0.02, 0.1)), None);
    }
}
