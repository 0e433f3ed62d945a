//! Effects: what a layer shows at a moment, for a robot at a place.

mod beat;
mod coordinate;
mod field;
mod projection;
mod ramp;
mod random;
mod travel;

pub use coordinate::Coordinate;

use crate::lit_robot::{LightContext, LitRobot};
use crate::look::Look;
use crate::palette::Shade;

/// An effect. Each computes a value u from 0 to 1 or a colour of its own; `Look` has the settings.
#[derive(Clone, Debug, PartialEq)]
pub enum LightEffect {
    /// The palette's start.
    Solid,
    /// The palette along a coordinate.
    Gradient(Coordinate),
    /// The palette over time.
    Fade,
    /// A rise and a fall in each cycle.
    Pulse,
    /// Light and dark by turns.
    Strobe,
    /// Robots glow up and fade, each at its own moments. In each cycle, the share `density` of the robots does.
    Twinkle {
        /// Share of robots, 0 to 1.
        density: f64,
    },
    /// In each cycle, a random share of the robots is lit.
    Sparkle {
        /// Share of robots, 0 to 1.
        density: f64,
    },
    /// All hues along a coordinate.
    Rainbow {
        /// What the hues run along.
        along: Coordinate,
        /// 0 (white) to 1.
        saturation: f64,
    },
    /// A sine wave along a coordinate.
    Wave(Coordinate),
    /// A light with a tail that runs along a coordinate.
    Chase(Coordinate),
    /// A ring that grows from the place.
    Ripple,
    /// A sum of sines of place and time.
    Plasma,
    /// Clouds.
    Noise {
        /// Octaves: more of them give finer grain.
        octaves: u32,
    },
    /// Flames.
    Fire,
    /// A picture or film on the floor, by its number in [`LightContext::pictures`].
    Picture(usize),
    /// Given colours for each robot and moment.
    Sequence {
        /// Index of the colours in [`LightContext::pictures`]: one column for each robot, by its number, and one row
        /// for each moment.
        picture: usize,
        /// Time from one row to the next, seconds.
        step_s: f64,
        /// When the first row is shown, seconds after the layer's origin; may be negative.
        start_s: f64,
    },
    /// A fade to the robot's colour in the next frame.
    NextFrame,
    /// A random value of the palette for each robot.
    ByRobot,
    /// The palette along the robot's speed.
    BySpeed {
        /// Speed at which the end of the palette is reached, metres per second.
        top_mps: f64,
    },
}

/// What an effect shows for a robot `tau_s` seconds after its layer began.
pub(crate) fn shade(
    effect: &LightEffect,
    look: &Look,
    tau_s: f64,
    robot: &LitRobot,
    context: &LightContext<'_>,
) -> Shade {
    let turns = look.speed_hz * tau_s;
    let u = match effect {
        LightEffect::Solid => 0.0,
        LightEffect::Gradient(along) => ramp::gradient(look, turns, along.at(look, robot)),
        LightEffect::Fade => look.wrap.at(turns),
        LightEffect::Pulse => beat::pulse(look, turns),
        LightEffect::Strobe => beat::strobe(look, turns),
        LightEffect::Twinkle { density } => random::twinkle(look, turns, robot.index, *density),
        LightEffect::Sparkle { density } => random::sparkle(look, turns, robot.index, *density),
        LightEffect::Rainbow { along, saturation } => {
            return ramp::rainbow(look, turns, along.at(look, robot), *saturation);
        }
        LightEffect::Wave(along) => travel::wave(turns, along.at(look, robot)),
        LightEffect::Chase(along) => travel::chase(look, turns, along.at(look, robot)),
        LightEffect::Ripple => travel::ripple(look, turns, robot.place),
        LightEffect::Plasma => field::plasma(look, turns, robot.place),
        LightEffect::Noise { octaves } => field::noise(look, turns, robot.place, *octaves),
        LightEffect::Fire => field::fire(look, turns, robot.place),
        LightEffect::Picture(number) => {
            return projection::picture(look, turns, robot.place, context.pictures.get(*number));
        }
        LightEffect::Sequence { picture, step_s, start_s } => {
            let rows = (tau_s - start_s) / step_s;
            return projection::sequence(rows, robot.index, context.pictures.get(*picture));
        }
        LightEffect::NextFrame => return (robot.next_colour, look.ease.at(look.wrap.at(turns))),
        LightEffect::ByRobot => random::by_robot(look, turns, robot.index),
        LightEffect::BySpeed { top_mps } => robot.speed_mps / top_mps,
    };
    look.palette.at(look.ease.at(u))
}
