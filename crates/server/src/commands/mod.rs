//! Commands of the program, with one file or folder for most of them.

pub mod backup;
pub mod broker;
pub mod certs;
pub mod check;
pub mod convert;
mod enter_key;
mod first_operator;
pub mod guard;
pub mod make;
pub mod passwd;
pub mod picture;
pub mod plan;
pub mod play;
pub mod rehearse;
pub mod render;
pub mod replay;
pub mod report;
pub mod robot_check;
pub mod robots;
pub mod run;

use lightbots_api as api;
use serde::Serialize;

use crate::failure::Failure;
use crate::say;

/// Prints a value as one JSON object on stdout.
pub(crate) fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value)
        .map_err(|error| Failure::problem(format!("the answer cannot be written as JSON: {error}")))?;
    say::line(&text);
    Ok(())
}

/// Prints issues for people, one line each.
pub(crate) fn print_issues(issues: &[api::Issue]) {
    for issue in issues {
        let level = match issue.severity {
            api::Severity::Error => "error",
            api::Severity::Warning => "warning",
            api::Severity::Note => "note",
        };
        say::line(&format!("{level}: {} [{}]", issue.message, issue.code));
    }
}

/// Formats a number with its noun: `1 robot`, `2 robots`.
fn count(number: usize, one: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {one}s") }
}
