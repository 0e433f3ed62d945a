//! A layer of light, and how it covers the light below.

use crate::blend::BlendMode;
use crate::colour::Linear;
use crate::ease::OpacityCurve;
use crate::effect::{LightEffect, shade};
use crate::lit_robot::{LightContext, LitRobot};
use crate::look::Look;
use crate::mask::LightMask;

/// An effect over time, with its settings, masks, blend mode and opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct LightLayer {
    /// When the layer begins to shine, seconds of show time (included).
    pub from_s: f64,
    /// When the layer stops shining, seconds of show time (excluded); infinite: never.
    pub to_s: f64,
    /// Moment from which the effect's own time counts, seconds of show time.
    pub origin_s: f64,
    /// Whether the effect goes on while show time stands. [`LightContext::lead_s`] is then added to the effect's time.
    pub runs_freely: bool,
    /// The effect.
    pub effect: LightEffect,
    /// The settings of the effect.
    pub look: Look,
    /// Masks. The opacity of the layer is multiplied by the share that each mask lets through.
    pub masks: Vec<LightMask>,
    /// How the light of the layer is mixed with the light below.
    pub blend: BlendMode,
    /// Opacity over the effect's own time.
    pub opacity: OpacityCurve,
}

impl LightLayer {
    /// An opaque layer without masks, which shines from the start of the first frame's air time, for ever.
    pub fn new(effect: LightEffect, look: Look) -> Self {
        Self {
            from_s: 0.0,
            to_s: f64::INFINITY,
            origin_s: 0.0,
            runs_freely: false,
            effect,
            look,
            masks: Vec::new(),
            blend: BlendMode::Normal,
            opacity: OpacityCurve::default(),
        }
    }

    /// Returns the light of a robot with this layer over the light `below`, at the show time `t_s`, seconds.
    pub(crate) fn over(
        &self,
        below: Linear,
        t_s: f64,
        robot: &LitRobot,
        context: &LightContext<'_>,
    ) -> Linear {
        if !(self.from_s <= t_s && t_s < self.to_s) {
            return below;
        }
        let lead_s = if self.runs_freely { context.lead_s } else { 0.0 };
        let tau_s = t_s - self.origin_s + lead_s;
        let visible = self.masks.iter().fold(self.opacity.at(tau_s), |share, mask| share * mask.share(robot));
        if visible <= 0.0 {
            return below;
        }
        let (light, opacity) = shade(&self.effect, &self.look, tau_s, robot, context);
        self.blend.over(below, light, visible * opacity)
    }
}
