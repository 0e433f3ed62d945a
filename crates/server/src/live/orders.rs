//! Orders to the conductor, and news from it.

use lightbots_control::{Event, OnReturn, Operation, Refusal, Snapshot, UnfinishedRun};
use lightbots_dmx::LivePublish;
use lightbots_link::BrokerUrl;
use tokio::sync::{mpsc, oneshot};

use super::link_state::LinkState;

/// An order to the conductor.
pub(super) enum ConductorOrder {
    Operate(Operation, oneshot::Sender<Result<(), Refusal>>),
    Look(oneshot::Sender<Snapshot>),
    TakeUp(Box<UnfinishedRun>, OnReturn),
    Connect(BrokerUrl),
    Disconnect,
    /// Publish these messages of a lighting desk.
    Publish(Vec<LivePublish>),
    /// Send copies of all later reports to this channel, while it has room.
    Overhear(mpsc::Sender<Vec<u8>>),
}

/// News from the conductor, for screens and other tasks.
#[derive(Clone, Debug)]
pub enum News {
    /// An event of the controller.
    Event(Event),
    /// The new state of the link.
    Link(LinkState),
    /// A warning: one sentence for people.
    Warning(String),
}
