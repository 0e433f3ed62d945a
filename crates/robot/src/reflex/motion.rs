//! Motion of the robot itself in a step.

use super::point::Point;

/// How a robot moved in a step, in its own body space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMotion {
    /// Distance driven, metres, forwards positive.
    pub way_m: f32,
    /// Rotation, radians, counter-clockwise positive.
    pub turn_rad: f32,
    /// Length of the step, seconds.
    pub dt: f32,
}

impl OwnMotion {
    /// Converts a fixed place from body space before the step to body space after the step.
    pub fn carry(&self, at: Point) -> Point {
        // The path of the robot bends, so that its chord points in the direction of half the turn.
        let moved = Point::of_small_angle(0.5 * self.turn_rad).times(self.way_m);
        at.minus(moved).rotated(Point::of_small_angle(-self.turn_rad))
    }
}
