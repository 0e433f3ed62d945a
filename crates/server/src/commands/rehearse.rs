//! `rehearse`: plays the whole show in virtual time.

use std::path::Path;

use clap::ValueEnum;
use lightbots_api::{self as api, rounded};
use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_report::{ReportedEvent, RunKind, Scrub, ShowReport, Truth, page, report_with_truth};
use lightbots_show::{Issue, slowed};
use lightbots_sim::{
    Conditions, Faults, Progress, RehearsalOptions, RehearsalReport, rehearse, rehearse_recorded,
};

use super::{count, print_issues, print_json};
use crate::cli::RehearseArguments;
use crate::failure::{Failure, Outcome};
use crate::growing_file::GrowingFile;
use crate::numbers::rounded_spread;
use crate::progress::Bar;
use crate::{say, show_file};

/// Most issues in the report of a show that was not played.
const ISSUES_MAX: usize = 200;

pub fn run(arguments: &RehearseArguments) -> Outcome {
    let faults = arguments.faults.as_deref().map(Faults::parse).transpose();
    let faults = faults.map_err(|error| Failure::input(format!("--faults: {error}")))?.unwrap_or_default();
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    let usual = if arguments.ideal { Conditions::ideal() } else { Conditions::default() };
    let options = RehearsalOptions {
        seed: arguments.seed,
        conditions: faults.added_to(usual),
        ..RehearsalOptions::default()
    };
    let show = slowed(&opened.show, arguments.speed);
    let mut log = arguments.record.as_deref().map(GrowingFile::create).transpose()?;
    let mut steps = arguments.steps.as_deref().map(steps_file).transpose()?;
    let mut told = arguments.report.as_ref().map(|_| Told::default());
    let began = std::time::Instant::now();
    let mut virtual_s = 0.0_f64;
    let mut report = {
        let bar = Bar::new();
        let mut progress = |progress: Progress<'_>| match progress {
            Progress::Planning => bar.set(0.0, "planning"),
            Progress::Departing { .. } => {}
            Progress::Logged(bytes) => {
                if let Some(log) = &mut log {
                    log.append(bytes);
                }
                if let Some(told) = &mut told {
                    told.log.extend_from_slice(bytes);
                }
            }
            Progress::Stepped { at, names, places } => {
                if let Some(steps) = &mut steps {
                    names.iter().for_each(|&(name, robot)| steps.append(&step_row(at, name, places[robot])));
                }
                if let Some(told) = &mut told {
                    names.iter().for_each(|&(name, robot)| told.truth.add(at, name, places[robot]));
                }
            }
            Progress::Playing { at_s, planned_s, frames } => {
                virtual_s = at_s;
                bar.set(at_s / planned_s.max(1.0), format!("{} played", count(frames, "frame")));
            }
        };
        if arguments.record.is_some() || arguments.report.is_some() {
            rehearse_recorded(&show, &options, notes(arguments), &mut progress)
        } else {
            rehearse(&show, &options, &mut progress)
        }
    };
    log.map_or(Ok(()), GrowingFile::finish)?;
    steps.map_or(Ok(()), GrowingFile::finish)?;
    let factor = virtual_s.max(report.duration_s) / began.elapsed().as_secs_f64().max(1e-9);
    report.real_time_factor = Some(rounded(factor, 1));
    let news = opened.issues.iter().filter(|issue| !report.issues.contains(issue));
    report.issues = news.chain(&report.issues).cloned().collect();
    if let (Some(file), Some(told)) = (&arguments.report, told) {
        let page =
            told.page(&report, title(&opened.show.name, &arguments.show), show.stage.limits.radius_m)?;
        std::fs::write(file, page).map_err(|error| Failure::unwritable(file, &error))?;
    }
    if arguments.json {
        print_json(&readable(report.clone()))?;
    } else {
        print(&report);
    }
    Ok(report.ok)
}

/// Records of a rehearsal for its report.
#[derive(Default)]
struct Told {
    /// Log of the controller's inputs; empty if nothing was played.
    log: Vec<u8>,
    truth: Truth,
}

impl Told {
    /// Returns the report as an HTML page. `radius_m` is the radius of a robot, metres.
    fn page(mut self, found: &RehearsalReport, title: String, radius_m: f64) -> Result<String, Failure> {
        if self.log.is_empty() {
            return Ok(unplayed_page(found, title));
        }
        self.truth.contacts = found.contacts;
        (self.truth.brakes, self.truth.false_brakes) = (found.brakes.all, found.brakes.unfounded);
        self.truth.messages_lost = found.messages.lost;
        self.truth.closest_m = found.closest_m.map(|centres_m| centres_m - 2.0 * radius_m);
        let made = report_with_truth(&self.log, Some(self.truth), &mut |_| {});
        let (mut report, scrub) =
            made.map_err(|error| Failure::problem(format!("the rehearsal has no report: {error}")))?;
        report.show = title;
        Ok(page(&report, &scrub))
    }
}

