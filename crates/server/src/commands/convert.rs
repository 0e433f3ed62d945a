//! `convert`: a show in another format.

use std::path::Path;

use lightbots_lighting::validate;
use lightbots_make::fit_show;
use lightbots_show::{Issue, Issues, Show};

use super::guard;
use crate::cli::ConvertArguments;
use crate::failure::{Failure, Outcome};
use crate::{say, show_file};

pub fn run(arguments: &ConvertArguments) -> Outcome {
    let (input, output) = (&arguments.input, &arguments.output);
    let format = show_file::format_of(output)?;
    let mut loaded = show_file::load(input)?;
    // Fitting draws the files in the show.
    let draws_files = arguments.robots.is_some() && !loaded.show.assets.is_empty();
    if let Some(outcome) = guard::child_outcome(draws_files) {
        return outcome;
    }
    let fitted = fitted(&mut loaded.show, arguments)?;
    if loaded.unread.is_some() && is_same_file(input, output) {
        let line = "it has parts that are not known, which would be lost; write to another file";
        return Err(Failure::input(format!("{}: {line}", output.display())));
    }
    let written = format.write(&loaded.show, loaded.plan.as_ref());
    let mut fine = true;
    for issue in loaded.issues.iter().chain(&fitted).chain(&validate(&loaded.show)).chain(&written.issues) {
        fine &= !issue.is_error();
        let level = if issue.is_error() { "error" } else { "warning" };
        say::note(&format!("{level}: {} [{}]", issue.message, issue.code));
    }
    show_file::write(output, written.bytes)?;
    Ok(fine)
}

/// Whether two paths lead to one file.
fn is_same_file(input: &Path, output: &Path) -> bool {
    let (input, output) = (input.canonicalize(), output.canonicalize());
    matches!((input, output), (Ok(input), Ok(output)) if input == output)
}

/// Fits the show to the robots that are asked for; what is different then.
fn fitted(show: &mut Show, arguments: &ConvertArguments) -> Result<Issues, Failure> {
    let Some(robots) = arguments.robots else { return Ok(Issues::new()) };
    let notes = fit_show(show, robots as usize).map_err(|error| {
        Failure::problem(format!("{}: {error} [{}]", arguments.input.display(), error.code))
    })?;
    Ok(notes.into_iter().map(|note| Issue::warning(note.code, note.message)).collect())
}
