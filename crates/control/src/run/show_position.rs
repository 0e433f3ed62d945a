//! Where a run is on the timeline of its show. Music begins at this position, and later keeps its own (`keeping_up`).

use crate::run::{Run, RunPhase, RunPurpose};
use crate::snapshot::ShowPosition;
use lightbots_base::{Instant, Span};

impl Run {
    /// Where the run is on the timeline of its show. `None` if no show is played or its first drive has not begun.
    pub fn show_position(&self, now: Instant) -> Option<ShowPosition> {
        let light = self.pipeline.light.current().filter(|_| self.playback.purpose == RunPurpose::Play)?;
        let end = light.times.drive + light.times.air;
        let until_end = |left: Span| (end - left).clamp(light.times.drive, end.max(light.times.drive));
        let (elapsed, runs) = match &self.phase {
            RunPhase::Driving(drive) => {
                let elapsed = drive.clock.path_time(now);
                (
                    elapsed.clamp(Span::ZERO, light.times.drive),
                    drive.clock.hold.is_none() && elapsed < light.times.drive,
                )
            }
            RunPhase::Standing(standing) => match standing.air.left {
                Some(left) => (until_end(left), false),
                None => {
                    let left = (standing.air.until - now).max(Span::ZERO);
                    let is_reached = light.reaches_frame && !self.playback.paused;
                    (until_end(left), is_reached && left > Span::ZERO)
                }
            },
            // The drive before was interrupted, and a new one is about to begin.
            RunPhase::Starting(_) if light.clock.is_none() => (light.seen, false),
            RunPhase::Starting(starting) => {
                let left = (starting.at - now).max(Span::ZERO);
                (until_end(left), left > Span::ZERO && left < light.times.air)
            }
            RunPhase::Interrupted(_) | RunPhase::Gathering(_) | RunPhase::Over(..) => {
                (light.seen.min(end.max(light.times.drive)), false)
            }
        };
        Some(ShowPosition { show_s: light.times.due_s + (elapsed - light.times.drive).as_secs(), runs })
    }
}
