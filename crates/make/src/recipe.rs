//! The sources of a show with typed settings, read from and written to the show's named settings.

use lightbots_base::{Rgb, Vec2};
use lightbots_draw::picture::{PictureSettings, PictureWay};
use lightbots_draw::text::Align;
use lightbots_draw::{DrawError, PlaceSettings, SHAPES, ShapeSettings, Style, shape_named};
use lightbots_show::{FrameSource, SourceKind};

use crate::floor::middle_and_side;
use crate::settings::{Reader, Writer};

/// The font of words if none is chosen.
const USUAL_FONT: &str = "lato";

/// Words for styles in settings. The first is used if the setting is missing.
const STYLES: [(&str, Style); 5] = [
    ("auto", Style::Auto),
    ("filled", Style::Filled),
    ("outline", Style::Outline),
    ("both", Style::Both),
    ("lines", Style::Lines),
];

/// Words for ways to draw a picture. The first is used if the setting is missing.
const WAYS: [(&str, PictureWay); 4] = [
    ("auto", PictureWay::Auto),
    ("silhouette", PictureWay::Silhouette),
    ("outline", PictureWay::Outline),
    ("tones", PictureWay::Tones),
];

/// Words for alignments of lines. The first is used if the setting is missing.
const ALIGNS: [(&str, Align); 3] =
    [("center", Align::Centre), ("left", Align::Left), ("right", Align::Right)];

/// The source of a frame with typed settings. In a show, settings are named values of any type.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// The kind of source and the settings of that kind.
    pub content: Content,
    /// How and where the lights of the source are placed.
    pub placing: Placing,
    /// Seed of all random choices in placing the lights.
    pub seed: u32,
}

/// The kind of a source and the settings of that kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Words.
    Text(TextRecipe),
    /// A shape.
    Shape(ShapeSettings),
    /// The SVG file that is the source's asset.
    Svg,
    /// The picture that is the source's asset.
    Picture(PictureSettings),
    /// The list of lights that is the source's asset.
    List,
    /// A moment of the animation that is the source's asset.
    Animation {
        /// How the pictures of the animation are drawn.
        picture: PictureSettings,
        /// The moment, seconds from the start of the animation.
        moment_s: f64,
    },
}

/// Words and how they are laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct TextRecipe {
    /// The words; lines are separated by `\n`.
    pub text: String,
    /// Name of a built-in font. If the source has an asset, the asset is the font, and this name is ignored.
    pub font: String,
    /// Where lines that are shorter than the longest line stand.
    pub align: Align,
    /// Ratio of width to height that the whole text should have. The text is broken into lines between words to come near
    /// it. `None`: only the line breaks in `text` count.
    pub wrap: Option<f64>,
    /// Additional gap between letters, in heights of a capital letter.
    pub letter_gap: f64,
    /// Colours of the letters, used in turn. Empty: all letters have the usual colour.
    pub colors: Vec<Rgb>,
    /// The step of the scrolling that the frame shows; `None`: the text does not scroll.
    pub scroll: Option<Scroll>,
}

/// A step of a text that scrolls past behind a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scroll {
    /// Width of the window, in heights of a capital letter.
    pub window: f64,
    /// Number of steps in which the text scrolls past, including steps with an empty window.
    pub steps: usize,
    /// Index of this step, counted from 0, among the steps in which the window is not empty.
    pub step: usize,
}

/// How and where lights are placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placing {
    /// Whether lights fill areas, or stand along edges or spines.
    pub style: Style,
    /// Wanted longer side of the picture, metres; `None`: it depends on the floor and the number of robots.
    pub size_m: Option<f64>,
    /// Centre of the picture, stage metres.
    pub center: Vec2,
    /// Angle by which the picture is turned, radians counter-clockwise.
    pub turn: f64,
    /// Smallest distance between two lights, metres; `None`: a distance with which drives are easy, or a smaller one if
    /// there is not enough room.
    pub spacing_m: Option<f64>,
}

impl Default for Placing {
    fn default() -> Self {
        Self { style: Style::Auto, size_m: None, center: Vec2::ZERO, turn: 0.0, spacing_m: None }
    }
}

