//! A robot that is cut off or lost stops in time, shows the reason by its light and reports, and takes part again
//! afterwards. The cases are the table at the end of the safety rules in `docs/protocol.md`.

mod plant;

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_robot::{Inputs, SENSORS};
use lightbots_wire::{Command, Report, RobotState, Topic};
use plant::{Flaws, Plant, straight};

/// Place of the robot before a drive, stage metres.
const START: Vec2 = Vec2::new(-0.6, 0.2);
/// End of a long drive, stage metres.
const FAR: Vec2 = Vec2::new(0.9, 0.2);
/// The robot's own colour.
const OWN: Rgb = Rgb::new(0, 60, 90);
const RED: Rgb = Rgb::new(255, 0, 0);

/// A robot with the colour `OWN` and a synchronised clock.
fn ready(flaws: Flaws) -> Plant {
    let mut plant = Plant::ready(START, 0.0, flaws, 2);
    plant.tell(&Command::Color(OWN));
    plant
}

/// Sends a route to `to` that starts in `in_ms` milliseconds.
fn send(plant: &mut Plant, seq: u32, to: Vec2, in_ms: i64) {
    let at = plant.show() + Span::from_millis(in_ms);
    plant.tell(&Command::Route(straight(seq, plant.at, to)));
    plant.tell(&Command::Start { seq, at });
}

/// A robot in the middle of a route.
fn driving() -> Plant {
    let mut plant = ready(Flaws::STANDARD);
    send(&mut plant, 9, FAR, 300);
    plant.run(2.5);
    assert!(!plant.stands() && plant.robot.state() == RobotState::Driving);
    plant.said.clear();
    plant
}

/// Steps until the robot stands. Returns the seconds that took, at most about 5.
fn stands_after(plant: &mut Plant) -> f64 {
    let began = plant.now;
    while !plant.stands() && plant.now < began + Span::from_millis(5_000) {
        plant.step();
    }
    (plant.now - began).as_secs()
}

/// Number of red flashes within two seconds, and whether the robot shows its own colour between them.
fn flashes(plant: &mut Plant) -> (usize, bool) {
    let mut shown = vec![plant.last.light];
    for _ in 0..125 {
        plant.step();
        shown.push(plant.last.light);
    }
    (shown.windows(2).filter(|pair| pair[0] != RED && pair[1] == RED).count(), shown.contains(&OWN))
}

/// Checks that the robot drives a new route from its place.
fn takes_part_again(plant: &mut Plant, seq: u32) {
    plant.said.clear();
    let to = plant.at + Vec2::new(-0.3, 0.2);
    send(plant, seq, to, 500);
    plant.run(4.0);
    assert!(plant.at.distance(to) < 0.02, "{:?} {to:?}", plant.at);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
    assert_eq!(plant.last.light, OWN);
}

fn states(reports: &[&Report]) -> Vec<RobotState> {
    reports.iter().filter_map(|report| report.details.as_ref()).map(|details| details.state).collect()
}

#[test]
fn cut_off_on_a_route_it_stands_after_two_seconds() {
    let mut plant = driving();
    plant.answers = false;
    plant.robot.link(plant.now, false);
    let after_s = stands_after(&mut plant);
    assert!((1.0..=2.15).contains(&after_s), "{after_s} s");
    plant.step();
    assert_eq!(plant.robot.state(), RobotState::Cut);
    plant.run(0.5);
    assert_eq!(flashes(&mut plant), (2, true));
    // What the robot sent meanwhile did not arrive.
    plant.said.clear();
    plant.answers = true;
    plant.robot.link(plant.now, true);
    plant.run(0.1);
    assert_eq!(states(&plant.heard(Topic::Uuid)), [RobotState::Cut]);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    plant.run(1.0);
    takes_part_again(&mut plant, 10);
}

