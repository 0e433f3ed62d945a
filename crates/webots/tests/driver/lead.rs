//! A minimal controller for one robot.

use std::time::Duration;

use lightbots_base::{Instant, Piece, RobotId, Span, Vec2};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent};
use lightbots_wire::{Command, Pieces, Report, Route, TimeAnswer, TimeQuestion, Topic, encode};

/// Clearance to other robots that a route states, metres.
pub const ROOM_M: f64 = 0.04;
/// Longest wait of a test, reached only on failure.
const PATIENCE: Duration = Duration::from_secs(60);

/// Sends a robot straight to `end`, which it faces, past an obstacle. Returns the report that its path is blocked.
pub fn into_its_way(broker: &str, id: RobotId, start: Vec2, end: Vec2) -> Report {
    drive_until(broker, id, (start, end), |report| {
        report.details.as_ref().is_some_and(|details| details.blocked.is_some())
    })
}

/// Sends a robot straight to `end`. Returns the first report for which `that` holds.
pub fn drive_until(
    broker: &str,
    id: RobotId,
    (start, end): (Vec2, Vec2),
    that: impl Fn(&Report) -> bool,
) -> Report {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
    runtime.block_on(async {
        let broker = BrokerUrl::parse(broker).expect("the test's own address");
        let filters = ["UUID", "Status", "Time"].map(|name| format!("T/LightBot/{name}")).into();
        let mut link = Link::open(LinkConfig { broker, client_id: "lead".into(), filters, queue: 1024 });
        let route = route(start, end);
        let led = tokio::time::timeout(PATIENCE, lead(&mut link, id, &route, that));
        led.await.expect("the robot reports it")
    })
}

/// A route with half a second of rest and then 0.25 m/s.
pub fn route(start: Vec2, end: Vec2) -> Route {
    let way = (end - start).normalized().expect("two places");
    let (cruise, ramp) = (way * 0.25, Span::from_millis(500));
    let begin = start + way * 0.0625;
    let pieces = [
        Piece::rest(start, ramp),
        Piece::hermite(start, Vec2::ZERO, begin, cruise, ramp),
        Piece::straight(begin, end, Span::from_secs((end - begin).length() / 0.25)),
    ];
    Route {
        seq: 1,
        start,
        pieces: Pieces::from_slice(&pieces).expect("three pieces"),
        room_mm: Some((ROOM_M * 1e3).round() as u16),
        neighbours: Default::default(),
    }
}

async fn lead(link: &mut Link, id: RobotId, route: &Route, that: impl Fn(&Report) -> bool) -> Report {
    let began = std::time::Instant::now();
    let show = || Instant(began.elapsed().as_micros() as u64 + 1_000_000);
    let sender = link.sender();
    let tell = |command: &Command| {
        let mut text = String::new();
        encode(command, &mut text).expect("a text takes everything");
        sender.send(&Topic::Robot(id).write(), text.into_bytes());
    };
    let mut sent = false;
    loop {
        let Some(event) = link.next().await else { panic!("the link ended") };
        let LinkEvent::Message { topic, payload, .. } = event else { continue };
        if Topic::parse(&topic) == Some(Topic::Time) {
            let question = TimeQuestion::decode(&payload).expect("a question");
            let (received, sent) = (show(), show());
            tell(&Command::Time(TimeAnswer { asked: question.asked, received, sent }));
            continue;
        }
        let report = Report::decode(&payload).expect("a report");
        if that(&report) {
            return report;
        }
        let details = report.details.as_ref().expect("a robot of ours");
        if details.clock_us.is_some() && !sent {
            tell(&Command::Route(route.clone()));
            tell(&Command::Start { seq: route.seq, at: show() + Span::from_millis(300) });
            sent = true;
        }
    }
}
