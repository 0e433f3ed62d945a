//! Effects that beat for all robots at once.

use crate::ease::fraction;
use crate::look::Look;

/// Rises from 0 to 1 over the first `width` of a cycle, and falls back to 0 over the rest. `turns`: cycles since the effect
/// began. If `width` is 1, the value jumps from 1 to 0.
pub(super) fn pulse(look: &Look, turns: f64) -> f64 {
    let phase = fraction(turns);
    if phase < look.width { phase / look.width } else { (1.0 - phase) / (1.0 - look.width) }
}

/// 1 over the first `width` of a cycle, else 0. `turns`: cycles since the effect began.
pub(super) fn strobe(look: &Look, turns: f64) -> f64 {
    if fraction(turns) < look.width { 1.0 } else { 0.0 }
}
