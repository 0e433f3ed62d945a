//! Where everything is, twenty times a second.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A snapshot of the run. Where the robots are is said just before, in a message of its own: `Robots`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct State {
    /// The show clock, milliseconds.
    pub at_ms: f64,
    /// How fast it goes: 1 is real time, less where this machine is too slow for its simulated robots.
    pub pace: f64,
    /// Which `Fleet` names the robots of the message before.
    pub fleet: u32,
    /// The broker.
    pub broker: Broker,
    /// The show.
    pub playback: Playback,
}

/// The connection to the broker.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct Broker {
    /// Its addresses, with commas between them, without user and password; empty: none is wanted.
    pub address: String,
    /// How far it is.
    pub phase: BrokerPhase,
    /// Whether it answers: `phase` is `connected`.
    pub connected: bool,
    /// Which of its addresses is in use; null: none.
    pub node: Option<String>,
    /// Why not, one line for people: what, where, and what to do.
    pub reason: Option<String>,
}

/// How far the connection to the broker is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum BrokerPhase {
    /// None is wanted: Connect brings it.
    #[default]
    Off,
    /// The first attempt is under way.
    Connecting,
    /// It answers.
    Connected,
    /// It does not answer, or does not any more: `reason` says why. It is tried again all the time.
    Retrying,
}

/// What is being played.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Playback {
    /// What is going on.
    pub phase: Phase,
    /// What the run is doing, for people, such as `driving`; null: there is no run.
    pub doing: Option<String>,
    /// The frame that is shown or driven to, counted from 0; null: none.
    pub frame: Option<usize>,
    /// How many frames the open show has.
    pub frames: usize,
    /// How much of the drive to `frame` is done, 0 to 1; 1 during its air time.
    pub progress: f64,
    /// Time left to the end of the show, seconds, as far as it is known.
    pub left_s: Option<f64>,
    /// Where and why the last run failed, a sentence for people; until it is dismissed or robots are started again.
    pub failure: Option<String>,
    /// Whether it begins again after the last frame.
    pub looping: bool,
    /// Names of the robots everybody is waiting for; at most twenty.
    pub late: Vec<String>,
}

/// What is going on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// No broker.
    Idle,
    /// Nothing is played.
    Ready,
    /// Robots are being sent their paths.
    Preparing,
    /// The show is on.
    Playing,
    /// It is held.
    Paused,
    /// One frame is driven to.
    Preview,
    /// Robots are coming to rest after an abort.
    Aborting,
}
