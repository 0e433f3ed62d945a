//! The sockets of lighting desks: UDP packets of Art-Net and sACN.

use std::collections::BTreeSet;
use std::net::Ipv4Addr;
use std::time::Duration;

use lightbots_dmx::{DmxPacket, decode_artnet, decode_sacn};
use tokio::net::UdpSocket;
use tokio::time::Instant;

use super::desk_socket::{listen, receive};
use crate::cli::DeskArguments;
use crate::failure::Failure;

/// Longest packet that is read, bytes: those of Art-Net and sACN have at most 638. Of a longer packet, the rest is
/// lost.
const PACKET_MAX: usize = 1_024;
/// Time over which packets are counted.
const WINDOW: Duration = Duration::from_millis(10);
/// Most packets that are read in a `WINDOW`: one for each of the 118 universes of 20,000 robots, and a reserve. Further
/// packets wait in the operating system's queue, which drops what does not fit.
const PACKETS: u32 = 200;
/// What packets of any sender can do, for a note to people.
const LIGHTS: &str = "drive the lights of robots";
/// Pause after a failed reception, so that a broken socket does not keep a processor busy.
const AFTER_ERROR: Duration = Duration::from_millis(100);

/// The sockets of lighting desks, with a bound on the packets that are read.
#[derive(Debug)]
pub struct DeskSockets {
    artnet: Option<UdpSocket>,
    sacn: Option<UdpSocket>,
    /// sACN universes whose multicast groups this program has joined or failed to join. A failure is not tried again.
    joined: BTreeSet<u16>,
    window_ends: Instant,
    left: u32,
}

impl DeskSockets {
    /// Binds the sockets that `arguments` ask for; `None` if they ask for none. The failure is one line with a remedy.
    pub async fn bind(arguments: &DeskArguments) -> Result<Option<Self>, Failure> {
        if arguments.artnet.is_none() && arguments.sacn.is_none() {
            return Ok(None);
        }
        Ok(Some(Self {
            artnet: listen("Art-Net", "--artnet", arguments.artnet, LIGHTS).await?,
            sacn: listen("sACN", "--sacn", arguments.sacn, LIGHTS).await?,
            joined: BTreeSet::new(),
            window_ends: Instant::now(),
            left: 0,
        }))
    }

    /// Waits for the next packet with channel values, and drops other packets. Cancel-safe.
    pub async fn next(&mut self) -> DmxPacket {
        let (mut artnet_bytes, mut sacn_bytes) = ([0; PACKET_MAX], [0; PACKET_MAX]);
        loop {
            if self.left == 0 {
                tokio::time::sleep_until(self.window_ends).await;
                (self.window_ends, self.left) = (Instant::now() + WINDOW, PACKETS);
            }
            let received = tokio::select! {
                received = receive(self.artnet.as_ref(), &mut artnet_bytes) => {
                    received.map(|(length, from)| decode_artnet(from, &artnet_bytes[..length]))
                }
                received = receive(self.sacn.as_ref(), &mut sacn_bytes) => {
                    received.map(|(length, _)| decode_sacn(&sacn_bytes[..length]))
                }
            };
            self.left -= 1;
            match received {
                Ok(Some(packet)) => return packet,
                Ok(None) => {}
                Err(error) => {
                    tracing::debug!("a packet of a lighting desk was not received: {error}");
                    tokio::time::sleep(AFTER_ERROR).await;
                }
            }
        }
    }

    /// Joins the multicast groups of universes if sACN is received on all IPv4 addresses. Groups that were tried before
    /// are left out. Returns a warning for the first universe that fails.
    pub fn join(&mut self, universes: impl Iterator<Item = u16>) -> Option<String> {
        let socket = self.sacn.as_ref()?;
        let is_open = socket.local_addr().is_ok_and(|address| address.ip() == Ipv4Addr::UNSPECIFIED);
        let mut warning = None;
        for universe in universes.filter(|_| is_open) {
            if !self.joined.insert(universe) {
                continue;
            }
            // ANSI E1.31-2018, 9.3.1.
            let [high, low] = universe.to_be_bytes();
            let group = Ipv4Addr::new(239, 255, high, low);
            if let Err(error) = socket.join_multicast_v4(group, Ipv4Addr::UNSPECIFIED) {
                let remedy = "have the desk send to the address of this machine (unicast)";
                let line =
                    format!("sACN universe {universe} is not received by multicast ({error}): {remedy}");
                warning = warning.or(Some(line));
            }
        }
        warning
    }
}
