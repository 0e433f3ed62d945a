//! Pictures for screens: the state of run, broker and fleet. Each is made once for all screens, and only while a screen
//! is connected.

use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use lightbots_api as api;
use lightbots_api::rounded;
use lightbots_base::{RobotId, Vec2};
use lightbots_control::{
    Age, ControllerState, PreflightRobot, RepeatView, RobotView, RunView, ShowPosition, Snapshot,
};
use lightbots_wire::RobotState;
use tokio::sync::{broadcast, watch};
use tokio::time::MissedTickBehavior;

use super::Desk;
use super::message::text;
use super::preflight;
use crate::fleet_book::FleetBook;
use crate::live::conductor::{Handle, LinkPhase, LinkState, News};
use crate::played_shows::{Played, PlayedShows};

/// Time between two pictures: 20 a second. Screens interpolate between them. A shorter time needs more bandwidth; a longer
/// one makes robots on the screen lag.
const EVERY: Duration = Duration::from_millis(50);

/// The newest picture and the newest fleet table, ready to send. A slow screen skips some. Clones share them.
#[derive(Clone, Debug)]
pub struct Pictures {
    states: watch::Sender<Picture>,
    fleets: watch::Sender<Utf8Bytes>,
}

/// Two messages about one moment: robots in binary form, and the state in JSON.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// The bytes of [`api::Robots`].
    pub robots: Bytes,
    /// The JSON of [`api::ToScreen::State`].
    pub state: Utf8Bytes,
}

/// What is needed to make a picture, besides the snapshot.
struct Painter {
    desk: Desk,
    book: FleetBook,
    played: PlayedShows,
    link: LinkState,
    /// The robots of the last fleet table, in order.
    names: Vec<RobotId>,
    revision: u32,
    /// Number of pictures sent since the last fleet table.
    since_fleet: usize,
    looked: bool,
    pace: PaceMeter,
}

/// Measures the rate of the show clock, as a share of real time.
#[derive(Debug, Default)]
struct PaceMeter {
    /// Real time and show clock at the start of the measurement.
    before: Option<(std::time::Instant, lightbots_base::Instant)>,
    share: Option<f64>,
}

impl PaceMeter {
    /// Time over which the rate is measured. A shorter one shows jitter; a longer one hides pauses.
    const OVER: Duration = Duration::from_secs(2);
    /// Largest shortfall of the rate, as a share, that still counts as real time. Covers the jitter of timers.
    const LEAST: f64 = 0.03;

    /// Returns the latest measured rate of the show clock as a share of real time, 0 to 1. Returns 1 before a
    /// measurement, and for a rate less than `LEAST` below real time. `real` and `show` are the present moments of the
    /// two clocks.
    fn look(&mut self, real: std::time::Instant, show: lightbots_base::Instant) -> f64 {
        let (since, shown) = *self.before.get_or_insert((real, show));
        let passed = real - since;
        if passed >= Self::OVER {
            self.before = Some((real, show));
            // After a pause without screens the measurement means nothing, so that a new one is awaited.
            let lately = passed < Self::OVER * 2;
            self.share = lately.then(|| (show - shown).as_secs() / passed.as_secs_f64());
        }
        let share = self.share.unwrap_or(1.0);
        if share > 1.0 - Self::LEAST { 1.0 } else { rounded(share.max(0.0), 2) }
    }
}

impl Pictures {
    /// Empty pictures.
    pub fn new() -> Self {
        Self { states: watch::channel(Picture::default()).0, fleets: watch::channel(Utf8Bytes::default()).0 }
    }

    /// Returns a receiver of later pictures.
    pub fn states(&self) -> watch::Receiver<Picture> {
        self.states.subscribe()
    }

    /// Returns a receiver of fleet tables. If another screen is connected, the receiver gets the last table at once.
    pub fn fleets(&self) -> watch::Receiver<Utf8Bytes> {
        let mut fleets = self.fleets.subscribe();
        if !fleets.borrow().is_empty() {
            // With thousands of robots the next table may be seconds away.
            fleets.mark_changed();
        }
        fleets
    }