#[test]
fn a_controller_that_falls_silent_is_as_good_as_a_broken_link() {
    let mut plant = driving();
    plant.answers = false;
    let after_s = stands_after(&mut plant);
    assert!((1.0..=2.15).contains(&after_s), "{after_s} s");
    plant.step();
    assert_eq!(states(&plant.heard(Topic::Status)).last(), Some(&RobotState::Cut));
    plant.run(0.5);
    assert_eq!(flashes(&mut plant), (2, true));
    plant.answers = true;
    plant.tell_text(b"|STATUS|");
    plant.run(0.1);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    takes_part_again(&mut plant, 10);
}

#[test]
fn cut_off_in_air_time_it_says_so_and_does_not_set_out() {
    let mut plant = ready(Flaws::STANDARD);
    send(&mut plant, 9, FAR, 5_000);
    plant.run(0.5);
    plant.answers = false;
    plant.robot.link(plant.now, false);
    plant.run(2.5);
    assert_eq!(plant.robot.state(), RobotState::Ready);
    assert_eq!(flashes(&mut plant), (2, true));
    plant.run(2.0);
    // The start of its route has passed, and other robots may be where it would have been.
    assert!(plant.stands() && plant.at.distance(START) < 0.01, "{:?}", plant.at);
    assert_eq!(plant.robot.state(), RobotState::Cut);
    plant.said.clear();
    plant.answers = true;
    plant.robot.link(plant.now, true);
    plant.run(0.1);
    assert_eq!(states(&plant.heard(Topic::Uuid)), [RobotState::Cut]);
    plant.run(1.0);
    takes_part_again(&mut plant, 10);
}

#[test]
fn a_robot_that_waits_for_its_start_does_not_turn_in_silence() {
    let mut plant = ready(Flaws::STANDARD);
    send(&mut plant, 9, START + Vec2::new(0.0, -0.5), 60_000);
    plant.run(1.0);
    plant.answers = false;
    plant.run(2.2);
    plant.heading += 1.0;
    for _ in 0..200 {
        plant.step();
        assert_eq!(plant.last.wheels_radps, [0.0; 2], "it was turned by hand");
    }
    plant.answers = true;
    plant.tell_text(b"|UUID|");
    for _ in 0..60 {
        plant.step();
        assert_eq!(plant.last.wheels_radps, [0.0; 2], "that may be an old message");
    }
    plant.tell(&Command::Start { seq: 9, at: plant.show() + Span::from_millis(60_000) });
    plant.run(1.0);
    assert!((plant.heading + core::f64::consts::FRAC_PI_2).abs() < 0.05, "{}", plant.heading);
}

#[test]
fn a_robot_between_two_drives_does_not_turn_to_a_route_that_comes_after_silence() {
    let mut plant = ready(Flaws::STANDARD);
    let goal = START + Vec2::new(0.1, 0.0);
    send(&mut plant, 9, goal, 300);
    plant.run(2.0);
    assert_eq!(plant.heard(Topic::Arrival).len(), 1);
    let next = Command::Route(straight(10, goal, goal + Vec2::new(0.0, -0.5)));
    plant.answers = false;
    plant.run(3.5);
    plant.answers = true;
    plant.tell(&next);
    for _ in 0..60 {
        plant.step();
        assert_eq!(plant.last.wheels_radps, [0.0; 2], "that may be an old message");
    }
    plant.tell(&Command::Start { seq: 10, at: plant.show() + Span::from_millis(60_000) });
    plant.run(1.0);
    assert!((plant.heading + core::f64::consts::FRAC_PI_2).abs() < 0.05, "{}", plant.heading);
}

#[test]
fn a_robot_that_stands_for_long_or_was_stopped_turns_towards_its_next_route() {
    for (silent_s, stop) in [(2.0, false), (4.0, true)] {
        let mut plant = ready(Flaws::STANDARD);
        let goal = START + Vec2::new(0.1, 0.0);
        send(&mut plant, 9, goal, 300);
        plant.run(2.0);
        // The robot may have requested the time a second ago.
        plant.answers = false;
        plant.run(silent_s);
        plant.answers = true;
        if stop {
            plant.tell(&Command::Stop);
        }
        plant.tell(&Command::Route(straight(10, goal, goal + Vec2::new(0.0, -0.5))));
        plant.run(1.0);
        let off_rad = (plant.heading + core::f64::consts::FRAC_PI_2).abs();
        assert!(off_rad < 0.05, "silent for {silent_s} s: {off_rad}");
    }
}

