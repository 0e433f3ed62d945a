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

/// An effect. Most effects compute a value from 0 to 1, with which a colour of the palette is looked up. `Look` has palette
/// and settings. A cycle lasts 1/`Look::speed_hz` seconds.
#[derive(Clone, Debug, PartialEq)]
pub enum LightEffect {
    /// The first colour of the palette, everywhere.
    Solid,
    /// The colours of the palette along a coordinate. With time, the colours move along the coordinate.
    Gradient(Coordinate),
    /// The colours of the palette one after another, for all robots at once.
    Fade,
    /// All robots go through the palette and back in each cycle.
    Pulse,
    /// All robots switch between the last and the first colour of the palette.
    Strobe,
    /// Random robots glow up and fade in each cycle, each robot at its own moment. Each cycle draws them anew.
    Twinkle {
        /// Probability that a robot glows up in a cycle, 0 to 1.
        density: f64,
    },
    /// Random robots are lit for a whole cycle. Each cycle draws them anew.
    Sparkle {
        /// Probability that a robot is lit in a cycle, 0 to 1.
        density: f64,
    },
    /// All hues along a coordinate. With time, the hues move along the coordinate.
    Rainbow {
        /// What the hues run along.
        along: Coordinate,
        /// Saturation of the hues: 0 (white) to 1.
        saturation: f64,
    },
    /// A sine wave along a coordinate.
    Wave(Coordinate),
    /// A light with a tail that runs along a coordinate.
    Chase(Coordinate),
    /// A ring that grows from the effect's place in each cycle.
    Ripple,
    /// The mean of four sine waves that run over the floor.
    Plasma,
    /// Noise that looks like clouds.
    Noise {
        /// Number of octaves: more octaves give a finer grain.
        octaves: u32,
    },
    /// Flames.
    Fire,
    /// A picture or film on the floor. The number is its index in [`LightContext::pictures`].
    Picture(usize),
    /// A list of colours for each robot and moment.
    Sequence {
        /// Index in [`LightContext::pictures`] of a picture with the colours. Its column n has the colours of robot n, its
        /// rows the moments.
        picture: usize,
        /// Time from one row to the next, seconds.
        step_s: f64,
        /// When the first row is shown, seconds after the layer's origin; may be negative.
        start_s: f64,
    },
    /// A fade to the robot's colour in the next frame.
    NextFrame,
    /// A random position of the palette for each robot. All positions move on with time.
    ByRobot,
    /// A position of the palette that grows with the robot's speed.
    BySpeed {
        /// Speed that gives the last colour of the palette, metres per second. Speed 0 gives the first one.
        top_mps: f64,
    },
}

/// The colour and opacity that an effect gives a robot at `tau_s`, seconds since the origin of the layer's time.
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
