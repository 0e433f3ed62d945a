//! Functions that the browser runs itself, as WebAssembly: they make frames, fit shows to other fleets, plan, and
//! compute light.
//!
//! Requests and answers are JSON texts, in the types of `lightbots_api`, so that JavaScript needs no glue for each
//! type. Errors are values in the answers.
//!
//! In reading order: [`make_answer`] makes a frame and [`film_answer`] the frames of an animation. [`fit_answer`] fits
//! a show, [`plan_answer`] plans one, and [`moved_answer`] moves a picture as a whole. [`PlannedLight`] computes a
//! show's colours with [`LightPictures`], and [`FilmPainter`] paints films of it. [`choices`] lists what settings can
//! name, [`file()`] identifies a file, and [`beats_answer`] finds beats of music. The functions below call these for
//! JavaScript.

mod answer;
mod beats;
mod choices;
mod file;
mod film;
mod fit;
mod light;
mod make;
mod moved;
mod plan;
mod show_film;

use wasm_bindgen::prelude::wasm_bindgen;

pub use beats::beats_answer;
pub use choices::choices;
pub use file::file;
pub use film::film_answer;
pub use fit::fit_answer;
pub use light::{LightPictures, PlannedLight};
pub use make::make_answer;
pub use moved::moved_answer;
pub use plan::plan_answer;
pub use show_film::FilmPainter;

/// Makes a frame from its source. Takes a `MakeRequest` as JSON and the bytes of the source's file; no bytes: the source
/// has no file. Returns a `MakeAnswer` as JSON.
#[wasm_bindgen]
pub fn make(request: &str, asset: &[u8]) -> String {
    answer::text(&make_answer(request, (!asset.is_empty()).then_some(asset)))
}

/// Makes the frames of an animation. Takes a `MakeRequest` as JSON and the bytes of the file. Returns a `FilmAnswer` as
/// JSON.
#[wasm_bindgen]
pub fn film(request: &str, bytes: &[u8]) -> String {
    answer::text(&film_answer(request, bytes))
}

/// Fits a show to the number `robots` of robots. Takes the bytes of a show file of any format. Returns a `FitAnswer` as
/// JSON.
#[wasm_bindgen]
pub fn fit(show: &[u8], robots: usize) -> String {
    answer::text(&fit_answer(show, robots))
}

/// Plans a show. Takes a `PlanningRequest` as JSON. Returns a `PlanAnswer` as JSON.
#[wasm_bindgen]
pub fn plan(request: &str) -> String {
    answer::text(&plan_answer(request))
}

/// Moves a picture as a whole. Takes the bytes of a show file with two frames: the first has the picture, the second has
/// the motion. Returns a `MovedAnswer` as JSON.
#[wasm_bindgen]
pub fn moved(show: &[u8]) -> String {
    answer::text(&moved_answer(show))
}

/// Returns the fonts and shapes that settings can name: `MakeChoices` as JSON.
#[wasm_bindgen]
pub fn list() -> String {
    answer::text(&choices())
}

/// Identifies a dropped or chosen file by its bytes. Returns a `MakeFile` as JSON.
#[wasm_bindgen]
pub fn look(bytes: &[u8]) -> String {
    answer::text(&file(bytes))
}

/// Finds the beats of music. Takes samples of one channel, from -1 to 1, and the number of samples per second. Returns a
/// `BeatsAnswer` as JSON.
#[wasm_bindgen]
pub fn beats(samples: &[f32], rate_hz: f64) -> String {
    answer::text(&beats_answer(samples, rate_hz))
}
