//! The simulated world: seeded wheels, sensors, contacts and networks, with the real robot core and the real controller
//! core in it.

mod breakdowns;
mod conditions;
mod contacts;
mod crew;
mod dice;
mod drive;
mod faults;
mod fleet;
mod floor;
mod hash;
mod html;
mod near;
mod network;
mod play;
mod rehearsal;
mod report;
mod sensors;
mod slip;
mod statistics;
mod track;
mod watch;
mod world;

pub use conditions::{Breakdown, Conditions, FixConditions, LinkConditions};
pub use contacts::Contacts;
pub use dice::{Dice, Purpose};
pub use faults::{Faults, FaultsError};
pub use fleet::{Fleet, FleetConfig, FleetMessage};
pub use hash::StateHash;
pub use network::MessageCounts;
pub use rehearsal::{Progress, ROBOTS_MAX, RehearsalOptions, rehearse};
pub use report::{FrameRecord, RehearsalReport};
pub use statistics::Spread;
pub use world::{Bumps, STEP, World};
