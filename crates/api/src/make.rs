//! Frames that are made from words, drawings and shapes: requests to the module in the browser, and its answers.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A request to make a frame from its source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeRequest {
    /// A show in the format `lightbots`. Only its stage and its first frame, which has the source, are used. Pixels of that
    /// frame that were moved by hand keep their places.
    #[ts(type = "unknown")]
    pub show: serde_json::Value,
    /// Number of robots.
    pub robots: usize,
    /// How much work is put into the frame.
    pub quality: MakeQuality,
}

/// How much work is put into a result.
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
    /// The pixels with their ids; empty if there is an error.
    pub pixels: Vec<MadePixel>,
    /// Longer side of the picture, metres.
    pub size_m: f64,
    /// Distance of the closest two pixels, metres; null with fewer than two pixels.
    pub closest_m: Option<f64>,
    /// How well the lights show the source; null: the source is itself an arrangement of lights, such as a grid.
    pub readability: Option<MadeReadability>,
    /// Number of robots with which the source would be readable, determined only for a `full` result that is not
    /// readable. null: not determined, or a thousand robots are not enough.
    pub enough: Option<usize>,
    /// What is missing from the picture, or differs from the request.
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

/// How well the lights of a frame show the frame's source.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MadeReadability {
    /// Normalised cross-correlation of the blurred lights with the source, 0 to 1. A source of several parts, such as
    /// letters, gets the lowest value of its parts.
    pub correlation: f64,
    /// Share of the lights that have a mirror image, 0 to 1, if the source is mirror-symmetric; 1 for other sources.
    pub symmetry: f64,
    /// Whether `correlation` is high enough for viewers to recognise the picture without being told what it is.
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
    /// The frames in order of time; empty if there is an error.
    pub frames: Vec<FilmPicture>,
    /// Factor by which the animation is slowed down, so that robots have time to move; 1: it is not slowed down.
    pub slowdown: f64,
    /// What is missing from the frames, or differs from the animation.
    pub notes: Vec<MakeRemark>,
    /// Why there are no frames; null: there are frames.
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

/// A show whose frames were all fitted to the same number of robots, or why there is none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct FitAnswer {
    /// The show in the format `lightbots`; null if there is an error.
    #[ts(type = "unknown")]
    pub show: Option<serde_json::Value>,
    /// Changes to the show that people may not expect, such as lost starting places.
    pub notes: Vec<MakeRemark>,
    /// Why there is no show; null: there is one.
    pub error: Option<MakeRemark>,
}

/// Fonts and shapes that the settings of sources may name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct MakeChoices {
    /// Built-in fonts, in the order in which they are offered.
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
    /// Number of corners, tips or circles.
    pub count: usize,
    /// Turns of a spiral, or periods of a wave.
    pub turns: f64,
    /// Inner radius as a share of the outer radius.
    pub inner: f64,
    /// Angle of an arc, radians.
    pub span: f64,
}

/// A built-in font.
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
    /// SHA-256 of the file's bytes as 64 hexadecimal digits.
    pub hash: String,
    /// What the file can be used for. `svg`, `picture`, `list` or `animation`: source of a frame; `font`: font of
    /// words; `show`: a show; `music`: music of a show. null: the file cannot be used.
    pub kind: Option<String>,
    /// Why the file cannot be used, and what to do; null: the file can be used.
    pub error: Option<MakeRemark>,
}

/// Where the pixels of a picture are after a motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct MovedAnswer {
    /// The pixels with their ids; empty if there is an error.
    pub pixels: Vec<MovedPixel>,
    /// Why there are no pixels; null: there are pixels.
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
    /// Time of the first beat, seconds from the start of the music file, if the tempo is constant; null: `times_s` has
    /// each beat.
    pub offset_s: Option<f64>,
    /// Times of all beats, seconds from the start of the music file, increasing; empty if the tempo is constant.
    pub times_s: Vec<f64>,
    /// Why no beats were found, and what to do; null: beats were found.
    pub error: Option<MakeRemark>,
}
