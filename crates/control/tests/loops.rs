//! Frames that repeat until GO.

mod fleet;

use fleet::{World, reached, show, started};
use lightbots_base::{Rgb, Span};
use lightbots_control::{EventKind, MissingPolicy, OnReturn, Operation, Refusal, RepeatView, RunOutcome};
use lightbots_show::{Cue, CuePlace, Identity, Layer, LayerSpan, Setting, Show};

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

/// A show whose frames from `first` to `last` repeat until GO.
fn repeating((first, last): (usize, usize), frames: usize, robots: usize, air_time_s: f64) -> Show {
    let mut show = show(frames, robots, air_time_s);
    for (number, frame) in show.frames.iter_mut().enumerate() {
        frame.id = Some(format!("f{number}"));
    }
    let at = CuePlace::Frame(format!("f{last}"));
    show.cues = vec![Cue { name: "Encore".into(), at, loop_from: Some(format!("f{first}")) }];
    show
}

fn left_for(frame: usize) -> impl Fn(&EventKind) -> bool {
    move |kind| matches!(kind, EventKind::TransitionStarted { frame: one, .. } if *one == frame)
}

fn repeats(world: &World) -> Option<RepeatView> {
    world.controller.snapshot(world.now).run.and_then(|run| run.repeats)
}

/// Runs until this frame was reached in this round of the loop.
fn run_to(world: &mut World, frame: usize, round: u32) {
    while repeats(world).is_none_or(|repeats| repeats.round < round) || world.stood().last() != Some(&frame) {
        world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    }
}

#[test]
fn frames_repeat_until_go_and_the_show_goes_on_after_the_last_of_them() {
    for loss in [0, 5] {
        let mut world = World::ready(12, 0, repeating((1, 3), 5, 12, 0.3));
        let frames = world.controller.show().unwrap().frames.clone();
        world.play();
        world.loss = loss;
        world.run_until(60.0, reached(0));
        world.run_until(60.0, started);
        assert_eq!((repeats(&world), world.operate(Operation::Go)), (None, Err(Refusal::NoCue)));
        for (round, frame) in [(1, 1), (1, 2), (1, 3), (2, 1), (2, 2), (2, 3), (3, 1), (3, 2)] {
            world.run_until(60.0, reached(frame));
            assert_eq!(repeats(&world), Some(RepeatView { first: 1, last: 3, round, leaves: false }));
            assert_eq!(world.lit(&frames[frame]), 12, "frame {frame}: {}", world.story());
        }
        world.operate(Operation::Go).unwrap();
        assert_eq!(repeats(&world), Some(RepeatView { first: 1, last: 3, round: 3, leaves: true }));
        assert_eq!(world.operate(Operation::Go), Err(Refusal::NoCue), "GO was given");
        let (outcome, ..) = world.run_to_end(60.0);
        assert_eq!((outcome, world.stood()), (RunOutcome::Finished, vec![0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4]));
        let told = |kind: &EventKind| match kind {
            EventKind::LoopBegun { .. } | EventKind::LeavesLoop { .. } => Some(kind.to_string()),
            _ => None,
        };
        let told: Vec<_> = world.events.iter().filter_map(|event| told(&event.kind)).collect();
        assert_eq!(told, ["Frames 2 to 4 repeat until GO.", "GO: the show leaves the loop after frame 4."]);
        assert!(world.closest_m >= CONTACT_M, "{} m", world.closest_m);
    }
}

#[test]
fn the_way_back_and_the_way_on_begin_as_soon_as_any_drive() {
    let mut world = World::ready(12, 0, repeating((1, 2), 4, 12, 1.0));
    world.play();
    for (frame, next) in [(0, 1), (1, 2), (2, 1), (1, 2), (2, 3)] {
        let stands = world.run_until(60.0, reached(frame)).at;
        if frame == 1 && repeats(&world).is_some_and(|repeats| repeats.round == 2) {
            world.operate(Operation::Go).unwrap();
        }
        let leaves = world.run_until(60.0, left_for(next)).at;
        assert!(
            (leaves - stands).as_secs() < 1.2,
            "frame {frame} stood for {} s",
            (leaves - stands).as_secs()
        );
    }
}

#[test]
fn go_is_given_at_any_moment_of_a_round() {
    let mut rounds = [0; 4];
    for (number, after_ms) in (0..9_000).step_by(450).enumerate() {
        let mut world = World::ready(9, 0, repeating((1, 2), 4, 9, 0.6));
        world.play();
        world.run_until(60.0, reached(1));
        world.loss = if number % 2 == 0 { 0 } else { 5 };
        world.run_for(f64::from(after_ms) / 1e3);
        let round = repeats(&world).unwrap().round as usize;
        world.operate(Operation::Go).unwrap();
        let outcome = world.run_to_end(90.0).0;
        let wanted: Vec<usize> = [0].into_iter().chain([1, 2].repeat(round)).chain([3]).collect();
        assert_eq!((outcome, world.stood()), (RunOutcome::Finished, wanted), "{after_ms}: {}", world.story());
        assert!(world.closest_m >= CONTACT_M, "after {after_ms} ms: {} m", world.closest_m);
        rounds[round.min(3)] += 1;
    }
    assert!(rounds[1] > 2 && rounds[2] > 2, "{rounds:?}");
}

