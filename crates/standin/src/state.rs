//! State of the robot that this process controls.
#![allow(clippy::print_stderr)]

use std::ffi::CString;
use std::os::unix::net::UnixStream;
use std::sync::{Mutex, PoisonError};

use crate::devices::{COMPASS, GPS, MOTORS, SENSORS, TAGS, Tag, proximity, side};
use crate::motor::RATE_MAX_RADPS;
use crate::proximity::value;
use crate::socket::{self, StepCommand, StepReply};

/// Step of the simulated floor, milliseconds, as in `webots/worlds` (docs/webots.md).
const STEP_MS: i32 = 16;

pub(crate) struct RobotProcess {
    pub(crate) name: CString,
    pub(crate) command: StepCommand,
    pub(crate) reply: StepReply,
    socket: Option<UnixStream>,
    /// `[tag]`: whether the device is enabled.
    enabled: [bool; TAGS],
    /// Number of steps since the connection.
    steps: u64,
    gps: [f64; 3],
    compass: [f64; 3],
}

static ROBOT: Mutex<Option<Box<RobotProcess>>> = Mutex::new(None);

/// Runs `action` on the robot and returns its result. If the process has not connected yet, prints an error and ends
/// the process.
pub(crate) fn with<T>(action: impl FnOnce(&mut RobotProcess) -> T) -> T {
    let mut guard = ROBOT.lock().unwrap_or_else(PoisonError::into_inner);
    match guard.as_mut() {
        Some(robot) => action(robot),
        None => fail("a function was called before wb_robot_init"),
    }
}

/// Connects to the simulated floor at the address in the environment. If that fails, ends the process.
pub(crate) fn connect() {
    let name = std::env::var("WEBOTS_ROBOT_NAME").unwrap_or_default();
    let Some(address) = std::env::var_os(socket::ADDRESS) else { fail("LIGHTBOTS_STANDIN is not set") };
    let mut stream = UnixStream::connect(address).unwrap_or_else(|error| fail(&format!("no floor: {error}")));
    if let Err(error) = socket::write_name(&name, &mut stream) {
        fail(&format!("the floor is gone: {error}"));
    }
    let robot = RobotProcess {
        name: CString::new(name).unwrap_or_default(),
        command: StepCommand::default(),
        reply: StepReply::default(),
        socket: Some(stream),
        enabled: [false; TAGS],
        steps: 0,
        gps: [f64::NAN; 3],
        compass: [f64::NAN; 3],
    };
    *ROBOT.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(robot));
}

impl RobotProcess {
    pub(crate) fn step(&mut self, millis: i32) -> i32 {
        if self.reply.ends {
            // After the last step, Webots' library ends the process in the next call.
            std::process::exit(0);
        }
        if millis <= 0 || millis % STEP_MS != 0 {
            fail(&format!("wb_robot_step({millis}) is no multiple of {STEP_MS}"));
        }
        for _ in 0..millis / STEP_MS {
            self.step_once();
            if self.reply.ends {
                return -1;
            }
        }
        0
    }

    fn step_once(&mut self) {
        let Some(socket) = &mut self.socket else { fail("the floor is gone") };
        let answer = self.command.write(socket).and_then(|()| StepReply::read(socket));
        self.reply = answer.unwrap_or_else(|error| fail(&format!("the floor is gone: {error}")));
        self.steps += 1;
    }

    pub(crate) fn cleanup(&mut self) {
        self.socket = None;
        if self.reply.ends {
            std::process::exit(0);
        }
    }

    pub(crate) fn aim_motor(&mut self, tag: Tag, position: f64) {
        if let Some(wheel) = side(MOTORS, tag) {
            self.command.motors[wheel].target_rad = position;
        }
    }

    pub(crate) fn turn_motor(&mut self, tag: Tag, radps: f64) {
        let Some(wheel) = side(MOTORS, tag) else { return };
        let motor = &mut self.command.motors[wheel];
        if motor.target_rad.is_finite() && radps < 0.0 {
            eprintln!("Error: negative velocity before wb_motor_set_position(INFINITY)");
            return;
        }
        motor.radps = radps.clamp(-RATE_MAX_RADPS, RATE_MAX_RADPS);
    }

    pub(crate) fn enable(&mut self, tag: Tag) {
        if let Some(enabled) = self.enabled.get_mut(usize::from(tag)) {
            *enabled = true;
        }
    }

    pub(crate) fn wheel_sensor(&self, tag: Tag) -> f64 {
        match side(SENSORS, tag) {
            Some(wheel) if self.samples(tag) => self.reply.wheels_rad[wheel],
            _ => f64::NAN,
        }
    }

    pub(crate) fn gps(&mut self) -> &[f64; 3] {
        if self.samples(GPS) {
            self.gps = [self.reply.at[0], self.reply.at[1], 0.0];
        }
        &self.gps
    }

    pub(crate) fn compass(&mut self) -> &[f64; 3] {
        if self.samples(COMPASS) {
            self.compass = [self.reply.heading.sin(), self.reply.heading.cos(), 0.0];
        }
        &self.compass
    }

    pub(crate) fn proximity(&self, tag: Tag) -> f64 {
        match proximity(tag) {
            Some(sensor) if self.samples(tag) => value(self.reply.near_m[sensor]),
            _ => f64::NAN,
        }
    }

    fn samples(&self, tag: Tag) -> bool {
        self.steps > 0 && self.enabled[usize::from(tag)]
    }
}

/// Prints the reason and ends the process, as Webots' library does.
fn fail(why: &str) -> ! {
    eprintln!("Error: {why}");
    std::process::exit(1)
}
