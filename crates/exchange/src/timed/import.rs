//! A timed show -> frames and trajectories. Each time for which all robots stand long enough is a frame. Drives between
//! frames are prescribed.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_PI_2;

use lightbots_base::{Rgb, RobotId, Span, Vec2};
use lightbots_lighting::{FrameTimes, fade_of};
use lightbots_plan::turn_time;
use lightbots_show::{
    Frame, Identity, Issue, Issues, MAX_FRAMES, MAX_LABEL_CHARS, MAX_PIXELS, MAX_TRAJECTORIES,
    MAX_TRAJECTORY_PIECES, Pixel, Show, Stage, Trajectory, TrajectoryPiece,
};

use super::matching::{EARLIER_S, differs};
use super::path::is_still;
use super::stands::stands;
use super::{TimedRobot, TimedShow, music, sequence};
use crate::error::ReadError;
use crate::format::Loaded;

/// Largest number of pixels of all frames together: a pixel takes 120 bytes of memory.
const PIXELS_MAX: usize = 1_000_000;
/// Least distance from the places of robots to the edge of the floor that is made for them, metres.
const MARGIN_M: f64 = 0.5;
/// Shortest air time that a drive leaves to the frame before it, seconds, unless robots stand even shorter. Of the rest
/// of that stand, up to the time of a quarter turn belongs to the drive, because robots turn in it.
const AIR_LEAST_S: f64 = 0.05;
/// Largest number of pieces of a path that a robot can store (docs/protocol.md, R31).
const PIECES_OF_DRIVE_MAX: usize = 128;
/// Largest sudden change of velocity that a robot is taken to follow, m/s, as in the planner's proof.
const JUMP_MPS: f64 = 1e-3;

/// Converts the timed show of a file into a show with frames.
pub(crate) fn loaded(file: &TimedShow) -> Result<Loaded, ReadError> {
    let robots = file.robots.len();
    if !(1..=MAX_PIXELS).contains(&robots) {
        let what = format!("the file has {robots} robots; a show has 1 to {MAX_PIXELS}: open another file");
        return Err(ReadError::whole("bad-robots", what));
    }
    let stage = stage(file);
    let mut times = times(file, turn_time(FRAC_PI_2, &stage.limits).as_secs());
    let mut issues = Issues::new();
    let mut show = framed(file, stage.clone(), &times, &mut issues)?;
    if differs(file, &show, &times) {
        let dark_s = dark_s(file, &times[0]);
        if !file.robots.iter().all(|robot| robot.light.is_dark_until(dark_s)) {
            // Layers shine only on robots with a pixel. A frame at the begin gives them one on the way to the first
            // picture.
            times.insert(0, FrameTimes { drive_s: 0.0, air_s: 0.0, end_s: 0.0 });
            issues.clear();
            // The old show is freed first, because a hostile file could make both too large for the memory.
            drop(std::mem::take(&mut show));
            show = framed(file, stage, &times, &mut issues)?;
        }
        issues.extend(sequence::add(&mut show, file, &times));
    }
    let heard = file.music.as_ref();
    issues.extend(heard.and_then(|heard| music::add(&mut show, heard, times[0].air_s)));
    issues.extend(findings(file, &show));
    Ok(Loaded { show, plan: None, has_stage: true, unread: None, issues })
}

/// How long all robots must be dark so that no frame is needed before the first picture, seconds from the start of the
/// file. This is the time until the first picture. If the music begins with that picture, lights may fade in earlier: a
/// further frame would move the music, which matters more than an exact fade.
fn dark_s(file: &TimedShow, first: &FrameTimes) -> f64 {
    let is_in_step = file.music.as_ref().is_some_and(|music| music.late_s(first.air_s) == 0.0);
    let fade_s = fade_of(Span::from_secs(first.air_s - first.drive_s)).as_secs();
    if is_in_step { first.air_s - fade_s - EARLIER_S } else { first.air_s }
}

/// Makes the show of a file, with a frame for each of `times`. Adds warnings to `issues`.
fn framed(
    file: &TimedShow,
    stage: Stage,
    times: &[FrameTimes],
    issues: &mut Issues,
) -> Result<Show, ReadError> {
    let robots = file.robots.len();
    if times.len() > MAX_FRAMES || times.len() * robots > PIXELS_MAX {
        let what = format!(
            "{robots} robots stand {} times, which are too many pictures; split the show into several",
            times.len()
        );
        return Err(ReadError::whole("too-many-frames", what));
    }
    let mut show = Show {
        name: file.name.chars().take(MAX_LABEL_CHARS).collect(),
        stage,
        identity: Identity::Fixed,
        starts: Some(file.robots.iter().map(|robot| robot.path.start).collect()),
        frames: times.iter().enumerate().map(|(index, times)| frame(index, times)).collect(),
        ..Show::default()
    };
    let mut taken = BTreeSet::new();
    for (number, robot) in (0..).zip(&file.robots) {
        let name = RobotId::new(&robot.name).map(|id| id.as_str().to_owned());
        // A name stands for one robot: the first that has it.
        let name = name.filter(|name| taken.insert(name.clone()));
        perform(&mut show, (number, name), robot, times);
    }
    show.trajectories.sort_by_key(|trajectory| frame_number(trajectory.frame.as_deref()));
    bounded(&mut show, issues);
    Ok(show)
}

