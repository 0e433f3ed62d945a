//! The last stage: corrects colours for the lamps of a fleet.

use crate::colour::Linear;
use lightbots_base::Rgb;
use serde::{Deserialize, Serialize};

/// How the lamps of a fleet differ from ideal sRGB lamps. Corrections work on linear light, which a robot obtains by
/// decoding the sRGB colour that it receives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LampSettings {
    /// Exponent g, 0.2 to 5: where an ideal lamp shows the light L, 0 to 1, this lamp shows L^g. 1 for an ideal lamp.
    pub gamma: f64,
    /// White balance: factors on the light of red, green and blue, 0 to 1.
    pub gain: [f64; 3],
    /// Current that one channel of a lamp draws at full light, milliamperes.
    pub channel_ma: f64,
    /// Current that a dark lamp draws, milliamperes.
    pub standby_ma: f64,
    /// Largest current that a lamp may draw, milliamperes; infinite: no limit.
    pub current_max_ma: f64,
}

impl Default for LampSettings {
    /// A lamp that shows sRGB colours without correction. 20 mA per channel and 1 mA in standby are those of a WS2812B in
    /// a 5050 housing.
    fn default() -> Self {
        Self { gamma: 1.0, gain: [1.0; 3], channel_ma: 20.0, standby_ma: 1.0, current_max_ma: f64::INFINITY }
    }
}

impl LampSettings {
    /// Returns the linear light to send to a lamp: `wanted`, corrected for gamma, white balance and the limit of current.
    /// If the current would exceed its limit, all channels are scaled by one factor, so that the hue does not change.
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

    /// Returns the sRGB colour to send to a lamp: that of [`LampSettings::light`].
    pub fn colour(&self, wanted: Linear) -> Rgb {
        self.light(wanted).to_rgb()
    }

    /// Returns the sRGB colour to send so that a lamp shows the sRGB colour `meant`, as far as its current allows.
    pub fn sent(&self, meant: Rgb) -> Rgb {
        if self.changes_nothing() { meant } else { self.colour(Linear::from_rgb(meant)) }
    }

    /// Whether these settings leave every colour unchanged.
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
