//! Light over time: stretches that robots get ahead, and COLORs for robots that know no stretches.
//!
//! Runs of shows without layers do not use it; their lights are in `lights`.

use crate::context::Context;
use crate::leg::{Leg, LegKind};
use crate::run::light_leg::{LegLight, PlannedStretch};
use crate::run::path_clock::PathClock;
use crate::run::playback::{PlayedShow, RunPurpose};
use crate::run::roster::Roster;
use crate::run::show_times::ShowTimes;
use crate::run::upload::Upload;
use lightbots_base::{Instant, Rgb, Span, TICK};
use lightbots_lighting::{FrameTimes, ShowLight, is_seen_apart};
use lightbots_wire::{Command, Route};

/// Duration of a stretch. Shorter: more messages. Longer: more is sent in vain when plans change.
const STRETCH: Span = Span::from_millis(10_000);
/// The next stretch is sent when half of the one before has played.
const REFILL: Span = Span::from_millis(5_000);
/// How long lights take to the new colours where show time jumps: after GO, in a new round, after a new plan.
const BLEND: Span = Span::from_millis(500);
/// Most stretches that are computed at once: each takes 0.3 ms, and reports wait meanwhile.
pub(crate) const AT_ONCE: usize = 16;
/// When the next ones follow.
pub(crate) const AGAIN_AFTER: Span = Span::from_millis(5);
/// How far ahead a stretch that begins in a hold or for one robot is stated: a round trip.
const LEAD: Span = Span::from_millis(100);
/// The second stretch is sent this long after the drive began: robots whose clock is a little behind drop what waits when
/// the drive begins (R56).
const BEGUN: Span = Span::from_millis(100);

/// COLORs of robots that know no stretches.
struct Colours {
    /// Time between two of a robot.
    every: Span,
    /// Most of them a second, for the whole fleet.
    rate: i64,
}

/// Four a second look like steps of a fade; 200 a second leave the broker free for routes.
const COLOURS: Colours = Colours { every: Span::from_millis(250), rate: 200 };

/// The light of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightPlayer {
    show: ShowLight,
    /// When the frames of this round are.
    pub times: ShowTimes,
    /// The leg that is driven or was driven last.
    current: Option<LegLight>,
    /// The leg after it.
    next: Option<LegLight>,
    /// The stretch that is uploaded.
    upload: Option<(PlannedStretch, Upload)>,
    /// Until when stretches were begun to be sent, as time since the drive began.
    covered: Span,
    /// Until when robots have light for the hold under way.
    held_until: Option<Instant>,
    /// When what was put off is sent.
    again_at: Instant,
    /// When COLORs are sent next.
    colours_at: Instant,
}

impl LightPlayer {
    /// The light of a run.
    pub fn new(playback: &PlayedShow) -> Self {
        let show = match playback.purpose {
            RunPurpose::Play => ShowLight::new(&playback.show, |_| None).0,
            RunPurpose::Preview | RunPurpose::Home => ShowLight::default(),
        };
        Self { show, again_at: Instant::FAR, ..Self::default() }
    }

    /// Whether the show has layers.
    pub fn is_active(&self) -> bool {
        !self.show.is_empty()
    }

    /// The first stretch of the next leg for a participant, which goes along with its route; `None`: its robot knows no
    /// stretches.
    pub fn first_stretch(
        &mut self,
        context: &mut Context,
        (playback, roster): (&PlayedShow, &Roster),
        (leg, after): (&Leg, Option<&Leg>),
        (now, participant): (Instant, usize),
    ) -> Option<Command> {
        if !self.is_active() || !roster.robot(context, participant).reported.abilities.light {
            return None;
        }
        self.prepare(context, playback, roster, leg);
        let light = self.next.as_ref()?;
        let robot = light.driven(leg, after, participant)?;
        Some(light.command(&self.show, &robot, &light.first, now))
    }

