//! A planned show as pictures one after another.

use lightbots_lighting::{PlannedScenes, PlannedShow, SeenRobot};
use lightbots_show::Stage;

use crate::camera::FilmView;
use crate::painter::Painter;

/// How long before the first picture stands a film begins, seconds. Robots drive there in the dark.
pub const LEAD_S: f64 = 1.5;

/// Size of pictures and how many a second there are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSize {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Pictures a second.
    pub fps: f64,
}

/// When a film begins, and how long it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTimes {
    /// Seconds since the start of the drive to the first frame.
    pub begins_s: f64,
    /// How long the music waits: it begins with the first frame's air time, seconds of the film.
    pub music_begins_s: f64,
    /// Number of pictures.
    pub pictures: usize,
}

impl FilmTimes {
    /// Of a show with `fps` pictures a second.
    pub fn new(planned: &PlannedShow<'_>, fps: f64) -> Self {
        let begins_s = (planned.first_drive_s() - LEAD_S).max(0.0);
        let pictures = ((planned.duration_s() - begins_s).max(0.0) * fps).round().max(1.0) as usize;
        Self { begins_s, music_begins_s: planned.first_drive_s() - begins_s, pictures }
    }
}

/// A film of a show.
#[derive(Debug)]
pub struct ShowFilm<'a> {
    times: FilmTimes,
    scenes: PlannedScenes<'a>,
    painter: Painter,
    scene: Vec<SeenRobot>,
    fps: f64,
}

impl<'a> ShowFilm<'a> {
    /// A film from one view.
    pub fn new(planned: &'a PlannedShow<'a>, stage: &Stage, view: FilmView, size: FilmSize) -> Self {
        let painter = Painter::new(view, stage, (size.width, size.height));
        let times = FilmTimes::new(planned, size.fps);
        Self { times, scenes: planned.scenes(), painter, scene: Vec::new(), fps: size.fps }
    }

    /// When it begins, and how long it is.
    pub fn times(&self) -> FilmTimes {
        self.times
    }

    /// A picture, counted from 0: red, green and blue of each pixel, row by row from the top left.
    pub fn picture(&mut self, number: usize) -> &[u8] {
        self.picture_at(self.times.begins_s + number as f64 / self.fps)
    }

    /// The picture at a moment, seconds since the start of the drive to the first frame.
    pub fn picture_at(&mut self, at_s: f64) -> &[u8] {
        self.scenes.at(at_s, &mut self.scene);
        self.painter.paint(&self.scene)
    }
}
