//! Robots that speak only the original's protocol, alone and among ours.

mod fleet;

use fleet::{World, show};
use lightbots_control::{EventKind, MissingPolicy, Operation, Outcome};

const CONTACT_M: f64 = 0.054;

#[test]
fn originals_play_a_show_without_touching() {
    let show = show(3, 9, 0.1);
    let mut world = World::ready(9, 9, show.clone());
    world.play();
    assert_eq!(world.run_to_end(300.0), (Outcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.lit(&show.frames[2]), 9);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn a_mixed_fleet_plays_a_show_without_touching() {
    let show = show(3, 12, 0.1);
    let mut world = World::ready(12, 4, show.clone());
    world.play();
    assert_eq!(world.run_to_end(300.0), (Outcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.lit(&show.frames[2]), 12);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn lost_targets_are_said_again() {
    let show = show(2, 6, 0.1);
    let mut world = World::ready(6, 6, show.clone());
    world.loss = 20;
    world.play();
    assert_eq!(world.run_to_end(300.0), (Outcome::Finished, 2, 0), "{}", world.story());
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
    assert_eq!((outcome, frames, dropouts), (Outcome::Finished, 2, 1), "{}", world.story());
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
    assert_eq!(world.run_to_end(200.0), (Outcome::Finished, 2, 0), "{}", world.story());
}
