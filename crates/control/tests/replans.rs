//! Plans that are made while robots stand on the floor and wait: how long they may take, and what happens if they take
//! longer.

mod fleet;

use fleet::{World, reached, show};
use lightbots_base::{PathRef, Span};
use lightbots_control::{EventKind, RunOutcome};
use lightbots_wire::Route;

/// A run of two frames in which a robot dies on the way to the second. The next `slow_plans` plans take too long.
fn run_with_a_death(robots: usize, slow_plans: usize) -> (World, RunOutcome, usize) {
    let mut world = World::ready(robots, 0, show(2, robots, 0.3));
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 1, .. }));
    world.run_for(0.5);
    world.robots[1].dead = true;
    world.slow_plans = slow_plans;
    let (outcome, _, dropouts) = world.run_to_end(120.0);
    (world, outcome, dropouts)
}

#[test]
fn a_replan_may_take_a_second_and_the_first_plan_as_long_as_it_needs() {
    let (world, outcome, dropouts) = run_with_a_death(8, 0);
    assert_eq!((outcome, dropouts), (RunOutcome::Finished, 1), "{}", world.story());
    let (first, replans) = world.budgets.split_first().unwrap();
    assert_eq!(*first, None);
    assert!(replans.contains(&Some(Span::from_millis(1_000))), "{:?}", world.budgets);
}

/// After a plan that took too long, the next one keeps clear of fewer guessed places, or leads to the next frame. At
/// last the run stops with a reason.
#[test]
fn a_replan_that_takes_too_long_is_followed_by_another_or_by_a_named_end() {
    let (world, outcome, _) = run_with_a_death(8, 1);
    assert!(
        matches!(outcome, RunOutcome::Finished | RunOutcome::Failed(_)),
        "{outcome:?}: {}",
        world.story()
    );
    let given_up = |kind: &EventKind| matches!(kind, EventKind::PlanFailed { .. });
    assert!(world.events.iter().any(|event| given_up(&event.kind)), "{}", world.story());
    let (world, outcome, _) = run_with_a_death(8, usize::MAX);
    let RunOutcome::Failed(why) = outcome else { panic!("{outcome:?}: {}", world.story()) };
    assert!(why.contains("Show stopped in frame 2"), "{why}");
    let replans = world.budgets.iter().filter(|budget| budget.is_some()).count();
    assert!((1..=4).contains(&replans), "{replans} replans: {}", world.story());
}

/// Moves a robot that dropped out onto another robot's route, and lets it report that place.
fn put_on(world: &mut World, robot: usize, route: &Route) {
    let path = PathRef::new(route.start, &route.pieces);
    world.robots[robot].at = path.at(path.duration() * 7 / 10).position;
    world.robots[robot].introduce();
}

#[test]
fn a_robot_that_is_put_on_a_path_in_a_drive_is_driven_around() {
    let starts = |kind: &EventKind| matches!(kind, EventKind::TransitionStarted { frame: 0, .. });
    let mut world = World::ready(8, 0, show(2, 8, 0.5));
    world.play();
    world.run_until(20.0, starts);
    world.run_for(0.5);
    world.robots[1].dead = true;
    world.run_until(20.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.run_until(20.0, starts);
    world.run_for(0.5);
    world.robots[1].dead = false;
    let (route, _) = world.robots[3].running.clone().unwrap();
    put_on(&mut world, 1, &route);
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 2, 1), "{}", world.story());
    assert!(world.closest_m >= 0.054, "{}: {}", world.closest_m, world.story());
}

#[test]
fn a_robot_that_is_put_on_a_path_before_its_start_is_driven_around() {
    let mut world = World::ready(8, 0, show(3, 8, 1.5));
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 1, .. }));
    world.run_for(0.5);
    world.robots[1].stuck = true;
    world.run_until(20.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.run_until(20.0, reached(1));
    world.run_for(0.5);
    let (route, _) = world.robots[2].kept.clone().unwrap();
    // Distances count from here, because robots without sensors drove into the stuck robot.
    world.closest_m = f64::INFINITY;
    put_on(&mut world, 1, &route);
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
    assert!(world.closest_m >= 0.054, "{}: {}", world.closest_m, world.story());
}
