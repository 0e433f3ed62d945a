//! `LightBotFirmware`: the controller of a LightBot in Webots.

use std::process::ExitCode;

use clap::Parser;
use lightbots_base::RobotId;
use lightbots_link::{ArgumentsError, BrokerArguments, BrokerUrl, random_id};
use lightbots_webots::{Library, Settings, complain, drive};

/// Where `lightbots run` listens on this machine.
const BROKER: &str = "mqtt://default:default@127.0.0.1:1883";

/// The robot core as a Webots controller. Webots starts it; by hand it serves a robot whose controller is `<extern>`.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// The broker: mqtt[s]://[user[:password]@]host[:port], more addresses of it after commas [default:
    /// mqtt://default:default@127.0.0.1:1883]
    #[arg(long, env = "LIGHTBOTS_BROKER", value_name = "URL", hide_env_values = true)]
    broker: Vec<String>,
    #[command(flatten)]
    login: BrokerArguments,
    /// What the robot calls itself; a new UUID otherwise
    #[arg(long)]
    id: Option<String>,
    /// Do not read the proximity sensors, which cost a slow machine time
    #[arg(long)]
    blind: bool,
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
    let broker = broker(arguments).map_err(|error| error.to_string())?;
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
    let outcome =
        runtime.block_on(async { drive(&library, &Settings { id, broker, blind: arguments.blind }) });
    // Where the simulation ends, the next call does not return: the connection must be gone before it.
    runtime.shutdown_background();
    library.cleanup();
    outcome.map_err(|missing| missing.to_string())
}

/// The broker named, or the one that `lightbots run` brings.
fn broker(arguments: &Arguments) -> Result<BrokerUrl, ArgumentsError> {
    let own = [BROKER.to_owned()];
    arguments.login.broker(if arguments.broker.is_empty() { &own } else { &arguments.broker })
}
