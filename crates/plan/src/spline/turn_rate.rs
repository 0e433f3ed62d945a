//! The turn rate of a differential drive: a slow robot must not change its direction fast. Driving back along the same
//! line is not a turn, so a near reversal becomes an exact reversal. A span is one piece of a spline, determined by
//! four successive control points; all spans last equally long.

use lightbots_base::{Limits, Vec2};

use crate::spline::hull::{crosses, halves, squares};
use crate::spline::weights::{blend, fold};

/// Speed below which a robot's direction does not matter, m/s. The proof has the same rule with a higher speed.
const CREEP_MPS: f64 = 0.008;
/// Number of sampled moments of a span.
const MOMENTS: usize = 16;
/// Share of the turn rate limit that is used, because a robot may turn faster between two sampled moments.
const BETWEEN_MOMENTS: f64 = 0.96;
/// If the robot is slower than this share of the speed that its turn needs, the span becomes a reversal instead of a
/// curve.
const REVERSAL: f64 = 0.5;
/// A span is smoothed instead of turned if the three steps between its control points are all shorter than this many
/// times [`TurnRate::creep_m`].
const WIGGLE: f64 = 3.0;
/// Multiple of [`CREEP_MPS`] below which a robot counts as slow. The direction may change during a slow stretch by as
/// much as the turn rate limit allows in the time of that stretch.
const SLOW: f64 = 2.6;
/// Ratio of v² to a², with the span as the unit of time, below which samples do not suffice. Between two of them, the
/// speed may then be over 2 % lower.
const NARROW_SWING: f64 = 0.25;
/// Share of the turn rate limit that is allowed near the stop of a reversal.
const REVERSAL_UNDERCUT: f64 = 0.6;
/// Weights of a span's four control points for its third derivative over time, the jerk.
const JERK: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];
/// Share of the turn rate limit that a correction aims at, so that corrections end.
const UNDERCUT: f64 = 0.97;

/// Motion on a span, with the duration of the span as the unit of time. Velocity is a quadratic function of time.
struct SpanMotion {
    velocity: Vec2,
    acceleration: Vec2,
    jerk: Vec2,
}

impl SpanMotion {
    fn new(four: &[Vec2]) -> Self {
        let velocity = (four[2] - four[0]) * 0.5;
        let acceleration = four[0] - four[1] * 2.0 + four[2];
        Self { velocity, acceleration, jerk: blend(four, &JERK) }
    }

    fn velocity(&self, u: f64) -> Vec2 {
        self.velocity + (self.acceleration + self.jerk * (u * 0.5)) * u
    }

    fn acceleration(&self, u: f64) -> Vec2 {
        self.acceleration + self.jerk * u
    }

    /// One bit for each sampled moment, the first in bit 0: whether the speed there is below `speed_m`, metres per
    /// span.
    fn slow_moments(&self, speed_m: f64) -> u32 {
        let squares: [f64; MOMENTS] =
            std::array::from_fn(|index| self.velocity(moment(index)).length_squared());
        let bits =
            squares.iter().enumerate().map(|(index, &square)| u32::from(square < speed_m * speed_m) << index);
        bits.fold(0, |all, bit| all | bit)
    }

    /// Finds the slowest moment near `u`, by Newton's method on v². Moments are shares of the span, 0 to 1.
    fn slowest(&self, mut u: f64) -> f64 {
        for _ in 0..4 {
            let (v, a) = (self.velocity(u), self.acceleration(u));
            let bend = a.length_squared() + v.dot(self.jerk);
            if bend <= 0.0 {
                break;
            }
            u = (u - v.dot(a) / bend).clamp(0.0, 1.0);
        }
        u
    }
}

/// Weights of a span's four control points for velocity and acceleration at the share `u` of the span, 0 to 1.
fn slopes(u: f64) -> ([f64; 4], [f64; 4]) {
    let w = 1.0 - u;
    let inner = [(3.0 * u * u - 4.0 * u) / 2.0, (-3.0 * u * u + 2.0 * u + 1.0) / 2.0];
    ([-w * w / 2.0, inner[0], inner[1], u * u / 2.0], [w, 3.0 * u - 2.0, 1.0 - 3.0 * u, u])
}

/// The sampled moments, as shares of the span: the middle of each of [`MOMENTS`] equal parts.
fn moments() -> impl Iterator<Item = f64> {
    (0..MOMENTS).map(moment)
}

fn moment(index: usize) -> f64 {
    (index as f64 + 0.5) / MOMENTS as f64
}

/// Spans of a spline that may exceed the turn rate limit.
#[derive(Clone, Copy)]
pub(crate) struct DirtySpans {
    /// One bit for each span.
    spans: u128,
    /// Whether the robot may turn too far while it is slow; [`TurnRate::slow_turn`] then has to check it.
    slow_turns: bool,
}

