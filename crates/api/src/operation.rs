//! Operations over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `POST /api/operate` | [`Operation`], without the number of a request | 204: the operation was begun; 403 if the
//! role does not allow this operation; 409 and [`RefusedOperation`] if it cannot be carried out now |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A message from a screen on the WebSocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum FromScreen {
    /// Carry out an operation.
    Operate(Request),
    /// Acknowledges the oldest unacknowledged `state`: the screen has drawn it.
    Took,
}

/// A numbered request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Request {
    /// Number of the request, chosen by the screen. The answer repeats it.
    pub id: u32,
    /// The operation.
    pub operation: Operation,
}

/// An operation on show, fleet or broker. Frames are counted from 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Operation {
    /// Play the open show.
    Play {
        /// The first frame that is shown.
        from: usize,
        /// What happens if robots are missing.
        missing: Missing,
    },
    /// Drive to one frame and stay there.
    Preview {
        /// The frame.
        frame: usize,
        /// What happens if robots are missing.
        #[serde(default)]
        #[ts(as = "Option<Missing>", optional)]
        missing: Missing,
    },
    /// Hold all robots at their places on their paths.
    Pause,
    /// Continue after a pause.
    Resume,
    /// Leave a pause: show the next frame, then pause again.
    Step,
    /// GO: go on from the frame that waits for GO. If frames repeat until GO, go on at the end of the present round.
    Go,
    /// Drive to the given frame instead of the next frame, and play on from there. Only while `Playback.may_jump`.
    GoTo {
        /// The frame.
        frame: usize,
    },
    /// Leave out the frame that comes next; no robot moves. Only while `Playback.may_jump`.
    Skip,
    /// Put a layer of light over the show that plays. It stays until a `live_light` without a layer takes it off, or
    /// until the show ends. Robots follow within 0.3 s.
    LiveLight {
        /// Name of the layer. A layer that already has this name is replaced.
        name: String,
        /// The layer, as in a show file (docs/light.md); the layer's span of time is ignored. Null: take the layer off.
        #[ts(type = "Record<string, unknown> | null")]
        layer: Option<serde_json::Value>,
    },
    /// Set whether the show begins again after the last frame.
    Loop {
        /// Whether the show begins again.
        on: bool,
    },
    /// Set the speed of drives of all later runs but preflights. Refused during a run and while robots are being
    /// stopped.
    Speed {
        /// Percent of the usual speed.
        percent: u32,
    },
    /// Drive all robots that can take part to their starting places.
    Home,
    /// Test all robots that can take part: each robot drives 50 mm out and back, is stopped on the way, and blinks.
    /// Refused during a run, and until `dismiss_failure` after a failed or stopped run. `Playback.preflight` has the
    /// progress, `FleetRow.preflight` the result for each robot.
    Preflight,
    /// End the run. Robots stop at their places.
    Abort,
    /// Stop every robot, in any phase. Robots on a drive first come to rest together, within 0.5 s on a fast link. A
    /// second `stop_all` in that time stops all wheels at once.
    StopAll,
    /// Continue a show whose robots were out of reach, without the robots that do not report. If the playlist is held,
    /// let it continue.
    GoOn,
    /// Clear `Playback.failure` and `Playback.stopped_in` on every screen, because the operator has read it.
    DismissFailure,
    /// Note on every screen that the operator has read an incident.
    ReadIncident {
        /// Number of the incident.
        incident: u32,
    },
    /// Ask all robots for a report.
    Refresh,
    /// Make a robot blink for five seconds. A robot that cannot blink is asked for a report.
    Identify {
        /// Name of the robot.
        robot: String,
    },
    /// Remove a robot from the fleet, with its pinned pixels, until it reports again. Refused during a run, and
    /// while robots are being stopped.
    Forget {
        /// Name of the robot.
        robot: String,
    },
    /// Give a robot a name for people, kept for later starts of the server. Refused if another robot has that name.
    Call {
        /// Name of the robot in messages.
        robot: String,
        /// The name, at most 40 characters; empty: take the name away.
        called: String,
    },
    /// Set whether only listed robots take part in runs. Switching the rule on lists all present robots.
    OnlyListed {
        /// Whether only listed robots take part.
        on: bool,
    },
    /// Put robots on the list of robots that take part in runs, or take robots off that list.
    List {
        /// Names of the robots in messages.
        robots: Vec<String>,
        /// Whether they are listed.
        listed: bool,
    },
    /// Bind all pixels with an id to one robot in all frames, or free them. This also holds for shows that are opened
    /// later.
    Pin {
        /// Id of the pixel.
        pixel: u32,
        /// Name of the only robot that may show the pixel; null: any robot may.
        robot: Option<String>,
    },
    /// Open a show of the library on every screen.
    Open {
        /// Name of the show in the library.
        name: String,
    },
    /// Connect to a broker and keep its settings for later starts of the server. Settings that cannot work are refused
    /// with the reason. `State.broker` says whether the broker answers.
    Connect {
        /// `mqtt://host:1883` or `mqtts://…`, several separated by commas; or `embedded`.
        address: String,
        /// User name; null: the user in the address, if there is one.
        #[ts(optional = nullable)]
        user: Option<String>,
        /// Password; null: the password in the address. If the address has none: the kept password, provided that
        /// address and user are the kept ones.
        #[ts(optional = nullable)]
        password: Option<String>,
        /// Certificate authority to trust: PEM text or the path of a file on the server; null: those of the system.
        #[serde(default)]
        #[ts(optional = nullable)]
        ca: Option<String>,
        /// Client certificate for a broker that asks for one: PEM text or the path of a file on the server.
        #[serde(default)]
        #[ts(optional = nullable)]
        client_cert: Option<String>,
        /// Key of the client certificate: PEM text or the path of a file on the server. null: the kept key, provided
        /// that `client_cert` is the kept certificate.
        #[serde(default)]
        #[ts(optional = nullable)]
        client_key: Option<String>,
    },
    /// Disconnect from the broker. Its settings are kept.
    Disconnect,
}

/// What happens if there are fewer ready robots than pixels, or the robot of a pinned pixel is not ready.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Missing {
    /// The operation is refused. The answer offers to play with the pixels dark.
    #[default]
    Refuse,
    /// Pixels without a robot stay dark.
    LeaveOut,
}

/// The answer to a [`Request`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Answer {
    /// Number of the request.
    pub id: u32,
    /// Whether the operation was carried out.
    pub ok: bool,
    /// Why the operation was refused: one line for people with cause and remedy; null if `ok`.
    pub error: Option<String>,
    /// Another operation that the server would carry out instead; null: none.
    pub choice: Option<Choice>,
}

/// The refusal of an operation that came over HTTP.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct RefusedOperation {
    /// Why the operation was refused: one line for people with cause and remedy.
    pub error: String,
    /// Another operation that the server would carry out instead; null: none.
    pub choice: Option<Choice>,
}

/// An operation that the server offers after a refusal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Choice {
    /// Label of a button for the operation.
    pub label: String,
    /// The operation.
    pub operation: Operation,
}
