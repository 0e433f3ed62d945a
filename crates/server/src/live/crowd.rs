//! Simulated robots on a real broker, in real time.

use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use lightbots_base::{Instant, RobotId, Span};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, crowd_client_id, robot_client_id};
use lightbots_sim::{Fleet, FleetConfig};
use lightbots_wire::Topic;
use tokio::sync::mpsc;

use super::clock::Clock;
use super::pace::Pace;
use crate::stop::Stop;

/// Robots that share a connection, unless it is stated otherwise.
pub const TOGETHER: usize = 50;
/// Messages taken in before the robots get their next step.
const BATCH: usize = 4096;
/// A step of the robots.
const STEP: Span = Span::from_millis(16);
/// Time waits, where it may, for robots that are `BEHIND` steps behind.
const BEHIND: i64 = 2;
/// Whether messages that hold time up have come through is looked at this often, …
const LOOK_AGAIN: Duration = Duration::from_millis(2);
/// … and if none of them comes for `LOST`, they are lost.
const LOST: Duration = Duration::from_millis(1_000);

/// Something on one of the connections.
type Heard = (usize, LinkEvent);

/// A fleet with its connections.
pub struct Crowd {
    fleet: Fleet,
    clock: Clock,
    pace: Arc<Pace>,
    /// When it began, show clock.
    began: Instant,
    /// Since when time waits for messages, and how many had come in.
    clogged: Option<(std::time::Instant, u64)>,
    robots: usize,
    /// Robots that share a connection.
    together: usize,
    senders: Vec<Sender>,
    heard: mpsc::Receiver<Heard>,
    tasks: Vec<tokio::task::JoinHandle<()>>,
}

impl Crowd {
    /// Robots that begin to connect to `broker`, `together` of them on a connection, and go on until `stop` is wanted.
    /// Their connections begin at its addresses in turn. They live by `clock`, and as `pace` lets them.
    pub fn start(
        config: &FleetConfig,
        broker: &BrokerUrl,
        together: usize,
        (clock, pace): (Clock, Arc<Pace>),
        stop: &Stop,
    ) -> Self {
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
        let began = clock.now();
        Self { robots: ids.len(), together, fleet, clock, pace, began, clogged: None, senders, heard, tasks }
    }

    /// The robots' names.
    pub fn ids(&self) -> Vec<RobotId> {
        self.fleet.ids()
    }

    /// Its connections.
    pub fn connections(&self) -> FleetConnections {
        FleetConnections(self.senders.clone())
    }

    /// Drives the robots until `stop` is wanted; then they leave the broker. What went missing meanwhile.
    pub async fn run(mut self, stop: Stop) -> Losses {
        let mut heard = Vec::new();
        let mut left_out = LeftOut::new(self.clock.withheld());
        loop {
            let alarm = match self.clogged {
                Some(_) => tokio::time::Instant::now() + LOOK_AGAIN,
                None => self.clock.deadline(self.began + Span(self.fleet.advance_at().0 as i64)),
            };
            tokio::select! {
                () = stop.wait() => break,
                _ = self.heard.recv_many(&mut heard, BATCH) => {
                    for (group, event) in heard.drain(..) {
                        self.hear(group, event);
                    }
                }
                () = tokio::time::sleep_until(alarm) => {}
            }
            self.advance();
            self.speak();
            left_out.notice(self.fleet.steps_left_out(), self.clock.withheld());
        }
        self.clock.grant(Instant::FAR);
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
        Instant((self.clock.now() - self.began).0.max(0) as u64)
    }

    /// Drives the robots until now. Where time may wait for them it does, and none of their steps is left out.
    fn advance(&mut self) {
        if !self.pace.may_slow() {
            self.clogged = None;
            self.clock.grant(Instant::FAR);
            self.fleet.advance(self.now());
            return;
        }
        if self.is_clogged() {
            return;
        }
        let behind = self.now().min(self.fleet.advance_at() + STEP * BEHIND);
        self.fleet.advance(behind);
        let until = self.fleet.advance_at() + STEP * BEHIND;
        self.clock.grant(self.began + Span(until.0 as i64));
    }