    /// Makes pictures until the conductor ends.
    pub async fn follow(self, handle: Handle, desk: Desk, book: FleetBook, played: PlayedShows) {
        let mut news = handle.news();
        let mut ticks = tokio::time::interval(EVERY);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let link = LinkState::default();
        let mut painter = Painter {
            desk,
            book,
            played,
            link,
            names: Vec::new(),
            revision: 0,
            since_fleet: 0,
            looked: false,
            pace: PaceMeter::default(),
        };
        loop {
            ticks.tick().await;
            loop {
                match news.try_recv() {
                    Ok(News::Link(link)) => painter.link = link,
                    Ok(News::Event(_) | News::Warning(_))
                    | Err(broadcast::error::TryRecvError::Lagged(_)) => {}
                    Err(broadcast::error::TryRecvError::Empty) => break,
                    Err(broadcast::error::TryRecvError::Closed) => return,
                }
            }
            if self.states.receiver_count() == 0 {
                painter.looked = false;
                // Without screens the table is not updated, so it must not be sent later.
                self.fleets.send_replace(Utf8Bytes::default());
                continue;
            }
            let Some(snapshot) = handle.look().await else { return };
            self.paint(&mut painter, &snapshot);
        }
    }

    fn paint(&self, painter: &mut Painter, snapshot: &Snapshot) {
        let same = painter.names.len() == snapshot.robots.len()
            && painter.names.iter().zip(&snapshot.robots).all(|(name, robot)| *name == robot.id);
        if !same {
            painter.names = snapshot.robots.iter().map(|robot| robot.id).collect();
            painter.revision += 1;
        }
        painter.since_fleet += 1;
        // A table is due twice a second for a few robots, and less often for thousands.
        let due = painter.since_fleet >= 10 + snapshot.robots.len() / 100;
        if !same || due || !painter.looked {
            painter.since_fleet = 0;
            painter.looked = true;
            let found = preflight::results(snapshot);
            let row = |robot| row(robot, snapshot, &painter.book, found.get(&robot.id).copied());
            let rows = snapshot.robots.iter().map(row).collect();
            let only_listed = painter.book.is_only_listed();
            let fleet = api::Fleet { revision: painter.revision, only_listed, rows };
            self.fleets.send_replace(text(&api::ToScreen::Fleet(fleet)));
        }
        let pace = painter.pace.look(std::time::Instant::now(), snapshot.at);
        let state = text(&api::ToScreen::State(painter.state(snapshot, pace)));
        self.states.send_replace(Picture { robots: robots(snapshot).to_bytes().into(), state });
    }
}

impl Painter {
    /// Whether robots of this kind (real or simulated) have never played the open show to its end. False for a show without
    /// frames, and until the hash of its drives is computed.
    fn is_first_run(&self, snapshot: &Snapshot) -> bool {
        let shown = self.desk.shown();
        let played = shown.known_drives().map(|drives| Played::of(drives, &snapshot.robots));
        !shown.show.frames.is_empty() && played.is_some_and(|played| !self.played.has(played))
    }

    fn state(&self, snapshot: &Snapshot, pace: f64) -> api::State {
        api::State {
            at_ms: snapshot.at.0 as f64 / 1e3,
            pace,
            fleet: self.revision,
            broker: api::Broker {
                address: self.link.address.clone(),
                phase: broker_phase(self.link.phase),
                connected: self.link.is_connected(),
                node: self.link.node.clone(),
                reason: self.link.reason.clone(),
            },
            playback: self.playback(snapshot),
            show_time: snapshot.run.as_ref().and_then(|run| run.position).map(show_time),
        }
    }

