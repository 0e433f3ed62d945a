//! A planned show as timed paths and samples of light. Time counts from the start of the drive to the first frame.

use std::collections::BTreeSet;

use lightbots_base::{Piece, Rgb, Span, Vec2};
use lightbots_lighting::{PlannedShow, ShowLight};
use lightbots_plan::{Path, ShowPlan};
use lightbots_show::{Issue, Issues, Show};

use crate::format::Written;

/// Time between two samples of light: 20 ms, a tick of Skybrush's light programs.
pub(crate) const SAMPLE: Span = Span::from_millis(20);
/// Largest number of samples of all robots together: 180 MB of three bytes each, enough for 1,000 robots and 20 minutes.
const SAMPLES_MAX: usize = 60_000_000;
/// Largest distance between the places on a line and on the curve that it replaces at the same moment, metres.
const CHORD_M: f64 = 0.000_5;
/// Largest number of lines for one curve.
const CHORDS_MAX: usize = 1_000;

/// A show, converted for a file.
#[derive(Debug)]
pub(crate) struct ExportedShow {
    /// Index of the sample nearest to the moment at which the music and the air time of the first frame begin.
    pub first_sample: usize,
    /// When the air time of the first frame begins, seconds from the start of the drive to that frame.
    pub first_s: f64,
    pub robots: Vec<ExportedRobot>,
}

/// A robot, converted for a file.
#[derive(Debug)]
pub(crate) struct ExportedRobot {
    /// Unique name. Robots that no pixel asks for by name are called "Robot 1" and so on, with leading zeros. Names of
    /// real robots have no space.
    pub name: String,
    /// The robot's path with all its rests. It lasts as long as the show.
    pub path: Path,
    /// The robot's colours, one for each [`SAMPLE`] from the start. The last colour is that at the end of the show, or
    /// less than one [`SAMPLE`] after it.
    pub colours: Vec<Rgb>,
}

/// Converts a planned show. Fails if the show has no frames, or if there is no plan, or one with errors or for another
/// number of frames.
pub(crate) fn exported(show: &Show, plan: Option<&ShowPlan>) -> Result<ExportedShow, Issue> {
    let plan = plan.ok_or_else(|| {
        Issue::error("no-plan", "a file with timed paths needs the plan of the show; plan it first")
    })?;
    if !plan.ok() || plan.transitions.len() != show.frames.len() || show.frames.is_empty() {
        let first = plan.issues.iter().find(|issue| issue.is_error());
        let why = first.map_or("it has no frames", |issue| &issue.message);
        let what = format!("the show cannot be planned, and a file with timed paths needs its plan: {why}");
        return Err(Issue::error("no-plan", what));
    }
    let (light, _) = ShowLight::new(show);
    let planned = PlannedShow::new(show, plan, &light);
    let paths = paths(show, plan);
    let duration = paths.first().map_or(Span::ZERO, |path| path.as_ref().duration());
    let colours = colours(&planned, paths.len(), duration)?;
    // In the order in which effects number robots, so that robot n of a file is robot n of a layer `sequence`.
    let numbers = planned.numbers();
    let names = names(plan, numbers);
    let robots = names.into_iter().zip(paths).zip(colours);
    let robots = robots.map(|((name, path), colours)| ExportedRobot { name, path, colours });
    let mut numbered: Vec<(u32, ExportedRobot)> = numbers.iter().copied().zip(robots).collect();
    numbered.sort_by_key(|(number, _)| *number);
    let robots = numbered.into_iter().map(|(_, robot)| robot).collect();
    let first_sample = (planned.first_drive_s() / SAMPLE.as_secs()).round() as usize;
    Ok(ExportedShow { first_sample, first_s: planned.first_drive_s(), robots })
}

/// Converts a planned show and writes its file with `encode`. If the conversion or `encode` fails, the file is empty and
/// the error is its only issue.
pub(crate) fn written(
    show: &Show,
    plan: Option<&ShowPlan>,
    encode: impl FnOnce(&ExportedShow) -> Result<(Vec<u8>, Issues), Issue>,
) -> Written {
    match exported(show, plan).and_then(|exported| encode(&exported)) {
        Ok((bytes, issues)) => Written { bytes, issues },
        Err(issue) => Written { bytes: Vec::new(), issues: vec![issue] },
    }
}

