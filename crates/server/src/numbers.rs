//! Reads values from the command line, and rounds numbers for people.

use std::net::{SocketAddr, ToSocketAddrs};

use lightbots_api::rounded;
use lightbots_base::{Rgb, RobotId, Vec2};
use lightbots_sim::Spread;

/// Reads the width and depth of a floor, `WxH` in metres, each from 0.1 to 1000, such as `3x3` or `4.5x2`.
pub fn floor(text: &str) -> Result<(f64, f64), String> {
    let wrong = || "a floor is WIDTHxDEPTH in metres, each from 0.1 to 1000, such as 3x3".to_owned();
    let (width, depth) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let read = |text: &str| text.trim().parse::<f64>().ok().filter(|metres| (0.1..=1000.0).contains(metres));
    read(width).zip(read(depth)).ok_or_else(wrong)
}

/// Reads the size of a picture, `WIDTHxHEIGHT` in pixels, each from 16 to 4096.
pub fn pixels(text: &str) -> Result<(u32, u32), String> {
    let wrong = || "a size is WIDTHxHEIGHT in pixels, each from 16 to 4096, such as 1280x720".to_owned();
    let (width, height) = text.split_once(['x', 'X', '×']).ok_or_else(wrong)?;
    let read = |text: &str| text.trim().parse::<u32>().ok().filter(|pixels| (16..=4096).contains(pixels));
    read(width).zip(read(height)).ok_or_else(wrong)
}

/// Reads a number of pictures a second, 1 to 120.
pub fn fps(text: &str) -> Result<f64, String> {
    let read = text.trim().parse::<f64>().ok().filter(|fps| (1.0..=120.0).contains(fps));
    read.ok_or_else(|| "pictures a second are a number from 1 to 120".into())
}

/// Reads a seed.
pub fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("a seed is a whole number from 0 to {}", u64::MAX))
}

/// Reads a robot's name.
pub fn robot(text: &str) -> Result<RobotId, String> {
    RobotId::new(text)
        .ok_or_else(|| "a robot's name has 1 to 36 letters, digits and signs, none of / + # |".into())
}

/// Reads a place `X,Y` in metres, each from -1000 to 1000, such as `0.5,-1.3`. `None` if it is no such place.
pub fn place(text: &str) -> Option<Vec2> {
    let (x, y) = text.split_once(',')?;
    let read = |text: &str| text.trim().parse::<f64>().ok().filter(|metres| metres.abs() <= 1000.0);
    Some(Vec2::new(read(x)?, read(y)?))
}

/// Reads a positive number up to 1,000, such as a length in metres.
pub fn metres(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| *number > 0.0 && *number <= 1_000.0);
    number.ok_or_else(|| "write a number above 0 and up to 1000".into())
}

/// Reads a time of up to a day, seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| (0.0..=86_400.0).contains(number));
    number.ok_or_else(|| "write a number of seconds from 0 to 86400".into())
}

/// Reads a colour such as `#ffa500`.
pub fn color(text: &str) -> Result<Rgb, String> {
    Rgb::from_hex(text).ok_or_else(|| "write a colour like #ffa500".into())
}

/// Reads an address to listen at or to send to: an IP address or a name of a machine, and a port, such as
/// `127.0.0.1:8420`. Of a name with several addresses, the first is taken.
pub fn address(text: &str) -> Result<SocketAddr, String> {
    let wrong =
        || "an address is HOST:PORT, such as 127.0.0.1:8420, or 0.0.0.0:8420 for every network".to_owned();
    text.trim().to_socket_addrs().ok().and_then(|mut found| found.next()).ok_or_else(wrong)
}

/// Returns a spread with its numbers rounded to `decimals` digits after the point.
pub fn rounded_spread(Spread { median, p99, max }: Spread, decimals: i32) -> Spread {
    Spread { median: rounded(median, decimals), p99: rounded(p99, decimals), max: rounded(max, decimals) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floors_are_read_and_nonsense_is_not() {
        assert_eq!(floor("3x3"), Ok((3.0, 3.0)));
        assert_eq!(floor("4.5X2"), Ok((4.5, 2.0)));
        for text in ["", "3", "3x", "x3", "0x1", "-1x3", "NaNx3", "infx2", "3x3x3", "1e9x3"] {
            assert!(floor(text).is_err(), "{text}");
        }
    }

    #[test]
    fn seeds_are_whole_numbers() {
        assert_eq!(seed("18446744073709551615"), Ok(u64::MAX));
        for text in ["", "x", "-1", "1.5", "18446744073709551616"] {
            assert!(seed(text).is_err(), "{text}");
        }
    }

    #[test]
    fn addresses_need_a_port() {
        assert_eq!(address("127.0.0.1:8420"), Ok(SocketAddr::from(([127, 0, 0, 1], 8420))));
        assert_eq!(address("[::1]:0").map(|address| address.port()), Ok(0));
        assert_eq!(address("localhost:80").map(|address| address.ip().is_loopback()), Ok(true));
        for text in ["", "foo", "127.0.0.1", ":8420", "127.0.0.1:99999", "8420"] {
            assert!(address(text).is_err(), "{text}");
        }
    }

    #[test]
    fn percentiles_are_values_of_the_set() {
        let spread = Spread::of(&(1..=200).map(f64::from).collect::<Vec<_>>());
        assert_eq!(spread, Spread { median: 100.0, p99: 198.0, max: 200.0 });
        assert_eq!(Spread::of(&[]), Spread::default());
        assert_eq!(Spread::of(&[7.0]), Spread { median: 7.0, p99: 7.0, max: 7.0 });
    }
}
