//! Effects that travel over the floor.

use crate::colour::within_one;
use crate::ease::fraction;
use crate::look::Look;
use core::f64::consts::TAU;
use lightbots_base::Vec2;

/// A cosine wave along a coordinate: 1 at the crests, 0 in the troughs. `turns`: cycles since the effect began.
pub(super) fn wave(turns: f64, along: f64) -> f64 {
    0.5 + 0.5 * libm::cos(TAU * fraction(along - turns))
}

/// 1 at the head of a light, falling to 0 over a tail as long as the share `width` of a cycle. The head moves along the
/// coordinate by 1 per cycle, backwards for a negative speed; the tail follows it.
pub(super) fn chase(look: &Look, turns: f64, along: f64) -> f64 {
    let ahead = if look.speed_hz < 0.0 { along - turns } else { turns - along };
    within_one(1.0 - fraction(ahead) / look.width)
}

/// A ring whose radius grows from 0 to the effect's size in each cycle, while its light fades to 0. Light falls from the
/// middle of the ring over `width` times the effect's size to either side.
pub(super) fn ripple(look: &Look, turns: f64, place: Vec2) -> f64 {
    let radius = fraction(turns);
    let distance = place.distance(look.place) / look.size_m;
    within_one(1.0 - (distance - radius).abs() / look.width) * (1.0 - radius)
}
