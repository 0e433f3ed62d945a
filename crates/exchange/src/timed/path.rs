//! The timed path of a robot in a file.

use lightbots_base::Vec2;
use lightbots_show::{MAX_TRAJECTORY_PIECES, TrajectoryPiece};

use crate::limits::LONGEST_S;

/// A robot stands during a piece if no point of the piece is farther than this from the piece's start, metres. Files
/// round places to a tenth of a millimetre.
const STILL_M: f64 = 1e-4;
/// Largest magnitude of a coordinate in a file, metres. No floor is as large, and squares of coordinates stay precise.
const FARTHEST_M: f64 = 100_000.0;
/// Height above which a robot counts as flying, metres. Programs write places on the floor with a few millimetres of
/// noise.
const FLIES_M: f64 = 0.01;

/// The timed path of a robot. The robot is at `start` until the first piece, and stays at the end of the last piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TimedPath {
    /// First place, stage metres.
    pub start: Vec2,
    /// Pieces in order. Their `end_s` is in seconds from the start of the show, and increases.
    pub pieces: Vec<TrajectoryPiece>,
    /// Largest height above the floor, metres; 0 for a robot that stays on the floor.
    pub top_m: f64,
}

/// The place where a piece starts in stage metres, the time when it starts in seconds from the start of the show, and
/// the piece.
pub(crate) type BegunPiece<'a> = (Vec2, f64, &'a TrajectoryPiece);

impl TimedPath {
    /// When the last piece ends, seconds from the start of the show; 0 without pieces.
    pub fn end_s(&self) -> f64 {
        self.pieces.last().map_or(0.0, |piece| piece.end_s)
    }

    /// Last place, stage metres.
    pub fn end(&self) -> Vec2 {
        self.pieces.last().map_or(self.start, |piece| piece.end)
    }

    /// The pieces from index `first` on, counted from 0, each with the place and time at which it starts.
    pub fn begun_from(&self, first: usize) -> impl Iterator<Item = BegunPiece<'_>> {
        let before = first.checked_sub(1).and_then(|before| self.pieces.get(before));
        let mut begin = before.map_or((self.start, 0.0), |piece| (piece.end, piece.end_s));
        self.pieces.iter().skip(first).map(move |piece| {
            let (from, begin_s) = begin;
            begin = (piece.end, piece.end_s);
            (from, begin_s, piece)
        })
    }

    /// Start and end of each piece in which the robot moves, seconds from the start of the show.
    pub fn moves(&self) -> impl Iterator<Item = (f64, f64)> {
        self.begun_from(0)
            .filter(|(from, _, piece)| !is_still(*from, piece))
            .map(|(_, begin_s, piece)| (begin_s, piece.end_s))
    }
}

/// Whether a robot stands during a piece that starts at the place `from`: its control points and its end are at most
/// [`STILL_M`] away.
pub(crate) fn is_still(from: Vec2, piece: &TrajectoryPiece) -> bool {
    let points = piece.controls.iter().flatten().chain([&piece.end]);
    points.into_iter().all(|point| point.distance(from) <= STILL_M)
}

/// Builds a [`TimedPath`] from the points of a file. An error is a text that a caller puts after the name of the robot.
#[derive(Debug)]
pub(crate) struct PathReader<'a> {
    path: Option<TimedPath>,
    /// Number of pieces that may still follow in the whole file, for all robots together.
    room: &'a mut usize,
}

/// Largest number of pieces in all paths of a file.
pub(crate) const PIECES_MAX: usize = MAX_TRAJECTORY_PIECES;

impl<'a> PathReader<'a> {
    pub fn new(room: &'a mut usize) -> Self {
        Self { path: None, room }
    }

