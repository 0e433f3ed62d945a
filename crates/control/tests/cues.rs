//! Frames that wait for GO.

mod fleet;

use fleet::{World, reached, show};
use lightbots_control::{
    ControllerState, EventKind, MissingPolicy, OnReturn, Operation, Refusal, RunOutcome,
};
use lightbots_show::{Cue, CuePlace, Show};

/// A show whose second frame waits for GO.
fn with_cue(frames: usize, robots: usize, air_time_s: f64) -> Show {
    let mut show = show(frames, robots, air_time_s);
    show.frames[1].id = Some("second".into());
    show.cues = vec![Cue { name: "Curtain".into(), at: CuePlace::Frame("second".into()), loop_from: None }];
    show
}

fn cue(world: &World) -> Option<String> {
    world.controller.snapshot(world.now).run.and_then(|run| run.wait.cue)
}

fn starts(world: &World) -> usize {
    world.count(|kind| matches!(kind, EventKind::TransitionStarted { .. }))
}

#[test]
fn a_frame_with_a_cue_stands_until_go() {
    let mut world = World::ready(9, 0, with_cue(3, 9, 0.5));
    world.play();
    world.run_until(30.0, reached(0));
    assert_eq!((cue(&world), world.operate(Operation::Go)), (None, Err(Refusal::NoCue)));
    world.run_until(30.0, reached(1));
    assert!(!world.controller.is_at_cue(world.now), "its air time is not over");
    world.run_for(600.0);
    assert_eq!((starts(&world), cue(&world).as_deref()), (2, Some("Curtain")));
    assert!(world.controller.is_at_cue(world.now));
    assert_eq!(world.controller.state(), ControllerState::Playing);
    world.operate(Operation::Go).unwrap();
    let began = world.now;
    world.run_until(5.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 2, .. }));
    assert!((world.now - began).as_secs() < 0.5, "it was planned and uploaded before");
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}

#[test]
fn go_before_the_air_time_is_over_leaves_at_once() {
    let mut world = World::ready(9, 0, with_cue(3, 9, 60.0));
    world.operate(Operation::Play { from: 1, missing: MissingPolicy::Refuse }).unwrap();
    world.run_until(30.0, reached(1));
    world.run_for(1.0);
    world.operate(Operation::Go).unwrap();
    world.run_until(2.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 2, .. }));
}

#[test]
fn a_cue_of_the_last_frame_ends_the_show_with_go() {
    let mut world = World::ready(4, 0, with_cue(2, 4, 0.1));
    world.play();
    world.run_until(30.0, reached(1));
    world.run_for(60.0);
    assert!(world.controller.has_run());
    world.operate(Operation::Go).unwrap();
    let ended = |kind: &EventKind| matches!(kind, EventKind::RunEnded { outcome: RunOutcome::Finished, .. });
    assert!(world.events.iter().any(|event| ended(&event.kind)), "{}", world.story());
}

#[test]
fn a_paused_run_takes_no_go_and_step_passes_a_cue() {
    let mut world = World::ready(4, 0, with_cue(4, 4, 0.1));
    world.play();
    world.run_until(30.0, reached(1));
    world.operate(Operation::Pause).unwrap();
    assert_eq!(world.operate(Operation::Go), Err(Refusal::Paused));
    world.operate(Operation::Step).unwrap();
    world.run_until(30.0, reached(2));
    assert_eq!((cue(&world), world.controller.state()), (None, ControllerState::Paused));
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 4, 0));
}

#[test]
fn robots_that_die_at_a_cue_do_not_give_go() {
    let mut world = World::ready(9, 0, with_cue(3, 9, 0.1));
    world.operate(Operation::Play { from: 0, missing: MissingPolicy::LeaveOut }).unwrap();
    world.run_until(30.0, reached(1));
    world.run_for(2.0);
    world.robots[4].dead = true;
    world.run_until(60.0, |kind| matches!(kind, EventKind::Dropout { .. }));
    world.run_for(300.0);
    assert_eq!((starts(&world), cue(&world).as_deref()), (2, Some("Curtain")), "{}", world.story());
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
}

#[test]
fn a_controller_that_is_killed_at_a_cue_waits_for_go_again() {
    let mut world = World::ready(9, 0, with_cue(3, 9, 0.1));
    world.controller.keep_journal();
    world.play();
    world.run_until(30.0, reached(1));
    world.run_for(1.0);
    world.kill_controller();
    world.run_for(2.0);
    assert!(world.return_controller(OnReturn::GoOrAsk));
    world.run_for(120.0);
    assert_eq!((starts(&world), cue(&world).as_deref()), (2, Some("Curtain")), "{}", world.story());
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.run_to_end(30.0).0, RunOutcome::Finished, "{}", world.story());
}
