//! Tests of a whole robot in a small simulated world.

mod plant;

use lightbots_base::{Instant, PathRef, Piece, Rgb, RobotId, Span, Vec2};
use lightbots_robot::{Config, Inputs, Message, Robot};
use lightbots_wire::{Abilities, Blink, Command, Fade, Pieces, RobotState, Route, Topic};
use plant::{Flaws, Plant, straight};

/// Place of the robot before a drive, stage metres.
const START: Vec2 = Vec2::new(-0.5, 0.2);
/// End of the drive, stage metres.
const END: Vec2 = Vec2::new(0.4, -0.3);

/// Sends a route that starts 0.3 s from now. Returns its start, show clock.
fn send(plant: &mut Plant, route: &Route) -> Instant {
    let at = plant.show() + Span::from_millis(300);
    plant.tell(&Command::Route(route.clone()));
    plant.tell(&Command::Start { seq: route.seq, at });
    at
}

/// Drives a route. Returns the largest distance of the robot from its planned place, and the largest error of the
/// estimated place, both metres. `held`: how much longer to run because of holds.
fn worst_off(plant: &mut Plant, route: &Route, held: Span) -> (f64, f64) {
    let at = send(plant, route);
    let path = PathRef::new(route.start, &route.pieces);
    let (mut off, mut error) = (0.0f64, 0.0f64);
    while plant.show() < at + path.duration() + held + Span::from_millis(500) {
        plant.step();
        let place = path.at_instant(at, plant.show()).position;
        off = off.max(plant.at.distance(place));
        error = error.max(plant.robot.pose().unwrap().at.distance(plant.at));
    }
    (off, error)
}

#[test]
fn a_world_that_paused_leaves_its_robot_on_its_route_and_the_show_clock_right() {
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 3);
    let route = straight(1, START, END);
    let at = send(&mut plant, &route);
    let path = PathRef::new(route.start, &route.pieces);
    for pause_ms in [0, 400, 900] {
        // The world pauses while the robot's clock and the show clock run on, as in a simulation that pauses.
        plant.now += Span::from_millis(pause_ms);
        plant.lag += Span::from_millis(pause_ms);
        // The clock is synchronised meanwhile, and its filter must not count the pause a second time.
        for _ in 0..50 {
            plant.step();
            let due = path.at_instant(at, plant.show() - plant.lag).position;
            let off_m = plant.at.distance(due);
            assert!(off_m < 0.004, "after a pause of {pause_ms} ms it is {off_m} m off");
            let show = plant.robot.show_time(plant.now).expect("it is synchronised");
            assert!((show - plant.show()).0.abs() < 3_000, "{pause_ms}: the show clock is off");
        }
        assert_eq!(plant.robot.state(), RobotState::Driving);
    }
    plant.run(6.0);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
}

#[test]
fn after_a_pause_longer_than_its_patience_a_message_does_not_set_a_robot_going_again() {
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 3);
    send(&mut plant, &straight(1, START, END));
    plant.run(1.5);
    assert_eq!(plant.robot.state(), RobotState::Driving);
    plant.now += Span::from_millis(2_500);
    plant.lag += Span::from_millis(2_500);
    plant.tell(&Command::Status);
    let from = plant.at;
    plant.run(0.3);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    assert!(plant.stands() && plant.at.distance(from) < 0.04, "{:?}", plant.at);
}

#[test]
fn a_target_is_reached_from_every_side_and_said_once() {
    for turn in 0..12 {
        let heading = f64::from(turn) * 0.55 - 3.1;
        let mut plant = Plant::ready(Vec2::ZERO, heading, Flaws::STANDARD, 7 + turn as u64);
        let goal = Vec2::new(0.4, -0.3);
        plant.tell(&Command::Target(goal));
        plant.run(5.0);
        let off = plant.at - goal;
        assert!(off.x.abs() <= 0.02 && off.y.abs() <= 0.02, "{turn}: {off:?}");
        assert!(plant.stands());
        assert_eq!(plant.heard(Topic::Arrival).len(), 1, "{turn}");
        plant.tell(&Command::Target(goal));
        plant.run(0.5);
        assert_eq!(plant.heard(Topic::Arrival).len(), 2, "a new target is reported anew");
    }
}

#[test]
fn a_target_straight_behind_is_driven_to_backwards() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::NONE, 1);
    plant.tell(&Command::Target(Vec2::new(-0.5, 0.05)));
    plant.run(4.0);
    assert!(plant.at.distance(Vec2::new(-0.5, 0.05)) < 0.01);
    assert!(plant.heading.abs() < 0.5);
}

