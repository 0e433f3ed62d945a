//! A layer of light, and how it covers the light below.

use crate::blend::BlendMode;
use crate::colour::Linear;
use crate::ease::OpacityCurve;
use crate::effect::{LightEffect, shade};
use crate::lit_robot::{LightContext, LitRobot};
use crate::look::Look;
use crate::mask::LightMask;

/// Light over time.
#[derive(Clone, Debug, PartialEq)]
pub struct LightLayer {
    /// When it begins, seconds of show time (included).
    pub from_s: f64,
    /// When it ends, seconds of show time (excluded); infinite: never.
    pub to_s: f64,
    /// Moment from which the time of its effect counts, seconds of show time.
    pub origin_s: f64,
    /// Whether its effect goes on while show time stands: [`LightContext::lead_s`] then counts for it.
    pub runs_freely: bool,
    /// The effect.
    pub effect: LightEffect,
    /// The settings of the effect.
    pub look: Look,
    /// Masks. The layer shines with the product of the shares that they let through.
    pub masks: Vec<LightMask>,
    /// How the light of the layer is mixed with the light below.
    pub blend: BlendMode,
    /// Opacity over time.
    pub opacity: OpacityCurve,
}

impl LightLayer {
    /// An opaque layer over the whole show.
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

    /// Returns the light `below` with the layer over it at the show time `t_s`, seconds.
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
