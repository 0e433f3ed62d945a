//! Lossy links, robots and controllers that disappear and come back, and invalid messages.

mod fleet;

use fleet::{Dice, World, show, started};
use lightbots_base::{Span, Vec2};
use lightbots_control::{ControllerState, EventKind, MissingPolicy, Operation, Refusal, RunOutcome, Trouble};
use lightbots_show::Identity;
use lightbots_wire::Blocked;
use std::sync::Arc;

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

/// Eight robots in the first of two frames. In the second frame those of the pixels from `movers` on stay in place. The
/// START of the drive there is postponed, because the first robot that has to move does not receive it. The clocks of
/// `early` robots are ahead, so that these begin before they learn of that.
fn put_off_while_some_are_early(movers: usize, early: std::ops::Range<usize>) -> World {
    let mut show = show(1, 8, 3.0);
    let mut second = show.frames[0].clone();
    second.pixels[..movers].iter_mut().for_each(|pixel| pixel.at -= Vec2::new(0.0, 0.6));
    show.frames.push(second);
    show.identity = Identity::Fixed;
    let mut world = World::ready(8, 0, show.clone());
    world.play();
    world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.run_for(1.0);
    let on = |world: &World, pixel: usize| {
        let there = |robot: &fleet::robot::Robot| robot.at.distance(show.frames[0].pixels[pixel].at) < 0.01;
        world.robots.iter().position(there).expect("each pixel has a robot")
    };
    for pixel in early {
        let robot = on(&world, pixel);
        world.robots[robot].ahead = Span::from_millis(450);
    }
    world.deaf = vec![on(&world, 0)];
    world.run_for(2.3);
    world.deaf.clear();
    world.robots.iter_mut().for_each(|robot| robot.ahead = Span::ZERO);
    world
}

#[test]
fn robots_that_have_ended_an_empty_route_do_not_keep_the_others_from_starting() {
    let mut world = put_off_while_some_are_early(1, 1..8);
    let started = world.run_until(5.0, started);
    assert_eq!(world.run_to_end(20.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Waiting { .. })), 0, "{}", world.story());
    assert!(matches!(started.kind, EventKind::TransitionStarted { frame: 1, .. }));
}