/// Removes the trajectories of a show, so that its drives will be planned. If a frame had trajectories, the wanted
/// duration of its transition becomes the time at which the last of them ends. Other frames keep theirs.
pub fn replanned(show: &mut Show) {
    let mut longest: BTreeMap<String, f64> = BTreeMap::new();
    for trajectory in std::mem::take(&mut show.trajectories) {
        let end_s = trajectory.at_s + trajectory.pieces.last().map_or(0.0, |piece| piece.end_s);
        if let Some(id) = trajectory.frame {
            let longest_s = longest.entry(id).or_default();
            *longest_s = longest_s.max(end_s);
        }
    }
    for frame in &mut show.frames {
        let longest_s = frame.id.as_ref().and_then(|id| longest.get(id)).copied().unwrap_or(0.0);
        if longest_s > 0.0 {
            frame.transition_s = Some(longest_s);
        }
    }
}

/// Returns `[frame]`: when the drive to the frame begins, and when its air time begins and ends, seconds from the start
/// of the file. `turn_s` is the time, in seconds, that robots need to turn before a drive.
fn times(file: &TimedShow, turn_s: f64) -> Vec<FrameTimes> {
    let ends = file.robots.iter().map(|robot| robot.path.end_s().max(robot.light.end_s()));
    let end_s = ends.fold(0.0, f64::max);
    let mut stands = stands(file, end_s);
    let moves = stands.last().is_some_and(|last| last.begin_s > 0.0);
    let is_dark = |robot: &TimedRobot| robot.light.player().at(0.0) == Rgb::BLACK;
    if moves && stands[0].begin_s == 0.0 && file.robots.iter().all(is_dark) {
        // Robots that wait in the dark are at their starts, before the drive to the first picture.
        stands.remove(0);
    }
    let mut times: Vec<FrameTimes> = Vec::new();
    if moves && stands.len() == 1 && stands[0].end_s - stands[0].begin_s < AIR_LEAST_S {
        times.push(FrameTimes { drive_s: 0.0, air_s: 0.0, end_s: 0.0 });
    }
    for (index, stand) in stands.iter().enumerate() {
        let drive_s = times.last().map_or(0.0, |before| before.end_s);
        let stands_s = stand.end_s - stand.begin_s;
        // A drive begins with a rest in which robots turn.
        let turn_s =
            if index + 1 == stands.len() { 0.0 } else { turn_s.min(stands_s - AIR_LEAST_S).max(0.0) };
        times.push(FrameTimes { drive_s, air_s: stand.begin_s, end_s: stand.end_s - turn_s });
    }
    times
}

fn frame(index: usize, times: &FrameTimes) -> Frame {
    let seconds = times.air_s.round() as u64;
    Frame {
        id: Some(frame_id(index)),
        name: format!("{}:{:02}", seconds / 60, seconds % 60),
        air_time_s: times.end_s - times.air_s,
        ..Frame::default()
    }
}

fn frame_id(index: usize) -> String {
    format!("f{}", index + 1)
}

fn frame_number(id: Option<&str>) -> usize {
    id.and_then(|id| id.strip_prefix('f')?.parse().ok()).unwrap_or(0)
}

/// Adds the pixels and trajectories of a robot to all frames. `number`, counted from 0, becomes the id of its pixels.
/// If it has a `name`, the pixels ask for the robot of that name.
fn perform(show: &mut Show, (number, name): (u32, Option<String>), robot: &TimedRobot, times: &[FrameTimes]) {
    let mut light = robot.light.player();
    let mut first = 0;
    for (index, times) in times.iter().enumerate() {
        let (trajectory, next) = drive(robot, first, times);
        first = next;
        let at = first.checked_sub(1).map_or(robot.path.start, |piece| robot.path.pieces[piece].end);
        if let Some(trajectory) = trajectory {
            show.trajectories.push(Trajectory { frame: Some(frame_id(index)), pixel: number, ..trajectory });
        }
        let color = light.at(times.air_s / 2.0 + times.end_s / 2.0);
        show.frames[index].pixels.push(Pixel {
            id: number,
            at,
            color,
            robot: name.clone(),
            ..Pixel::default()
        });
    }
}