/// Returns the page for a show that was not played, with the reasons.
fn unplayed_page(found: &RehearsalReport, show: String) -> String {
    let incident = |issue: &Issue| ReportedEvent {
        at_s: 0.0,
        tone: if issue.is_error() { "bad" } else { "look" },
        line: issue.message.clone(),
        robot: None,
    };
    let report = ShowReport {
        show,
        kind: RunKind::Rehearsal,
        verdict: "This show must not be played like this; nothing was rehearsed.".into(),
        incidents: found.issues.iter().take(ISSUES_MAX).map(incident).collect(),
        incidents_left_out: found.issues.len().saturating_sub(ISSUES_MAX),
        is_complete: true,
        ..ShowReport::default()
    };
    page(&report, &Scrub::default())
}

fn steps_file(path: &Path) -> Result<GrowingFile<'_>, Failure> {
    let mut file = GrowingFile::create(path)?;
    file.append(b"time_s,robot,x_m,y_m\n");
    Ok(file)
}

/// Formats a row of the file for `--steps`: one robot at one moment. Names are quoted, because they may have commas.
fn step_row(at: Instant, name: RobotId, place: Vec2) -> Vec<u8> {
    let quoted = name.as_str().replace('"', "\"\"");
    format!("{:.3},\"{quoted}\",{:.5},{:.5}\n", at.as_secs(), place.x, place.y).into_bytes()
}

/// Returns notes for the log: the arguments that decide how the rehearsal goes.
fn notes(arguments: &RehearseArguments) -> Vec<(String, String)> {
    let mut notes = vec![
        ("command", "rehearse".to_owned()),
        ("show", arguments.show.display().to_string()),
        ("seed", arguments.seed.to_string()),
        ("ideal", arguments.ideal.to_string()),
        ("speed", arguments.speed.to_string()),
    ];
    notes.extend(arguments.faults.clone().map(|faults| ("faults", faults)));
    let reading = &arguments.reading;
    notes.extend(reading.floor.map(|(width, depth)| ("floor", format!("{width}x{depth}"))));
    let identity = reading.identity.and_then(|identity| identity.to_possible_value());
    notes.extend(identity.map(|identity| ("identity", identity.get_name().to_owned())));
    notes.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Returns the name of the show. A show without a name gets the name of its file, without the ending.
fn title(name: &str, file: &Path) -> String {
    let stem = file.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    if name.is_empty() { stem.unwrap_or_default() } else { name.to_owned() }
}

/// Returns the report with its spreads and most of its other times and lengths rounded, so that the JSON is readable.
fn readable(mut report: RehearsalReport) -> RehearsalReport {
    for seconds in [&mut report.duration_s, &mut report.lower_bound_s] {
        *seconds = rounded(*seconds, 3);
    }
    report.closest_m = report.closest_m.map(|metres| rounded(metres, 5));
    report.wall_pressed_m = rounded(report.wall_pressed_m, 5);
    report.arrival_spread_s = rounded_spread(report.arrival_spread_s, 3);
    // Clock errors are microseconds, so they keep more digits.
    report.clock_spread_s = rounded_spread(report.clock_spread_s, 6);
    for errors_m in [&mut report.position_error_m, &mut report.estimate_error_m, &mut report.tracking_error_m]
    {
        *errors_m = rounded_spread(*errors_m, 5);
    }
    for frame in &mut report.per_frame {
        for seconds in [&mut frame.at_s, &mut frame.drive_s, &mut frame.arrival_spread_s] {
            *seconds = rounded(*seconds, 3);
        }
        frame.position_error_m = rounded_spread(frame.position_error_m, 5);
    }
    report
}

fn print(report: &RehearsalReport) {
    print_issues(&report.issues.iter().map(api::Issue::from).collect::<Vec<_>>());
    if report.messages.sent == 0 && !report.ok {
        say::line("this show must not be played like this; nothing was rehearsed");
        return;
    }
    let closest =
        report.closest_m.map_or(String::new(), |metres| format!(", closest {:.1} mm", metres * 1e3));
    let edge = match report.wall_contacts {
        0 => String::new(),
        _ => format!(", touches of the floor's edge: {}", report.edge_touches()),
    };
    say::line(&format!(
        "{}: {} of {} by {} in {:.2} s (at least {:.2} s)",
        if report.ok { "fine" } else { "this show has problems" },
        report.frames_played,
        count(report.frames, "frame"),
        count(report.robots, "robot"),
        report.duration_s,
        report.lower_bound_s,
    ));
    say::line(&format!(
        "{}{edge}, {} ({} false){closest}; arrivals within {:.2} s, places within {:.1} mm (99 %)",
        count(report.contacts as usize, "contact"),
        count(report.brakes.all as usize, "brake"),
        report.brakes.unfounded,
        report.arrival_spread_s.p99,
        report.position_error_m.p99 * 1e3,
    ));
    say::line(&format!(
        "{} messages, {} lost; seed {}, state {}, {:.0} times real time",
        report.messages.sent,
        report.messages.lost,
        report.seed,
        report.state_hash,
        report.real_time_factor.unwrap_or_default(),
    ));
}
