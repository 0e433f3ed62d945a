//! Palettes: colours and opacities along a value from 0 to 1.

use crate::colour::Linear;
use lightbots_base::Rgb;

/// A colour at a position of a palette.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaletteStop {
    /// Position, 0 to 1.
    pub at: f64,
    /// Colour in linear light.
    pub colour: Linear,
    /// Opacity: 0 shows only the light below the layer, 1 only the palette.
    pub opacity: f64,
}

/// A colour in linear light and its opacity, 0 to 1.
pub(crate) type Shade = (Linear, f64);

/// Stops sorted by position. Linear light and opacity are interpolated linearly between two stops. Beyond the outermost
/// stops, they are constant. Two stops at one position make an edge: the first belongs to the positions before, the second
/// to those after.
#[derive(Clone, Debug, PartialEq)]
pub struct Palette {
    /// The stops; at least one.
    pub stops: Vec<PaletteStop>,
}

impl Palette {
    /// A palette that has one opaque colour at all positions.
    pub fn plain(colour: Rgb) -> Self {
        Self::even(&[colour])
    }

    /// A palette of opaque colours at equal distances. The first is at 0 and the last at 1; a single colour is at 0.
    pub fn even(colours: &[Rgb]) -> Self {
        let last = colours.len().saturating_sub(1).max(1) as f64;
        let stop = |(index, &colour): (usize, &Rgb)| PaletteStop {
            at: index as f64 / last,
            colour: Linear::from_rgb(colour),
            opacity: 1.0,
        };
        Self { stops: colours.iter().enumerate().map(stop).collect() }
    }

    /// A palette of one colour, whose opacity rises from 0 at position 0 to 1 at position 1.
    pub fn rising(colour: Rgb) -> Self {
        let colour = Linear::from_rgb(colour);
        let stop = |at| PaletteStop { at, colour, opacity: at };
        Self { stops: vec![stop(0.0), stop(1.0)] }
    }

    /// Colour and opacity at the position `u`. A palette without stops gives black with opacity 0.
    pub(crate) fn at(&self, u: f64) -> Shade {
        let after = self.stops.partition_point(|stop| stop.at <= u);
        let before = after.checked_sub(1).map(|index| self.stops[index]);
        match (before, self.stops.get(after)) {
            (Some(low), Some(high)) => {
                let share = (u - low.at) / (high.at - low.at);
                let opacity = low.opacity + (high.opacity - low.opacity) * share;
                (low.colour.lerp(high.colour, share), opacity)
            }
            (Some(stop), None) => (stop.colour, stop.opacity),
            (None, Some(stop)) => (stop.colour, stop.opacity),
            (None, None) => (Linear::BLACK, 0.0),
        }
    }
}

impl Default for Palette {
    /// From black to white.
    fn default() -> Self {
        Self::even(&[Rgb::BLACK, Rgb::new(255, 255, 255)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_palette_mixes_light_and_not_codes() {
        let (middle, opacity) = Palette::default().at(0.5);
        assert_eq!((middle, opacity), (Linear::new(0.5, 0.5, 0.5), 1.0));
        // Half of the light of white is sRGB 188.
        assert_eq!(middle.to_rgb(), Rgb::new(188, 188, 188));
    }

    #[test]
    fn two_stops_at_one_position_make_an_edge() {
        let stop = |at, light| PaletteStop { at, colour: Linear::new(light, 0.0, 0.0), opacity: 1.0 };
        let palette = Palette { stops: vec![stop(0.5, 0.2), stop(0.5, 0.8)] };
        assert_eq!([0.0, 0.49, 0.5, 1.0].map(|u| palette.at(u).0.r), [0.2, 0.2, 0.8, 0.8]);
    }
}
