//! Light from a lighting desk: packets of Art-Net and sACN -> colours of robots -> messages of live light (R59 to R63 of
//! docs/protocol.md). No sockets, no clock: bytes and `now` are passed in. The crate knows nothing of shows.
//!
//! [`decode_artnet`] and [`decode_sacn`] read untrusted bytes. [`PatchTable`] says which channels belong to which
//! robot. [`DeskReceiver`] merges sources and writes messages.
//!
//! ```
//! use lightbots_base::RobotId;
//! use lightbots_dmx::{DmxAddress, PatchTable};
//! let patch = PatchTable::read("left-arm 3 10\nothers 1").unwrap();
//! let address = |name: &str, number: u32| patch.address(RobotId::new(name).unwrap(), number);
//! assert_eq!(address("left-arm", 0), Some(DmxAddress { universe: 3, channel: 10 }));
//! assert_eq!(address("r171", 171), Some(DmxAddress { universe: 2, channel: 4 }));
//! ```

mod artnet;
mod fixtures;
mod messages;
mod packet;
mod patch;
mod receiver;
mod sacn;
mod universe;
mod unpatched;

pub use artnet::decode_artnet;
pub use packet::{DmxPacket, DmxSource};
pub use patch::{DmxAddress, PatchError, PatchTable};
pub use receiver::{DeskNews, DeskReceiver, LivePublish, PacketCounts};
pub use sacn::decode_sacn;
