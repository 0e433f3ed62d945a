//! Built-in fonts, and fonts from files.

use std::sync::OnceLock;

use super::outline::Outlines;
use super::strokes::StrokeFace;
use crate::error::DrawError;

/// Largest font file that is read, bytes. The largest common fonts, with all Chinese, Japanese and Korean signs, have
/// about 20 MB.
const FILE_MAX: usize = 32 << 20;

/// A font with either the outlines or the middle lines (strokes) of its letters.
#[derive(Clone)]
pub struct Font {
    face: Face,
}

/// How the letters of a font are drawn.
#[derive(Clone)]
pub(super) enum Face {
    /// As areas.
    Outlines(Outlines),
    /// As lines.
    Strokes(StrokeFace),
}

/// A built-in font.
#[derive(Clone, Copy, Debug)]
pub struct FontInfo {
    /// Name for programs and documents.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// Licence of the font, as an SPDX expression or in words. The full text is in a file beside the font file.
    pub licence: &'static str,
    /// Whether people can choose the font. Fonts that cannot be chosen only supply signs that the chosen font lacks.
    pub offered: bool,
    file: File,
}

#[derive(Clone, Copy, Debug)]
enum File {
    Outlines(&'static [u8]),
    Strokes(&'static str),
}

/// All built-in fonts, in the order in which they are offered.
pub static FONTS: [FontInfo; 8] = [
    outlines("lato", "Lato Bold", true, include_bytes!("../../fonts/Lato-Bold.ttf")),
    outlines(
        "league-spartan",
        "League Spartan Bold",
        true,
        include_bytes!("../../fonts/LeagueSpartan-Bold.otf"),
    ),
    outlines("quicksand", "Quicksand Bold", true, include_bytes!("../../fonts/Quicksand-Bold.ttf")),
    FontInfo {
        name: "hershey-sans",
        title: "Hershey Sans, single line",
        licence: "Hershey fonts: any use, acknowledgements kept",
        offered: true,
        file: File::Strokes(include_str!("../../fonts/HersheySans1.svg")),
    },
    FontInfo {
        name: "ems-readability",
        title: "EMS Readability, single line",
        licence: "OFL-1.1",
        offered: true,
        file: File::Strokes(include_str!("../../fonts/EMSReadability.svg")),
    },
    outlines(
        "hebrew",
        "Noto Sans Hebrew Bold, part",
        false,
        include_bytes!("../../fonts/NotoSansHebrew-Bold-part.ttf"),
    ),
    outlines(
        "arabic",
        "Noto Sans Arabic Bold, part",
        false,
        include_bytes!("../../fonts/NotoSansArabic-Bold-part.ttf"),
    ),
    outlines("emoji", "Noto Emoji Bold, part", false, include_bytes!("../../fonts/NotoEmoji-Bold-part.ttf")),
];

/// Names of fonts that supply signs which the chosen font lacks, in the order in which they are tried.
const STAND_INS: [&str; 4] = ["lato", "hebrew", "arabic", "emoji"];

const fn outlines(name: &'static str, title: &'static str, offered: bool, bytes: &'static [u8]) -> FontInfo {
    FontInfo { name, title, licence: "OFL-1.1", offered, file: File::Outlines(bytes) }
}

impl FontInfo {
    /// The bytes of the font's file, if the font has outlines; `None` for a font of strokes.
    pub fn outline_file(&self) -> Option<&'static [u8]> {
        match self.file {
            File::Outlines(bytes) => Some(bytes),
            File::Strokes(_) => None,
        }
    }
}

/// The bytes of all built-in fonts with outlines, in the order of [`FONTS`].
pub(crate) fn outline_files() -> impl Iterator<Item = &'static [u8]> {
    FONTS.iter().filter_map(FontInfo::outline_file)
}

impl Font {
    /// Returns the built-in font with this name; `None` if [`FONTS`] has no such name.
    pub fn built_in(name: &str) -> Option<Self> {
        let info = FONTS.iter().find(|info| info.name == name)?;
        let face = match info.file {
            File::Outlines(bytes) => Face::Outlines(Outlines::read(bytes)?),
            File::Strokes(svg) => Face::Strokes(StrokeFace::read(svg)?),
        };
        Some(Self { face })
    }

