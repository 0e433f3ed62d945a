//! The operator's choice of the next frame. The drive to it is planned from where robots stand, as after a dropout.

use crate::context::Context;
use crate::event::EventKind;
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::run::machine::Run;
use crate::run::phase::RunPhase;
use lightbots_base::Instant;

impl Run {
    /// Whether the operator may choose the next frame: robots stand, are being stopped, or are held on their drive.
    /// Also if the run is paused before or on a drive. `false` while the run is interrupted, and once it is over.
    pub fn may_jump(&self) -> bool {
        match &self.phase {
            RunPhase::Standing(_) | RunPhase::Gathering(_) => true,
            RunPhase::Starting(_) => self.playback.paused,
            RunPhase::Driving(drive) => self.playback.paused || drive.clock.is_held(),
            RunPhase::Interrupted(_) | RunPhase::Over(..) => false,
        }
    }

    /// Sends robots to a frame that the operator chose. They leave for it as soon as they can.
    pub fn go_to(&mut self, io: &mut Context, now: Instant, frame: usize) {
        let present = self.pipeline.leg().map_or(self.playback.next, Leg::cursor);
        // A jump within a loop stays in its present pass.
        let repeats = self.playback.loop_at(frame).filter(|repeats| repeats.has(present.frame));
        let pass = repeats.map_or(0, |_| present.pass);
        self.playback.choose(Some(FrameCursor { frame, pass, ..present }), true);
        match &mut self.phase {
            RunPhase::Standing(standing) => standing.leave_now(now),
            RunPhase::Gathering(gathering) => gathering.leave_now(),
            _ => {}
        }
        io.log.record(now, EventKind::GoesTo { frame });
        self.playback.music.lead();
        self.plan_chosen(io, now);
    }

    /// Leaves out the next frame, because the operator skips it.
    pub fn skip(&mut self, io: &mut Context, now: Instant) {
        io.log.record(now, EventKind::Skipped { frame: self.playback.next.frame });
        self.playback.music.lead();
        self.leave_out(io, now);
    }

    /// Leaves out the next frame and plans the drive to the one after it.
    pub fn leave_out(&mut self, io: &mut Context, now: Instant) {
        self.playback.choose(self.playback.after(self.playback.next), false);
        self.plan_chosen(io, now);
    }

    fn plan_chosen(&mut self, io: &mut Context, now: Instant) {
        self.pipeline.planning.failure = None;
        // Robots no longer drive to the frame that recovery made late.
        self.tally.recovery.reached(now);
        self.drop_plans(io);
        if !matches!(self.phase, RunPhase::Gathering(_)) {
            self.gather_what_moves(io, now);
        }
    }

    /// Index of the frame that is reached after the one that robots drive to or stand in. `None` if there is none.
    pub fn next_frame(&self) -> Option<usize> {
        let next = self.playback.next;
        let next = if self.is_frame_reached() { Some(next) } else { self.playback.after(next) };
        next.map(|next| next.frame).filter(|&frame| frame < self.playback.show.frames.len())
    }
}
