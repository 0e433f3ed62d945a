//! Many robots fall silent at once, because the link is lost and not the robots.

mod fleet;

use fleet::{World, show, started};
use lightbots_base::Span;
use lightbots_control::{Config, ControllerState, EventKind, Operation, Refusal, RunOutcome};
use std::sync::Arc;

fn lost(kind: &EventKind) -> bool {
    matches!(kind, EventKind::LinkLost { .. })
}

/// The broker holds all messages back for this time.
fn freeze(world: &mut World, seconds: f64) {
    world.frozen = true;
    world.run_for(seconds);
    world.frozen = false;
}

#[test]
fn a_broker_that_freezes_costs_time_and_no_robot() {
    for seconds in [1.0, 4.0, 20.0] {
        let mut world = World::under_way(10);
        freeze(&mut world, seconds);
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{seconds} s\n{}", world.story());
        assert_eq!(world.count(lost), usize::from(seconds > 2.0), "{seconds} s\n{}", world.story());
    }
}

#[test]
fn a_broker_that_freezes_while_a_frame_stands_or_a_start_is_stated_costs_no_robot() {
    for wait_s in [0.0, 0.2, 0.4] {
        let mut world = World::ready(10, 0, show(3, 10, 0.5));
        world.play();
        world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
        world.run_for(wait_s);
        freeze(&mut world, 9.0);
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{wait_s} s\n{}", world.story());
    }
}

/// Robots are then told to hold at a moment after the end of the drive, and the next START could come before it.
#[test]
fn a_broker_lost_for_a_moment_at_any_time_of_a_short_drive_costs_no_robot() {
    let mut show = show(3, 10, 0.3);
    let first = show.frames[0].clone();
    for (number, frame) in show.frames.iter_mut().enumerate() {
        frame.pixels.clone_from(&first.pixels);
        frame.pixels.iter_mut().for_each(|pixel| pixel.at.y += 0.1 * number as f64);
    }
    for (tenths, gap_s) in (0..10).flat_map(|tenths| [0.05, 0.15, 0.3].map(|gap_s| (tenths, gap_s))) {
        let mut world = World::ready(10, 0, show.clone());
        world.play();
        world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
        world.run_until(10.0, started);
        world.run_for(f64::from(tenths) / 10.0);
        world.link(false);
        world.run_for(gap_s);
        world.link(true);
        let ended = world.run_to_end(90.0);
        assert_eq!(ended, (RunOutcome::Finished, 3, 0), "{tenths}, {gap_s} s\n{}", world.story());
        // At the end of a drive there is no time for a hold.
        let dead_stops = world.robots.iter().map(|robot| robot.dead_stops).sum::<u32>();
        assert!(dead_stops == 0 || tenths > 3, "{tenths}, {gap_s} s: {dead_stops} stops without a hold");
    }
}

/// Robots that set their clocks anew would be waited for until 15 s after the link was back.
#[test]
fn a_broker_that_freezes_while_robots_set_their_clocks_costs_no_robot() {
    let mut world = World::under_way(10);
    freeze(&mut world, 4.0);
    world.run_until(5.0, |kind| matches!(kind, EventKind::LinkBack { .. }));
    world.robots.iter_mut().for_each(|robot| robot.clockless = true);
    world.run_for(1.0);
    freeze(&mut world, 20.0);
    world.robots.iter_mut().for_each(|robot| robot.clockless = false);
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    assert_eq!(world.count(lost), 2, "{}", world.story());
}

#[test]
fn after_more_than_half_a_minute_the_operator_says_that_it_goes_on() {
    let mut world = World::under_way(10);
    freeze(&mut world, 20.0);
    world.frozen = true;
    assert_eq!(world.operate(Operation::GoOn), Err(Refusal::NothingToGoOn), "no robot reports");
    world.run_for(20.0);
    world.frozen = false;
    let back = world.run_until(5.0, |kind| matches!(kind, EventKind::LinkBack { .. }));
    assert!(back.kind.to_string().ends_with("press Go on."), "{}", back.kind);
    world.run_for(30.0);
    let snapshot = world.controller.snapshot(world.now);
    assert_eq!(snapshot.state, ControllerState::LinkLost);
    assert!(snapshot.run.is_some_and(|run| run.wait.may_go_on && run.doing == "waiting for you to go on"));
    world.operate(Operation::GoOn).unwrap();
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}