    /// Makes the light of the next leg, unless it is made.
    fn prepare(&mut self, context: &mut Context, playback: &PlayedShow, roster: &Roster, leg: &Leg) {
        if self.next.as_ref().is_some_and(|next| next.seq == leg.seq) {
            return;
        }
        let before = self.before(context, roster, leg);
        let (drive, air) = (leg.duration, playback.air_time(leg.frame));
        let frame = (leg.frame, leg.round);
        let current = self.current.as_ref();
        let is_new_round = current.is_some_and(|current| current.frame.1 != leg.round);
        let is_same_frame = current.is_some_and(|current| current.frame == frame);
        let is_chosen = playback.jump.is_some();
        if is_new_round {
            self.times.begun.clear();
        }
        let show_s = match current {
            _ if is_chosen => self.times.begin_s(playback, leg.frame) - drive.as_secs(),
            Some(current) if is_same_frame => {
                let elapsed = if current.reaches_frame { current.seen } else { current.drive };
                current.moment(elapsed.min(current.drive), Span::ZERO).show_s
            }
            Some(current) if !is_new_round => current.show_s + (current.drive + current.air).as_secs(),
            _ => self.times.begin_s(playback, leg.frame) - drive.as_secs(),
        };
        if is_chosen {
            self.times.begin_earlier(playback, leg.frame);
        }
        let waits_for_go = leg.reaches_frame && playback.cue(leg.frame).is_some();
        let air_s = if leg.reaches_frame { show_s + drive.as_secs() } else { f64::INFINITY };
        let end_s = if waits_for_go { f64::INFINITY } else { air_s + air.as_secs() };
        let drive_s = match (is_chosen, self.times.begun.get(&leg.frame)) {
            (true, _) => self.times.drive_begin_s(playback, leg.frame).unwrap_or(show_s),
            (false, known) => known.filter(|_| is_same_frame).map_or(show_s, |times| times.drive_s),
        };
        self.times.begun.insert(leg.frame, FrameTimes { drive_s, air_s, end_s });
        let layers = self.show.in_frame(leg.frame, |frame| self.times.begun.get(&frame).copied());
        let follows = current.is_some_and(|current| {
            current.frame == (leg.frame.wrapping_sub(1), leg.round) && !current.waits_for_go
        }) && !is_chosen;
        let over = if follows && !layers.runs_freely { Span::ZERO } else { BLEND };
        let number = context.number_route();
        let mut light = LegLight {
            seq: leg.seq,
            frame,
            reaches_frame: leg.reaches_frame,
            show_s,
            drive,
            air: if leg.reaches_frame { air } else { Span::ZERO },
            waits_for_go,
            lead_s: current.map_or(0.0, |current| {
                current.clock.map_or(current.lead_s, |clock| current.lead_s + clock.lost.as_secs())
            }),
            before,
            after: leg.robots.iter().map(|step| (step.color, step.pixel.is_some())).collect(),
            layers,
            first: PlannedStretch { number, from: Span::ZERO, ticks: 1, over, held_at: None },
            clock: None,
            seen: Span::ZERO,
        };
        light.first = light.stretch(number, Span::ZERO, STRETCH, over).unwrap_or(light.first);
        self.next = Some(light);
    }

    /// The drive of a leg has begun.
    pub fn begin_drive(
        &mut self,
        context: &mut Context,
        (playback, roster): (&PlayedShow, &Roster),
        leg: &Leg,
        (now, clock): (Instant, PathClock),
    ) {
        self.prepare(context, playback, roster, leg);
        let Some(mut light) = self.next.take() else { return };
        light.clock = Some(clock);
        // The first stretch went along with the routes, if there were any.
        let is_sent = leg.kind == LegKind::Routes;
        self.covered = if is_sent { TICK * i64::from(light.first.ticks) } else { Span::ZERO };
        (self.upload, self.held_until, self.again_at) = (None, None, Instant::FAR);
        self.colours_at = now;
        for (participant, step) in leg.robots.iter().enumerate().take(roster.len()) {
            if roster.robot(context, participant).reported.abilities.light {
                context.set_light(roster.participants[participant].robot, step.color);
            }
        }
        self.current = Some(light);
    }

    /// The drive goes on by this clock.
    pub fn see(&mut self, clock: PathClock) {
        if let Some(current) = &mut self.current {
            current.clock = Some(clock);
        }
    }

    /// Robots stop, and all is planned again from where they stand: show time stands until the next drive, unless this one
    /// was over.
    pub fn halt(&mut self) {
        if let Some(current) = self.current.as_mut().filter(|current| current.seen < current.drive) {
            (current.clock, self.upload) = (None, None);
        }
    }

    /// A report names the stretch that its robot received last.
    pub fn acknowledge(&mut self, now: Instant, participant: usize, number: u32) {
        let Some((stretch, upload)) = &mut self.upload else { return };
        if stretch.number == number && upload.acknowledge(now, participant) && upload.has_unserved() {
            self.again_at = now;
        }
    }

    /// Sends what is due while a leg is driven or its frame stands. `legs`: that leg, and the one after it.
    pub fn pump(&mut self, context: &mut Context, roster: &Roster, now: Instant, legs: (&Leg, Option<&Leg>)) {
        let Some(elapsed) = self.current.as_ref().and_then(|current| current.elapsed(now)) else { return };
        if let Some(current) = &mut self.current {
            current.seen = elapsed;
            if let Some(clock) = &mut current.clock {
                clock.end_hold(now);
            }
        }
        self.again_at = Instant::FAR;
        self.begin_stretch(context, now, elapsed, legs.0);
        self.pump_stretch(context, roster, now, legs);
        if now >= self.colours_at {
            self.colours_at = self.send_colours(context, roster, (now, elapsed), legs);
        }
    }

