//! Approximates curves by points. The arithmetic uses only the four basic operations and square roots, which give the
//! same bits on every machine. Libraries for this use powers and logarithms of the system, which differ.

use lightbots_base::Vec2;

/// Largest distance between a curve and its chords, in cap heights. Robots cannot show smaller details.
const TOLERANCE: f64 = 0.005;

/// Largest number of points of one curve: enough for a half circle of 40 cap heights.
const STEPS_MAX: f64 = 200.0;

/// Two points nearer than this, in cap heights, are one point.
const SAME: f64 = 1e-9;

/// An outline to which lines and curves are added one after the other. All methods that add take `most`, the largest
/// number of points of the whole outline.
#[derive(Default)]
pub(super) struct Curve {
    rings: Vec<Vec<Vec2>>,
    points: usize,
    full: bool,
}

impl Curve {
    /// Whether points were left out because there were too many.
    pub(super) fn is_full(&self) -> bool {
        self.full
    }

    /// Begins a ring.
    pub(super) fn move_to(&mut self, to: Vec2, most: usize) {
        self.rings.push(Vec::new());
        self.push(to, most);
    }

    /// Adds a straight line.
    pub(super) fn line_to(&mut self, to: Vec2, most: usize) {
        self.push(to, most);
    }

    /// Adds a quadratic Bézier curve.
    pub(super) fn quad_to(&mut self, control: Vec2, to: Vec2, most: usize) {
        let from = self.last();
        let steps = steps((from - control * 2.0 + to).length() * 2.0);
        for step in 1..=steps {
            let t = step as f64 / steps as f64;
            let (a, b) = (from.lerp(control, t), control.lerp(to, t));
            self.push(if step == steps { to } else { a.lerp(b, t) }, most);
        }
    }

    /// Adds a cubic Bézier curve.
    pub(super) fn cubic_to(&mut self, a: Vec2, b: Vec2, to: Vec2, most: usize) {
        let from = self.last();
        let bend = (from - a * 2.0 + b).length().max((a - b * 2.0 + to).length()) * 6.0;
        let steps = steps(bend);
        for step in 1..=steps {
            let t = step as f64 / steps as f64;
            let (p, q, r) = (from.lerp(a, t), a.lerp(b, t), b.lerp(to, t));
            self.push(if step == steps { to } else { p.lerp(q, t).lerp(q.lerp(r, t), t) }, most);
        }
    }

    /// Returns the rings. The first point of a ring is not repeated at its end. Rings of fewer than three points are
    /// left out.
    pub(super) fn into_rings(self) -> Vec<Vec<Vec2>> {
        let closed = self.rings.into_iter().map(|mut ring| {
            while ring.len() > 1 && ring[0].distance(ring[ring.len() - 1]) < SAME {
                ring.pop();
            }
            ring
        });
        closed.filter(|ring| ring.len() >= 3).collect()
    }

    fn last(&self) -> Vec2 {
        self.rings.last().and_then(|ring| ring.last()).copied().unwrap_or(Vec2::ZERO)
    }

    fn push(&mut self, point: Vec2, most: usize) {
        if self.points >= most {
            self.full = true;
            return;
        }
        if self.rings.is_empty() {
            self.rings.push(Vec::new());
        }
        let Some(ring) = self.rings.last_mut() else { return };
        if ring.last().is_none_or(|last| last.distance(point) >= SAME) {
            ring.push(point);
            self.points += 1;
        }
    }
}

/// Number of straight pieces for a curve whose second derivative is at most `bend`. With n pieces the error is at most
/// bend / (8 n²). At most about [`STEPS_MAX`] pieces are used, so that the error of a huge curve is larger than
/// [`TOLERANCE`].
fn steps(bend: f64) -> usize {
    let wanted = (bend / (8.0 * TOLERANCE)).sqrt();
    if wanted > 1.0 { wanted.min(STEPS_MAX) as usize + 1 } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_circle_stays_within_the_tolerance() {
        let k = 0.552_284_75;
        let mut curve = Curve::default();
        curve.move_to(Vec2::new(1.0, 0.0), 1_000);
        curve.cubic_to(Vec2::new(1.0, k), Vec2::new(k, 1.0), Vec2::new(0.0, 1.0), 1_000);
        curve.line_to(Vec2::ZERO, 1_000);
        let rings = curve.into_rings();
        let arc = &rings[0][..rings[0].len() - 1];
        for pair in arc.windows(2) {
            assert!(1.0 - pair[0].lerp(pair[1], 0.5).length() < TOLERANCE * 1.1);
        }
        assert!((4..12).contains(&arc.len()), "{} points", arc.len());
    }

    #[test]
    fn a_ring_that_is_too_long_says_so() {
        let mut curve = Curve::default();
        curve.move_to(Vec2::ZERO, 3);
        for step in 1..5 {
            curve.line_to(Vec2::new(f64::from(step), 0.0), 3);
        }
        assert!(curve.is_full());
    }
}
