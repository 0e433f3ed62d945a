//! Simulated robots on a real broker, in real time where the machine is fast enough.

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

/// Number of simulated robots that share a connection in the command `run`.
pub const TOGETHER: usize = 50;
/// Most events of connections that are handled before the robots are simulated further.
const BATCH: usize = 4096;
/// Length of a simulation step: 16 ms.
const STEP: Span = Span::from_millis(16);
/// If the show clock may wait for the robots: the number of steps by which it may pass the time at which the robots'
/// next step is due. There the clock is held.
const BEHIND: i64 = 2;
/// Time between two checks whether messages that the clock waits for have arrived.
const LOOK_AGAIN: Duration = Duration::from_millis(2);
/// If the clock waits for messages under way and none arrives for this time, these messages count as lost.
const LOST: Duration = Duration::from_millis(1_000);

/// Index of a connection, and an event of that connection.
type Heard = (usize, LinkEvent);

/// Simulated robots with their connections to the broker.
pub struct Crowd {
    fleet: Fleet,
    clock: Clock,
    pace: Arc<Pace>,
    /// Start of the simulation, time of the show clock.
    began: Instant,
    /// Set while the clock waits for messages: when the number of received messages last changed (machine time), and
    /// that number. `None` otherwise.
    clogged: Option<(std::time::Instant, u64)>,
    robots: usize,
    /// Number of robots that share a connection.
    together: usize,
    senders: Vec<Sender>,
    heard: mpsc::Receiver<Heard>,
    tasks: Vec<tokio::task::JoinHandle<()>>,
}

impl Crowd {
    /// Creates robots and begins to connect them to `broker`, `together` robots on each connection (at least 1; the
    /// last connection may have fewer). Each further connection tries the next of the broker's addresses first. The
    /// connections last until `stop` is wanted. The robots run by `clock`, which waits for them if `pace` allows it.
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

    /// The connections of the robots.
    pub fn connections(&self) -> FleetConnections {
        FleetConnections(self.senders.clone())
    }

    /// Simulates the robots until `stop` is wanted, then waits for the end of their connections. Returns the steps and
    /// messages that were lost.
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
            // A connection whose task panicked has ended as well.
            let _ = task.await;
        }
        losses
    }

    fn now(&self) -> Instant {
        Instant((self.clock.now() - self.began).0.max(0) as u64)
    }

    /// Simulates the robots up to the present. If the clock may wait for them, lets it run only until `BEHIND` steps
    /// after their next step is due, and leaves no step out. While the clock waits for messages under way, simulates
    /// nothing.
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

    /// Whether too many messages are under way, so that the clock waits for them. Counts these messages as lost if none
    /// of them arrives for `LOST`.
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

/// Steps and messages that simulated robots lost in total because the machine or the network was too slow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Losses {
    /// Number of simulation steps of 16 ms that were left out. During them, all robots stood.
    pub steps: u64,
    /// Number of robots' messages that were dropped before they reached a connection.
    pub unsaid: u64,
    /// Number of messages, in both directions, that connections dropped because a queue was full.
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

/// Logs that the machine is too slow for the robots. Checks at most once in `EVERY`.
struct LeftOut {
    steps: u64,
    withheld: Duration,
    said: std::time::Instant,
}

impl LeftOut {
    /// Shortest time between two checks whether there is something to log.
    const EVERY: Duration = Duration::from_secs(5);
    /// Share of real time, 0 to 1. If the show clock was held for a larger share since the last check, that is logged.
    const WORTH: f64 = 0.1;

    fn new(withheld: Duration) -> Self {
        Self { steps: 0, withheld, said: std::time::Instant::now() }
    }

    /// Logs what was lost since the last check, unless that check was less than `EVERY` ago. `steps`: simulation steps
    /// left out since the start. `withheld`: how long the clock has been held since its start.
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

/// The connections of simulated robots.
pub struct FleetConnections(Vec<Sender>);

impl FleetConnections {
    /// Whether all connections are up.
    pub fn all(&self) -> bool {
        self.0.iter().all(Sender::is_connected)
    }
}

/// Settings of the connection that a group of robots shares.
fn link_config(index: usize, group: &[RobotId], broker: &BrokerUrl) -> LinkConfig {
    let mut filters: Vec<String> = group.iter().map(|id| format!("T/LightBot/{id}")).collect();
    filters.push("T/LightBot/Broadcast".into());
    // A broker that recognises robots by their client ids must not take a shared connection for one robot.
    let client_id = match group {
        [id] => robot_client_id(id),
        _ => crowd_client_id(),
    };
    LinkConfig { broker: broker.clone().starting_at(index), client_id, filters, queue: 65_536 }
}

/// Passes on the events of a link until `stop` is wanted, then closes the link.
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
    use lightbots_show::{Stage, back_rows};
    use lightbots_sim::Conditions;

    /// Three robots without a broker, with their clock and pace.
    fn crowd() -> (Crowd, Clock, Arc<Pace>) {
        let stage = Stage::default();
        let (starts, conditions) = (back_rows(&stage, 3), Conditions::ideal());
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
    async fn the_clock_does_not_wait_where_others_share_it() {
        let (mut crowd, clock, pace) = crowd();
        pace.reports.say(100_000);
        let before = crowd.fleet.advance_at();
        while crowd.fleet.advance_at() == before {
            crowd.advance();
        }
        assert_eq!(clock.withheld(), Duration::ZERO);
    }
}
