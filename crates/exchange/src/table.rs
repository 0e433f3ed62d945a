//! The table of formats, and functions that find a row.

use crate::format::Format;
use crate::part::Part;
use crate::{archive, csv, fseq, lightbots, original, skyc, vviz};

/// Every format. The last format in the list whose `sniff` accepts the bytes of a file reads the file. A format with a
/// looser check therefore stands before a format with a stricter check.
pub static FORMATS: [&Format; 7] = [&LIGHTBOTS, &ARCHIVE, &ORIGINAL, &SKYC, &CSV, &VVIZ, &FSEQ];

/// Our own format. It keeps every part of a show except the files that belong to the show.
pub static LIGHTBOTS: Format = Format {
    name: "lightbots",
    program: "LightBots",
    endings: &[".lightbots.json", ".lightbots"],
    media_type: "application/json",
    carries: &Part::DOCUMENT,
    holds_music: false,
    needs_plan: false,
    sniff: lightbots::sniff,
    read: lightbots::read,
    encode: lightbots::encode,
};

/// Our own format with the files that belong to the show.
pub static ARCHIVE: Format = Format {
    name: "archive",
    program: "LightBots, with its files",
    endings: &[".lightbots.zip"],
    media_type: "application/zip",
    carries: &Part::SHOW,
    holds_music: true,
    needs_plan: false,
    sniff: archive::sniff,
    read: archive::read,
    encode: archive::encode,
};

/// The format of the original system, which is for thirty robots on a floor of 3 m by 3 m.
pub static ORIGINAL: Format = Format {
    name: "original",
    program: "the original LightBots",
    endings: &[".json"],
    media_type: "application/json",
    carries: &[],
    holds_music: false,
    needs_plan: false,
    sniff: original::sniff,
    read: original::read,
    encode: original::encode,
};

/// Compiled shows of Skybrush: timed paths and light programs.
pub static SKYC: Format = Format {
    name: "skyc",
    program: "Skybrush",
    endings: &[".skyc"],
    media_type: "application/skybrush-compiled",
    carries: &Part::TIMED_WITH_NAMES,
    holds_music: true,
    needs_plan: true,
    sniff: skyc::sniff,
    read: skyc::read,
    encode: skyc::encode,
};

/// Tables of Skybrush, one for each robot: places and colours at moments.
pub static CSV: Format = Format {
    name: "csv",
    program: "Skybrush, as tables",
    endings: &[".csv.zip"],
    media_type: "application/zip",
    carries: &Part::TABLES,
    holds_music: false,
    needs_plan: true,
    sniff: csv::sniff,
    read: csv::read,
    encode: csv::encode,
};

/// Verge Aero's format for visualisation.
pub static VVIZ: Format = Format {
    name: "vviz",
    program: "Finale 3D and other VVIZ programs",
    endings: &[".vviz"],
    media_type: "application/json",
    carries: &Part::TIMED,
    holds_music: false,
    needs_plan: true,
    sniff: vviz::sniff,
    read: vviz::read,
    encode: vviz::encode,
};

/// Sequences of xLights and the Falcon Player: colours of lights over time, without places.
pub static FSEQ: Format = Format {
    name: "fseq",
    program: "xLights and the Falcon Player",
    endings: &[".fseq"],
    media_type: "application/x-fseq",
    carries: &[Part::Music],
    holds_music: false,
    needs_plan: true,
    sniff: fseq::sniff,
    read: fseq::read,
    encode: fseq::encode,
};

/// The format of a file's bytes: the last one in [`FORMATS`] whose `sniff` accepts them. `None` if none does.
pub fn sniff(bytes: &[u8]) -> Option<&'static Format> {
    FORMATS.into_iter().rev().find(|format| (format.sniff)(bytes))
}

/// The format with this name.
pub fn named(name: &str) -> Option<&'static Format> {
    FORMATS.into_iter().find(|format| format.name == name)
}

/// The format that a file's name stands for: that with the longest ending that fits, in upper or lower case. `None` if
/// no ending fits.
pub fn for_file(file: &str) -> Option<&'static Format> {
    ending_of(file).map(|(format, _)| format)
}

/// A file's name without the ending of its format. The whole name if it has no ending of a known format.
pub fn stem(file: &str) -> &str {
    let ending = ending_of(file).map_or(0, |(_, ending)| ending.len());
    &file[..file.len() - ending]
}

/// A list of all formats, each with its first ending, for messages: "show of LightBots (.lightbots.json) or of …".
pub fn formats_in_words() -> String {
    let formats = FORMATS.map(|format| format!("of {} ({})", format.program, format.ending()));
    format!("show {}", formats.join(" or "))
}

fn ending_of(file: &str) -> Option<(&'static Format, &'static str)> {
    let endings =
        FORMATS.into_iter().flat_map(|format| format.endings.iter().map(move |ending| (format, *ending)));
    endings.filter(|(_, ending)| ends_with(file, ending)).max_by_key(|(_, ending)| ending.len())
}

/// Whether a file's name ends with `ending`, in upper or lower case. Compares bytes: `ending` is ASCII, so none of its
/// bytes matches a part of a longer UTF-8 character.
fn ends_with(file: &str, ending: &str) -> bool {
    let start = file.len().checked_sub(ending.len());
    start.is_some_and(|start| file.as_bytes()[start..].eq_ignore_ascii_case(ending.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_endings_are_unique_lower_case_and_ascii() {
        let mut words: Vec<&str> =
            FORMATS.iter().flat_map(|format| format.endings.iter().chain([&format.name])).copied().collect();
        assert!(words.iter().all(|word| word.is_ascii() && *word == word.to_ascii_lowercase()));
        assert!(FORMATS.iter().all(|format| format.endings.iter().all(|ending| ending.starts_with('.'))));
        let count = words.len();
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), count);
    }

    #[test]
    fn files_are_told_apart_by_their_longest_ending() {
        assert_eq!(for_file("a/b.lightbots.json"), Some(&LIGHTBOTS));
        assert_eq!(for_file("3210.JSON"), Some(&ORIGINAL));
        assert_eq!(for_file("show.txt"), None);
        assert_eq!(for_file("json"), None);
        assert_eq!(for_file("é"), None);
        assert_eq!(stem("Heart beat.Lightbots.json"), "Heart beat");
        assert_eq!(stem("3210.json"), "3210");
        assert_eq!(stem("notes.txt"), "notes.txt");
    }
}
