//! `convert`: between show formats, by the files' endings.

use std::path::Path;

use lightbots_show::{Format, losses, read, validate, write};

use crate::cli::ConvertArguments;
use crate::failure::{Failure, Outcome};
use crate::{say, show_file};

pub fn run(arguments: &ConvertArguments) -> Outcome {
    let (input, output) = (&arguments.input, &arguments.output);
    let format = format_of(output)?;
    let bytes = show_file::bytes(input)?;
    let ending = input.extension().and_then(|ending| ending.to_str());
    let loaded =
        read(&bytes, ending).map_err(|error| Failure::input(format!("{}: {error}", input.display())))?;
    let mut fine = true;
    for issue in loaded.issues.iter().chain(&validate(&loaded.show)).chain(&losses(&loaded.show, format)) {
        fine &= !issue.is_error();
        let level = if issue.is_error() { "error" } else { "warning" };
        say::note(&format!("{level}: {} [{}]", issue.message, issue.code));
    }
    std::fs::write(output, write(&loaded.show, format))
        .map_err(|error| Failure::input(format!("{}: cannot be written: {error}", output.display())))?;
    Ok(fine)
}

/// The format a file's ending stands for.
fn format_of(path: &Path) -> Result<Format, Failure> {
    let name = path.file_name().map(|name| name.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    if name.ends_with(".lightbots.json") || name.ends_with(".lightbots") {
        Ok(Format::LightBots)
    } else if name.ends_with(".json") {
        Ok(Format::Original)
    } else {
        let line = "its ending names no show format: .lightbots.json is ours, any other .json the original's";
        Err(Failure::input(format!("{}: {line}", path.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_name_formats() {
        assert_eq!(format_of(Path::new("a/b.lightbots.json")), Ok(Format::LightBots));
        assert_eq!(format_of(Path::new("3210.JSON")), Ok(Format::Original));
        assert!(format_of(Path::new("show.txt")).is_err());
        assert!(format_of(Path::new("json")).is_err());
    }
}