    fn playback(&self, snapshot: &Snapshot) -> api::Playback {
        let run = snapshot.run.as_ref();
        let of_show = run.filter(|run| !run.home && run.preflight.is_none());
        let is_showing = run.is_some_and(|run| run.doing == "showing" || run.wait.cue.is_some());
        let progress = run.map_or(0.0, |run| if is_showing { 1.0 } else { run.progress.share });
        api::Playback {
            phase: phase(snapshot.state),
            doing: run.map(|run| run.doing.to_owned()),
            frame: of_show.map(|run| run.frame),
            next: of_show.and_then(|run| run.next),
            live_light: run.map(|run| run.live_light.clone()).unwrap_or_default(),
            may_jump: run.is_some_and(|run| run.may_jump),
            frames: self.desk.shown().show.frames.len(),
            progress: rounded(progress, 3),
            left_s: self.left_s(snapshot, is_showing),
            failure: snapshot.failure.clone(),
            stopped_in: snapshot.stopped_in,
            preflight: preflight::state(snapshot),
            cue: run.and_then(|run| run.wait.cue.clone()),
            repeats: run.and_then(|run| run.repeats).map(repeats),
            may_go_on: run.is_some_and(|run| run.wait.may_go_on),
            speed_percent: snapshot.speed_percent,
            first_run: self.is_first_run(snapshot),
            looping: snapshot.looping,
            late: run.map_or(Vec::new(), |run| run.wait.robots.iter().map(ToString::to_string).collect()),
        }
    }

    /// Returns the planned time to the end of the show, seconds: the rest of the present drive or air time, and all
    /// later drives and air times. `None` without a run, for a preview, a preflight, or a loop that waits for GO. On
    /// the drive to the starting places: the rest of that drive, `None` before it begins. `is_showing`: robots show a
    /// frame and do not drive.
    fn left_s(&self, snapshot: &Snapshot, is_showing: bool) -> Option<f64> {
        let is_of_show =
            |run: &&RunView| snapshot.state != ControllerState::Preview && run.preflight.is_none();
        let run = snapshot.run.as_ref().filter(is_of_show)?;
        let share_left = 1.0 - run.progress.share.clamp(0.0, 1.0);
        if run.home {
            // Before the drive begins, its duration is not known.
            return (run.progress.drive_s > 0.0).then(|| rounded(run.progress.drive_s * share_left, 2));
        }
        let (shown, plan) = (self.desk.shown(), self.desk.plan());
        let frames = &shown.show.frames;
        let air_s = frames.get(run.frame)?.air_time_s;
        let now_s = if is_showing { air_s } else { run.progress.drive_s };
        let then_s = if is_showing { 0.0 } else { air_s };
        // A loop has no planned end, because it lasts until GO.
        if run.repeats.is_some_and(|repeats| !repeats.leaves) {
            return None;
        }
        // If the show begins again after this frame, the end of the present round counts as the end.
        let next = run.next.filter(|next| *next > run.frame).unwrap_or(frames.len());
        let rest = frames.iter().zip(&plan.transitions).skip(next);
        // The plan on the screen is that of the usual speed.
        let slower = 100.0 / f64::from(snapshot.speed_percent.max(1));
        let rest_s: f64 = rest.map(|(frame, way)| frame.air_time_s + way.duration_s * slower).sum();
        Some(rounded(now_s * share_left + then_s + rest_s, 2))
    }
}

fn show_time(ShowPosition { show_s, runs }: ShowPosition) -> api::ShowTime {
    api::ShowTime { show_s: rounded(show_s, 4), runs }
}

fn repeats(RepeatView { first, last, round, leaves }: RepeatView) -> api::Repeats {
    api::Repeats { first, last, round, leaves }
}

fn broker_phase(phase: LinkPhase) -> api::BrokerPhase {
    match phase {
        LinkPhase::Off => api::BrokerPhase::Off,
        LinkPhase::Connecting => api::BrokerPhase::Connecting,
        LinkPhase::Connected => api::BrokerPhase::Connected,
        LinkPhase::Retrying => api::BrokerPhase::Retrying,
    }
}

fn phase(state: ControllerState) -> api::Phase {
    match state {
        ControllerState::Idle => api::Phase::Idle,
        ControllerState::Ready => api::Phase::Ready,
        ControllerState::Preparing => api::Phase::Preparing,
        ControllerState::Playing => api::Phase::Playing,
        ControllerState::Paused => api::Phase::Paused,
        ControllerState::Preview => api::Phase::Preview,
        ControllerState::Aborting => api::Phase::Aborting,
        ControllerState::LinkLost => api::Phase::LinkLost,
    }
}

