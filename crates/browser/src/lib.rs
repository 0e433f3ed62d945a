//! What the browser runs by itself as WebAssembly: frames from words, drawings and shapes, shows for other
//! fleets, plans, and light.
//!
//! JSON texts go in and out, in the types of `lightbots_api`, so that JavaScript needs no glue for each type. Errors are
//! values in the answers. In reading order: [`make_answer`] makes a frame, [`film_answer`] those of an animation,
//! [`fit_answer`] fits a show, [`plan_answer`] plans one, [`moved_answer`] moves a picture as one, [`PlannedLight`] has its
//! colours with [`LightPictures`], [`FilmPainter`] paints films of it, [`choices`] lists what settings may name, [`file()`]
//! tells what a file is, [`beats_answer`] finds beats of music; the functions below them are the same for JavaScript.

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

/// Makes a frame: a `MakeRequest` as JSON and the bytes of the source's file, empty without one; a `MakeAnswer` as JSON.
#[wasm_bindgen]
pub fn make(request: &str, asset: &[u8]) -> String {
    answer::text(&make_answer(request, (!asset.is_empty()).then_some(asset)))
}

/// Makes the frames of an animation: a `MakeRequest` as JSON and the bytes of the file; a `FilmAnswer` as JSON.
#[wasm_bindgen]
pub fn film(request: &str, bytes: &[u8]) -> String {
    answer::text(&film_answer(request, bytes))
}

/// Fits a show to a number of robots: a show file of any format; a `FitAnswer` as JSON.
#[wasm_bindgen]
pub fn fit(show: &[u8], robots: usize) -> String {
    answer::text(&fit_answer(show, robots))
}

/// Plans a show: a `PlanningRequest` as JSON; a `PlanAnswer` as JSON.
#[wasm_bindgen]
pub fn plan(request: &str) -> String {
    answer::text(&plan_answer(request))
}

/// Moves a picture as one: a show file of two frames, of which the second has the motion; a `MovedAnswer` as JSON.
#[wasm_bindgen]
pub fn moved(show: &[u8]) -> String {
    answer::text(&moved_answer(show))
}

/// What settings may name: `MakeChoices` as JSON.
#[wasm_bindgen]
pub fn list() -> String {
    answer::text(&choices())
}

/// What a dropped or chosen file is: its bytes; a `MakeFile` as JSON.
#[wasm_bindgen]
pub fn look(bytes: &[u8]) -> String {
    answer::text(&file(bytes))
}

/// Finds the beats of music: samples of one channel, and how many there are in a second; a `BeatsAnswer` as JSON.
#[wasm_bindgen]
pub fn beats(samples: &[f32], rate_hz: f64) -> String {
    answer::text(&beats_answer(samples, rate_hz))
}