#[test]
fn the_last_frame_keeps_its_air_time() {
    let mut world = World::ready(9, 0, repeating((0, 1), 3, 9, 4.0));
    world.play();
    let stands = world.run_until(60.0, reached(1)).at;
    world.run_for(1.0);
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.controller.snapshot(world.now).run.unwrap().next, Some(2));
    let leaves = world.run_until(60.0, left_for(2)).at;
    let stood_s = (leaves - stands).as_secs();
    assert!((3.7..4.3).contains(&stood_s), "{stood_s} s");
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0));
}

#[test]
fn a_loop_of_one_frame_and_one_at_the_end_of_the_show() {
    let mut one = World::ready(9, 0, repeating((1, 1), 3, 9, 0.4));
    one.play();
    run_to(&mut one, 1, 4);
    one.operate(Operation::Go).unwrap();
    assert_eq!(one.run_to_end(60.0).0, RunOutcome::Finished);
    assert_eq!(one.stood(), [0, 1, 1, 1, 1, 2]);
    for go_at in [1, 2] {
        let mut last = World::ready(9, 0, repeating((1, 2), 3, 9, 0.4));
        last.play();
        run_to(&mut last, go_at, 2);
        last.operate(Operation::Go).unwrap();
        assert_eq!(last.run_to_end(60.0).0, RunOutcome::Finished, "{}", last.story());
        assert_eq!(last.stood(), [0, 1, 2, 1, 2]);
    }
}

#[test]
fn a_show_that_begins_again_repeats_its_loop_again() {
    let mut world = World::ready(9, 0, repeating((1, 2), 3, 9, 0.3));
    world.operate(Operation::Loop(true)).unwrap();
    world.play();
    world.run_until(60.0, reached(2));
    world.operate(Operation::Go).unwrap();
    run_to(&mut world, 1, 2);
    world.operate(Operation::Loop(false)).unwrap();
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished, "{}", world.story());
    assert_eq!(world.stood(), [0, 1, 2, 0, 1, 2, 1, 2]);
}

#[test]
fn a_controller_that_is_killed_in_a_loop_goes_on_with_it() {
    for is_given in [false, true] {
        for after_s in [0.1, 0.5, 1.2, 2.0] {
            let mut world = World::ready(9, 0, repeating((1, 2), 4, 9, 0.8));
            world.controller.keep_journal();
            world.play();
            run_to(&mut world, 1, 2);
            if is_given {
                world.operate(Operation::Go).unwrap();
            }
            world.run_for(after_s);
            let before = repeats(&world);
            world.kill_controller();
            world.run_for(2.0);
            assert!(world.return_controller(OnReturn::GoOrAsk));
            assert_eq!(repeats(&world), before, "after {after_s} s");
            if !is_given {
                run_to(&mut world, 2, 3);
                world.operate(Operation::Go).unwrap();
            }
            assert_eq!(world.run_to_end(90.0).0, RunOutcome::Finished, "{}", world.story());
            let rounds = if is_given { 2 } else { 3 };
            let wanted: Vec<usize> = [0].into_iter().chain([1, 2].repeat(rounds)).chain([3]).collect();
            assert_eq!(world.stood(), wanted, "GO {is_given}, after {after_s} s");
        }
    }
}

#[test]
fn a_lost_link_and_dead_robots_do_not_end_a_loop() {
    let mut world = World::ready(9, 0, repeating((1, 2), 4, 9, 0.3));
    world.operate(Operation::Play { from: 0, missing: MissingPolicy::LeaveOut }).unwrap();
    run_to(&mut world, 1, 2);
    world.run_until(60.0, started);
    world.run_for(0.5);
    world.link(false);
    world.run_for(8.0);
    world.link(true);
    run_to(&mut world, 1, 3);
    world.robots[4].dead = true;
    run_to(&mut world, 2, 5);
    world.operate(Operation::Go).unwrap();
    let (outcome, _, dropouts) = world.run_to_end(90.0);
    assert_eq!((outcome, dropouts), (RunOutcome::Finished, 1), "{}", world.story());
    let wanted: Vec<usize> = [0].into_iter().chain([1, 2].repeat(5)).chain([3]).collect();
    assert_eq!(world.stood(), wanted);
    assert!(world.closest_m >= CONTACT_M, "{} m", world.closest_m);
}

