//! Valid layers, and the colour that they mix for a robot.

use crate::colour::Linear;
use crate::layer::LightLayer;
use crate::lit_robot::{LightContext, LitRobot};
use crate::validate::{LayerFault, faults};

/// Layers that were found valid, lowest first. [`Self::at_times`] changes times without a new check.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layers(Vec<LightLayer>);

impl Layers {
    /// Validates layers, which are in order from the lowest to the highest.
    ///
    /// # Errors
    /// If a layer is invalid: the faults in the order of the layers, at most [`FAULTS_MAX`](crate::FAULTS_MAX).
    pub fn new(layers: Vec<LightLayer>) -> Result<Self, Vec<LayerFault>> {
        let faults = faults(&layers);
        if faults.is_empty() { Ok(Self(layers)) } else { Err(faults) }
    }

    /// Returns a copy with other times. `times` gets the index of a layer, from 0, and returns its new `from_s`, `to_s`
    /// and `origin_s`. A layer whose new `from_s` or `to_s` is NaN never shines.
    pub fn at_times(&self, times: impl Fn(usize) -> (f64, f64, f64)) -> Self {
        let timed = |(number, layer): (usize, &LightLayer)| {
            let (from_s, to_s, origin_s) = times(number);
            LightLayer { from_s, to_s, origin_s, ..layer.clone() }
        };
        Self(self.0.iter().enumerate().map(timed).collect())
    }

    /// The layers, lowest first.
    pub fn list(&self) -> &[LightLayer] {
        &self.0
    }

    /// The colour of a robot under all layers at the show time `t_s`, seconds. Its channels are clamped to 0..=1.
    pub fn colour(&self, t_s: f64, robot: &LitRobot, context: &LightContext<'_>) -> Linear {
        self.colour_without(usize::MAX, t_s, robot, context)
    }

    /// Like [`Self::colour`], but without the layer with the index `left_out`, counted from 0.
    pub fn colour_without(
        &self,
        left_out: usize,
        t_s: f64,
        robot: &LitRobot,
        context: &LightContext<'_>,
    ) -> Linear {
        let layers = self.0.iter().enumerate().filter(|&(number, _)| number != left_out);
        layers.fold(robot.colour, |below, (_, layer)| layer.over(below, t_s, robot, context)).clamped()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LightEffect, LightMask, Look, MaskShape, OpacityCurve, Palette};
    use lightbots_base::Rgb;

    fn plain(colour: Rgb) -> LightLayer {
        LightLayer::new(LightEffect::Solid, Look { palette: Palette::plain(colour), ..Look::default() })
    }

    fn at(layers: &[LightLayer], t_s: f64) -> Rgb {
        let layers = Layers::new(layers.to_vec()).expect("the layers are valid");
        let robot = LitRobot { colour: Linear::new(0.0, 0.0, 1.0), ..LitRobot::default() };
        layers.colour(t_s, &robot, &LightContext::default()).to_rgb()
    }

    #[test]
    fn a_layer_shines_from_its_start_until_before_its_end() {
        let red = LightLayer { from_s: 1.0, to_s: 2.0, origin_s: 1.0, ..plain(Rgb::new(255, 0, 0)) };
        let (blue, lit) = (Rgb::new(0, 0, 255), Rgb::new(255, 0, 0));
        assert_eq!(
            [0.999, 1.0, 1.999, 2.0].map(|t| at(std::slice::from_ref(&red), t)),
            [blue, lit, lit, blue]
        );
        assert_eq!(at(&[red], f64::NAN), blue);
    }

    #[test]
    fn the_highest_layer_covers_the_others_by_its_opacity_and_masks() {
        let half = LightLayer { opacity: OpacityCurve::constant(0.5), ..plain(Rgb::new(0, 255, 0)) };
        assert_eq!(at(&[plain(Rgb::new(255, 0, 0)), half.clone()], 0.0), Rgb::new(188, 188, 0));
        let masks = vec![LightMask::new(MaskShape::Selection(vec![1]))];
        assert_eq!(at(&[plain(Rgb::new(255, 0, 0)), LightLayer { masks, ..half }], 0.0), Rgb::new(255, 0, 0));
    }
}