    /// Begins to upload the next stretch, if it is time.
    fn begin_stretch(&mut self, context: &mut Context, now: Instant, elapsed: Span, leg: &Leg) {
        let Some(current) = &self.current else { return };
        let is_held = current
            .clock
            .and_then(|clock| clock.hold)
            .is_some_and(|hold| hold.until.is_none() && now > hold.at + Route::EASE);
        let stretch = match self.held_until {
            until if is_held && current.layers.runs_freely => {
                if until.is_some_and(|until| now + REFILL < until) {
                    return;
                }
                self.held_until = Some(now + LEAD + STRETCH);
                let stretch = current.stretch(context.number_route(), elapsed, STRETCH, Span::ZERO);
                stretch.map(|stretch| PlannedStretch { held_at: Some(now + LEAD), ..stretch })
            }
            Some(_) => {
                self.held_until = None;
                current.stretch(context.number_route(), elapsed, STRETCH, Span::ZERO)
            }
            None if elapsed < BEGUN || elapsed + REFILL < self.covered => return,
            None if current.end().is_some_and(|end| self.covered >= end && !current.layers.runs_freely) => {
                return;
            }
            None => current.stretch(context.number_route(), self.covered, STRETCH, Span::ZERO),
        };
        let Some(stretch) = stretch else { return };
        if stretch.held_at.is_none() {
            self.covered = stretch.from + TICK * i64::from(stretch.ticks);
        }
        self.upload = Some((stretch, Upload::new(stretch.number, now, leg.robots.len())));
    }

    /// Sends the stretch under way to robots that have not got it.
    fn pump_stretch(
        &mut self,
        context: &mut Context,
        roster: &Roster,
        now: Instant,
        (leg, after): (&Leg, Option<&Leg>),
    ) {
        let (Some(current), Some((stretch, upload))) = (&self.current, &mut self.upload) else { return };
        let config = context.config.upload;
        let again_at = now + config.resend_after * 2;
        let mut left = AT_ONCE;
        while left > 0 {
            let needs_none =
                |one: usize| roster.is_excluded(one) || !roster.robot(context, one).reported.abilities.light;
            let overdue = upload.next_overdue(now, needs_none);
            let Some(one) = overdue.or_else(|| upload.next_unserved(config.window, needs_none)) else {
                return;
            };
            if let Some(robot) = current.driven(leg, after, one) {
                let command = current.command(&self.show, &robot, stretch, now);
                context.send(roster.participants[one].robot, &[command]);
            }
            upload.record_sent(now, one, again_at);
            left -= 1;
        }
        self.again_at = now + AGAIN_AFTER;
    }

    /// Sends COLORs to robots that know no stretches; when that is done next.
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
            if !robot.is_light_sure || is_seen_apart(robot.light, colour) {
                context.set_light(known.robot, colour);
                context.send(known.robot, &[Command::Color(colour)]);
            }
        }
        let every = COLOURS.every.max(Span(robots * 1_000_000 / COLOURS.rate));
        if robots == 0 { Instant::FAR } else { now + every }
    }

    /// A robot was switched off and on: it gets what is left of its light.
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
        let longest = (self.covered - elapsed).max(TICK);
        let Some(stretch) = current.stretch(number, elapsed, longest, BLEND) else { return };
        let command = current.command(&self.show, &robot, &stretch, now);
        context.send(roster.participants[participant].robot, &[command]);
    }

    /// When something is due.
    pub fn due(&self, now: Instant) -> Instant {
        let Some(current) = &self.current else { return Instant::FAR };
        let resend = self.upload.as_ref().and_then(|(_, upload)| upload.due()).unwrap_or(Instant::FAR);
        let is_covered = current.end().is_some_and(|end| self.covered >= end) && !current.layers.runs_freely;
        let next = match current.clock.filter(|clock| clock.hold.is_none() && !is_covered) {
            Some(clock) => now + (self.covered - REFILL - clock.path_time(now)).max(BEGUN),
            None => self.held_until.map_or(Instant::FAR, |_| now + REFILL),
        };
        self.again_at.min(resend).min(next).min(self.colours_at)
    }

    /// Whether lights are on their way to the colours of a new drive.
    pub fn blends(&self, now: Instant) -> bool {
        let Some(current) = &self.current else { return false };
        current.elapsed(now).is_none_or(|elapsed| elapsed < current.first.over)
    }

    /// The colour that a participant should show now.
    pub fn colour(
        &self,
        now: Instant,
        (leg, after): (&Leg, Option<&Leg>),
        participant: usize,
    ) -> Option<Rgb> {
        let current = self.current.as_ref()?;
        let moment = current.moment(current.elapsed(now)?, current.lost(now));
        let robot = current.driven(leg, after, participant)?;
        Some(robot.colour(&current.layers, self.show.pictures(), moment))
    }

    /// `[participant]`: what robots show before a leg.
    fn before(&self, context: &Context, roster: &Roster, leg: &Leg) -> Vec<(Rgb, bool)> {
        let shown = |participant: usize| {
            let known = self.current.as_ref().map(|current| &current.after);
            let known = known.and_then(|after| after.get(participant)).copied();
            known.unwrap_or_else(|| (roster.robot(context, participant).light, false))
        };
        (0..leg.robots.len().min(roster.len())).map(shown).collect()
    }
}
