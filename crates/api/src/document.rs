//! A show file as types, for its JSON Schema. docs/show-format.md says what each field means; `exchange` reads and writes
//! files.

#![allow(dead_code, reason = "only the schema is made of these types")]

use std::collections::BTreeMap;

use schemars::JsonSchema;

/// A place, stage metres: x to the right, y away from the audience.
pub type DocumentPlace = [f64; 2];
/// Settings of a source or layer; their names depend on its kind.
pub type DocumentSettings = BTreeMap<String, serde_json::Value>;

/// A show: what a `.lightbots.json` file holds.
#[derive(JsonSchema)]
#[schemars(title = "LightBots show", deny_unknown_fields)]
pub struct ShowDocument {
    /// Version of the format.
    #[schemars(range(min = 1, max = 2))]
    pub lightbots: u32,
    /// Name for people.
    pub name: Option<String>,
    /// The floor and the robots on it.
    pub stage: Option<DocumentStage>,
    /// Whether pixels with equal ids in different frames are shown by one robot.
    pub identity: Option<DocumentIdentity>,
    /// Places of the robots before the first frame; if absent, rows along the back edge.
    pub starts: Option<Vec<DocumentPlace>>,
    /// File name of the music.
    pub music: Option<String>,
    /// Number of spare robots. They have no pixels, and wait to replace robots that fail.
    pub spares: Option<u32>,
    /// Files that belong to the show, by their SHA-256.
    pub assets: Option<BTreeMap<String, DocumentAsset>>,
    /// Beats of the music.
    pub beats: Option<DocumentBeats>,
    /// Named stretches of the timeline.
    pub sections: Option<Vec<DocumentSection>>,
    /// Named moments of the timeline.
    pub markers: Option<Vec<DocumentMarker>>,
    /// Where the show waits for GO.
    pub cues: Option<Vec<DocumentCue>>,
    /// Light over time, lowest layer first.
    pub layers: Option<Vec<DocumentLayer>>,
    /// Timed paths that the show prescribes.
    pub trajectories: Option<Vec<DocumentTrajectory>>,
    /// Frames in playing order.
    pub frames: Vec<DocumentFrame>,
}

/// The floor and the robots on it.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentStage {
    /// Extent along x, metres.
    pub width_m: Option<f64>,
    /// Extent along y, metres.
    pub depth_m: Option<f64>,
    /// No-go areas.
    pub obstacles: Option<Vec<DocumentObstacle>>,
    /// Size and limits of robots.
    pub robot: Option<DocumentRobot>,
}

/// A no-go area.
#[derive(JsonSchema)]
#[schemars(untagged)]
pub enum DocumentObstacle {
    /// A disc.
    Disc {
        /// Centre.
        at: DocumentPlace,
        /// Radius, metres.
        radius_m: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Corner with the smaller x and y.
        min: DocumentPlace,
        /// Corner with the larger x and y.
        max: DocumentPlace,
    },
}

/// Size and limits of robots.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
#[allow(missing_docs, reason = "the names say it with their units")]
pub struct DocumentRobot {
    pub radius_m: Option<f64>,
    pub speed_mps: Option<f64>,
    pub accel_mps2: Option<f64>,
    pub turn_radps: Option<f64>,
    pub wheel_radps: Option<f64>,
    pub wheel_radius_m: Option<f64>,
    pub track_m: Option<f64>,
}

/// Whether pixels are bound to robots.
#[derive(JsonSchema)]
#[schemars(rename_all = "snake_case")]
pub enum DocumentIdentity {
    /// Any robot may show any pixel.
    Any,
    /// Pixels with equal ids in different frames are shown by one robot.
    Fixed,
}

/// A file that belongs to the show.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentAsset {
    /// Name for people.
    pub name: Option<String>,
    /// Media type.
    pub media_type: String,
    /// Length, bytes.
    pub bytes: u64,
}

/// Beats of the music: `bpm` and `offset_s`, or `times_s`.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentBeats {
    /// Beats per minute.
    pub bpm: Option<f64>,
    /// Time of the first beat, seconds from the start of the music.
    pub offset_s: Option<f64>,
    /// Times of all beats, seconds from the start of the music.
    pub times_s: Option<Vec<f64>>,
    /// Number of beats in a bar.
    pub per_bar: Option<u32>,
}

/// A named stretch of the timeline.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentSection {
    /// Name for people.
    pub name: Option<String>,
    /// Start, seconds from the start of the first frame's air time.
    pub from_s: f64,
    /// End, seconds from the start of the first frame's air time.
    pub to_s: f64,
}

/// A named moment of the timeline.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentMarker {
    /// Name for people.
    pub name: Option<String>,
    /// The moment, seconds from the start of the first frame's air time.
    pub at_s: f64,
}

/// A place where the show waits for GO: at the end of a frame, or at a moment.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentCue {
    /// Name for people.
    pub name: Option<String>,
    /// Id of the frame at the end of which the show waits.
    pub frame: Option<String>,
    /// Moment at which the show waits, seconds from the start of the first frame's air time.
    pub at_s: Option<f64>,
    /// Id of the first frame of those that repeat until GO. The last one is `frame`.
    pub loop_from: Option<String>,
}

