//! Evaluation of a route at an advancing path time. The current piece of the route is kept as a polynomial.

use lightbots_base::{Motion, Span, Vec2};
use lightbots_wire::Route;

/// A position in a route: its current piece, as a cubic polynomial of the share of the piece's duration that is over.
#[derive(Debug)]
pub(crate) struct RouteCursor {
    /// Index of the current piece; past the end of the route: the number of pieces.
    index: usize,
    begin: Span,
    end: Span,
    per_second: f64,
    /// Coefficients of share⁰ to share³, stage metres. The share is the part of the piece's duration that is over, 0 to
    /// 1.
    cubic: [Vec2; 4],
    rests: bool,
}

impl RouteCursor {
    /// A cursor at the beginning of a route.
    pub(crate) fn new(route: &Route) -> Self {
        let mut cursor = Self {
            index: 0,
            begin: Span::ZERO,
            end: Span::ZERO,
            per_second: 0.0,
            cubic: [route.start, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO],
            rests: true,
        };
        cursor.enter(route, 0, Span::ZERO);
        cursor
    }

    /// Moves the cursor to the piece at the path time `time`, forwards or backwards.
    pub(crate) fn seek(&mut self, route: &Route, time: Span) {
        if time < self.begin {
            self.enter(route, 0, Span::ZERO);
        }
        while time >= self.end && self.index < route.pieces.len() {
            self.enter(route, self.index + 1, self.end);
        }
    }

    /// The motion of the route at the path time `time`, which must be within the current piece. Velocity and
    /// acceleration are per path time.
    pub(crate) fn motion(&self, time: Span) -> Motion {
        let [p, a, b, c] = self.cubic;
        if self.rests {
            return Motion { position: p, ..Motion::default() };
        }
        let share = ((time - self.begin).as_secs() * self.per_second).clamp(0.0, 1.0);
        let per_second = self.per_second;
        Motion {
            position: p + (a + (b + c * share) * share) * share,
            velocity: (a + (b * 2.0 + c * (3.0 * share)) * share) * per_second,
            acceleration: (b * 2.0 + c * (6.0 * share)) * (per_second * per_second),
        }
    }

    /// The current piece: its index, and the path time at which it begins.
    pub(crate) fn piece(&self) -> (usize, Span) {
        (self.index, self.begin)
    }

    fn enter(&mut self, route: &Route, index: usize, begin: Span) {
        let from = from(route, index);
        self.index = index;
        self.begin = begin;
        let Some(piece) = route.pieces.get(index) else {
            self.end = begin;
            self.cubic = [from, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO];
            self.rests = true;
            return;
        };
        self.end = begin + piece.duration;
        self.per_second = 1.0 / piece.duration.as_secs();
        let (d0, d1, d2) = (piece.c1 - from, piece.c2 - piece.c1, piece.end - piece.c2);
        self.cubic = [from, d0 * 3.0, (d1 - d0) * 3.0, d2 - d1 * 2.0 + d0];
        self.rests = piece.is_rest(from);
    }
}

/// The place where piece `index` of a route starts, stage metres.
pub(crate) fn from(route: &Route, index: usize) -> Vec2 {
    index.checked_sub(1).and_then(|before| route.pieces.get(before)).map_or(route.start, |piece| piece.end)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::{PathRef, Piece};
    use lightbots_wire::Pieces;

    fn route() -> Route {
        let (a, b) = (Vec2::new(0.0, 0.4), Vec2::new(0.4, 0.4));
        let pieces = [
            Piece::rest(Vec2::ZERO, Span(350_000)),
            Piece { duration: Span(900_000), c1: Vec2::ZERO, c2: Vec2::new(0.0, 0.3), end: a },
            Piece::straight(a, b, Span(1_700_000)),
        ];
        Route {
            seq: 1,
            start: Vec2::ZERO,
            pieces: Pieces::from_slice(&pieces).unwrap(),
            room_mm: None,
            neighbours: Default::default(),
        }
    }

    #[test]
    fn it_agrees_with_the_path_at_every_time_in_any_order() {
        let route = route();
        let path = PathRef::new(route.start, &route.pieces);
        let mut cursor = RouteCursor::new(&route);
        for n in 0..2000i64 {
            let time = Span((n * 7919) % 3_200_000);
            cursor.seek(&route, time);
            let (mine, theirs) = (cursor.motion(time), path.at(time));
            assert!(mine.position.distance(theirs.position) < 1e-12);
            assert!(mine.velocity.distance(theirs.velocity) < 1e-9);
            assert!(mine.acceleration.distance(theirs.acceleration) < 1e-9);
        }
    }

    #[test]
    fn a_route_without_pieces_rests_at_its_start() {
        let route = Route {
            seq: 1,
            start: Vec2::new(1.0, 2.0),
            pieces: Pieces::new(),
            room_mm: None,
            neighbours: Default::default(),
        };
        let mut cursor = RouteCursor::new(&route);
        cursor.seek(&route, Span(5));
        assert_eq!(cursor.motion(Span(5)).position, route.start);
    }
}
