//! Displaces a timed path sideways or lengthwise for some time. The progress along the path stays the same.

use crate::Path;
use lightbots_base::{Piece, Span, Vec2};

/// Least time between two knots, and between a knot and the beginning or the end of the drive, microseconds.
const APART_US: i64 = 200_000;

/// Displacements of a path at some moments (knots), with a smooth transition between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Displacements {
    /// Each knot: a moment after the start of the path, microseconds, and the displacement at it, metres along the
    /// stage axes. Sorted by moment.
    knots: Vec<(i64, Vec2)>,
}

impl Displacements {
    /// Adds the displacement `offset`, metres, at a moment after the start of the path. If a knot is nearer than 0.2 s,
    /// the offset is added to that knot instead.
    pub(crate) fn push(&mut self, at: Span, offset: Vec2) {
        // Messages carry whole milliseconds without loss.
        let at_us = at.0 / 1000 * 1000;
        let rank = self.knots.partition_point(|knot| knot.0 < at_us);
        let near = |rank: usize| self.knots.get(rank).is_some_and(|knot| (knot.0 - at_us).abs() < APART_US);
        if near(rank) {
            self.knots[rank].1 += offset;
        } else if rank > 0 && near(rank - 1) {
            self.knots[rank - 1].1 += offset;
        } else {
            self.knots.insert(rank, (at_us, offset));
        }
    }

    /// Returns `path` with these displacements. Its first rest, its start, its end and its duration stay the same.
    /// Knots nearer than 0.2 s to the end of the first rest or to the end of the path are left out.
    pub(crate) fn applied_to(&self, path: &Path) -> Path {
        let rest = path
            .pieces
            .first()
            .filter(|piece| piece.is_rest(path.start))
            .map_or(Span::ZERO, |piece| piece.duration);
        let total = path.as_ref().duration();
        let mut knots = vec![(rest.0, Vec2::ZERO)];
        let within = |knot: &&(i64, Vec2)| knot.0 >= rest.0 + APART_US && knot.0 <= total.0 - APART_US;
        knots.extend(self.knots.iter().filter(within));
        knots.push((total.0, Vec2::ZERO));
        let mut pieces = Vec::new();
        for (start, begin, piece) in path.as_ref().timed() {
            let (begin_us, end_us) = (begin.0, begin.0 + piece.duration.0);
            if end_us <= rest.0 {
                pieces.push(*piece);
                continue;
            }
            let mut from_us = begin_us;
            for pair in knots.windows(2).filter(|pair| pair[1].0 > begin_us && pair[0].0 < end_us) {
                let to_us = pair[1].0.min(end_us);
                let way = part([start, piece.c1, piece.c2, piece.end], begin_us, end_us, from_us, to_us);
                let [(t0, w0), (t1, w1)] = [pair[0], pair[1]];
                let aside = part([w0, w0, w1, w1], t0, t1, from_us, to_us);
                pieces.push(Piece {
                    duration: Span(to_us - from_us),
                    c1: way[1] + aside[1],
                    c2: way[2] + aside[2],
                    end: way[3] + aside[3],
                });
                from_us = to_us;
            }
        }
        Path { start: path.start, pieces }
    }
}

/// Control points of the part `from_us..to_us` of a cubic that lasts from `begin_us` to `end_us`.
fn part(curve: [Vec2; 4], begin_us: i64, end_us: i64, from_us: i64, to_us: i64) -> [Vec2; 4] {
    let (mut curve, length) = (curve, (end_us - begin_us) as f64);
    if to_us < end_us {
        curve = halves(curve, (to_us - begin_us) as f64 / length).0;
    }
    if from_us > begin_us {
        curve = halves(curve, (from_us - begin_us) as f64 / (to_us - begin_us) as f64).1;
    }
    curve
}

/// Splits a cubic at the parameter `u` into the parts before and after it (de Casteljau).
fn halves([a, b, c, d]: [Vec2; 4], u: f64) -> ([Vec2; 4], [Vec2; 4]) {
    let (ab, bc, cd) = (a.lerp(b, u), b.lerp(c, u), c.lerp(d, u));
    let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
    let middle = abc.lerp(bcd, u);
    ([a, ab, abc, middle], [middle, bcd, cd, d])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Profile;
    use lightbots_base::Limits;
    use lightbots_show::Easing;

    #[test]
    fn a_bent_path_passes_aside_and_arrives_where_and_when_it_did() {
        let to = Vec2::new(1.0, 0.0);
        let straight = Profile::quickest(1.0, Easing::Swift, &Limits::ELISA_3).path(Vec2::ZERO, to);
        let mut displacement = Displacements::default();
        let (early, late) = (Span::from_millis(1_500), Span::from_millis(3_000));
        displacement.push(early, Vec2::new(0.0, 0.004));
        displacement.push(early + Span::from_millis(50), Vec2::new(0.0, 0.002));
        displacement.push(late, Vec2::new(0.0, -0.005));
        let bent = displacement.applied_to(&straight);
        assert_eq!(bent.as_ref().duration(), straight.as_ref().duration());
        assert_eq!(bent.as_ref().end(), to);
        assert!((bent.as_ref().at(early).position.y - 0.006).abs() < 1e-9);
        assert!((bent.as_ref().at(late).position.y + 0.005).abs() < 1e-9);
        for millis in 0..4_000 {
            let at = Span::from_millis(millis);
            let (was, is) = (straight.as_ref().at(at), bent.as_ref().at(at));
            assert!((was.position.x - is.position.x).abs() < 1e-9);
            assert!((was.velocity.x - is.velocity.x).abs() < 1e-9);
            assert!(is.velocity.y.abs() < 0.02);
        }
    }
}
