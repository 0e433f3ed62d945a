//! Keeping apart: who sees a neighbour much nearer than the plan leaves room gives way a few millimetres.
//!
//! A robot is off its route by what its sensors are wrong, two neighbours by the sum of both; their proximity sensors
//! tell them far better how near they are than both their places do. Both give way, each a part of what is missing.

use lightbots_base::Vec2;

use super::Reflex;
use super::sight::{PAST, SENSORS};

/// More room than this is as good as any, and where nobody tells there is this, metres.
const MOST_M: f32 = 0.008;
const UNTOLD_M: f32 = 0.003;
/// Less room than this is left only on the way out of a tight corner: it may as well be more, metres.
const LEAST_M: f32 = 0.003;
/// It gives way by this share of what is missing; more where little is left, but never more than so many metres.
const GIVE: f32 = 0.7;
const GIVE_MOST_M: f32 = 0.008;
/// What comes no faster than this, m/s, counts as near as it will be so much later, seconds.
const DRIFTING_MPS: f32 = 0.1;
const SOON_S: f32 = 0.1;
/// So little left that it gives way twice as far as where as much is missing from plenty, metres.
const LITTLE_M: f32 = 0.0015;

/// If one in line with it dies, the one behind drives on for so long at its speed, seconds: two or three steps until that is
/// sure, one until wheels answer, and the braking.
const STOP_S: f32 = 0.065;
/// In line is who is ahead or behind by this at least (cosine of the angle to its way).
const IN_LINE: f32 = 0.5;
/// It falls behind or runs ahead by so many times what is missing to that way, but never by more than so many metres.
const LAG: f32 = 1.5;
const LAG_MOST_M: f32 = 0.006;

impl Reflex {
    /// How far, and where to in body space, it gives way to neighbours; metres, zero where nobody is too near.
    /// `room_mm`: how far others stay away by plan; `speed_mps`: how fast it drives along its front.
    #[inline]
    pub(crate) fn give_way(&self, room_mm: Option<u16>, speed_mps: f64) -> Vec2 {
        if self.sight.sees { self.away(room_mm, speed_mps as f32) } else { Vec2::ZERO }
    }

    /// How much farther, metres, it would rather be from one in line with it that keeps pace, so that whichever is behind
    /// could stop if the other died. The plan does not see to that: who follows at the same speed is never nearer.
    fn lag_m(&self, sensor: usize, in_line: f32, speed_mps: f32) -> f32 {
        let keeps_pace =
            || self.sight.closing(sensor, PAST).is_some_and(|closing| closing.sure_mps <= DRIFTING_MPS);
        if in_line < IN_LINE || !keeps_pace() {
            return 0.0;
        }
        let needed_m = STOP_S * speed_mps.abs() * in_line;
        (LAG * (needed_m - self.sight.mean_gap_m(sensor))).clamp(0.0, LAG_MOST_M)
    }

    /// How much nearer what a sensor sees will be soon, for sure: only slowly, as those on ways that cross come near fast
    /// by plan.
    fn drift_m(&self, sensor: usize) -> f32 {
        let sure_mps = self.sight.closing(sensor, PAST).map_or(0.0, |closing| closing.sure_mps);
        if (0.0..DRIFTING_MPS).contains(&sure_mps) { sure_mps * SOON_S } else { 0.0 }
    }