#[test]
fn jumps_and_skips_lead_out_of_a_loop_and_through_it() {
    let mut world = World::ready(9, 0, repeating((1, 3), 5, 9, 0.5));
    world.play();
    run_to(&mut world, 2, 2);
    // A jump within the loop keeps the round, and cancels a GO.
    world.operate(Operation::Go).unwrap();
    world.operate(Operation::GoTo(1)).unwrap();
    assert_eq!(repeats(&world).map(|repeats| (repeats.round, repeats.leaves)), Some((2, false)));
    run_to(&mut world, 3, 2);
    world.operate(Operation::Skip).unwrap();
    assert_eq!(world.controller.snapshot(world.now).run.unwrap().next, Some(2), "frame 2 is left out");
    run_to(&mut world, 2, 3);
    world.operate(Operation::GoTo(4)).unwrap();
    assert_eq!(repeats(&world), None);
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished, "{}", world.story());
    assert_eq!(world.stood(), [0, 1, 2, 3, 1, 2, 1, 2, 3, 2, 4]);
    // GO counts even if the first frame of the next round was skipped before.
    let mut world = World::ready(9, 0, repeating((1, 2), 4, 9, 2.0));
    world.play();
    world.run_until(60.0, reached(2));
    world.operate(Operation::Skip).unwrap();
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished, "{}", world.story());
    assert_eq!(world.stood(), [0, 1, 2, 3]);
}

#[test]
fn a_frame_within_a_loop_that_waits_gets_the_first_go() {
    let mut show = repeating((1, 3), 5, 9, 0.3);
    show.cues.push(Cue { name: "Wait".into(), at: CuePlace::Frame("f2".into()), loop_from: None });
    let mut world = World::ready(9, 0, show);
    world.play();
    for _ in 0..2 {
        world.run_until(60.0, reached(2));
        world.run_for(30.0);
        world.operate(Operation::Go).unwrap();
        world.run_until(60.0, reached(3));
    }
    world.operate(Operation::Go).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished, "{}", world.story());
    assert_eq!(world.stood(), [0, 1, 2, 3, 1, 2, 3, 4]);
}

#[test]
fn a_pause_and_a_step_stay_in_the_loop() {
    let mut world = World::ready(9, 0, repeating((0, 1), 3, 9, 0.3));
    world.play();
    world.run_until(60.0, reached(1));
    world.operate(Operation::Pause).unwrap();
    assert_eq!(world.operate(Operation::Go), Err(Refusal::Paused));
    world.operate(Operation::Step).unwrap();
    world.run_until(60.0, reached(0));
    assert_eq!(repeats(&world).map(|repeats| repeats.round), Some(2));
}

#[test]
fn robots_that_know_target_only_repeat_frames() {
    for loss in [0, 5] {
        let mut world = World::ready(8, 2, repeating((1, 2), 4, 8, 0.3));
        world.play();
        world.loss = loss;
        run_to(&mut world, 1, 3);
        world.operate(Operation::Go).unwrap();
        assert_eq!(world.run_to_end(240.0).0, RunOutcome::Finished, "{}", world.story());
        assert_eq!(world.stood(), [0, 1, 2, 1, 2, 1, 2, 3]);
        assert!(world.closest_m >= CONTACT_M, "{} m", world.closest_m);
    }
}

#[test]
fn layers_begin_again_with_the_round_and_go_on_after_it() {
    // Colours 0.8 s after the frame was reached.
    let shown = |world: &mut World, frame: usize| {
        let at = world.run_until(60.0, reached(frame)).at;
        world.run_for(0.9);
        world.controller.layered_lights(at + Span::from_secs(0.8))
    };
    let lit = |repeats: bool| {
        let mut show = repeating((1, 2), 4, 9, 1.5);
        let span = LayerSpan::Frames { first: "f1".into(), last: "f3".into(), phase: Default::default() };
        let settings = vec![("speed_hz".to_owned(), Setting::Number(0.11))];
        show.layers = vec![Layer { name: String::new(), kind: "rainbow".into(), span, settings }];
        show.identity = Identity::Fixed;
        if !repeats {
            show.cues.clear();
        }
        let mut world = World::ready(9, 0, show);
        world.play();
        world
    };
    let mut through = lit(false);
    let known: Vec<_> = (0..4).map(|frame| shown(&mut through, frame)).collect();
    let mut repeating = lit(true);
    for frame in [0, 1, 2, 1, 2, 1, 2, 3] {
        if repeats(&repeating).is_some_and(|repeats| repeats.round == 3) {
            let _ = repeating.operate(Operation::Go);
        }
        let lights = shown(&mut repeating, frame);
        assert_eq!(lights.len(), 9, "frame {frame}");
        let off = |(one, other): (&(_, Rgb), &(_, Rgb))| {
            let of = |one: u8, other: u8| one.abs_diff(other);
            of(one.1.r, other.1.r).max(of(one.1.g, other.1.g)).max(of(one.1.b, other.1.b))
        };
        let most = lights.iter().zip(&known[frame]).map(off).max();
        assert!(most < Some(12), "frame {frame}: {lights:?}, and {:?}", known[frame]);
    }
    assert_eq!(repeating.stood(), [0, 1, 2, 1, 2, 1, 2, 3]);
}
