//! The functions of libController that a robot needs. They are looked up when the program starts.
//!
//! Source: Webots R2025a, `include/controller/c/webots/*.h`; R2023b has functions of equal names.
#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_double, c_int};
use std::fmt;
use std::path::Path;

use crate::library_paths;

/// Webots' number for a device of the robot; 0 is no device.
pub type DeviceTag = u16;

/// libController, loaded, with its functions. Call them all from one thread, because the library holds a lock during a
/// step.
pub struct LibController {
    init: extern "C" fn() -> c_int,
    step: extern "C" fn(c_int) -> c_int,
    cleanup: extern "C" fn(),
    name: extern "C" fn() -> *const c_char,
    time: extern "C" fn() -> c_double,
    basic_time_step: extern "C" fn() -> c_double,
    device: extern "C" fn(*const c_char) -> DeviceTag,
    motor_position: extern "C" fn(DeviceTag, c_double),
    motor_velocity: extern "C" fn(DeviceTag, c_double),
    sensor_enable: extern "C" fn(DeviceTag, c_int),
    sensor_value: extern "C" fn(DeviceTag) -> c_double,
    gps_enable: extern "C" fn(DeviceTag, c_int),
    gps_values: extern "C" fn(DeviceTag) -> *const c_double,
    compass_enable: extern "C" fn(DeviceTag, c_int),
    compass_values: extern "C" fn(DeviceTag) -> *const c_double,
    led_set: extern "C" fn(DeviceTag, c_int),
    distance_enable: extern "C" fn(DeviceTag, c_int),
    distance_value: extern "C" fn(DeviceTag) -> c_double,
    distance_type: extern "C" fn(DeviceTag) -> c_int,
    distance_table_size: extern "C" fn(DeviceTag) -> c_int,
    distance_table: extern "C" fn(DeviceTag) -> *const c_double,
    // Keeps the library loaded for the functions above.
    _library: libloading::Library,
}

/// Why libController could not be used.
#[derive(Debug)]
pub struct LoadError(String);

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for LoadError {}

/// Binds one function by its C name.
macro_rules! bind {
    ($library:expr, $name:literal) => {{
        // SAFETY: the signature is that of the header named above.
        let symbol = unsafe { $library.get(concat!($name, "\0").as_bytes()) };
        *symbol.map_err(|error| LoadError(format!("libController lacks {}: {error}", $name)))?
    }};
}

impl LibController {
    /// Finds libController at the paths where Webots' own controllers look for it, and loads it. `home`: value of
    /// `WEBOTS_HOME`, if it is set. An error names the paths that were tried, or a function that the library lacks.
    pub fn load(home: Option<&Path>) -> Result<Self, LoadError> {
        let mut tried = Vec::new();
        for place in library_paths::candidates(home) {
            // SAFETY: loading Webots' own library runs its initialisers, which only set up its globals.
            match unsafe { libloading::Library::new(&place) } {
                Ok(library) => return Self::bind(library),
                Err(_) => tried.push(place.display().to_string()),
            }
        }
        Err(LoadError(format!(
            "Webots' libController was not found; set WEBOTS_HOME to where Webots is installed (tried {})",
            tried.join(", ")
        )))
    }

    fn bind(library: libloading::Library) -> Result<Self, LoadError> {
        Ok(Self {
            init: bind!(library, "wb_robot_init"),
            step: bind!(library, "wb_robot_step"),
            cleanup: bind!(library, "wb_robot_cleanup"),
            name: bind!(library, "wb_robot_get_name"),
            time: bind!(library, "wb_robot_get_time"),
            basic_time_step: bind!(library, "wb_robot_get_basic_time_step"),
            device: bind!(library, "wb_robot_get_device"),
            motor_position: bind!(library, "wb_motor_set_position"),
            motor_velocity: bind!(library, "wb_motor_set_velocity"),
            sensor_enable: bind!(library, "wb_position_sensor_enable"),
            sensor_value: bind!(library, "wb_position_sensor_get_value"),
            gps_enable: bind!(library, "wb_gps_enable"),
            gps_values: bind!(library, "wb_gps_get_values"),
            compass_enable: bind!(library, "wb_compass_enable"),
            compass_values: bind!(library, "wb_compass_get_values"),
            led_set: bind!(library, "wb_led_set"),
            distance_enable: bind!(library, "wb_distance_sensor_enable"),
            distance_value: bind!(library, "wb_distance_sensor_get_value"),
            distance_type: bind!(library, "wb_distance_sensor_get_type"),
            distance_table_size: bind!(library, "wb_distance_sensor_get_lookup_table_size"),
            distance_table: bind!(library, "wb_distance_sensor_get_lookup_table"),
            _library: library,
        })
    }

    /// Connects to the simulation. Waits up to about 50 s, and ends the process if there is no simulation.
    pub fn init(&self) {
        (self.init)();
    }

