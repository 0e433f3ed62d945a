//! Tests the planner's label that a robot may stop dead at a moment. Robots are killed at moments with the label and
//! without:
//! `cargo run --release -p lightbots-sim --example deaths SCENE ROBOTS [SAFE [UNSAFE [FAULTS [SEED]]]]`.
//!
//! The scenes are those of the example `crowds`. SAFE and UNSAFE are numbers of moments, drawn at random among all
//! moments of the drive. Each is a separate rehearsal. The last lines rate labels under other assumptions.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[path = "../arguments/mod.rs"]
mod arguments;
#[path = "../../../plan/examples/bench/scenes.rs"]
#[allow(dead_code)]
mod bench;
#[path = "../../../plan/examples/common/dice.rs"]
mod dice;
#[path = "../crowds/scenes.rs"]
mod scenes;

use std::process::ExitCode;

use lightbots_base::{Limits, Span};
use lightbots_plan::Path;
use lightbots_plan::proof::stop_safe::{StopAssumptions, StopSafety, stop_safety_unless};
use lightbots_show::Show;
use lightbots_sim::{Conditions, Progress, RehearsalOptions, RehearsalReport, rehearse};

/// Number of seeds of the noise. Each is rehearsed once without a death, to know the drive.
const NOISES: u64 = 10;

fn main() -> ExitCode {
    arguments::main(run)
}

/// Returns whether no safe moment led to a contact, and at least three in ten unsafe ones did.
fn run(args: &[String]) -> Result<bool, String> {
    let usage = format!("usage: deaths {} ROBOTS [SAFE [UNSAFE [FAULTS [SEED]]]]", scenes::NAMES.join("|"));
    let number = |index: usize, usual: u64| arguments::number(args, index, usual, &usage);
    let robots = number(1, 30)? as usize;
    let mut show = args.first().and_then(|name| scenes::show(name, robots)).ok_or(&usage)?;
    show.frames.truncate(2);
    let conditions = arguments::conditions(args, 4)?;
    let (safe, unsafe_) = (number(2, 100)? as usize, number(3, 40)? as usize);
    let trial = Trial::new(&show, conditions, number(5, 1)?)?;
    let deaths = trial.deaths(safe, unsafe_, number(5, 1)?);
    let count = |is_safe: bool| {
        let of = || deaths.iter().filter(move |death| death.is_safe(0) == is_safe);
        (of().count(), of().filter(|death| death.touched > 0).count())
    };
    let ((safe, safe_bad), (unsafe_, unsafe_bad)) = (count(true), count(false));
    println!(
        "{} {robots}: share {:.4}; safe {safe}, of these with contacts {safe_bad}; unsafe {unsafe_}, of these with \
         contacts {unsafe_bad}",
        args[0],
        trial.share(0),
    );
    for (index, of) in assumed().iter().enumerate() {
        let of_kind = |is_safe: bool| deaths.iter().filter(move |death| death.is_safe(index) == is_safe);
        let part = |is_safe: bool| {
            let bad = of_kind(is_safe).filter(|death| death.touched > 0).count();
            format!("{bad}/{}", of_kind(is_safe).count())
        };
        println!(
            "  reaction {:.0} ms, silence {:.1} s, alarm {:.1} s, spare {:.0} mm, wary {:.0} mm, sight {:.0} mm: share {:.4}, \
             contacts {} of safe, {} of unsafe ones",
            of.reaction_s * 1e3,
            of.silence_s,
            of.alarm_s,
            of.spare_m * 1e3,
            of.wary_m * 1e3,
            of.sight_m * 1e3,
            trial.share(index),
            part(true),
            part(false)
        );
    }
    Ok(safe_bad == 0 && unsafe_bad * 10 >= 3 * unsafe_)
}

/// Assumptions to compare, the planner's first.
fn assumed() -> Vec<StopAssumptions> {
    let usual = StopAssumptions::default();
    vec![
        usual,
        StopAssumptions { silence_s: 1.2, alarm_s: 1.2, ..usual },
        StopAssumptions { spare_m: 0.001, ..usual },
        StopAssumptions { spare_m: 0.001, wary_m: 0.003, ..usual },
        StopAssumptions { wary_m: 0.003, ..usual },
        StopAssumptions { wary_m: 0.005, ..usual },
        StopAssumptions { sight_m: 0.03, ..usual },
        StopAssumptions { reaction_s: 0.056, ..usual },
        StopAssumptions { reaction_s: 0.056, spare_m: 0.001, wary_m: 0.003, sight_m: 0.02, ..usual },
    ]
}

