//! Measures a round: a route to every robot through a broker, and every robot's answer back, on loopback TCP.
//!
//! `cargo xtask bench round` runs it with `--json`. The embedded broker is `lightbots broker`; Mosquitto
//! (the program named in `LIGHTBOTS_MOSQUITTO`, or the one on the path) is measured in the same run.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod common;

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use lightbots_base::{Piece, RobotId, Span, Vec2};
use lightbots_link::{
    BrokerUrl, Link, LinkConfig, LinkEvent, controller_client_id, crowd_client_id, robot_client_id,
};
use lightbots_wire::{Details, Report, RobotState, Route, Topic, encode};

use common::{Broker, Outcome, embedded, mosquitto};

/// Numbers of robots, each with the number that share a connection: one, and for the largest fleet as the program does
/// it.
const SIZES: [(usize, usize); 4] = [(30, 1), (100, 1), (1_000, 1), (10_000, 50)];
/// Number of measured rounds for each broker and number of robots.
const ROUNDS: usize = 7;
/// Time after which a missing answer counts as lost.
const PATIENCE: Duration = Duration::from_secs(30);

/// Results for one broker and one number of robots.
struct Measured {
    median_ms: f64,
    lost: usize,
}

#[tokio::main]
async fn main() -> Outcome {
    // Every connection needs a file descriptor.
    let _ = rlimit::increase_nofile_limit(65_536);
    for (robots, together) in SIZES {
        let embedded = measure(embedded()?, robots, together).await?;
        let mosquitto = measure(mosquitto()?, robots, together).await?;
        println!(
            "{{\"robots\":{robots},\"connections\":{},\"embedded_ms\":{:.2},\"embedded_lost\":{},\"mosquitto_ms\":{:.2},\
             \"mosquitto_lost\":{}}}",
            robots.div_ceil(together),
            embedded.median_ms,
            embedded.lost,
            mosquitto.median_ms,
            mosquitto.lost
        );
    }
    Ok(())
}

async fn measure(broker: Broker, robots: usize, together: usize) -> Outcome<Measured> {
    let ids: Vec<RobotId> = (0..robots).map(|number| RobotId::from_random(number as u128)).collect();
    let fleet: Vec<_> = ids.chunks(together).map(|group| robots_on(&broker.url, group)).collect();
    let mut controller = Link::open(LinkConfig {
        broker: broker.url.clone(),
        client_id: controller_client_id(),
        filters: vec![Topic::Status.write().to_string()],
        queue: 4 * robots + 64,
    });
    while !matches!(controller.next().await, Some(LinkEvent::Connected)) {}
    let payloads: Vec<(String, Vec<u8>)> =
        ids.iter().enumerate().map(|(number, id)| command(number, id)).collect();
    gather(&mut controller, &payloads).await?;
    let mut times_ms = Vec::new();
    let mut lost = 0;
    for _ in 0..ROUNDS {
        let began = Instant::now();
        lost += robots - round(&mut controller, &payloads).await;
        times_ms.push(began.elapsed().as_secs_f64() * 1e3);
    }
    for task in fleet {
        task.abort();
    }
    times_ms.sort_by(f64::total_cmp);
    Ok(Measured { median_ms: times_ms[ROUNDS / 2], lost })
}

/// Sends `payloads` until every robot has answered once, because then all robots are subscribed.
async fn gather(controller: &mut Link, payloads: &[(String, Vec<u8>)]) -> Outcome {
    for _ in 0..120 {
        for (topic, payload) in payloads {
            controller.sender().send(topic, payload.clone());
        }
        if answers(controller, payloads.len(), Duration::from_secs(2)).await == payloads.len() {
            return Ok(());
        }
    }
    Err("the robots did not all come to the broker".into())
}

async fn round(controller: &mut Link, payloads: &[(String, Vec<u8>)]) -> usize {
    let sender = controller.sender();
    for (topic, payload) in payloads {
        sender.send(topic, payload.clone());
    }
    answers(controller, payloads.len(), PATIENCE).await
}

/// Number of different robots that answered within `patience`. Returns as soon as `wanted` robots have answered.
async fn answers(controller: &mut Link, wanted: usize, patience: Duration) -> usize {
    let mut heard = BTreeSet::new();
    let end = tokio::time::Instant::now() + patience;
    while heard.len() < wanted {
        match tokio::time::timeout_at(end, controller.next()).await {
            Ok(Some(LinkEvent::Message { payload, .. })) => {
                heard.extend(Report::decode(&payload).map(|report| report.id));
            }
            Ok(Some(_)) => {}
            Ok(None) | Err(_) => break,
        }
    }
    heard.len()
}

/// Starts robots on one connection, which answer every command with a full report.
fn robots_on(broker: &BrokerUrl, group: &[RobotId]) -> tokio::task::JoinHandle<()> {
    let mut link = Link::open(LinkConfig {
        broker: broker.clone(),
        client_id: match group {
            [id] => robot_client_id(id),
            _ => crowd_client_id(),
        },
        filters: group.iter().map(|id| Topic::Robot(*id).write().to_string()).collect(),
        queue: 4 * group.len() + 64,
    });
    tokio::spawn(async move {
        let sender = link.sender();
        while let Some(event) = link.next().await {
            let LinkEvent::Message { topic, .. } = event else { continue };
            let Some(Topic::Robot(id)) = Topic::parse(&topic) else { continue };
            sender.send(&Topic::Status.write(), answer(id));
        }
    })
}

fn answer(id: RobotId) -> Vec<u8> {
    let details = Details {
        heading: Some(std::f64::consts::FRAC_PI_2),
        battery: Some(80),
        state: RobotState::Ready,
        route: 17,
        off_m: Some(0.001),
        err_m: Some(0.001),
        clock_us: Some(400),
        ..Details::default()
    };
    let mut text = String::new();
    let report = Report { id, at: Some(Vec2::new(0.1234, -1.2345)), details: Some(details) };
    let _ = report.encode(&mut text);
    text.into_bytes()
}

/// The topic and the command of a route as in a transition: rest, speed up, cruise, slow down.
fn command(number: usize, id: &RobotId) -> (String, Vec<u8>) {
    let place = |share: f64| Vec2::new(number as f64 * 0.001 - 1.4, -1.0 + share);
    let mut route = Route {
        seq: 17,
        start: place(0.0),
        pieces: Default::default(),
        room_mm: None,
        neighbours: Default::default(),
    };
    let _ = route.pieces.push(Piece::rest(place(0.0), Span::from_millis(350)));
    for share in [0.1, 0.9, 1.0] {
        let _ = route.pieces.push(Piece::hermite(
            place(share - 0.1),
            Vec2::ZERO,
            place(share),
            Vec2::ZERO,
            Span::from_millis(800),
        ));
    }
    let mut text = String::new();
    let _ = encode(&lightbots_wire::Command::Route(route), &mut text);
    (Topic::Robot(*id).write().to_string(), text.into_bytes())
}
