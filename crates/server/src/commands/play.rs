//! `play`: plays a show once on a live fleet, without a screen.

use std::time::{Duration, Instant};

use lightbots_control::{
    Age, Event, EventKind, MissingPolicy, Operation, Refusal, RobotView, RunView, Snapshot,
};
use lightbots_show::{Issue, Show, most_pixels};
use lightbots_wire::RobotState;
use tokio::sync::broadcast;

use super::run::GOODBYE;
use crate::cli::PlayArguments;
use crate::commands::enter_key::{EnterFor, EnterKey};
use crate::failure::{Failure, Outcome};
use crate::live::clock::Clock;
use crate::live::conductor::{self, Handle, LOOK, News};
use crate::live::recorder::RecordingTarget;
use crate::progress::Bar;
use crate::run_report::{RunReport, print};
use crate::stop::Stop;
use crate::{open_files, say, show_file};

/// Without `--wait`: if no further robot becomes ready for this time, the show starts with fewer robots than pixels. A
/// shorter time would leave out robots that start slowly.
const SETTLED: Duration = Duration::from_secs(10);
/// A run without events, warnings and changes of the link for this time is aborted, because a fault must have gone
/// unnoticed. It goes on if a frame waits for GO or frames repeat until GO. The time is longer than any usual air time.
const NOTHING: Duration = Duration::from_secs(900);

/// Without a terminal: interval at which the run is checked for a frame to which GO must be given.
const LOOK_AT_CUE: Duration = Duration::from_millis(250);

/// Longest time for disconnecting and for writing to the disk after a run that the user did not stop. After a stop,
/// [`GOODBYE`] holds.
const SAVED: Duration = Duration::from_secs(10);

pub async fn run(arguments: PlayArguments, stop: Stop) -> Outcome {
    stop.take_over();
    let broker = arguments.login.broker(&arguments.broker)?;
    let opened = show_file::open(&arguments.show, &arguments.reading)?;
    if opened.issues.iter().any(Issue::is_error) {
        let mut report = RunReport::new(&opened.show);
        report.add_issues(&opened.issues);
        print(report, arguments.json)?;
        return Ok(false);
    }
    open_files::raise_limit();
    let recording = arguments.record.clone().map_or(RecordingTarget::Off, RecordingTarget::File);
    let (until, end) = stop.child();
    let (handle, task) = Handle::start(recording, (Clock::start(), arguments.lamps.settings()), until);
    let (mut news, links) = (handle.news(), handle.news());
    handle.connect(broker).await;
    let mut report = RunReport::new(&opened.show);
    let played = tokio::select! {
        played = play(&arguments, &opened.show, &handle, &mut report, (&mut news, links)) => played,
        () = stop.wait() => Err(Failure::problem("stopped before the end of the show")),
    };
    report.add_issues(&opened.issues);
    // Ends the conductor, and not only its link: it may still have to stop the robots of a failed run.
    if !stop.is_wanted() {
        end.now();
    }
    finish(&stop, task).await;
    if stop.is_wanted() {
        // The conductor ended the run when it stopped the robots. The event of that end is still unread, behind others.
        catch_up(&mut report, &mut news);
    }
    tell(report, arguments.json, played)
}

/// Prints the report. Programs get one JSON object in every case; people get one line if nothing was played.
fn tell(mut report: RunReport, json: bool, played: Result<(), Failure>) -> Outcome {
    if let Err(failure) = &played {
        if json {
            report.add_issues(&vec![Issue::error("not-played", failure.line.clone())]);
        } else if !report.has_begun() {
            return played.map(|()| false);
        }
    }
    let ok = report.ok();
    print(report, json)?;
    played.map(|()| ok)
}

/// Waits until the conductor has disconnected from the broker and the recorded run is on disk. The wait is at most
/// [`GOODBYE`] if the user wants to stop, else `SAVED`. The conductor stops the robots of an unfinished run before it
/// disconnects.
async fn finish(stop: &Stop, task: tokio::task::JoinHandle<()>) {
    // The wait is limited, because a broker or a disk may hang.
    let patience = if stop.is_wanted() { GOODBYE } else { SAVED };
    let _ = tokio::time::timeout(patience, task).await;
}

