//! Arguments of the program: which cases are rehearsed, and how.

use std::ops::RangeInclusive;
use std::str::FromStr;

use lightbots_sim::Conditions;

use super::arguments;
use super::case::{CASES, COUNTS, Case, Place};
use super::shapes::Shape;
use super::verdict::Required;

pub const USAGE: &str = "\
usage: formations [OPTION VALUE]…
Robots drive from the usual rows at the back edge to one formation; rehearsed without and with noise and slip.
  --cases A..B        cases with these numbers, both included; also one number
  --shape NAME        grid, hexagon, disc, ring or rows
  --count N           30, 100, 200 or 400 robots
  --spacing A..B      metres, both included; also one number
  --place WHERE       near (in front of the starting rows) or far (in the middle of the floor)
  --every N           every Nth of all cases
  --offset K          beginning with case K
  --only CONDITIONS   ideal or standard
  --faults FAULTS     on top of the standard conditions, such as loss=5%
  --seed S            1 unless told otherwise
  --jobs N            as many at once; all cores unless told otherwise
  --show all          all cases, not only those that fail";

/// The chosen cases, and how they are rehearsed.
pub struct Slice {
    cases: RangeInclusive<usize>,
    shape: Option<Shape>,
    count: Option<usize>,
    spacing_m: RangeInclusive<f64>,
    place: Option<Place>,
    every: usize,
    offset: usize,
    /// The rehearsals of each case.
    pub runs: Vec<Run>,
    pub seed: u64,
    pub jobs: usize,
    /// Whether every case is printed, not only those that fail.
    pub shows_all: bool,
}

/// A kind of rehearsal: its name, its conditions and what it must achieve.
pub struct Run {
    pub name: &'static str,
    pub conditions: Conditions,
    pub required: Required,
}

impl Default for Slice {
    fn default() -> Self {
        let run = |name, conditions, required| Run { name, conditions, required };
        Self {
            cases: 0..=CASES - 1,
            shape: None,
            count: None,
            spacing_m: 0.0..=1.0,
            place: None,
            every: 1,
            offset: 0,
            runs: vec![
                run("ideal", Conditions::ideal(), Required::Exact),
                run("standard", Conditions::default(), Required::Untouched),
            ],
            seed: 1,
            jobs: std::thread::available_parallelism().map_or(1, usize::from),
            shows_all: false,
        }
    }
}

impl Slice {
    /// Reads the arguments, which are pairs of option and value.
    pub fn read(args: &[String]) -> Result<Self, String> {
        let mut slice = Self::default();
        for option in (0..args.len()).step_by(2) {
            slice.take(args, option)?;
        }
        Ok(slice)
    }

    /// Applies the option at this index, whose value comes after it.
    fn take(&mut self, args: &[String], option: usize) -> Result<(), String> {
        let (name, at) = (args[option].as_str(), option + 1);
        let value = args.get(at).ok_or_else(|| format!("{name} needs a value\n{USAGE}"))?.as_str();
        let number = || arguments::number(args, at, 0, USAGE);
        let wrong = || format!("{name} cannot be '{value}'\n{USAGE}");
        match name {
            "--cases" => self.cases = range(value).ok_or_else(wrong)?,
            "--shape" => {
                self.shape = Some(Shape::ALL.into_iter().find(|s| s.name() == value).ok_or_else(wrong)?);
            }
            "--count" => {
                self.count = Some(COUNTS.into_iter().find(|c| c.to_string() == value).ok_or_else(wrong)?);
            }
            "--spacing" => self.spacing_m = range(value).ok_or_else(wrong)?,
            "--place" => {
                let places = [("near", Place::Near), ("far", Place::Far)];
                self.place = Some(places.into_iter().find(|p| p.0 == value).ok_or_else(wrong)?.1);
            }
            "--every" => self.every = (number()? as usize).max(1),
            "--offset" => self.offset = number()? as usize,
            "--only" => {
                self.runs.retain(|run| run.name == value);
                (self.runs.len() == 1).then_some(()).ok_or_else(wrong)?;
            }
            "--faults" => {
                let conditions = arguments::conditions(args, at)?;
                self.runs.iter_mut().filter(|run| run.name == "standard").for_each(|run| {
                    run.conditions = conditions.clone();
                });
            }
            "--seed" => self.seed = number()?,
            "--jobs" => self.jobs = (number()? as usize).max(1),
            "--show" => self.shows_all = (value == "all").then_some(true).ok_or_else(wrong)?,
            _ => return Err(format!("there is no option '{name}'\n{USAGE}")),
        }
        Ok(())
    }

    /// The chosen cases, in order.
    pub fn cases(&self) -> Vec<Case> {
        (0..CASES).filter(|index| self.cases.contains(index)).map(Case::new).filter(|c| self.has(c)).collect()
    }

    fn has(&self, case: &Case) -> bool {
        // The margin is less than the tenth of a millimetre between spacings.
        let (least_m, most_m) = (self.spacing_m.start() - 1e-6, self.spacing_m.end() + 1e-6);
        case.index >= self.offset
            && (case.index - self.offset).is_multiple_of(self.every)
            && self.shape.is_none_or(|shape| shape == case.shape)
            && self.count.is_none_or(|count| count == case.count)
            && (least_m..=most_m).contains(&case.spacing_m)
            && self.place.is_none_or(|place| place == case.place)
    }
}

/// Reads `A..B`, both included, or one number.
fn range<T: FromStr + Copy>(text: &str) -> Option<RangeInclusive<T>> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    Some(first.parse().ok()?..=last.parse().ok()?)
}
