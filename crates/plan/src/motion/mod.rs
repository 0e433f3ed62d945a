//! Timed paths along straight lines, and their displacements and delays. At each moment of a drive without delays, all
//! robots have driven the same share of their lines (the progress). So all leave and arrive together.

mod bend;
mod delayed;
mod profile;
pub(crate) mod progress;
pub(crate) mod stop_and_go;

pub(crate) use bend::Displacements;
pub(crate) use delayed::{delayed, ends};
pub(crate) use profile::Profile;

use lightbots_base::{Limits, Span};

/// Time that a robot needs to turn by `angle` radians on the spot, in whole milliseconds, rounded up. The turn rate
/// counts as at least 0.01 rad/s. Before a drive, a quarter turn is always enough, because a robot may drive backwards.
pub fn turn_time(angle: f64, limits: &Limits) -> Span {
    whole_millis(angle.abs() / limits.turn_radps.max(0.01))
}

/// Time of a quarter turn on the spot. A rest of this duration suffices before a drive in any direction.
pub(crate) fn quarter_turn(limits: &Limits) -> Span {
    turn_time(core::f64::consts::FRAC_PI_2, limits)
}

/// Rounds `seconds` up to whole milliseconds, at least zero, because messages carry whole milliseconds without loss.
pub(crate) fn whole_millis(seconds: f64) -> Span {
    // Subtracts a little first, so that a rounding error does not lift a whole number to the next.
    let millis = (seconds * 1e3 - 1e-6).clamp(0.0, 1e12);
    Span::from_millis(millis.ceil() as i64)
}
