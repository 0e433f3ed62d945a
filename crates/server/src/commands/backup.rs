//! `backup` and `restore`: the data folder in one file, and back.

use super::count;
use crate::backup;
use crate::cli::{BackupArguments, RestoreArguments};
use crate::data_folder::DataFolder;
use crate::failure::{Failure, Outcome};
use crate::say;

pub fn save(arguments: &BackupArguments) -> Outcome {
    let BackupArguments { file, data, replace } = arguments;
    if file.exists() && !replace {
        let line = format!("{} is there already: name another file, or say --replace", file.display());
        return Err(Failure::problem(line));
    }
    let data = data.clone().unwrap_or_else(DataFolder::usual);
    let saved = backup::save(&data, file)?;
    for path in &saved.left_out {
        say::note(&format!("left out: {}, which is no regular file or has an unusual name", path.display()));
    }
    say::line(&format!(
        "Saved {} of {} in {}",
        amount(saved.files, saved.bytes),
        data.display(),
        file.display()
    ));
    Ok(true)
}

pub fn restore(arguments: &RestoreArguments) -> Outcome {
    let RestoreArguments { file, data, replace } = arguments;
    let data = data.clone().unwrap_or_else(DataFolder::usual);
    let restored = backup::restore(file, &data, *replace)?;
    say::line(&format!("Restored {} to {}", amount(restored.files, restored.bytes), data.display()));
    if let Some(before) = restored.before {
        say::line(&format!("What was there before is in {}", before.display()));
    }
    Ok(true)
}

fn amount(files: usize, bytes: u64) -> String {
    format!("{} ({:.1} MB)", count(files, "file"), bytes as f64 / 1e6)
}
