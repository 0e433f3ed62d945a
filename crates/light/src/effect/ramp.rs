//! Effects that spread colours along a coordinate.

use lightbots_base::srgb_decoded;

use crate::colour::{Linear, within_one};
use crate::ease::fraction;
use crate::look::Look;
use crate::palette::Shade;

/// The coordinate `along` minus `turns`, the cycles since the effect began, wrapped into 0 to 1.
pub(super) fn gradient(look: &Look, turns: f64, along: f64) -> f64 {
    look.wrap.at(along - turns)
}

/// The opaque colour whose hue is the fraction of the coordinate `along` minus `turns`, the cycles since the effect began.
/// The easing curve is applied to the hue, 0 to 1.
pub(super) fn rainbow(look: &Look, turns: f64, along: f64, saturation: f64) -> Shade {
    let hue = look.ease.at(fraction(along - turns));
    let channel = |start: f64| {
        let around = (6.0 * hue + start) % 6.0;
        let full = within_one((around - 3.0).abs() - 1.0);
        1.0 - saturation * (1.0 - full)
    };
    let [r, g, b] = [channel(0.0), channel(4.0), channel(2.0)].map(srgb_decoded);
    (Linear::new(r, g, b), 1.0)
}
