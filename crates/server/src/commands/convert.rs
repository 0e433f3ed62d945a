//! `convert`: a show in another format.

use std::path::Path;

use lightbots_exchange::{Format, for_file, formats_in_words};
use lightbots_make::fit_show;
use lightbots_show::{Issue, Issues, Show, validate};

use crate::cli::ConvertArguments;
use crate::failure::{Failure, Outcome};
use crate::{say, show_file};

pub fn run(arguments: &ConvertArguments) -> Outcome {
    let (input, output) = (&arguments.input, &arguments.output);
    let format = format_of(output)?;
    let mut loaded = show_file::load(input)?;
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
    std::fs::write(output, written.bytes)
        .map_err(|error| Failure::input(format!("{}: cannot be written: {error}", output.display())))?;
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

/// The format that the ending of a file's name stands for.
fn format_of(path: &Path) -> Result<&'static Format, Failure> {
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    for_file(&name).ok_or_else(|| {
        let line = format!("no format has this ending; write a {}", formats_in_words());
        Failure::input(format!("{}: {line}", path.display()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_without_an_ending_of_a_format_is_refused_and_the_formats_in_words_are_named() {
        assert!(format_of(Path::new("folder.json/show.lightbots.json")).is_ok());
        let failure = format_of(Path::new("folder.json/show.txt")).unwrap_err();
        assert!(format!("{failure:?}").contains(".lightbots.json"), "{failure:?}");
    }
}