#[test]
fn a_new_target_replaces_the_old_at_once_and_a_senseless_one_stops() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::STANDARD, 1);
    plant.tell(&Command::Target(Vec2::new(1.0, 0.0)));
    plant.run(1.0);
    plant.tell_text(b"|TARGET 0,100000 0,300000|");
    plant.run(4.0);
    assert!(plant.at.distance(Vec2::new(0.1, 0.3)) < 0.02);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
    plant.tell_text(b"|TARGET 1.0 0.0|");
    plant.run(0.5);
    assert!(!plant.stands());
    plant.tell_text(b"|TARGET NaN 0.0|");
    plant.step();
    assert!(plant.stands());
    assert_eq!((plant.robot.unknown(), plant.robot.state()), (1, RobotState::Idle));
}

#[test]
fn on_a_route_it_is_where_the_path_says_when_it_says() {
    for seed in 0..8 {
        let heading = seed as f64 - 3.0;
        let mut plant = Plant::ready(START, heading, Flaws::STANDARD, seed);
        let (off, error) = worst_off(&mut plant, &straight(7, START, END), Span::ZERO);
        assert!(off < 0.005, "seed {seed}: {off}");
        assert!(error < 0.003, "seed {seed}: {error}");
        let arrivals = plant.heard(Topic::Arrival);
        assert_eq!(arrivals.len(), 1);
        assert_eq!(arrivals[0].details.as_ref().unwrap().route, 7);
    }
}

#[test]
fn a_turn_that_takes_longer_than_the_route_allows_is_begun_before() {
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 3);
    plant.tell(&Command::Route(straight(7, START, START + Vec2::new(0.0, 0.5))));
    plant.run(0.6);
    assert_eq!(plant.robot.state(), RobotState::Ready);
    assert!((plant.heading - core::f64::consts::FRAC_PI_2).abs() < 0.03, "{}", plant.heading);
    assert!(plant.at.distance(START) < 0.001);
}

#[test]
fn late_fixes_are_laid_beside_the_past() {
    let flaws = Flaws { fix_delay_steps: 6, ..Flaws::STANDARD };
    let mut plant = Plant::ready(START, 0.3, flaws, 5);
    let (off, error) = worst_off(&mut plant, &straight(7, START, END), Span::ZERO);
    assert!(off < 0.007 && error < 0.004, "{off} {error}");
}

#[test]
fn hold_brings_it_to_rest_on_its_path_and_resume_goes_on() {
    let mut plant = Plant::ready(START, 0.0, Flaws::STANDARD, 2);
    let route = straight(9, START, END);
    let at = send(&mut plant, &route);
    plant.run(2.0);
    let hold = plant.show() + Span::from_millis(100);
    plant.tell(&Command::Hold { at: hold });
    plant.run(1.0);
    assert_eq!(plant.robot.state(), RobotState::Held);
    let path = PathRef::new(route.start, &route.pieces);
    let held_at = path.at(hold - at + Route::EASE / 2).position;
    assert!(plant.at.distance(held_at) < 0.005, "{}", plant.at.distance(held_at));
    let still = plant.at;
    plant.run(1.0);
    assert!(plant.at.distance(still) < 0.003);
    let resume = plant.show();
    plant.tell(&Command::Resume { at: resume });
    let end = at + path.duration() + (resume - hold) + Span::from_millis(100);
    while plant.show() < end {
        plant.step();
    }
    assert!(plant.at.distance(END) < 0.005);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
}

#[test]
fn held_in_a_curve_it_keeps_its_heading() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::STANDARD, 2);
    let quarter = Piece {
        duration: Span(4_000_000),
        c1: Vec2::new(0.22, 0.0),
        c2: Vec2::new(0.4, 0.18),
        end: Vec2::new(0.4, 0.4),
    };
    let pieces = Pieces::from_slice(&[quarter]).unwrap();
    let at = send(
        &mut plant,
        &Route { seq: 1, start: Vec2::ZERO, pieces, room_mm: None, neighbours: Default::default() },
    );
    plant.tell(&Command::Hold { at: at + Span(1_850_000) });
    plant.run(4.0);
    let tangent = quarter.at(Vec2::ZERO, Span(2_000_000));
    assert_eq!(plant.robot.state(), RobotState::Held);
    assert!((plant.heading - tangent.velocity.angle()).abs() < 0.1, "{}", plant.heading);
    assert!(plant.at.distance(tangent.position) < 0.004);
}

#[test]
fn a_silent_link_cuts_it_off_and_it_takes_part_again() {
    let mut plant = Plant::ready(START, 0.0, Flaws::STANDARD, 2);
    let far = START + Vec2::new(1.5, 0.0);
    send(&mut plant, &straight(9, START, far));
    plant.answers = false;
    plant.run(1.9);
    assert_eq!(plant.robot.state(), RobotState::Driving);
    plant.run(0.3);
    assert!(plant.stands());
    assert_eq!(plant.robot.state(), RobotState::Cut);
    plant.answers = true;
    plant.robot.link(plant.now, true);
    plant.run(0.5);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    let here = plant.at;
    let (off, _) = worst_off(&mut plant, &straight(10, here, here + Vec2::new(0.3, 0.3)), Span::ZERO);
    assert!(off < 0.006, "{off}");
}

