//! Changes of light in shows without layers of light: colours change over the last part of a drive (a fade), by the
//! show clock.
//!
//! A change is kept after its drive: it is sent along with the next route until that route is acknowledged.

use crate::context::Context;
use crate::leg::Leg;
use crate::run::roster::Roster;
use crate::run::upload::Upload;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Fade, Topic};

/// Longest time that a colour takes to change. A longer fade looks like a fault of the light.
const FADE_MAX: Span = Span::from_millis(1_000);

/// How changes of light that were sent without a route are repeated. No report acknowledges these.
struct Repeats {
    /// Time between two repeats. If copies were closer together, one burst of losses would take them all.
    every: Span,
    /// Number of repeats in small fleets, and in larger ones, whose link is busy with routes.
    times: (u32, u32),
    /// Largest number of robots in a small fleet.
    few: usize,
}

/// With 5 % of messages lost, five copies (the first and four repeats) leave one robot of 3 million in the wrong light.
const REPEATS: Repeats = Repeats { every: Span::from_millis(300), times: (4, 1), few: 200 };

/// Changes of light, by participant.
#[derive(Clone, Debug)]
pub(crate) struct Lights {
    /// `[participant]`: a change that the robot may not have received yet. Participants that joined later have none.
    pending: Vec<Option<Fade>>,
    /// Which pending changes are repeated, and when.
    repeats: Option<Upload>,
    /// When the pending changes are repeated next, all at once.
    repeat_at: Instant,
    /// Number of repeats that are left.
    repeats_left: u32,
    /// When robots that cannot fade are sent their new colour.
    colors_at: Instant,
}

impl Default for Lights {
    fn default() -> Self {
        Self {
            pending: Vec::new(),
            repeats: None,
            repeat_at: Instant::FAR,
            repeats_left: 0,
            colors_at: Instant::FAR,
        }
    }
}

impl Lights {
    /// Sends robots their changes of light for a drive from `began` to `ends`. If a robot has a route in the `next`
    /// leg, its change is sent along with that route, which is acknowledged. Otherwise the change is sent at once and
    /// repeated. Robots that follow routes and cannot fade are sent their new colour in the middle of the fade.
    pub fn begin_drive(
        &mut self,
        context: &mut Context,
        roster: &Roster,
        (now, began, ends): (Instant, Instant, Instant),
        (leg, next): (&Leg, Option<&Leg>),
    ) {
        let over = FADE_MAX.min((ends - began) / 2).max(Span::ZERO);
        let at = ends - over;
        let mut is_any_sent = false;
        for (participant, step) in leg.robots.iter().enumerate() {
            let known = &roster.participants[participant];
            let robot = context.fleet.robot(known.robot);
            let changes = leg.reaches_frame || leg.path(participant).is_some();
            if known.is_excluded() || !changes || robot.is_original() || robot.shows(step.color) {
                continue;
            }
            if !robot.reported.abilities.fade {
                self.colors_at = at + over / 2;
                continue;
            }
            let fade = Fade { to: step.color, at, over };
            let topic = Topic::Robot(robot.id);
            context.set_light(known.robot, step.color);
            self.pending[participant] = Some(fade);
            if next.is_none_or(|next| next.path(participant).is_none()) {
                context.outbox.send(topic, &[Command::Fade(fade)]);
                is_any_sent = true;
            }
        }
        if is_any_sent {
            self.begin_repeats(now);
        }
    }

    fn begin_repeats(&mut self, now: Instant) {
        let (few, many) = REPEATS.times;
        self.repeats_left = if self.pending.len() <= REPEATS.few { few } else { many };
        self.repeat_at = now + REPEATS.every;
        let mut repeats = Upload::new(0, now, self.pending.len());
        for participant in (0..self.pending.len()).filter(|&one| self.pending[one].is_some()) {
            repeats.record_sent(now, participant, self.repeat_at);
        }
        self.repeats = Some(repeats);
    }

