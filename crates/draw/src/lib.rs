//! Turns words, drawings and pictures into places and colours for any number of robots.
//!
//! The crate does no IO: bytes and numbers in, places and colours out. The same input and seed give the same bits.
//! In reading order: [`text`], [`svg`], [`picture`], [`animation`], [`list`] and [`draw_shape`] read or make a source.
//! All but [`list`] make a [`Drawing`] of parts with areas, lines and colours. [`place()`] puts lights on a drawing,
//! [`enough_robots`] says how many robots make it readable, and [`refit()`] changes the number of lights of a picture.

mod allot;
pub mod animation;
mod apart;
mod arrange;
mod buckets;
mod colour;
mod coverage;
mod drawing;
mod enough;
mod error;
mod fit;
mod geometry;
mod ground;
mod ink;
mod layout;
mod light_image;
mod lines;
pub mod list;
mod measure;
mod occupy;
pub mod picture;
mod pins;
mod place;
#[cfg(test)]
mod place_tests;
mod readability;
mod reader;
mod refit;
mod relax;
mod rivals;
mod seeds;
mod settings;
mod shape;
mod sniff;
pub mod svg;
mod symmetry;
pub mod text;
mod thick;
mod unique;

pub use buckets::closest_distance;
pub use drawing::{Area, Drawing, DrawingPart, FillRule, Raster, Stroke};
pub use enough::enough_robots;
pub use error::{DrawError, Made, Note};
pub use fit::{NoGo, PictureFloor};
pub use geometry::bounds;
pub use ground::Quality;
pub use ink::{Gradient, GradientShape, GradientSpread, Ink};
pub use layout::Style;
pub use list::LightList;
pub use measure::{Figures, figures};
pub use place::{Placed, place};
pub use readability::{DOUBTFUL, READABLE, Readability};
pub use reader::{SignRead, SignReader};
pub use refit::{RefitLight, refit};
pub use rivals::rivals;
pub use settings::{MAX_ROBOTS, PlaceSettings, PlacedLight};
pub use shape::{MAX_SHAPE_POINTS, SHAPES, ShapeKind, ShapeSettings, draw_shape, exact_places, shape_named};
pub use sniff::{FileKind, sniff, unsupported};
pub use svg::font_faces;