    /// Adds the next place of the robot, `[x, y, z]` in metres with z up. The robot reaches it `at_s` seconds after the
    /// start of the show. `controls` are the control points of a cubic Bézier curve to that place; `None`: a straight
    /// line. Until the time of the first point, the robot stands at the first place. Fails if times decrease, for a
    /// jump, for numbers out of bounds, and for too many pieces.
    pub fn point(
        &mut self,
        at_s: f64,
        place: [f64; 3],
        controls: Option<[[f64; 3]; 2]>,
    ) -> Result<(), String> {
        if !(0.0..=LONGEST_S).contains(&at_s) {
            return Err(format!("a place is at {at_s} s; times go from 0 s to a day: correct the file"));
        }
        let numbers = controls.iter().flatten().chain([&place]).flatten();
        if numbers.into_iter().any(|number| !(-FARTHEST_M..=FARTHEST_M).contains(number)) {
            return Err(format!("the place at {at_s} s is none within 100 km; give it finite metres"));
        }
        let end = flat(place);
        let Some(path) = &mut self.path else {
            self.path = Some(TimedPath { start: end, pieces: Vec::new(), top_m: height(place) });
            return if at_s > 0.0 { self.piece(at_s, None, end) } else { Ok(()) };
        };
        path.top_m = path.top_m.max(height(place));
        let (before_s, before) = (path.end_s(), path.end());
        if at_s < before_s {
            return Err(format!("the place at {at_s} s stands behind one at {before_s} s; sort its places"));
        }
        if at_s == before_s {
            let what = format!("two places at {at_s} s: a robot cannot jump; take one out");
            return if before.distance(end) <= STILL_M { Ok(()) } else { Err(what) };
        }
        self.piece(at_s, controls.map(|controls| controls.map(flat)), end)
    }

    fn piece(&mut self, end_s: f64, controls: Option<[Vec2; 2]>, end: Vec2) -> Result<(), String> {
        *self.room = self.room.checked_sub(1).ok_or_else(|| {
            format!("the paths of all robots have more than {PIECES_MAX} pieces; split the show into several")
        })?;
        if let Some(path) = &mut self.path {
            let piece = TrajectoryPiece { end_s, controls, end };
            let from = path.end();
            // Rests that follow each other become one, so that the hundreds of rows of a robot that stands do not
            // count.
            let stood = path.pieces.len().checked_sub(2).map_or(path.start, |before| path.pieces[before].end);
            match path.pieces.last_mut() {
                Some(last) if is_rest(stood, last) && is_rest(from, &piece) => {
                    last.end_s = end_s;
                    *self.room += 1;
                }
                _ => path.pieces.push(piece),
            }
        }
        Ok(())
    }

    /// Returns the whole path. Fails if there was no point.
    pub fn end(self) -> Result<TimedPath, String> {
        self.path.ok_or_else(|| "it has no place; give it one at 0 s".into())
    }
}

fn is_rest(from: Vec2, piece: &TrajectoryPiece) -> bool {
    piece.controls.is_none() && piece.end == from
}

fn flat([x, y, _]: [f64; 3]) -> Vec2 {
    Vec2::new(x, y)
}

fn height([_, _, z]: [f64; 3]) -> f64 {
    if z > FLIES_M { z } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(points: &[(f64, [f64; 3])]) -> Result<TimedPath, String> {
        let mut room = 10;
        let mut reader = PathReader::new(&mut room);
        for (at_s, place) in points {
            reader.point(*at_s, *place, None)?;
        }
        reader.end()
    }

    #[test]
    fn rests_become_one_and_moves_are_found() {
        let path = read(&[
            (1.0, [0.0, 0.0, 0.0]),
            (2.0, [0.0, 0.0, 0.0]),
            (3.0, [1.0, 0.0, 7.5]),
            (4.0, [1.0, 0.0, 0.0]),
            (5.0, [1.0, 0.0, 0.0]),
        ]);
        let path = path.unwrap();
        let ends: Vec<f64> = path.pieces.iter().map(|piece| piece.end_s).collect();
        assert_eq!((ends, path.top_m), (vec![2.0, 3.0, 5.0], 7.5));
        assert_eq!(path.moves().collect::<Vec<_>>(), [(2.0, 3.0)]);
    }

    #[test]
    fn what_no_robot_can_drive_is_refused() {
        let at = [0.0; 3];
        for (points, part) in [
            (vec![(0.0, [f64::NAN, 0.0, 0.0])], "none within 100 km"),
            (vec![(0.0, [1e9, 0.0, 0.0])], "none within 100 km"),
            (vec![(f64::NAN, at)], "times go from 0 s to a day"),
            (vec![(-1.0, at)], "times go from 0 s to a day"),
            (vec![(2.0, at), (1.0, at)], "sort its places"),
            (vec![(2.0, at), (2.0, [1.0, 0.0, 0.0])], "cannot jump"),
            (vec![], "it has no place"),
            ((0..20).map(|nth| (f64::from(nth), [f64::from(nth), 0.0, 0.0])).collect(), "more than 1000000"),
        ] {
            let error = read(&points).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }
}
