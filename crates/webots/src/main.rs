//! `LightBotFirmware`: the controller of a LightBot in Webots.

use std::process::ExitCode;

use clap::Parser;
use lightbots_base::RobotId;
use lightbots_link::{ArgumentsError, BrokerArguments, BrokerUrl, random_id};
use lightbots_webots::{DriverSettings, LibController, drive, print_problem};

/// Default broker: the one of `lightbots run` on this machine.
const BROKER: &str = "mqtt://default:default@127.0.0.1:1883";

/// The robot core as a Webots controller. Webots starts it; by hand it serves a robot whose controller is `<extern>`.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Broker: mqtt[s]://[user[:password]@]host[:port], more addresses after commas [default:
    /// mqtt://default:default@127.0.0.1:1883]
    #[arg(long, env = "LIGHTBOTS_BROKER", value_name = "URL", hide_env_values = true)]
    broker: Vec<String>,
    #[command(flatten)]
    login: BrokerArguments,
    /// Name of the robot [default: a new UUID]
    #[arg(long)]
    id: Option<String>,
    /// Disable the proximity sensors
    #[arg(long)]
    blind: bool,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            print_problem(&message);
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
        LibController::load(home.as_deref().map(std::path::Path::new)).map_err(|error| error.to_string())?;
    library.init();
    let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build();
    let runtime = runtime.map_err(|error| format!("cannot start the network: {error}"))?;
    let outcome =
        runtime.block_on(async { drive(&library, &DriverSettings { id, broker, blind: arguments.blind }) });
    // If the simulation ends, the next call does not return, so the connection is closed before.
    runtime.shutdown_background();
    library.cleanup();
    outcome.map_err(|missing| missing.to_string())
}

/// Returns the broker of the command line, or `BROKER` if there is none.
fn broker(arguments: &Arguments) -> Result<BrokerUrl, ArgumentsError> {
    let own = [BROKER.to_owned()];
    arguments.login.broker(if arguments.broker.is_empty() { &own } else { &arguments.broker })
}
