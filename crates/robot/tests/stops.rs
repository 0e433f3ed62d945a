//! `STOP` and `StopFrom`, immediate and at a moment (R40 of `docs/protocol.md`).

mod plant;

use lightbots_base::{Instant, PathRef, Span, Vec2};
use lightbots_wire::{Command, RobotState, Route, Topic};
use plant::{Flaws, Plant, straight};

/// Start of the route, stage metres.
const START: Vec2 = Vec2::new(-0.6, 0.2);
/// End of the route, stage metres.
const END: Vec2 = Vec2::new(0.6, -0.1);

/// A robot in the middle of a route, which also keeps the next one. Returns that first route and its beginning too.
fn driving() -> (Plant, Route, Instant) {
    let mut plant = Plant::ready(START, 0.0, Flaws::STANDARD, 2);
    let route = straight(9, START, END);
    let at = plant.show() + Span::from_millis(300);
    plant.tell(&Command::Route(route.clone()));
    plant.tell(&Command::Start { seq: 9, at });
    plant.run(2.0);
    assert_eq!(plant.robot.state(), RobotState::Driving);
    plant.tell(&Command::Route(straight(10, END, START)));
    (plant, route, at)
}

/// Asserts that the robot has forgotten its routes and does not move.
fn has_stopped(plant: &mut Plant) {
    plant.said.clear();
    plant.tell(&Command::Status);
    for _ in 0..120 {
        plant.step();
        assert!(plant.stands());
    }
    assert_eq!((plant.robot.state(), plant.heard(Topic::Arrival).len()), (RobotState::Idle, 0));
    let reports = plant.heard(Topic::Status);
    assert_eq!(reports[0].details.as_ref().map(|details| details.route), Some(0));
}

#[test]
fn stop_is_at_once_and_forgets() {
    let (mut plant, ..) = driving();
    plant.robot.receive(plant.now, Topic::Broadcast, b"|STOP|");
    plant.step();
    has_stopped(&mut plant);
}

#[test]
fn stop_for_a_moment_lets_its_route_come_to_rest_whatever_resumes() {
    let (mut plant, route, at) = driving();
    let stop = plant.show() + Span::from_millis(200);
    let (copy, resume) = (Command::StopFrom { at: stop }, stop + Span::from_millis(100));
    for command in
        [Command::Resume { at: resume }, copy.clone(), copy.clone(), Command::Resume { at: resume }]
    {
        plant.tell(&command);
    }
    plant.run(0.4);
    assert_eq!(plant.robot.state(), RobotState::Held);
    plant.run(0.2);
    let rests_at = PathRef::new(route.start, &route.pieces).at(stop - at + Route::EASE / 2).position;
    assert!(plant.at.distance(rests_at) < 0.005, "{}", plant.at.distance(rests_at));
    has_stopped(&mut plant);
    plant.tell(&copy);
    has_stopped(&mut plant);
}

#[test]
fn stop_for_a_moment_is_at_once_where_that_is_long_ago_or_far_ahead_or_nothing_drives() {
    for ahead_ms in [-400, 1_800, 3_600_000] {
        let (mut plant, ..) = driving();
        plant.tell(&Command::StopFrom { at: plant.show() + Span::from_millis(ahead_ms) });
        plant.step();
        has_stopped(&mut plant);
    }
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 2);
    let at = plant.show() + Span::from_millis(300);
    plant.tell(&Command::Route(straight(9, START, END)));
    plant.tell(&Command::Start { seq: 9, at });
    plant.tell(&Command::StopFrom { at });
    plant.step();
    has_stopped(&mut plant);
}
