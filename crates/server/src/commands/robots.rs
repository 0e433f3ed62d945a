//! `robots`: simulated robots only.

use lightbots_show::{Stage, front_rows};
use lightbots_sim::{Conditions, Faults, FleetConfig};

use super::count;
use crate::cli::RobotsArguments;
use crate::failure::{Failure, Outcome};
use crate::live::conductor::LOOK;
use crate::live::crowd::Crowd;
use crate::stop::Stop;
use crate::{open_files, say};

pub async fn run(arguments: RobotsArguments, stop: Stop) -> Outcome {
    stop.take_over();
    let faults = Faults::parse(arguments.faults.as_deref().unwrap_or(""))
        .map_err(|error| Failure::input(format!("--faults: {error}")))?;
    let broker = arguments.login.broker(&arguments.broker)?;
    open_files::raise_limit();
    let robots = arguments.count as usize;
    let (width_m, depth_m) = arguments.floor;
    let stage = Stage { width_m, depth_m, ..Stage::default() };
    let starts = front_rows(&stage, robots);
    let conditions = faults.added_to(conditions(arguments.ideal));
    let config = FleetConfig { stage, starts, seed: seed(arguments.seed), conditions };
    let crowd = Crowd::start(&config, &broker, arguments.together as usize, &stop);
    let connected = crowd.connections();
    let going = tokio::spawn(crowd.run(stop.clone()));
    say::note(&format!("{} connecting to {}; Ctrl-C stops them", count(robots, "robot"), broker));
    while !stop.is_wanted() && !connected.all() {
        tokio::time::sleep(LOOK).await;
    }
    if connected.all() {
        say::line(&format!("{} connected to {}", count(robots, "robot"), broker));
    }
    going.await.map_err(|error| Failure::problem(format!("the simulation failed: {error}")))?;
    Ok(true)
}

/// What simulated robots suffer.
pub(super) fn conditions(ideal: bool) -> Conditions {
    if ideal { Conditions::ideal() } else { Conditions::default() }
}

/// The seed asked for, or any.
pub(super) fn seed(asked: Option<u64>) -> u64 {
    asked.unwrap_or_else(|| {
        let mut bytes = [0; 8];
        // Without randomness of the system the process id tells fleets apart.
        if getrandom::fill(&mut bytes).is_err() {
            return u64::from(std::process::id());
        }
        u64::from_le_bytes(bytes)
    })
}
