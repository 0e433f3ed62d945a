//! Frames that are made from words, drawings and shapes: requests to the module in the browser, and its answers.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A wish for a frame that is made from its source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeRequest {
    /// A show in our format of which only the stage and the first frame count. The frame has the source; its pixels that
    /// were moved by hand keep their places.
    #[ts(type = "unknown")]
    pub show: serde_json::Value,
    /// Number of robots.
    pub robots: usize,
    /// How much work is done.
    pub quality: MakeQuality,
}

/// How much work a made frame takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "lowercase")]
pub enum MakeQuality {
    /// A preview while a setting changes.
    Quick,
    /// The result that is saved.
    Full,
}

/// A made frame, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeAnswer {
    /// The pixels by their ids; empty with an error.
    pub pixels: Vec<MadePixel>,
    /// Longer side of the picture, metres.
    pub size_m: f64,
    /// Distance of the closest two pixels, metres; null with fewer than two pixels.
    pub closest_m: Option<f64>,
    /// How well the lights show the source; null: the source is an arrangement of lights by itself, such as a grid.
    pub readability: Option<MadeReadability>,
    /// Number of robots that would show the source readably, counted only for a full result that is not readable; null:
    /// the result is readable, or not even a thousand robots would do.
    pub enough: Option<usize>,
    /// What is missing from the picture, or different from the wish.
    pub notes: Vec<MakeRemark>,
    /// Why there is no picture; null: there is one.
    pub error: Option<MakeRemark>,
}

/// A pixel of a made frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MadePixel {
    /// Id, unique in its frame.
    pub id: u32,
    /// x and y, stage metres.
    pub place: [f64; 2],
    /// Colour as red, green and blue, such as `#ffa500`.
    pub color: String,
    /// The robot that is pinned to the pixel; null: any robot.
    pub robot: Option<String>,
    /// Name of the source's part, such as a letter; may be empty. null: the pixel belongs to no source.
    pub part: Option<String>,
}

/// How well lights show what they are made from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MadeReadability {
    /// Normalised cross-correlation of the blurred lights with the source, 0 to 1: the worst part's.
    pub correlation: f64,
    /// Share of the lights that have a mirror image, where the source is mirror-symmetric; 1 for others.
    pub symmetry: f64,
    /// Whether guests read the picture without being told what it is.
    pub readable: bool,
}

/// A note or an error: a word for programs and a sentence for people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeRemark {
    /// Kind for programs, such as `too-many-robots`.
    pub code: String,
    /// One line for people: what is wrong, where, and the remedy.
    pub message: String,
}

/// The frames that an animation becomes, or why there are none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct FilmAnswer {
    /// In order of time; empty with an error.
    pub frames: Vec<FilmPicture>,
    /// Factor by which the animation is slowed down, so that robots have time to move; 1: as it is.
    pub slowdown: f64,
    /// What is missing, or different from the animation.
    pub notes: Vec<MakeRemark>,
    /// Why there are no frames; null: there are.
    pub error: Option<MakeRemark>,
}

/// A frame that shows a moment of an animation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct FilmPicture {
    /// The moment, seconds from the start of the animation.
    pub moment_s: f64,
    /// How long the picture stays, seconds.
    pub air_time_s: f64,
    /// The frame's pixels.
    pub made: MakeAnswer,
}

/// A show whose frames all have one number of robots, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct FitAnswer {
    /// The show in our format; null with an error.
    #[ts(type = "unknown")]
    pub show: Option<serde_json::Value>,
    /// What is different from what might be expected.
    pub notes: Vec<MakeRemark>,
    /// Why there is no show; null: there is one.
    pub error: Option<MakeRemark>,
}

/// What the settings of sources may name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeChoices {
    /// Fonts inside, in the order in which they are offered.
    pub fonts: Vec<MakeFont>,
    /// All shapes with their usual settings.
    pub shapes: Vec<MakeShape>,
}

/// A shape with its usual settings; each shape uses some of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeShape {
    /// Name in settings.
    pub name: String,
    /// Width over height.
    pub aspect: f64,
    /// Corners, tips or circles.
    pub count: usize,
    /// Turns of a spiral, periods of a wave.
    pub turns: f64,
    /// Inner radius as a share of the outer one.
    pub inner: f64,
    /// Angle of an arc, radians.
    pub span: f64,
}

/// A font inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeFont {
    /// Name in settings.
    pub name: String,
    /// Name for people.
    pub title: String,
}

/// A file that was dropped or chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeFile {
    /// SHA-256 of its bytes as 64 hexadecimal digits.
    pub hash: String,
    /// `svg`, `picture`, `list` or `animation`: a frame is made from it; `font`: words are set in it; `show`: it is a show;
    /// `music`: it is the music of a show; null: it is of no use here.
    pub kind: Option<String>,
    /// Why it is of no use, and what to do; null: it is.
    pub error: Option<MakeRemark>,
}

/// Where the pixels of a picture are after a motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct MovedAnswer {
    /// The pixels by their ids; empty with an error.
    pub pixels: Vec<MovedPixel>,
    /// Why there are none; null: there are.
    pub error: Option<MakeRemark>,
}

/// A pixel after a motion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MovedPixel {
    /// Id, as in the picture before.
    pub id: u32,
    /// x and y, stage metres.
    pub place: [f64; 2],
}

/// Beats that were found in music.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct BeatsAnswer {
    /// Tempo, beats a minute.
    pub bpm: f64,
    /// The first beat, seconds of the music file, if all keep one tempo; null: `times_s` has each beat.
    pub offset_s: Option<f64>,
    /// Each beat, seconds of the music file, increasing; empty if all keep one tempo.
    pub times_s: Vec<f64>,
    /// Why no beats were found, and what to do; null: they were.
    pub error: Option<MakeRemark>,
}