async fn play(
    arguments: &PlayArguments,
    show: &Show,
    handle: &Handle,
    report: &mut RunReport,
    (news, links): (&mut broadcast::Receiver<News>, broadcast::Receiver<News>),
) -> Result<(), Failure> {
    let pixels = most_pixels(show);
    let refused = |refusal: Refusal| Failure::problem(refusal.to_string());
    let missing = gather(arguments, pixels, handle, links).await?;
    handle.operate(conductor::open(show.clone())).await.map_err(refused)?;
    handle.operate(Operation::Speed(arguments.speed)).await.map_err(refused)?;
    let until = Instant::now() + Duration::from_secs(arguments.patience.into());
    loop {
        match handle.operate(Operation::Play { from: 0, missing }).await {
            Ok(()) => break,
            // The start is tried again, because robots that were ready a moment ago may report again at once.
            Err(Refusal::TooFewRobots { .. } | Refusal::NotConnected) if Instant::now() < until => {
                tokio::time::sleep(LOOK).await;
            }
            Err(refusal) => return Err(refused(refusal)),
        }
    }
    follow(report, handle, news).await
}

/// Waits until enough robots are ready. Returns whether the show may start with fewer robots than pixels. Error if too few
/// robots are ready in time.
async fn gather(
    arguments: &PlayArguments,
    pixels: usize,
    handle: &Handle,
    mut news: broadcast::Receiver<News>,
) -> Result<MissingPolicy, Failure> {
    let wanted = arguments.wait.map_or(pixels, |wait| wait as usize);
    let until = Instant::now() + Duration::from_secs(arguments.patience.into());
    let (mut most, mut changed, mut reason) = (0, Instant::now(), None);
    let bar = Bar::new();
    loop {
        while let Ok(happened) = news.try_recv() {
            if let News::Link(link) = happened {
                reason = link.reason;
            }
        }
        let snapshot = handle.look().await.ok_or_else(|| Failure::problem("stopped"))?;
        let ready = snapshot.robots.iter().filter(|robot| is_ready(robot)).count();
        bar.set(ready as f64 / wanted.max(1) as f64, format!("{ready} of {wanted} robots are ready"));
        if snapshot.connected && ready >= wanted {
            return Ok(if ready < pixels { MissingPolicy::LeaveOut } else { MissingPolicy::Refuse });
        }
        if ready != most {
            (most, changed) = (ready, Instant::now());
        }
        let settled = arguments.wait.is_none() && ready > 0 && changed.elapsed() >= SETTLED;
        if settled && snapshot.connected {
            say::note(&format!("only {ready} of {pixels} robots are here: the other pixels stay dark"));
            return Ok(MissingPolicy::LeaveOut);
        }
        if Instant::now() >= until {
            return Err(reason.map_or_else(|| too_few(arguments, &snapshot, ready, wanted), Failure::problem));
        }
        tokio::time::sleep(LOOK).await;
    }
}

/// Whether a robot can take part: it reports, knows its place, and is neither lost nor faulty.
fn is_ready(robot: &RobotView) -> bool {
    let fit = !matches!(robot.reported.state, Some(RobotState::Lost | RobotState::Faulty));
    robot.contact.age == Age::Active && robot.reported.at.is_some() && fit
}

/// Returns the error for a wait that ended with too few robots.
fn too_few(arguments: &PlayArguments, snapshot: &Snapshot, ready: usize, wanted: usize) -> Failure {
    // The address was valid before. It is shown without its login.
    let broker =
        arguments.login.broker(&arguments.broker).map(|broker| broker.to_string()).unwrap_or_default();
    let patience = arguments.patience;
    if !snapshot.connected {
        return Failure::problem(format!(
            "no broker answers at {broker} within {patience} s: check the address"
        ));
    }
    let lost = snapshot.robots.iter().filter(|robot| robot.reported.at.is_none()).count();
    let unknown = if lost > 0 { format!("; {lost} more do not know their places") } else { String::new() };
    if ready == 0 {
        return Failure::problem(format!(
            "no robot is ready on {broker} after {patience} s{unknown}: switch some on"
        ));
    }
    Failure::problem(format!(
        "{ready} of {wanted} robots are ready on {broker} after {patience} s{unknown}: --wait {ready} plays with them"
    ))
}

/// Note that is printed if GO is due and there is no terminal to press Enter on.
const NO_TERMINAL: &str = "there is no terminal to press Enter on: GO is given after each air time, and frames that \
                           repeat are played once";

