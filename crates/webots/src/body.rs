//! The robot's body in Webots: two wheels, GPS, compass, light and proximity sensors.

use std::fmt;

use lightbots_base::{Limits, Rgb};

use crate::distance_sensors::DistanceSensors;
use crate::library::{DeviceTag, LibController};
use crate::odometry::wheel_turn_rad;

/// A required device that the robot lacks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingDevice(&'static str);

impl fmt::Display for MissingDevice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the robot has no device \"{}\": use the PROTO LightBot or LightBotElisa3", self.0)
    }
}

/// Motors, sensors and light of this process's robot. GPS, compass and wheel sensors are switched on; the proximity
/// sensors may be off.
pub struct WebotsBody<'a> {
    library: &'a LibController,
    motors: [DeviceTag; 2],
    sensors: [DeviceTag; 2],
    gps: DeviceTag,
    compass: DeviceTag,
    light: DeviceTag,
    proximity: Option<DistanceSensors>,
    last_read_rad: [f64; 2],
    last_rates: [f64; 2],
    last_light: Option<Rgb>,
    steps_since_light: u32,
}

/// Least number of steps between two changes of the light: about 100 ms. With fewer, Webots slows down, because each
/// change costs time. With more, fades look uneven. Chosen, not measured.
const LIGHT_INTERVAL_STEPS: u32 = 6;
/// A wheel's target position is ahead of its reading by the turn in this time at the commanded rate, seconds. Webots'
/// motors turn at 10 rad/s per radian of error (`controlPID`, reference manual), so 0.1 s keep them at their rate. Two
/// steps pass until the next command acts; one is spare. With a smaller value, wheels slow down. With a larger value, a
/// robot without its driver rolls farther than 40 mm at 0.27 m/s.
const AHEAD_S: f64 = 0.1 + 3.0 * 0.016;

impl<'a> WebotsBody<'a> {
    /// Finds the robot's devices, stops its wheels, and has sensors sampled every `step_ms` milliseconds. If `blind`,
    /// the proximity sensors stay off. An error if a motor, wheel sensor, GPS, compass or light is missing.
    pub fn new(library: &'a LibController, step_ms: i32, blind: bool) -> Result<Self, MissingDevice> {
        let find = |name: &'static str| library.device(name).ok_or(MissingDevice(name));
        let motors = [find("left wheel motor")?, find("right wheel motor")?];
        let sensors = [find("left wheel sensor")?, find("right wheel sensor")?];
        let (gps, compass, light) = (find("gps")?, find("compass")?, find("ledrgb")?);
        for motor in motors {
            library.motor_position(motor, f64::INFINITY);
            library.motor_velocity(motor, 0.0);
        }
        for sensor in sensors {
            library.sensor_enable(sensor, step_ms);
        }
        library.gps_enable(gps, step_ms);
        library.compass_enable(compass, step_ms);
        Ok(Self {
            library,
            motors,
            sensors,
            gps,
            compass,
            light,
            proximity: if blind { None } else { DistanceSensors::find(library, step_ms) },
            last_read_rad: [f64::NAN; 2],
            last_rates: [0.0; 2],
            last_light: None,
            steps_since_light: LIGHT_INTERVAL_STEPS,
        })
    }

    /// Turns of the wheels since the last call of this function, left and right, radians; zero before the second
    /// sample.
    pub fn wheel_turns_rad(&mut self) -> [f64; 2] {
        let read = self.sensors.map(|sensor| self.library.sensor_value(sensor));
        let turned = [0, 1].map(|side| wheel_turn_rad(read[side] - self.last_read_rad[side]));
        self.last_read_rad = read;
        turned.map(|turn| if turn.is_finite() { turn } else { 0.0 })
    }

    /// Place (x, y) in stage metres and heading in radians; NaN before the first sample. The axes of the Webots world
    /// are those of the stage (ENU, origin in the middle of the floor).
    pub fn fix(&self) -> ([f64; 2], f64) {
        let [x, y, _] = self.library.gps_values(self.gps);
        let north = self.library.compass_values(self.compass);
        ([x, y], north[0].atan2(north[1]))
    }

    /// Gaps to near obstacles in eight directions, metres, counter-clockwise from the front; `None`: too few proximity
    /// sensors, or they stay off.
    pub fn gaps_m(&self) -> Option<[f32; 8]> {
        self.proximity.as_ref().map(|proximity| proximity.gaps_m(self.library))
    }

    /// Sets the rates of both wheels, rad/s; does nothing before their first reading. Webots' motors keep their last
    /// command when this process ends. Therefore the wheels are not told to turn on without end, but to a position a
    /// little ahead of the last reading of [`wheel_turns_rad`](Self::wheel_turns_rad).
    pub fn set_wheels(&mut self, radps: [f64; 2]) {
        for side in [0, 1] {
            let (motor, read_rad) = (self.motors[side], self.last_read_rad[side]);
            let radps = radps[side].clamp(-Limits::ELISA_3.wheel_radps, Limits::ELISA_3.wheel_radps);
            if !read_rad.is_finite() || radps == 0.0 && self.last_rates[side] == 0.0 {
                continue;
            }
            self.library.motor_position(motor, read_rad + radps * AHEAD_S);
            self.library.motor_velocity(motor, radps.abs());
            self.last_rates[side] = radps;
        }
    }

    /// Shows a colour. Call this once a step with the wanted colour. For some steps after a change of the light (about
    /// 100 ms), further colours are not shown.
    pub fn set_light(&mut self, colour: Rgb) {
        self.steps_since_light = self.steps_since_light.saturating_add(1);
        if self.last_light != Some(colour) && self.steps_since_light >= LIGHT_INTERVAL_STEPS {
            self.library.led_set(self.light, colour.number());
            self.last_light = Some(colour);
            self.steps_since_light = 0;
        }
    }
}
