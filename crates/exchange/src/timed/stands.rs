//! When all robots of a file stand.

use super::TimedShow;

/// Shortest time for which all robots must stand so that their places count as a picture, seconds.
const SEEN_S: f64 = 0.4;

/// A stretch of time in which no robot moves, seconds from the start of the show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stand {
    pub begin_s: f64,
    pub end_s: f64,
}

/// The stretches of at least [`SEEN_S`] in which all robots stand, in order. The last one begins when the last robot
/// stops, ends at `end_s`, and may be shorter. The first one begins at 0 only if no robot moves within the first
/// [`SEEN_S`].
pub(super) fn stands(show: &TimedShow, end_s: f64) -> Vec<Stand> {
    let mut moves: Vec<(f64, f64)> = show.robots.iter().flat_map(|robot| robot.path.moves()).collect();
    moves.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let mut stands = Vec::new();
    let mut still_from_s = 0.0_f64;
    for (from_s, to_s) in moves {
        if from_s - still_from_s >= SEEN_S {
            stands.push(Stand { begin_s: still_from_s, end_s: from_s });
        }
        still_from_s = still_from_s.max(to_s);
    }
    stands.push(Stand { begin_s: still_from_s, end_s: end_s.max(still_from_s) });
    stands
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timed::TimedRobot;
    use crate::timed::path::TimedPath;
    use lightbots_base::Vec2;
    use lightbots_show::TrajectoryPiece;

    fn robot(pieces: &[(f64, f64)]) -> TimedRobot {
        let piece =
            |&(end_s, x): &(f64, f64)| TrajectoryPiece { end_s, controls: None, end: Vec2::new(x, 0.0) };
        let pieces = pieces.iter().map(piece).collect();
        TimedRobot { path: TimedPath { pieces, ..TimedPath::default() }, ..TimedRobot::default() }
    }

    #[test]
    fn all_robots_must_stand_for_long_enough() {
        let robots =
            vec![robot(&[(1.0, 0.0), (2.0, 1.0)]), robot(&[(2.3, 0.0), (4.0, 1.0), (9.0, 1.0), (9.5, 2.0)])];
        let show = TimedShow { robots, ..TimedShow::default() };
        let stand = |begin_s, end_s| Stand { begin_s, end_s };
        assert_eq!(stands(&show, 10.0), [stand(0.0, 1.0), stand(4.0, 9.0), stand(9.5, 10.0)]);
        assert_eq!(stands(&TimedShow::default(), 0.0), [stand(0.0, 0.0)]);
    }
}
