//! A planned show as Skybrush's tables.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use lightbots_base::{Span, Vec2};
use lightbots_plan::{Path, ShowPlan};
use lightbots_show::{Issue, Issues, Show};

use super::HEAD;
use crate::format::Written;
use crate::json::text::number;
use crate::limits::MAX_BYTES;
use crate::timed::export::{ExportedRobot, ExportedShow, SAMPLE, linear, sampled_note, written};
use crate::timed::fit::{FittedStretch, fitted};
use crate::zip_files::pack;

/// Time from one row to the next: ten rows a second.
const ROW: Span = Span::from_millis(100);
/// How long before a sudden change of colour a row repeats the old colour. Without that row, readers would fade.
const BEFORE_STEP: Span = Span::from_millis(1);

pub(crate) fn encode(show: &Show, plan: Option<&ShowPlan>) -> Written {
    written(show, plan, archive)
}

fn archive(exported: &ExportedShow) -> Result<(Vec<u8>, Issues), Issue> {
    let mut tables: Vec<(String, String)> = Vec::new();
    let mut length = 0;
    let mut names = BTreeSet::new();
    for robot in &exported.robots {
        let table = table(robot);
        length += table.len();
        if length > MAX_BYTES {
            let mib = MAX_BYTES >> 20;
            let what = format!("the tables have more than {mib} MiB; export a part of the show");
            return Err(Issue::error("too-big", what));
        }
        tables.push((file_name(&robot.name, &mut names), table));
    }
    let bytes = pack(tables.iter().map(|(name, table)| (name.clone(), table.as_bytes())))?;
    let note = sampled_note(
        "paths become lines of a tenth of a second, and lights linear light of eight bits; the darkest colours become black",
    );
    Ok((bytes, vec![note]))
}

/// A file name for the table of the robot `name`, with ASCII letters, digits, spaces, `-` and `_` only. Underscores are
/// added until the name, in lower case and without its ending, is new in `names`. It is then added to `names`.
fn file_name(name: &str, names: &mut BTreeSet<String>) -> String {
    let plain = |char: char| if char.is_ascii_alphanumeric() || " -_".contains(char) { char } else { '_' };
    let mut stem: String = name.chars().map(plain).collect();
    while !names.insert(stem.to_lowercase()) {
        stem.push('_');
    }
    format!("{stem}.csv")
}

fn table(robot: &ExportedRobot) -> String {
    let stretches = fitted(&linear(&robot.colours));
    let mut rows = rows(&robot.path, &stretches);
    let mut text = format!("{HEAD}\n");
    let mut place = Places::new(&robot.path);
    while let Some((at, [r, g, b])) = rows.pop_first() {
        let Vec2 { x, y } = place.at(at);
        let milliseconds = number(at.as_secs() * 1e3);
        // Writing to a text cannot fail.
        let _ = writeln!(text, "{milliseconds},{},{},0,{r},{g},{b}", number(x), number(y));
    }
    text
}

/// Times of the rows of a robot's table, from the start of the show, and the codes of its light at these times.
fn rows(path: &Path, stretches: &[FittedStretch]) -> BTreeMap<Span, [u8; 3]> {
    let duration = path.as_ref().duration();
    let moments = moments(path);
    let moment = |sample: usize| (SAMPLE * sample as i64).min(duration);
    let mut rows = BTreeMap::new();
    let (mut begin, mut now) = (Span::ZERO, stretches.first().map_or([0; 3], |stretch| stretch.to));
    rows.insert(Span::ZERO, now);
    for stretch in stretches {
        let end = moment(stretch.end);
        if !stretch.fades && stretch.to != now && begin > Span::ZERO {
            rows.insert(begin - BEFORE_STEP, now);
            rows.insert(begin, stretch.to);
        }
        let from = if stretch.fades { now } else { stretch.to };
        for &at in moments.range(begin..).filter(|at| **at > begin).take_while(|at| **at < end) {
            let share = (at - begin).as_secs() / (end - begin).as_secs();
            let mixed = |channel: usize| {
                let (from, to) = (f64::from(from[channel]), f64::from(stretch.to[channel]));
                (from + (to - from) * share).round() as u8
            };
            rows.insert(at, [mixed(0), mixed(1), mixed(2)]);
        }
        // The row of a step at this moment has the colours after it.
        rows.insert(end, stretch.to);
        (begin, now) = (end, stretch.to);
    }
    rows.insert(duration, now);
    rows
}

/// Times at which a row gives the place of the robot: every [`ROW`], and the start and end of each rest of its path.
fn moments(path: &Path) -> BTreeSet<Span> {
    let whole = path.as_ref().duration();
    let mut moments: BTreeSet<Span> = (0..whole.0 / ROW.0).map(|nth| ROW * nth).collect();
    for (from, begin, piece) in path.as_ref().timed() {
        if piece.is_rest(from) {
            moments.extend([begin, begin + piece.duration]);
        }
    }
    moments
}

/// Gives the places of a path, stage metres, at times that do not decrease from call to call.
struct Places<'a> {
    path: &'a Path,
    next: usize,
    begin: Span,
    from: Vec2,
}

impl<'a> Places<'a> {
    fn new(path: &'a Path) -> Self {
        Self { path, next: 0, begin: Span::ZERO, from: path.start }
    }

    fn at(&mut self, at: Span) -> Vec2 {
        while let Some(piece) = self.path.pieces.get(self.next) {
            if at < self.begin + piece.duration {
                return piece.at(self.from, at - self.begin).position;
            }
            (self.begin, self.from) = (self.begin + piece.duration, piece.end);
            self.next += 1;
        }
        self.from
    }
}
