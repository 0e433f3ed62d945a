//! The controller core: fleet, show clock, mapping of pixels to robots, playback, recovery.
//!
//! Sans-IO and deterministic: messages, wishes and time come in as values, messages, events and planning jobs go out.
//! It knows nothing of sockets, brokers, files or screens.
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
//! assert_eq!(robots[0].at, Some(Vec2::new(0.5, 1.3)));
//! ```

mod blocked;
mod clock;
mod config;
mod controller;
mod desk;
mod drafting;
mod driving;
mod event;
mod fleet;
mod hearing;
mod holding;
mod hopping;
mod leg;
mod lights;
mod log;
mod mapping;
mod operating;
mod operation;
mod outbox;
mod recovery;
mod recovery_bound;
mod run;
mod separation;
mod shortage;
mod silent;
mod snapshot;
mod standing;
mod starting;
mod stopping;
mod surroundings;
mod trial;
mod upload;
mod view;
mod watch;

pub use config::Config;
pub use controller::{Controller, PathsView};
pub use drafting::{Done, Job};
pub use event::{Event, EventKind, Outcome, Trouble};
pub use operation::{MissingPolicy, Operation, Refusal, State};
pub use outbox::Send;
pub use snapshot::{Age, Counters, RobotView, RunView, Snapshot};
