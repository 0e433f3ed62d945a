//! Computes the colours of a planned show's robots.

use lightbots_api::{LightAnswer, LightRequest, MakeRemark, Transition};
use lightbots_base::{Piece, Span, Vec2};
use lightbots_lighting::{LAYER_PICTURES_MAX, PlannedDrive, PlannedShow, ShowLight, floor_picture};
use lightbots_make::layer_picture;
use lightbots_plan::Path;
use lightbots_show::{Frame, LayerPicture, Show, Stage};
use std::collections::BTreeMap;
use wasm_bindgen::prelude::wasm_bindgen;

use crate::answer;

/// Largest number of colours in one answer, one for each robot and moment. If a request needs more, the answer has fewer
/// moments than requested.
const COLOURS_MAX: usize = 2_000_000;

/// Decoded pictures that layers project on the floor.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct LightPictures {
    /// The pictures, by the hash of their file.
    decoded: BTreeMap<String, LayerPicture>,
}

#[wasm_bindgen]
impl LightPictures {
    /// Makes an empty collection.
    #[wasm_bindgen(constructor)]
    pub fn new() -> LightPictures {
        Self::default()
    }

    /// Decodes a file and keeps its picture under `hash`. Returns a `LightAnswer` as JSON. Its error says what is wrong
    /// with the file, or that too many pictures are kept.
    pub fn add(&mut self, hash: &str, file: &[u8]) -> String {
        let decoded = if lightbots_exchange::is_sequence(file) {
            let remark = |message| MakeRemark { code: "bad-sequence".into(), message };
            lightbots_exchange::sequence_picture(file).map_err(remark)
        } else {
            layer_picture(file).map_err(answer::drawing)
        };
        let decoded = decoded.and_then(|picture| {
            if self.decoded.len() >= LAYER_PICTURES_MAX && !self.decoded.contains_key(hash) {
                let message =
                    format!("More than {LAYER_PICTURES_MAX} pictures were looked at: reload the page.");
                return Err(MakeRemark { code: "too-many-pictures".into(), message });
            }
            self.decoded.insert(hash.to_owned(), picture);
            Ok(())
        });
        answer::text(&LightAnswer { robots: 0, error: decoded.err() })
    }
}

impl LightPictures {
    fn light(&self, show: &Show) -> ShowLight {
        ShowLight::with_pictures(show, |hash| floor_picture(self.decoded.get(hash)?)).0
    }
}

/// The light of a planned show. It gives the colours of all robots at any moments.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct PlannedLight {
    show: Show,
    light: ShowLight,
    drives: Vec<Drive>,
    robots: usize,
    error: Option<MakeRemark>,
}

/// The drive to a frame.
#[derive(Debug)]
struct Drive {
    pixels: Vec<Option<u32>>,
    paths: Vec<Path>,
    duration: Span,
}

#[wasm_bindgen]
impl PlannedLight {
    /// Reads a `LightRequest` as JSON. If reading fails, [`Self::answer`] returns the error.
    #[wasm_bindgen(constructor)]
    pub fn new(request: &str, pictures: &LightPictures) -> PlannedLight {
        Self::read(request, pictures).unwrap_or_else(|error| Self { error: Some(error), ..Self::default() })
    }

    /// Returns the result of reading: a `LightAnswer` as JSON.
    pub fn answer(&self) -> String {
        answer::text(&LightAnswer { robots: self.robots, error: self.error.clone() })
    }

    /// Replaces the layers of the show by those of `document`, a show in the format `lightbots`. Nothing else of
    /// `document` is used, and it may have no pixels. If `document` cannot be read, the layers stay as they are.
    /// Returns a `LightAnswer` as JSON.
    pub fn relight(&mut self, document: &str, pictures: &LightPictures) -> String {
        match shown(document) {
            Ok(other) => {
                self.show.layers = other.layers;
                self.light = pictures.light(&self.show);
                self.answer()
            }
            Err(error) => answer::text(&LightAnswer { robots: self.robots, error: Some(error) }),
        }
    }

