//! `render`: what the audience sees, as a film, and sheets of paper about a show.

mod ffmpeg;
mod output;

use std::fs::File;
use std::io::BufWriter;

use lightbots_api as api;
use lightbots_base::Vec2;
use lightbots_film::{
    FilmSize, GifError, GifPalette, GifWriter, SHEET_FRAMES_MAX, ShowFilm, contact_sheet, crew_sheet,
};
use lightbots_lighting::{PlannedShow, ShowLight};
use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Show, most_pixels, starting_places};
use serde::Serialize;

use super::{count, print_issues, print_json};
use crate::cli::RenderArguments;
use crate::disk::Draft;
use crate::failure::{Failure, Outcome};
use crate::progress::Bar;
use crate::stop::Stop;
use crate::{say, show_file, show_plan};
use ffmpeg::Video;
use output::Output;

/// Most pictures from which the colours of a GIF are chosen.
const PALETTE_PICTURES: usize = 40;

/// The JSON of `render`.
#[derive(Debug, Serialize)]
struct Summary {
    ok: bool,
    frames: usize,
    pixels: usize,
    issues: Vec<api::Issue>,
    out: String,
    #[serde(flatten)]
    film: Option<FilmFacts>,
}

/// Numbers of a film.
#[derive(Clone, Copy, Debug, Serialize)]
struct FilmFacts {
    pictures: usize,
    duration_s: f64,
}

pub fn run(arguments: &RenderArguments, stop: &Stop) -> Outcome {
    let output = Output::of(arguments)?;
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    let bar = Bar::new();
    bar.set(0.0, "planning");
    let (plan, document) = show_plan::plan_unless(&opened.show, &opened.issues, &|| stop.is_wanted())
        .map_err(|_| cancelled())?;
    let mut summary = Summary {
        ok: document.ok,
        frames: opened.show.frames.len(),
        pixels: most_pixels(&opened.show),
        issues: document.issues,
        out: arguments.out.display().to_string(),
        film: None,
    };
    if summary.ok {
        let work = Work { arguments, stop, bar: &bar, show: &opened.show, plan: &plan };
        summary.film = work.write(output, &mut summary.issues)?;
    }
    drop(bar);
    if arguments.json {
        print_json(&summary)?;
    } else {
        summary.print();
    }
    Ok(summary.ok)
}

fn cancelled() -> Failure {
    Failure { line: "cancelled; nothing was written".into(), code: 130 }
}

impl Summary {
    fn print(&self) {
        print_issues(&self.issues);
        if !self.ok {
            say::line("The show has errors, so that nothing was written.");
            return;
        }
        let film = self.film.map_or(String::new(), |film| {
            format!(", {} in {:.1} s", count(film.pictures, "picture"), film.duration_s)
        });
        say::line(&format!(
            "{} with {} written to {}{film}",
            count(self.frames, "frame"),
            count(self.pixels, "robot"),
            self.out
        ));
    }
}

/// Inputs of a rendering.
struct Work<'a> {
    arguments: &'a RenderArguments,
    stop: &'a Stop,
    bar: &'a Bar,
    show: &'a Show,
    plan: &'a ShowPlan,
}

