//! The robot's body in Webots: two wheels, GPS, compass, a light, and eyes for what is near.

use std::fmt;

use lightbots_base::{Limits, Rgb};

use crate::library::{Library, Tag};
use crate::odometry::wheel_turn_rad;
use crate::proximity::Proximity;

/// A device that the robot must have and has not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingDevice(&'static str);

impl fmt::Display for MissingDevice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the robot has no device \"{}\": use the PROTO LightBot or LightBotElisa3", self.0)
    }
}

/// Motors, sensors and light of this process's robot, with the sensors switched on.
pub struct Body<'a> {
    library: &'a Library,
    motors: [Tag; 2],
    sensors: [Tag; 2],
    gps: Tag,
    compass: Tag,
    light: Tag,
    proximity: Option<Proximity>,
    last_read_rad: [f64; 2],
    last_rates: [f64; 2],
    last_light: Option<Rgb>,
    steps_since_light: u32,
}

/// Webots takes a moment for every change of a light; a fade at this pace still looks even.
const STEPS_BETWEEN_LIGHTS: u32 = 6;
/// How far ahead of a wheel the position is that it turns to, seconds at its rate. Webots' motors turn at 10 rad/s for each
/// radian that is missing (`controlPID`), so 0.1 s keep them at their rate; two steps more until the next command acts, and
/// one to spare. A robot whose driver is gone rolls on for that: 40 mm at 0.27 m/s.
const AHEAD_S: f64 = 0.1 + 3.0 * 0.016;

impl<'a> Body<'a> {
    /// Finds the devices and switches the sensors on, to be sampled every `step_ms`; not those for what is near where it
    /// is to be `blind`. The wheels stand.
    pub fn new(library: &'a Library, step_ms: i32, blind: bool) -> Result<Self, MissingDevice> {
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
            proximity: if blind { None } else { Proximity::find(library, step_ms) },
            last_read_rad: [f64::NAN; 2],
            last_rates: [0.0; 2],
            last_light: None,
            steps_since_light: STEPS_BETWEEN_LIGHTS,
        })
    }

    /// How far the wheels turned since the last call, left and right, radians; zero before two samples are there.
    pub fn wheel_turns_rad(&mut self) -> [f64; 2] {
        let read = self.sensors.map(|sensor| self.library.sensor_value(sensor));
        let turned = [0, 1].map(|side| wheel_turn_rad(read[side] - self.last_read_rad[side]));
        self.last_read_rad = read;
        turned.map(|turn| if turn.is_finite() { turn } else { 0.0 })
    }

    /// Place (x, y) in stage metres and heading in radians; NaN before the first sample. The world's axes are the
    /// stage's (ENU, origin in the middle of the floor).
    pub fn fix(&self) -> ([f64; 2], f64) {
        let [x, y, _] = self.library.gps_values(self.gps);
        let north = self.library.compass_values(self.compass);
        ([x, y], north[0].atan2(north[1]))
    }

    /// Gaps to what is near, metres, counter-clockwise from the front; `None`: it has no sensors for that.
    pub fn gaps_m(&self) -> Option<[f32; 8]> {
        self.proximity.as_ref().map(|proximity| proximity.gaps_m(self.library))
    }

    /// Sets both wheels, rad/s, for the next steps: towards a position a little ahead of where the latest
    /// [`wheel_turns_rad`](Self::wheel_turns_rad) found them, because Webots' motors do what they were told last when
    /// this process is gone.
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

    /// Shows a colour, at most ten times a second.
    pub fn set_light(&mut self, colour: Rgb) {
        self.steps_since_light = self.steps_since_light.saturating_add(1);
        if self.last_light != Some(colour) && self.steps_since_light >= STEPS_BETWEEN_LIGHTS {
            self.library.led_set(self.light, colour.number());
            self.last_light = Some(colour);
            self.steps_since_light = 0;
        }
    }
}
