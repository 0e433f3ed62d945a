//! The last stage: corrects colours for the lamps of a fleet.

use crate::colour::Linear;
use lightbots_base::Rgb;
use serde::{Deserialize, Serialize};

/// How the lamps of a fleet show light. A robot decodes the sRGB colour that it receives, so the correction works on
/// linear light.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LampSettings {
    /// Exponent from the light that an sRGB lamp shows to the light that this lamp shows, 0.2 to 5; 1 for a lamp that
    /// decodes sRGB.
    pub gamma: f64,
    /// White balance: factor of each channel's light, 0 to 1.
    pub gain: [f64; 3],
    /// Current of one channel at full light, milliamperes.
    pub channel_ma: f64,
    /// Current of a lamp that is dark, milliamperes.
    pub standby_ma: f64,
    /// Largest current of a lamp, milliamperes; infinite: no limit.
    pub current_max_ma: f64,
}

impl Default for LampSettings {
    /// A lamp that shows sRGB as it is. 20 mA a channel and 1 mA standby are a WS2812B's in a 5050 housing.
    fn default() -> Self {
        Self { gamma: 1.0, gain: [1.0; 3], channel_ma: 20.0, standby_ma: 1.0, current_max_ma: f64::INFINITY }
    }
}

impl LampSettings {
    /// Returns the light to send to a lamp: `wanted` after gamma, white balance and the limit of current. One factor
    /// scales all channels until the current is within its limit, so that the hue stays.
    pub fn light(&self, wanted: Linear) -> Linear {
        let wanted = wanted.clamped();
        let bent =
            if self.gamma == 1.0 { wanted } else { wanted.map(|light| libm::pow(light, 1.0 / self.gamma)) };
        let [r, g, b] = self.gain;
        let balanced = Linear::new(bent.r * r, bent.g * g, bent.b * b);
        let current_ma = self.channel_ma * (balanced.r + balanced.g + balanced.b);
        let left_ma = (self.current_max_ma - self.standby_ma).max(0.0);
        let factor = if current_ma > left_ma { left_ma / current_ma } else { 1.0 };
        balanced.map(|light| light * factor).clamped()
    }

    /// [`LampSettings::light`] as the sRGB colour that is sent.
    pub fn colour(&self, wanted: Linear) -> Rgb {
        self.light(wanted).to_rgb()
    }

    /// Returns the colour to send, so that a lamp shows the colour `meant`.
    pub fn sent(&self, meant: Rgb) -> Rgb {
        if self.changes_nothing() { meant } else { self.colour(Linear::from_rgb(meant)) }
    }

    /// Whether every colour is sent unchanged.
    pub fn changes_nothing(&self) -> bool {
        let most_ma = self.standby_ma + 3.0 * self.channel_ma;
        self.gamma == 1.0 && self.gain == [1.0; 3] && self.current_max_ma >= most_ma
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_lamps_change_nothing() {
        assert_eq!(
            LampSettings::default().colour(Linear::from_rgb(Rgb::new(1, 128, 255))),
            Rgb::new(1, 128, 255)
        );
    }

    #[test]
    fn what_is_meant_is_sent_as_it_is_or_corrected() {
        let [white, grey] = [255, 128].map(|code| Rgb::new(code, code, code));
        let plain = LampSettings { current_max_ma: 61.0, ..LampSettings::default() };
        assert!(plain.changes_nothing() && plain.sent(grey) == grey);
        for (lamp, sent) in [
            (LampSettings { current_max_ma: 60.0, ..plain }, Rgb::new(253, 253, 253)),
            (LampSettings { gain: [1.0, 0.5, 1.0], ..plain }, Rgb::new(255, 188, 255)),
        ] {
            assert!(!lamp.changes_nothing());
            assert_eq!(lamp.sent(white), sent);
        }
        // Half of the light of a lamp with gamma 2 needs the root of it.
        let bent = LampSettings { gamma: 2.0, ..plain };
        assert_eq!((bent.sent(white), bent.sent(grey)), (white, Rgb::new(181, 181, 181)));
    }

    #[test]
    fn current_is_limited_and_the_hue_stays() {
        let lamp = LampSettings { current_max_ma: 31.0, ..LampSettings::default() };
        // 60 mA are wanted, 30 remain beside 1 mA of standby.
        assert_eq!(lamp.light(Linear::new(1.0, 1.0, 1.0)), Linear::new(0.5, 0.5, 0.5));
        assert_eq!(lamp.light(Linear::new(1.0, 0.5, 0.0)), Linear::new(1.0, 0.5, 0.0));
        let dark = LampSettings { current_max_ma: 0.5, ..lamp };
        assert_eq!(dark.light(Linear::new(1.0, 1.0, 1.0)), Linear::BLACK);
    }

    #[test]
    fn gamma_comes_before_the_white_balance() {
        let lamp = LampSettings { gamma: 0.5, gain: [1.0, 0.5, 0.25], ..LampSettings::default() };
        assert_eq!(lamp.light(Linear::new(0.5, 0.5, 0.5)), Linear::new(0.25, 0.125, 0.0625));
    }
}
