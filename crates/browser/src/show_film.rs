//! Paints films of a planned show.

use lightbots_film::{FilmTimes, FilmView, Painter};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::light::PlannedLight;

/// Largest width or height of a picture, pixels.
const SIDE_MAX: u32 = 4096;

/// Paints the pictures of a film, one after another.
#[wasm_bindgen]
#[derive(Debug)]
pub struct FilmPainter {
    painter: Painter,
    times: FilmTimes,
    fps: f64,
}

#[wasm_bindgen]
impl FilmPainter {
    /// Prepares a film of a show with `fps` pictures per second. `from_front`: the show is seen from seats before the front
    /// edge, otherwise from above. Width and height are limited to 16 to 4,096 pixels.
    #[wasm_bindgen(constructor)]
    pub fn new(light: &PlannedLight, from_front: bool, width: u32, height: u32, fps: f64) -> FilmPainter {
        let view = if from_front { FilmView::Front } else { FilmView::Above };
        let size = (width.clamp(16, SIDE_MAX), height.clamp(16, SIDE_MAX));
        let times = light.with_planned(|planned| FilmTimes::new(planned, fps));
        Self { painter: Painter::new(view, light.stage(), size), times, fps }
    }

    /// Number of pictures of the film.
    pub fn pictures(&self) -> usize {
        self.times.pictures
    }

    /// Time from the start of the film to the start of the music, seconds.
    pub fn music_begins_s(&self) -> f64 {
        self.times.music_begins_s
    }

    /// Paints the picture with the index `number`, counted from 0. Returns four bytes for each pixel: red, green, blue and
    /// the opacity 255, row by row from the top left.
    pub fn picture(&mut self, light: &PlannedLight, number: usize) -> Vec<u8> {
        let at_s = self.times.begins_s + number as f64 / self.fps;
        let mut scene = Vec::new();
        light.with_planned(|planned| planned.scenes().at(at_s, &mut scene));
        let painted = self.painter.paint(&scene);
        painted.chunks_exact(3).flat_map(|pixel| [pixel[0], pixel[1], pixel[2], 255]).collect()
    }
}
