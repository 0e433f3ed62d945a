//! How the robot itself moves.

use super::point::Point;

/// How a robot moved in a step, in its own body space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OwnMotion {
    /// Forward, metres.
    pub way_m: f32,
    /// Counter-clockwise, radians.
    pub turn_rad: f32,
    /// Length of the step, seconds.
    pub dt: f32,
}

impl OwnMotion {
    /// Where a place that does not move is in body space after the step.
    pub fn carry(&self, at: Point) -> Point {
        // The own path bends by half the turn.
        let moved = Point::of_small_angle(0.5 * self.turn_rad).times(self.way_m);
        at.minus(moved).rotated(Point::of_small_angle(-self.turn_rad))
    }
}