impl Placing {
    /// Wanted and smallest allowed distance between two lights, metres. Both are `spacing_m` if it is set.
    pub(crate) fn spacing(&self) -> (f64, f64) {
        let usual = PlaceSettings::default();
        self.spacing_m.map_or((usual.spacing_m, usual.least_m), |wanted| (wanted, wanted))
    }
}

impl TextRecipe {
    /// Returns a recipe for the words `text` with default settings.
    pub fn new(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            font: USUAL_FONT.into(),
            align: Align::Centre,
            wrap: None,
            letter_gap: 0.0,
            colors: Vec::new(),
            scroll: None,
        }
    }
}

impl Recipe {
    /// Returns the settings for placing `robots` lights in full quality. None of the lights is kept from an earlier picture.
    pub fn place_settings(&self, robots: usize) -> PlaceSettings {
        let (spacing_m, least_m) = self.placing.spacing();
        let Placing { style, size_m, center, turn, .. } = self.placing;
        let seed = u64::from(self.seed);
        PlaceSettings {
            robots,
            spacing_m,
            least_m,
            style,
            size_m,
            center,
            turn,
            seed,
            ..PlaceSettings::default()
        }
    }

    /// Returns a recipe with default placing and the seed 1.
    pub fn new(content: Content) -> Self {
        Self { content, placing: Placing::default(), seed: 1 }
    }

    /// Reads the recipe of a frame's source. If size or centre are not set, they come from the source's floor box.
    ///
    /// # Errors
    /// If a setting has a value of a wrong type or one that is not allowed, such as an unknown word.
    pub fn read(source: &FrameSource) -> Result<Self, DrawError> {
        let reader = Reader(&source.settings);
        let content = match source.kind {
            SourceKind::Text => Content::Text(TextRecipe {
                text: reader.text("text", "")?,
                font: reader.text("font", USUAL_FONT)?,
                align: reader.word("align", &ALIGNS)?,
                wrap: reader.number("wrap")?,
                letter_gap: reader.number("letter_gap")?.unwrap_or(0.0),
                colors: reader.colors("colors")?,
                scroll: scroll(&reader)?,
            }),
            SourceKind::Shape => Content::Shape(shape(&reader)?),
            SourceKind::Svg => Content::Svg,
            SourceKind::Picture => Content::Picture(picture_settings(&reader)?),
            SourceKind::List => Content::List,
            SourceKind::Animation => Content::Animation {
                picture: picture_settings(&reader)?,
                moment_s: source.moment_s.unwrap_or(0.0),
            },
        };
        let boxed = source.floor_box.map(|place| middle_and_side(place.min, place.max));
        let placing = Placing {
            style: style_of(reader.word("style", &STYLES)?, &content),
            size_m: reader.number("size_m")?.or(boxed.map(|(_, side)| side)),
            center: reader
                .points("center")?
                .first()
                .copied()
                .or(boxed.map(|(at, _)| at))
                .unwrap_or(Vec2::ZERO),
            turn: reader.number("turn")?.unwrap_or(0.0),
            spacing_m: reader.number("spacing_m")?,
        };
        Ok(Self { content, placing, seed: source.seed })
    }

    /// Writes the recipe as the source of a show. The source gets kind, settings, seed and moment, but neither file nor
    /// floor box.
    pub fn source(&self) -> FrameSource {
        let mut writer = Writer::default();
        let mut moment_s = None;
        let kind = match &self.content {
            Content::Text(words) => {
                words.write(&mut writer);
                SourceKind::Text
            }
            Content::Shape(shape) => {
                write_shape(shape, &mut writer);
                SourceKind::Shape
            }
            Content::Svg => SourceKind::Svg,
            Content::Picture(picture) => {
                write_picture(picture, &mut writer);
                SourceKind::Picture
            }
            Content::List => SourceKind::List,
            Content::Animation { picture, moment_s: at_s } => {
                write_picture(picture, &mut writer);
                moment_s = Some(*at_s);
                SourceKind::Animation
            }
        };
        let (placing, usual) = (&self.placing, Placing::default());
        writer.word("style", &placing.style, &STYLES);
        writer.number("size_m", placing.size_m.unwrap_or(0.0), 0.0);
        if placing.center != usual.center {
            writer.points("center", &[placing.center]);
        }
        writer.number("turn", placing.turn, usual.turn);
        writer.number("spacing_m", placing.spacing_m.unwrap_or(0.0), 0.0);
        FrameSource { seed: self.seed, moment_s, settings: writer.0, ..FrameSource::new(kind) }
    }
}

