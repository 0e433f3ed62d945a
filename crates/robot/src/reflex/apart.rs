//! Keeping apart: who sees a neighbour much nearer than the plan leaves room gives way a few millimetres.
//!
//! A robot is off its route by what its sensors are wrong, two neighbours by the sum of both; their proximity sensors
//! tell them far better how near they are than both their places do. Both give way, each a part of what is missing.

use lightbots_base::Vec2;

use super::{Reflex, SENSORS};

/// Nearer than this share of the room that the plan leaves, a neighbour is too near; …
const SHARE: f32 = 0.75;
/// … more room than this is as good as any, and where nobody tells there is this, metres.
const MOST_M: f32 = 0.008;
const UNTOLD_M: f32 = 0.003;
/// It gives way by this share of what is missing.
const GIVE: f32 = 0.7;

impl Reflex {
    /// How far, and where to in body space, it gives way to neighbours; metres, zero where nobody is too near.
    /// `room_mm`: how far others stay away by plan.
    #[inline]
    pub(crate) fn give_way(&self, room_mm: Option<u16>) -> Vec2 {
        if self.sees { self.away(room_mm) } else { Vec2::ZERO }
    }

    fn away(&self, room_mm: Option<u16>) -> Vec2 {
        let room_m = room_mm.map_or(UNTOLD_M, |room_mm| (f32::from(room_mm) * 1e-3).min(MOST_M));
        let now = &self.past_m[0];
        let mut away = Vec2::ZERO;
        for sensor in 0..SENSORS {
            let missing_m = SHARE * room_m - self.gap_m(sensor);
            // One neighbour is in sight of two sensors: the nearer of them counts.
            let (left, right) = ((sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS);
            if missing_m > 0.0 && now[sensor] <= now[left] && now[sensor] < now[right] {
                away -= Vec2::unit(self.towards(sensor)) * f64::from(GIVE * missing_m);
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
        let left = seeing([NONE, 0.016, 0.004, 0.016, NONE, NONE, NONE, NONE]);
        let away = left.give_way(Some(8));
        assert!(away.y < -0.001 && away.y > -0.0016 && away.x.abs() < 1e-4, "{away:?}");
        assert_eq!(left.give_way(Some(5)), Vec2::ZERO);
        assert_eq!(left.give_way(None), Vec2::ZERO);
        assert_eq!(left.give_way(Some(500)), away);
        assert_eq!(Reflex::new().give_way(Some(8)), Vec2::ZERO);
    }

    #[test]
    fn who_stands_between_two_sensors_is_one() {
        let away = seeing([0.006, 0.006, NONE, NONE, NONE, NONE, NONE, NONE]).give_way(Some(8));
        let middle = Vec2::unit(core::f64::consts::FRAC_PI_8);
        assert!((away.normalized().unwrap() + middle).length() < 1e-6, "{away:?}");
        assert!((away.length() - 0.7 * 0.0036).abs() < 1e-6, "{away:?}");
    }

    #[test]
    fn between_two_neighbours_it_stays() {
        let both = seeing([NONE, 0.016, 0.004, 0.016, NONE, 0.016, 0.004, 0.016]).give_way(Some(8));
        assert!(both.length() < 1e-6, "{both:?}");
    }
}
