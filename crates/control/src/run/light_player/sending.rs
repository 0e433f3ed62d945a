//! Sends light that is due. Stretches (seconds of a robot's colours) are sent until they are acknowledged; other robots
//! get single colours (the command COLOR).

use super::{AGAIN_AFTER, AT_ONCE, BLEND, LightPlayer, STRETCH};
use crate::context::Context;
use crate::leg::Leg;
use crate::run::light_leg::{LegLight, PlannedStretch};
use crate::run::path_clock::PathClock;
use crate::run::roster::Roster;
use crate::run::upload::Upload;
use lightbots_base::{Instant, Span, TICK};
use lightbots_lighting::is_seen_apart;
use lightbots_wire::Command;

/// Least time from sending a stretch that goes on during holds to its beginning: a round trip. For changes of live
/// light it is `LIVE.lead`.
const LEAD: Span = Span::from_millis(100);
/// For how long after a drive began the second stretch is not sent. A robot with a clock a little behind has not begun
/// the drive yet. It drops a waiting stretch when it begins (R56).
const BEGUN: Span = Span::from_millis(100);

/// Parameters of a change of live light, which robots show within 0.3 s.
struct LiveChange {
    /// Duration of the blend to the new colours. A shorter one looks like a fault, a longer one like a slow button.
    blend: Span,
    /// How long before the beginning of the blend the change is sent.
    lead: Span,
    /// Duration of the first stretch after a change, and the time that each robot adds to it. The next stretch then
    /// reaches all robots in time. A short first stretch is computed sooner.
    first: (Span, Span),
    /// `AT_ONCE` is multiplied by at most this for short stretches, because each takes only 0.06 ms to compute.
    at_once: usize,
}

/// `lead` and `blend` add up to 180 ms. Of the 0.3 s, 120 ms are left for the message and the computation.
const LIVE: LiveChange = LiveChange {
    blend: Span::from_millis(150),
    lead: Span::from_millis(30),
    first: (Span::from_millis(2_000), Span(600)),
    at_once: 5,
};

impl LiveChange {
    fn first(&self, robots: usize) -> Span {
        let (least, each) = self.first;
        (least + each * i64::try_from(robots).unwrap_or(i64::MAX / 1_000)).min(STRETCH)
    }
}

/// Rate at which colours are sent to robots that do not understand stretches.
struct Colours {
    /// Least time between two colours for one robot.
    every: Span,
    /// Largest number of colours a second for the whole fleet.
    rate: i64,
}

/// Four colours a second look like the steps of a fade. 200 a second in all leave the broker free for routes.
const COLOURS: Colours = Colours { every: Span::from_millis(250), rate: 200 };

impl LightPlayer {
    /// Sends light that is due while robots drive a leg or stand in its frame. `legs`: this leg, and the one after it.
    pub fn pump(&mut self, context: &mut Context, roster: &Roster, now: Instant, legs: (&Leg, Option<&Leg>)) {
        let Some(elapsed) = self.current.as_ref().and_then(|current| current.elapsed(now)) else { return };
        if let Some(clock) = self.current.as_mut().and_then(|current| current.clock.as_mut()) {
            clock.end_hold(now);
        }
        self.again_at = Instant::FAR;
        self.begin_stretch(context, now, elapsed, legs.0);
        self.pump_stretch(context, roster, now, legs);
        if now >= self.colours_at {
            self.colours_at = self.send_colours(context, roster, (now, elapsed), legs);
        }
    }

