//! Arguments and exit codes of the examples that rehearse many runs.
#![allow(dead_code)] // Each example uses a part of it.

use std::process::ExitCode;

use lightbots_show::Show;
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Runs `run` with the program's arguments. It returns whether all was fine, or an error with the usage.
pub fn main(run: impl FnOnce(&[String]) -> Result<bool, String>) -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match run(&args) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

/// The number at this index, or `usual` if there is none. An error if the argument is no number.
pub fn number(args: &[String], index: usize, usual: u64, usage: &str) -> Result<u64, String> {
    match args.get(index) {
        Some(text) => text.parse().map_err(|_| format!("'{text}' is no number; {usage}")),
        None => Ok(usual),
    }
}

/// The conditions at this index: standard ones with the given faults added, or `ideal` ones.
pub fn conditions(args: &[String], index: usize) -> Result<Conditions, String> {
    match args.get(index).map_or("", String::as_str) {
        "" => Ok(Conditions::default()),
        "ideal" => Ok(Conditions::ideal()),
        faults => standard_with(faults),
    }
}

fn standard_with(faults: &str) -> Result<Conditions, String> {
    let faults = Faults::parse(faults).map_err(|error| error.to_string())?;
    Ok(faults.added_to(Conditions::default()))
}

/// Reads the show in a file.
pub fn show(path: &str) -> Result<Show, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{path}: {error}"))?;
    Ok(lightbots_exchange::read(&bytes, Some(path)).map_err(|error| format!("{path}: {error}"))?.show)
}

/// The files from this index on, or shows/hello.json if there are none.
pub fn show_files(args: &[String], index: usize) -> Vec<String> {
    let files = args.get(index..).unwrap_or_default();
    if files.is_empty() { vec!["shows/hello.json".to_owned()] } else { files.to_vec() }
}

/// Rehearses under standard conditions with these faults. An empty text means no faults.
pub fn play(show: &Show, faults: &str, seed: u64) -> Result<RehearsalReport, String> {
    let conditions = if faults.is_empty() { Conditions::default() } else { standard_with(faults)? };
    Ok(rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {}))
}

/// Number of issues of a report with this code.
pub fn count(report: &RehearsalReport, code: &str) -> usize {
    report.issues.iter().filter(|issue| issue.code == code).count()
}