/// Follows the run to its end and adds its events to the report.
async fn follow(
    report: &mut RunReport,
    handle: &Handle,
    news: &mut broadcast::Receiver<News>,
) -> Result<(), Failure> {
    let (bar, mut enter) = (Bar::new(), EnterKey::default());
    let mut has_terminal = true;
    loop {
        let event = tokio::select! {
            event = next_event(report, handle, news) => event?,
            (question, is_pressed) = enter.answer() => {
                has_terminal = is_pressed;
                match question {
                    EnterFor::GoOn => go_on(handle, is_pressed).await?,
                    EnterFor::Go if is_pressed => go(handle).await,
                    EnterFor::Go => say::note(NO_TERMINAL),
                }
                if has_terminal && waits_for_go(handle).await {
                    enter.ask(EnterFor::Go);
                }
                continue;
            }
            () = air_time_over(handle), if !has_terminal => {
                go(handle).await;
                continue;
            }
        };
        match event.kind {
            EventKind::LinkBack { asks_operator: true, .. } => enter.ask(EnterFor::GoOn),
            EventKind::WaitsForGo { .. } | EventKind::LoopBegun { .. } if has_terminal => {
                enter.ask(EnterFor::Go)
            }
            _ => {}
        }
        let places = if RunReport::wants_places(&event) { handle.look().await } else { None };
        report.add(&event, places.as_ref());
        bar.set(report.share(), event.kind.to_string());
        if report.is_over() {
            return Ok(());
        }
    }
}

/// Waits for the next event and returns it. Warnings before the event go into the report. Error if the conductor has
/// ended, or after `NOTHING` without news, unless the run waits for GO.
async fn next_event(
    report: &mut RunReport,
    handle: &Handle,
    news: &mut broadcast::Receiver<News>,
) -> Result<Event, Failure> {
    loop {
        match tokio::time::timeout(NOTHING, news.recv()).await {
            Ok(Ok(News::Event(event))) => return Ok(event),
            Ok(Ok(News::Warning(line))) => report.warn(line),
            Ok(Ok(News::Link(_)) | Err(broadcast::error::RecvError::Lagged(_))) => {}
            Ok(Err(broadcast::error::RecvError::Closed)) => return Err(Failure::problem("stopped")),
            Err(_) if waits_for_go(handle).await => {}
            Err(_) => {
                return Err(Failure::problem(
                    "no event for 15 minutes: the run was given up; run again with --log debug",
                ));
            }
        }
    }
}

/// Whether a frame waits for GO, or frames repeat until GO.
async fn waits_for_go(handle: &Handle) -> bool {
    let waits = |run: RunView| run.wait.cue.is_some() || is_repeating(&run);
    handle.look().await.and_then(|snapshot| snapshot.run).is_some_and(waits)
}

/// Whether frames repeat until GO, and GO has not been given yet.
fn is_repeating(run: &RunView) -> bool {
    run.repeats.is_some_and(|repeats| !repeats.leaves)
}

/// Waits until GO is due without a terminal: a frame has stood for its air time at a cue, or frames repeat until GO.
async fn air_time_over(handle: &Handle) {
    let is_due = |run: RunView| {
        let is_cue_due = run.wait.cue.is_some() && run.progress.share >= 1.0;
        is_cue_due || run.wait.cue.is_none() && is_repeating(&run)
    };
    let is_over = |snapshot: Snapshot| snapshot.run.is_some_and(is_due);
    while !handle.look().await.is_some_and(is_over) {
        tokio::time::sleep(LOOK_AT_CUE).await;
    }
}

/// Gives GO. Prints the refusal, for example if the run has left the frame meanwhile.
async fn go(handle: &Handle) {
    if let Err(refusal) = handle.operate(Operation::Go).await {
        say::note(&refusal.to_string());
    }
}

/// Resumes the interrupted show if `goes_on`, and prints a refusal. Otherwise returns an error, because there is no terminal
/// to ask at.
async fn go_on(handle: &Handle, goes_on: bool) -> Result<(), Failure> {
    if !goes_on {
        let why = "robots were out of reach for more than 30 s, and there is no terminal to press Enter on: the show was ended";
        return Err(Failure::problem(why));
    }
    // The operation is refused if robots have fallen silent again. The question is asked again once they report.
    if let Err(refusal) = handle.operate(Operation::GoOn).await {
        say::note(&refusal.to_string());
    }
    Ok(())
}

/// Adds the unread news to the report.
fn catch_up(report: &mut RunReport, news: &mut broadcast::Receiver<News>) {
    loop {
        match news.try_recv() {
            Ok(News::Event(event)) => report.add(&event, None),
            Ok(News::Warning(line)) => report.warn(line),
            Ok(News::Link(_)) | Err(broadcast::error::TryRecvError::Lagged(_)) => {}
            Err(_) => return,
        }
    }
}