    fn away(&self, room_mm: Option<u16>, speed_mps: f32) -> Vec2 {
        let room_m = room_mm.map_or(UNTOLD_M, |room_mm| (f32::from(room_mm) * 1e-3).clamp(LEAST_M, MOST_M));
        let now = self.sight.now_m();
        let mut away = Vec2::ZERO;
        for sensor in 0..SENSORS {
            // One neighbour is in sight of two sensors: the nearer of them counts.
            let (left, right) = ((sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS);
            if now[sensor] <= now[left] && now[sensor] < now[right] {
                let gap_m = self.sight.gap_m(sensor);
                let missing_m = (room_m - gap_m + self.drift_m(sensor)).max(0.0);
                let way_m = (GIVE * missing_m * (1.0 + LITTLE_M / gap_m.max(1e-4))).min(GIVE_MOST_M);
                let towards = Vec2::unit(self.sight.towards(sensor));
                let lag_m = self.lag_m(sensor, towards.x.abs() as f32, speed_mps);
                away -= towards * f64::from(way_m.max(lag_m));
            }
        }
        away
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: f32 = f32::INFINITY;

    fn seeing(gaps_m: [f32; SENSORS]) -> Reflex {
        let mut reflex = Reflex::new();
        reflex.look(Some(&gaps_m), 0.004, 0.016);
        reflex
    }

    #[test]
    fn it_gives_way_to_who_is_nearer_than_planned_and_to_nobody_else() {
        let left = |gap_m: f32| seeing([NONE, gap_m + 0.012, gap_m, gap_m + 0.012, NONE, NONE, NONE, NONE]);
        let away = left(0.004).give_way(Some(8), 0.0);
        assert!((away.y + 0.7 * 0.004 * 1.375).abs() < 1e-4 && away.x.abs() < 4e-4, "{away:?}");
        assert_eq!(left(0.004).give_way(Some(500), 0.0), away);
        assert_eq!(
            (left(0.004).give_way(Some(4), 0.0), left(0.004).give_way(None, 0.0)),
            (Vec2::ZERO, Vec2::ZERO)
        );
        assert_eq!(Reflex::new().give_way(Some(8), 0.0), Vec2::ZERO);
        assert!((left(0.0).give_way(Some(8), 0.0).length() - 0.008).abs() < 1e-6);
    }

    #[test]
    fn who_stands_between_two_sensors_is_one() {
        let away = seeing([0.0086, 0.0086, NONE, NONE, NONE, NONE, NONE, NONE]).give_way(Some(8), 0.0);
        let middle = Vec2::unit(core::f64::consts::FRAC_PI_8);
        assert!((away.normalized().unwrap() + middle).length() < 1e-6, "{away:?}");
        assert!((away.length() - 0.7 * 0.003 * 1.3).abs() < 1e-5, "{away:?}");
    }

    #[test]
    fn from_one_in_line_that_keeps_pace_it_keeps_far_enough_to_stop() {
        let ahead = |gap_m: f32| [gap_m, NONE, NONE, NONE, NONE, NONE, NONE, NONE];
        let pacing = |gaps_m: [f32; SENSORS]| {
            let mut reflex = seeing(gaps_m);
            reflex.look(Some(&gaps_m), 0.004, 0.016);
            reflex
        };
        let lag_m = |gap_m: f32, speed_mps: f64| pacing(ahead(gap_m)).give_way(Some(8), speed_mps).x;
        assert_eq!(lag_m(0.009, 0.27), f64::from(-LAG_MOST_M));
        assert!((lag_m(0.016, 0.27) + 1.5 * (0.065 * 0.27 - 0.016)).abs() < 1e-6, "{}", lag_m(0.016, 0.27));
        assert_eq!((lag_m(0.018, 0.27), lag_m(0.009, 0.05), lag_m(0.009, 0.0)), (0.0, 0.0, 0.0));
        let behind = pacing([NONE, NONE, NONE, NONE, 0.009, NONE, NONE, NONE]);
        assert!(behind.give_way(Some(8), 0.27).x > 0.005 && behind.give_way(Some(8), -0.27).x > 0.005);
        let beside = pacing([NONE, NONE, 0.009, NONE, NONE, NONE, NONE, NONE]);
        assert_eq!(beside.give_way(Some(8), 0.27), Vec2::ZERO);
    }

    #[test]
    fn between_two_neighbours_it_stays() {
        let both = seeing([NONE, 0.016, 0.004, 0.016, NONE, 0.016, 0.004, 0.016]).give_way(Some(8), 0.0);
        assert!(both.y.abs() < 1e-6 && both.x.abs() < 1e-3, "{both:?}");
    }
}
