//! Where a leg is in show time, and when its frame is due by the timeline that the music keeps to.
//!
//! A leg is the drive of all robots between two moments at which all stand.

use crate::leg::Leg;
use crate::run::light_leg::LegLight;
use crate::run::playback::PlayedShow;
use crate::run::show_times::ShowTimes;
use lightbots_base::Span;

/// Where a leg is on the timeline.
#[derive(Clone, Copy, Debug)]
pub(super) struct LegPlace {
    /// Show time when the drive begins, seconds.
    pub show_s: f64,
    /// Show time at which robots are to reach the frame by the timeline, seconds. Late robots reach it later.
    pub due_s: f64,
    /// Whether the leg leads to the same frame as the leg before it.
    pub is_same_frame: bool,
    /// Whether the leg follows a jump, or a loop goes back to its frame. A jump: the frame was chosen, or the one
    /// before it was left out.
    pub is_chosen: bool,
    /// Whether the music jumps to the leg too.
    pub leads_music: bool,
}

/// Finds where the leg after `current` is on the timeline. If `current` leads to the same frame, either several legs
/// lead there, or the drive was planned anew and robots are late. Show time then goes on, and the frame stays due when
/// it was before, unless the leg follows a jump. Notes in `times` when the frame is due.
pub(super) fn place(
    times: &mut ShowTimes,
    current: Option<&LegLight>,
    (playback, leg): (&PlayedShow, &Leg),
) -> LegPlace {
    let drive_s = leg.duration.as_secs();
    let is_new_round = current.is_some_and(|current| current.frame.round != leg.round);
    let is_same_frame = current.is_some_and(|current| current.frame == leg.cursor());
    // A loop goes back to its first frame as a jump does.
    let goes_back = current.is_some_and(|current| !is_new_round && leg.pass > current.frame.pass);
    let is_chosen = playback.jump.is_some() || goes_back;
    let leads_music = is_new_round || goes_back || playback.jump.is_some() && playback.music.is_led;
    if is_new_round {
        times.clear();
    }
    let (show_s, due_s) = match current {
        Some(current) if is_same_frame && !is_chosen => {
            let elapsed = if current.reaches_frame { current.seen } else { current.times.drive };
            (current.moment(elapsed.min(current.times.drive), Span::ZERO).show_s, current.times.due_s)
        }
        Some(current) if !is_new_round && !is_chosen => {
            let air_s = current.times.air.as_secs();
            let due_s = current.times.due_s + air_s + times.planned_s(leg.frame).unwrap_or(drive_s);
            (current.times.show_s + current.times.drive.as_secs() + air_s, due_s)
        }
        _ => {
            let begin_s = times.begin_s(playback, leg.frame);
            (begin_s - drive_s, times.due_s(playback, leg.frame))
        }
    };
    if is_chosen {
        times.begin_earlier(playback, leg.frame);
    }
    times.due.insert(leg.frame, due_s);
    LegPlace { show_s, due_s, is_same_frame, is_chosen, leads_music }
}
