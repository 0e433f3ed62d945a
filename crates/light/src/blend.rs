//! Blend modes: how the light of a layer is mixed with the light below.

use crate::colour::Linear;

/// How a channel is computed from `below`, the light below the layer, and `layer`, the light of the layer. Both are linear
/// light, 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BlendMode {
    /// The light of the layer.
    #[default]
    Normal,
    /// The sum, at most 1.
    Add,
    /// `below` minus `layer`, at least 0.
    Subtract,
    /// The product.
    Multiply,
    /// 1 − (1 − below)(1 − layer).
    Screen,
    /// The lesser.
    Darken,
    /// The greater.
    Lighten,
    /// The absolute difference.
    Difference,
    /// The mean.
    Average,
    /// 2·below·layer where `below` is at most 0.5; above, the screen of `layer` and 2·below − 1.
    Overlay,
    /// 2·below·layer where `layer` is at most 0.5; above, the screen of `below` and 2·layer − 1.
    HardLight,
    /// Below + (2·layer − 1)(below − below²): a gentle form of hard light.
    SoftLight,
}

impl BlendMode {
    /// Returns a mixture: the light that the mode computes has the share `opacity`, and the light `below` has the rest.
    pub fn over(self, below: Linear, layer: Linear, opacity: f64) -> Linear {
        below.lerp(below.zip(layer, |below, layer| self.channel(below, layer)), opacity)
    }

    fn channel(self, below: f64, layer: f64) -> f64 {
        match self {
            Self::Normal => layer,
            Self::Add => (below + layer).min(1.0),
            Self::Subtract => (below - layer).max(0.0),
            Self::Multiply => below * layer,
            Self::Screen => screen(below, layer),
            Self::Darken => below.min(layer),
            Self::Lighten => below.max(layer),
            Self::Difference => (below - layer).abs(),
            Self::Average => (below + layer) / 2.0,
            Self::Overlay => hard(layer, below),
            Self::HardLight => hard(below, layer),
            Self::SoftLight => below + (2.0 * layer - 1.0) * (below - below * below),
        }
    }
}

fn screen(below: f64, layer: f64) -> f64 {
    1.0 - (1.0 - below) * (1.0 - layer)
}

/// Returns 2·other·judge if `judge` is at most 0.5, else the screen of `other` and 2·judge − 1.
fn hard(other: f64, judge: f64) -> f64 {
    if judge <= 0.5 { other * 2.0 * judge } else { screen(other, 2.0 * judge - 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All modes.
    const ALL: [BlendMode; 12] = [
        BlendMode::Normal,
        BlendMode::Add,
        BlendMode::Subtract,
        BlendMode::Multiply,
        BlendMode::Screen,
        BlendMode::Darken,
        BlendMode::Lighten,
        BlendMode::Difference,
        BlendMode::Average,
        BlendMode::Overlay,
        BlendMode::HardLight,
        BlendMode::SoftLight,
    ];

    #[test]
    fn every_mode_stays_within_zero_and_one() {
        for mode in ALL {
            for step in 0..=100 {
                let (below, layer) = (f64::from(step % 11) / 10.0, f64::from(step / 10) / 10.0);
                let mixed = mode.channel(below, layer);
                assert!((0.0..=1.0).contains(&mixed), "{mode:?} of {below} and {layer}: {mixed}");
            }
        }
    }

    #[test]
    fn a_layer_without_opacity_changes_nothing() {
        let below = Linear::new(0.2, 0.4, 0.6);
        for mode in ALL {
            assert_eq!(mode.over(below, Linear::new(1.0, 0.5, 0.0), 0.0), below);
        }
    }

    #[test]
    fn modes_give_the_values_of_their_formulas() {
        let of = |mode: BlendMode| mode.channel(0.25, 0.75);
        let found = ALL.map(of);
        let wanted = [0.75, 1.0, 0.0, 0.1875, 0.8125, 0.25, 0.75, 0.5, 0.5, 0.375, 0.625, 0.34375];
        assert_eq!(found, wanted);
    }
}
