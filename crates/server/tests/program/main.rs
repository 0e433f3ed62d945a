//! The program as it is used: real processes, real brokers, real sockets.
//!
//! Tests wait for conditions and not for fixed times. Deadlines are long, because they only matter when something is
//! broken. Tests with robots run one at a time, so that a small machine keeps up.

// A failing test prints the output of its child processes.
#![allow(clippy::print_stderr)]

mod backup;
mod broker_choice;
mod broker_outages;
mod certificates;
mod child;
#[cfg(unix)]
mod cluster;
mod commands;
mod conformance;
mod crossings;
mod cues;
mod desk_light;
mod example_brokers;
mod fleet;
mod guesses;
mod hostile_clients;
mod hostile_layers;
mod hostile_shows;
mod http;
mod layer_pictures;
mod library;
mod make;
mod mosquitto;
mod mutations;
mod original_controller;
mod original_robot;
mod plain_mqtt;
mod playlist;
mod python;
#[cfg(unix)]
mod rabbitmq;
mod raw_mqtt;
mod recording;
mod refusals;
mod render;
mod returns;
mod rights;
mod robot_check;
mod run;
mod screen;
mod show_time;
mod shows;
mod sign_in;
mod site;
mod sound_desk;
mod strangers;
mod web_tls;

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Longest wait for any condition. After it a test fails.
const DEADLINE: Duration = Duration::from_secs(120);

/// Waits until no other test with robots runs, and holds the others back while the guard lives.
fn alone() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Calls `look` until it returns a value, and returns that value. Panics after [`DEADLINE`].
fn wait_for<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let until = Instant::now() + DEADLINE;
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(Instant::now() < until, "waited {} s in vain for {what}", DEADLINE.as_secs());
        std::thread::sleep(Duration::from_millis(20));
    }
}
