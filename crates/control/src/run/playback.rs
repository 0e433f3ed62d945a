//! What is played: the show, the frame that is reached next, and whether the operator paused.
//!
//! GO is the operator's command that ends the wait at a cue, or lets the show leave a loop of frames.

use crate::frame_cursor::FrameCursor;
use crate::operation::MissingPolicy;
use crate::run::MusicTime;
use lightbots_base::Span;
use lightbots_show::{CuePlace, FrameLoop, Show, frame_loops};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Longest air time of a frame, seconds: a day. A much larger value in a show could overflow the show clock.
const AIR_TIME_MAX_S: f64 = 86_400.0;

/// What a run is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum RunPurpose {
    /// All frames of the open show, from a chosen one on.
    Play,
    /// One frame of the open show, without air time.
    Preview,
    /// The starting places, played as a show of one frame.
    Home,
    /// All frames of a preflight.
    Preflight,
}

impl RunPurpose {
    /// Whether robots drive to frames of the open show.
    pub fn is_of_show(self) -> bool {
        matches!(self, Self::Play | Self::Preview)
    }
}

/// A jump: the operator chose or skipped the next frame, or it was left out for the music. Holds what to restore if no
/// path leads to the chosen frame. Kept until robots begin to drive there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Jump {
    /// The frame that would have been next.
    pub instead_of: FrameCursor,
    /// Whether the run was waiting for GO.
    pub waited_for_go: bool,
    /// The value of [`PlayedShow::leaves_loop`] before the jump.
    pub left_loop: Option<FrameCursor>,
    /// Whether robots leave for the chosen frame as soon as they can. If `false`, air time, a pause and a wait for GO
    /// go on as before the choice.
    pub leaves: bool,
}

/// What a run plays, and how far it has come.
#[derive(Clone, Debug)]
pub(crate) struct PlayedShow {
    /// The show; it does not change during a run.
    pub show: Arc<Show>,
    /// What the run is for.
    pub purpose: RunPurpose,
    /// What happens to pixels without a robot.
    pub missing: MissingPolicy,
    /// Whether the show starts again after its last frame.
    pub looping: bool,
    /// The frame that is reached next.
    pub next: FrameCursor,
    /// Whether the operator paused the run.
    pub paused: bool,
    /// Whether the run pauses when robots reach the next frame, because the operator steps from frame to frame.
    pub stepping: bool,
    /// Whether robots stay in the frame that they reached last until the operator gives GO, because that frame has a
    /// cue.
    pub waits_for_go: bool,
    /// The jump that determined the next frame, until robots begin to drive there. `None` if there was none.
    pub jump: Option<Jump>,
    /// The loops of the show: ranges of frames that repeat until GO. Empty unless the purpose is [`RunPurpose::Play`].
    pub loops: Vec<FrameLoop>,
    /// The last frame of the present pass of a loop, if GO was given in that pass. After this frame the show goes on
    /// behind the loop. `None` without such a GO.
    pub leaves_loop: Option<FrameCursor>,
    /// Where the music is on the timeline.
    pub music: MusicTime,
}

impl PlayedShow {
    /// A show that is about to be played, from the frame at `next` on.
    pub fn new(show: Arc<Show>, purpose: RunPurpose, missing: MissingPolicy, next: FrameCursor) -> Self {
        Self {
            loops: if purpose == RunPurpose::Play { frame_loops(&show) } else { Vec::new() },
            show,
            purpose,
            missing,
            looping: false,
            next,
            paused: false,
            stepping: false,
            waits_for_go: false,
            jump: None,
            leaves_loop: None,
            music: MusicTime::default(),
        }
    }

    /// The frame that follows `cursor` in this run, with loops and rounds of the show. `None` if the run ends with
    /// `cursor`.
    pub fn after(&self, cursor: FrameCursor) -> Option<FrameCursor> {
        let FrameCursor { frame, round, pass } = cursor;
        let repeats = self.loop_at(frame);
        let is_last = repeats.is_some_and(|repeats| repeats.last == frame);
        match (self.purpose, repeats) {
            (RunPurpose::Preview | RunPurpose::Home, _) => None,
            (RunPurpose::Preflight, _) => (frame.saturating_add(1) < self.show.frames.len())
                .then(|| FrameCursor { frame: frame + 1, round, pass }),
            (RunPurpose::Play, Some(repeats)) if is_last && self.leaves_loop != Some(cursor) => {
                Some(FrameCursor { frame: repeats.first, round, pass: pass.saturating_add(1) })
            }
            (RunPurpose::Play, _) if frame.saturating_add(1) < self.show.frames.len() => {
                Some(FrameCursor { frame: frame + 1, round, pass: if is_last { 0 } else { pass } })
            }
            (RunPurpose::Play, _) => {
                self.looping.then(|| FrameCursor { frame: 0, round: round + 1, pass: 0 })
            }
        }
    }

