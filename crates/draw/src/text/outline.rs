//! Outlines of the letters of TTF and OTF fonts.

use lightbots_base::Vec2;
use skrifa::font::Source;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{Font as FontFile, FontRef, GlyphId, MetadataProvider};

use super::curve::Curve;

/// Largest number of points of one letter; a letter with more is left out. Ornate letters have about a thousand points,
/// a malicious font could have millions.
const POINTS_MAX: usize = 20_000;

/// Height of capitals as a share of the em, for fonts that do not state this height: the mean of common sans-serif
/// fonts.
const CAP_SHARE: f64 = 0.7;

/// Largest absolute coordinate of a sound glyph, in cap heights. A glyph with larger coordinates is broken.
const EXTENT_MAX: f64 = 1_000.0;

/// Number of the font's first characters that are searched for an outline when the font is read.
const TRIED: usize = 300;

/// A font with outlines.
#[derive(Clone)]
pub(super) struct Outlines {
    file: FontFile,
    /// Font units in one cap height.
    pub(super) unit: f64,
    /// Distance by which all glyphs are moved up, in cap heights. It is 0 except for emoji fonts, whose signs hang
    /// below the baseline.
    pub(super) lift: f64,
}

impl Outlines {
    /// Reads the first font of a file; `None` if the file has no font.
    pub(super) fn read(bytes: impl Into<Source>) -> Option<Self> {
        let file = FontFile::new(bytes, 0)?;
        let mut outlines = Self { file, unit: 1.0, lift: 0.0 };
        let metrics = outlines.font()?.metrics(Size::unscaled(), LocationRef::default());
        let em = f64::from(metrics.units_per_em);
        let said = metrics.cap_height.map(f64::from).filter(|cap| *cap > em * 0.2 && *cap < em * 1.5);
        outlines.unit = said.unwrap_or(em * CAP_SHARE).max(1.0);
        if let Some(height) = outlines.height('H').filter(|height| *height > 0.2 && *height < 5.0) {
            outlines.unit *= height;
        } else if let Some((low, high)) = outlines.span('\u{1f600}').filter(|(low, high)| high > low) {
            outlines.unit *= (high - low) / EMOJI_HEIGHT;
            outlines.lift = EMOJI_FOOT - low * EMOJI_HEIGHT / (high - low);
        }
        Some(outlines)
    }

    /// The font file, for shaping.
    pub(super) fn file(&self) -> &FontFile {
        &self.file
    }

    fn font(&self) -> Option<FontRef<'_>> {
        match self.file.source() {
            Source::Blob(bytes) => FontRef::from_index(bytes, 0).ok(),
            Source::TableFunction(_) => None,
        }
    }

    /// Whether the font maps the character to a glyph.
    pub(super) fn has(&self, character: char) -> bool {
        self.glyph(character).is_some()
    }

    fn glyph(&self, character: char) -> Option<GlyphId> {
        self.font()?.charmap().map(character).filter(|glyph| *glyph != GlyphId::NOTDEF)
    }

    /// Whether any of the font's first [`TRIED`] characters has an outline.
    pub(super) fn has_letters(&self) -> bool {
        let Some(font) = self.font() else { return false };
        let mapped: Vec<GlyphId> = font.charmap().mappings().take(TRIED).map(|(_, glyph)| glyph).collect();
        mapped.into_iter().any(|glyph| !self.rings(glyph).is_empty())
    }

    /// Returns the rings of a character, in cap heights, with the start of the letter at x = 0. Empty if the font lacks
    /// the character.
    pub(super) fn rings_of(&self, character: char) -> Vec<Vec<Vec2>> {
        self.glyph(character).map_or_else(Vec::new, |glyph| self.rings(glyph))
    }

    /// Returns the rings of a glyph, in cap heights, with the start of the letter at x = 0. Empty for a broken glyph.
    pub(super) fn rings(&self, glyph: GlyphId) -> Vec<Vec<Vec2>> {
        let Some(outline) = self.font().and_then(|font| font.outline_glyphs().get(glyph)) else {
            return Vec::new();
        };
        let mut pen = Pen { curve: Curve::default(), scale: 1.0 / self.unit, lift: self.lift };
        let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
        if outline.draw(settings, &mut pen).is_err() || pen.curve.is_full() {
            return Vec::new();
        }
        let rings = pen.curve.into_rings();
        let sound =
            |point: &Vec2| point.is_finite() && point.x.abs() < EXTENT_MAX && point.y.abs() < EXTENT_MAX;
        if rings.iter().flatten().all(sound) { rings } else { Vec::new() }
    }

    fn height(&self, character: char) -> Option<f64> {
        self.span(character).map(|(_, high)| high)
    }

    /// Lowest and highest y of a character, in cap heights. `None` if the font does not have the character.
    fn span(&self, character: char) -> Option<(f64, f64)> {
        let rings = self.rings_of(character);
        let heights = rings.iter().flatten().map(|point| (point.y, point.y));
        heights.reduce(|(low, high), (y, _)| (low.min(y), high.max(y)))
    }
}

/// Height of an emoji, in cap heights. It is a little above 1 because an emoji has more detail than a capital letter.
const EMOJI_HEIGHT: f64 = 1.1;

/// y of an emoji's lowest point, in cap heights. At this value an emoji is centred on the height of capitals.
const EMOJI_FOOT: f64 = -0.05;

/// Receives an outline in font units and converts it to cap heights.
struct Pen {
    curve: Curve,
    scale: f64,
    lift: f64,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> Vec2 {
        Vec2::new(f64::from(x) * self.scale, f64::from(y) * self.scale + self.lift)
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.curve.move_to(self.at(x, y), POINTS_MAX);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.curve.line_to(self.at(x, y), POINTS_MAX);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.curve.quad_to(self.at(cx, cy), self.at(x, y), POINTS_MAX);
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        self.curve.cubic_to(self.at(ax, ay), self.at(bx, by), self.at(x, y), POINTS_MAX);
    }

    fn close(&mut self) {}
}
