//! Prescribed trajectories.

use lightbots_base::Vec2;
use lightbots_show::{MAX_TRAJECTORIES, MAX_TRAJECTORY_PIECES, Trajectory, TrajectoryPiece};

use super::fields::{bounded, label, place};
use crate::error::ReadError;
use crate::json::Json;
use crate::json::frames::{Notes, missing};
use crate::json::text::{exact, place_text, quoted};

pub(super) fn read(json: &mut Json<'_>, notes: &mut Notes) -> Result<Vec<Trajectory>, ReadError> {
    let mut room = MAX_TRAJECTORY_PIECES;
    bounded(json, "trajectories", MAX_TRAJECTORIES, |json| trajectory(json, notes, &mut room))
}

fn trajectory(json: &mut Json<'_>, notes: &mut Notes, room: &mut usize) -> Result<Trajectory, ReadError> {
    let (mut frame, mut pixel, mut at_s, mut start, mut pieces) = (None, None, 0.0, None, Vec::new());
    json.object(|json, key| {
        match key {
            "frame" => frame = Some(label(json, key)?),
            "pixel" => pixel = Some(json.whole(key)?),
            "at_s" => at_s = json.number(key)?,
            "start" => start = Some(place(json, key)?),
            "pieces" => pieces = bounded(json, "pieces of all trajectories", *room, piece)?,
            _ => notes.unknown(json, "trajectory", key)?,
        }
        Ok(())
    })?;
    *room -= pieces.len();
    Ok(Trajectory {
        frame,
        pixel: pixel.ok_or_else(|| missing(json, "the pixel of the trajectory"))?,
        at_s,
        start: start.ok_or_else(|| missing(json, "the start of the trajectory"))?,
        pieces,
    })
}

/// Reads a piece: `[end_s, x, y]`, or `[end_s, x1, y1, x2, y2, x, y]` for a curve with two control points.
fn piece(json: &mut Json<'_>) -> Result<TrajectoryPiece, ReadError> {
    let numbers = bounded(json, "numbers of a piece", 7, |json| json.number("a number of the piece"))?;
    match numbers[..] {
        [end_s, x, y] => Ok(TrajectoryPiece { end_s, controls: None, end: Vec2::new(x, y) }),
        [end_s, x1, y1, x2, y2, x, y] => {
            let controls = Some([Vec2::new(x1, y1), Vec2::new(x2, y2)]);
            Ok(TrajectoryPiece { end_s, controls, end: Vec2::new(x, y) })
        }
        _ => {
            let what = "a piece has 3 numbers (end_s, x, y) or 7 (end_s, two control points, x, y)";
            Err(json.fail("bad-piece", what))
        }
    }
}

pub(super) fn text(trajectory: &Trajectory) -> String {
    let mut fields = Vec::new();
    if let Some(frame) = &trajectory.frame {
        fields.push(format!("\"frame\": {}", quoted(frame)));
    }
    fields.push(format!("\"pixel\": {}", trajectory.pixel));
    if trajectory.at_s != 0.0 {
        fields.push(format!("\"at_s\": {}", exact(trajectory.at_s)));
    }
    fields.push(format!("\"start\": {}", place_text(trajectory.start)));
    let pieces: Vec<String> = trajectory.pieces.iter().map(piece_text).collect();
    fields.push(format!("\"pieces\": [{}]", pieces.join(", ")));
    format!("{{ {} }}", fields.join(", "))
}

fn piece_text(piece: &TrajectoryPiece) -> String {
    let places = piece.controls.iter().flatten().chain([&piece.end]);
    let numbers = places.flat_map(|at| [at.x, at.y]);
    let numbers: Vec<String> = [piece.end_s].into_iter().chain(numbers).map(exact).collect();
    format!("[{}]", numbers.join(", "))
}