    /// Begins to upload the next stretch, if it is due.
    fn begin_stretch(&mut self, context: &mut Context, now: Instant, elapsed: Span, leg: &Leg) {
        let Some(current) = &self.current else { return };
        let Some(clock) = current.clock else { return };
        let renews = now >= self.renew_at && elapsed >= BEGUN;
        let is_free = current.layers.is_free();
        let begins = match is_free || renews && clock.is_held() {
            true => self.next_free(&clock, now, renews).map(|at| (clock.path_time(at), Some(at))),
            false => self.next_moment(current, &clock, elapsed, renews).map(|from| (from, None)),
        };
        let Some((from, free_at)) = begins else { return };
        let rests_at = clock.rests_from().unwrap_or(now);
        let (longest, over) = match (renews, free_at) {
            // Once all robots stand in the hold, the light does not change until the hold is over.
            (true, Some(at)) if !is_free => ((rests_at - at).max(Span::ZERO) + TICK, LIVE.blend),
            (true, _) => (LIVE.first(leg.robots.len()), LIVE.blend),
            (false, _) => (STRETCH, Span::ZERO),
        };
        let number = context.number_route();
        let stretch = match current.stretch(number, from, longest, over) {
            Some(stretch) => PlannedStretch { free_at, ..stretch },
            // Show time of the leg is over, so the light stays as it is at the end.
            None if renews => PlannedStretch { number, from, ticks: 1, over, free_at },
            None => return,
        };
        let lasts = TICK * i64::from(stretch.ticks);
        self.refill = (STRETCH / 2).min(lasts / 2);
        if renews {
            (self.renew_at, self.renewed_at) = (Instant::FAR, now);
        }
        self.free_until = free_at.map(|at| if is_free { at + lasts } else { Instant::FAR });
        self.known_hold = clock.hold.map(|hold| (hold.at, hold.until));
        if free_at.is_none() {
            self.covered = stretch.from + lasts;
        }
        self.upload = Some((stretch, Upload::new(stretch.number, now, leg.robots.len())));
    }

    /// The show-clock moment at which the next stretch that goes on during holds begins. `None` if none is due.
    fn next_free(&self, clock: &PathClock, now: Instant, renews: bool) -> Option<Instant> {
        if renews {
            return Some(now + LIVE.lead);
        }
        // A new hold needs a new stretch, because light that follows show time slows down and picks up with the drive.
        let hold = clock.hold.filter(|hold| self.known_hold != Some((hold.at, hold.until)));
        if let Some(hold) = hold {
            return Some(hold.until.unwrap_or(hold.at).max(now + LEAD));
        }
        let until = self.free_until?;
        (now + self.refill >= until).then_some(until.max(now + LEAD))
    }

    /// The beginning of the next stretch that stands still in holds, as time since the drive began, without holds.
    /// `None` if none is due.
    fn next_moment(
        &self,
        current: &LegLight,
        clock: &PathClock,
        elapsed: Span,
        renews: bool,
    ) -> Option<Span> {
        if renews {
            return Some(elapsed);
        }
        if self.free_until.is_some() && !clock.is_held() && self.renew_at == Instant::FAR {
            // One tick later, so that the light of the hold stays until the hold is over.
            return Some(elapsed + TICK);
        }
        let is_covered = elapsed < BEGUN || elapsed + self.refill < self.covered;
        let is_over = current.end().is_some_and(|end| self.covered >= end);
        (!is_covered && !is_over).then_some(self.covered)
    }

    /// Sends the present stretch to robots that have not acknowledged it, at most `AT_ONCE` of them (more if the
    /// stretch is short). The rest follows after `AGAIN_AFTER`.
    fn pump_stretch(
        &mut self,
        context: &mut Context,
        roster: &Roster,
        now: Instant,
        (leg, after): (&Leg, Option<&Leg>),
    ) {
        let is_changing = self.is_changing(now);
        let (Some(current), Some((stretch, upload))) = (&self.current, &mut self.upload) else { return };
        let config = context.config.upload;
        // The operator waits for a change of live light, and a stretch that goes on during holds begins soon.
        let is_urgent = is_changing || stretch.free_at.is_some_and(|at| at < now + config.resend_after * 2);
        // Short stretches take less time to compute.
        let shorter = STRETCH.0 / (TICK.0 * i64::from(stretch.ticks)).max(1);
        let mut left = AT_ONCE * usize::try_from(shorter).unwrap_or(1).clamp(1, LIVE.at_once);
        while left > 0 {
            let needs_none =
                |one: usize| roster.is_excluded(one) || !roster.robot(context, one).reported.abilities.light;
            let overdue = upload.next_overdue(now, needs_none);
            let Some(one) = overdue.or_else(|| upload.next_unserved(config.window, needs_none)) else {
                return;
            };
            if let Some(robot) = current.driven(leg, after, one) {
                let command = current.command(&context.config, &self.show, &robot, stretch, now);
                context.send(roster.participants[one].robot, &[command]);
            }
            let again_after = match upload.tries(one) {
                _ if is_urgent => config.resend_after,
                0 => config.resend_after * 2,
                // A slow broker gets no more work than it must: at most two messages to a robot in any second.
                _ => config.resend_after * 4,
            };
            upload.record_sent(now, one, now + again_after);
            left -= 1;
        }
        self.again_at = now + AGAIN_AFTER;
    }