/// The show in which robots are killed, and its drive with each seed of the noise.
struct Trial<'a> {
    show: &'a Show,
    conditions: Conditions,
    /// The drive with each seed. Plans differ, because each begins at the places that robots report.
    drives: Vec<Drive>,
}

/// A drive as it was planned and driven with one seed.
struct Drive {
    seed: u64,
    /// Its beginning, seconds after the first departure.
    begins_s: f64,
    duration: Span,
    /// Indices of the paths on which robots move.
    drivers: Vec<usize>,
    /// `[assumption]`: the label of all moments of the paths.
    labels: Vec<StopSafety>,
    /// `[path]`: the robot that drives it.
    robots: Vec<usize>,
}

/// Labels and contacts of one death.
struct Death {
    /// `[assumption]`: whether the moment was labelled safe.
    safe: Vec<bool>,
    /// Contacts before the first replan.
    touched: u64,
}

impl Death {
    fn is_safe(&self, assumed: usize) -> bool {
        self.safe[assumed]
    }
}

impl<'a> Trial<'a> {
    fn new(show: &'a Show, conditions: Conditions, first_seed: u64) -> Result<Self, String> {
        let mut trial = Self { show, conditions, drives: Vec::new() };
        for seed in first_seed..first_seed + NOISES {
            let mut drive = None;
            trial.rehearsed(seed, None, &mut |progress| {
                if let Progress::Departing { frame: 1, begins_s, paths } = progress {
                    drive.get_or_insert_with(|| Drive::new(seed, begins_s, paths, &show.stage.limits));
                }
            });
            trial.drives.push(drive.ok_or("the scene is not played to its end")?);
        }
        Ok(trial)
    }

    fn rehearsed(
        &self,
        seed: u64,
        killed: Option<(usize, Span)>,
        progress: &mut dyn FnMut(Progress<'_>),
    ) -> RehearsalReport {
        let mut conditions = self.conditions.clone();
        conditions
            .killed
            .extend(killed.map(|(robot, at)| lightbots_sim::Breakdown { robot: Some(robot), at: Some(at) }));
        rehearse(self.show, &RehearsalOptions { seed, conditions, robots: None }, progress)
    }

    /// The mean share of stop-safe moments over all drives, under one of the assumptions.
    fn share(&self, assumed: usize) -> f64 {
        self.drives.iter().map(|drive| drive.labels[assumed].share()).sum::<f64>() / self.drives.len() as f64
    }

    /// Rehearses deaths at random moments, `safe` and `unsafe_` of each kind, or fewer if a kind is rare.
    fn deaths(&self, safe: usize, unsafe_: usize, seed: u64) -> Vec<Death> {
        let mut dice = dice::Dice::new(seed, 7);
        let (mut left, mut deaths) = ([unsafe_, safe], Vec::new());
        for _ in 0..1000 * (safe + unsafe_) {
            if left == [0, 0] {
                break;
            }
            let drive = &self.drives[(dice.share() * self.drives.len() as f64) as usize];
            let path = drive.drivers[(dice.share() * drive.drivers.len() as f64) as usize];
            let at = Span::from_secs(dice.share() * drive.duration.as_secs());
            let labels: Vec<bool> = drive.labels.iter().map(|label| label.is_safe(path, at)).collect();
            let left = &mut left[usize::from(labels[0])];
            if *left == 0 {
                continue;
            }
            *left -= 1;
            let show_at = Span::from_secs(drive.begins_s) + at;
            let robot = drive.robots[path];
            let report = self.rehearsed(drive.seed, Some((robot, show_at)), &mut |_| {});
            let touched = report.contacts - report.contacts_after_replan;
            if labels[0] && touched > 0 {
                println!(
                    "touched though safe: kill={robot}@{:.6}s seed {} ({:.2} s into the drive): {touched} contacts, labels {labels:?}",
                    show_at.as_secs(),
                    drive.seed,
                    at.as_secs()
                );
            }
            deaths.push(Death { safe: labels, touched });
        }
        deaths
    }
}

impl Drive {
    fn new(seed: u64, begins_s: f64, paths: &[(usize, &Path)], limits: &Limits) -> Self {
        let (robots, paths): (Vec<usize>, Vec<Path>) =
            paths.iter().map(|&(robot, path)| (robot, path.clone())).unzip();
        let labels =
            |of: &StopAssumptions| stop_safety_unless(&paths, limits, of, &|| false).unwrap_or_default();
        Self {
            seed,
            begins_s,
            duration: paths.iter().map(|path| path.as_ref().duration()).max().unwrap_or(Span::ZERO),
            drivers: (0..paths.len()).filter(|&path| !paths[path].as_ref().rests()).collect(),
            labels: assumed().iter().map(labels).collect(),
            robots,
        }
    }
}
