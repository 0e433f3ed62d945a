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
    /// The file behind the source; `None`: the settings suffice.
    pub asset: Option<AssetHash>,
    /// Seed of all random choices in placing its pixels.
    pub seed: u32,
    /// Where the picture of the source lies on the floor; `None`: the whole floor.
    pub floor_box: Option<FloorBox>,
    /// Ids of pixels that a user moved by hand. They keep their place when the others are placed anew. Sorted, unique.
    pub moved: Vec<u32>,
    /// Name that frames share which were made together from one source, such as frames of one word each from a text.
    pub series: Option<String>,
    /// Moment of an animation that the frame shows, seconds from its start.
    pub moment_s: Option<f64>,
    /// Settings, such as the text and its font. Serde skips them: they nest, and untrusted input could nest them
    /// without a bound.
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
    /// Name of the part, such as a letter of a word; may be empty. When pixels are made anew, a pin moves to a pixel of
    /// the same part.
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
    /// Every kind.
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
