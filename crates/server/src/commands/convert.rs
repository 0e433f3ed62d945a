//! `convert`: a show in another format.

use std::path::Path;

use lightbots_exchange::{Format, Loaded, Written, put_onto, replanned};
use lightbots_lighting::validate;
use lightbots_make::fit_show;
use lightbots_show::{Issue, Issues, Show};

use super::guard;
use crate::cli::ConvertArguments;
use crate::failure::{Failure, Outcome};
use crate::layer_pictures::LayerPictures;
use crate::{say, show_file, show_plan};

pub fn run(arguments: &ConvertArguments) -> Outcome {
    let output = &arguments.output;
    let format = show_file::format_of(output)?;
    let mut loaded = loaded(arguments)?;
    // Fitting a show to another fleet reads the files inside the show, which are untrusted.
    let draws_files = arguments.robots.is_some() && !loaded.show.assets.is_empty();
    if let Some(outcome) = guard::child_outcome(draws_files) {
        return outcome;
    }
    let watch = draws_files.then(guard::ReadingTime::start);
    if arguments.replan {
        replanned(&mut loaded.show);
    }
    let fitted = fitted(&mut loaded.show, arguments)?;
    watch.inspect(guard::ReadingTime::decoded);
    let read = arguments.onto.as_ref().unwrap_or(&arguments.input);
    if loaded.unread.is_some() && is_same_file(read, output) {
        let line = "it has parts that are not known, which would be lost; write to another file";
        return Err(Failure::input(format!("{}: {line}", output.display())));
    }
    let found = validate(&loaded.show);
    let written = written(format, &mut loaded);
    let mut fine = true;
    for issue in loaded.issues.iter().chain(&fitted).chain(&found).chain(&written.issues) {
        fine &= !issue.is_error();
        let level = if issue.is_error() { "error" } else { "warning" };
        say::note(&format!("{level}: {} [{}]", issue.message, issue.code));
    }
    if !written.bytes.is_empty() {
        show_file::write(output, written.bytes)?;
    }
    Ok(fine)
}

/// Reads the input show. With `--onto`, reads the show that the option names, and puts the colours of the input onto that
/// show.
fn loaded(arguments: &ConvertArguments) -> Result<Loaded, Failure> {
    let input = &arguments.input;
    let Some(onto) = &arguments.onto else { return show_file::load(input) };
    let mut loaded = show_file::load(onto)?;
    let bytes = show_file::bytes(input)?;
    let issues = put_onto(&mut loaded.show, &bytes)
        .map_err(|error| Failure::input(format!("{}: {error}", input.display())))?;
    loaded.issues.extend(issues);
    Ok(loaded)
}

/// Writes a show in a format. If the format needs a plan and the show's file brought none, plans the show first.
fn written(format: &Format, loaded: &mut Loaded) -> Written {
    if !format.needs_plan || loaded.plan.is_some() {
        return format.write(&loaded.show, loaded.plan.as_ref());
    }
    let show = &mut loaded.show;
    let dark = LayerPictures::default().attach(show, |_, asset| asset.content.clone());
    let (plan, _) = show_plan::plan(show, &Vec::new());
    let mut written = format.write(show, Some(&plan));
    written.issues.splice(0..0, dark);
    written
}

/// Whether two paths lead to the same existing file.
fn is_same_file(input: &Path, output: &Path) -> bool {
    let (input, output) = (input.canonicalize(), output.canonicalize());
    matches!((input, output), (Ok(input), Ok(output)) if input == output)
}

/// Fits the show to the number of robots in `--robots`. Returns warnings about what changed.
fn fitted(show: &mut Show, arguments: &ConvertArguments) -> Result<Issues, Failure> {
    let Some(robots) = arguments.robots else { return Ok(Issues::new()) };
    let notes = fit_show(show, robots as usize).map_err(|error| {
        Failure::problem(format!("{}: {error} [{}]", arguments.input.display(), error.code))
    })?;
    Ok(notes.into_iter().map(|note| Issue::warning(note.code, note.message)).collect())
}
