//! The values of one universe at one moment, as Art-Net and sACN both carry them.

use core::net::IpAddr;

/// Number of channels of a universe (ANSI E1.11, DMX512-A).
pub(crate) const CHANNELS: usize = 512;

/// Identity of a sender of values, such as a lighting desk.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum DmxSource {
    /// A sender of Art-Net, by its IP address, because the packets do not name their sender.
    ArtNet(IpAddr),
    /// A sender of sACN, by its component identifier (CID).
    Sacn([u8; 16]),
}

/// The values of one universe at one moment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DmxPacket {
    /// The sender of the packet.
    pub source: DmxSource,
    /// Priority of the source, 0 to 200, usually 100. Of all sources of a universe, only those of the highest priority
    /// count. Art-Net has no priorities; its sources get 100.
    pub priority: u8,
    /// Number of the universe: 1 to 63999 in sACN, 0 to 32767 in Art-Net.
    pub universe: u16,
    /// Number of the packet, rising modulo 256; `None`: the source does not number its packets.
    pub sequence: Option<u8>,
    /// Whether this packet ends the stream of its source, which then sends no more.
    pub ends: bool,
    /// Values of the channels from channel 1 on, at most 512. If there are fewer, the source does not send the other
    /// channels.
    pub values: Vec<u8>,
}
