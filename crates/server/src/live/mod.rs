//! Tasks and files of a live fleet: the embedded broker, the controller, simulated robots, desks, sound, and records of
//! runs.

pub mod broker;
pub mod cast;
pub mod clock;
pub mod conductor;
pub mod crowd;
mod cue_topic;
pub mod cut_off;
pub mod desk_light;
mod desk_lights;
mod desk_socket;
mod desk_sockets;
mod handle;
mod journal;
mod link_state;
#[cfg(feature = "sound")]
pub mod loudspeaker;
mod orders;
pub mod osc;
mod pace;
pub mod recorder;
mod rivals;
pub mod run_facts;
pub mod run_files;
pub mod run_reports;

use lightbots_link::{BrokerUrl, LinkConfig, controller_client_id};

/// Returns the settings of a controller's link to a broker, with subscriptions to the topics on which robots report.
pub fn controller_link(broker: BrokerUrl) -> LinkConfig {
    let filters = ["UUID", "Arrival", "Status", "Time"].map(|name| format!("T/LightBot/{name}"));
    LinkConfig { broker, client_id: controller_client_id(), filters: filters.into(), queue: 65_536 }
}