    /// Returns the colours of all robots at `count` moments, or at fewer if the answer would be too long. For each moment,
    /// the result has red, green and blue of each robot. `from_s` is the first moment, seconds from the start of the drive
    /// to the first frame; moments are `step_s` apart. Robots that are not in a frame are dark.
    pub fn colours(&self, from_s: f64, step_s: f64, count: usize) -> Vec<u8> {
        self.with_planned(|planned| {
            let (mut scenes, mut scene, mut bytes) = (planned.scenes(), Vec::new(), Vec::new());
            for nth in 0..self.count_of(count) {
                scenes.at(from_s + step_s * nth as f64, &mut scene);
                let start = bytes.len();
                bytes.extend(scene.iter().flat_map(|robot| [robot.colour.r, robot.colour.g, robot.colour.b]));
                bytes.resize(start + 3 * self.robots, 0);
            }
            bytes
        })
    }
}

impl PlannedLight {
    fn read(request: &str, pictures: &LightPictures) -> Result<Self, MakeRemark> {
        let request: LightRequest = answer::request(request)?;
        let show = shown(&request.show.to_string())?;
        let planned = |number: usize, frame: &Frame| match request.transitions.get(number) {
            Some(way) if !way.paths.is_empty() => Drive::planned(way),
            _ => Drive::standing(frame),
        };
        let drives: Vec<Drive> =
            show.frames.iter().enumerate().map(|(number, frame)| planned(number, frame)).collect();
        let robots = drives.iter().map(|drive| drive.pixels.len()).max().unwrap_or(0);
        let light = pictures.light(&show);
        Ok(Self { show, light, drives, robots, error: None })
    }

    /// Calls `of` with the planned show and returns its result.
    pub(crate) fn with_planned<T>(&self, of: impl FnOnce(&PlannedShow<'_>) -> T) -> T {
        let drives = self.drives.iter().map(Drive::as_planned).collect();
        of(&PlannedShow::of_drives(&self.show, drives, &self.light))
    }

    pub(crate) fn stage(&self) -> &Stage {
        &self.show.stage
    }

    fn count_of(&self, count: usize) -> usize {
        count.min(COLOURS_MAX / self.robots.max(1))
    }
}

fn shown(document: &str) -> Result<Show, MakeRemark> {
    let loaded = lightbots_exchange::read(document.as_bytes(), None);
    loaded.map(|loaded| loaded.show).map_err(|error| answer::reading(&error))
}

impl Drive {
    fn planned(way: &Transition) -> Self {
        let paths = way.paths.iter().map(|path| {
            let piece = |piece: &[f64; 7]| Piece {
                duration: Span::from_secs(piece[0]),
                c1: Vec2::new(piece[1], piece[2]),
                c2: Vec2::new(piece[3], piece[4]),
                end: Vec2::new(piece[5], piece[6]),
            };
            let pieces = path.pieces.iter().map(piece).collect();
            let [x, y] = path.start;
            Path { start: Vec2::new(x, y), pieces }
        });
        let paths: Vec<Path> = paths.collect();
        let mut pixels = way.pixels.clone();
        pixels.resize(paths.len(), None);
        Self { pixels, paths, duration: Span::from_secs(way.duration_s) }
    }

    /// Returns the drive to a frame without a plan: it takes no time, and robots stand on the frame's pixels.
    fn standing(frame: &Frame) -> Self {
        let pixels = frame.pixels.iter().map(|pixel| Some(pixel.id)).collect();
        Self { pixels, paths: Vec::new(), duration: Span::ZERO }
    }

    fn as_planned(&self) -> PlannedDrive<'_> {
        PlannedDrive { pixels: &self.pixels, paths: &self.paths, duration: self.duration }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan_answer;