#[test]
fn a_robot_that_was_cut_off_on_its_first_route_does_not_turn_towards_another() {
    let mut plant = driving();
    plant.answers = false;
    stands_after(&mut plant);
    plant.tell(&Command::Route(straight(10, plant.at, plant.at + Vec2::new(0.0, -0.5))));
    for _ in 0..60 {
        plant.step();
        assert_eq!(plant.last.wheels_radps, [0.0; 2], "that may be an old message");
    }
}

#[test]
fn a_robot_that_aborted_its_route_does_not_turn_towards_the_one_after_it() {
    let mut plant = driving();
    plant.tell(&Command::Route(straight(10, FAR, FAR + Vec2::new(0.0, -0.5))));
    plant.answers = false;
    assert!(stands_after(&mut plant) < 2.2 && plant.at.distance(FAR) > 0.1);
    plant.tell_text(b"|STATUS|");
    for _ in 0..60 {
        plant.step();
        assert_eq!(plant.last.wheels_radps, [0.0; 2]);
    }
}

#[test]
fn a_short_break_of_the_link_in_air_time_changes_nothing() {
    let mut plant = ready(Flaws::STANDARD);
    send(&mut plant, 9, FAR, 4_000);
    plant.run(0.5);
    plant.answers = false;
    plant.robot.link(plant.now, false);
    plant.run(1.5);
    plant.answers = true;
    plant.robot.link(plant.now, true);
    plant.run(9.5);
    assert_eq!(plant.last.light, OWN);
    assert!(plant.at.distance(FAR) < 0.02);
    assert!(!states(&plant.heard(Topic::Uuid)).contains(&RobotState::Cut));
}

#[test]
fn lost_on_a_route_it_stands_before_its_doubt_is_large() {
    let mut plant = driving();
    plant.sees = false;
    let began = plant.now;
    let after_s = stands_after(&mut plant);
    assert!(after_s <= 3.05, "{after_s} s");
    while plant.robot.state() != RobotState::Lost && plant.now < began + Span::from_millis(3_050) {
        assert!(plant.stands());
        plant.step();
    }
    assert_eq!(plant.robot.state(), RobotState::Lost);
    assert!(!states(&plant.heard(Topic::Status)).contains(&RobotState::Faulty));
    plant.step();
    let last = plant.heard(Topic::Status).last().map(|report| report.at);
    assert_eq!(last, Some(None));
    assert_eq!(states(&plant.heard(Topic::Status)).last(), Some(&RobotState::Lost));
    plant.run(0.5);
    assert_eq!(flashes(&mut plant), (1, true));
    plant.sees = true;
    plant.run(1.0);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    assert!(plant.heard(Topic::Status).last().is_some_and(|report| report.at.is_some()));
    takes_part_again(&mut plant, 10);
}

#[test]
fn without_fixes_for_a_while_it_stands_before_it_is_lost_and_goes_on() {
    // In its first metre the robot does not know its wheels' slip. It once drove on for half a second until it was
    // lost.
    let mut plant = ready(Flaws { slip: [0.12, 0.03], ..Flaws::STANDARD });
    send(&mut plant, 9, FAR, 300);
    plant.run(0.7);
    assert!(!plant.stands() && plant.robot.state() == RobotState::Driving);
    plant.sees = false;
    let after_s = stands_after(&mut plant);
    assert!(after_s < 0.8, "{after_s} s");
    plant.run(0.9 - after_s);
    assert!(plant.stands() && plant.robot.state() == RobotState::Driving);
    assert!(plant.robot.place_error_m() < 0.02, "{}", plant.robot.place_error_m());
    plant.sees = true;
    plant.run(9.0);
    assert!(plant.at.distance(FAR) < 0.02 && plant.robot.state() == RobotState::Idle);
}

