//! The Webots driver of the robot core: one process a robot, as Webots starts its controllers.
//!
//! libController is loaded when the program starts, so nothing of Webots is needed to build it. Its main types, in
//! reading order: [`Library`] finds and loads it, [`Body`] is the robot's motors, sensors and light, [`drive`] is the
//! loop that connects them with the core and the broker.

mod body;
mod library;
mod looping;
mod odometry;
mod pace;
mod places;
mod proximity;
pub mod rays;

pub use body::{Body, MissingDevice};
pub use library::{Library, LoadError};
pub use looping::{Settings, drive};

/// Says what is wrong where Webots shows it: in its console.
#[allow(clippy::print_stderr)]
pub fn complain(message: &str) {
    eprintln!("LightBotFirmware: {message}");
}
