//! `report`: what was planned and what happened in a recorded run, as a page and as figures.

use std::panic::catch_unwind;

use lightbots_report::{page, report_of};
use serde_json::json;

use super::print_json;
use super::replay::{BYTES_MAX, path};
use crate::cli::ReportArguments;
use crate::disk::{self, Readers};
use crate::failure::{Failure, Outcome};
use crate::progress::Bar;
use crate::say;

pub fn run(arguments: &ReportArguments) -> Outcome {
    let path = path(&arguments.run, arguments.data.as_ref());
    let failed = |why: String| Failure::input(format!("{}: {why}", path.display()));
    let log =
        disk::read_regular(&path, BYTES_MAX).map_err(|error| failed(format!("cannot be read: {error}")))?;
    // A log may come from a program that failed: then the core fails again.
    let made = catch_unwind(|| {
        let bar = Bar::new();
        report_of(&log, None, &mut |share| bar.set(share, "reading the run"))
    });
    let Ok(made) = made else {
        return Err(Failure::problem(format!("{}: the controller failed in this run", path.display())));
    };
    let (report, scrub) = made.map_err(|error| failed(error.to_string()))?;
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
