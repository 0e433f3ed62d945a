//! Timed paths: where a robot's centre is at every moment.

use crate::{Instant, Span, Vec2};

/// One piece of a path: a cubic Bézier curve whose parameter is proportional to time. It starts at the end of the
/// previous piece, or at the start of the path. A piece that has all its points at its start is a rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Duration of the piece; positive.
    pub duration: Span,
    /// First control point after the start, stage metres.
    pub c1: Vec2,
    /// Second control point, stage metres.
    pub c2: Vec2,
    /// End of the piece, stage metres.
    pub end: Vec2,
}

/// Position, velocity and acceleration of a path at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    /// Stage metres.
    pub position: Vec2,
    /// Stage m/s.
    pub velocity: Vec2,
    /// Stage m/s².
    pub acceleration: Vec2,
}

/// A path: its start and its pieces in order. Before the path begins, the robot rests at `start`. After the path, it
/// rests at the path's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathRef<'a> {
    /// First place, stage metres.
    pub start: Vec2,
    /// The pieces in order of time; may be empty.
    pub pieces: &'a [Piece],
}

impl Piece {
    /// From `start` to `end` at constant speed.
    pub fn straight(start: Vec2, end: Vec2, duration: Span) -> Self {
        Self { duration, c1: start.lerp(end, 1.0 / 3.0), c2: start.lerp(end, 2.0 / 3.0), end }
    }

    /// A rest at `at`.
    pub fn rest(at: Vec2, duration: Span) -> Self {
        Self { duration, c1: at, c2: at, end: at }
    }

    /// The cubic piece with the given places (metres) and velocities (m/s) at both ends.
    pub fn hermite(start: Vec2, v0: Vec2, end: Vec2, v1: Vec2, duration: Span) -> Self {
        let third = duration.as_secs() / 3.0;
        Self { duration, c1: start + v0 * third, c2: end - v1 * third, end }
    }

    /// The motion at the time `t` after the beginning of the piece, 0 to `duration`. `start`: place where the piece
    /// begins, stage metres. A piece without duration gives its end, at rest.
    pub fn at(&self, start: Vec2, t: Span) -> Motion {
        let seconds = self.duration.as_secs();
        if seconds <= 0.0 {
            return Motion { position: self.end, ..Motion::default() };
        }
        let u = t.as_secs() / seconds;
        let w = 1.0 - u;
        let (d0, d1, d2) = (self.c1 - start, self.c2 - self.c1, self.end - self.c2);
        Motion {
            position: start * (w * w * w)
                + self.c1 * (3.0 * w * w * u)
                + self.c2 * (3.0 * w * u * u)
                + self.end * (u * u * u),
            velocity: (d0 * (w * w) + d1 * (2.0 * w * u) + d2 * (u * u)) * (3.0 / seconds),
            acceleration: ((d1 - d0) * w + (d2 - d1) * u) * (6.0 / (seconds * seconds)),
        }
    }

    /// Whether the piece stays at `start`.
    pub fn is_rest(&self, start: Vec2) -> bool {
        self.c1 == start && self.c2 == start && self.end == start
    }
}

impl<'a> PathRef<'a> {
    /// A path from its start and pieces.
    pub const fn new(start: Vec2, pieces: &'a [Piece]) -> Self {
        Self { start, pieces }
    }

    /// Duration of the whole path.
    pub fn duration(&self) -> Span {
        self.pieces.iter().fold(Span::ZERO, |sum, piece| sum + piece.duration)
    }

    /// Last place, stage metres.
    pub fn end(&self) -> Vec2 {
        self.pieces.last().map_or(self.start, |piece| piece.end)
    }

    /// Whether all pieces stay at the start; `true` for a path without pieces.
    pub fn rests(&self) -> bool {
        self.timed().all(|(_, _, piece)| piece.is_rest(self.start))
    }

    /// The motion at the time `t` after the beginning of the path. At rest before the path begins, and from its end on.
    /// Takes time linear in the number of pieces.
    pub fn at(&self, t: Span) -> Motion {
        let mut start = self.start;
        let mut left = t;
        if left < Span::ZERO {
            return Motion { position: start, ..Motion::default() };
        }
        for piece in self.pieces {
            if left < piece.duration {
                return piece.at(start, left);
            }
            left -= piece.duration;
            start = piece.end;
        }
        Motion { position: start, ..Motion::default() }
    }

    /// Iterates over the pieces, each with its start place and its start time, counted from the path's start.
    pub fn timed(&self) -> impl Iterator<Item = (Vec2, Span, &'a Piece)> + use<'a> {
        let mut start = self.start;
        let mut begin = Span::ZERO;
        self.pieces.iter().map(move |piece| {
            let this = (start, begin, piece);
            start = piece.end;
            begin += piece.duration;
            this
        })
    }

    /// The motion at `now` of a path that starts at `began`.
    pub fn at_instant(&self, began: Instant, now: Instant) -> Motion {
        self.at(now - began)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One second, in microseconds.
    const SECOND: Span = Span(1_000_000);

    #[test]
    fn a_hermite_piece_meets_both_ends() {
        let (v0, v1) = (Vec2::new(0.1, 0.2), Vec2::new(-0.3, 0.0));
        let piece = Piece::hermite(Vec2::ZERO, v0, Vec2::new(1.0, 1.0), v1, SECOND);
        let (first, last) = (piece.at(Vec2::ZERO, Span::ZERO), piece.at(Vec2::ZERO, SECOND));
        assert!((first.velocity - v0).length() < 1e-12);
        assert!((last.velocity - v1).length() < 1e-12);
        assert_eq!(last.position, Vec2::new(1.0, 1.0));
    }

    #[test]
    fn a_path_rests_before_and_after() {
        let end = Vec2::new(2.0, 0.0);
        let pieces = [Piece::rest(Vec2::ZERO, SECOND), Piece::straight(Vec2::ZERO, end, SECOND)];
        let path = PathRef::new(Vec2::ZERO, &pieces);
        assert_eq!(path.at(Span(-5)).position, Vec2::ZERO);
        assert_eq!(path.at(SECOND / 2).velocity, Vec2::ZERO);
        assert!((path.at(Span(1_500_000)).position.x - 1.0).abs() < 1e-12);
        assert_eq!(path.at(SECOND * 9), Motion { position: end, ..Motion::default() });
        assert_eq!(path.duration(), SECOND * 2);
    }

    #[test]
    fn acceleration_is_the_slope_of_velocity() {
        let piece = Piece {
            duration: SECOND,
            c1: Vec2::new(0.2, 0.5),
            c2: Vec2::new(0.9, -0.4),
            end: Vec2::new(1.0, 1.0),
        };
        let (a, b) = (piece.at(Vec2::ZERO, Span(400_000)), piece.at(Vec2::ZERO, Span(400_010)));
        let slope = (b.velocity - a.velocity) / 1e-5;
        assert!((slope - a.acceleration).length() < 1e-3);
    }
}
