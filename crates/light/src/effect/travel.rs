//! Effects that travel over the floor.

use crate::colour::within_one;
use crate::ease::fraction;
use crate::look::Look;
use core::f64::consts::TAU;
use lightbots_base::Vec2;

/// 1 at the crests, 0 in the troughs.
pub(super) fn wave(turns: f64, along: f64) -> f64 {
    0.5 + 0.5 * libm::cos(TAU * fraction(along - turns))
}

/// 1 at the head, falling to 0 over a tail of `width`. The head moves along the coordinate with the turns.
pub(super) fn chase(look: &Look, turns: f64, along: f64) -> f64 {
    let ahead = if look.speed_hz < 0.0 { along - turns } else { turns - along };
    within_one(1.0 - fraction(ahead) / look.width)
}

/// A ring of half-width `width` sizes, whose radius grows from 0 to the size in a cycle while its light fades to 0.
pub(super) fn ripple(look: &Look, turns: f64, place: Vec2) -> f64 {
    let radius = fraction(turns);
    let distance = place.distance(look.place) / look.size_m;
    within_one(1.0 - (distance - radius).abs() / look.width) * (1.0 - radius)
}
