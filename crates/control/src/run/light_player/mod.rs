//! Light over time. A stretch is up to 10 s of a robot's colours, sent ahead. Robots that do not understand stretches
//! are sent single colours (the command COLOR).
//!
//! Shows without layers of light use this only once live light (layers that the operator adds) is put over them. Before
//! that, `lights` changes their colours. `sending` sends what is due, `placing` says where a leg is on the timeline,
//! and `live` has the layers of live light.
//!
//! A leg is the drive of all robots between two moments at which all stand. Robots stop in a hold, and light stands
//! still with them unless a layer runs freely.

mod live;
mod placing;
mod sending;

pub(crate) use live::{LIVE_MAX, NAME_MAX};

use crate::context::Context;
use crate::leg::{Leg, LegKind};
use crate::run::light_leg::{LegLight, LegTimes, PlannedStretch};
use crate::run::path_clock::PathClock;
use crate::run::playback::{PlayedShow, RunPurpose};
use crate::run::roster::Roster;
use crate::run::show_times::ShowTimes;
use crate::run::upload::Upload;
use lightbots_base::{Instant, Rgb, Span, TICK};
use lightbots_lighting::{FrameTimes, LiveLayers, ShowLight, numbers};
use lightbots_wire::Command;
use std::sync::Arc;

/// Longest duration of a stretch. With a shorter one, more messages are needed. With a longer one, more light is sent
/// in vain when plans change.
const STRETCH: Span = Span::from_millis(10_000);
/// How long lights blend to the new colours where show time jumps: after GO, in a new round, after a new plan.
const BLEND: Span = Span::from_millis(500);
/// How long it takes robots to show a change of live light: the time of the message and of the blend.
const CHANGE: Span = Span::from_millis(250);
/// Layers that run freely are moved to the music if they are farther from it than this, seconds. People notice twice
/// this difference.
const NEAR_MUSIC_S: f64 = 0.03;
/// Largest number of long stretches that are computed at once; of short ones, up to five times as many. A long one
/// takes 0.3 ms, and reports of robots wait meanwhile.
pub(crate) const AT_ONCE: usize = 16;
/// Pause until the next `AT_ONCE` stretches are computed.
pub(crate) const AGAIN_AFTER: Span = Span::from_millis(5);

/// The light of a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct LightPlayer {
    show: ShowLight,
    /// Show times of the frames of the present round of the show.
    pub times: ShowTimes,
    /// `[participant]`: the number by which effects know its robot. It stays the same over the whole run.
    numbers: Arc<[u32]>,
    /// Light of the leg that is driven or was driven last; `None` before the first drive.
    current: Option<LegLight>,
    /// Light of the leg after `current`; `None` until it is computed.
    next: Option<LegLight>,
    /// The stretch that is being uploaded or was uploaded last in this drive, and its deliveries; `None` if there is
    /// none.
    upload: Option<(PlannedStretch, Upload)>,
    /// Up to when robots have light that stands still in holds, as time since the drive began, without holds.
    covered: Span,
    /// Up to which show-clock moment robots have light that goes on during holds. [`Instant::FAR`]: they have one
    /// colour until the present hold ends. `None`: their light stands still in holds.
    free_until: Option<Instant>,
    /// The hold that the newest stretch takes into account: when it begins, and when it ends if that was known. `None`
    /// without a hold.
    known_hold: Option<(Instant, Option<Instant>)>,
    /// When stretches are sent that were put off because `AT_ONCE` were computed.
    again_at: Instant,
    /// When colours are next sent to robots that do not understand stretches.
    colours_at: Instant,
    /// Layers of light that the operator put over the show.
    live: LiveLayers,
    /// Whether live light was used in this run. From then on stretches are sent even if the show has no layers.
    was_live: bool,
    /// When all robots get a new stretch; [`Instant::FAR`] if never. Reasons: live light changed, a drive began after
    /// live light was used, or layers that run freely are moved to the music.
    renew_at: Instant,
    /// When all robots last began to get a new stretch for any of these reasons; [`Instant::ZERO`] if never.
    renewed_at: Instant,
    /// How long before the end of the newest stretch the next one begins to be sent.
    refill: Span,
}

impl LightPlayer {
    /// The light of a run. Previews, the way home and preflights have no layers of light.
    pub fn new(playback: &PlayedShow) -> Self {
        let show = match playback.purpose {
            RunPurpose::Play => ShowLight::new(&playback.show).0,
            RunPurpose::Preview | RunPurpose::Home | RunPurpose::Preflight => ShowLight::default(),
        };
        Self { show, again_at: Instant::FAR, renew_at: Instant::FAR, ..Self::default() }
    }

