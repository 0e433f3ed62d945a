//! Robots that speak only the original's protocol, alone and together with ours.

mod fleet;

use fleet::{World, show};
use lightbots_base::Vec2;
use lightbots_control::{EventKind, MissingPolicy, Operation, RunOutcome};

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

#[test]
fn originals_play_a_show_without_touching() {
    let show = show(3, 9, 0.1);
    let mut world = World::ready(9, 9, show.clone());
    world.play();
    assert_eq!(world.run_to_end(300.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.lit(&show.frames[2]), 9);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn a_mixed_fleet_plays_a_show_without_touching() {
    let show = show(3, 12, 0.1);
    let mut world = World::ready(12, 4, show.clone());
    world.play();
    assert_eq!(world.run_to_end(300.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.lit(&show.frames[2]), 12);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn lost_targets_are_said_again() {
    let show = show(2, 6, 0.1);
    let mut world = World::ready(6, 6, show.clone());
    world.loss = 20;
    world.play();
    assert_eq!(world.run_to_end(300.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

/// An original robot that does not receive its target in the second of two frames. `way` leads from its pixel in the
/// first frame to that target, which is returned. The robot still receives no messages.
fn lost_target(way: Vec2) -> (World, Vec2) {
    let mut show = show(2, 1, 0.5);
    let goal = show.frames[0].pixels[0].at + way;
    show.frames[1].pixels[0].at = goal;
    let mut world = World::ready(1, 1, show);
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.deaf = vec![0];
    world.run_until(60.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(0.05);
    (world, goal)
}

#[test]
fn a_robot_near_its_goal_is_not_there_before_it_reports_so() {
    // The controller must not take this robot, 18 mm from its goal, for arrived, or other robots pass too close to it.
    let (mut world, goal) = lost_target(Vec2::new(0.018, 0.0));
    let at = world.robots[0].at;
    world.inject("T/LightBot/UUID", format!("robot-0 {} {}", at.x, at.y).as_bytes());
    world.deaf.clear();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert!(world.robots[0].at.distance(goal) < 0.01, "{:?} for {goal:?}", world.robots[0].at);
}

#[test]
fn a_robot_that_reports_arrival_far_from_its_goal_is_sent_its_target_again() {
    // The reported arrival may belong to the target before. Then the robot stands 25 mm from its goal, where others
    // pass.
    let (mut world, goal) = lost_target(Vec2::new(0.06, 0.0));
    let said = goal - Vec2::new(0.018, 0.018);
    world.inject("T/LightBot/Arrival", format!("robot-0 {} {}", said.x, said.y).as_bytes());
    world.deaf.clear();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert!(world.robots[0].at.distance(goal) < 0.015, "{:?} for {goal:?}", world.robots[0].at);
}

#[test]
fn a_robot_lifted_while_all_stand_is_planned_from_where_it_was_put_down() {
    let mut world = World::ready(6, 6, show(2, 6, 5.0));
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.robots[2].at += Vec2::new(0.3, 0.4);
    world.run_until(4.0, |kind| matches!(kind, EventKind::Misaligned { .. }));
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Replanning { .. })), 1);
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn a_robot_that_was_not_heard_when_it_was_switched_on_is_found_soon() {
    // A request every two seconds would be too rare: where every fifth message is lost, a robot could stay unknown
    // until the show begins.
    let mut world = World::new(6, 6);
    world.robots[5].dead = true;
    world.run_for(3.0);
    assert_eq!(world.controller.snapshot(world.now).robots.len(), 5);
    world.robots[5].dead = false;
    world.run_for(0.7);
    assert_eq!(world.controller.snapshot(world.now).robots.len(), 6);
}

#[test]
fn a_dead_original_is_gone_round() {
    let mut world = World::ready(5, 5, show(2, 5, 0.1));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(0.5);
    let driving = world.robots.iter().position(|robot| robot.target.is_some()).unwrap();
    world.robots[driving].dead = true;
    let (outcome, frames, dropouts) = world.run_to_end(300.0);
    assert_eq!((outcome, frames, dropouts), (RunOutcome::Finished, 2, 1), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn pause_and_resume_work_with_originals() {
    let mut world = World::ready(4, 4, show(2, 4, 0.1));
    world.operate(Operation::Play { from: 0, missing: MissingPolicy::LeaveOut }).unwrap();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(1.0);
    world.operate(Operation::Pause).unwrap();
    world.run_for(20.0);
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(200.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn a_robot_that_keeps_others_waiting_is_named_before_it_is_given_up() {
    let mut world = World::ready(5, 5, show(2, 5, 0.1));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(0.5);
    let driving = world.robots.iter().position(|robot| robot.target.is_some()).unwrap();
    world.robots[driving].dead = true;
    let id = world.robots[driving].id;
    world.run_until(10.0, |kind| matches!(kind, EventKind::Waiting { robot, .. } if *robot == id));
    let run = world.controller.snapshot(world.now).run.unwrap();
    assert_eq!(run.wait.robots, [id], "{}", world.story());
    assert!((0.1..1.0).contains(&run.progress.share), "{}", run.progress.share);
    world.run_until(10.0, |kind| matches!(kind, EventKind::Dropout { robot, .. } if *robot == id));
}

#[test]
fn arrivals_are_spread_from_the_first_to_the_last_whatever_stages_it_takes() {
    let mut world = World::ready(12, 4, show(1, 12, 0.1));
    world.play();
    let begun = world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. })).at;
    let event = world.run_until(100.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    let EventKind::FrameReached { spread, .. } = event.kind else { unreachable!() };
    let drives = world.count(|kind| matches!(kind, EventKind::TransitionStarted { .. }));
    assert!(drives >= 2, "ours and the originals drive one after the other\n{}", world.story());
    assert!(spread.as_secs() > 1.0 && spread < event.at - begun, "{}\n{}", spread.as_secs(), world.story());
}

#[test]
fn pins_hold_for_originals_and_ours_alike() {
    let show = show(2, 8, 0.1);
    let mut world = World::ready(8, 4, show.clone());
    // Robots 4 to 7 are originals.
    for (pixel, robot) in [(0, 7), (3, 1), (6, 4)] {
        let robot = Some(world.robots[robot].id);
        world.operate(Operation::Pin { pixel, robot }).unwrap();
    }
    world.play();
    assert_eq!(world.run_to_end(100.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
    assert_eq!(world.lit(&show.frames[1]), 8);
    for (pixel, robot) in [(0, 7), (3, 1), (6, 4)] {
        let (at, goal) = (world.robots[robot].at, show.frames[1].pixels[pixel].at);
        assert!(at.distance(goal) < 0.021, "pixel {pixel}: {at:?} for {goal:?}");
    }
}

#[test]
fn a_pause_keeps_originals_where_they_are() {
    let mut world = World::ready(6, 6, show(1, 6, 0.1));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(1.5);
    world.operate(Operation::Pause).unwrap();
    world.run_for(1.0);
    let places = |world: &World| world.robots.iter().map(|robot| robot.at).collect::<Vec<_>>();
    let before = places(&world);
    world.run_for(10.0);
    assert_eq!(places(&world), before);
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(100.0), (RunOutcome::Finished, 1, 0), "{}", world.story());
}

#[test]
fn a_picture_stays_as_long_as_it_should_though_all_robots_are_asked_anew_meanwhile() {
    let mut world = World::ready(5, 3, show(2, 5, 20.0));
    world.play();
    let stands = world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. })).at;
    world.run_for(5.0);
    world.inject("T/LightBot/Arrival", b"robot-4 0.9 0.9");
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Misaligned { .. })), 1);
    let leaves = world.run_until(60.0, |kind| matches!(kind, EventKind::TransitionStarted { .. })).at;
    assert!((leaves - stands).as_secs() > 19.9, "{}", world.story());
    assert_eq!(world.run_to_end(100.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn after_an_outage_an_original_is_stopped_where_it_reports_that_it_is() {
    let mut world = World::ready(1, 1, show(2, 1, 0.5));
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(0.3);
    world.link(false);
    world.operate(Operation::Abort).unwrap();
    let left = world.robots[0].at;
    world.run_for(0.5);
    let driven_m = world.robots[0].at.distance(left);
    world.link(true);
    assert!(driven_m > 0.05 && !world.to_robots().iter().any(|message| message.contains("TARGET")));
    world.run_for(3.0);
    let at = world.robots[0].at;
    assert!(at.distance(left) > driven_m - 0.01, "it went back");
    world.run_for(1.0);
    assert_eq!(world.robots[0].at, at, "it drives");
}
