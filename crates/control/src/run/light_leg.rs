//! Light from the beginning of a drive until its frame is left: when each of its moments is, and colours at them.

use crate::config::Config;
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::run::path_clock::PathClock;
use lightbots_base::{Instant, Rgb, Span, TICK};
use lightbots_lighting::{DrivenLight, FrameLight, LightMoment, ShowLight, fit};
use lightbots_wire::{Command, LightAnchor, LightRecords, LightStretch, MAX_LIGHT_RECORDS};
use std::sync::Arc;

/// A stretch of light that is sent to all robots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlannedStretch {
    /// Number of the messages.
    pub number: u32,
    /// Time since the drive began, without holds, at its beginning.
    pub from: Span,
    /// Its duration in ticks.
    pub ticks: u32,
    /// How long robots take from what they show to its colours.
    pub over: Span,
    /// The moment at which it begins, if it runs through holds. `None`: it stands still in them.
    pub free_at: Option<Instant>,
}

/// When a leg happens on the timeline, and how show time goes on after it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LegTimes {
    /// Show time at the beginning of the drive, seconds.
    pub show_s: f64,
    /// When the frame is to stand by the timeline, seconds. Show time then is later by what robots are behind.
    pub due_s: f64,
    /// The music goes there with it: the operator chose the frame, or frames repeat.
    pub leads_music: bool,
    /// Duration of the drive by plan.
    pub drive: Span,
    /// How long the frame stands by the show.
    pub air: Span,
    /// The frame has a cue: show time goes on until GO.
    pub waits_for_go: bool,
    /// How long show time had stood at the beginning of the drive, seconds.
    pub lead_s: f64,
}

/// Light of a leg.
#[derive(Clone, Debug)]
pub(crate) struct LegLight {
    /// Number of the leg's routes.
    pub seq: u32,
    /// The frame it leads to, in its run.
    pub frame: FrameCursor,
    /// Whether the frame is reached at its end.
    pub reaches_frame: bool,
    /// When it happens.
    pub times: LegTimes,
    /// `[participant]`: its number in effects.
    pub numbers: Arc<[u32]>,
    /// `[participant]`: colour before, and whether layers shone on the robot then.
    pub before: Vec<(Rgb, bool)>,
    /// The same at its end.
    pub after: Vec<(Rgb, bool)>,
    /// The layers that may shine.
    pub layers: FrameLight,
    /// The first stretch.
    pub first: PlannedStretch,
    /// The time base, once the drive has begun.
    pub clock: Option<PathClock>,
    /// Time since the drive began, when that was looked at last.
    pub seen: Span,
}

impl LegLight {
    /// The end of show time in this leg, as time since the drive began; `None`: show time goes on.
    pub fn end(&self) -> Option<Span> {
        (!self.times.waits_for_go).then_some(self.times.drive + self.times.air)
    }

    /// Time since the drive began, without holds; `None`: it has not begun.
    pub fn elapsed(&self, now: Instant) -> Option<Span> {
        self.clock.map(|clock| clock.path_time(now)).filter(|elapsed| *elapsed >= Span::ZERO)
    }

    /// What robots show at a time since the drive began. `lost`: how long it was held.
    pub fn moment(&self, elapsed: Span, lost: Span) -> LightMoment {
        let shown = self.end().map_or(elapsed, |end| elapsed.min(end));
        let lead_s = self.times.lead_s + (lost + (elapsed - shown)).as_secs();
        let began = self.clock.map_or(Instant::ZERO, |clock| clock.began);
        let clock_s = (began - Instant::ZERO + elapsed + lost).as_secs();
        LightMoment { elapsed, show_s: self.times.show_s + shown.as_secs(), lead_s, clock_s }
    }

    /// What robots show at a moment of the show clock, by the holds that are stated.
    pub fn moment_at(&self, at: Instant) -> LightMoment {
        self.moment(self.elapsed(at).unwrap_or(Span::ZERO), self.lost(at))
    }

    /// How long holds have taken until now.
    pub fn lost(&self, now: Instant) -> Span {
        self.clock.map_or(Span::ZERO, |clock| (now - clock.began - clock.path_time(now)).max(Span::ZERO))
    }

    /// How long show time has stood until the end of the leg, by the holds that were released, seconds.
    pub fn lead_s_after(&self) -> f64 {
        self.times.lead_s + self.clock.map_or(0.0, |clock| clock.lost.as_secs())
    }

    /// The light of a participant. `next`: the leg to the frame after.
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

    /// A stretch as a participant's message.
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
        // Robots draw lines between the colours that they get: these are corrected first and fitted then.
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
            // Fits: the fit has no more records.
            records: LightRecords::from_slice(&fitted.records).unwrap_or_default(),
        })
    }

    /// From when a stretch counts. Until robots stand, that is the START, because holds may still come; then it is a moment,
    /// so that a frame may wait for GO as long as it likes.
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

    /// The stretch that begins at a time since the drive began; `None`: show time is over then.
    pub fn stretch(&self, number: u32, from: Span, longest: Span, over: Span) -> Option<PlannedStretch> {
        let left = self.end().map_or(longest, |end| (end - from).min(longest));
        // Layers that run freely go on when show time is over.
        let left = if self.layers.is_free() { longest } else { left };
        let ticks = u32::try_from((left.0 + TICK.0 - 1) / TICK.0).ok().filter(|ticks| *ticks > 0)?;
        Some(PlannedStretch { number, from, ticks, over, free_at: None })
    }
}
