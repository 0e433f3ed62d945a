//! What the audience sees of a planned show, as pictures: films, a contact sheet, and a sheet for the crew.
//!
//! No IO and no clock: the same show gives the same bytes on every machine. Reading order: [`FilmView`] and [`Camera`] say
//! where things are in a picture; [`Painter`] paints robots' lights; [`ShowFilm`] is a show as pictures one after another.
//! With the feature `sheets` a film becomes a GIF ([`GifWriter`]), a [`contact_sheet`] (PNG) or a [`crew_sheet`] (PDF).

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