#[test]
fn a_few_silent_robots_are_lost_and_many_are_not() {
    for (dead, dropouts) in [(2, 2), (3, 0)] {
        let mut world = World::under_way(10);
        (0..dead).for_each(|robot| world.robots[robot].dead = true);
        world.run_for(6.0);
        assert_eq!(
            world.count(|kind| matches!(kind, EventKind::Dropout { .. })),
            dropouts,
            "{}",
            world.story()
        );
        assert_eq!(world.count(lost), usize::from(dropouts == 0), "{}", world.story());
    }
}

#[test]
fn robots_that_stay_silent_after_the_others_are_back_drop_out() {
    let mut world = World::under_way(10);
    (0..5).for_each(|robot| world.robots[robot].dead = true);
    world.run_until(5.0, lost);
    (0..3).for_each(|robot| world.robots[robot].dead = false);
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 2), "{}", world.story());
}

#[test]
fn the_operator_goes_on_without_robots_that_stay_silent() {
    let mut world = World::under_way(10);
    (0..5).for_each(|robot| world.robots[robot].dead = true);
    world.run_until(5.0, lost);
    world.run_for(10.0);
    assert_eq!(world.controller.state(), ControllerState::LinkLost, "{}", world.story());
    world.operate(Operation::GoOn).unwrap();
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 5), "{}", world.story());
    assert_eq!(world.operate(Operation::GoOn), Err(Refusal::NoRun));
}

#[test]
fn robots_that_are_out_of_reach_for_good_end_the_run() {
    let mut config = Config::default();
    config.waits.outage = Span::from_millis(20_000);
    let mut world = World::with(config, 10, 0);
    world.operate(Operation::Open(Arc::new(show(3, 10, 0.3)))).unwrap();
    world.run_for(1.0);
    world.play();
    world.run_until(10.0, started);
    (0..5).for_each(|robot| world.robots[robot].dead = true);
    let (outcome, _, dropouts) = world.run_to_end(30.0);
    let RunOutcome::Failed(why) = outcome else { panic!("{}", world.story()) };
    assert!(why.ends_with("only 5 of 10 robots report"), "{why}");
    assert_eq!(dropouts, 0);
}

#[test]
fn the_operator_can_end_a_run_whose_robots_are_out_of_reach() {
    let mut world = World::under_way(10);
    world.frozen = true;
    world.run_until(5.0, lost);
    world.operate(Operation::Abort).unwrap();
    assert_eq!(
        world.count(|kind| matches!(kind, EventKind::RunEnded { outcome: RunOutcome::Aborted, .. })),
        1
    );
}

/// Robots that understand only TARGET and COLOR do not report unasked, and drive on to their targets (R44).
#[test]
fn robots_that_know_target_only_are_not_dropped_for_a_frozen_broker() {
    let mut world = World::ready(6, 6, show(2, 6, 0.3));
    world.play();
    world.run_until(10.0, started);
    world.run_for(1.0);
    freeze(&mut world, 12.0);
    assert_eq!(world.run_to_end(120.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
    assert_eq!(world.count(lost), 1, "{}", world.story());
}

#[test]
fn a_robot_that_floods_is_named_and_the_others_play_on() {
    let mut world = World::under_way(10);
    let flooder = world.robots[3].id;
    for _ in 0..20 {
        let at = world.robots[3].at;
        let report = format!("{flooder} {} {} state=driving can=route", at.x, at.y);
        (0..5_000).for_each(|_| world.inject("T/LightBot/UUID", report.as_bytes()));
        world.run_for(0.1);
    }
    assert_eq!(world.count(|kind| *kind == EventKind::Flooding(flooder)), 1, "{}", world.story());
    assert!(world.controller.counters().flooded > 90_000, "{:?}", world.controller.counters());
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}

/// After an outage of the broker, clients find it again one after the other.
#[test]
fn robots_that_come_back_in_turn_hold_at_one_moment_when_the_others_slow_down_by_themselves() {
    let mut world = World::under_way(10);
    world.run_for(1.0);
    let broke = world.now;
    world.cut.extend(0..10);
    world.link(false);
    world.run_for(0.2);
    world.link(true);
    for robot in 0..8 {
        world.cut.retain(|&cut| cut != robot);
        world.robots[robot].introduce();
        world.run_for(0.12);
    }
    let holds: Vec<_> = world.robots[..8].iter().map(|robot| robot.hold_since).collect();
    let at = holds[0].unwrap();
    assert!(holds.iter().all(|hold| *hold == Some(at)), "{holds:?}");
    assert!((at - broke).as_secs() > 1.3 && (at - broke).as_secs() < 1.9, "{:?}", at - broke);
    assert_eq!(world.robots[9].hold_since, None);
    world.cut.clear();
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}
