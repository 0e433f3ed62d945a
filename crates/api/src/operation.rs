//! What a screen asks for, and what it is answered.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Everything a screen says on the WebSocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum FromScreen {
    /// Do something.
    Operate(Request),
    /// The oldest `state` it has got has been dealt with.
    Took,
}

/// A numbered wish.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Request {
    /// Chosen by the screen; the answer repeats it.
    pub id: u32,
    /// What to do.
    pub operation: Operation,
}

/// What can be done with show and fleet. Frames are counted from 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Operation {
    /// Play the open show.
    Play {
        /// The first frame to show.
        from: usize,
        /// What to do where robots are missing.
        missing: Missing,
    },
    /// Drive to one frame and stay there.
    Preview {
        /// Which.
        frame: usize,
        /// What to do where robots are missing.
        #[serde(default)]
        #[ts(as = "Option<Missing>", optional)]
        missing: Missing,
    },
    /// Hold everything where it is on its way.
    Pause,
    /// Go on after a pause.
    Resume,
    /// Show the next frame, then pause.
    Step,
    /// Begin again after the last frame, or not.
    Loop {
        /// Whether to.
        on: bool,
    },
    /// Stop playing; robots stop where they are.
    Abort,
    /// Every robot's wheels stop at once, whatever is going on.
    StopAll,
    /// The operator has read `Playback.failure`: it goes from every screen.
    DismissFailure,
    /// Ask all robots to introduce themselves.
    Refresh,
    /// Let a robot blink.
    Identify {
        /// Its name.
        robot: String,
    },
    /// Strike a robot from the fleet until it reports again.
    Forget {
        /// Its name.
        robot: String,
    },
    /// Bind a pixel to a robot in all frames for as long as this show is open, or free it.
    Pin {
        /// The pixel's id.
        pixel: u32,
        /// The only robot that may show it; null: any.
        robot: Option<String>,
    },
    /// Open a show of the library on every screen.
    Open {
        /// Its name there.
        name: String,
    },
    /// Use this broker from now on, and after a restart of the server: the settings are kept. Refused, with what is
    /// wrong, where they cannot be right; whether the broker then answers is said by `State.broker`.
    Connect {
        /// `mqtt://host:1883` or `mqtts://…`, several with commas between them; or `embedded`.
        address: String,
        /// User name; null: that of the address, or none.
        #[ts(optional = nullable)]
        user: Option<String>,
        /// Password; null: that of the address, else the kept one where address and user are the kept ones.
        #[ts(optional = nullable)]
        password: Option<String>,
        /// The authority to trust for `mqtts://`: PEM text, or a file on the server's machine; null: the system's.
        #[serde(default)]
        #[ts(optional = nullable)]
        ca: Option<String>,
        /// A certificate of our own for a broker that asks for one: PEM text, or a file on the server's machine.
        #[serde(default)]
        #[ts(optional = nullable)]
        client_cert: Option<String>,
        /// Its key: PEM text, or a file on the server's machine; null: the kept one where the certificate is.
        #[serde(default)]
        #[ts(optional = nullable)]
        client_key: Option<String>,
    },
    /// Leave the broker; the settings are kept for the next `Connect`.
    Disconnect,
}

/// What to do where there are fewer ready robots than pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Missing {
    /// Do not start; the answer offers to go on without.
    #[default]
    Refuse,
    /// Leave pixels dark.
    LeaveOut,
}

/// The answer to a [`Request`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Answer {
    /// The request's number.
    pub id: u32,
    /// Whether it was done.
    pub ok: bool,
    /// Why not: one line for people, with a remedy.
    pub error: Option<String>,
    /// A way to go on all the same.
    pub choice: Option<Choice>,
}

/// A way to go on after a refusal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Choice {
    /// What a button for it should say.
    pub label: String,
    /// What to ask for instead.
    pub operation: Operation,
}