/// Light over time.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentLayer {
    /// Name of the effect.
    pub kind: String,
    /// Name for people.
    pub name: Option<String>,
    /// Ids of the first and the last frame in which the layer shines.
    pub frames: Option<[String; 2]>,
    /// The part of each frame's time in which the layer shines.
    pub phase: Option<DocumentPhase>,
    /// Start, seconds from the start of the first frame's air time.
    pub from_s: Option<f64>,
    /// End, seconds from the start of the first frame's air time.
    pub to_s: Option<f64>,
    /// Settings of the effect.
    pub settings: Option<DocumentSettings>,
}

/// A part of a frame's time.
#[derive(JsonSchema)]
#[schemars(rename_all = "snake_case")]
pub enum DocumentPhase {
    /// The transition to the frame and its air time.
    Whole,
    /// The transition.
    Transition,
    /// The air time.
    Picture,
}

/// A timed path that the show prescribes.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentTrajectory {
    /// Id of the frame; without it, the path is for the whole show.
    pub frame: Option<String>,
    /// Id of the pixel whose robot drives the path.
    pub pixel: u32,
    /// Start of the path, seconds from the start of the transition to `frame`, or from the start of the show.
    pub at_s: Option<f64>,
    /// The place where it starts.
    pub start: DocumentPlace,
    /// `[end_s, x, y]`, or `[end_s, x1, y1, x2, y2, x, y]` with the control points of a cubic Bézier curve. `end_s`
    /// counts from the start of the path.
    #[schemars(inner(length(min = 3, max = 7)))]
    pub pieces: Vec<Vec<f64>>,
}

/// A picture of the show.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentFrame {
    /// Word by which layers, cues and trajectories name the frame.
    pub id: Option<String>,
    /// Name for people.
    pub name: Option<String>,
    /// How long the picture stays, seconds.
    pub air_time_s: Option<f64>,
    /// Moment at which the air time must begin, seconds from the start of the first frame's air time.
    pub at_s: Option<f64>,
    /// Wanted duration of the drive to the frame, seconds; if absent, the shortest drive that the planner finds.
    pub transition_s: Option<f64>,
    /// How robots speed up and slow down.
    pub easing: Option<DocumentEasing>,
    /// How robots get from the previous frame's picture to this frame: as one formation, one after another, or as a
    /// morph.
    pub motion: Option<DocumentMotion>,
    /// Overrides the show's `identity`.
    pub identity: Option<DocumentIdentity>,
    /// What the pixels were made from.
    pub sources: Option<Vec<DocumentSource>>,
    /// The pixels.
    pub pixels: Vec<DocumentPixel>,
}

/// How robots speed up and slow down.
#[derive(JsonSchema)]
#[schemars(rename_all = "snake_case")]
pub enum DocumentEasing {
    /// At the limits of the robots.
    Swift,
    /// They speed up over the first half of the drive and slow down over the second.
    Gentle,
}

/// How robots get from one picture to the next: as one formation, one after another, or as a morph. The other fields of
/// a motion depend on `kind`.
#[derive(JsonSchema)]
pub struct DocumentMotion {
    /// The kind.
    pub kind: DocumentMotionKind,
}

/// Kinds of motions.
#[derive(JsonSchema)]
#[schemars(rename_all = "snake_case")]
#[allow(missing_docs, reason = "docs/show-format.md has a table of them")]
pub enum DocumentMotionKind {
    Travel,
    Turn,
    Breathe,
    Follow,
    Wave,
    Stagger,
    Morph,
}

/// What pixels were made from.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentSource {
    /// The kind of source.
    pub kind: DocumentSourceKind,
    /// SHA-256 of the file from which the source is made.
    pub asset: Option<String>,
    /// Seed of everything random.
    pub seed: Option<u32>,
    /// Where the picture of the source lies on the floor.
    #[schemars(rename = "box")]
    pub area: Option<DocumentBox>,
    /// Ids of the pixels that were moved by hand.
    pub moved: Option<Vec<u32>>,
    /// A word shared by frames that were made together.
    pub series: Option<String>,
    /// Moment of the animation that the frame shows, seconds.
    pub moment_s: Option<f64>,
    /// Settings of this kind of source.
    pub settings: Option<DocumentSettings>,
}

/// Kinds of sources.
#[derive(JsonSchema)]
#[schemars(rename_all = "snake_case")]
#[allow(missing_docs, reason = "the names say it")]
pub enum DocumentSourceKind {
    Text,
    Svg,
    Picture,
    Shape,
    List,
    Animation,
}

/// A rectangle.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentBox {
    /// Corner with the smaller x and y.
    pub min: DocumentPlace,
    /// Corner with the larger x and y.
    pub max: DocumentPlace,
}

/// A light of a picture.
#[derive(JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct DocumentPixel {
    /// Id, unique in its frame.
    pub id: u32,
    /// Where the pixel is.
    pub place: DocumentPlace,
    /// Colour, `#rrggbb`.
    #[schemars(regex(pattern = "^#[0-9a-fA-F]{6}$"))]
    pub color: String,
    /// Name of the only robot that may show the pixel.
    pub robot: Option<String>,
    /// Index of the source that the pixel was made from, counted from 0.
    pub source: Option<u32>,
    /// Name of the part of that source.
    pub part: Option<String>,
    /// A word shared by pixels that are edited as one.
    pub group: Option<String>,
}