    /// Whether stretches are sent, because the show has layers of light or live light was put over it.
    pub fn is_active(&self) -> bool {
        !self.show.is_empty() || self.was_live
    }

    /// The first stretch of the next leg for a participant, which is sent along with its route. `None` if the robot
    /// does not understand stretches, if no stretches are used, or during live light.
    pub fn first_stretch(
        &mut self,
        context: &mut Context,
        (playback, roster): (&PlayedShow, &Roster),
        (leg, after): (&Leg, Option<&Leg>),
        (now, participant): (Instant, usize),
    ) -> Option<Command> {
        // Live light runs by the show clock, and it is not known yet when the drive begins.
        let may_be_sent = self.is_active() && self.live.is_empty();
        if !may_be_sent || !roster.robot(context, participant).reported.abilities.light {
            return None;
        }
        self.prepare(context, playback, roster, leg);
        let light = self.next.as_ref()?;
        let robot = light.driven(leg, after, participant)?;
        Some(light.command(&context.config, &self.show, &robot, &light.first, now))
    }

    /// Computes the light of the next leg, unless it is known already.
    fn prepare(&mut self, context: &mut Context, playback: &PlayedShow, roster: &Roster, leg: &Leg) {
        if self.next.as_ref().is_some_and(|next| next.seq == leg.seq) {
            return;
        }
        let before = self.before(context, roster, leg);
        self.number_robots(leg);
        let (drive, air) = (leg.duration, playback.air_time(leg.frame));
        let place = placing::place(&mut self.times, self.current.as_ref(), (playback, leg));
        let (show_s, is_chosen) = (place.show_s, place.is_chosen);
        let current = self.current.as_ref();
        let waits_for_go = leg.reaches_frame && playback.cue(leg.frame).is_some();
        let air_s = if leg.reaches_frame { show_s + drive.as_secs() } else { f64::INFINITY };
        let end_s = if waits_for_go { f64::INFINITY } else { air_s + air.as_secs() };
        let drive_s = match (is_chosen, self.times.begun.get(&leg.frame)) {
            (true, _) => self.times.drive_begin_s(playback, leg.frame).unwrap_or(show_s),
            (false, known) => known.filter(|_| place.is_same_frame).map_or(show_s, |times| times.drive_s),
        };
        self.times.begun.insert(leg.frame, FrameTimes { drive_s, air_s, end_s });
        let mut layers = self.show.in_frame(leg.frame, |frame| self.times.begun.get(&frame).copied());
        layers.live = self.live.layers().clone();
        let follows = current.is_some_and(|current| {
            current.frame.round == leg.round
                && current.frame.frame.checked_add(1) == Some(leg.frame)
                && !current.times.waits_for_go
        }) && !is_chosen;
        let over = if follows && !layers.is_free() { Span::ZERO } else { BLEND };
        let number = if self.is_active() { context.number_route() } else { 0 };
        let mut light = LegLight {
            seq: leg.seq,
            frame: leg.cursor(),
            reaches_frame: leg.reaches_frame,
            times: LegTimes {
                show_s,
                due_s: place.due_s,
                leads_music: place.leads_music,
                drive,
                air: if leg.reaches_frame { air } else { Span::ZERO },
                waits_for_go,
                lead_s: current.map_or(0.0, LegLight::lead_s_after),
            },
            numbers: self.numbers.clone(),
            before,
            after: leg.robots.iter().map(|step| (step.color, step.pixel.is_some())).collect(),
            layers,
            first: PlannedStretch { number, from: Span::ZERO, ticks: 1, over, free_at: None },
            clock: None,
            seen: Span::ZERO,
        };
        light.first = light.stretch(number, Span::ZERO, STRETCH, over).unwrap_or(light.first);
        self.next = Some(light);
    }

    /// Numbers all robots for effects at the first leg, and later those that have joined since.
    fn number_robots(&mut self, leg: &Leg) {
        if self.numbers.is_empty() {
            self.numbers = numbers(leg.robots.iter().map(|step| step.pixel)).into();
        } else if self.numbers.len() < leg.robots.len() {
            self.numbers = self
                .numbers
                .iter()
                .copied()
                .chain(self.numbers.len() as u32..leg.robots.len() as u32)
                .collect();
        }
    }