    /// Advances the simulation by `millis` milliseconds, a multiple of the world's basic step. Returns `false` if the
    /// simulation ends; then call only [`cleanup`](Self::cleanup).
    pub fn step(&self, millis: i32) -> bool {
        (self.step)(millis) != -1
    }

    /// Disconnects from the simulation. Make this the last call: if the simulation ends, it ends the process.
    pub fn cleanup(&self) {
        (self.cleanup)();
    }

    /// The robot's name in the Webots world.
    pub fn name(&self) -> String {
        let text = (self.name)();
        if text.is_null() {
            return String::new();
        }
        // SAFETY: the library returns a zero-terminated string that lives until the process ends.
        unsafe { std::ffi::CStr::from_ptr(text) }.to_string_lossy().into_owned()
    }

    /// Simulated time since the start of the simulation, seconds.
    pub fn time_s(&self) -> f64 {
        (self.time)()
    }

    /// Basic step of the Webots world, milliseconds.
    pub fn basic_time_step_ms(&self) -> f64 {
        (self.basic_time_step)()
    }

    /// The device with this name; `None` if the robot has no such device.
    pub fn device(&self, name: &str) -> Option<DeviceTag> {
        let name = CString::new(name).ok()?;
        Some((self.device)(name.as_ptr())).filter(|tag| *tag != 0)
    }

    /// Sets a motor's target position, in radians as the motor's sensor reads them. With infinity, the motor turns at
    /// its rate without end.
    pub fn motor_position(&self, motor: DeviceTag, radians: f64) {
        (self.motor_position)(motor, radians);
    }

    /// Sets a motor's rate, rad/s. It may be negative only if the target position is infinite. Towards a finite
    /// position, Webots chooses the sign.
    pub fn motor_velocity(&self, motor: DeviceTag, radps: f64) {
        (self.motor_velocity)(motor, radps);
    }

    /// Samples a position sensor every `millis`.
    pub fn sensor_enable(&self, sensor: DeviceTag, millis: i32) {
        (self.sensor_enable)(sensor, millis);
    }

    /// Value of a position sensor, radians; NaN before its first sample.
    pub fn sensor_value(&self, sensor: DeviceTag) -> f64 {
        (self.sensor_value)(sensor)
    }

    /// Samples a GPS every `millis`.
    pub fn gps_enable(&self, gps: DeviceTag, millis: i32) {
        (self.gps_enable)(gps, millis);
    }

    /// World x, y and z of a GPS, metres; NaN before its first sample.
    pub fn gps_values(&self, gps: DeviceTag) -> [f64; 3] {
        three((self.gps_values)(gps))
    }

    /// Samples a compass every `millis`.
    pub fn compass_enable(&self, compass: DeviceTag, millis: i32) {
        (self.compass_enable)(compass, millis);
    }

    /// Direction of north in body space, as x, y and z; NaN before the first sample.
    pub fn compass_values(&self, compass: DeviceTag) -> [f64; 3] {
        three((self.compass_values)(compass))
    }

    /// Sets the colour of a light, R·65536 + G·256 + B.
    pub fn led_set(&self, led: DeviceTag, colour: u32) {
        (self.led_set)(led, colour as c_int);
    }

    /// Samples a distance sensor every `millis`.
    pub fn distance_enable(&self, sensor: DeviceTag, millis: i32) {
        (self.distance_enable)(sensor, millis);
    }

    /// Value of a distance sensor, in the units of its look-up table; NaN before its first sample.
    pub fn distance_value(&self, sensor: DeviceTag) -> f64 {
        (self.distance_value)(sensor)
    }

    /// Whether the readings of a distance sensor depend on colours (`WB_DISTANCE_SENSOR_INFRA_RED`).
    pub fn distance_is_infra_red(&self, sensor: DeviceTag) -> bool {
        (self.distance_type)(sensor) == 1
    }

    /// Look-up table of a distance sensor. Each row: distance in metres, value, noise as a share of the value. Sorted
    /// by distance.
    pub fn distance_table(&self, sensor: DeviceTag) -> Vec<[f64; 3]> {
        let rows = usize::try_from((self.distance_table_size)(sensor)).unwrap_or(0);
        let table = (self.distance_table)(sensor);
        if table.is_null() {
            return Vec::new();
        }
        // SAFETY: the library returns three doubles per row, which are valid until the simulation changes the table.
        (0..rows).map(|row| unsafe { *table.add(3 * row).cast::<[f64; 3]>() }).collect()
    }
}

fn three(values: *const c_double) -> [f64; 3] {
    if values.is_null() {
        return [f64::NAN; 3];
    }
    // SAFETY: GPS and compass return three doubles that are valid until the next step.
    unsafe { [*values, *values.add(1), *values.add(2)] }
}
