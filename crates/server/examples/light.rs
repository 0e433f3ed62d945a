//! Measures the difference between the times at which a fleet's lights change. Each robot core has its own clock and
//! its own connection to the embedded broker, and all receive one moment for the change.
//!
//! `cargo xtask bench light` runs it with `--json`. A core steps every 16 ms at its own phase, and its light is sampled
//! every millisecond, as on a board.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod common;

use std::time::{Duration, Instant as Moment};

use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, controller_client_id, robot_client_id};
use lightbots_robot::{Config, Fix, Inputs, Message, Robot};
use lightbots_wire::{Command, Fade, Topic, encode};
use tokio::sync::mpsc;

use common::{Outcome, embedded};

/// Numbers of robots that are measured.
const SIZES: [usize; 3] = [30, 100, 1_000];
/// Number of light changes for each number of robots.
const CHANGES: usize = 20;
/// How long before its moment a light is sent.
const AHEAD: Span = Span::from_millis(500);
/// Time between two samples of the lights.
const ASK: Duration = Duration::from_millis(1);
/// Time for clocks to settle before the first change.
const SETTLE: Duration = Duration::from_secs(20);
/// Time between two steps of a robot core, microseconds.
const STEP_US: u64 = 16_000;
/// Longest wait until all robots know the show clock.
const PATIENCE: Duration = Duration::from_secs(60);

/// A link event for a robot: the robot's index, when the event arrived, and the event.
type Heard = (usize, Moment, LinkEvent);

struct Body {
    robot: Robot,
    id: RobotId,
    sender: Sender,
    /// Offset of its own clock, microseconds. `fast_ppm` is how much faster that clock runs, parts per million.
    offset_us: u64,
    fast_ppm: f64,
    next_step_us: u64,
    light: Rgb,
    /// When the light last changed, microseconds since the start. `seen_us` is when a step last found another light.
    changed_us: u64,
    seen_light: Rgb,
    seen_us: u64,
}

struct Fleet {
    began: Moment,
    bodies: Vec<Body>,
    heard: mpsc::Receiver<Heard>,
    message: Message,
}

/// For each light change, the time between the first and the last robot that changed, milliseconds, sorted. `asked_ms`
/// is by samples of the lights, `stepped_ms` by steps of the cores. `missed`: lights that did not change in time, in
/// total.
struct Spreads {
    asked_ms: Vec<f64>,
    stepped_ms: Vec<f64>,
    missed: usize,
}

#[tokio::main]
async fn main() -> Outcome {
    // Every connection needs a file descriptor.
    let _ = rlimit::increase_nofile_limit(65_536);
    for robots in SIZES {
        let broker = embedded()?;
        let spreads = measure(&broker.url, robots).await?;
        let median = |list: &[f64]| list.get(list.len() / 2).copied().unwrap_or_default();
        println!(
            "{{\"robots\":{robots},\"changes\":{CHANGES},\"spread_ms\":{:.2},\"worst_ms\":{:.2},\"by_steps_ms\":{:.2},\"missed\":{}}}",
            median(&spreads.asked_ms),
            spreads.asked_ms.last().copied().unwrap_or_default(),
            median(&spreads.stepped_ms),
            spreads.missed,
        );
    }
    Ok(())
}

async fn measure(broker: &BrokerUrl, robots: usize) -> Outcome<Spreads> {
    let began = Moment::now();
    let mut fleet = Fleet::start(broker, robots, began);
    // The program's own controller keeps the show clock. This connection only sends the changes.
    let client_id = controller_client_id();
    let mut link =
        Link::open(LinkConfig { broker: broker.clone(), client_id, filters: vec![], queue: 4 * robots });
    while !matches!(link.next().await, Some(LinkEvent::Connected)) {}
    let sender = link.sender();
    fleet.settle().await?;
    let mut spreads = Spreads { asked_ms: Vec::new(), stepped_ms: Vec::new(), missed: 0 };
    for change in 0..CHANGES {
        let to = if change % 2 == 0 { Rgb::new(255, 255, 255) } else { Rgb::new(0, 0, 200) };
        let at = fleet.show_time().ok_or("the first robot has lost the show clock")? + AHEAD;
        for body in &fleet.bodies {
            let mut text = String::new();
            encode(&Command::Fade(Fade { to, at, over: Span::ZERO }), &mut text)?;
            sender.send(&Topic::Robot(body.id).write(), text.into_bytes());
        }
        let until = Moment::now() + Duration::from_millis(900);
        while Moment::now() < until {
            fleet.turn().await;
        }
        let shows: Vec<&Body> = fleet.bodies.iter().filter(|body| body.light == to).collect();
        spreads.missed += robots - shows.len();
        spreads.asked_ms.push(spread_ms(shows.iter().map(|body| body.changed_us)));
        spreads.stepped_ms.push(spread_ms(shows.iter().map(|body| body.seen_us)));
    }
    link.close().await;
    spreads.asked_ms.sort_by(f64::total_cmp);
    spreads.stepped_ms.sort_by(f64::total_cmp);
    Ok(spreads)
}