    /// The loop that a frame is in; `None` if it is in none.
    pub fn loop_at(&self, frame: usize) -> Option<FrameLoop> {
        self.loops.iter().copied().find(|repeats| repeats.has(frame))
    }

    /// Makes the frame after `next` the next one, because robots have reached `next`. After the last frame, the index
    /// of `next` is `usize::MAX`.
    pub fn advance(&mut self) {
        match self.after(self.next) {
            Some(next) => self.next = next,
            None => self.next.frame = usize::MAX,
        }
    }

    /// Makes `next` the frame that is reached next, because the operator chose it or a frame is left out. `None`: no
    /// further frame is reached. With `leaves`, robots leave for it at once. A pause, a wait for GO, and a GO that was
    /// given for a loop are then cancelled.
    pub fn choose(&mut self, next: Option<FrameCursor>, leaves: bool) {
        let begun = Jump {
            instead_of: self.next,
            waited_for_go: self.waits_for_go,
            left_loop: self.leaves_loop,
            leaves: false,
        };
        let jump = self.jump.get_or_insert(begun);
        jump.leaves |= leaves;
        self.next = next.unwrap_or(FrameCursor { frame: usize::MAX, ..self.next });
        if leaves {
            (self.paused, self.stepping, self.waits_for_go) = (false, false, false);
            self.leaves_loop = None;
        }
    }

    /// Undoes a jump, because no path leads to the chosen frame: `next` is again what it was before the jump. If robots
    /// were to leave at once, the run now waits for GO if it did before the jump, and is paused otherwise.
    pub fn give_up(&mut self, jump: Jump) {
        self.jump = None;
        (self.next, self.leaves_loop) = (jump.instead_of, jump.left_loop);
        if jump.leaves {
            self.waits_for_go = jump.waited_for_go;
            self.paused = !jump.waited_for_go;
        }
    }

    /// Whether robots are to leave at once for the frame that the operator chose.
    pub fn leaves(&self) -> bool {
        self.jump.is_some_and(|jump| jump.leaves)
    }

    /// Whether the run waits for the operator: it is paused or waits for GO.
    pub fn waits(&self) -> bool {
        self.paused || self.waits_for_go
    }

    /// Whether all frames were reached.
    pub fn is_ended(&self) -> bool {
        self.next.frame >= self.show.frames.len()
    }

    /// The next frame, or the last frame of the show if all were reached; counted from 0.
    pub fn shown_frame(&self) -> usize {
        self.next.frame.min(self.show.frames.len().saturating_sub(1))
    }

    /// The name of the cue for which robots wait for GO in a frame; the name may be empty. `None` if they do not wait
    /// there: the frame has no cue or ends a loop, or the purpose is not [`RunPurpose::Play`].
    pub fn cue(&self, frame: usize) -> Option<&str> {
        if self.loops.iter().any(|repeats| repeats.last == frame) {
            return None;
        }
        let id = self.show.frames.get(frame).filter(|_| self.purpose == RunPurpose::Play)?.id.as_deref()?;
        let mut cues = self.show.cues.iter();
        cues.find(|cue| matches!(&cue.at, CuePlace::Frame(at) if at == id)).map(|cue| cue.name.as_str())
    }

    /// The air time (stay of robots in a frame) that the show gives a frame, at most a day. Zero if the index is beyond
    /// the last frame, or the value is not finite.
    pub fn air_time(&self, frame: usize) -> Span {
        let air_s = self.show.frames.get(frame).map_or(0.0, |frame| frame.air_time_s);
        Span::from_secs(if air_s.is_finite() { air_s.clamp(0.0, AIR_TIME_MAX_S) } else { 0.0 })
    }

    /// The air time of a frame in this run: zero in a preview and on the way home, and as in the show otherwise.
    pub fn standing_time(&self, frame: usize) -> Span {
        let stands = matches!(self.purpose, RunPurpose::Play | RunPurpose::Preflight);
        if stands { self.air_time(frame) } else { Span::ZERO }
    }

