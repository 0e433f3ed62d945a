//! The light of one leg, from the beginning of its drive until robots leave the frame: moments of show time, and
//! colours at these.
//!
//! A leg is the drive of all robots between two moments at which all stand. A hold is a common stop during a drive.
//! Show time stands during holds.

use crate::config::Config;
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::run::path_clock::PathClock;
use lightbots_base::{Instant, Rgb, Span, TICK};
use lightbots_lighting::{DrivenLight, FrameLight, LightMoment, ShowLight, fit};
use lightbots_wire::{Command, LightAnchor, LightRecords, LightStretch, MAX_LIGHT_RECORDS};
use std::sync::Arc;

/// A stretch: the next seconds of light. Each robot is sent its own colours for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlannedStretch {
    /// Number of the stretch, by which robots acknowledge it.
    pub number: u32,
    /// Beginning of the stretch, as time since the drive began, without the time of holds.
    pub from: Span,
    /// Duration of the stretch in ticks of 10 ms ([`TICK`]).
    pub ticks: u32,
    /// How long robots blend from the colours that they show to the colours of the stretch.
    pub over: Span,
    /// Show-clock moment at which the stretch begins, if it goes on during holds. `None` if it stands still in holds.
    pub free_at: Option<Instant>,
}

/// Where a leg is on the timeline of the show, and how show time goes on after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegTimes {
    /// Show time when the drive begins, seconds.
    pub show_s: f64,
    /// Show time at which robots are to reach the frame by the timeline, seconds. If robots are late, they reach it at
    /// a later show time.
    pub due_s: f64,
    /// Whether the music jumps to this leg, because the operator chose the frame, or because frames repeat.
    pub leads_music: bool,
    /// Duration of the drive by plan.
    pub drive: Span,
    /// Air time (stay of robots) that the show gives the frame; zero if the leg does not reach the frame.
    pub air: Span,
    /// Whether robots wait for the operator's GO in the frame that the leg reaches. Show time then goes on until GO.
    pub waits_for_go: bool,
    /// How long show time had stood still in the run until the drive began, seconds. Corrected so that layers that run
    /// freely keep to the music.
    pub lead_s: f64,
}

/// The light of a leg.
#[derive(Clone, Debug)]
pub(crate) struct LegLight {
    /// Number of the leg's routes.
    pub seq: u32,
    /// The frame to which the leg leads.
    pub frame: FrameCursor,
    /// Whether robots reach the frame at the end of the leg.
    pub reaches_frame: bool,
    /// Where the leg is on the timeline.
    pub times: LegTimes,
    /// `[participant]`: the number by which effects know its robot.
    pub numbers: Arc<[u32]>,
    /// `[participant]`: its colour before the leg, and whether layers of light shone on its robot then.
    pub before: Vec<(Rgb, bool)>,
    /// `[participant]`: its colour at the end of the leg, and whether layers of light may shine on its robot then.
    pub after: Vec<(Rgb, bool)>,
    /// The layers of light that may shine during the leg.
    pub layers: FrameLight,
    /// The first stretch of the leg.
    pub first: PlannedStretch,
    /// The time base of the drive. `None` before the drive begins, and after it was interrupted.
    pub clock: Option<PathClock>,
    /// Time since the drive began, without holds, when it was last noted.
    pub seen: Span,
}

impl LegLight {
    /// When show time ends in this leg, as time since the drive began, without holds. `None` if show time goes on until
    /// GO.
    pub fn end(&self) -> Option<Span> {
        (!self.times.waits_for_go).then_some(self.times.drive + self.times.air)
    }

    /// Time since the drive began, without holds. `None` before the drive begins, and after it was interrupted.
    pub fn elapsed(&self, now: Instant) -> Option<Span> {
        self.clock.map(|clock| clock.path_time(now)).filter(|elapsed| *elapsed >= Span::ZERO)
    }

    /// The [`LightMoment`], from which layers compute colours, at `elapsed` after the drive began. `elapsed` does not
    /// contain holds; `lost` is how long the drive was held.
    pub fn moment(&self, elapsed: Span, lost: Span) -> LightMoment {
        let shown = self.end().map_or(elapsed, |end| elapsed.min(end));
        let lead_s = self.times.lead_s + (lost + (elapsed - shown)).as_secs();
        let began = self.clock.map_or(Instant::ZERO, |clock| clock.began);
        let clock_s = (began - Instant::ZERO + elapsed + lost).as_secs();
        LightMoment { elapsed, show_s: self.times.show_s + shown.as_secs(), lead_s, clock_s }
    }

