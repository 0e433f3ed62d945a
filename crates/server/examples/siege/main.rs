//! Measures a show under attack. `lightbots run` plays a show of thirty robots repeatedly while hostile clients attack
//! its broker and its web server.
//!
//! `cargo xtask bench siege` runs it for ten minutes, and `siege SECONDS` for another time. A row has the duration of
//! the show with and without attacks, and the peak memory of program and broker together.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../common/mod.rs"]
mod common;

mod broker_attacks;
#[path = "../common/packets.rs"]
mod packets;
mod program;
mod screen;
mod web_attacks;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use common::Outcome;
use program::Program;
use screen::Screen;

/// Default duration of the attacks, seconds.
const SECONDS: u64 = 600;

/// The attacked program, as all attackers share it.
pub struct Target {
    /// Address of the web server.
    pub web: String,
    /// Address of the broker.
    pub broker: String,
    is_over: AtomicBool,
    /// Number of packets, connections and requests that attackers have sent.
    pub attacks: AtomicU64,
}

impl Target {
    /// Repeats an attack until the siege is over. Errors such as a closed connection do not stop it.
    fn repeat(
        self: &Arc<Self>,
        pause: Duration,
        mut attack: impl FnMut(&Self) -> std::io::Result<()> + Send + 'static,
    ) {
        let target = self.clone();
        std::thread::spawn(move || {
            while !target.is_over.load(Ordering::Relaxed) {
                let _ = attack(&target);
                target.attacks.fetch_add(1, Ordering::Relaxed);
                std::thread::sleep(pause);
            }
        });
    }
}

fn main() -> Outcome {
    let asked = std::env::args().skip(1).find_map(|argument| argument.parse().ok());
    let until = Duration::from_secs(asked.unwrap_or(SECONDS));
    let program = Program::start()?;
    let mut screen = Screen::open(&program.web)?;
    screen.wait_for_robots(30)?;
    let quiet_s = screen.play()?;
    let target = Arc::new(Target {
        web: program.web.clone(),
        broker: program.broker.clone(),
        is_over: AtomicBool::new(false),
        attacks: AtomicU64::new(0),
    });
    broker_attacks::begin(&target);
    web_attacks::begin(&target);
    let began = Instant::now();
    let mut times_s = Vec::new();
    while began.elapsed() < until {
        times_s.push(screen.play()?);
    }
    target.is_over.store(true, Ordering::Relaxed);
    let longest_s = times_s.iter().copied().fold(0.0, f64::max);
    println!(
        "{{\"minutes\":{:.1},\"attacks\":{},\"shows\":{},\"quiet_s\":{quiet_s:.2},\"longest_s\":{longest_s:.2},\
         \"dropouts\":{},\"broker_restarts\":{},\"peak_mb\":{:.0}}}",
        began.elapsed().as_secs_f64() / 60.0,
        target.attacks.load(Ordering::Relaxed),
        times_s.len(),
        screen.dropouts,
        screen.restarts,
        program.peak_bytes() as f64 / 1e6,
    );
    Ok(())
}
