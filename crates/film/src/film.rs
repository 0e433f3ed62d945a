//! Shows a planned show as a sequence of pictures.

use lightbots_lighting::{PlannedScenes, PlannedShow, SeenRobot};
use lightbots_show::Stage;

use crate::camera::FilmView;
use crate::painter::Painter;

/// How long before the air time of the first frame a film begins, seconds; less if the drive to that frame is shorter. A
/// film does not show all of that drive, because robots are dark for most of it.
pub const LEAD_S: f64 = 1.5;

/// Size and rate of a film's pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSize {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// Pictures per second.
    pub fps: f64,
}

/// Start and length of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTimes {
    /// Start of the film, seconds from the start of the drive to the first frame.
    pub begins_s: f64,
    /// Start of the music, which is the start of the first frame's air time, seconds from the start of the film.
    pub music_begins_s: f64,
    /// Number of pictures of the film.
    pub pictures: usize,
}

impl FilmTimes {
    /// Computes start and length of the film of a show with `fps` pictures per second.
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
    /// Prepares a film of a show, seen from `view`. `stage` is the stage of the show.
    pub fn new(planned: &'a PlannedShow<'a>, stage: &Stage, view: FilmView, size: FilmSize) -> Self {
        let painter = Painter::new(view, stage, (size.width, size.height));
        let times = FilmTimes::new(planned, size.fps);
        Self { times, scenes: planned.scenes(), painter, scene: Vec::new(), fps: size.fps }
    }

    /// Start and length of the film.
    pub fn times(&self) -> FilmTimes {
        self.times
    }

    /// Paints the picture with the index `number`, counted from 0. Returns red, green and blue of each pixel, row by row
    /// from the top left.
    pub fn picture(&mut self, number: usize) -> &[u8] {
        self.picture_at(self.times.begins_s + number as f64 / self.fps)
    }

    /// Paints the picture at the moment `at_s`, seconds from the start of the drive to the first frame. Returns pixels as
    /// [`Self::picture`] does.
    pub fn picture_at(&mut self, at_s: f64) -> &[u8] {
        self.scenes.at(at_s, &mut self.scene);
        self.painter.paint(&self.scene)
    }
}