    fn show(layers: &str) -> String {
        format!(
            r##"{{"lightbots": 2, "layers": [{layers}], "frames": [
            {{"name": "A", "air_time_s": 2, "pixels": [{{"id": 4, "place": [0, 0], "color": "#ff0000"}}]}},
            {{"name": "B", "air_time_s": 2, "pixels": [{{"id": 4, "place": [1, 0], "color": "#0000ff"}}]}}]}}"##
        )
    }

    fn planned(request: &str) -> PlannedLight {
        PlannedLight::new(request, &LightPictures::new())
    }

    fn with_plan(layers: &str) -> (PlannedLight, f64) {
        let show = show(layers);
        let plan = plan_answer(&format!(r#"{{"show": {show}, "quality": "full"}}"#)).plan.unwrap();
        let ways = serde_json::to_string(&plan.transitions).unwrap();
        let light = planned(&format!(r#"{{"show": {show}, "transitions": {ways}}}"#));
        assert_eq!(light.answer(), r#"{"robots":1,"error":null}"#);
        (light, plan.transitions[0].duration_s)
    }

    #[test]
    fn pixels_shine_in_their_own_colours_and_layers_over_them_at_show_time() {
        // Show time begins with the air time of the first frame, this long after moment 0.
        let (plain, first_s) = with_plan("");
        assert_eq!(plain.colours(first_s + 1.0, 100.0, 2), [255, 0, 0, 0, 0, 255]);
        let green = r##"{"kind": "solid", "from_s": 0.5, "to_s": 1, "settings": {"palette": ["#00ff00"]}}"##;
        let (lit, _) = with_plan(green);
        assert_eq!(lit.colours(first_s + 0.4, 0.2, 4), [255, 0, 0, 0, 255, 0, 0, 255, 0, 255, 0, 0]);
    }

    #[test]
    fn without_a_plan_robots_stand_on_their_pixels() {
        let along =
            r##"{"kind": "gradient", "settings": {"speed_hz": 0, "palette": ["#000000", "#ffffff"]}}"##;
        let light = planned(&format!(r#"{{"show": {}, "transitions": []}}"#, show(along)));
        assert_eq!(light.colours(0.5, 2.0, 3), [0, 0, 0, 255, 255, 255, 255, 255, 255]);
    }

    #[test]
    fn layers_are_exchanged_without_a_new_show() {
        let (mut light, first_s) = with_plan("");
        let frames = r#""frames": [{"name": "A", "pixels": []}]"#;
        let layers = r##""layers": [{"kind": "solid", "settings": {"palette": ["#00ff00"]}}]"##;
        let answer =
            light.relight(&format!(r#"{{"lightbots": 2, {layers}, {frames}}}"#), &LightPictures::new());
        assert_eq!(answer, r#"{"robots":1,"error":null}"#);
        assert_eq!(light.colours(first_s, 1.0, 1), [0, 255, 0]);
        assert!(light.relight("{", &LightPictures::new()).contains("error"));
        assert_eq!(light.colours(first_s, 1.0, 1), [0, 255, 0]);
    }

    #[test]
    fn absurd_moments_and_shows_are_answered() {
        let (light, _) = with_plan("");
        for from_s in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
            assert_eq!(light.colours(from_s, f64::NAN, 2).len(), 6);
        }
        assert_eq!(light.colours(0.0, 0.0, usize::MAX).len(), 3 * COLOURS_MAX);
        let none = planned("{");
        assert!(none.answer().contains("bad-request"));
        assert!(none.colours(0.0, 1.0, 9).is_empty());
    }

    /// A GIF of 2 by 1 pixels, blue and red. It has a palette of two colours, and codes of three bits (clear 4, 0, 1,
    /// end 5).
    const GIF: &[u8] = b"GIF89a\x02\0\x01\0\x80\0\0\0\0\xff\xff\0\0,\0\0\0\0\x02\0\x01\0\0\x02\x02D\n\0;";

    #[test]
    fn a_picture_of_a_layer_shines_once_it_was_decoded_and_what_is_wrong_is_said() {
        let hash = "ab".repeat(32);
        let settings = format!(r#"{{"picture": "{hash}", "place": [0.5, 0], "size_m": 2}}"#);
        let request = format!(
            r#"{{"show": {}, "transitions": []}}"#,
            show(&format!(r#"{{"kind": "picture", "settings": {settings}}}"#))
        );
        let mut pictures = LightPictures::new();
        let own = [255, 0, 0, 0, 0, 255];
        assert_eq!(PlannedLight::new(&request, &pictures).colours(0.5, 2.0, 2), own);
        let cut = pictures.add(&hash, &GIF[..20]);
        assert!(cut.contains("damaged or cut off"), "{cut}");
        assert_eq!(PlannedLight::new(&request, &pictures).colours(0.5, 2.0, 2), own);
        assert_eq!(pictures.add(&hash, GIF), r#"{"robots":0,"error":null}"#);
        // The robot stands on the centres of the picture's pixels, on the left one first.
        let lit = PlannedLight::new(&request, &pictures).colours(0.5, 2.0, 2);
        assert_eq!(lit, [0, 0, 255, 255, 0, 0]);
    }
}
