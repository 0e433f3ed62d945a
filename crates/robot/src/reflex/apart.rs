//! Keeping apart: who sees a neighbour much nearer than the plan leaves room gives way a few millimetres.
//!
//! A robot is off its route by what its sensors are wrong, two neighbours by the sum of both; their proximity sensors
//! tell them far better how near they are than both their places do. Both give way, each a part of what is missing.

use lightbots_base::Vec2;

use super::{Reflex, SENSORS, around};

/// More room than this is as good as any, and where nobody tells there is this, metres.
const MOST_M: f32 = 0.008;
const UNTOLD_M: f32 = 0.003;
/// It gives way by this share of what is missing; more where little is left, but never more than so many metres.
const GIVE: f32 = 0.7;
const GIVE_MOST_M: f32 = 0.008;
/// What comes no faster than this, m/s, counts as near as it will be so much later, seconds.
const DRIFTING_MPS: f32 = 0.1;
const SOON_S: f32 = 0.1;
/// So little left that it gives way twice as far as where as much is missing from plenty, metres.
const LITTLE_M: f32 = 0.0015;

impl Reflex {
    /// How far, and where to in body space, it gives way to neighbours; metres, zero where nobody is too near.
    /// `room_mm`: how far others stay away by plan.
    pub(crate) fn give_way(&self, room_mm: Option<u16>) -> Vec2 {
        if self.sees { self.away(room_mm) } else { Vec2::ZERO }
    }

    /// How much nearer what a sensor sees will be soon, for sure: only slowly, as those on ways that cross come near fast
    /// by plan.
    fn drift_m(&self, sensor: usize) -> f32 {
        let sure_mps = self.closing(sensor).map_or(0.0, |closing| closing.sure_mps);
        if (0.0..DRIFTING_MPS).contains(&sure_mps) { sure_mps * SOON_S } else { 0.0 }
    }

    fn away(&self, room_mm: Option<u16>) -> Vec2 {
        let room_m = room_mm.map_or(UNTOLD_M, |room_mm| (f32::from(room_mm) * 1e-3).min(MOST_M));
        let now = &self.past_m[0];
        let mut away = Vec2::ZERO;
        for sensor in 0..SENSORS {
            // One neighbour is in sight of two sensors: the nearer of them counts.
            let [_, left, right] = around(sensor);
            if now[sensor] <= now[left] && now[sensor] < now[right] {
                let gap_m = self.gap_m(sensor);
                let missing_m = room_m - gap_m + self.drift_m(sensor);
                if missing_m > 0.0 {
                    let way_m = (GIVE * missing_m * (1.0 + LITTLE_M / gap_m.max(1e-4))).min(GIVE_MOST_M);
                    away -= Vec2::unit(self.towards(sensor)) * f64::from(way_m);
                }
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
        reflex.look(Some(&gaps_m), (0.004, 0.0), 0.016);
        reflex
    }

    #[test]
    fn it_gives_way_to_who_is_nearer_than_planned_and_to_nobody_else() {
        let left = |gap_m: f32| seeing([NONE, gap_m + 0.012, gap_m, gap_m + 0.012, NONE, NONE, NONE, NONE]);
        let away = left(0.004).give_way(Some(8));
        assert!((away.y + 0.7 * 0.004 * 1.375).abs() < 1e-4 && away.x.abs() < 4e-4, "{away:?}");
        assert_eq!(left(0.004).give_way(Some(500)), away);
        assert_eq!((left(0.004).give_way(Some(4)), left(0.004).give_way(None)), (Vec2::ZERO, Vec2::ZERO));
        assert_eq!(Reflex::new().give_way(Some(8)), Vec2::ZERO);
        assert!((left(0.0).give_way(Some(8)).length() - 0.008).abs() < 1e-6);
    }

    #[test]
    fn who_stands_between_two_sensors_is_one() {
        let away = seeing([0.0086, 0.0086, NONE, NONE, NONE, NONE, NONE, NONE]).give_way(Some(8));
        let middle = Vec2::unit(core::f64::consts::FRAC_PI_8);
        assert!((away.normalized().unwrap() + middle).length() < 1e-6, "{away:?}");
        assert!((away.length() - 0.7 * 0.003 * 1.3).abs() < 1e-5, "{away:?}");
    }

    #[test]
    fn between_two_neighbours_it_stays() {
        let both = seeing([NONE, 0.016, 0.004, 0.016, NONE, 0.016, 0.004, 0.016]).give_way(Some(8));
        assert!(both.y.abs() < 1e-6 && both.x.abs() < 1e-3, "{both:?}");
    }
}
