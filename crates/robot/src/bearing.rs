//! Heading from motion, for robots without heading fixes. It is found by the rotation that maps the track by odometry
//! onto the track by position fixes.

use lightbots_base::{Vec2, wrap};

/// Displacement by odometry since the first pair of places at which the rotation is computed, metres. With a smaller
/// value, the noise of the fixes hides the direction: 2 mm over 60 mm are 2°. With a larger value, a robot drives
/// farther before its heading is known.
const SPREAD_M: f64 = 0.06;
/// Number of fixes after which the sums are reset if the robot has not driven [`SPREAD_M`]: 16 s of fixes. A robot that
/// stands gathers no information.
const MOST: u32 = 1000;

/// Sums over pairs of (place by odometry, place by fix). They give the least-squares rotation from the first to the
/// second track.
#[derive(Debug, Default)]
pub(crate) struct Bearing {
    count: u32,
    first: Option<(Vec2, Vec2)>,
    wheels: Vec2,
    fixes: Vec2,
    dots: f64,
    crosses: f64,
}

impl Bearing {
    /// Adds a pair of places, metres. Once the track is long enough, returns the rotation from the track by odometry to
    /// the track by fixes, radians counter-clockwise, and resets the sums. Otherwise `None`.
    pub(crate) fn add(&mut self, by_wheels: Vec2, by_fix: Vec2) -> Option<f64> {
        let (wheels0, fix0) = *self.first.get_or_insert((by_wheels, by_fix));
        let (wheels, fix) = (by_wheels - wheels0, by_fix - fix0);
        self.count += 1;
        self.wheels += wheels;
        self.fixes += fix;
        self.dots += wheels.dot(fix);
        self.crosses += wheels.cross(fix);
        if wheels.length_squared() < SPREAD_M * SPREAD_M {
            if self.count >= MOST {
                *self = Self::default();
            }
            return None;
        }
        let share = 1.0 / f64::from(self.count);
        let dots = self.dots - self.wheels.dot(self.fixes) * share;
        let crosses = self.crosses - self.wheels.cross(self.fixes) * share;
        *self = Self::default();
        Some(wrap(Vec2::new(dots, crosses).angle()))
    }

    /// Discards all pairs, because the estimate jumped.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turn_between_two_tracks_is_found() {
        let mut bearing = Bearing::default();
        let mut found = None;
        for step in 0..40 {
            let noise = if step % 2 == 0 { 0.002 } else { -0.002 };
            let way = f64::from(step) * 0.004;
            let fix = Vec2::new(0.5, -0.5) + Vec2::unit(2.0) * way + Vec2::new(noise, -noise);
            found = found.or(bearing.add(Vec2::new(way, 0.0), fix));
        }
        assert!((found.unwrap() - 2.0).abs() < 0.05);
    }

    #[test]
    fn standing_tells_nothing() {
        let mut bearing = Bearing::default();
        assert!((0..5000).all(|_| bearing.add(Vec2::ZERO, Vec2::new(0.3, 0.3)).is_none()));
    }
}
