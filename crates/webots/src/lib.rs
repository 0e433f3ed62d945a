//! The Webots driver of the robot core: one process per robot, as Webots starts its controllers.
//!
//! libController is loaded when the program starts, so that the build needs no part of Webots. In reading order:
//! [`LibController`] finds and loads it, and [`WebotsBody`] holds the robot's motors, sensors and light. [`drive`] is
//! the loop that connects them with the robot core and the broker.

mod body;
mod distance_sensors;
mod drive;
mod library;
mod library_paths;
mod odometry;
pub mod rays;
mod world_clock;

pub use body::{MissingDevice, WebotsBody};
pub use drive::{DriverSettings, drive};
pub use library::{LibController, LoadError};

/// Prints a problem on stderr, which Webots shows in its console.
#[allow(clippy::print_stderr)]
pub fn print_problem(message: &str) {
    eprintln!("LightBotFirmware: {message}");
}
