//! Music does not wait for late robots: a picture that is late stands for a shorter time, and where that is not enough, the
//! next one is left out. docs/music.md states the rule.

use crate::context::Context;
use crate::event::EventKind;
use crate::run::{MusicTime, Run, RunPhase, RunPurpose};
use crate::snapshot::ShowPosition;
use lightbots_base::{Instant, Span};

/// A late picture stands at least as long, or as long as the show says if that is less.
const STANDS: Span = Span::from_millis(500);
/// Pictures that are later than this do not catch up by shorter air times alone, seconds.
const LATE_MAX_S: f64 = 2.0;
/// Show time that moves by more at once was moved on purpose, seconds: by a loop, or by a frame that is left out.
const JUMP_S: f64 = 0.2;

impl Run {
    /// Where the music of the show is on the timeline; for a show without music, where the show is.
    pub fn music_position(&self, now: Instant) -> Option<ShowPosition> {
        let show = self.show_position(now)?;
        let MusicTime { seen, runs, .. } = self.playback.music;
        let Some((at, music_s, _)) = seen else { return Some(show) };
        let since_s = if runs { (now - at).as_secs() } else { 0.0 };
        Some(ShowPosition { show_s: music_s + since_s, runs })
    }

    /// Moves the music on. It runs with the show clock from the first picture on, whether robots drive or are held.
    pub fn follow_music(&mut self, now: Instant) {
        let show = self.show_position(now).filter(|_| self.playback.show.music.is_some());
        let (Some(show), Some(music)) = (show, self.music_position(now)) else {
            self.playback.music.seen = None;
            return;
        };
        let before = self.playback.music;
        let moved_s = before.seen.map_or(0.0, |(at, _, show_s)| {
            let most_s = (now - at).as_secs();
            // Show time moves no faster than the show clock, unless it jumps.
            (show.show_s - show_s - most_s).max(0.0) + (show.show_s - show_s).min(0.0)
        });
        let jumps = moved_s.abs() > JUMP_S;
        // Back: a loop begins again. Forward: a frame was left out, or a late picture was cut short.
        let is_before = self.tally.frames_played == 0;
        let goes_along = is_before || moved_s < -JUMP_S || (before.is_led && jumps);
        let is_led = before.is_led && !jumps;
        let music_s = if goes_along { show.show_s } else { music.show_s };
        let is_away = matches!(self.phase, RunPhase::Interrupted(_) | RunPhase::Over(..));
        let stands = self.playback.paused || is_away;
        let runs = if self.playback.waits_for_go || is_before { show.runs } else { !stands };
        let seen = Some((now, music_s, show.show_s));
        self.playback.music = MusicTime { seen, runs, is_led, stood: before.stood };
        if runs && !is_before {
            self.pipeline.light.keep_to_music(now, music_s);
        }
    }

    /// A picture that stands since the last time catches up with the music.
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
        // A picture that is early after a frame was left out stands until the music is there.
        standing.air.until = standing.air.until - shorter;
        if late_s > LATE_MAX_S && self.may_leave_out_next() {
            let frame = self.playback.next.frame;
            let late = Span::from_secs(late_s);
            io.log.record(now, EventKind::LeftOutForMusic { frame, late });
            self.leave_out(io, now);
        }
    }

    /// Whether the next frame is neither the last nor one that the operator waits for.
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