impl TextRecipe {
    fn write(&self, writer: &mut Writer) {
        writer.text("text", &self.text, "");
        writer.text("font", &self.font, USUAL_FONT);
        writer.word("align", &self.align, &ALIGNS);
        writer.number("wrap", self.wrap.unwrap_or(0.0), 0.0);
        writer.number("letter_gap", self.letter_gap, 0.0);
        writer.colors("colors", &self.colors);
        if let Some(scroll) = &self.scroll {
            writer.number("window", scroll.window, 0.0);
            writer.number("steps", scroll.steps as f64, -1.0);
            writer.number("step", scroll.step as f64, -1.0);
        }
    }
}

fn shape(reader: &Reader<'_>) -> Result<ShapeSettings, DrawError> {
    let name = reader.text("shape", "circle")?;
    let kind = shape_named(&name).ok_or_else(|| unknown_shape(&name))?;
    let usual = ShapeSettings::new(kind);
    Ok(ShapeSettings {
        kind,
        aspect: reader.number("aspect")?.unwrap_or(usual.aspect),
        count: reader.whole("count", usual.count)?,
        turns: reader.number("turns")?.unwrap_or(usual.turns),
        inner: reader.number("inner")?.unwrap_or(usual.inner),
        span: reader.number("span")?.unwrap_or(usual.span),
        points: reader.points("points")?,
        closed: reader.flag("closed", usual.closed)?,
        color: reader.colors("color")?.first().copied().unwrap_or(usual.color),
    })
}

/// Returns the style of a content: `chosen`, except that animations get `Filled` for `Auto`. The robots of an animation
/// keep their indices from picture to picture, which is not possible along edges whose length changes.
pub(crate) fn style_of(chosen: Style, content: &Content) -> Style {
    let is_animation = matches!(content, Content::Animation { .. });
    if is_animation && chosen == Style::Auto { Style::Filled } else { chosen }
}

/// Returns the error for a source with an unknown name of a shape.
pub fn unknown_shape(name: &str) -> DrawError {
    let known: Vec<&str> = SHAPES.iter().map(|(_, name)| *name).collect();
    let name: String = name.chars().take(40).collect();
    DrawError::new("unknown-shape", format!("there is no shape \"{name}\"; use {}", known.join(", ")))
}

fn write_shape(shape: &ShapeSettings, writer: &mut Writer) {
    let usual = ShapeSettings::new(shape.kind);
    writer.text("shape", shape.kind.name(), "");
    writer.number("aspect", shape.aspect, usual.aspect);
    writer.number("count", shape.count as f64, usual.count as f64);
    writer.number("turns", shape.turns, usual.turns);
    writer.number("inner", shape.inner, usual.inner);
    writer.number("span", shape.span, usual.span);
    writer.points("points", &shape.points);
    writer.flag("closed", shape.closed, usual.closed);
    if shape.color != usual.color {
        writer.colors("color", &[shape.color]);
    }
}

fn picture_settings(reader: &Reader<'_>) -> Result<PictureSettings, DrawError> {
    Ok(PictureSettings { way: reader.word("way", &WAYS)?, inverted: reader.flag("inverted", false)? })
}

fn write_picture(picture: &PictureSettings, writer: &mut Writer) {
    writer.word("way", &picture.way, &WAYS);
    writer.flag("inverted", picture.inverted, false);
}

fn scroll(reader: &Reader<'_>) -> Result<Option<Scroll>, DrawError> {
    let Some(window) = reader.number("window")? else { return Ok(None) };
    Ok(Some(Scroll { window, steps: reader.whole("steps", 1)?, step: reader.whole("step", 0)? }))
}
