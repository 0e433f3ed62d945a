//! Look-ahead on slow parts of a route. Near a stop, the tangent of the route turns faster than a robot can, or
//! reverses. So the robot turns to the look-ahead direction: the direction in which the route drives off after the slow
//! part.

use lightbots_base::{Span, Vec2};
use lightbots_wire::Route;

use crate::cursor::from;

/// Below this speed a route is slow, m/s. The proof of a plan uses the same bound (`CREEP_MPS` of its module `course`).
/// With a larger value, a robot turns away from the tangent of faster parts of its route.
pub(crate) const SLOW_MPS: f64 = 0.02;
/// How far the look-ahead looks ahead on the route, path time. With a smaller value, a robot begins its turn too late.
/// With a larger value, the robot turns away while the route still moves.
const HORIZON: Span = Span::from_millis(480);
/// Time between two samples of the route: a step of the control loop.
const STEP: Span = Span::from_millis(16);
/// If the route stays slow within the horizon, the direction of its fastest moment is taken. The speed must then be
/// more than this multiple of the present speed.
const MUCH_FASTER: f64 = 2.0;

/// The look-ahead direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ahead {
    /// Unit vector of the direction, in the stage.
    pub towards: Vec2,
    /// Path time until the route travels in this direction, seconds.
    pub within_s: f64,
}

/// The latest look-ahead, kept until it is outdated.
#[derive(Debug, Default)]
pub(crate) struct LookAhead {
    /// First path time for which `towards` is valid.
    from: Span,
    /// Path time at which `towards` is outdated: if there is a direction, when the route drives off.
    until: Span,
    towards: Option<Vec2>,
}

impl LookAhead {
    /// The look-ahead direction at the path time `time`, which is within piece `index` of the route; this piece begins
    /// at the path time `begin`. `None` if, within [`HORIZON`], the route ends or stays about as slow as it is now.
    pub(crate) fn look(&mut self, route: &Route, (index, begin): (usize, Span), time: Span) -> Option<Ahead> {
        if time < self.from || time >= self.until {
            (self.from, self.until, self.towards) = (time, time + HORIZON / 2, None);
            if let Some((at, towards)) = drives_off(route, (index, begin), time) {
                (self.until, self.towards) = (at, Some(towards));
            }
        }
        let within_s = (self.until - time).as_secs();
        self.towards.map(|towards| Ahead { towards, within_s })
    }
}

/// Path time at which a route drives off after `time`, and its direction then. If the route stays slow, the moment at
/// which it becomes much faster than at first. `None` if neither comes within [`HORIZON`], counted from the end of a
/// rest at the beginning.
fn drives_off(route: &Route, (index, begin): (usize, Span), time: Span) -> Option<(Span, Vec2)> {
    let mut start = from(route, index);
    let (mut begin, mut now, mut horizon) = (begin, time.max(begin), time + HORIZON);
    let (mut first, mut fastest) = (None, (now, Vec2::ZERO));
    for piece in route.pieces.get(index..)? {
        let end = begin + piece.duration;
        if piece.is_rest(start) {
            // Before a rest the direction into it counts, and from the rest on the direction out of it.
            if first.is_some() {
                break;
            }
            (now, horizon) = (end, end + HORIZON);
        }
        while now < end && now < horizon {
            let velocity = piece.at(start, now - begin).velocity;
            let speed = velocity.length();
            let first = *first.get_or_insert(speed);
            if speed >= SLOW_MPS {
                return Some((now, velocity / speed));
            }
            if speed > fastest.1.length() && speed > MUCH_FASTER * first {
                fastest = (now, velocity);
            }
            now += STEP;
        }
        if now >= horizon {
            break;
        }
        (start, begin) = (piece.end, end);
    }
    fastest.1.normalized().map(|towards| (fastest.0, towards))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Piece;
    use lightbots_wire::Pieces;

    /// One second: the duration of most pieces here.
    const SECOND: Span = Span(1_000_000);

    fn route(pieces: &[Piece]) -> Route {
        Route {
            seq: 1,
            start: Vec2::ZERO,
            pieces: Pieces::from_slice(pieces).unwrap(),
            room_mm: None,
            neighbours: Default::default(),
        }
    }

    fn look(route: &Route, index: usize, begin: i64, time: i64) -> Option<(Vec2, f64)> {
        let ahead = LookAhead::default().look(route, (index, Span(begin)), Span(time))?;
        Some((ahead.towards, ahead.within_s))
    }

    #[test]
    fn it_looks_past_rests_but_not_before_it_rests() {
        let (a, b) = (Vec2::new(0.0, 0.2), Vec2::new(0.2, 0.2));
        let gentle = |from: Vec2, to: Vec2| Piece { duration: SECOND, c1: from, c2: to, end: to };
        let rest = |at| Piece::rest(at, SECOND);
        let route =
            route(&[rest(Vec2::ZERO), rest(Vec2::ZERO), gentle(Vec2::ZERO, a), rest(a), gentle(a, b)]);
        let (towards, within_s) = look(&route, 0, 0, 0).unwrap();
        assert!(towards.distance(Vec2::new(0.0, 1.0)) < 1e-9 && (2.0..2.1).contains(&within_s));
        assert_eq!(look(&route, 2, 2_000_000, 2_990_000), None);
        assert!(look(&route, 3, 3_000_000, 3_000_000).unwrap().0.distance(Vec2::new(1.0, 0.0)) < 1e-9);
        assert_eq!(look(&route, 4, 4_000_000, 4_990_000), None);
        assert_eq!(look(&route, 5, 5_000_000, 5_000_000), None);
    }

    #[test]
    fn at_a_reversal_it_sees_the_way_back() {
        let there =
            Piece { duration: SECOND, c1: Vec2::new(0.1, 0.0), c2: Vec2::new(0.1, 0.0), end: Vec2::ZERO };
        let (towards, within_s) = look(&route(&[there]), 0, 0, 495_000).unwrap();
        assert!(towards.distance(Vec2::new(-1.0, 0.0)) < 1e-9 && within_s < 0.1);
    }

    #[test]
    fn a_route_that_only_crawls_says_where_it_crawls_faster() {
        let back = Vec2::new(0.0, 0.002);
        let slow = Piece { duration: SECOND, c1: back, c2: back, end: Vec2::ZERO };
        assert!(look(&route(&[slow]), 0, 0, 490_000).unwrap().0.distance(Vec2::new(0.0, -1.0)) < 1e-9);
        let even = Piece::straight(Vec2::ZERO, Vec2::new(0.01, 0.0), SECOND);
        assert_eq!(look(&route(&[even]), 0, 0, 100_000), None);
        let faster = Piece::straight(Vec2::ZERO, Vec2::new(0.1, 0.0), SECOND);
        assert_eq!(look(&route(&[faster]), 0, 0, 100_000), Some((Vec2::new(1.0, 0.0), 0.0)));
    }

    #[test]
    fn what_was_seen_is_kept_until_it_comes() {
        let piece =
            Piece { duration: SECOND, c1: Vec2::ZERO, c2: Vec2::new(0.0, 0.2), end: Vec2::new(0.2, 0.2) };
        let (route, mut look_ahead) = (route(&[piece]), LookAhead::default());
        let first = look_ahead.look(&route, (0, Span::ZERO), Span::ZERO).unwrap();
        let then = look_ahead.look(&route, (0, Span::ZERO), Span(10_000)).unwrap();
        assert_eq!(first.towards, then.towards);
        assert!((first.within_s - then.within_s - 0.01).abs() < 1e-9);
    }
}
