//! What is played: the show, the frame that is reached next, and whether the operator paused.

use crate::operation::MissingPolicy;
use lightbots_base::Span;
use lightbots_show::{CuePlace, Show};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Longest air time of a frame, seconds: a day. A larger value in a show would overflow the show clock.
const AIR_TIME_MAX_S: f64 = 86_400.0;

/// Whether a run plays a show or drives to one frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum RunPurpose {
    /// All frames from the first one on.
    Play,
    /// One frame, without air time.
    Preview,
    /// The starting places, which are a frame of their own.
    Home,
}

/// A frame in a run of a show that may loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FrameCursor {
    /// Index of the frame, counted from 0; `usize::MAX` after the last one.
    pub frame: usize,
    /// How many times the show started again before.
    pub round: u32,
}

/// The operator chose the frame that is reached next. This ends when robots leave for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Jump {
    /// The frame that would have been next.
    pub instead_of: FrameCursor,
    /// The frame that stood waited for GO.
    pub waited_for_go: bool,
    /// Robots leave as soon as they can. Otherwise the show waits as it would have.
    pub leaves: bool,
}

/// What is played, and where it is.
#[derive(Clone, Debug)]
pub(crate) struct PlayedShow {
    /// The show; it does not change during a run.
    pub show: Arc<Show>,
    /// Whether all frames are played.
    pub purpose: RunPurpose,
    /// What happens to pixels without a robot.
    pub missing: MissingPolicy,
    /// The show starts again after its last frame.
    pub looping: bool,
    /// The frame that is reached next.
    pub next: FrameCursor,
    /// The operator paused.
    pub paused: bool,
    /// The run pauses again at the next frame.
    pub stepping: bool,
    /// The frame that was reached last has a cue, and GO was not given: it is not left.
    pub waits_for_go: bool,
    /// The operator chose the next frame.
    pub jump: Option<Jump>,
}

impl PlayedShow {
    /// The frame after one, if there is any.
    pub fn after(&self, cursor: FrameCursor) -> Option<FrameCursor> {
        match self.purpose {
            RunPurpose::Preview | RunPurpose::Home => None,
            RunPurpose::Play if cursor.frame.saturating_add(1) < self.show.frames.len() => {
                Some(FrameCursor { frame: cursor.frame + 1, ..cursor })
            }
            RunPurpose::Play => self.looping.then(|| FrameCursor { frame: 0, round: cursor.round + 1 }),
        }
    }

    /// A frame was reached: the one after it is next.
    pub fn advance(&mut self) {
        match self.after(self.next) {
            Some(next) => self.next = next,
            None => self.next.frame = usize::MAX,
        }
    }

    /// The operator chooses the frame that is reached next. `leaves`: robots leave for it at once.
    pub fn choose(&mut self, next: Option<FrameCursor>, leaves: bool) {
        let begun = Jump { instead_of: self.next, waited_for_go: self.waits_for_go, leaves: false };
        let jump = self.jump.get_or_insert(begun);
        jump.leaves |= leaves;
        self.next = next.unwrap_or(FrameCursor { frame: usize::MAX, ..self.next });
        if leaves {
            (self.paused, self.stepping, self.waits_for_go) = (false, false, false);
        }
    }

    /// There is no path to the frame that the operator chose: the show waits where it is.
    pub fn give_up(&mut self, jump: Jump) {
        self.jump = None;
        self.next = jump.instead_of;
        if jump.leaves {
            self.waits_for_go = jump.waited_for_go;
            self.paused = !jump.waited_for_go;
        }
    }

    /// Whether robots are about to leave for the frame that the operator chose.
    pub fn leaves(&self) -> bool {
        self.jump.is_some_and(|jump| jump.leaves)
    }

    /// Whether the run stands until the operator says that it goes on.
    pub fn waits(&self) -> bool {
        self.paused || self.waits_for_go
    }

    /// Whether all frames were reached.
    pub fn is_ended(&self) -> bool {
        self.next.frame >= self.show.frames.len()
    }

    /// The last frame, where the next one is after it.
    pub fn shown_frame(&self) -> usize {
        self.next.frame.min(self.show.frames.len().saturating_sub(1))
    }

    /// The name of the cue at which a frame waits for GO in this run; it may be empty. `None`: the frame has none.
    pub fn cue(&self, frame: usize) -> Option<&str> {
        let id = self.show.frames.get(frame).filter(|_| self.purpose == RunPurpose::Play)?.id.as_deref()?;
        let mut cues = self.show.cues.iter();
        cues.find(|cue| matches!(&cue.at, CuePlace::Frame(at) if at == id)).map(|cue| cue.name.as_str())
    }

    /// How long a frame stands by the show; zero where the show has no such frame.
    pub fn air_time(&self, frame: usize) -> Span {
        let air_s = self.show.frames.get(frame).map_or(0.0, |frame| frame.air_time_s);
        Span::from_secs(if air_s.is_finite() { air_s.clamp(0.0, AIR_TIME_MAX_S) } else { 0.0 })
    }

    /// How long a frame stands in this run.
    pub fn standing_time(&self, frame: usize) -> Span {
        if self.purpose == RunPurpose::Play { self.air_time(frame) } else { Span::ZERO }
    }

    /// Distance of two centres at which rims touch, metres.
    pub fn contact_m(&self) -> f64 {
        self.show.stage.limits.contact_m()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::{Frame, Stage};

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
        PlayedShow {
            show: Arc::new(show),
            purpose,
            missing: MissingPolicy::Refuse,
            looping,
            next: FrameCursor { frame: 1, round: 0 },
            paused: false,
            stepping: false,
            waits_for_go: false,
            jump: None,
        }
    }

    #[test]
    fn a_show_that_loops_starts_again_in_the_next_round() {
        let mut once = playback(RunPurpose::Play, false);
        once.advance();
        assert!(once.is_ended());
        let mut looping = playback(RunPurpose::Play, true);
        looping.advance();
        assert_eq!(looping.next, FrameCursor { frame: 0, round: 1 });
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
        playback.choose(Some(FrameCursor { frame: 0, round: 0 }), true);
        assert!(!playback.waits() && playback.leaves());
        playback.give_up(playback.jump.unwrap());
        assert_eq!((playback.next, playback.waits_for_go, playback.paused), (before, true, false));
        playback.waits_for_go = false;
        playback.choose(Some(FrameCursor { frame: 0, round: 0 }), true);
        playback.give_up(playback.jump.unwrap());
        assert_eq!((playback.next, playback.waits_for_go, playback.paused), (before, false, true));
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
