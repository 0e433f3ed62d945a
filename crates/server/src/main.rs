//! The program `lightbots`: sockets, embedded broker, files and clocks around the cores.
//!
//! `main` reads the command line and runs a command; `commands` has one file or folder for each. `live` holds what a
//! running fleet needs: the broker, the task that owns the controller core, the simulated robots. `web` is the screen's
//! server. The cores, and not this program, decide about shows and robots.

mod accounts;
mod backup;
mod broker_settings;
mod cli;
mod commands;
mod data_folder;
mod disk;
mod examples;
mod failure;
mod fleet_book;
mod growing_file;
mod json_file;
mod layer_pictures;
mod library;
mod live;
mod logging;
mod numbers;
mod open_files;
mod own_program;
mod played_shows;
mod playlist;
mod playlist_player;
mod progress;
mod run_report;
mod say;
mod sentences;
mod show_file;
mod show_plan;
mod stop;
mod threads;
mod tls;
mod web;

use clap::Parser;

use crate::cli::{Cli, Command};
use crate::failure::Failure;
use crate::stop::Stop;

fn main() {
    let runtime = match tokio::runtime::Builder::new_multi_thread().enable_all().build() {
        Ok(runtime) => runtime,
        Err(error) => {
            say::error(&format!("the system gives no threads: {error}"));
            std::process::exit(1);
        }
    };
    let code = runtime.block_on(async {
        // The first thing, so that an early Ctrl-C or TERM is not missed.
        let stop = Stop::install();
        match Cli::try_parse() {
            Ok(cli) => run(cli, stop).await,
            Err(error) => misuse(&error),
        }
    });
    // Exits here, because returning would wait for a plan that another thread is still making.
    std::process::exit(code);
}

/// Prints help, version, or one line about wrong use. Returns the exit code.
fn misuse(error: &clap::Error) -> i32 {
    let lists_commands = error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if !error.use_stderr() || lists_commands {
        // Printing fails if the reader of the output has gone away, which is no error.
        let _ = error.print();
        return if lists_commands { 2 } else { 0 };
    }
    let text = error.to_string();
    let lines: Vec<&str> = text.lines().take_while(|line| !line.trim().is_empty()).map(str::trim).collect();
    say::error(&format!("{} (--help explains)", lines.join(" ").trim_start_matches("error: ")));
    2
}

/// Runs one command. Returns its exit code: 0 fine, 1 problems that were printed, 2 wrong use or unreadable input, 130
/// cancelled.
async fn run(cli: Cli, stop: Stop) -> i32 {
    logging::start(cli.log);
    let outcome = match cli.command {
        Command::Run(arguments) => commands::run::run(*arguments, stop).await,
        Command::Check(arguments) => stop.at_once(|| commands::check::run(&arguments)),
        Command::Plan(arguments) => stop.at_once(|| commands::plan::run(&arguments)),
        Command::Rehearse(arguments) => stop.at_once(|| commands::rehearse::run(&arguments)),
        Command::Replay(arguments) => stop.at_once(|| commands::replay::run(&arguments)),
        Command::Report(arguments) => stop.at_once(|| commands::report::run(&arguments)),
        Command::Play(arguments) => commands::play::run(arguments, stop).await,
        Command::Robots(arguments) => commands::robots::run(arguments, stop).await,
        Command::RobotCheck(arguments) => commands::robot_check::run(arguments, stop).await,
        Command::Broker(arguments) => commands::broker::run(arguments, stop).await,
        Command::Convert(arguments) => stop.at_once(|| commands::convert::run(&arguments)),
        Command::Make(arguments) => stop.at_once(|| commands::make::run(&arguments)),
        Command::Render(arguments) => {
            stop.take_over();
            tokio::task::block_in_place(|| commands::render::run(&arguments, &stop))
        }
        Command::Picture => stop.at_once(commands::picture::run),
        Command::Passwd(arguments) => stop.at_once(|| commands::passwd::run(&arguments)),
        Command::Backup(arguments) => stop.at_once(|| commands::backup::save(&arguments)),
        Command::Restore(arguments) => stop.at_once(|| commands::backup::restore(&arguments)),
        Command::Certs(arguments) => stop.at_once(|| commands::certs::run(&arguments)),
    };
    match outcome {
        Ok(true) => 0,
        Ok(false) => 1,
        Err(Failure { line, code }) => {
            say::error(&line);
            code
        }
    }
}
