//! What the conductor can be told, and what it says.

use lightbots_control::{Event, OnReturn, Operation, Refusal, Snapshot, UnfinishedRun};
use lightbots_dmx::LivePublish;
use lightbots_link::BrokerUrl;
use tokio::sync::{mpsc, oneshot};

use super::link_state::LinkState;

/// What the conductor can be told.
pub(super) enum ConductorOrder {
    Operate(Operation, oneshot::Sender<Result<(), Refusal>>),
    Look(oneshot::Sender<Snapshot>),
    TakeUp(Box<UnfinishedRun>, OnReturn),
    Connect(BrokerUrl),
    Disconnect,
    /// Messages of a lighting desk.
    Publish(Vec<LivePublish>),
    /// Copies of all reports go there, as long as there is room.
    Overhear(mpsc::Sender<Vec<u8>>),
}

/// What happens, for screens and reports.
#[derive(Clone, Debug)]
pub enum News {
    /// The controller says so.
    Event(Event),
    /// The link says why it is not connected.
    Link(LinkState),
    /// Something is wrong with the broker: one sentence for people.
    Warning(String),
}
