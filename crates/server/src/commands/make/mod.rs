//! `make`: makes a show's frames from words, shapes, drawings, pictures and lists.

mod films;
mod sources;
mod wanted;

use lightbots_api as api;
use lightbots_api::rounded;
use lightbots_base::Vec2;
use lightbots_draw::{DrawError, Note, Quality, READABLE, Readability, enough_robots};
use lightbots_lighting::validate;
use lightbots_make::{MadeFrame, make_frame_from, picture_floor};
use lightbots_show::{Issue, Issues, Show, most_pixels};
use serde::Serialize;

use super::{count, guard, print_issues, print_json};
use crate::cli::MakeArguments;
use crate::failure::{Failure, Outcome};
use crate::progress::Bar;
use crate::{say, show_file};
use wanted::{Wanted, stage};

/// The JSON of `make`.
#[derive(Debug, Serialize)]
struct Summary {
    ok: bool,
    frames: usize,
    pixels: usize,
    pictures: Vec<Picture>,
    issues: Vec<api::Issue>,
    out: String,
}

/// How well a frame shows its source.
#[derive(Debug, Serialize)]
struct Picture {
    name: String,
    size_m: f64,
    closest_m: Option<f64>,
    correlation: Option<f64>,
    symmetry: Option<f64>,
    /// Number of robots that would show the source readably, if the frame is hard to read. `None` if it is readable, or if
    /// no number above the requested one is known.
    enough: Option<usize>,
}

pub fn run(arguments: &MakeArguments) -> Outcome {
    let format = show_file::format_of(&arguments.out)?;
    if let Some(outcome) = guard::child_outcome(has_files(arguments)) {
        return outcome;
    }
    let watch = guard::ReadingTime::start();
    let bar = Bar::new();
    let mut wanted = sources::read(arguments, &bar)?;
    watch.decoded();
    let mut show = Show { name: title(arguments), stage: stage(arguments), ..Show::default() };
    let (mut pictures, mut issues) = (Vec::new(), Issues::new());
    let all = wanted.len();
    for (index, one) in wanted.drain(..).enumerate() {
        bar.set(index as f64 / all as f64, format!("placing {}", one.frame.name));
        let name = one.frame.name.clone();
        let placed = place(one, &mut show, arguments)
            .map_err(|error| Failure::problem(format!("{name}: {error} [{}]", error.code)))?;
        issues.extend(placed.1);
        pictures.push(placed.0);
    }
    drop(bar);
    issues.extend(validate(&show));
    let written = format.write(&show, None);
    issues.extend(written.issues);
    show_file::write(&arguments.out, written.bytes)?;
    let summary = Summary {
        ok: !issues.iter().any(Issue::is_error),
        frames: show.frames.len(),
        pixels: most_pixels(&show),
        pictures,
        issues: issues.iter().map(api::Issue::from).collect(),
        out: arguments.out.display().to_string(),
    };
    if arguments.json {
        print_json(&summary)?;
    } else {
        summary.print();
    }
    Ok(summary.ok)
}

/// Whether a source or the font may be a file.
fn has_files(arguments: &MakeArguments) -> bool {
    let is_words = |source: &String| source.starts_with("text:") || source.starts_with("shape:");
    arguments.font.is_some() || !arguments.sources.iter().all(is_words)
}

fn title(arguments: &MakeArguments) -> String {
    let name = arguments.out.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    lightbots_exchange::stem(&name).to_owned()
}

/// Adds a frame to the show. Returns its row of the summary, and its issues.
fn place(wanted: Wanted, show: &mut Show, arguments: &MakeArguments) -> Result<(Picture, Issues), DrawError> {
    let floor = picture_floor(&show.stage);
    let robots = arguments.robots as usize;
    let drawing = wanted.drawing();
    let recipe = lightbots_make::Recipe::read(&wanted.frame.sources[0])?;
    let before = wanted.start.then(|| show.frames.last()).flatten();
    let start: Vec<Vec2> = before.iter().flat_map(|frame| &frame.pixels).map(|pixel| pixel.at).collect();
    let Wanted { mut frame, material, asset, .. } = wanted;
    if let Some((hash, asset)) = asset {
        frame.sources[0].asset = Some(hash);
        show.assets.insert(hash, asset);
    }
    let made = make_frame_from(&frame, material, &floor, robots, Quality::Full, &start)?;
    let enough = made.readability.filter(|shown| shown.correlation < READABLE).and_then(|_| {
        enough_robots(drawing.as_ref()?, &recipe.place_settings(robots)).filter(|enough| *enough > robots)
    });
    let issues = issues(&made, show.frames.len(), enough);
    let picture = picture(&made, enough);
    show.frames.push(made.frame);
    Ok((picture, issues))
}

fn picture(made: &MadeFrame, enough: Option<usize>) -> Picture {
    let figure =
        |value: fn(&Readability) -> f64| made.readability.as_ref().map(|shown| rounded(value(shown), 3));
    Picture {
        name: made.frame.name.clone(),
        size_m: rounded(made.size_m, 3),
        closest_m: made.closest_m.is_finite().then(|| rounded(made.closest_m, 4)),
        correlation: figure(|shown| shown.correlation),
        symmetry: figure(|shown| shown.symmetry),
        enough,
    }
}

/// Returns the notes of a frame as issues, and one more if the frame is hard to read.
fn issues(made: &MadeFrame, index: usize, enough: Option<usize>) -> Issues {
    let label = lightbots_show::frame_label(index, &made.frame.name);
    let warning = |note: &Note| Issue::warning(note.code, format!("{label}: {}", note.message));
    let mut issues: Issues = made.notes.iter().map(warning).collect();
    if made.readability.is_some_and(|shown| shown.correlation < READABLE) {
        let remedy = enough.map_or_else(
            || "a simpler picture or more robots would be".to_owned(),
            |enough| format!("{enough} would do"),
        );
        let robots = made.frame.pixels.len();
        let what = format!("{label}: hard to read with {}; {remedy}", count(robots, "robot"));
        issues.push(Issue::warning("hard-to-read", what));
    }
    issues
}

impl Summary {
    fn print(&self) {
        say::line(&format!(
            "{}: {} of {}",
            self.out,
            count(self.frames, "frame"),
            count(self.pixels, "pixel")
        ));
        for picture in &self.pictures {
            let reads =
                picture.correlation.map_or(String::new(), |value| format!(", readability {value:.2}"));
            say::line(&format!("  {}: {:.2} m wide{reads}", picture.name, picture.size_m));
        }
        print_issues(&self.issues);
    }
}