fn robots(snapshot: &Snapshot) -> api::Robots {
    let robots = &snapshot.robots;
    let metres = |number: Option<f64>| number.map_or(f32::NAN, |metres| rounded(metres, 4) as f32);
    let along = |place: fn(&RobotView) -> Option<Vec2>, axis: fn(Vec2) -> f64| {
        robots.iter().map(|robot| metres(place(robot).map(axis))).collect()
    };
    let (x, y) = (|at: Vec2| at.x, |at: Vec2| at.y);
    api::Robots {
        x: along(|robot| robot.reported.at, x),
        y: along(|robot| robot.reported.at, y),
        planned_x: along(|robot| robot.planned, x),
        planned_y: along(|robot| robot.planned, y),
        goal_x: along(|robot| robot.goal, x),
        goal_y: along(|robot| robot.goal, y),
        colour: robots.iter().map(|robot| robot.light.number()).collect(),
        status: robots.iter().map(|robot| status(robot) as u8).collect(),
    }
}

fn row(
    robot: &RobotView,
    snapshot: &Snapshot,
    book: &FleetBook,
    tested: Option<&PreflightRobot>,
) -> api::FleetRow {
    let firmware = robot.reported.firmware.as_str();
    api::FleetRow {
        id: robot.id.to_string(),
        status: status(robot),
        presence: match robot.contact.age {
            Age::Active => api::Presence::Active,
            Age::Stale => api::Presence::Stale,
            Age::Gone => api::Presence::Gone,
        },
        age_s: rounded((snapshot.at - robot.contact.heard).as_secs(), 1),
        battery: robot.reported.battery,
        battery_left_s: robot.battery_left.map(|left| rounded(left.as_secs(), 0)),
        pixel: robot.pixel,
        firmware: (!firmware.is_empty()).then(|| firmware.to_owned()),
        abilities: api::Abilities {
            route: robot.reported.abilities.route,
            fade: robot.reported.abilities.fade,
            blink: robot.reported.abilities.blink,
        },
        clock_us: robot.reported.clock_us,
        called: book.called(robot.id),
        admitted: robot.is_admitted,
        simulated: robot.reported.simulated,
        preflight: tested.map(preflight::result),
    }
}

fn status(robot: &RobotView) -> api::RobotStatus {
    match robot.reported.state {
        // An original robot reports no state.
        None | Some(RobotState::Idle) => api::RobotStatus::Idle,
        Some(RobotState::Ready) => api::RobotStatus::Ready,
        Some(RobotState::Driving) => api::RobotStatus::Driving,
        Some(RobotState::Held) => api::RobotStatus::Held,
        Some(RobotState::Lost) => api::RobotStatus::Lost,
        Some(RobotState::Cut) => api::RobotStatus::Cut,
        Some(RobotState::Faulty) => api::RobotStatus::Faulty,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_goes_slower_is_said_to() {
        let (began, mut meter) = (std::time::Instant::now(), PaceMeter::default());
        let mut look = |real_ms: u64, show_ms: u64| {
            let show = lightbots_base::Instant(7_000_000 + show_ms * 1000);
            meter.look(began + Duration::from_millis(real_ms), show)
        };
        assert_eq!([look(0, 0), look(1000, 400), look(2000, 800)], [1.0, 1.0, 0.4]);
        assert_eq!([look(3000, 1800), look(4000, 2790)], [0.4, 1.0]);
        assert_eq!(look(60_000, 3000), 1.0, "without screens the clock may have stood or not");
    }

    #[test]
    fn a_screen_that_joins_others_gets_their_fleet_table_at_once() {
        let pictures = Pictures::new();
        assert!(!pictures.fleets().has_changed().unwrap(), "there is no table yet");
        pictures.fleets.send_replace("a table".into());
        assert!(pictures.fleets().has_changed().unwrap());
    }
}