fn spread_ms(moments: impl Iterator<Item = u64> + Clone) -> f64 {
    let (first, last) = (moments.clone().min().unwrap_or(0), moments.max().unwrap_or(0));
    (last - first) as f64 / 1e3
}

impl Fleet {
    fn start(broker: &BrokerUrl, robots: usize, began: Moment) -> Self {
        let (news, heard) = mpsc::channel(65_536);
        let bodies = (0..robots).map(|index| Body::start(broker, index, news.clone())).collect();
        Self { began, bodies, heard, message: Message::new() }
    }

    fn now_us(&self) -> u64 {
        self.began.elapsed().as_micros() as u64
    }

    /// The show clock as the first robot estimates it.
    fn show_time(&self) -> Option<Instant> {
        let body = self.bodies.first()?;
        body.robot.show_time(body.own(self.now_us()))
    }

    /// Waits until every clock has been synchronised for a while.
    async fn settle(&mut self) -> Outcome {
        let late = Moment::now() + PATIENCE;
        loop {
            self.turn().await;
            let now_us = self.now_us();
            if self.bodies.iter().all(|body| body.robot.show_time(body.own(now_us)).is_some()) {
                break;
            }
            if Moment::now() > late {
                return Err("not all robots came to know the show clock".into());
            }
        }
        let until = Moment::now() + SETTLE;
        while Moment::now() < until {
            self.turn().await;
        }
        Ok(())
    }

    /// Handles received events. Then each robot steps if that is due, its light is sampled, and its messages are sent.
    async fn turn(&mut self) {
        while let Ok((index, at, event)) = self.heard.try_recv() {
            let at_us = at.duration_since(self.began).as_micros() as u64;
            self.bodies[index].hear(at_us, event);
        }
        for body in &mut self.bodies {
            // Each robot reads the time separately, because a real fleet is many boards.
            body.turn(self.began.elapsed().as_micros() as u64, &mut self.message);
        }
        tokio::time::sleep(ASK).await;
    }
}

impl Body {
    fn start(broker: &BrokerUrl, index: usize, news: mpsc::Sender<Heard>) -> Self {
        let id = RobotId::from_random(0x5eed_0000 + index as u128);
        let filters = vec![Topic::Broadcast.write().to_string(), Topic::Robot(id).write().to_string()];
        let mut link = Link::open(LinkConfig {
            broker: broker.clone(),
            client_id: robot_client_id(&id),
            filters,
            queue: 256,
        });
        let sender = link.sender();
        tokio::spawn(async move {
            while let Some(event) = link.next().await {
                if news.send((index, Moment::now(), event)).await.is_err() {
                    return;
                }
            }
        });
        let scattered = (index as u64).wrapping_mul(2_654_435_761);
        Self {
            robot: Robot::new(Config { seed: scattered as u32, ..Config::new(id) }),
            id,
            sender,
            offset_us: 1_000_000 + scattered % 3_600_000_000,
            fast_ppm: (scattered % 101) as f64 - 50.0,
            next_step_us: scattered % STEP_US,
            light: Rgb::BLACK,
            changed_us: 0,
            seen_light: Rgb::BLACK,
            seen_us: 0,
        }
    }

    /// The time of its own clock.
    fn own(&self, now_us: u64) -> Instant {
        Instant((self.offset_us + now_us).wrapping_add_signed((now_us as f64 * self.fast_ppm * 1e-6) as i64))
    }

    fn hear(&mut self, at_us: u64, event: LinkEvent) {
        let at = self.own(at_us);
        match event {
            LinkEvent::Connected => self.robot.link(at, true),
            LinkEvent::Disconnected { .. } => self.robot.link(at, false),
            LinkEvent::Message { topic, payload, .. } => {
                if let Some(topic) = Topic::parse(&topic) {
                    self.robot.receive(at, topic, &payload);
                }
            }
        }
    }

    fn turn(&mut self, now_us: u64, message: &mut Message) {
        let now = self.own(now_us);
        if now_us >= self.next_step_us {
            self.next_step_us += STEP_US * (1 + (now_us - self.next_step_us) / STEP_US);
            let fix = Some(Fix { at: Vec2::ZERO, heading: Some(0.0) });
            let light = self.robot.step(now, &Inputs { fix, ..Inputs::default() }).light;
            if light != self.seen_light {
                (self.seen_light, self.seen_us) = (light, now_us);
            }
        }
        let light = self.robot.light(now);
        if light != self.light {
            (self.light, self.changed_us) = (light, now_us);
        }
        while let Some(topic) = self.robot.outgoing(message) {
            self.sender.send(&topic.write(), message.as_bytes().to_vec());
        }
    }
}
