//! A stand-in for Webots' libController: the same C functions, with a floor of ours behind a socket.
//!
//! It lets the Webots driver be tested without Webots. What makes drivers stumble is copied: NaN before the first
//! sample, a negative rate that is refused before the motor was freed, motors that do what they were told last when their
//! controller is gone, position sensors that under-read, a step that returns −1 once, after which the process ends in the
//! next call. [`socket`] says what goes over the socket.
#![allow(unsafe_code)]
// Named after the file that Webots has.
#![allow(non_snake_case)]

mod devices;
pub mod motor;
pub mod proximity;
pub mod socket;
mod state;

use std::ffi::{CStr, c_char, c_double, c_int};

use devices::Tag;
use state::with;

/// Connects to the floor; ends the process where there is none, as Webots' library does.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_init() -> c_int {
    state::connect();
    1
}

/// Goes on by a step; −1: the simulation ends.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_step(millis: c_int) -> c_int {
    with(|robot| robot.step(millis))
}

/// Ends the process where the simulation is ending.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_cleanup() {
    with(|robot| robot.cleanup());
}

/// The robot's name in the world.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_name() -> *const c_char {
    with(|robot| robot.name.as_ptr())
}

/// Simulated seconds.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_time() -> c_double {
    with(|robot| robot.seen.time_s)
}

/// Milliseconds of a step.
#[unsafe(no_mangle)]
pub extern "C" fn wb_robot_get_basic_time_step() -> c_double {
    16.0
}

/// A device's tag by its name; 0: none.
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

/// Where a motor turns to, radians; infinity: on and on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_motor_set_position(tag: Tag, position: c_double) {
    with(|robot| robot.aim_motor(tag, position));
}

/// Sets a motor's rate, rad/s.
#[unsafe(no_mangle)]
pub extern "C" fn wb_motor_set_velocity(tag: Tag, radps: c_double) {
    with(|robot| robot.turn_motor(tag, radps));
}

/// Switches a wheel's sensor on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_position_sensor_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// A wheel's sensor, radians.
#[unsafe(no_mangle)]
pub extern "C" fn wb_position_sensor_get_value(tag: Tag) -> c_double {
    with(|robot| robot.wheel_sensor(tag))
}

/// Switches the GPS on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_gps_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// World x, y, z, metres; the pointer is good until the next step.
#[unsafe(no_mangle)]
pub extern "C" fn wb_gps_get_values(_tag: Tag) -> *const c_double {
    with(|robot| robot.gps().as_ptr())
}

/// Switches the compass on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_compass_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// North in the robot's body; the pointer is good until the next step.
#[unsafe(no_mangle)]
pub extern "C" fn wb_compass_get_values(_tag: Tag) -> *const c_double {
    with(|robot| robot.compass().as_ptr())
}

/// Shows a colour.
#[unsafe(no_mangle)]
pub extern "C" fn wb_led_set(_tag: Tag, colour: c_int) {
    with(|robot| robot.told.colour = colour as u32);
}

/// Switches a proximity sensor on.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_enable(tag: Tag, _millis: c_int) {
    with(|robot| robot.enable(tag));
}

/// What a proximity sensor reads, as its table has it.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_value(tag: Tag) -> c_double {
    with(|robot| robot.proximity(tag))
}

/// How a proximity sensor measures: `WB_DISTANCE_SENSOR_GENERIC`, by one ray.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_type(_tag: Tag) -> c_int {
    0
}

/// Rows of a proximity sensor's table.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_lookup_table_size(_tag: Tag) -> c_int {
    proximity::TABLE.len() as c_int
}

/// A proximity sensor's table: distance, value, noise.
#[unsafe(no_mangle)]
pub extern "C" fn wb_distance_sensor_get_lookup_table(_tag: Tag) -> *const c_double {
    proximity::TABLE.as_ptr().cast()
}
