//! `plan`: writes the timed paths of a show to a file.

use super::check::Summary;
use super::print_json;
use crate::cli::PlanArguments;
use crate::failure::{Failure, Outcome};
use crate::{say, show_file, show_plan};

pub fn run(arguments: &PlanArguments) -> Outcome {
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    let (made, plan) = show_plan::plan(&opened.show, &opened.issues);
    let out = &arguments.out;
    let text = serde_json::to_string(&plan).map_err(|error| Failure::unwritable(out, &error))?;
    show_file::write(out, (text + "\n").into_bytes())?;
    let summary = Summary::new(&opened.show, &made, &plan);
    if arguments.json {
        print_json(&summary)?;
    } else {
        summary.print(&opened.show);
        say::line(&format!("paths written to {}", out.display()));
    }
    Ok(plan.ok)
}
