//! Live light: named layers that an operator puts over a running show and takes off again.

use crate::settings::light_layer;
use lightbots_light::{LayerFault, Layers, LightLayer};
use lightbots_show::Layer;

/// Layers of live light, lowest first. Their effects use the time of the show clock. They shine until they are taken off.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LiveLayers {
    /// Name, layer, and the moment at which the layer's effect starts, seconds of the show clock.
    named: Vec<(String, LightLayer, f64)>,
    layers: Layers,
}

impl LiveLayers {
    /// Whether no layer is on.
    pub fn is_empty(&self) -> bool {
        self.named.is_empty()
    }

    /// Names of the layers that are on, lowest first.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.named.iter().map(|(name, ..)| name.as_str())
    }

    /// The layers, for [`FrameLight::live`](crate::FrameLight::live).
    pub fn layers(&self) -> &Layers {
        &self.layers
    }

    /// Puts `layer` over all others, and takes off the layer that already has `name`. The effect of the new layer starts
    /// at `clock_s`, seconds of the show clock. Its span is ignored, and it cannot show pictures.
    ///
    /// # Errors
    /// If the layer has faults or settings without meaning. Live light is then unchanged.
    pub fn put_on(&mut self, name: String, layer: &Layer, clock_s: f64) -> Result<(), Vec<LayerFault>> {
        let (light, unknown) = light_layer(layer, 0, &mut |_| None)?;
        if !unknown.is_empty() {
            return Err(unknown);
        }
        self.named.retain(|(other, ..)| *other != name);
        self.named.push((name, light, clock_s));
        self.collect();
        Ok(())
    }

    /// Takes the layer called `name` off, if there is one.
    pub fn take_off(&mut self, name: &str) {
        self.named.retain(|(other, ..)| other != name);
        self.collect();
    }

    fn collect(&mut self) {
        let layers = self.named.iter().map(|(_, layer, _)| layer.clone()).collect();
        // Each layer was found valid on its own, and the caller bounds their number.
        let layers = Layers::new(layers).unwrap_or_default();
        self.layers = layers.at_times(|number| (f64::NEG_INFINITY, f64::INFINITY, self.named[number].2));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_light::{LightContext, Linear, LitRobot};
    use lightbots_show::{LayerSpan, Setting};

    fn solid(colour: &str) -> Layer {
        let palette = Setting::List(vec![Setting::Text(colour.into())]);
        Layer {
            name: String::new(),
            kind: "solid".into(),
            span: LayerSpan::Show,
            settings: vec![("palette".into(), palette)],
        }
    }

    fn shown(live: &LiveLayers) -> Linear {
        live.layers().colour(1.76e9, &LitRobot::default(), &LightContext::default())
    }

    #[test]
    fn the_last_one_put_on_covers_the_others_until_it_is_taken_off() {
        let mut live = LiveLayers::default();
        for (name, colour) in [("a", "#ff0000"), ("b", "#00ff00"), ("a", "#0000ff")] {
            live.put_on(name.into(), &solid(colour), 1.76e9).expect("the layer is valid");
        }
        assert!(live.names().eq(["b", "a"]));
        assert_eq!(shown(&live), Linear::new(0.0, 0.0, 1.0));
        live.take_off("a");
        assert_eq!(shown(&live), Linear::new(0.0, 1.0, 0.0));
        live.take_off("a");
        live.take_off("b");
        assert!(live.is_empty() && shown(&live) == Linear::default());
    }

    #[test]
    fn a_layer_that_is_wrong_changes_nothing_and_its_fault_says_what_to_do() {
        let mut live = LiveLayers::default();
        live.put_on("a".into(), &solid("#ff0000"), 0.0).expect("the layer is valid");
        let strobe = Setting::Number(1000.0);
        let wrong = Layer { kind: "strobe".into(), settings: vec![("speed_hz".into(), strobe)], ..solid("") };
        let faults = live.put_on("a".into(), &wrong, 0.0).expect_err("1 kHz is too fast");
        assert!(faults[0].to_string().starts_with("layer 1: speed_hz is 1000: "), "{}", faults[0]);
        let typo = Layer { settings: vec![("colour".into(), Setting::Bool(true))], ..solid("") };
        assert!(live.put_on("a".into(), &typo, 0.0).is_err());
        assert_eq!(shown(&live), Linear::new(1.0, 0.0, 0.0));
    }
}
