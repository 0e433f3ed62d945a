//! File formats, and the results of reading and writing a file.

use std::fmt;

use lightbots_plan::ShowPlan;
use lightbots_show::{Asset, Issue, Issues, Show};

use crate::error::ReadError;
use crate::part::{Part, uses};

/// A file format: its names, its contents, and functions that read and write it.
pub struct Format {
    /// The word that programs use, such as `?to=original`. Lower case, unique.
    pub name: &'static str,
    /// The program that the format is for, in messages and menus: "a show of …", "Export for …".
    pub program: &'static str,
    /// Endings of file names: lower case, with the dot, unique. A written file gets the first. Never empty.
    pub endings: &'static [&'static str],
    /// Media type of the bytes, for HTTP.
    pub media_type: &'static str,
    /// Parts of a show that a file keeps. Besides these, every format keeps frames with their names, air times and
    /// pixels.
    pub carries: &'static [Part],
    /// Whether a file holds the music itself, if the show does.
    pub holds_music: bool,
    /// Whether a file holds timed paths or lights, so that it cannot be written without the plan of the show.
    pub needs_plan: bool,
    /// Whether bytes look like this format. Does not parse them, and never fails.
    pub sniff: fn(&[u8]) -> bool,
    /// Reads the bytes of a file.
    pub(crate) read: fn(&[u8]) -> Result<Loaded, ReadError>,
    /// Writes the parts that the format carries. Other parts are left out without an issue.
    pub(crate) encode: fn(&Show, Option<&ShowPlan>) -> Written,
}

/// The result of reading a file.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The show.
    pub show: Show,
    /// The plan, if the file has one. It is not proven: a file may hold any plan.
    pub plan: Option<ShowPlan>,
    /// Whether the file has a stage. If not, the floor is 3 m by 3 m and may be replaced.
    pub has_stage: bool,
    /// Why the file holds more than was read, such as fields of a newer version, in words after "because". What was
    /// read must then not replace the file. `None`: everything was read.
    pub unread: Option<String>,
    /// Issues found while reading, such as unknown fields. Issues of [`validate`](lightbots_show::validate) are not
    /// among them.
    pub issues: Issues,
}

/// The result of writing a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The bytes of the file. Empty if an error among the issues says why there is no file.
    pub bytes: Vec<u8>,
    /// A warning for each part that the show uses and the format does not keep, then issues of the format itself.
    pub issues: Issues,
}

impl Format {
    /// Writes a file with the show and, if the format keeps it, the plan. The same show gives the same bytes. A format
    /// that [needs](Self::needs_plan) a plan gives an error without one, and for a plan that is not sound.
    pub fn write(&self, show: &Show, plan: Option<&ShowPlan>) -> Written {
        let mut issues = self.losses(show, plan);
        let written = (self.encode)(show, plan);
        issues.extend(written.issues);
        Written { bytes: written.bytes, issues }
    }

    /// A warning for each part that the show uses and the format does not keep, in the order of [`Part::all`].
    fn losses(&self, show: &Show, plan: Option<&ShowPlan>) -> Issues {
        // Music that the format holds is not lost with the list of files.
        let is_music = |asset: &Asset| self.holds_music && show.music.as_ref() == Some(&asset.name);
        let others = show.assets.values().any(|asset| !is_music(asset));
        let counts = |part: Part| others || !matches!(part, Part::Assets | Part::AssetFiles);
        let lost = Part::all().filter(|part| !self.keeps(*part) && counts(*part) && uses(*part, show, plan));
        let warning = |part: Part| {
            let message = format!("a file for {} does not keep {}", self.program, part.words());
            Issue::warning("lost-in-format", message)
        };
        lost.map(warning).collect()
    }

    /// The ending that a written file gets.
    pub fn ending(&self) -> &'static str {
        self.endings[0]
    }

    /// Whether a file keeps a part.
    pub fn keeps(&self, part: Part) -> bool {
        self.carries.contains(&part)
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Format {}

impl fmt::Debug for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}