    /// The [`LightMoment`] at a moment of the show clock, with the holds that are known now.
    pub fn moment_at(&self, at: Instant) -> LightMoment {
        self.moment(self.elapsed(at).unwrap_or(Span::ZERO), self.lost(at))
    }

    /// How much holds have delayed the drive until `now`.
    pub fn lost(&self, now: Instant) -> Span {
        self.clock.map_or(Span::ZERO, |clock| (now - clock.began - clock.path_time(now)).max(Span::ZERO))
    }

    /// How long show time has stood still in the run by the end of the leg, seconds. Only holds that are over count.
    pub fn lead_s_after(&self) -> f64 {
        self.times.lead_s + self.clock.map_or(0.0, |clock| clock.lost.as_secs())
    }

    /// What determines the light of a participant in this leg. `next` is the leg after this one. `None` if the
    /// participant is not in the leg.
    pub fn driven<'a>(
        &self,
        leg: &'a Leg,
        next: Option<&Leg>,
        participant: usize,
    ) -> Option<DrivenLight<'a>> {
        let step = leg.robots.get(participant)?;
        let (before, shone) = self.before.get(participant).copied().unwrap_or((Rgb::BLACK, false));
        let after = next.filter(|next| next.frame != leg.frame).and_then(|next| next.robots.get(participant));
        Some(DrivenLight {
            number: (self.numbers.get(participant).copied()?, leg.robots.len() as u32),
            frame: leg.frame as u32,
            pixel: step.pixel,
            colours: [before, step.color, after.map_or(step.color, |after| after.color)],
            shines: [shone, step.pixel.is_some()],
            path: leg.path(participant).map(|path| path.as_ref()),
            goal: step.goal,
            drive: self.times.drive,
        })
    }

    /// The message to a participant with its colours for a stretch.
    pub fn command(
        &self,
        config: &Config,
        show: &ShowLight,
        robot: &DrivenLight<'_>,
        stretch: &PlannedStretch,
        now: Instant,
    ) -> Command {
        let lost = self.lost(now);
        let mut samples =
            robot.samples(&self.layers, show.pictures(), stretch.ticks, |time| match stretch.free_at {
                Some(at) => self.moment_at(at + time),
                None => self.moment(stretch.from + time, lost),
            });
        // Robots interpolate linearly between the colours that they receive. Colours are therefore corrected for the
        // lamp before records are fitted to them.
        if !config.lamp.changes_nothing() {
            samples.iter_mut().for_each(|colour| *colour = config.lamp.sent(*colour));
        }
        let fitted = fit(&samples, config.light_tolerance, MAX_LIGHT_RECORDS);
        let (anchor, skip) = self.anchor(stretch, now);
        Command::Light(LightStretch {
            number: stretch.number,
            anchor,
            skip,
            over: stretch.over,
            start: fitted.start,
            // They fit, because `fit` makes no more than `MAX_LIGHT_RECORDS`.
            records: LightRecords::from_slice(&fitted.records).unwrap_or_default(),
        })
    }

    /// The moment from which robots count the time of a stretch, and the time from that moment to the beginning of the
    /// stretch. Before the drive begins, the moment is the START of the leg's routes. During the drive it is the
    /// beginning of the drive, and robots add the holds. Once robots stand it is a fixed moment, because a frame may
    /// wait for GO for any time. A stretch that goes on during holds counts from its own beginning.
    fn anchor(&self, stretch: &PlannedStretch, now: Instant) -> (LightAnchor, Span) {
        let Some(clock) = self.clock else { return (LightAnchor::Start(self.seq), stretch.from) };
        if let Some(at) = stretch.free_at {
            return (LightAnchor::Free(at), Span::ZERO);
        }
        let stands = clock.hold.is_none() && clock.path_time(now) >= self.times.drive;
        if stands && stretch.from >= self.times.drive {
            return (LightAnchor::Moment(clock.began + clock.lost + stretch.from), Span::ZERO);
        }
        (LightAnchor::Moment(clock.began), stretch.from)
    }

    /// The stretch that begins at `from`, time since the drive began without holds, and takes `longest` at most. `None`
    /// if show time of the leg is over by then, unless layers run freely: these go on.
    pub fn stretch(&self, number: u32, from: Span, longest: Span, over: Span) -> Option<PlannedStretch> {
        let left = self.end().map_or(longest, |end| (end - from).min(longest));
        // Layers that run freely go on after show time is over.
        let left = if self.layers.is_free() { longest } else { left };
        let ticks = u32::try_from((left.0 + TICK.0 - 1) / TICK.0).ok().filter(|ticks| *ticks > 0)?;
        Some(PlannedStretch { number, from, ticks, over, free_at: None })
    }
}
