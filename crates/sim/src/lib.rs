//! The simulated world: seeded wheels, sensors, contacts and networks around the real robot core and the real controller
//! core. `docs/simulator.md` describes the world and what was measured in Webots.
//!
//! The crate is deterministic: it uses no clock, IO or thread, and the same seed gives the same bits. It does not know
//! MQTT, files or screens.
//!
//! In reading order: [`rehearse`] plays a whole show in virtual time under [`Conditions`] and returns a
//! [`RehearsalReport`]. [`Faults`] are changes to the conditions, read from text. [`Fleet`] runs simulated robots in real
//! time for a caller with a clock and a network. [`World`] is the bodies on the floor.
//!
//! ```
//! use lightbots_sim::{Conditions, Faults, RehearsalOptions, rehearse};
//! let show = lightbots_exchange::read(br#"[{"name": "one", "airTime": 0.1, "pixels": [{"pixelId": 0,
//!     "color": {"R": 1, "G": 0, "B": 0}, "physicalLocation": {"X": 0, "Y": 1}}]}]"#, None).unwrap().show;
//! let conditions = Faults::parse("loss=5%").unwrap().added_to(Conditions::default());
//! let report = rehearse(&show, &RehearsalOptions { conditions, ..Default::default() }, &mut |_| {});
//! assert!(report.ok && report.contacts == 0 && report.frames_played == 1);
//! ```

mod brakes;
mod breakdowns;
mod broker_outages;
mod bumps;
mod campaign;
mod conditions;
mod contacts;
mod controller_clock;
mod controller_crashes;
mod dice;
mod disk;
mod drive_train;
mod error_statistics;
mod faults;
mod firmware;
mod fix_sensors;
mod fleet;
mod floor;
mod forgeries;
mod light_watch;
mod message_log;
mod mishap;
mod neighbour_list;
mod network;
mod operator;
mod options;
mod original;
mod play;
mod prefetch;
mod proximity;
mod record;
mod rehearsal;
mod report;
mod robot_set;
mod statistics;
mod timetable;
mod track;

mod wheel_slip;
mod world;

pub use brakes::BrakeCounts;
pub use bumps::{Bump, Bumps, EDGE_SLACK_M};
pub use campaign::{Campaign, Scene, Story, Violation};
pub use conditions::{Breakdown, Conditions, FixConditions, LinkConditions, Outage};
pub use contacts::Contacts;
pub use dice::{Dice, Purpose};
pub use faults::{Faults, FaultsError};
pub use fleet::{Fleet, FleetConfig, FleetMessage};
pub use floor::FloorObject;
pub use light_watch::{LightCounts, LightWatch};
pub use lightbots_base::StateHash;
pub use mishap::Mishap;
pub use network::MessageCounts;
pub use options::{Progress, ROBOTS_MAX, RehearsalOptions};
pub use rehearsal::{rehearse, rehearse_recorded};
pub use report::{FrameRecord, RehearsalReport, SHOWN_M};
pub use statistics::Spread;
pub use world::{STEP, World};