#[test]
fn a_controller_that_says_nothing_on_the_way_to_a_target_is_an_original_one() {
    let mut plant = Plant::new(Vec2::ZERO, 0.0, Flaws::STANDARD, 2);
    plant.answers = false;
    plant.run(0.2);
    plant.tell(&Command::Target(Vec2::new(1.2, 0.0)));
    plant.run(6.0);
    assert!(plant.at.distance(Vec2::new(1.2, 0.0)) < 0.02);
    plant.tell(&Command::Target(Vec2::ZERO));
    plant.run(0.5);
    plant.robot.link(plant.now, false);
    plant.run(2.0);
    assert_eq!(plant.robot.state(), RobotState::Driving);
    plant.run(0.2);
    assert!(plant.stands());
    assert_eq!(plant.robot.state(), RobotState::Cut);
}

#[test]
fn without_fixes_it_reckons_then_stands_lost_then_is_found() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::STANDARD, 2);
    plant.tell(&Command::Target(Vec2::new(1.2, 0.0)));
    plant.run(1.0);
    plant.sees = false;
    plant.run(0.3);
    assert_eq!(plant.robot.state(), RobotState::Driving);
    assert!(plant.robot.pose().unwrap().at.distance(plant.at) < 0.012);
    plant.run(3.0);
    assert_eq!(plant.robot.state(), RobotState::Lost);
    assert!(plant.stands() && plant.robot.pose().is_none());
    assert_eq!(plant.heard(Topic::Status).last().unwrap().at, None);
    plant.sees = true;
    plant.run(6.0);
    assert!(plant.at.distance(Vec2::new(1.2, 0.0)) < 0.02);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
}

#[test]
fn senseless_sensors_stop_the_wheels() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::STANDARD, 2);
    plant.tell(&Command::Target(Vec2::new(1.2, 0.0)));
    plant.run(1.0);
    let inputs = Inputs { wheel_turns_rad: [f64::NAN, 0.1], ..Inputs::default() };
    let outputs = plant.robot.step(plant.now + plant::STEP, &inputs);
    assert_eq!(outputs.wheels_radps, [0.0; 2]);
    assert_eq!(plant.robot.state(), RobotState::Faulty);
    plant.run(8.0);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1, "it goes on to its target afterwards");
}

#[test]
fn a_robot_far_from_its_route_gives_it_up() {
    let mut plant = Plant::ready(START + Vec2::new(0.0, 0.5), 0.0, Flaws::NONE, 2);
    send(&mut plant, &straight(9, START, END));
    plant.run(0.4);
    assert!(plant.stands());
    assert_eq!(plant.robot.state(), RobotState::Faulty);
    plant.run(2.0);
    assert_eq!(plant.robot.state(), RobotState::Idle);
}

#[test]
fn without_a_compass_it_learns_its_heading_from_driving() {
    let flaws = Flaws { heading_sigma_rad: None, ..Flaws::STANDARD };
    let mut plant = Plant::ready(Vec2::ZERO, 2.0, flaws, 2);
    for goal in [Vec2::new(0.5, 0.5), Vec2::new(-0.3, 0.4), Vec2::ZERO] {
        plant.tell(&Command::Target(goal));
        plant.run(8.0);
        assert!(plant.at.distance(goal) < 0.025, "{goal:?} {:?}", plant.at);
    }
    assert_eq!(plant.heard(Topic::Arrival).len(), 3);
}

#[test]
fn lights_switch_fade_by_the_show_clock_and_blink() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::NONE, 2);
    plant.tell(&Command::Color(Rgb::new(255, 165, 0)));
    plant.step();
    assert_eq!(plant.last.light, Rgb::new(255, 165, 0));
    let at = plant.show() + Span(500_000);
    plant.tell(&Command::Fade(Fade { to: Rgb::new(0, 0, 255), at, over: Span(400_000) }));
    while plant.show() < at + Span(200_000) {
        plant.step();
    }
    let Rgb { r, b, .. } = plant.last.light;
    assert!((118..=128).contains(&r) && (127..=138).contains(&b), "{:?}", plant.last.light);
    plant.run(0.4);
    assert_eq!(plant.last.light, Rgb::new(0, 0, 255));
    plant.tell(&Command::Blink(Blink { over: Span(1_000_000) }));
    plant.step();
    assert_eq!(plant.last.light, Rgb::new(255, 255, 255));
}

