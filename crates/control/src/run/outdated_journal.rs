//! Where a silent robot may stand if the journal (the file from which a controller takes up a run) is out of date.
//!
//! A full or slow disk leaves a journal whose last entries are missing (`crate::journal`). Its leg (the last drive)
//! then does not say where a robot stands that died while the controller was away. Robots that report are therefore
//! compared with all frames. A frame may explain where more of them stand than the leg does. The silent robot then most
//! likely stands at a free place of that frame.

use crate::floor_cells::FloorCells;
use crate::journal::Position;
use crate::leg::Leg;
use crate::run::roster::Whereabouts;
use crate::run::run_context::RunContext;
use crate::run::silence;
use lightbots_base::Vec2;
use lightbots_show::Frame;

/// Where a participant may stand after a drive was interrupted, or after another controller has taken up the run. Empty
/// if it stands where it reported.
pub(crate) fn whereabouts_after(cx: &RunContext, left: &Position, participant: usize) -> Whereabouts {
    let by_leg = silence::whereabouts_after(cx, left, participant);
    let robot = cx.robot(participant);
    if robot.is_original() || has_reported(cx, participant).is_some() {
        return by_leg;
    }
    let free = free_places(cx, left);
    if free.is_empty() {
        return by_leg;
    }
    let by_journal =
        if by_leg.possible.is_empty() { robot.reported.at.into_iter().collect() } else { by_leg.possible };
    Whereabouts { possible: free.iter().copied().chain(by_journal).collect(), likely: free }
}

/// The free places of the frame in which the largest number of reporting robots stand. Empty if the leg is not from a
/// journal, or if at least as many of these robots stand where the leg has them. Also empty if only half of them, or
/// fewer, stand in that frame.
fn free_places(cx: &RunContext, left: &Position) -> Vec<Vec2> {
    let driven = cx.pipeline.driven.as_ref().filter(|driven| driven.targets.is_of_journal);
    let Some(driven) = driven else { return Vec::new() };
    let reported = || cx.roster.active().filter_map(|(one, _)| Some((one, has_reported(cx, one)?)));
    let stand: Vec<Vec2> = reported().map(|(_, at)| at).collect();
    let by_leg = reported().filter(|&(one, at)| is_expected(&driven.leg, left, one, at)).count();
    if by_leg == stand.len() {
        return Vec::new();
    }
    let is_better = |taken: usize| taken > by_leg && taken * 2 > stand.len();
    let frames = cx.playback.show.frames.iter().map(|frame| {
        let free = free_of(frame, &stand);
        (frame.pixels.len() - free.len(), free)
    });
    let best = frames.max_by_key(|(taken, _)| *taken).filter(|(taken, _)| is_better(*taken));
    best.map_or_else(Vec::new, |(_, free)| free)
}

/// The places of a frame that are free: no robot stands near them. `stand`: where robots stand, stage metres.
fn free_of(frame: &Frame, stand: &[Vec2]) -> Vec<Vec2> {
    let pixels: Vec<Vec2> = frame.pixels.iter().map(|pixel| pixel.at).collect();
    let cells = FloorCells::new(&pixels, stand, silence::OFF_PATH_M);
    let is_at = |one: usize, pixel: Vec2| one >= pixels.len() && is_near(cells.all[one], pixel);
    let is_free = |pixel: &usize| !cells.near(*pixel).any(|one| is_at(one, pixels[*pixel]));
    (0..pixels.len()).filter(is_free).map(|pixel| pixels[pixel]).collect()
}

/// The place that a participant has reported to this controller. `None` if there is none, and for TARGET-only robots
/// (they understand the command TARGET but no routes), which report no state.
fn has_reported(cx: &RunContext, participant: usize) -> Option<Vec2> {
    let reported = &cx.robot(participant).reported;
    reported.at.filter(|_| reported.state.is_some())
}

/// Whether a participant may stand at `at` after it drove the leg of the journal as far as `left` says.
fn is_expected(leg: &Leg, left: &Position, participant: usize, at: Vec2) -> bool {
    match (leg.path(participant), left.drive, left.stops) {
        (Some(path), Some(clock), Some(stops)) => {
            silence::stopped(&clock, stops).any(|time| is_near(path.as_ref().at(time).position, at))
        }
        _ if left.is_in_leg() => leg.goal(participant).is_none_or(|goal| is_near(goal, at)),
        // Robots stand at the places that they reported before, and the journal does not hold these places.
        _ => true,
    }
}

/// Whether a robot at `at` may be meant to stand at `place`: they are closer than the largest distance off a path.
fn is_near(at: Vec2, place: Vec2) -> bool {
    at.distance(place) <= silence::OFF_PATH_M
}
