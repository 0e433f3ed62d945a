//! Music does not wait for late robots. A late frame gets a shorter air time; if that is not enough, the next frame
//! is left out. docs/music.md states the rule.

use crate::context::Context;
use crate::event::EventKind;
use crate::run::{MusicTime, Run, RunPhase, RunPurpose};
use crate::snapshot::ShowPosition;
use lightbots_base::{Instant, Span};

/// Least air time (stay of robots in a frame) of a late frame, unless the show gives it less.
const STANDS: Span = Span::from_millis(500);
/// If the show is behind the music by more than this when robots reach a frame, the next frame is left out if allowed;
/// seconds. Up to this delay, shorter air times alone catch up.
const LATE_MAX_S: f64 = 2.0;

impl Run {
    /// Where the music is on the timeline of the show. Without music it is the position of the show. `None` if no show
    /// is played or its first drive has not begun.
    pub fn music_position(&self, now: Instant) -> Option<ShowPosition> {
        let show = self.show_position(now)?;
        let MusicTime { seen, runs, .. } = self.playback.music;
        let Some((at, music_s)) = seen else { return Some(show) };
        let since_s = if runs { (now - at).as_secs() } else { 0.0 };
        Some(ShowPosition { show_s: music_s + since_s, runs })
    }

    /// Notes where the music is at `now`. Once the first frame was reached, the music goes on with the show clock,
    /// whether robots drive or are held. The music stands while the run is paused or interrupted, and in a frame that
    /// waits for GO once the air time is over. It jumps to a frame that the operator chose or that repeats.
    pub fn follow_music(&mut self, now: Instant) {
        let show = self.show_position(now).filter(|_| self.playback.show.music.is_some());
        let (Some(show), Some(music)) = (show, self.music_position(now)) else {
            self.playback.music.seen = None;
            return;
        };
        let before = self.playback.music;
        let light = self.pipeline.light.current();
        let (leg, leads) = light.map_or((before.leg, false), |light| (light.seq, light.times.leads_music));
        // The music jumps to a frame that the operator chose or that comes once more. It does not jump for a frame
        // that is late or left out.
        let is_led_there = leads && leg != before.leg;
        let is_before = self.tally.frames_played == 0;
        let music_s = if is_before || is_led_there { show.show_s } else { music.show_s };
        let is_away = matches!(self.phase, RunPhase::Interrupted(_) | RunPhase::Over(..));
        let stands = self.playback.paused || is_away;
        let runs = if self.playback.waits_for_go || is_before { show.runs } else { !stands };
        let is_led = before.is_led && !is_led_there;
        self.playback.music =
            MusicTime { seen: Some((now, music_s)), leg, runs, is_led, stood: before.stood };
        if runs && !is_before {
            self.pipeline.light.keep_to_music(now, music_s);
        }
    }

    /// If robots have just reached a frame, adapts its air time to the music: shorter if the show is late, longer if it
    /// is early. If the show is late by more than `LATE_MAX_S`, also leaves out the next frame, if that is allowed.
    pub fn keep_up_with_music(&mut self, io: &mut Context, now: Instant) {
        if std::mem::replace(&mut self.playback.music.stood, self.tally.frames_played)
            == self.tally.frames_played
        {
            return;
        }
        if self.playback.purpose != RunPurpose::Play || !self.is_frame_reached() || self.playback.waits() {
            return;
        }
        self.follow_music(now);
        let late_s = match (self.music_position(now), self.show_position(now)) {
            (Some(music), Some(show)) => music.show_s - show.show_s,
            _ => return,
        };
        let RunPhase::Standing(standing) = &mut self.phase else { return };
        let stands = standing.air.until - now;
        let shorter = Span::from_secs(late_s).min((stands - STANDS).max(Span::ZERO));
        // A frame that is early because one was left out stays until the music has reached it: `shorter` is negative.
        standing.air.until = standing.air.until - shorter;
        if late_s > LATE_MAX_S && self.may_leave_out_next() {
            let frame = self.playback.next.frame;
            let late = Span::from_secs(late_s);
            io.log.record(now, EventKind::LeftOutForMusic { frame, late });
            self.leave_out(io, now);
        }
    }

    /// Whether the next frame may be left out for the music. It must stay if it is the last one, is in a loop or has a
    /// cue. It must also stay if it became the next one by a jump (a choice, a skip or a left-out frame).
    fn may_leave_out_next(&self) -> bool {
        let playback = &self.playback;
        let frame = playback.next.frame;
        let is_last = frame.saturating_add(1) >= playback.show.frames.len();
        !is_last
            && playback.jump.is_none()
            && playback.cue(frame).is_none()
            && playback.loop_at(frame).is_none()
    }
}
