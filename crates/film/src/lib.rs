//! Draws what the audience sees of a planned show: films, a contact sheet, and a sheet for the crew.
//!
//! The crate does no IO and has no clock: the same show gives the same bytes on every machine. In reading order:
//! [`FilmView`] and [`Camera`] project the stage into a picture, and [`Painter`] paints robots' lights.
//! [`ShowFilm`] is a show as a sequence of pictures. With the feature `sheets` a film becomes a GIF ([`GifWriter`]), a
//! [`contact_sheet()`] (PNG) or a [`crew_sheet()`] (PDF).

mod camera;
#[cfg(feature = "sheets")]
mod contact_sheet;
#[cfg(feature = "sheets")]
mod crew_sheet;
mod film;
#[cfg(feature = "sheets")]
mod gif_writer;
mod painter;
#[cfg(feature = "sheets")]
mod pdf_page;
mod tone;
#[cfg(feature = "sheets")]
mod words;

pub use camera::{Camera, FilmView, OnPicture};
#[cfg(feature = "sheets")]
pub use contact_sheet::{SHEET_FRAMES_MAX, contact_sheet};
#[cfg(feature = "sheets")]
pub use crew_sheet::crew_sheet;
pub use film::{FilmSize, FilmTimes, LEAD_S, ShowFilm};
#[cfg(feature = "sheets")]
pub use gif_writer::{GIF_COLOURS, GifError, GifPalette, GifWriter};
pub use painter::Painter;