    /// Makes the light of a leg the current light, because its drive has begun. Also done while no stretches are sent,
    /// because live light may be put over the show later.
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
        (self.upload, self.again_at, self.known_hold) = (None, Instant::FAR, None);
        self.free_until = light.layers.is_free().then_some(clock.began + self.covered);
        (self.refill, self.colours_at) = (STRETCH / 2, now);
        self.renew_at = if self.was_live { now } else { Instant::FAR };
        self.current = Some(light);
        if self.is_active() {
            self.set_lights(context, roster, leg);
        }
    }

    /// Notes in the fleet table that robots that understand stretches will end with the colours of the leg.
    fn set_lights(&self, context: &mut Context, roster: &Roster, leg: &Leg) {
        for (participant, step) in leg.robots.iter().enumerate().take(roster.len()) {
            if roster.robot(context, participant).reported.abilities.light {
                context.set_light(roster.participants[participant].robot, step.color);
            }
        }
    }

    /// Light of the leg that is driven or was driven last; `None` before the first drive.
    pub fn current(&self) -> Option<&LegLight> {
        self.current.as_ref()
    }

    /// Notes how much time of the current leg has passed at `now`. Also needed while no stretches are sent.
    pub fn look(&mut self, now: Instant) {
        let Some(current) = &mut self.current else { return };
        if let Some(elapsed) = current.elapsed(now) {
            current.seen = elapsed;
        }
    }

    /// Replaces the time base of the current drive, because holds may have changed it.
    pub fn see(&mut self, clock: PathClock) {
        if let Some(current) = &mut self.current {
            current.clock = Some(clock);
        }
    }

    /// If layers that run freely are off the music by more than `NEAR_MUSIC_S`, moves them to it, and all robots get a
    /// new stretch. `music_s` is where the music is on the timeline, seconds.
    pub fn keep_to_music(&mut self, now: Instant, music_s: f64) {
        let is_free = |current: &&mut LegLight| current.layers.runs_freely && current.elapsed(now).is_some();
        let Some(current) = self.current.as_mut().filter(is_free) else { return };
        let shown = current.moment_at(now);
        let behind_s = music_s - shown.show_s - shown.lead_s;
        if behind_s.abs() > NEAR_MUSIC_S {
            current.times.lead_s += behind_s;
            self.renew_at = now;
        }
    }

    /// Stops show time until the next drive, because robots are stopped and all is planned again. Does nothing once the
    /// drive of the current leg is over.
    pub fn halt(&mut self) {
        if let Some(current) = self.current.as_mut().filter(|current| current.seen < current.times.drive) {
            (current.clock, self.upload) = (None, None);
        }
    }

    /// Takes in a report, which names (and so acknowledges) the stretch that its robot received last.
    pub fn acknowledge(&mut self, now: Instant, participant: usize, number: u32) {
        let Some((stretch, upload)) = &mut self.upload else { return };
        if stretch.number == number && upload.acknowledge(now, participant) && upload.has_unserved() {
            self.again_at = now;
        }
    }

    /// Whether robots are still adopting a change of live light.
    fn is_changing(&self, now: Instant) -> bool {
        let is_under_way = self.renewed_at > Instant::ZERO && now < self.renewed_at + CHANGE;
        self.renew_at < Instant::FAR || is_under_way
    }

    /// Whether lights still blend to the colours of a new drive or of changed live light. Also `true` after the drive
    /// was interrupted, until the next one begins. `false` if no stretches are used, or before the first drive.
    pub fn blends(&self, now: Instant) -> bool {
        let Some(current) = self.current.as_ref().filter(|_| self.is_active()) else { return false };
        self.is_changing(now) || current.elapsed(now).is_none_or(|elapsed| elapsed < current.first.over)
    }

    /// The colour that a participant should show now. `None` if no stretches are used, no drive has begun, the drive
    /// was interrupted, or the participant is not in the leg.
    pub fn colour(
        &self,
        now: Instant,
        (leg, after): (&Leg, Option<&Leg>),
        participant: usize,
    ) -> Option<Rgb> {
        let current = self.current.as_ref().filter(|_| self.is_active())?;
        let moment = current.moment(current.elapsed(now)?, current.lost(now));
        let robot = current.driven(leg, after, participant)?;
        Some(robot.colour(&current.layers, self.show.pictures(), moment))
    }

    /// `[participant]`: the colour that its robot shows before a leg, and whether layers of light shine on the robot
    /// then.
    fn before(&self, context: &Context, roster: &Roster, leg: &Leg) -> Vec<(Rgb, bool)> {
        let shown = |participant: usize| {
            let known = self.current.as_ref().map(|current| &current.after);
            let known = known.and_then(|after| after.get(participant)).copied();
            known.unwrap_or_else(|| (roster.robot(context, participant).light.color, false))
        };
        (0..leg.robots.len().min(roster.len())).map(shown).collect()
    }
}
