//! The handle through which screens and commands reach the conductor.

use std::sync::Arc;

use lightbots_control::{OnReturn, Operation, Refusal, Snapshot, UnfinishedRun};
use lightbots_dmx::LivePublish;
use lightbots_link::BrokerUrl;
use tokio::sync::{broadcast, mpsc, oneshot};

use super::clock::Clock;
use super::desk_lights::DeskLights;
use super::orders::{ConductorOrder, News};
use super::pace::Pace;
use super::run_reports::ReportsUnderWay;

/// Most reports that wait for a listener: one of each robot of a large fleet.
const REPORTS: usize = 16_384;

/// A handle to the conductor; clones share it.
#[derive(Clone, Debug)]
pub struct Handle {
    orders: mpsc::Sender<ConductorOrder>,
    news: broadcast::Sender<News>,
    clock: Clock,
    pace: Arc<Pace>,
    desk_lights: DeskLights,
    reports: ReportsUnderWay,
}

impl Handle {
    /// A handle to the conductor that reads these orders.
    pub(super) fn new(
        orders: mpsc::Sender<ConductorOrder>,
        news: broadcast::Sender<News>,
        clock: Clock,
        pace: Arc<Pace>,
        reports: ReportsUnderWay,
    ) -> Self {
        Self { orders, news, clock, pace, desk_lights: DeskLights::default(), reports }
    }

    /// The logs of runs whose reports are being made.
    pub fn reports(&self) -> &ReportsUnderWay {
        &self.reports
    }

    /// Makes the controller carry out an operation. `Err` if the controller refuses, or if the conductor has ended.
    pub async fn operate(&self, operation: Operation) -> Result<(), Refusal> {
        let (answer, answered) = oneshot::channel();
        // The answer is missing only if the conductor has ended, which has no broker any more.
        let _ = self.orders.send(ConductorOrder::Operate(operation, answer)).await;
        answered.await.unwrap_or(Err(Refusal::NotConnected))
    }

    /// Returns a snapshot of the controller, with the colours that a lighting desk gives to robots; `None` once the
    /// conductor has ended.
    pub async fn look(&self) -> Option<Snapshot> {
        let (answer, answered) = oneshot::channel();
        self.orders.send(ConductorOrder::Look(answer)).await.ok()?;
        let mut snapshot = answered.await.ok()?;
        self.desk_lights.cover(&mut snapshot);
        Some(snapshot)
    }

    /// Publishes messages of a lighting desk, if there is a broker.
    pub async fn publish(&self, messages: Vec<LivePublish>) {
        let _ = self.orders.send(ConductorOrder::Publish(messages)).await;
    }

    /// Returns a receiver of the payloads of all later reports of robots. While its queue is full, reports are left out. If
    /// this is called again, only the newest receiver gets reports.
    pub async fn overhear(&self) -> mpsc::Receiver<Vec<u8>> {
        let (reports, overheard) = mpsc::channel(REPORTS);
        let _ = self.orders.send(ConductorOrder::Overhear(reports)).await;
        overheard
    }

    /// The colours that robots show for a lighting desk.
    pub fn desk_lights(&self) -> &DeskLights {
        &self.desk_lights
    }

    /// Makes the controller take up a run that was cut off. Call this before [`connect`](Self::connect).
    pub async fn take_up(&self, run: UnfinishedRun, on_return: OnReturn) {
        let _ = self.orders.send(ConductorOrder::TakeUp(Box::new(run), on_return)).await;
    }

    /// Makes the conductor leave its broker, if it has one, and connect to this one. Does not wait for the connection.
    pub async fn connect(&self, broker: BrokerUrl) {
        let _ = self.orders.send(ConductorOrder::Connect(broker)).await;
    }

    /// Makes the conductor leave its broker.
    pub async fn disconnect(&self) {
        let _ = self.orders.send(ConductorOrder::Disconnect).await;
    }

    /// Returns the show clock.
    pub fn clock(&self) -> Clock {
        self.clock.clone()
    }

    /// Returns the state that decides whether the show clock may wait for simulated robots.
    pub fn pace(&self) -> Arc<Pace> {
        self.pace.clone()
    }

    /// Returns a receiver of later news.
    pub fn news(&self) -> broadcast::Receiver<News> {
        self.news.subscribe()
    }
}
