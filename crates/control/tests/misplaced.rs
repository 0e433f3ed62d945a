//! Robots that stand elsewhere than the plan has them, because people lifted them or their reports were false.

mod fleet;

use fleet::{World, show};
use lightbots_base::Vec2;
use lightbots_control::{EventKind, RunOutcome, Trouble};

fn is_misaligned(kind: &EventKind) -> bool {
    matches!(kind, EventKind::Misaligned { .. })
}

/// Six robots that stand in the first of two frames, for five seconds.
fn standing() -> World {
    let mut world = World::ready(6, 0, show(2, 6, 5.0));
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world
}

#[test]
fn a_robot_that_was_lifted_in_a_frame_is_planned_from_where_it_was_put_down() {
    let mut world = standing();
    world.robots[2].at += Vec2::new(0.3, 0.4);
    world.run_until(2.1, is_misaligned);
    assert_eq!(world.count(|kind| matches!(kind, EventKind::Replanning { .. })), 1);
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert_eq!(world.count(is_misaligned), 1, "{}", world.story());
}

#[test]
fn a_robot_that_stands_a_little_off_is_not_planned_again() {
    let mut world = standing();
    world.robots[2].at += Vec2::new(0.015, 0.0);
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert_eq!(world.count(is_misaligned), 0, "{}", world.story());
}

#[test]
fn a_robot_that_is_somewhere_else_each_time_drops_out() {
    let mut show = show(2, 6, 60.0);
    show.frames[1].air_time_s = 0.1;
    let mut world = World::ready(6, 0, show);
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    for _ in 0..6 {
        world.robots[2].at += Vec2::new(0.08, 0.0);
        world.run_for(3.0);
    }
    let why = |kind: &EventKind| matches!(kind, EventKind::Dropout { why: Trouble::Missed, .. });
    assert_eq!(world.count(why), 1, "{}", world.story());
}
