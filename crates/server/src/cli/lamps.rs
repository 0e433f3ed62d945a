//! The arguments for the lamps of a fleet, of `run` and `play`.

use clap::Args;
use lightbots_lighting::LampSettings;

/// The lamps of the fleet: what they are sent so that they show the colours of the show, of `run` and `play`
#[derive(Clone, Copy, Debug, Args)]
pub struct LampArguments {
    /// Exponent of the lamps' light relative to sRGB; choose a value above 1 if dim colours come out too dark
    #[arg(long, value_name = "G", default_value_t = 1.0, value_parser = gamma)]
    pub lamp_gamma: f64,
    /// White balance: the shares of red, green and blue, each 0 to 1, that together look white, such as 1,0.8,0.7
    #[arg(long, value_name = "R,G,B", default_value = "1,1,1", value_parser = white)]
    pub lamp_white: White,
    /// Largest current of a robot's lamp, milliamperes; brighter colours are dimmed and keep their hue [default: not
    /// limited]
    #[arg(long, value_name = "MA", value_parser = milliamperes)]
    pub lamp_max_ma: Option<f64>,
    /// Current of one colour channel at full light, milliamperes
    #[arg(long, value_name = "MA", default_value_t = 20.0, value_parser = milliamperes)]
    pub lamp_channel_ma: f64,
    /// Current of a dark lamp, milliamperes
    #[arg(long, value_name = "MA", default_value_t = 1.0, value_parser = milliamperes)]
    pub lamp_standby_ma: f64,
}

/// Shares of red, green and blue that together look white, each 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct White([f64; 3]);

impl LampArguments {
    /// Returns these arguments as lamp settings.
    pub fn settings(&self) -> LampSettings {
        LampSettings {
            gamma: self.lamp_gamma,
            gain: self.lamp_white.0,
            channel_ma: self.lamp_channel_ma,
            standby_ma: self.lamp_standby_ma,
            current_max_ma: self.lamp_max_ma.unwrap_or(f64::INFINITY),
        }
    }
}

fn gamma(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| (0.2..=5.0).contains(number));
    number.ok_or_else(|| "write a number from 0.2 to 5, such as 2.2".into())
}

fn white(text: &str) -> Result<White, String> {
    let shares: Option<Vec<f64>> = text.split(',').map(|share| share.trim().parse().ok()).collect();
    let shares = shares.and_then(|shares| <[f64; 3]>::try_from(shares).ok());
    let is_white = |shares: &[f64; 3]| shares.iter().all(|share| (0.0..=1.0).contains(share));
    shares
        .filter(is_white)
        .map(White)
        .ok_or_else(|| "write three numbers from 0 to 1, such as 1,0.8,0.7".into())
}

fn milliamperes(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|number: &f64| (0.0..=100_000.0).contains(number));
    number.ok_or_else(|| "write milliamperes from 0 to 100000, such as 30".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_are_read_and_nonsense_is_not() {
        assert_eq!((gamma("2.2"), white("1, 0.5,0")), (Ok(2.2), Ok(White([1.0, 0.5, 0.0]))));
        for text in ["", "0", "-1", "NaN", "inf", "5.1"] {
            assert!(gamma(text).is_err(), "{text}");
        }
        for text in ["", "1", "1,1", "1,1,1,1", "1,1,1.1", "1,NaN,1", "a,b,c"] {
            assert!(white(text).is_err(), "{text}");
        }
        assert!(
            milliamperes("-1").is_err() && milliamperes("inf").is_err() && milliamperes("30") == Ok(30.0)
        );
    }
}
