//! Makes frames from their sources: reads the sources of a show, draws them, and places lights on the drawings.
//!
//! The crate does no IO. In reading order: [`Recipe`] is the typed form of a source's settings, [`material()`] makes
//! its drawing, and [`make_frame`] its pixels. [`film()`] makes the frames of an animation, and [`layer_picture()`]
//! makes what a layer projects on the floor. [`fit_show`] fits all frames of a show to another fleet.

mod enough;
mod film;
mod fit;
mod floor;
mod frame;
mod layer_picture;
mod material;
mod recipe;
mod settings;

pub use enough::enough_for;
pub use film::{Film, FilmFrame, film};
pub use fit::fit_show;
pub use floor::picture_floor;
pub use frame::{MadeFrame, make_frame, make_frame_from};
pub use layer_picture::layer_picture;
pub use material::{Material, TextPages, material, text_pages};
pub use recipe::{Content, Placing, Recipe, Scroll, TextRecipe, unknown_shape};
