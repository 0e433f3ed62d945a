//! `LightBotFirmware`: the controller of a LightBot in Webots.

use std::process::ExitCode;

use clap::Parser;
use lightbots_base::RobotId;
use lightbots_link::{BrokerUrl, random_id};
use lightbots_webots::{Library, Settings, drive};

/// The robot core as a Webots controller. Webots starts it; by hand it serves a robot whose controller is `<extern>`.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// The broker, such as mqtt://user:password@host:1883
    #[arg(long, env = "LIGHTBOTS_BROKER", default_value = "mqtt://default:default@127.0.0.1:1883")]
    broker: String,
    /// What the robot calls itself; a new UUID otherwise
    #[arg(long)]
    id: Option<String>,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            complain(&message);
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let broker = BrokerUrl::parse(&arguments.broker).map_err(|error| error.to_string())?;
    let id = match &arguments.id {
        Some(text) => RobotId::new(text).ok_or_else(|| format!("'{text}' cannot be a robot's name"))?,
        None => random_id(),
    };
    let home = std::env::var_os("WEBOTS_HOME");
    let library =
        Library::load(home.as_deref().map(std::path::Path::new)).map_err(|error| error.to_string())?;
    library.init();
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build();
    let runtime = runtime.map_err(|error| format!("cannot start the network: {error}"))?;
    let outcome = runtime.block_on(async { drive(&library, &Settings { id, broker }) });
    // Where the simulation ends, the next call does not return: the connection must be gone before it.
    runtime.shutdown_background();
    library.cleanup();
    outcome.map_err(|missing| missing.to_string())
}

#[allow(clippy::print_stderr)]
fn complain(message: &str) {
    eprintln!("LightBotFirmware: {message}");
}