impl Work<'_> {
    fn write(&self, output: Output, issues: &mut Vec<api::Issue>) -> Result<Option<FilmFacts>, Failure> {
        let (light, _) = ShowLight::new(self.show);
        let planned = PlannedShow::new(self.show, self.plan, &light);
        let view = self.arguments.view.into();
        let film = |size: FilmSize| ShowFilm::new(&planned, &self.show.stage, view, size);
        let out = &self.arguments.out;
        match output {
            Output::Sheet => {
                if self.show.frames.len() > SHEET_FRAMES_MAX {
                    let line = format!(
                        "the sheet has the first {SHEET_FRAMES_MAX} of {} frames",
                        self.show.frames.len()
                    );
                    issues.push(api::Issue::from(&Issue::warning("frames-left-out", line)));
                }
                self.bar.set(0.5, "painting");
                show_file::write(out, contact_sheet(self.show, &planned, view, self.arguments.size))?;
                Ok(None)
            }
            Output::Crew => {
                let starts = starting_places(self.show);
                let sheet = crew_sheet(self.show, &planned, &starts, &names(self.plan, &starts));
                show_file::write(out, sheet)?;
                Ok(None)
            }
            Output::Gif(size) => self.gif(film(size), size).map(Some),
            Output::Video(container, size) => {
                let music = ffmpeg::music(self.show, (&self.arguments.show, out), issues)?;
                let film = film(size);
                let video = Video {
                    container,
                    size,
                    music_begins_s: film.times().music_begins_s,
                    music: music.as_ref(),
                };
                self.video(film, &video, size).map(Some)
            }
        }
    }

    /// Renders each picture and passes it to `add`. Error if the program is to stop.
    fn pictures(
        &self,
        mut film: ShowFilm<'_>,
        size: FilmSize,
        mut add: impl FnMut(&[u8]) -> Result<(), Failure>,
    ) -> Result<FilmFacts, Failure> {
        let pictures = film.times().pictures;
        for number in 0..pictures {
            if self.stop.is_wanted() {
                return Err(cancelled());
            }
            self.bar.set(number as f64 / pictures as f64, format!("picture {number} of {pictures}"));
            add(film.picture(number))?;
        }
        Ok(FilmFacts { pictures, duration_s: api::rounded(pictures as f64 / size.fps, 3) })
    }

    fn gif(&self, mut film: ShowFilm<'_>, size: FilmSize) -> Result<FilmFacts, Failure> {
        let out = &self.arguments.out;
        self.bar.set(0.0, "choosing colours");
        let pictures = film.times().pictures;
        let every = pictures.div_ceil(PALETTE_PICTURES);
        let mut samples = Vec::new();
        for number in (0..pictures).step_by(every.max(1)) {
            if self.stop.is_wanted() {
                return Err(cancelled());
            }
            samples.push(film.picture(number).to_vec());
        }
        let palette = GifPalette::new(samples.iter().map(Vec::as_slice));
        drop(samples);
        let file = Draft::beside(out);
        let opened = File::create(file.path()).map_err(|error| Failure::unwritable(out, &error))?;
        let cannot = |error: GifError| Failure::unwritable(out, &error);
        let writer = BufWriter::new(opened);
        let mut gif = GifWriter::new(writer, (size.width, size.height), size.fps, palette).map_err(cannot)?;
        let facts = self.pictures(film, size, |picture| gif.add(picture).map_err(cannot))?;
        let written = gif.finish().map_err(cannot)?;
        written.into_inner().map_err(|error| Failure::unwritable(out, error.error()))?;
        file.finish(out).map_err(|error| Failure::unwritable(out, &error))?;
        Ok(facts)
    }

    fn video(&self, film: ShowFilm<'_>, video: &Video<'_>, size: FilmSize) -> Result<FilmFacts, Failure> {
        let out = &self.arguments.out;
        let file = Draft::beside(out);
        let duration_s = film.times().pictures as f64 / size.fps;
        let mut encoder = video.start(file.path(), duration_s)?;
        let facts = self.pictures(film, size, |picture| encoder.add(picture))?;
        self.bar.set(1.0, "finishing");
        encoder.finish()?;
        file.finish(out).map_err(|error| Failure::unwritable(out, &error))?;
        Ok(facts)
    }
}

/// Returns, for each starting place, the name of the robot that the show requires there; `None` if any robot will do.
fn names(plan: &ShowPlan, starts: &[Vec2]) -> Vec<Option<String>> {
    let mut names = vec![None; starts.len()];
    for (name, &robot) in &plan.names {
        if let Some(start) = names.get_mut(robot) {
            *start = Some(name.clone());
        }
    }
    names
}
