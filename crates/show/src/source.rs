//! What a frame was made from, so that it can be made again with other settings or another number of robots.

use lightbots_base::Vec2;
use serde::{Deserialize, Serialize};

use crate::asset::AssetHash;
use crate::setting::NamedSettings;

/// What pixels of a frame were made from: a word, a drawing, a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameSource {
    /// Kind of source.
    pub kind: SourceKind,
    /// The file that the source is made from; `None`: the source has no file.
    pub asset: Option<AssetHash>,
    /// Seed of all random choices in placing the source's pixels.
    pub seed: u32,
    /// Rectangle in which the picture of the source lies, unless `settings` state its size and centre. `None`: no
    /// rectangle is given.
    pub floor_box: Option<FloorBox>,
    /// Ids of the pixels that a user moved by hand, sorted and unique. When the source is made anew, these pixels keep
    /// their places, as far as there are robots for them.
    pub moved: Vec<u32>,
    /// Name that all frames made together share, such as one frame for each word of a text; `None`: the frame was made
    /// alone.
    pub series: Option<String>,
    /// Moment of the animation that the frame shows, seconds from the start of the animation; `None`: no animation.
    pub moment_s: Option<f64>,
    /// Settings, such as the text and its font. Serde skips `settings`, because untrusted input could nest them without
    /// a bound.
    #[serde(skip)]
    pub settings: NamedSettings,
}

/// Kind of source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SourceKind {
    /// Words in a font.
    Text,
    /// An SVG drawing.
    Svg,
    /// A raster picture, such as a PNG.
    Picture,
    /// A shape with handles, such as a star.
    Shape,
    /// A list of places, such as a CSV file.
    List,
    /// A moving picture, such as a GIF.
    Animation,
}

/// A rectangle on the floor with sides along the axes, stage metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FloorBox {
    /// Corner with the smaller x and y.
    pub min: Vec2,
    /// Corner with the larger x and y.
    pub max: Vec2,
}

/// The part of a source that a pixel belongs to.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourcePart {
    /// Index of the source in [`Frame::sources`](crate::Frame::sources), counted from 0.
    pub source: u32,
    /// Name of the part, such as a letter of a word; may be empty. When the source is made anew, pinned robots are
    /// pinned to new pixels, of the same part if possible.
    pub name: String,
}

impl FrameSource {
    /// A source without a file and settings.
    pub fn new(kind: SourceKind) -> Self {
        Self {
            kind,
            asset: None,
            seed: 0,
            floor_box: None,
            moved: Vec::new(),
            series: None,
            moment_s: None,
            settings: Vec::new(),
        }
    }
}

impl SourceKind {
    /// All kinds.
    pub const ALL: [Self; 6] =
        [Self::Text, Self::Svg, Self::Picture, Self::Shape, Self::List, Self::Animation];

    /// The word for the kind in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Svg => "svg",
            Self::Picture => "picture",
            Self::Shape => "shape",
            Self::List => "list",
            Self::Animation => "animation",
        }
    }
}