#[test]
fn a_robot_that_drove_its_route_alone_is_planned_for_anew() {
    let mut world = put_off_while_some_are_early(2, 1..2);
    let waits = |kind: &EventKind| matches!(kind, EventKind::Waiting { why: Trouble::Cut, .. });
    assert!(world.count(waits) > 0, "{}", world.story());
    assert_eq!(world.run_to_end(20.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

/// The simulation of a busy machine runs slowly, so that all robots are late together, and on their routes.
#[test]
fn robots_of_a_slow_world_are_waited_for() {
    let mut world = World::ready(8, 0, show(3, 8, 0.3));
    world.robots.iter_mut().for_each(|robot| robot.pace = 0.4);
    world.play();
    assert_eq!(world.run_to_end(120.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn lossy_and_slow_links_lose_no_robot() {
    for (loss, delay_ms) in [(5, (5, 15)), (20, (5, 50)), (5, (100, 200))] {
        let show = show(4, 12, 0.3);
        let mut world = World::ready(12, 0, show.clone());
        (world.loss, world.delay_ms) = (loss, delay_ms);
        world.play();
        let ended = world.run_to_end(120.0);
        assert_eq!(ended, (RunOutcome::Finished, 4, 0), "loss {loss} %:\n{}", world.story());
        assert_eq!(world.lit(&show.frames[3]), 12, "loss {loss} %");
    }
}

#[test]
fn a_broker_that_passes_nothing_on_costs_no_robot() {
    let mut world = World::under_way(8);
    world.mute = true;
    world.run_until(30.0, |kind| *kind == EventKind::Undelivered);
    world.run_for(20.0);
    world.mute = false;
    let ended = world.run_to_end(60.0);
    assert_eq!(ended, (RunOutcome::Finished, 3, 0), "{}", world.story());
}

/// A cluster of brokers that lost a node may drop the subscriptions of that node's clients.
#[test]
fn robots_that_hear_late_after_the_broker_came_back_are_waited_for() {
    let mut world = World::under_way(8);
    world.link(false);
    world.run_for(3.0);
    world.deaf = vec![2, 5];
    world.link(true);
    world.run_for(11.0);
    world.deaf.clear();
    let ended = world.run_to_end(60.0);
    assert_eq!(ended, (RunOutcome::Finished, 3, 0), "{}", world.story());
}

#[test]
fn one_that_stays_so_ends_the_run_in_bounded_time() {
    let mut world = World::under_way(8);
    world.mute = true;
    let (outcome, _, dropouts) = world.run_to_end(330.0);
    assert!(matches!(&outcome, RunOutcome::Failed(why) if why.contains("acknowledges")), "{outcome:?}");
    assert_eq!(dropouts, 0, "{}", world.story());
}

#[test]
fn a_robot_that_dies_while_driving_is_planned_around() {
    let mut world = World::ready(12, 0, show(3, 12, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.5);
    world.robots[5].dead = true;
    let (outcome, frames, dropouts) = world.run_to_end(90.0);
    assert_eq!((outcome, frames, dropouts), (RunOutcome::Finished, 3, 1), "{}", world.story());
}

#[test]
fn a_robot_that_dies_while_all_are_stopped_for_another_is_planned_around_too() {
    for other in [2, 4] {
        let mut world = World::ready(12, 0, show(4, 12, 0.3));
        world.play();
        world.run_until(10.0, started);
        world.run_for(1.2);
        world.robots[5].dead = true;
        world.run_until(3.0, |kind| matches!(kind, EventKind::Waiting { why: Trouble::Silent, .. }));
        world.run_for(0.3);
        world.robots[other].dead = true;
        let ended = world.run_to_end(90.0);
        assert_eq!(ended, (RunOutcome::Finished, 4, 2), "{}", world.story());
        assert!(world.closest_m >= CONTACT_M, "{other}: {}", world.closest_m);
    }
}

#[test]
fn a_robot_that_finds_something_in_its_way_leads_to_the_one_that_died_there() {
    let mut world = World::under_way(8);
    let towards = world.robots[4].at - world.robots[3].at;
    (world.robots[3].stuck, world.robots[4].dead) = (true, true);
    world.robots[3].blocked = Some(Blocked { gap_m: towards.length() - CONTACT_M, towards: towards.angle() });
    let (blocked, dead) = (world.robots[3].id, world.robots[4].id);
    let began = world.now;
    world.run_until(2.0, |kind| *kind == EventKind::Waiting { robot: blocked, why: Trouble::Blocked });
    world.run_until(2.0, |kind| *kind == EventKind::Dropout { robot: dead, why: Trouble::Silent });
    assert!((world.now - began).as_secs() < 1.6, "{}", world.story());
    (world.robots[3].stuck, world.robots[3].blocked) = (false, None);
    let ended = world.run_to_end(90.0);
    assert_eq!(ended, (RunOutcome::Finished, 3, 1), "{}", world.story());
}

#[test]
fn an_unknown_obstacle_is_driven_around_and_the_run_ends_in_bounded_time() {
    let mut world = World::under_way(8);
    world.robots[3].stuck = true;
    world.robots[3].blocked = Some(Blocked { gap_m: 0.002, towards: 0.3 });
    let (outcome, frames, dropouts) = world.run_to_end(120.0);
    assert_eq!((outcome, frames), (RunOutcome::Finished, 3), "{}", world.story());
    assert!((1..=2).contains(&dropouts) && world.now.as_secs() < 60.0, "{}", world.story());
}

#[test]
fn all_robots_wait_for_a_blocked_one_then_go_on_without_it() {
    let mut world = World::ready(8, 0, show(2, 8, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.0);
    world.robots[3].stuck = true;
    world.run_until(3.0, |kind| matches!(kind, EventKind::Waiting { .. }));
    world.run_for(1.0);
    assert_eq!(world.controller.snapshot(world.now).run.unwrap().wait.robots, [world.robots[3].id]);
    world.run_until(10.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.robots[3].stuck = false;
    let (outcome, frames, _) = world.run_to_end(90.0);
    assert_eq!((outcome, frames), (RunOutcome::Finished, 2), "{}", world.story());
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Rejoined(_))), 1, "{}", world.story());
}

#[test]
fn a_robot_that_never_drives_again_does_not_come_back() {
    let mut world = World::ready(8, 0, show(6, 8, 2.0));
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.0);
    world.robots[3].stuck = true;
    let ended = world.run_to_end(120.0);
    assert_eq!(ended, (RunOutcome::Finished, 6, 1), "{}", world.story());
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Rejoined(_))), 0, "{}", world.story());
    assert_eq!(world.robots[3].kept, None);
}

/// A robot that stands sees the approaching robots, and is blocked by them too.
#[test]
fn of_two_that_see_each_other_the_one_that_was_late_before_is_left_out() {
    let mut world = World::under_way(8);
    world.robots[4].stuck = true;
    world.robots[4].introduce();
    world.run_for(0.5);
    let way = world.robots[4].at - world.robots[3].at;
    for (robot, way) in [(3, way), (4, -way)] {
        let seen = Blocked { gap_m: way.length() - CONTACT_M, towards: way.angle() };
        world.robots[robot].blocked = Some(seen);
        world.robots[robot].introduce();
    }
    world.run_until(4.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.robots[3].blocked = None;
    let left_out = EventKind::Dropout { robot: world.robots[4].id, why: Trouble::Late };
    assert_eq!(world.count(|kind| *kind == left_out), 1, "{}", world.story());
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
}

#[test]
fn a_robot_that_was_late_is_waited_for() {
    let mut world = World::ready(8, 0, show(2, 8, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.0);
    world.robots[3].stuck = true;
    world.run_until(3.0, |kind| matches!(kind, EventKind::Waiting { .. }));
    world.run_for(1.0);
    world.robots[3].stuck = false;
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn an_unsure_robot_is_waited_for_until_it_is_sure() {
    let mut world = World::under_way(8);
    world.robots[3].unsure = true;
    world.robots[3].introduce();
    world.run_until(3.0, |kind| matches!(kind, EventKind::Waiting { .. }));
    world.run_for(1.0);
    assert_eq!(world.controller.snapshot(world.now).run.unwrap().wait.robots, [world.robots[3].id]);
    world.robots[3].unsure = false;
    world.robots[3].introduce();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Resumed)), 1, "{}", world.story());
}

#[test]
fn a_robot_that_is_never_sure_does_not_stop_the_show() {
    let mut world = World::under_way(8);
    world.robots[3].unsure = true;
    assert_eq!(world.run_to_end(240.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert!(world.count(|kind| matches!(kind, EventKind::Resumed)) > 1, "{}", world.story());
}

#[test]
fn a_robot_restarted_in_the_middle_is_taken_back() {
    let show = show(3, 8, 0.3);
    let mut world = World::ready(8, 0, show.clone());
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.5);
    world.robots[2].restart();
    let (outcome, frames, _) = world.run_to_end(90.0);
    assert_eq!((outcome, frames), (RunOutcome::Finished, 3), "{}", world.story());
    assert_eq!(world.lit(&show.frames[2]), 8);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn a_robot_restarted_in_a_picture_shows_it_again() {
    let show = show(3, 8, 3.0);
    let mut world = World::ready(8, 0, show.clone());
    world.play();
    world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.run_for(0.3);
    world.robots[2].restart();
    world.run_for(0.5);
    assert_eq!(world.lit(&show.frames[0]), 8);
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}

#[test]
fn a_broker_lost_in_the_middle_of_a_run_only_costs_time() {
    for gap_s in [0.5, 6.0] {
        let mut world = World::under_way(8);
        world.link(false);
        world.run_for(gap_s);
        assert_eq!(world.controller.state(), ControllerState::LinkLost);
        world.link(true);
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    }
}

#[test]
fn a_broker_lost_while_a_picture_stands_does_not_cut_its_air_time_short() {
    for (gap_s, wait_s) in [(0.5, 5.0), (8.0, 8.0)] {
        let mut world = World::ready(8, 0, show(2, 8, 5.0));
        world.play();
        let stood = world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. })).at;
        world.run_for(0.5);
        world.link(false);
        world.run_for(gap_s);
        world.link(true);
        let left = world.run_until(20.0, started).at - stood;
        assert!((wait_s - 0.5..wait_s + 1.5).contains(&left.as_secs()), "{left:?}\n{}", world.story());
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    }
}

#[test]
fn reports_of_robots_that_take_no_part_do_not_end_a_run() {
    let mut world = World::under_way(8);
    // The controller plans anew while strangers report places next to those of robots.
    world.robots[5].dead = true;
    for _ in 0..20 {
        for place in 0..48 {
            let aside = Vec2::unit(f64::from(place / 8) * 1.05) * 0.055;
            let at = world.robots[place as usize % 8].at + aside;
            let report = format!("stranger-{place} {:.4} {:.4}", at.x, at.y);
            world.inject("T/LightBot/UUID", report.as_bytes());
        }
        world.run_for(0.25);
    }
    let (outcome, frames, _) = world.run_to_end(240.0);
    assert_eq!((outcome, frames), (RunOutcome::Finished, 3), "{}", world.story());
}

#[test]
fn a_controller_restarted_in_the_middle_of_a_run_can_play_again() {
    let mut world = World::under_way(8);
    world.replace_controller();
    world.run_for(0.5);
    world.operate(Operation::Open(Arc::new(show(2, 8, 0.1)))).unwrap();
    world.play();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn all_robots_can_be_stopped_by_a_controller_that_did_not_start_them() {
    let mut world = World::under_way(8);
    world.replace_controller();
    world.run_for(0.3);
    world.operate(Operation::StopAll).unwrap();
    world.run_for(0.5);
    assert!(world.robots.iter().all(|robot| robot.running.is_none()));
}

#[test]
fn when_all_robots_die_the_run_ends() {
    let mut world = World::ready(4, 0, show(2, 4, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.robots.iter_mut().for_each(|robot| robot.dead = true);
    let (outcome, _, dropouts) = world.run_to_end(330.0);
    let why = "Show stopped in frame 1: no robot reports any more";
    assert_eq!((outcome, dropouts), (RunOutcome::Failed(why.into()), 0), "{}", world.story());
    assert_eq!(world.controller.snapshot(world.now).failure, Some(format!("{why}.")));
    assert_eq!(world.controller.snapshot(world.now).state, ControllerState::Aborting);
    world.robots[0].dead = false;
    world.run_for(0.5);
    assert!(world.robots[0].stops > 0, "who comes back must not keep a route");
    assert_eq!(world.controller.snapshot(world.now).state, ControllerState::Ready);
    world.operate(Operation::DismissFailure).unwrap();
    assert_eq!(world.controller.snapshot(world.now).failure, None);
}

#[test]
fn starting_again_takes_back_why_the_last_run_failed() {
    let mut world = World::ready(4, 0, show(2, 4, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.robots.iter_mut().for_each(|robot| robot.dead = true);
    world.run_to_end(330.0);
    world.robots.iter_mut().for_each(|robot| robot.dead = false);
    world.operate(Operation::Refresh).unwrap();
    world.run_for(3.0);
    world.play();
    assert_eq!(world.controller.snapshot(world.now).failure, None);
}

#[test]
fn without_a_broker_or_show_nothing_is_begun() {
    let mut world = World::new(2, 0);
    let play = Operation::Play { from: 0, missing: MissingPolicy::Refuse };
    assert_eq!(world.operate(play.clone()), Err(Refusal::NoShow));
    assert_eq!(world.operate(Operation::Abort), Err(Refusal::NoRun));
    world.operate(Operation::Open(Arc::new(show(2, 2, 0.0)))).unwrap();
    assert_eq!(
        world.operate(Operation::Play { from: 9, missing: MissingPolicy::Refuse }),
        Err(Refusal::NoSuchFrame { frame: 9, frames: 2 })
    );
    world.link(false);
    assert_eq!(world.operate(play), Err(Refusal::NotConnected));
    assert_eq!(world.operate(Operation::StopAll), Err(Refusal::NotConnected));
}

#[test]
fn robots_age_and_come_back() {
    let mut world = World::ready(3, 0, show(1, 3, 0.0));
    world.robots[0].dead = true;
    world.run_until(10.0, |kind| matches!(kind, EventKind::RobotStale(_)));
    world.run_until(40.0, |kind| matches!(kind, EventKind::RobotGone(_)));
    world.robots[0].dead = false;
    world.run_until(10.0, |kind| matches!(kind, EventKind::RobotBack(_)));
    assert_eq!(world.count(|kind| matches!(kind, EventKind::RobotStale(_))), 1);
}

#[test]
fn unexpected_arrivals_are_told_at_a_bounded_rate() {
    let mut world = World::ready(2, 0, show(1, 2, 0.0));
    for _ in 0..500 {
        world.inject("T/LightBot/Arrival", b"nobody 0.1 0.1");
    }
    let told = world.count(|kind| matches!(kind, EventKind::UnexpectedArrival(_)));
    assert!((1..=10).contains(&told), "{told}");
    assert_eq!(world.controller.counters().unexpected, 500);
}

#[test]
fn junk_changes_nothing() {
    let mut world = World::ready(8, 0, show(3, 8, 0.2));
    world.play();
    let mut dice = Dice(3);
    let topics = ["UUID", "Arrival", "Status", "Time", "Broadcast", "robot-1", "", "a/b"];
    for _ in 0..3_000 {
        let topic = format!("T/LightBot/{}", topics[dice.below(8) as usize]);
        let mut payload = match dice.below(4) {
            0 => Vec::new(),
            1 => format!("robot-{} {} NaN state=driving", dice.below(9) + 100, dice.next()).into_bytes(),
            2 => vec![0xff; dice.below(5_000) as usize],
            _ => (0..dice.below(60)).map(|_| dice.next() as u8).collect(),
        };
        if dice.below(4) == 0 {
            payload.extend_from_slice(b" 1e999 -inf route=99999999999999999999 off=NaN");
        }
        world.inject(&topic, &payload);
        if dice.below(3) == 0 {
            world.step();
        }
    }
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert!(world.controller.counters().junk > 500);
}

#[test]
fn the_same_inputs_make_the_same_run() {
    let story = || {
        let mut world = World::ready(10, 2, show(3, 10, 0.2));
        world.loss = 10;
        world.play();
        world.run_to_end(200.0);
        world.story()
    };
    assert_eq!(story(), story());
}
