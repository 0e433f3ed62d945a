//! Timed paths along straight lines: everybody shares one progress over time, so all leave and arrive together.

mod bend;
mod profile;
pub(crate) mod progress;
pub(crate) mod stop_and_go;

pub(crate) use bend::Displacements;
pub(crate) use profile::Profile;

use lightbots_base::{Limits, Span};

/// How long a robot needs to turn by `angle` radians on the spot, in whole milliseconds rounded up. A quarter turn
/// is the most anybody needs, because driving backwards is as good as driving forwards.
pub fn turn_time(angle: f64, limits: &Limits) -> Span {
    whole_millis(angle.abs() / limits.turn_radps.max(0.01))
}

/// How long a robot needs for a quarter turn on the spot: every path begins with this rest.
pub(crate) fn quarter_turn(limits: &Limits) -> Span {
    turn_time(core::f64::consts::FRAC_PI_2, limits)
}

/// `seconds` rounded up to whole milliseconds, at least zero: what the wire carries without loss.
pub(crate) fn whole_millis(seconds: f64) -> Span {
    // A hair less, so that what is whole already stays so.
    let millis = (seconds * 1e3 - 1e-6).clamp(0.0, 1e12);
    Span::from_millis(millis.ceil() as i64)
}
