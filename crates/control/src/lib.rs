//! The controller core: fleet, show clock, mapping of pixels to robots, playback, recovery.
//!
//! Sans-IO and deterministic: messages, operations and time come in as values; messages, events and plan requests go
//! out. This crate uses no sockets, broker connections, files or screens.
//!
//! Read [`Controller`] first, then [`Operation`], [`Snapshot`] and [`Event`].
//!
//! ```
//! use lightbots_base::{Instant, Vec2};
//! use lightbots_control::{Config, Controller};
//! let mut controller = Controller::new(Config::default());
//! controller.connected(Instant::ZERO);
//! controller.message(Instant(5), "T/LightBot/UUID", b"robot-1 0.5 1.3");
//! let robots = controller.snapshot(Instant(5)).robots;
//! assert_eq!(robots.len(), 1);
//! assert_eq!(robots[0].reported.at, Some(Vec2::new(0.5, 1.3)));
//! ```

mod block;
mod charge;
mod checkpoint;
mod clock;
mod computer_time;
mod config;
mod context;
mod controller;
mod event;
mod event_text;
mod fleet;
mod floor_cells;
mod frame_cursor;
mod home;
mod input_log;
mod journal;
mod leg;
mod log;
mod mapping;
mod mutant;
mod namesakes;
mod operating;
mod operation;
mod outbox;
mod own_clocks;
mod plan_builder;
mod plan_request;
mod preflight;
mod report_rate;
mod robot;
mod run;
mod separation;
mod shared_show;
mod snapshot;
mod stopping;
mod surroundings;
mod unsure_places;
mod view;

pub use computer_time::{ComputerTime, Uptime};
pub use config::{Ageing, Config, LateBounds, UploadLimits, WaitBounds};
pub use controller::Controller;
pub use event::{Event, EventKind, RunOutcome, Trouble};
pub use input_log::{
    Difference, GrowingReplay, HEAD_BYTES, LogEnd, LogError, RecordedController, ReplayObserver,
    ReplayReport, ReplayStep, check_head, replay, replay_observed,
};
pub use journal::{JournalError, JournalPiece, OUTDATED as JOURNAL_OUTDATED, OnReturn, UnfinishedRun};
pub use mutant::Mutant;
pub use operation::{ControllerState, MissingPolicy, Operation, Refusal};
pub use outbox::Send;
pub use plan_request::{PlanRequest, PlanResult};
pub use preflight::{PreflightFinding, PreflightReport, PreflightRobot};
pub use snapshot::{
    Age, Counters, LastContact, LegProgress, PreflightProgress, RepeatView, Reported, RobotView, RunView,
    RunWait, ShowPosition, Snapshot,
};
pub use view::PathsView;