impl DirtySpans {
    /// All spans.
    pub const ALL: Self = Self { spans: u128::MAX, slow_turns: true };
    /// No spans.
    pub const NOTHING: Self = Self { spans: 0, slow_turns: false };

    /// Whether no span is left.
    pub fn is_over(self) -> bool {
        self.spans == 0
    }

    /// Adds a span whose control points moved, and all spans that share control points with it.
    pub fn add(&mut self, span: usize) {
        self.spans |= (0x7f_u128 << span) >> 3;
        self.slow_turns = true;
    }

    /// Adds the spans whose shape depends on a control point.
    pub fn add_point(&mut self, point: usize) {
        self.spans |= (0xf_u128 << point) >> 3;
        self.slow_turns = true;
    }
}

/// The turn rate limit for spans that all last equally long.
pub(crate) struct TurnRate {
    /// Largest turn that is allowed in the time of a span, radians.
    turn: f64,
    /// Distance that a robot drives at [`CREEP_MPS`] in the time of a span, metres. The direction of shorter steps does
    /// not matter.
    creep_m: f64,
}

impl TurnRate {
    /// The limit for spans of `span_s` seconds.
    pub fn new(span_s: f64, limits: &Limits) -> Self {
        Self { turn: limits.turn_radps * span_s * BETWEEN_MOMENTS, creep_m: CREEP_MPS * span_s }
    }

    /// Deforms a spline once where it turns too fast in the spans of `dirty`, and at the worst turn of a slow stretch.
    /// Returns the spans to check again: those that were changed, and those that share control points with them.
    /// `spare`: as in [`fold`].
    pub fn smooth_turns(&self, spline: &mut [Vec2], spare: bool, dirty: DirtySpans) -> DirtySpans {
        let mut again = DirtySpans::NOTHING;
        let spans = spline.len() - 3;
        if let Some((span, _)) = dirty.slow_turns.then(|| self.slow_turn(spline)).flatten() {
            for span in span.saturating_sub(1)..(span + 2).min(spans) {
                let shifts = smoothed(&spline[span..span + 4], span, spans);
                spline[span..span + 4].iter_mut().zip(shifts).for_each(|(point, shift)| *point += shift);
                again.add(span);
            }
        }
        for span in ones(dirty.spans | again.spans).take_while(|&span| span < spans) {
            let four = &spline[span..span + 4];
            let worst = if self.stays_within(four, self.turn) { None } else { self.fastest(four) };
            let Some((_, fastest)) = worst.filter(|(turn, _)| *turn > self.turn) else { continue };
            let shifts = self.corrected(four, fastest, &|weights| fold(weights, span, spans, spare));
            let shifts = if self.only_wiggles(four) { Some(smoothed(four, span, spans)) } else { shifts };
            for (point, shift) in spline[span..span + 4].iter_mut().zip(shifts.into_iter().flatten()) {
                *point += shift;
            }
            again.add(span);
        }
        again
    }

    /// Returns displacements of a span's four control points that lower its turn rate; `None` if none are needed or
    /// none help. `fastest`: moment of the fastest turn, as a share of the span. `folded`: applies [`fold`] to weights.
    fn corrected(
        &self,
        four: &[Vec2],
        fastest: f64,
        folded: &dyn Fn(&[f64; 4]) -> [f64; 4],
    ) -> Option<[Vec2; 4]> {
        let motion = SpanMotion::new(four);
        let weighted = |u: f64| {
            let (v, a) = slopes(u);
            ((folded(&v), motion.velocity(u)), (folded(&a), motion.acceleration(u)))
        };
        let (v, (_, a)) = weighted(motion.slowest(fastest));
        let nearly_stops = v.1.length() * self.turn < a.length() * REVERSAL;
        let reversed = || self.reversed(four, v, (folded(&JERK), a));
        nearly_stops.then(reversed).flatten().or_else(|| {
            let (v, a) = weighted(fastest);
            self.widened(v, a)
        })
    }

    /// Returns the greatest turn rate of a spline as a multiple of the limit. At 1, the turn rate is just legal. It may
    /// be too low, even 0, for splines that surely keep the limit.
    pub fn time_scale(&self, spline: &[Vec2]) -> f64 {
        let fastest = spline.windows(4).fold(0.0_f64, |most, four| {
            let faster = if self.stays_within(four, most) { None } else { self.fastest(four) };
            faster.map_or(most, |(turn, _)| most.max(turn))
        });
        (fastest / self.turn).max(self.slow_turn(spline).map_or(0.0, |(_, time_scale)| time_scale))
    }

