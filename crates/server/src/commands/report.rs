//! `report`: what was planned and what happened in a recorded run, as an HTML page and as numbers.

use lightbots_report::{page, report_of};
use serde_json::json;

use super::print_json;
use super::replay::replayed;
use crate::cli::ReportArguments;
use crate::disk::{self, Readers};
use crate::failure::{Failure, Outcome};
use crate::say;

pub fn run(arguments: &ReportArguments) -> Outcome {
    let (report, scrub) =
        replayed(&arguments.run, arguments.data.as_ref(), "reading the run", |log, progress| {
            report_of(log, progress)
        })?;
    if let Some(out) = &arguments.out {
        disk::replace(out, page(&report, &scrub).as_bytes(), Readers::All)
            .map_err(|error| Failure::input(format!("{} cannot be written: {error}", out.display())))?;
    }
    if arguments.json {
        let mut value = serde_json::to_value(&report).unwrap_or_default();
        value["out"] = json!(arguments.out);
        print_json(&value)?;
    } else {
        say::line(&report.verdict);
        if let Some(out) = &arguments.out {
            say::line(&format!("The report is in {}", out.display()));
        }
    }
    Ok(report.ok)
}
