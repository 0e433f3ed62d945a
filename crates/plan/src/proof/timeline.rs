//! Paths as pieces with times, so that two paths can be compared moment by moment.

use super::curve::{Cubic, nearest, part, point};
use crate::Path;
use lightbots_base::Vec2;

/// One piece of a path, and the time in which it is driven.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// Begin of the piece, microseconds after the transition's start; less than `end_us`.
    pub begin_us: i64,
    /// End of the piece, microseconds after the transition's start.
    pub end_us: i64,
    /// Control points, stage metres.
    pub curve: Cubic,
}

impl Stretch {
    /// The curve between two moments within the piece, microseconds after the transition's start.
    pub fn between(&self, from_us: i64, to_us: i64) -> Cubic {
        if (from_us, to_us) == (self.begin_us, self.end_us) {
            return self.curve;
        }
        let length = (self.end_us - self.begin_us) as f64;
        let share = |at_us: i64| (at_us - self.begin_us) as f64 / length;
        part(&self.curve, share(from_us), share(to_us))
    }

    /// Length of the control polygon, metres: the curve is no longer.
    pub fn polygon_m(&self) -> f64 {
        self.curve.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }
}

/// Adds the pieces of one path to `into`, without gaps from 0 to `horizon_us`. A path that ends earlier gets a rest at
/// its end.
pub(super) fn stretches(path: &Path, horizon_us: i64, into: &mut Vec<Stretch>) {
    let (mut start, mut begin_us) = (path.start, 0i64);
    for piece in &path.pieces {
        let end_us = begin_us.saturating_add(piece.duration.0.max(0));
        if end_us > begin_us {
            into.push(Stretch { begin_us, end_us, curve: [start, piece.c1, piece.c2, piece.end] });
        }
        start = piece.end;
        begin_us = end_us;
    }
    if begin_us < horizon_us || begin_us == 0 {
        into.push(Stretch { begin_us, end_us: horizon_us.max(1), curve: [start; 4] });
    }
}

/// Finds the closest approach of two robots from `from_us` to `to_us`, if they come closer than `enough` metres.
/// Returns the distance, the moment in microseconds after the transition's start, and the place half way between the
/// two centres.
pub(super) fn closest(
    a: &[Stretch],
    b: &[Stretch],
    from_us: i64,
    to_us: i64,
    enough: f64,
) -> Option<(f64, i64, Vec2)> {
    let (mut i, mut j, mut now_us) = (0, 0, from_us);
    let (mut least, mut found) = (enough, None);
    while now_us < to_us && i < a.len() && j < b.len() {
        let until_us = a[i].end_us.min(b[j].end_us).min(to_us);
        if until_us > now_us {
            let (p, q) = (a[i].between(now_us, until_us), b[j].between(now_us, until_us));
            let relative = [p[0] - q[0], p[1] - q[1], p[2] - q[2], p[3] - q[3]];
            if let Some((distance, u)) = nearest(&relative, least) {
                least = distance;
                let at_us = now_us + ((until_us - now_us) as f64 * u).round() as i64;
                found = Some((distance, at_us, point(&p, u).lerp(point(&q, u), 0.5)));
            }
            now_us = until_us;
        }
        i += usize::from(a[i].end_us <= now_us);
        j += usize::from(b[j].end_us <= now_us);
    }
    found
}