    /// Returns the worst turn of a slow stretch: the span in which the robot is fast again, and its turn. The turn is
    /// given as a multiple of what the time of the stretch allows. `None` if all these turns are legal.
    fn slow_turn(&self, spline: &[Vec2]) -> Option<(usize, f64)> {
        let slow_m = SLOW * self.creep_m;
        let (mut heading, mut slow, mut worst) = (None::<Vec2>, 0.0, None::<(usize, f64)>);
        for (span, four) in spline.windows(4).enumerate() {
            let steps = [four[1] - four[0], four[2] - four[1], four[3] - four[2]];
            if (slow == 0.0 || heading.is_none())
                && squares(&steps).iter().all(|&square| square > slow_m * slow_m)
            {
                (heading, slow) = (Some(steps[1] + steps[2]), 0.0);
                continue;
            }
            if self.stays_below(&steps, slow_m) {
                slow += 1.0;
                continue;
            }
            let motion = SpanMotion::new(four);
            let slow_moments = motion.slow_moments(slow_m);
            let mut at = 0;
            while at < MOMENTS {
                let slow_for = (slow_moments >> at).trailing_ones() as usize;
                slow += slow_for as f64 / MOMENTS as f64;
                at += slow_for;
                if at == MOMENTS {
                    break;
                }
                slow += 1.0 / MOMENTS as f64;
                if let Some(before) = heading.filter(|_| slow > 1.5 / MOMENTS as f64) {
                    let velocity = motion.velocity(moment(at));
                    let angle = Vec2::new(before.dot(velocity).abs(), before.cross(velocity).abs()).angle();
                    let time_scale = angle / (self.turn * slow);
                    if time_scale > 1.0 && worst.is_none_or(|(_, most)| time_scale > most) {
                        worst = Some((span, time_scale));
                    }
                }
                at += ((slow_moments >> at).trailing_zeros() as usize).min(MOMENTS - at);
                (heading, slow) = (Some(motion.velocity(moment(at - 1))), 0.0);
            }
        }
        worst
    }

    /// Returns the greatest turn of a span, radians per span, and its moment as a share of the span. Moments at which
    /// the robot is slower than [`CREEP_MPS`] hardly count. `None` if the span cannot exceed the limit.
    fn fastest(&self, four: &[Vec2]) -> Option<(f64, f64)> {
        if self.is_easy(four) {
            return None;
        }
        let (creep, motion) = (self.creep_m * self.creep_m, SpanMotion::new(four));
        let mut worst = (0.0, 0.5);
        let mut squares = [f64::MAX; MOMENTS + 2];
        let (mut swings, mut hardest) = ([0.0; MOMENTS], [0.0; MOMENTS]);
        for (index, u) in moments().enumerate() {
            let (v, a) = (motion.velocity(u), motion.acceleration(u));
            squares[index + 1] = v.length_squared();
            swings[index] = v.cross(a).abs();
            hardest[index] = a.length_squared();
        }
        for (index, u) in moments().enumerate() {
            let [before, here, after] = [squares[index], squares[index + 1], squares[index + 2]];
            if here > creep && swings[index] > worst.0 * here {
                worst = (swings[index] / here, u);
            }
            if here <= before && here <= after && here < hardest[index] * NARROW_SWING {
                // The fastest turns fall between two moments.
                let u = motion.slowest(u);
                let (v, a) = (motion.velocity(u), motion.acceleration(u));
                let turn = v.cross(a).abs() / v.length_squared().max(creep);
                worst = if turn > worst.0 { (turn, u) } else { worst };
            }
        }
        Some(worst)
    }

    /// Whether the steps between a span's control points are so short that the span is smoothed instead of turned or
    /// reversed.
    fn only_wiggles(&self, four: &[Vec2]) -> bool {
        four.windows(2).all(|step| step[0].distance(step[1]) < WIGGLE * self.creep_m)
    }

    /// Whether the convex hull of a span's velocity shows, without sampling, that the span keeps the limit.
    fn is_easy(&self, four: &[Vec2]) -> bool {
        let steps = [four[1] - four[0], four[2] - four[1], four[3] - four[2]];
        let along = steps[1];
        let square = along.length_squared();
        let slowest = along.dot(steps[0]).min(along.dot(steps[2])).min(square);
        let swing = (steps[1] - steps[0]).length_squared().max((steps[2] - steps[1]).length_squared());
        let may = slowest * self.turn;
        (slowest > 0.0 && swing * square <= may * may) || self.stays_below(&steps, self.creep_m)
    }

