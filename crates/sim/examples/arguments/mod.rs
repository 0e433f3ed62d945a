//! What the examples that rehearse many runs have in common: their arguments, and how they end.

use std::process::ExitCode;

use lightbots_sim::{Conditions, Faults};

/// Runs a program with its arguments; it says whether all was fine, or how it is used.
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

/// The number at a place, or the usual one where there is none.
pub fn number(args: &[String], index: usize, usual: u64, usage: &str) -> Result<u64, String> {
    match args.get(index) {
        Some(text) => text.parse().map_err(|_| format!("'{text}' is no number; {usage}")),
        None => Ok(usual),
    }
}

/// Standard conditions, with the faults at a place on top; or `ideal` ones.
pub fn conditions(args: &[String], index: usize) -> Result<Conditions, String> {
    match args.get(index).map_or("", String::as_str) {
        "" => Ok(Conditions::default()),
        "ideal" => Ok(Conditions::ideal()),
        faults => {
            let faults = Faults::parse(faults).map_err(|error| error.to_string())?;
            Ok(faults.added_to(Conditions::default()))
        }
    }
}
