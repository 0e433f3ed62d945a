//! Loops: frames that repeat until GO. Which frames repeat, in which pass they are, and how the run leaves them.

use crate::context::Context;
use crate::event::EventKind;
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::run::machine::Run;
use crate::run::run_context::RunContext;
use crate::snapshot::RepeatView;
use lightbots_base::Instant;
use lightbots_show::FrameLoop;

impl Run {
    /// The frame that robots stand in or drive to.
    fn present(&self) -> FrameCursor {
        match self.pipeline.leg() {
            Some(leg) if self.is_frame_reached() => leg.cursor(),
            _ => self.playback.next,
        }
    }

    /// The loop whose frames are played, and the last frame of its present pass. A loop begins once robots have reached
    /// its first frame. A second GO at the cue before the loop therefore does not end the loop. `None` if no loop has
    /// begun.
    fn present_loop(&self) -> Option<(FrameLoop, FrameCursor)> {
        let present = self.present();
        let repeats = self.playback.loop_at(present.frame)?;
        let is_begun = present.pass > 0 || present.frame > repeats.first || self.is_frame_reached();
        is_begun.then_some((repeats, FrameCursor { frame: repeats.last, ..present }))
    }

    /// The loop under way, for screens.
    pub fn repeats(&self) -> Option<RepeatView> {
        let (FrameLoop { first, last }, end) = self.present_loop()?;
        let leaves = self.playback.leaves_loop == Some(end);
        Some(RepeatView { first, last, round: end.pass.saturating_add(1), leaves })
    }

    /// Handles the operator's GO while frames repeat: the show goes on after the last frame of the present pass. Drops
    /// plans beyond that frame. Returns `false` if no frames repeat or GO was given in this pass already.
    pub fn leave_loop(&mut self, io: &mut Context, now: Instant) -> bool {
        let Some((repeats, end)) = self.present_loop() else { return false };
        if self.playback.leaves_loop == Some(end) {
            return false;
        }
        self.playback.leaves_loop = Some(end);
        io.log.record(now, EventKind::LeavesLoop { last: end.frame });
        plan_on(&mut self.split(io, now).1, repeats, end);
        true
    }
}

/// After the last frame of a pass, plans the frame behind the loop instead of the drive back to the loop's first frame.
fn plan_on(cx: &mut RunContext, repeats: FrameLoop, end: FrameCursor) {
    let is_in_pass = |at: FrameCursor| at.is_in_pass_of(end) && repeats.has(at.frame);
    let after = cx.playback.after(end);
    if !is_in_pass(cx.playback.next) {
        cx.playback.next = after.unwrap_or(FrameCursor { frame: usize::MAX, ..end });
        cx.playback.jump = None;
    }
    let (now, pipeline) = (cx.now, &mut *cx.pipeline);
    let queued = pipeline.queue.len();
    pipeline.queue.retain(|leg| is_in_pass(leg.cursor()));
    let planning = &mut pipeline.planning;
    if pipeline.queue.len() < queued {
        let tail = pipeline.queue.back().or(pipeline.driven.as_ref().map(|driven| &driven.leg));
        planning.from =
            tail.map_or(Vec::new(), |leg: &Leg| leg.robots.iter().map(|step| step.goal).collect());
        // Changes of light that were to be sent along with a dropped route are sent by themselves.
        pipeline.lights.send_again(now);
    }
    // A pending plan request covers frames of one pass only.
    if planning.pending.is_some() && !is_in_pass(planning.last) {
        planning.pending = None;
        (planning.last, planning.next) = (end, after);
    } else if planning.next.is_some_and(|next| !is_in_pass(next))
        || planning.next.is_none() && !is_in_pass(planning.last)
    {
        (planning.next, planning.failure) = (after, None);
        if planning.pending.is_none() {
            planning.last = end;
        }
    }
}
