//! File formats, and the results of reading and writing a file.

use std::fmt;

use lightbots_plan::ShowPlan;
use lightbots_show::{Asset, Issue, Issues, Show};

use crate::error::ReadError;
use crate::part::{Part, uses};

/// A file format: its names, its contents, and functions that read and write it.
pub struct Format {
    /// The format's name for programs, such as `original` in `/api/convert?to=original`. Lower case, unique.
    pub name: &'static str,
    /// The program that the format is for, in messages and menus: "a show of …", "Export for …".
    pub program: &'static str,
    /// Endings of the format's file names: lower case, with the dot. No other format has them. A written file gets the
    /// first. The list is never empty.
    pub endings: &'static [&'static str],
    /// Media type of the bytes, for HTTP.
    pub media_type: &'static str,
    /// Parts of a show that files of the format keep. Besides these parts, a format that needs no plan keeps frames
    /// with their names, air times and pixels. Formats that need a plan keep paths or colours of robots over time.
    pub carries: &'static [Part],
    /// Whether a written file contains the bytes of the music, provided that the show has them.
    pub holds_music: bool,
    /// Whether a file holds timed paths or lights, so that it cannot be written without the plan of the show.
    pub needs_plan: bool,
    /// Whether bytes look like a file of this format. Looks for a few marks, does not parse the bytes, and never fails.
    pub sniff: fn(&[u8]) -> bool,
    /// Reads the bytes of a file.
    pub(crate) read: fn(&[u8]) -> Result<Loaded, ReadError>,
    /// Writes the parts that the format carries. Leaves other parts out silently: [`Format::write`] adds the warnings.
    pub(crate) encode: fn(&Show, Option<&ShowPlan>) -> Written,
}

/// The result of reading a file.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The show.
    pub show: Show,
    /// The plan, if the file has one. It has not been proven free of contact, because a file may hold any plan.
    pub plan: Option<ShowPlan>,
    /// Whether the file has a stage, or the reader made one around the paths in the file. If not, the floor is 3 m by 3
    /// m and may be replaced.
    pub has_stage: bool,
    /// Why the file holds more than the show does, such as fields of a newer version: words that follow "because". If
    /// the show replaces the file, these contents are lost. `None`: no such contents were noticed.
    pub unread: Option<String>,
    /// Issues found while reading, such as unknown fields. Issues of [`validate`](lightbots_show::validate) are not
    /// among them.
    pub issues: Issues,
}

/// The result of writing a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The bytes of the file. Empty if no file could be made; an error among `issues` then says why.
    pub bytes: Vec<u8>,
    /// A warning for each part that the show uses and the format does not keep, then issues of writing the file.
    pub issues: Issues,
}

impl Format {
    /// Writes a file with the show and, if the format keeps it, the plan. Equal shows and plans give equal bytes. If
    /// the format [needs](Self::needs_plan) a plan and `plan` is `None` or has errors, there are no bytes, and an error
    /// says why.
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

    /// Whether a file of the format keeps a part.
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
