//! The simulated world: seeded wheels, sensors, contacts and networks, with the real robot core and the real controller
//! core in it.

mod contacts;
mod dice;
mod drive;
mod floor;
mod hash;
mod near;
mod slip;
mod track;
mod world;

pub use contacts::Contacts;
pub use dice::{Dice, Purpose};
pub use hash::StateHash;
pub use world::{Bumps, STEP, World};
