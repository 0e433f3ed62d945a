//! The controller is killed in a run, and another controller continues the run from the journal.

mod fleet;

use fleet::{Dice, World, reached, show, started};
use lightbots_base::{RobotId, Span};
use lightbots_control::{ControllerState, EventKind, JOURNAL_OUTDATED, OnReturn, Operation, RunOutcome};
use lightbots_show::{Identity, Show};

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

/// A run of `count` robots, the last `originals` of which are original ones, with a journal.
fn journalled(count: usize, originals: usize, show: Show) -> World {
    let mut world = World::ready(count, originals, show);
    world.controller.keep_journal();
    world.play();
    world
}

/// A run whose controller is killed after `after_s`, and is then absent for `away_s`.
fn killed(show: Show, after_s: f64, away_s: f64) -> World {
    let count = show.frames[0].pixels.len();
    let mut world = journalled(count, 0, show);
    world.run_for(after_s);
    world.kill_controller();
    world.run_for(away_s);
    world
}

fn is_taken_up(kind: &EventKind) -> bool {
    matches!(kind, EventKind::TakenUp { .. })
}

#[test]
fn a_run_that_was_killed_at_any_moment_is_found_and_finished() {
    let mut dice = Dice(26);
    let mut last_s = 0.0;
    for number in 0..40 {
        let mut show = show(4, 9, 0.6);
        show.identity = if number % 2 == 0 { Identity::Any } else { Identity::Fixed };
        let after_s = 0.05 + dice.below(16_000) as f64 / 1e3;
        let away_s = 0.2 + dice.below(6_000) as f64 / 1e3;
        let mut world = killed(show.clone(), after_s, away_s);
        let story =
            |world: &World| format!("run {number}, killed at {after_s} s for {away_s} s:\n{}", world.story());
        if !world.return_controller(OnReturn::GoOrAsk) {
            assert_eq!(
                world.count(|kind| matches!(kind, EventKind::RunEnded { .. })),
                1,
                "{}",
                story(&world)
            );
            continue;
        }
        last_s = f64::max(last_s, after_s);
        assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 4, 0), "{}", story(&world));
        assert_eq!(world.lit(&show.frames[3]), 9, "{}", story(&world));
        assert!(world.closest_m >= CONTACT_M, "{} m; {}", world.closest_m, story(&world));
        assert_eq!(world.count(is_taken_up), 1);
        let reached = world.count(|kind| matches!(kind, EventKind::FrameReached { .. }));
        assert_eq!(reached, 4, "a frame is not played twice, and none is left out: {}", story(&world));
    }
    assert!(last_s > 10.0, "runs were killed in all frames");
}

#[test]
fn a_run_is_taken_up_more_than_once() {
    let mut world = killed(show(3, 6, 0.5), 3.0, 1.0);
    for _ in 0..3 {
        assert!(world.return_controller(OnReturn::Go));
        world.run_for(1.3);
        world.kill_controller();
        world.run_for(2.5);
    }
    assert!(world.return_controller(OnReturn::Go));
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.count(is_taken_up), 4);
}

#[test]
fn the_operator_is_asked_after_a_long_time_or_where_that_is_wanted() {
    for (away_s, on_return) in [(40.0, OnReturn::GoOrAsk), (1.0, OnReturn::Ask)] {
        let mut world = killed(show(3, 6, 0.5), 3.0, away_s);
        assert!(world.return_controller(on_return));
        world.run_for(20.0);
        assert_eq!(world.controller.state(), ControllerState::LinkLost, "{}", world.story());
        let places: Vec<_> = world.robots.iter().map(|robot| robot.at).collect();
        world.run_for(5.0);
        assert!(world.robots.iter().map(|robot| robot.at).eq(places), "robots drive");
        world.operate(Operation::GoOn).unwrap();
        assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    }
    let mut world = killed(show(3, 6, 0.5), 3.0, 40.0);
    assert!(world.return_controller(OnReturn::Go));
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}

#[test]
fn the_operator_is_asked_if_entries_of_the_journal_were_lost() {
    for (on_return, asks) in [(OnReturn::GoOrAsk, true), (OnReturn::Go, false)] {
        let mut world = killed(show(3, 6, 0.5), 3.0, 1.0);
        let (at, mark) = JOURNAL_OUTDATED;
        world.journal[at] = mark;
        assert!(world.return_controller(on_return));
        world.run_for(5.0);
        assert_eq!(world.controller.state() == ControllerState::LinkLost, asks, "{}", world.story());
        if asks {
            world.operate(Operation::GoOn).unwrap();
        }
        assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    }
}