#[test]
fn it_introduces_itself_at_power_on_on_request_and_when_it_first_knows_its_place() {
    let mut plant = Plant::new(Vec2::new(0.5, 1.3), 0.0, Flaws::STANDARD, 2);
    plant.sees = false;
    plant.run(1.0);
    assert_eq!(plant.heard(Topic::Uuid)[0].at, None);
    plant.sees = true;
    plant.run(0.1);
    let introduced = plant.heard(Topic::Uuid);
    assert_eq!(introduced.len(), 2);
    assert!(introduced[1].at.unwrap().distance(plant.at) < 0.01);
    plant.robot.receive(plant.now, Topic::Broadcast, b"|UUID|");
    plant.step();
    assert_eq!(plant.heard(Topic::Uuid).len(), 3);
    plant.robot.receive(plant.now, Topic::Robot(RobotId::new("other").unwrap()), b"|UUID|");
    plant.robot.receive(plant.now, Topic::Arrival, b"|UUID|");
    plant.step();
    assert_eq!(plant.heard(Topic::Uuid).len(), 3);
}

#[test]
fn what_it_does_not_know_is_ignored_counted_and_reported() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::STANDARD, 2);
    plant.tell_text(b"|JUMP||COLOR x||UUID|");
    plant.tell_text(b"\xff\xfe");
    plant.tell_text(&vec![b'a'; 1 << 20]);
    plant.tell_text(b"");
    plant.step();
    assert_eq!(plant.robot.unknown(), 4);
    let report = plant.heard(Topic::Uuid)[0].details.clone().unwrap();
    assert_eq!((report.unknown, report.battery), (4, Some(80)));
}

#[test]
fn paths_and_starts_are_acknowledged_at_once() {
    let mut plant = Plant::ready(START, 0.0, Flaws::STANDARD, 2);
    plant.tell(&Command::Route(straight(12, START, END)));
    plant.step();
    let kept = plant.heard(Topic::Status).last().unwrap().details.clone().unwrap();
    assert_eq!((kept.route, kept.state, kept.starts), (12, RobotState::Ready, None));
    let at = plant.show() + Span(500_000);
    plant.robot.receive(plant.now, Topic::Broadcast, format!("|START 12 {}|", at.0).as_bytes());
    plant.step();
    let told = plant.heard(Topic::Status).last().unwrap().details.clone().unwrap();
    assert_eq!(told.starts, Some(at));
    assert!(told.clock_us.unwrap() <= 5000);
}

#[test]
fn with_no_abilities_it_speaks_and_understands_the_original_protocol_alone() {
    let id = RobotId::new("old").unwrap();
    let mut robot = Robot::new(Config { abilities: Abilities::default(), ..Config::new(id) });
    robot.receive(Instant::ZERO, Topic::Robot(id), b"|STATUS||UUID||FADE 1 2 3|");
    let mut said = Vec::new();
    let mut message = Message::new();
    for step in 1..500u64 {
        robot.step(Instant(step * 16_000), &Inputs::default());
        while let Some(topic) = robot.outgoing(&mut message) {
            said.push((topic, message.to_string()));
        }
    }
    assert!(said.iter().all(|one| *one == (Topic::Uuid, "old NaN NaN".to_string())), "{said:?}");
    assert_eq!(robot.unknown(), 2);
}

#[test]
fn a_robot_without_routes_sends_the_status_reports_that_commands_require_alone() {
    let status = |abilities: Abilities| {
        let id = RobotId::new("lamp").unwrap();
        let mut robot = Robot::new(Config { abilities, ..Config::new(id) });
        robot.link(Instant::ZERO, true);
        robot.receive(Instant::ZERO, Topic::Robot(id), b"|SLOT 3||LIGHT 9 F0 0 0 AAAAAwAA/w|");
        let (mut topics, mut message) = (Vec::new(), Message::new());
        for step in 1..500u64 {
            robot.step(Instant(step * 16_000), &Inputs::default());
            while let Some(topic) = robot.outgoing(&mut message) {
                topics.push((topic, message.contains("slot=3"), message.contains("light=9")));
            }
        }
        topics.retain(|one| one.0 != Topic::Uuid);
        topics
    };
    let none = Abilities::default();
    assert_eq!(status(Abilities { fade: true, blink: true, ..none }), []);
    assert_eq!(status(Abilities { live: true, ..none }), [(Topic::Status, true, false)]);
    assert_eq!(status(Abilities { light: true, ..none }), [(Topic::Status, false, true)]);
}

#[test]
fn messages_between_steps_do_not_shorten_them() {
    let mut plant = Plant::ready(Vec2::ZERO, 0.0, Flaws::NONE, 2);
    plant.tell(&Command::Target(Vec2::new(1.0, 0.0)));
    plant.step();
    let before = plant.last.wheels_radps[0];
    plant.robot.receive(plant.now + Span(15_900), Topic::Broadcast, b"|COLOR 1|");
    plant.step();
    assert!((plant.last.wheels_radps[0] / before - 2.0).abs() < 1e-6);
}
