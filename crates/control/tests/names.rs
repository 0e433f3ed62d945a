//! Which robot names take part in a show, and what happens to a name that two robots share.

mod fleet;

use fleet::robot::Robot;
use fleet::{World, frame, show};
use lightbots_base::Vec2;
use lightbots_control::{Config, EventKind, MissingPolicy, Operation, Refusal, RunOutcome, Trouble};
use std::sync::Arc;

/// The far corner of the floor, where no pixel is.
const CORNER: Vec2 = Vec2 { x: 1.3, y: -1.3 };

/// Plays a show of four frames. One robot dies, and after that another robot reports for the first time. Returns the
/// outcome of the run and how many robots joined it.
fn with_a_late_robot(config: Config) -> (World, (RunOutcome, usize, usize), usize) {
    let mut world = World::with(config, 8, 0);
    world.operate(Operation::Open(Arc::new(show(4, 8, 0.3)))).unwrap();
    world.run_for(1.0);
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(1.0);
    world.robots[1].dead = true;
    world.run_until(10.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    let mut late = Robot::new(77, CORNER, false);
    late.introduce();
    world.robots.push(late);
    let ended = world.run_to_end(90.0);
    let joined = world.count(|kind| matches!(kind, EventKind::Rejoined(_)));
    (world, ended, joined)
}

#[test]
fn a_listed_robot_takes_the_place_of_a_dead_one() {
    let names = (0..8).chain([77]).map(|number| Robot::new(number, CORNER, false).id);
    let config = Config { admitted: Some(names.collect()), ..Config::default() };
    let (world, ended, joined) = with_a_late_robot(config);
    assert_eq!((ended, joined), ((RunOutcome::Finished, 4, 1), 1), "{}", world.story());
    assert!(world.lit(&frame(3, 8, 0.3)) >= 7, "{}", world.story());
}

#[test]
fn without_a_list_a_name_that_is_first_heard_during_a_run_takes_no_place() {
    let (world, ended, joined) = with_a_late_robot(Config::default());
    assert_eq!((ended, joined), ((RunOutcome::Finished, 4, 1), 0), "{}", world.story());
    assert_eq!(world.robots[8].at, CORNER);
}

#[test]
fn forged_names_take_no_place_where_names_are_listed() {
    let names = (0..8).map(|number| Robot::new(number, CORNER, false).id);
    let config = Config { admitted: Some(names.collect()), ..Config::default() };
    let mut world = World::with(config, 8, 0);
    world.operate(Operation::Open(Arc::new(show(2, 9, 0.1)))).unwrap();
    // A thousand forged names report from the far edge of the floor.
    for number in 0..1_000 {
        world.inject("T/LightBot/UUID", format!("forged-{number} 1.4 -1.4").as_bytes());
    }
    world.run_for(1.0);
    let play = |missing| Operation::Play { from: 0, missing };
    let refused = world.operate(play(MissingPolicy::Refuse)).unwrap_err();
    assert!(matches!(refused, Refusal::TooFewRobots { pixels: 9, robots: 8, .. }), "{refused:?}");
    world.operate(play(MissingPolicy::LeaveOut)).unwrap();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

/// Another robot reports under the name of robot 3, from `CORNER`.
fn pose(world: &mut World, seconds: f64) {
    let name = world.robots[3].id;
    for _ in 0..(seconds / 0.25) as usize {
        world.inject("T/LightBot/UUID", format!("{name} {} {}", CORNER.x, CORNER.y).as_bytes());
        world.run_for(0.25);
    }
}

#[test]
fn two_robots_of_one_name_are_kept_out_and_the_show_plays_on() {
    let mut world = World::ready(8, 0, show(3, 8, 0.3));
    let name = world.robots[3].id;
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    pose(&mut world, 5.0);
    let is_named = |kind: &EventKind| matches!(kind, EventKind::NameShared { robot, .. } if *robot == name);
    assert_eq!(world.count(is_named), 1, "{}", world.story());
    let drops = EventKind::Dropout { robot: name, why: Trouble::Shared };
    assert_eq!(world.count(|kind| *kind == drops), 1, "{}", world.story());
    assert_eq!(world.run_to_end(120.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
    assert!(world.closest_m > 0.054, "{}", world.closest_m);
}

#[test]
fn two_robots_of_one_name_that_are_near_each_other_are_told_apart_by_their_clocks() {
    let mut world = World::ready(8, 0, show(3, 8, 0.3));
    let (name, near) = (world.robots[3].id, world.robots[3].at + Vec2::new(0.0, 0.15));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    // The clock of the first robot is far ahead of that of the second, which has just been switched on.
    for half_s in 0..10u64 {
        for clock_us in [900_000_000, 0] {
            let asked = clock_us + half_s * 500_000;
            world.inject("T/LightBot/Time", format!("{name} {asked}").as_bytes());
        }
        world.inject("T/LightBot/UUID", format!("{name} {} {}", near.x, near.y).as_bytes());
        world.run_for(0.5);
    }
    let drops = EventKind::Dropout { robot: name, why: Trouble::Shared };
    assert_eq!(world.count(|kind| *kind == drops), 1, "{}", world.story());
    assert_eq!(world.run_to_end(120.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
}

#[test]
fn two_robots_of_one_name_take_no_part_until_one_of_them_has_gone() {
    let mut world = World::ready(8, 0, show(2, 8, 0.1));
    pose(&mut world, 4.0);
    let play = Operation::Play { from: 0, missing: MissingPolicy::Refuse };
    let refused = world.operate(play.clone()).unwrap_err();
    assert!(matches!(refused, Refusal::TooFewRobots { robots: 7, .. }), "{refused:?}");
    world.run_until(60.0, |kind| matches!(kind, EventKind::NameUnique(_)));
    world.operate(play).unwrap();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn a_robot_that_is_not_listed_wants_to_join_and_joins_once_it_is() {
    let mut world = World::ready(6, 0, show(3, 6, 0.2));
    let names = |count| Some((0..count).map(|number| Robot::new(number, CORNER, false).id).collect());
    world.operate(Operation::Admit(names(6))).unwrap();
    let mut stranger = Robot::new(6, CORNER, false);
    stranger.introduce();
    world.robots.push(stranger);
    world.run_for(3.0);
    let wants = |kind: &EventKind| matches!(kind, EventKind::WantsToJoin(_));
    assert_eq!(world.count(wants), 1, "{}", world.story());
    let admitted = |world: &World| {
        world.controller.snapshot(world.now).robots.iter().filter(|robot| robot.is_admitted).count()
    };
    assert_eq!(admitted(&world), 6);
    world.operate(Operation::Admit(names(7))).unwrap();
    assert_eq!(admitted(&world), 7);
    world.operate(Operation::Admit(None)).unwrap();
    world.play();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}