#[test]
fn a_run_that_does_not_go_on_leaves_robots_that_stand() {
    for away_s in [0.3, 3.0] {
        let mut world = killed(show(3, 6, 0.5), 3.0, away_s);
        assert!(world.return_controller(OnReturn::Stop));
        world.run_for(2.2);
        assert!(world.robots.iter().all(|robot| robot.running.is_none()), "{}", world.story());
        world.run_for(2.0);
        assert_eq!(world.controller.state(), ControllerState::Ready);
        world.play();
        assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    }
}

#[test]
fn pauses_pins_and_lost_robots_are_kept() {
    let mut world = World::ready(7, 0, show(4, 7, 0.5));
    let pinned = RobotId::new("robot-5").unwrap();
    world.operate(Operation::Pin { pixel: 0, robot: Some(pinned) }).unwrap();
    world.controller.keep_journal();
    world.play();
    world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.robots[2].dead = true;
    world.run_until(30.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.run_until(30.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.operate(Operation::Pause).unwrap();
    world.kill_controller();
    world.run_for(3.0);
    assert!(world.return_controller(OnReturn::Go));
    world.run_for(10.0);
    let snapshot = world.controller.snapshot(world.now);
    assert_eq!(snapshot.state, ControllerState::Paused, "{}", world.story());
    assert_eq!(snapshot.run.unwrap().dropouts, 1);
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 4, 1), "{}", world.story());
    let shown =
        |id| world.controller.snapshot(world.now).robots.iter().find(|robot| robot.id == id).unwrap().pixel;
    assert_eq!((shown(pinned), shown(RobotId::new("robot-2").unwrap())), (Some(0), None));
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn robots_that_died_meanwhile_drop_out_and_are_driven_around() {
    let mut world = killed(show(4, 9, 0.5), 4.5, 2.5);
    world.robots[4].dead = true;
    assert!(world.return_controller(OnReturn::Go));
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 4, 1), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn a_drive_that_did_not_begin_has_brought_none_to_its_goal() {
    let mut world = journalled(6, 0, show(3, 6, 0.5));
    while !world.robots.iter().all(|robot| robot.kept.is_some()) {
        world.step();
    }
    // Robot 2 never confirms START. The drive is called off when that robot drops out.
    world.deaf = vec![2];
    world.run_until(60.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    assert_eq!(world.count(started), 0, "{}", world.story());
    world.kill_controller();
    assert!(world.return_controller(OnReturn::Go));
    are_where_they_stand(&world);
}

#[test]
fn a_drive_that_was_broken_off_has_brought_none_to_its_goal() {
    let mut world = journalled(7, 0, show(3, 6, 0.5));
    world.run_until(20.0, started);
    world.run_for(0.8);
    world.robots[2].dead = true;
    world.run_until(20.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    // Waits until STOP has discarded the kept routes, and then until robots keep routes of the new plan.
    for keeps in [false, true] {
        let is_any_kept =
            |world: &World| world.robots.iter().any(|robot| !robot.dead && robot.kept.is_some());
        let until = world.now + Span::from_millis(20_000);
        while is_any_kept(&world) != keeps {
            assert!(world.now < until, "{}", world.story());
            world.step();
        }
    }
    world.kill_controller();
    assert!(world.return_controller(OnReturn::Go));
    are_where_they_stand(&world);
}

/// Asserts that the new controller has all live robots within 1 mm of where they stand.
fn are_where_they_stand(world: &World) {
    for row in world.controller.snapshot(world.now).robots {
        let robot = world.robots.iter().find(|robot| robot.id == row.id).unwrap();
        let (stands, at) = (robot.at, row.reported.at.unwrap());
        assert!(robot.dead || at.distance(stands) < 1e-3, "{} stands at {stands:?}, not {at:?}", row.id);
    }
}

/// On a leg of TARGETs all other robots stand. The journal holds the places that they reported before the show, and the
/// leg says where they stand now.
#[test]
fn robots_that_wait_for_originals_are_where_the_leg_has_them() {
    let mut world = journalled(6, 2, show(3, 6, 0.5));
    world.run_until(30.0, reached(0));
    world.run_until(30.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    while world.robots.iter().all(|robot| robot.target.is_none()) {
        world.step();
    }
    assert!(world.robots.iter().all(|robot| robot.running.is_none()), "{}", world.story());
    world.kill_controller();
    assert!(world.return_controller(OnReturn::Go));
    for robot in world.robots.iter().filter(|robot| !robot.original) {
        let rows = world.controller.snapshot(world.now).robots;
        let expected = rows.iter().find(|row| row.id == robot.id).unwrap().reported.at.unwrap();
        assert!(expected.distance(robot.at) < 1e-3, "{} is expected at {expected:?}", robot.id);
    }
}

/// The journal does not say how far a robot that knows TARGET only is on its straight drives.
#[test]
fn an_original_that_died_meanwhile_is_anywhere_on_its_drives() {
    for dies in 4..8 {
        let mut world = journalled(8, 4, show(3, 8, 0.5));
        world.run_until(60.0, reached(0));
        while world.robots[dies].target.is_none() {
            world.step();
        }
        world.run_for(0.3);
        world.kill_controller();
        world.robots[dies].dead = true;
        world.run_for(3.0);
        assert!(world.return_controller(OnReturn::Go));
        let (outcome, frames, _) = world.run_to_end(200.0);
        assert_eq!((outcome, frames), (RunOutcome::Finished, 3), "{dies}: {}", world.story());
        assert!(world.closest_m >= CONTACT_M, "{dies}: {} m\n{}", world.closest_m, world.story());
    }
}

/// The disk was full from the first frame on. Robots stand in the third when the controller returns, and one of them
/// has died there.
#[test]
fn a_robot_that_died_where_no_journal_has_it_is_looked_for_at_the_free_place_of_a_frame() {
    for dies in 0..9 {
        let mut world = journalled(9, 0, show(4, 9, 0.5));
        world.run_until(30.0, reached(0));
        world.run_until(30.0, started);
        world.run_for(0.5);
        let journal = world.journal.clone();
        world.run_until(30.0, reached(2));
        world.kill_controller();
        world.robots[dies].dead = true;
        world.run_for(8.0);
        world.journal = journal;
        assert!(world.return_controller(OnReturn::Go));
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 4, 1), "{}", world.story());
        assert!(world.closest_m >= CONTACT_M, "{dies}: {} m\n{}", world.closest_m, world.story());
    }
}

/// Robot 8 does not receive START, so that it is postponed again and again. Another robot has confirmed the first
/// moment, and its link breaks: it drives alone.
#[test]
fn a_robot_that_began_alone_and_is_silent_is_not_where_it_reported() {
    for cut in 0..8 {
        let mut world = killed(show(3, 9, 0.5), 1.0, 1.0);
        assert!(world.return_controller(OnReturn::Go));
        world.run_until(30.0, reached(0));
        world.deaf = vec![8];
        while world.robots[cut].kept.as_ref().is_none_or(|(_, starts)| starts.is_none()) {
            world.step();
        }
        world.run_for(0.03);
        world.cut = vec![cut];
        world.run_until(60.0, |kind| matches!(kind, EventKind::Dropout { .. }));
        world.deaf.clear();
        assert_eq!(world.run_to_end(90.0).0, RunOutcome::Finished, "{}", world.story());
        assert!(world.closest_m >= CONTACT_M, "{cut}: {} m\n{}", world.closest_m, world.story());
    }
}

#[test]
fn originals_stand_before_the_run_goes_on() {
    let mut world = journalled(6, 2, show(3, 6, 0.5));
    world.run_until(30.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.run_for(1.5);
    world.kill_controller();
    world.run_for(3.0);
    assert!(world.return_controller(OnReturn::Go));
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
}

#[test]
fn a_preview_and_a_loop_are_taken_up_as_they_were() {
    let mut world = World::ready(6, 0, show(2, 6, 0.2));
    world.controller.keep_journal();
    world.operate(Operation::Preview { frame: 1, missing: Default::default() }).unwrap();
    world.run_for(2.0);
    world.kill_controller();
    world.run_for(1.0);
    assert!(world.return_controller(OnReturn::Go));
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 1, 0), "{}", world.story());
    world.operate(Operation::Loop(true)).unwrap();
    world.play();
    world.run_for(15.0);
    world.kill_controller();
    world.run_for(1.0);
    assert!(world.return_controller(OnReturn::Go));
    world.run_for(15.0);
    assert_eq!(world.count(|kind| matches!(kind, EventKind::RunEnded { .. })), 1, "it loops on");
    assert!(world.controller.snapshot(world.now).looping);
}

/// Some robots may have stopped by themselves by then. If the others only held, they would drive into those robots.
#[test]
fn robots_that_still_drive_stop_at_once_where_others_may_have_stopped() {
    let mut world = journalled(9, 0, show(3, 9, 0.6));
    world.run_until(10.0, started);
    world.run_for(1.0);
    world.kill_controller();
    world.run_for(1.6);
    assert!(world.robots.iter().any(|robot| robot.running.is_some()));
    assert!(world.return_controller(OnReturn::GoOrAsk));
    world.run_for(0.2);
    assert!(world.robots.iter().all(|robot| robot.stops > 0), "{}", world.story());
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}
