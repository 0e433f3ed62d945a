//! The arguments for lighting and sound desks, of `run`.

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::Args;

use crate::numbers::address;

/// Address for Art-Net if the option has no value: this machine only.
const ARTNET: &str = "127.0.0.1:6454";
/// Address for sACN if the option has no value: this machine only.
const SACN: &str = "127.0.0.1:5568";

/// Address for OSC if the option has no value: this machine only. The port is not 53000, because a widespread sound program
/// uses that port itself.
const OSC: &str = "127.0.0.1:53100";

/// Lighting and sound desks, of `run`
#[derive(Clone, Debug, Args)]
pub struct DeskArguments {
    /// Receive Art-Net [without an address: from this machine, 127.0.0.1:6454]
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true, default_missing_value = ARTNET, value_parser = address)]
    pub artnet: Option<SocketAddr>,
    /// Receive sACN (E1.31), on 0.0.0.0 multicast too [without an address: from this machine, 127.0.0.1:5568]
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true, default_missing_value = SACN, value_parser = address)]
    pub sacn: Option<SocketAddr>,
    /// Table of the channels of each robot, with lines ROBOT UNIVERSE CHANNEL and `others UNIVERSE` [default: `others 1`,
    /// 170 robots on each universe]
    #[arg(long, value_name = "FILE")]
    pub patch: Option<PathBuf>,
    /// Receive OSC: /lightbots/go and /lightbots/stop [without an address: from this machine, 127.0.0.1:53100]
    #[arg(long, value_name = "HOST:PORT", num_args = 0..=1, require_equals = true, default_missing_value = OSC, value_parser = address)]
    pub osc: Option<SocketAddr>,
    /// Send OSC to this address when robots leave for a frame or reach it, a cue waits for GO, or the controller's state
    /// changes
    #[arg(long, value_name = "HOST:PORT", value_parser = address)]
    pub osc_out: Option<SocketAddr>,
    /// Play the music of the show on a sound device of this machine, at the show's position
    #[cfg(feature = "sound")]
    #[arg(long)]
    pub sound: bool,
    /// How much earlier than the show the music is played, milliseconds
    #[cfg(feature = "sound")]
    #[arg(long, value_name = "MS", allow_hyphen_values = true, default_value_t = 0.0)]
    pub sound_offset_ms: f64,
}