/// Returns `[robot]`: the robot's path through the whole show, drives and air times.
fn paths(show: &Show, plan: &ShowPlan) -> Vec<Path> {
    let robots = plan.transitions.first().map_or(0, |transition| transition.paths.len());
    let whole = |robot: usize| {
        let mut path: Option<Path> = None;
        for (transition, frame) in plan.transitions.iter().zip(&show.frames) {
            let Some(part) = transition.paths.get(robot) else { continue };
            let whole = path.get_or_insert_with(|| Path { start: part.start, pieces: Vec::new() });
            part.pieces.iter().for_each(|piece| push(whole, *piece));
            let end = whole.as_ref().end();
            let left = transition.duration - part.as_ref().duration();
            push(whole, Piece::rest(end, left));
            push(whole, Piece::rest(end, Span::from_secs(frame.air_time_s)));
        }
        path
    };
    (0..robots).filter_map(whole).collect()
}

/// Adds a piece at the end of `path`. A rest after a rest only prolongs it. A piece without a duration is skipped.
fn push(path: &mut Path, piece: Piece) {
    if piece.duration <= Span::ZERO {
        return;
    }
    let end = path.as_ref().end();
    let stood = path.pieces.len().checked_sub(2).map_or(path.start, |before| path.pieces[before].end);
    match path.pieces.last_mut() {
        Some(last) if last.is_rest(stood) && piece.is_rest(end) => last.duration += piece.duration,
        _ => path.pieces.push(piece),
    }
}

/// Returns `[robot][sample]`: colour of the robot's light. Fails for more than [`SAMPLES_MAX`] samples.
fn colours(planned: &PlannedShow<'_>, robots: usize, duration: Span) -> Result<Vec<Vec<Rgb>>, Issue> {
    let samples = usize::try_from((duration.0 + SAMPLE.0 - 1) / SAMPLE.0).unwrap_or(0) + 1;
    if samples.saturating_mul(robots) > SAMPLES_MAX {
        let what = format!(
            "{robots} robots for {:.0} s have too many samples of light for one file; export a part of the show",
            duration.as_secs()
        );
        return Err(Issue::error("too-long", what));
    }
    let mut colours: Vec<Vec<Rgb>> = (0..robots).map(|_| Vec::with_capacity(samples)).collect();
    let (mut scenes, mut scene) = (planned.scenes(), Vec::new());
    for sample in 0..samples {
        scenes.at(sample as f64 * SAMPLE.as_secs(), &mut scene);
        for (robot, colours) in colours.iter_mut().enumerate() {
            colours.push(scene.get(robot).map_or(Rgb::BLACK, |seen| seen.colour));
        }
    }
    Ok(colours)
}

/// Returns `[robot]`: a unique name. It is the name by which pixels ask for the robot, unless an earlier robot has it
/// in upper or lower case. Otherwise it is "Robot" and the robot's number, counted from 1, with leading zeros.
fn names(plan: &ShowPlan, numbers: &[u32]) -> Vec<String> {
    let digits = numbers.len().to_string().len();
    let numbered = numbers.iter().map(|number| format!("Robot {:0digits$}", number + 1));
    let mut names: Vec<String> = numbered.collect();
    let mut taken = BTreeSet::new();
    for (name, robot) in &plan.names {
        if let Some(own) = names.get_mut(*robot)
            && taken.insert(name.to_lowercase())
        {
            own.clone_from(name);
        }
    }
    names
}

/// Converts a path into lines. Returns the end of each line: time since the start of the path, and place. At every
/// moment, a line is within [`CHORD_M`] of the path, unless a curve would need more than [`CHORDS_MAX`] lines.
pub(crate) fn lines(path: &Path) -> Vec<(Span, Vec2)> {
    let mut lines = Vec::new();
    for (from, begin, piece) in path.as_ref().timed() {
        // A line between two moments of a curve is off by at most an eighth of the largest acceleration times the
        // square of the duration.
        let seconds = piece.duration.as_secs();
        let bend = (piece.c2 - piece.c1 - (piece.c1 - from))
            .length()
            .max(((piece.end - piece.c2) - (piece.c2 - piece.c1)).length());
        let count = ((6.0 * bend / (8.0 * CHORD_M)).sqrt().ceil() as usize).clamp(1, CHORDS_MAX);
        for nth in 1..=count {
            let share = nth as f64 / count as f64;
            let since = if nth == count { piece.duration } else { Span::from_secs(seconds * share) };
            lines.push((begin + since, piece.at(from, since).position));
        }
    }
    lines
}

/// Converts sRGB colours into codes of linear light, 0 to 255.
pub(crate) fn linear(colours: &[Rgb]) -> Vec<[u8; 3]> {
    colours.iter().map(|colour| super::light::linear_codes(*colour)).collect()
}

/// The warning that a file holds samples of the show. `what` says of what, and how precisely.
pub(crate) fn sampled_note(what: &str) -> Issue {
    Issue::warning("sampled", format!("{what}; keep the show in a file of LightBots as well"))
}