    /// Sends colours that have visibly changed to robots that do not understand stretches. Returns when to do that
    /// next; [`Instant::FAR`] if all robots that take part understand stretches.
    fn send_colours(
        &self,
        context: &mut Context,
        roster: &Roster,
        (now, elapsed): (Instant, Span),
        (leg, after): (&Leg, Option<&Leg>),
    ) -> Instant {
        let Some(current) = &self.current else { return Instant::FAR };
        let mut robots = 0;
        for (participant, known) in roster.participants.iter().enumerate() {
            let robot = context.fleet.robot(known.robot);
            if known.is_excluded() || robot.reported.abilities.light {
                continue;
            }
            robots += 1;
            let Some(driven) = current.driven(leg, after, participant) else { continue };
            let moment = current.moment(elapsed, current.lost(now));
            let colour = driven.colour(&current.layers, self.show.pictures(), moment);
            if !robot.light.is_sure || is_seen_apart(robot.light.color, colour) {
                context.set_light(known.robot, colour);
                context.send(known.robot, &[Command::Color(colour)]);
            }
        }
        let every = COLOURS.every.max(Span(robots * 1_000_000 / COLOURS.rate));
        if robots == 0 { Instant::FAR } else { now + every }
    }

    /// Sends a robot that was switched off and on again the rest of its present light.
    pub fn relight(
        &self,
        context: &mut Context,
        roster: &Roster,
        now: Instant,
        leg: &Leg,
        participant: usize,
    ) {
        let Some(current) = &self.current else { return };
        let (Some(elapsed), Some(robot)) = (current.elapsed(now), current.driven(leg, None, participant))
        else {
            return;
        };
        let number = context.number_route();
        let free_at = now + LEAD;
        let free = self.free_until.filter(|until| (free_at..Instant::FAR).contains(until));
        let stretch = match free.zip(current.clock) {
            Some((until, clock)) => current
                .stretch(number, clock.path_time(free_at), (until - free_at).max(TICK), BLEND)
                .map(|stretch| PlannedStretch { free_at: Some(free_at), ..stretch }),
            None => current.stretch(number, elapsed, (self.covered - elapsed).max(TICK), BLEND),
        };
        let Some(stretch) = stretch else { return };
        let command = current.command(&context.config, &self.show, &robot, &stretch, now);
        context.send(roster.participants[participant].robot, &[command]);
    }

    /// When [`pump`](Self::pump) has something to do next.
    pub fn due(&self, now: Instant) -> Instant {
        let Some(current) = self.current.as_ref().filter(|_| self.is_active()) else { return Instant::FAR };
        let resend = self.upload.as_ref().and_then(|(_, upload)| upload.due()).unwrap_or(Instant::FAR);
        let free = self.free_until.filter(|until| *until < Instant::FAR).map(|until| until - self.refill);
        let is_over = current.end().is_some_and(|end| self.covered >= end);
        let next = match current.clock.filter(|clock| clock.hold.is_none() && !is_over) {
            _ if current.layers.is_free() => free.unwrap_or(Instant::FAR),
            Some(clock) => now + (self.covered - self.refill - clock.path_time(now)).max(BEGUN),
            None => Instant::FAR,
        };
        let renewal = current.clock.map_or(Instant::FAR, |clock| self.renew_at.max(clock.began + BEGUN));
        self.again_at.min(resend).min(next).min(self.colours_at).min(renewal)
    }
}