/// The path of a robot to the frame with these `times`, and the index of the first piece after it. The search begins
/// with piece `first` of the robot's whole path, counted from 0. The path is `None` if the robot only rests.
fn drive(robot: &TimedRobot, first: usize, times: &FrameTimes) -> (Option<Trajectory>, usize) {
    let mut next = first;
    let mut way: Option<Trajectory> = None;
    let mut moved = 0;
    for (from, begin_s, piece) in robot.path.begun_from(first) {
        // A rest that goes on into the frame ends the drive. The drive to the next frame begins with it.
        if begin_s >= times.air_s || piece.end_s > times.air_s {
            break;
        }
        next += 1;
        let still = is_still(from, piece);
        if way.is_none() && still {
            continue;
        }
        let begin_s = begin_s.max(times.drive_s);
        let way = way.get_or_insert_with(|| Trajectory {
            frame: None,
            pixel: 0,
            at_s: begin_s - times.drive_s,
            start: from,
            pieces: Vec::new(),
        });
        let end_s = piece.end_s - times.drive_s - way.at_s;
        way.pieces.push(TrajectoryPiece { end_s, ..*piece });
        if !still {
            moved = way.pieces.len();
        }
    }
    if let Some(way) = &mut way {
        way.pieces.truncate(moved);
    }
    (way, next)
}

/// Removes all trajectories if there are more than a file of our format may hold, and adds a warning. The drives are then
/// planned instead.
fn bounded(show: &mut Show, issues: &mut Issues) {
    let pieces: usize = show.trajectories.iter().map(|trajectory| trajectory.pieces.len()).sum();
    if show.trajectories.len() > MAX_TRAJECTORIES || pieces > MAX_TRAJECTORY_PIECES {
        let what = format!(
            "the file has {} drives of single robots, more than the {MAX_TRAJECTORIES} of a show: drives are planned \
             between its pictures instead",
            show.trajectories.len()
        );
        issues.push(Issue::warning("paths-left-out", what));
        replanned(show);
    }
}

/// A floor around all places and control points of the paths. The origin is at its centre.
fn stage(file: &TimedShow) -> Stage {
    let mut reach = Vec2::ZERO;
    for robot in &file.robots {
        let controls = robot.path.pieces.iter().filter_map(|piece| piece.controls).flatten();
        let ends = robot.path.pieces.iter().map(|piece| piece.end);
        for at in [robot.path.start].into_iter().chain(ends).chain(controls) {
            reach = Vec2::new(reach.x.max(at.x.abs()), reach.y.max(at.y.abs()));
        }
    }
    // In whole decimetres, so that the size reads well.
    let side_m = |reach_m: f64| ((reach_m + MARGIN_M) * 20.0).ceil() / 10.0;
    Stage { width_m: side_m(reach.x), depth_m: side_m(reach.y), ..Stage::default() }
}

/// Warnings about a file for robots on a floor: about flying robots, names of robots, sudden changes of speed, and paths
/// with too many pieces.
fn findings(file: &TimedShow, show: &Show) -> Issues {
    let mut issues = Issues::new();
    let mut find = |code: &str, what: String| issues.push(Issue::warning(code, what));
    let fliers = file.robots.iter().filter(|robot| robot.path.top_m > 0.0).count();
    if fliers > 0 {
        let top_m = file.robots.iter().map(|robot| robot.path.top_m).fold(0.0, f64::max);
        let verb = if fliers == 1 { "robot flies" } else { "robots fly" };
        find("flies", format!("{fliers} {verb} up to {top_m:.1} m: places on the floor are kept"));
    }
    let named =
        show.frames.first().map_or(0, |frame| frame.pixels.iter().filter(|p| p.robot.is_some()).count());
    if named > 0 {
        let what =
            "pixels ask for robots by the names in the file; take the names away if your robots have others";
        find("named-robots", what.into());
    }
    let jumping = show.trajectories.iter().filter(|trajectory| jumps(trajectory)).count();
    let long = show.trajectories.iter().filter(|way| way.pieces.len() > PIECES_OF_DRIVE_MAX).count();
    let remedy = "have the drives planned anew (lightbots convert --replan)";
    if jumping > 0 {
        find(
            "sudden-speeds",
            format!("on {jumping} paths the speed changes without a ramp, and no robot can follow; {remedy}"),
        );
    }
    if long > 0 {
        find(
            "long-paths",
            format!(
                "{long} paths have more than {PIECES_OF_DRIVE_MAX} pieces, which robots cannot keep; {remedy}"
            ),
        );
    }
    issues
}

/// Whether the velocity along a trajectory changes suddenly by more than [`JUMP_MPS`]. Before its start and after its
/// end, the velocity is 0.
fn jumps(trajectory: &Trajectory) -> bool {
    let (mut from, mut begin_s, mut velocity) = (trajectory.start, 0.0, Vec2::ZERO);
    for piece in &trajectory.pieces {
        let seconds = piece.end_s - begin_s;
        let (first, last) = match piece.controls {
            Some([c1, c2]) => ((c1 - from) * (3.0 / seconds), (piece.end - c2) * (3.0 / seconds)),
            None => ((piece.end - from) / seconds, (piece.end - from) / seconds),
        };
        if !is_ramp(first - velocity) {
            return true;
        }
        (from, begin_s, velocity) = (piece.end, piece.end_s, last);
    }
    !is_ramp(velocity)
}

/// Whether a change of velocity, m/s, is at most [`JUMP_MPS`].
fn is_ramp(step: Vec2) -> bool {
    (0.0..=JUMP_MPS).contains(&step.length())
}
