//! Values of a show in messages.

use lightbots_base::Vec2;

/// Range of magnitudes that are written in full. Other numbers, which no show needs, get an exponent, so that lines stay
/// short.
const IN_FULL: std::ops::Range<f64> = 1e-4..1e7;

/// A number as text, for messages.
pub(super) fn number(value: f64) -> String {
    if value == 0.0 || IN_FULL.contains(&value.abs()) { format!("{value}") } else { format!("{value:e}") }
}

/// A place in stage metres as text, for messages: `x, y` with three decimals. Huge numbers get an exponent.
pub(super) fn place(at: Vec2) -> String {
    let metres = |value: f64| if value.abs() < IN_FULL.end { format!("{value:.3}") } else { number(value) };
    format!("{}, {}", metres(at.x), metres(at.y))
}

/// A distance as text, for messages: millimetres with one decimal. `metres` is the distance in metres.
pub(super) fn millimetres(metres: f64) -> String {
    format!("{:.1} mm", metres * 1e3)
}