#[test]
fn lost_in_air_time_it_says_so_and_is_found_again() {
    let mut plant = ready(Flaws::NONE);
    plant.sees = false;
    plant.run(3.6);
    assert_eq!(states(&plant.heard(Topic::Status)).last(), Some(&RobotState::Lost));
    assert_eq!(flashes(&mut plant), (1, true));
    plant.sees = true;
    plant.run(0.2);
    assert_eq!(plant.robot.state(), RobotState::Idle);
    assert_eq!(plant.last.light, OWN);
    takes_part_again(&mut plant, 10);
}

#[test]
fn senseless_wheels_stop_it_at_once_and_show() {
    let mut plant = driving();
    let senseless = Inputs { wheel_turns_rad: [f64::NAN, 0.0], ..Inputs::default() };
    plant.last = plant.robot.step(plant.now + plant::STEP, &senseless);
    assert!(plant.stands() && plant.robot.state() == RobotState::Faulty);
    plant.run(0.5);
    // The state lasts only one second, so there are only the first two flashes of three.
    let (red, _) = flashes(&mut plant);
    assert_eq!(red, 2);
    assert_eq!(states(&plant.heard(Topic::Status))[0], RobotState::Faulty);
    takes_part_again(&mut plant, 10);
}

#[test]
fn lifted_on_its_route_it_leaves_the_route_and_stands() {
    let mut plant = driving();
    plant.at += Vec2::new(-0.1, 0.15);
    let put = plant.at;
    stands_after(&mut plant);
    plant.run(1.0);
    assert!(plant.at.distance(put) < 0.1, "it drove on for {} m", plant.at.distance(put));
    assert_eq!(states(&plant.heard(Topic::Status)).last(), Some(&RobotState::Idle));
    takes_part_again(&mut plant, 10);
}

#[test]
fn pushed_a_little_it_goes_back_on_its_route() {
    let mut plant = driving();
    plant.at += Vec2::new(0.0, 0.03);
    plant.run(6.0);
    assert!(plant.at.distance(FAR) < 0.01, "{:?}", plant.at);
}

#[test]
fn lifted_before_its_start_it_does_not_begin_the_route() {
    let mut plant = ready(Flaws::STANDARD);
    send(&mut plant, 9, FAR, 1_000);
    plant.run(0.5);
    plant.said.clear();
    plant.at += Vec2::new(0.1, 0.2);
    let put = plant.at;
    plant.run(0.4);
    let told = plant.heard(Topic::Status).last().and_then(|report| report.at);
    assert!(told.is_some_and(|at| at.distance(put) < 0.01), "{told:?} for {put:?}");
    plant.run(3.0);
    assert!(plant.at.distance(put) < 0.01 && plant.robot.state() == RobotState::Idle, "{:?}", plant.at);
    takes_part_again(&mut plant, 10);
}

/// Without a HOLD, a robot that stands for an obstacle falls behind its route by itself.
#[test]
fn a_robot_that_stands_for_an_obstacle_gives_its_route_up_and_is_not_faulty() {
    let mut plant = driving();
    let mut gaps_m = [f32::INFINITY; SENSORS];
    gaps_m[0] = 0.006;
    plant.gaps_m = Some(gaps_m);
    plant.run(0.5);
    let braked = plant
        .heard(Topic::Status)
        .iter()
        .any(|report| report.details.as_ref().is_some_and(|details| details.blocked.is_some()));
    assert!(plant.stands() && braked && plant.robot.state() == RobotState::Driving);
    plant.run(1.5);
    assert!(plant.stands());
    let said = states(&plant.heard(Topic::Status));
    assert!(said.last() == Some(&RobotState::Idle) && !said.contains(&RobotState::Faulty), "{said:?}");
    plant.gaps_m = None;
    plant.run(0.5);
    takes_part_again(&mut plant, 10);
}