    /// Forgets the changes of the drive before, and makes room for those of `participants`.
    pub fn forget(&mut self, participants: usize) {
        *self = Self { pending: vec![None; participants], ..Self::default() };
    }

    /// Starts to repeat pending changes by themselves, because the routes that were to carry them were dropped.
    pub fn send_again(&mut self, now: Instant) {
        if self.pending.iter().any(Option::is_some) {
            self.begin_repeats(now);
        }
    }

    /// Ends the repeats of a drive. Its pending changes are now sent only along with the next routes.
    pub fn end_drive(&mut self) {
        let pending = std::mem::take(&mut self.pending);
        *self = Self { pending, ..Self::default() };
    }

    /// Sends repeats of changes and new colours that are due.
    pub fn pump(&mut self, context: &mut Context, roster: &Roster, now: Instant, leg: &Leg) {
        self.repeat(context, roster, now);
        if now >= self.colors_at {
            self.colors_at = Instant::FAR;
            set_colors(context, roster, leg);
        }
    }

    fn repeat(&mut self, context: &mut Context, roster: &Roster, now: Instant) {
        if now < self.repeat_at {
            return;
        }
        self.repeats_left = self.repeats_left.saturating_sub(1);
        self.repeat_at = if self.repeats_left > 0 { now + REPEATS.every } else { Instant::FAR };
        let Some(repeats) = &mut self.repeats else { return };
        let needs_none = |one: usize| roster.is_excluded(one) || self.pending[one].is_none();
        while let Some(one) = repeats.next_overdue(now, needs_none) {
            if let Some(fade) = self.pending[one] {
                let topic = Topic::Robot(roster.robot(context, one).id);
                context.outbox.send(topic, &[Command::Fade(fade)]);
                repeats.record_sent(now, one, self.repeat_at);
            }
        }
    }

    /// When [`pump`](Self::pump) has something to do next.
    pub fn due(&self) -> Instant {
        self.repeat_at.min(self.colors_at)
    }

    /// The change of light to send along with the next route of a participant. `None` if none is pending.
    pub fn pending(&self, participant: usize) -> Option<Fade> {
        self.pending.get(participant).copied().flatten()
    }

    /// Forgets the pending change of a participant, because its robot acknowledged the route with the change, or
    /// dropped out.
    pub fn settle(&mut self, participant: usize) {
        if let Some(pending) = self.pending.get_mut(participant) {
            *pending = None;
        }
    }
}

/// Sends the new colour to robots that follow routes and cannot fade.
fn set_colors(context: &mut Context, roster: &Roster, leg: &Leg) {
    for (participant, step) in leg.robots.iter().enumerate() {
        let known = &roster.participants[participant];
        let fades = context.fleet.robot(known.robot).reported.abilities.fade;
        let drives = !known.is_excluded() && !fades && leg.path(participant).is_some();
        if drives && context.set_light(known.robot, step.color) {
            context.send(known.robot, &[Command::Color(step.color)]);
        }
    }
}

/// At the beginning of a leg that is driven by TARGETs, sends new colours to the robots that drive. If the leg reaches
/// its frame, also sends them to all other robots that show a pixel.
pub(crate) fn color_target_robots(context: &mut Context, roster: &Roster, leg: &Leg) {
    for (participant, step) in leg.robots.iter().enumerate() {
        let known = &roster.participants[participant];
        let lit = leg.is_driven_by(participant) || leg.reaches_frame && step.pixel.is_some();
        if lit && !known.is_excluded() && context.set_light(known.robot, step.color) {
            context.send(known.robot, &[Command::Color(step.color)]);
        }
    }
}

/// Sends a robot that was switched off and on again the colour that it has in the leg.
pub(crate) fn relight(context: &mut Context, roster: &Roster, leg: &Leg, participant: usize) {
    let Some(step) = leg.robots.get(participant) else { return };
    let robot = roster.participants[participant].robot;
    context.set_light(robot, step.color);
    context.send(robot, &[Command::Color(step.color)]);
}