    /// Whether a span surely turns by at most `turn` radians per span, or keeps the limit. turn · v² − |v × a| is a
    /// polynomial. It is nowhere below the least of its Bernstein coefficients, nor below those of its halves, which
    /// are closer bounds.
    fn stays_within(&self, four: &[Vec2], turn: f64) -> bool {
        if self.is_easy(four) {
            return true;
        }
        let steps = [four[1] - four[0], four[2] - four[1], four[3] - four[2]];
        let (may, does) = (squares(&steps).map(|square| square * turn), crosses(&steps));
        let is_positive = |half: &[f64; 5]| half.iter().all(|&coefficient| coefficient >= 0.0);
        may.iter().zip(&does).all(|(may, does)| does.abs() <= *may)
            || [1.0, -1.0]
                .into_iter()
                .all(|side| halves(std::array::from_fn(|i| may[i] - does[i] * side)).iter().all(is_positive))
    }

    /// Whether a span's speed stays below `speed_m` metres per span, by the convex hull of its steps.
    fn stays_below(&self, steps: &[Vec2; 3], speed_m: f64) -> bool {
        steps.iter().all(|step| step.length_squared() < speed_m * speed_m)
    }

    /// Returns displacements of control points after which |v × a| ≤ turn · v², to first order. `None` if that holds
    /// already, or control points have no influence on it. `v` and `a`: the weights of the control points, and the
    /// velocity and acceleration.
    fn widened(&self, v: ([f64; 4], Vec2), a: ([f64; 4], Vec2)) -> Option<[Vec2; 4]> {
        let ((v_weights, v), (a_weights, a)) = (v, a);
        let cross = v.cross(a);
        let excess = cross.abs() - self.turn * UNDERCUT * v.length_squared();
        let slope: [Vec2; 4] = std::array::from_fn(|i| {
            let (vw, aw) = (v_weights[i], a_weights[i]);
            let of_cross = Vec2::new(vw * a.y - aw * v.y, aw * v.x - vw * a.x);
            of_cross * cross.signum() - v * (2.0 * self.turn * vw)
        });
        let steep = slope.iter().map(|s| s.length_squared()).sum::<f64>().sqrt();
        if excess <= 0.0 || steep < 1e-12 {
            return None;
        }
        // The first-order estimate does not reach beyond about the speed itself.
        let far = (excess / steep).min(v.length() * 0.5 + self.creep_m);
        Some(slope.map(|s| s * (-far / steep)))
    }

    /// Returns the least displacements of control points that turn a near stop into a reversal. At a reversal, the
    /// velocity has no component perpendicular to the acceleration, and the perpendicular jerk is small: the path
    /// returns along itself. Near a stop, the turn rate is half the perpendicular jerk divided by the acceleration.
    /// `v`: weights and value of the velocity. `jerk`: weights of the jerk, and the acceleration. `None` if the span is
    /// a reversal already, or the acceleration is zero.
    fn reversed(&self, four: &[Vec2], v: ([f64; 4], Vec2), jerk: ([f64; 4], Vec2)) -> Option<[Vec2; 4]> {
        let ((v_weights, v), (j_weights, a)) = (v, jerk);
        let across = a.normalized()?.left();
        let slow_turn = blend(four, &JERK).dot(across);
        let may = 2.0 * self.turn * a.length() * REVERSAL_UNDERCUT;
        let (v_lack, j_lack) = (-v.dot(across), slow_turn.clamp(-may, may) - slow_turn);
        if v_lack.abs() < self.creep_m * 0.0025 && j_lack == 0.0 {
            return None;
        }
        let dot = |one: &[f64; 4], other: &[f64; 4]| one.iter().zip(other).map(|(a, b)| a * b).sum::<f64>();
        let (vv, vj) = (dot(&v_weights, &v_weights) + 1e-6, dot(&v_weights, &j_weights));
        let jj = dot(&j_weights, &j_weights) + 1e-6;
        let whole = vv * jj - vj * vj;
        let (v_force, j_force) = ((v_lack * jj - j_lack * vj) / whole, (j_lack * vv - v_lack * vj) / whole);
        Some(std::array::from_fn(|i| across * (v_weights[i] * v_force + j_weights[i] * j_force)))
    }
}

/// Indices of the set bits, the least first.
fn ones(mut bits: u128) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let least = bits.trailing_zeros();
        bits &= bits.wrapping_sub(1);
        (least < u128::BITS).then_some(least as usize)
    })
}

/// Displacements of a span's two middle control points, as far as they are free, towards the middle of their
/// neighbours. `last`: index of the spline's last free point.
fn smoothed(four: &[Vec2], span: usize, last: usize) -> [Vec2; 4] {
    std::array::from_fn(|i| {
        let inner = (1..3).contains(&i) && (2..=last).contains(&(span + i));
        if inner { (four[i - 1] + four[i + 1] - four[i] * 2.0) * 0.25 } else { Vec2::ZERO }
    })
}

#[cfg(test)]
#[path = "turn_rate_tests.rs"]
mod tests;