    /// Reads a font from the bytes of a TTF, OTF or TTC file. If the file has several fonts, the first is read.
    ///
    /// # Errors
    /// Codes: `font-too-large`, `font-web` for WOFF files, `font-cut-off`, `font-unreadable`, and `font-empty` for a
    /// font whose first letters have no outlines.
    pub fn read(bytes: &[u8]) -> Result<Self, DrawError> {
        if bytes.len() > FILE_MAX {
            let mb = bytes.len() >> 20;
            let message = format!(
                "The font file has {mb} MB; at most {} MB are read. Use a smaller font.",
                FILE_MAX >> 20
            );
            return Err(DrawError::new("font-too-large", message));
        }
        if bytes.starts_with(b"wOF") {
            let message =
                "The file is a web font (WOFF). Convert it to TTF or OTF, or download that form of it.";
            return Err(DrawError::new("font-web", message));
        }
        let unreadable = || {
            let message =
                "The file is no font that can be read, or it is cut off. Use a whole TTF, OTF or TTC file.";
            DrawError::new("font-unreadable", message)
        };
        if is_cut_off(bytes) {
            let message =
                "The font file is cut off: its own list names parts beyond its end. Use a whole file.";
            return Err(DrawError::new("font-cut-off", message));
        }
        let outlines = Outlines::read(bytes.to_vec()).ok_or_else(unreadable)?;
        if !outlines.has_letters() {
            let message =
                "The font has no letters with outlines, only pictures or empty ones. Use another font.";
            return Err(DrawError::new("font-empty", message));
        }
        Ok(Self { face: Face::Outlines(outlines) })
    }

    /// How the font's letters are drawn.
    pub(super) fn face(&self) -> &Face {
        &self.face
    }

    /// Whether the font has the character. Other fonts that supply missing signs do not count.
    pub fn has(&self, character: char) -> bool {
        self.face.has(character)
    }

    /// Whether the font's letters are lines instead of areas.
    pub fn is_single_line(&self) -> bool {
        matches!(self.face, Face::Strokes(_))
    }
}

impl Face {
    /// Whether the font has the character.
    pub(super) fn has(&self, character: char) -> bool {
        match self {
            Self::Outlines(outlines) => outlines.has(character),
            Self::Strokes(strokes) => strokes.has(character),
        }
    }
}

/// Whether the table list at the start of a font file names bytes beyond the end of the file. Collections (TTC) have no
/// such list there, and give false.
fn is_cut_off(bytes: &[u8]) -> bool {
    let collection = bytes.starts_with(b"ttcf");
    let number = |at: usize| bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes);
    let tables = number(2).map_or(0, |number| number & 0xffff) as usize;
    let kinds: [&[u8]; 3] = [b"\0\x01\0\0", b"OTTO", b"true"];
    if collection || !kinds.iter().any(|kind| bytes.starts_with(kind)) {
        return false;
    }
    let ends = (0..tables).map(|table| {
        let record = 12 + 16 * table;
        Some(u64::from(number(record + 8)?) + u64::from(number(record + 12)?))
    });
    ends.into_iter().any(|end| end.is_none_or(|end| end > bytes.len() as u64))
}

/// Returns the fonts that supply signs which the chosen font lacks. They are read at the first call only.
pub(super) fn stand_ins() -> &'static [Font] {
    static READ: OnceLock<Vec<Font>> = OnceLock::new();
    READ.get_or_init(|| STAND_INS.iter().filter_map(|name| Font::built_in(name)).collect())
}

/// Returns the single-line fonts whose strokes are fitted to letters of other fonts, in the order of [`FONTS`]. They
/// are read at the first call only.
pub(super) fn spines() -> &'static [StrokeFace] {
    static READ: OnceLock<Vec<StrokeFace>> = OnceLock::new();
    READ.get_or_init(|| {
        let svgs = FONTS.iter().filter_map(|info| match info.file {
            File::Strokes(svg) => StrokeFace::read(svg),
            File::Outlines(_) => None,
        });
        svgs.collect()
    })
}
