//! A snapshot of connection and run, sent 20 times a second.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A snapshot of the run. The binary message `Robots`, sent just before, has the places of the robots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct State {
    /// The show clock, milliseconds.
    pub at_ms: f64,
    /// Rate of the show clock: 1 is real time. Less than 1 if the machine is too slow for its simulated robots.
    pub pace: f64,
    /// `Fleet.revision` of the fleet table that names the robots of the preceding binary message.
    pub fleet: u32,
    /// The broker.
    pub broker: Broker,
    /// The run and its progress.
    pub playback: Playback,
    /// Position of the show on its timeline at `at_ms`; null: no show is played, or its first drive has not begun.
    pub show_time: Option<ShowTime>,
}

/// Position of the show on its timeline. In a show with music, this is the position of the music.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct ShowTime {
    /// Seconds from the start of the first frame's air time; negative during the drive to the first frame.
    pub show_s: f64,
    /// Whether the position advances with the show clock. With music, the position stands still during a pause and while
    /// the show waits for GO. Without music, it also stands still while robots are held or waited for.
    pub runs: bool,
}

/// The connection to the broker.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Broker {
    /// Addresses of the broker without user and password, separated by commas; empty: no broker is wanted.
    pub address: String,
    /// Phase of the connection.
    pub phase: BrokerPhase,
    /// Whether the broker answers: `phase` is `connected`.
    pub connected: bool,
    /// The address in use; null: none.
    pub node: Option<String>,
    /// Why the broker does not answer: one line for people with cause, place and remedy; null unless `phase` is
    /// `retrying`.
    pub reason: Option<String>,
}

/// Phase of the connection to the broker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum BrokerPhase {
    /// No connection is wanted.
    #[default]
    Off,
    /// The first attempt is under way.
    Connecting,
    /// The broker answers.
    Connected,
    /// The broker does not answer; `reason` says why. The server keeps trying.
    Retrying,
}

/// The run: what is played, and how far it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Playback {
    /// Phase of the run.
    pub phase: Phase,
    /// What the run does, for people, such as `driving`; null: there is no run.
    pub doing: Option<String>,
    /// Index of the frame that robots show or drive to, counted from 0. null: there is no run, or it is a preflight or
    /// a drive to the starting places.
    pub frame: Option<usize>,
    /// Index of the frame after `frame`, counted from 0; null: `frame` is null, or the run ends after `frame`.
    pub next: Option<usize>,
    /// Whether `GoTo` and `Skip` are possible: a show is played, and robots stand or are held.
    pub may_jump: bool,
    /// Number of frames of the open show.
    pub frames: usize,
    /// Progress of the drive under way, 0 to 1; 1 during the air time and while the show waits for `go`, 0 without a
    /// run.
    pub progress: f64,
    /// Planned time to the end of the show, or of its present pass if it begins again, seconds. On the drive
    /// to the starting places: to the end of that drive. null: robots do neither, or frames repeat until `go`.
    pub left_s: Option<f64>,
    /// Why and where the last run failed, a sentence for people; null: no failure since the last run began, or
    /// dismissed.
    pub failure: Option<String>,
    /// Index of the frame in which the last run of a show ended early, counted from 0. null: the run reached its end,
    /// another run began, another show was opened, or `dismiss_failure` cleared the index.
    pub stopped_in: Option<usize>,
    /// The preflight that is under way, or the last one since the server's start; null: there was none.
    pub preflight: Option<PreflightState>,
    /// Name of the cue at which the show waits for `go`; may be empty. Null: the show does not wait for `go`.
    pub cue: Option<String>,
    /// Names of the layers of live light that are on, lowest first.
    pub live_light: Vec<String>,
    /// The frames that repeat until `go`; null: no frames repeat at the moment.
    pub repeats: Option<Repeats>,
    /// Whether `go_on` can continue a show whose robots were out of reach, because some of its robots report again.
    pub may_go_on: bool,
    /// Speed of drives of a show, of one frame and to the starting places, percent of the usual speed.
    pub speed_percent: u32,
    /// Whether robots of this kind (real or simulated) have never played the open show to its end. The screen then
    /// offers a slow first run. `false` for a show without frames, and until the server knows the drives of the show.
    pub first_run: bool,
    /// Whether the show begins again after the last frame.
    pub looping: bool,
    /// Names of the robots that the fleet waits for: late on a drive, or not ready for one; at most 20.
    pub late: Vec<String>,
}

/// The preflight that is under way, or the last one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct PreflightState {
    /// What robots do, for people, such as `driving out`; null: the preflight is over.
    pub doing: Option<String>,
    /// The round under way, counted from 1; 0: the preflight is over. Robots that would be in each other's way are
    /// tested in different rounds.
    pub round: usize,
    /// Number of rounds; 0: the preflight is over.
    pub rounds: usize,
    /// Whether the preflight was carried out to its end.
    pub finished: bool,
    /// Number of robots that passed; 0 while the preflight is under way.
    pub passed: usize,
    /// Number of robots with faults; 0 while the preflight is under way.
    pub named: usize,
}

/// Frames that repeat until `go`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Repeats {
    /// Index of the first repeated frame, counted from 0.
    pub first: usize,
    /// Index of the last repeated frame, counted from 0.
    pub last: usize,
    /// Number of the present round, counted from 1.
    pub round: u32,
    /// Whether GO was given. The show then goes on with the frame after `last`.
    pub leaves: bool,
}

/// Phase of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// The server has no broker.
    Idle,
    /// There is no run.
    Ready,
    /// A run is planned, and robots receive their paths.
    Preparing,
    /// The show plays.
    Playing,
    /// The operator has paused the run.
    Paused,
    /// Robots drive to one frame or show it, drive to their starting places, or are tested in a preflight.
    Preview,
    /// Robots are being stopped.
    Aborting,
    /// The run stands still, because its robots or the broker are or were out of reach. It goes on after `go_on`.
    LinkLost,
}
