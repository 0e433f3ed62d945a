//! Simulated robots on a real broker, in real time.

use std::fmt;

use lightbots_base::{Instant, RobotId};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, crowd_client_id, robot_client_id};
use lightbots_sim::{Fleet, FleetConfig};
use tokio::sync::mpsc;

use crate::stop::Stop;

/// Robots that share a connection, unless it is stated otherwise.
pub const TOGETHER: usize = 50;
/// Messages taken in before the robots get their next step.
const BATCH: usize = 4096;

/// Something on one of the connections.
type Heard = (usize, LinkEvent);

/// A fleet with its connections.
pub struct Crowd {
    fleet: Fleet,
    began: std::time::Instant,
    robots: usize,
    /// Robots that share a connection.
    together: usize,
    senders: Vec<Sender>,
    heard: mpsc::Receiver<Heard>,
    tasks: Vec<tokio::task::JoinHandle<()>>,
}

impl Crowd {
    /// Robots that begin to connect to `broker`, `together` of them on a connection, and go on until `stop` is wanted.
    /// Their connections begin at its addresses in turn.
    pub fn start(config: &FleetConfig, broker: &BrokerUrl, together: usize, stop: &Stop) -> Self {
        let together = together.max(1);
        let fleet = Fleet::new(config);
        let ids = fleet.ids();
        let (news, heard) = mpsc::channel(65_536);
        let (mut senders, mut tasks) = (Vec::new(), Vec::new());
        for (index, group) in ids.chunks(together).enumerate() {
            let link = Link::open(link_config(index, group, broker));
            senders.push(link.sender());
            tasks.push(tokio::spawn(forward(link, index, news.clone(), stop.clone())));
        }
        Self { robots: ids.len(), together, fleet, began: std::time::Instant::now(), senders, heard, tasks }
    }

    /// The robots' names.
    pub fn ids(&self) -> Vec<RobotId> {
        self.fleet.ids()
    }

    /// Its connections.
    pub fn connections(&self) -> Connections {
        Connections(self.senders.clone())
    }

    /// Drives the robots until `stop` is wanted; then they leave the broker. What went missing meanwhile.
    pub async fn run(mut self, stop: Stop) -> Losses {
        let mut heard = Vec::new();
        let mut left_out = LeftOut::default();
        loop {
            let alarm = self.began + std::time::Duration::from_micros(self.fleet.advance_at().0);
            tokio::select! {
                () = stop.wait() => break,
                _ = self.heard.recv_many(&mut heard, BATCH) => {
                    for (group, event) in heard.drain(..) {
                        self.hear(group, event);
                    }
                }
                () = tokio::time::sleep_until(alarm.into()) => {}
            }
            let now = self.now();
            self.fleet.advance(now);
            self.speak();
            left_out.notice(self.fleet.steps_left_out());
        }
        let losses = Losses {
            steps: self.fleet.steps_left_out(),
            unsaid: self.fleet.messages_dropped(),
            dropped: self.senders.iter().map(Sender::dropped).sum(),
        };
        for task in self.tasks {
            // A connection that failed has ended as well.
            let _ = task.await;
        }
        losses
    }

    fn now(&self) -> Instant {
        Instant(self.began.elapsed().as_micros() as u64)
    }

    fn hear(&mut self, group: usize, event: LinkEvent) {
        let now = self.now();
        let first = group * self.together;
        let sharing = first..(first + self.together).min(self.robots);
        let up = match event {
            LinkEvent::Message { topic, payload } => {
                self.fleet.receive_on(now, sharing, &topic, &payload);
                return;
            }
            LinkEvent::Connected => true,
            LinkEvent::Disconnected { .. } => false,
        };
        for robot in sharing {
            self.fleet.link_of(now, robot, up);
        }
    }

    fn speak(&mut self) {
        while let Some(message) = self.fleet.next_message() {
            self.senders[message.robot / self.together].send(&message.topic.write(), message.payload);
        }
    }
}

/// What a crowd lost in all because machine or network was too slow for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Losses {
    /// Steps of 16 ms for which all robots stood.
    pub steps: u64,
    /// Messages of robots that were dropped before they reached a connection.
    pub unsaid: u64,
    /// Messages that connections dropped because a queue was full, either way.
    pub dropped: u64,
}

impl fmt::Display for Losses {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "this machine was too slow for the simulated robots: they stood for {} steps of 16 ms, and {} messages were \
             dropped",
            self.steps,
            self.unsaid + self.dropped
        )
    }
}

/// Says, but not all the time, that the machine is too slow.
#[derive(Default)]
struct LeftOut {
    steps: u64,
    said: Option<std::time::Instant>,
}

impl LeftOut {
    const EVERY: std::time::Duration = std::time::Duration::from_secs(5);

    /// `steps`: how many were left out since the start.
    fn notice(&mut self, steps: u64) {
        if steps > self.steps && self.said.is_none_or(|said| said.elapsed() >= Self::EVERY) {
            let more = steps - self.steps;
            tracing::warn!(
                "this machine is too slow for the simulated robots: they stood for {more} steps of 16 ms"
            );
            self.steps = steps;
            self.said = Some(std::time::Instant::now());
        }
    }
}

/// The connections of a crowd.
pub struct Connections(Vec<Sender>);

impl Connections {
    /// Whether all of them stand.
    pub fn all(&self) -> bool {
        self.0.iter().all(Sender::is_connected)
    }
}

/// One connection for a group of robots.
fn link_config(index: usize, group: &[RobotId], broker: &BrokerUrl) -> LinkConfig {
    let mut filters: Vec<String> = group.iter().map(|id| format!("T/LightBot/{id}")).collect();
    filters.push("T/LightBot/Broadcast".into());
    // A broker that knows robots by their client ids must not take a crowd for one of them.
    let client_id = match group {
        [id] => robot_client_id(id),
        _ => crowd_client_id(),
    };
    LinkConfig { broker: broker.clone().starting_at(index), client_id, filters, queue: 65_536 }
}

/// Hands on what happens on a link, and closes it in the end.
async fn forward(mut link: Link, index: usize, news: mpsc::Sender<Heard>, stop: Stop) {
    loop {
        let event = tokio::select! {
            () = stop.wait() => break,
            event = link.next() => event,
        };
        let Some(event) = event else { break };
        if news.send((index, event)).await.is_err() {
            break;
        }
    }
    link.close().await;
}
