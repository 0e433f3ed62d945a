//! Reads and writes files of shows.

use std::path::Path;

use lightbots_exchange::{Format, Loaded, MAX_BYTES, for_file, formats_in_words, read};
use lightbots_lighting::validate;
use lightbots_show::{Identity, Issue, Issues, Show, Stage, with_floor};

use crate::cli::ShowArguments;
use crate::disk::read_bounded;
use crate::failure::Failure;
use crate::layer_pictures::LayerPictures;

/// The code of the issue that a show has a floor of its own, so that `--floor` is ignored.
pub const FLOOR_IGNORED: &str = "floor-ignored";

/// A show as commands use it: read, adapted to the command line, and validated.
#[derive(Clone, Debug)]
pub struct Opened {
    /// The show, with the identity that the command line states, if any. Its floor is that of the file, or else that of
    /// the command line, or else the default.
    pub show: Show,
    /// Why the file holds more than the show; `None`: the show holds everything.
    pub unread: Option<String>,
    /// Issues that were found when the show was read and validated.
    pub issues: Issues,
}

/// Reads the show of a file, with the identity that the command line states, if any. The floor of the command line is
/// used only if the file has none. The error is one line with the file's name.
pub fn open(path: &Path, arguments: &ShowArguments) -> Result<Opened, Failure> {
    let bytes = bytes(path)?;
    interpret(&bytes, path, arguments)
}

/// Reads what a file of any format holds. The error is one line with the file's name.
pub fn load(path: &Path) -> Result<Loaded, Failure> {
    let bytes = bytes(path)?;
    loaded(&bytes, path)
}

/// Reads a file of at most `MAX_BYTES`; a folder, a longer file or an unreadable file is an error.
pub fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |what: String| Failure::input(format!("{}: {what}", path.display()));
    let about = std::fs::metadata(path).map_err(|error| unreadable(format!("cannot be read: {error}")))?;
    if about.is_dir() {
        return Err(unreadable("this is a folder; name a show file in it".into()));
    }
    if about.len() > MAX_BYTES as u64 {
        let size = about.len() as f64 / 1e6;
        let limit = MAX_BYTES as f64 / 1e6;
        return Err(unreadable(format!(
            "the file has {size:.0} MB, a show at most {limit:.0} MB: is it a show?"
        )));
    }
    // A pipe has no length before it is read, so the limit is checked again while reading.
    read_bounded(path, MAX_BYTES as u64).map_err(|error| unreadable(format!("cannot be read: {error}")))
}

/// Returns the format that the ending of a file's name stands for. Error if no format has this ending.
pub fn format_of(path: &Path) -> Result<&'static Format, Failure> {
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    for_file(&name).ok_or_else(|| {
        let line = format!("no format has this ending; write a {}", formats_in_words());
        Failure::input(format!("{}: {line}", path.display()))
    })
}

/// Writes a file. The error is one line with the file's name.
pub fn write(path: &Path, bytes: Vec<u8>) -> Result<(), Failure> {
    std::fs::write(path, bytes).map_err(|error| Failure::unwritable(path, &error))
}

/// Reads the show in the bytes of the file at `path` as [`open`] does.
pub fn interpret(bytes: &[u8], path: &Path, arguments: &ShowArguments) -> Result<Opened, Failure> {
    Ok(prepare(loaded(bytes, path)?, arguments))
}

fn loaded(bytes: &[u8], path: &Path) -> Result<Loaded, Failure> {
    let name = path.file_name().and_then(|name| name.to_str());
    read(bytes, name).map_err(|error| Failure::input(format!("{}: {error}", path.display())))
}

fn prepare(loaded: Loaded, arguments: &ShowArguments) -> Opened {
    let Loaded { mut show, has_stage, unread, mut issues, .. } = loaded;
    if let Some((width_m, depth_m)) = arguments.floor {
        if has_stage {
            issues.extend(floor_ignored(&show.stage, (width_m, depth_m)));
        } else {
            show = with_floor(show, width_m, depth_m);
        }
    }
    if let Some(identity) = arguments.identity {
        let identity = Identity::from(identity);
        show.identity = identity;
        for frame in &mut show.frames {
            frame.identity = None;
        }
    }
    issues.extend(validate(&show));
    issues.extend(LayerPictures::default().attach(&mut show, |_, asset| asset.content.clone()));
    Opened { show, unread, issues }
}

/// Returns a warning if `--floor` differs from the show's own floor, which is kept.
fn floor_ignored(stage: &Stage, (width_m, depth_m): (f64, f64)) -> Option<Issue> {
    let same = (stage.width_m, stage.depth_m) == (width_m, depth_m);
    let message = format!(
        "the show carries its own floor, {} x {} m, so that --floor {width_m}x{depth_m} is not used; change the floor in \
         the show",
        stage.width_m, stage.depth_m
    );
    (!same).then(|| Issue::warning(FLOOR_IGNORED, message))
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