    /// Whether time waits for messages under way. Those that do not come are given up.
    fn is_clogged(&mut self) -> bool {
        if !self.pace.is_clogged() {
            self.clogged = None;
            return false;
        }
        let (reports, commands) = (&self.pace.reports, &self.pace.commands);
        let heard = reports.heard() + commands.heard();
        match self.clogged {
            Some((since, before)) if before == heard => {
                if since.elapsed() >= LOST {
                    reports.forget();
                    commands.forget();
                }
            }
            _ => self.clogged = Some((std::time::Instant::now(), heard)),
        }
        true
    }

    fn hear(&mut self, group: usize, event: LinkEvent) {
        let now = self.now();
        let first = group * self.together;
        let sharing = first..(first + self.together).min(self.robots);
        let up = match event {
            LinkEvent::Message { topic, payload, .. } => {
                if matches!(Topic::parse(&topic), Some(Topic::Robot(_))) {
                    self.pace.commands.hear(1);
                }
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
        let mut said = 0;
        while let Some(message) = self.fleet.next_message() {
            let sender = &self.senders[message.robot / self.together];
            said += u64::from(sender.send(&message.topic.write(), message.payload));
        }
        self.pace.reports.say(said);
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
struct LeftOut {
    steps: u64,
    withheld: Duration,
    said: std::time::Instant,
}

impl LeftOut {
    const EVERY: Duration = Duration::from_secs(5);
    /// Time that goes slower by less than this share is not worth a word.
    const WORTH: f64 = 0.1;

    fn new(withheld: Duration) -> Self {
        Self { steps: 0, withheld, said: std::time::Instant::now() }
    }

    /// `steps`: how many were left out since the start; `withheld`: for how long time has waited.
    fn notice(&mut self, steps: u64, withheld: Duration) {
        let since = self.said.elapsed();
        if since < Self::EVERY {
            return;
        }
        if steps > self.steps {
            let more = steps - self.steps;
            tracing::warn!(
                "this machine is too slow for the simulated robots: they stood for {more} steps of 16 ms"
            );
        }
        let lost = (withheld - self.withheld).as_secs_f64() / since.as_secs_f64();
        if lost > Self::WORTH {
            let share = 100.0 * (1.0 - lost).max(0.0);
            tracing::warn!(
                "this machine is too slow for the simulated robots: show time goes at {share:.0} % of real time"
            );
        }
        *self = Self { steps, withheld, said: std::time::Instant::now() };
    }
}

/// The connections of a crowd.
pub struct FleetConnections(Vec<Sender>);

impl FleetConnections {
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

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::{Stage, front_rows};
    use lightbots_sim::Conditions;

    /// Three robots without a broker, and what holds their time.
    fn crowd() -> (Crowd, Clock, Arc<Pace>) {
        let stage = Stage::default();
        let (starts, conditions) = (front_rows(&stage, 3), Conditions::ideal());
        let config = FleetConfig { stage, starts, seed: 1, conditions };
        let (clock, pace) = (Clock::start(), Arc::new(Pace::default()));
        let broker = BrokerUrl::new("127.0.0.1", 1);
        let time = (clock.clone(), pace.clone());
        (Crowd::start(&config, &broker, TOGETHER, time, &Stop::install()), clock, pace)
    }

    #[tokio::test]
    async fn time_waits_for_simulated_robots_and_leaves_out_none_of_their_steps() {
        let (mut crowd, clock, pace) = crowd();
        let here = || Some("mqtt://here".to_owned());
        pace.simulates(3, here());
        pace.controls(here());
        crowd.advance();
        for _ in 0..100 {
            let ahead = clock.now() - crowd.began - (crowd.fleet.advance_at() - Instant::ZERO);
            assert!(ahead <= STEP * BEHIND, "{ahead:?}");
            crowd.advance();
        }
        assert_eq!(crowd.fleet.steps_left_out(), 0);
        pace.reports.say(100_000);
        let stands_at = crowd.fleet.advance_at();
        (0..3).for_each(|_| crowd.advance());
        assert_eq!(crowd.fleet.advance_at(), stands_at, "it goes on though nobody hears it");
        pace.reports.hear(100_000);
        while crowd.fleet.advance_at() == stands_at {
            crowd.advance();
        }
    }

    #[tokio::test]
    async fn time_waits_for_nobody_where_others_live_by_it() {
        let (mut crowd, clock, pace) = crowd();
        pace.reports.say(100_000);
        let before = crowd.fleet.advance_at();
        while crowd.fleet.advance_at() == before {
            crowd.advance();
        }
        assert_eq!(clock.withheld(), Duration::ZERO);
    }
}
