//! A stand-in for Webots' libController: the same C functions, connected to our simulated floor by a socket.
//!
//! It allows tests of the Webots driver without Webots. It copies some special cases of Webots:
//! - values are NaN before the first sample;
//! - a negative rate is refused while a motor has a finite target position;
//! - when the simulation ends, a step returns −1, and the next step or the cleanup ends the process.
//!
//! The floor at the other end of the socket adds two more. Position sensors show less than the wheels turn. Motors keep
//! their last command when their controller ends.
//!
//! [`socket`] describes the messages on the socket.
#![allow(unsafe_code)]
// Named after Webots' file.
#![allow(non_snake_case)]

mod devices;
pub mod motor;
pub mod proximity;
pub mod socket;
mod state;

use std::ffi::{CStr, c_char, c_double, c_int};

use devices::Tag;
use state::with;

/// Connects to the simulated floor. If there is none, ends the process, as Webots' library does.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_init() -> c_int {
    state::connect();
    1
}

/// Advances the simulation by `millis` milliseconds, a multiple of 16. Returns 0, or −1 if the simulation ends. After
/// −1, the next call of this function ends the process.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_step(millis: c_int) -> c_int {
    with(|robot| robot.step(millis))
}

/// Disconnects from the floor. Ends the process if the simulation has ended.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_cleanup() {
    with(|robot| robot.cleanup());
}

/// The robot's name in the world.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_name() -> *const c_char {
    with(|robot| robot.name.as_ptr())
}

/// Simulated time at the latest step, seconds; 0 before the first step.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_time() -> c_double {
    with(|robot| robot.reply.time_s)
}

/// Basic step of the simulation, milliseconds.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_basic_time_step() -> c_double {
    16.0
}

/// Tag of the device with this name; 0: no such device.
///
/// # Safety
/// `name` must be null or a zero-terminated string.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn wb_robot_get_device(name: *const c_char) -> Tag {
    if name.is_null() {
        return 0;
    }
    // SAFETY: the caller promises a zero-terminated string.
    devices::tag(unsafe { CStr::from_ptr(name) }.to_bytes())
}

/// Sets a motor's target position, radians. With infinity, the motor turns at its rate without end.
#[unsafe(no_mangle)]
pub extern "C" fn wb_motor_set_position(tag: Tag, position: c_double) {
    with(|robot| robot.aim_motor(tag, position));
}

/// Sets a motor's rate, rad/s, limited to ±[`motor::RATE_MAX_RADPS`]. A negative rate is refused while the motor has a
/// finite target position.
#[unsafe(no_mangle)]
pub extern "C" fn wb_motor_set_velocity(tag: Tag, radps: c_double) {
    with(|robot| robot.turn_motor(tag, radps));
}

/// Enables a wheel's sensor.
#[unsafe(no_mangle)]
pub extern "C" fn wb_position_sensor_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// Value of a wheel's sensor, radians; NaN before the first sample.
#[unsafe(no_mangle)]
pub extern "C" fn wb_position_sensor_get_value(tag: Tag) -> c_double {
    with(|robot| robot.wheel_sensor(tag))
}

/// Enables the GPS.
#[unsafe(no_mangle)]
pub extern "C" fn wb_gps_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// World x, y and z of the robot, metres; z is 0. NaN before the first sample. The pointer stays valid; the values
/// change with the steps.
#[unsafe(no_mangle)]
pub extern "C" fn wb_gps_get_values(_tag: Tag) -> *const c_double {
    with(|robot| robot.gps().as_ptr())
}

/// Enables the compass.
#[unsafe(no_mangle)]
pub extern "C" fn wb_compass_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// Direction of north (world +y) in body space, as x, y and z; NaN before the first sample. The pointer stays valid;
/// the values change with the steps.
#[unsafe(no_mangle)]
pub extern "C" fn wb_compass_get_values(_tag: Tag) -> *const c_double {
    with(|robot| robot.compass().as_ptr())
}

/// Sets the colour of the light, R·65536 + G·256 + B. It counts from the next step on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_led_set(_tag: Tag, colour: c_int) {
    with(|robot| robot.command.colour = colour as u32);
}

/// Enables a proximity sensor.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// Value of a proximity sensor, in the units of its look-up table; NaN before the first sample.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_value(tag: Tag) -> c_double {
    with(|robot| robot.proximity(tag))
}

/// Type of a proximity sensor: `WB_DISTANCE_SENSOR_GENERIC`, with one ray.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_type(_tag: Tag) -> c_int {
    0
}

/// Number of rows of a proximity sensor's look-up table.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_lookup_table_size(_tag: Tag) -> c_int {
    proximity::TABLE.len() as c_int
}

/// Look-up table of a proximity sensor: each row has distance in metres, value, and noise as a share of the value.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_lookup_table(_tag: Tag) -> *const c_double {
    proximity::TABLE.as_ptr().cast()
}