    /// Distance between the centres of two robots whose rims touch, metres.
    pub fn contact_m(&self) -> f64 {
        self.show.stage.limits.contact_m()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::{Cue, Frame, Stage};

    fn playback(purpose: RunPurpose, looping: bool) -> PlayedShow {
        let frame = |air_time_s| Frame {
            name: String::new(),
            air_time_s,
            transition_s: None,
            easing: Default::default(),
            pixels: Vec::new(),
            ..Frame::default()
        };
        let show =
            Show { stage: Stage::default(), frames: vec![frame(1.0), frame(f64::NAN)], ..Show::default() };
        let next = FrameCursor { frame: 1, ..FrameCursor::default() };
        PlayedShow { looping, ..PlayedShow::new(Arc::new(show), purpose, MissingPolicy::Refuse, next) }
    }

    #[test]
    fn a_show_that_loops_starts_again_in_the_next_round() {
        let mut once = playback(RunPurpose::Play, false);
        once.advance();
        assert!(once.is_ended());
        let mut looping = playback(RunPurpose::Play, true);
        looping.advance();
        assert_eq!(looping.next, FrameCursor { frame: 0, round: 1, pass: 0 });
    }

    #[test]
    fn a_preview_has_one_frame_and_no_air_time() {
        let preview = playback(RunPurpose::Preview, true);
        assert_eq!(preview.after(preview.next), None);
        assert_eq!(preview.standing_time(0), Span::ZERO);
        let play = playback(RunPurpose::Play, false);
        assert_eq!((play.standing_time(0), play.standing_time(1)), (Span::from_secs(1.0), Span::ZERO));
    }

    #[test]
    fn a_jump_that_is_given_up_leaves_the_show_as_it_was() {
        let mut playback = playback(RunPurpose::Play, false);
        let before = playback.next;
        playback.waits_for_go = true;
        playback.choose(None, false);
        assert!(playback.is_ended() && playback.waits_for_go && !playback.leaves());
        playback.choose(Some(FrameCursor::default()), true);
        assert!(!playback.waits() && playback.leaves());
        playback.give_up(playback.jump.unwrap());
        assert_eq!((playback.next, playback.waits_for_go, playback.paused), (before, true, false));
        playback.waits_for_go = false;
        playback.choose(Some(FrameCursor::default()), true);
        playback.give_up(playback.jump.unwrap());
        assert_eq!((playback.next, playback.waits_for_go, playback.paused), (before, false, true));
    }

    /// Four frames, of which the second and third repeat.
    fn repeating() -> PlayedShow {
        let frame = |number: usize| Frame { id: Some(format!("f{number}")), ..Frame::default() };
        let at = CuePlace::Frame("f2".into());
        let cue = Cue { name: "Encore".into(), at, loop_from: Some("f1".into()) };
        let show = Show { frames: (0..4).map(frame).collect(), cues: vec![cue], ..Show::default() };
        PlayedShow::new(Arc::new(show), RunPurpose::Play, MissingPolicy::Refuse, FrameCursor::default())
    }

    #[test]
    fn frames_repeat_until_go_and_again_in_the_next_round() {
        let mut playback = repeating();
        let at = |frame, round, pass| FrameCursor { frame, round, pass };
        assert_eq!(playback.after(at(2, 0, 0)), Some(at(1, 0, 1)));
        assert_eq!(playback.after(at(1, 0, 1)), Some(at(2, 0, 1)));
        playback.leaves_loop = Some(at(2, 0, 1));
        assert_eq!(playback.after(at(2, 0, 1)), Some(at(3, 0, 0)));
        playback.looping = true;
        assert_eq!(playback.after(at(3, 0, 0)), Some(at(0, 1, 0)));
        assert_eq!(playback.after(at(2, 1, 0)), Some(at(1, 1, 1)));
        assert_eq!((playback.cue(2), playback.loop_at(3)), (None, None), "it does not wait");
        let preview = PlayedShow::new(playback.show, RunPurpose::Preview, MissingPolicy::Refuse, at(2, 0, 0));
        assert_eq!(preview.after(preview.next), None);
    }

    #[test]
    fn a_jump_takes_back_a_go_for_the_loop_unless_it_is_given_up() {
        let mut playback = repeating();
        let end = FrameCursor { frame: 2, ..FrameCursor::default() };
        (playback.next, playback.leaves_loop) = (end, Some(end));
        playback.choose(Some(FrameCursor { frame: 1, ..FrameCursor::default() }), true);
        assert_eq!(playback.leaves_loop, None);
        playback.give_up(playback.jump.unwrap());
        assert_eq!((playback.next, playback.leaves_loop), (end, Some(end)));
    }

    #[test]
    fn nothing_comes_after_a_show_that_is_over() {
        let mut playback = playback(RunPurpose::Play, false);
        while !playback.is_ended() {
            playback.advance();
        }
        assert_eq!(playback.after(playback.next), None);
    }
}
