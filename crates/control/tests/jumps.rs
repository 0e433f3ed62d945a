//! The operator goes to a frame other than the next one, or skips a frame.

mod fleet;

use fleet::{World, reached, show, started};
use lightbots_base::Span;
use lightbots_control::{
    ControllerState, EventKind, MissingPolicy, OnReturn, Operation, Refusal, RunOutcome,
};
use lightbots_show::{Cue, CuePlace, Identity, Layer, LayerSpan, Setting, Show};
use lightbots_wire::LightAnchor;

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

/// A show in which every frame waits for GO.
fn waiting(frames: usize, robots: usize) -> Show {
    let mut show = show(frames, robots, 0.3);
    for (number, frame) in show.frames.iter_mut().enumerate() {
        frame.id = Some(format!("f{number}"));
        show.cues.push(Cue {
            name: String::new(),
            at: CuePlace::Frame(format!("f{number}")),
            loop_from: None,
        });
    }
    show
}

/// The frame that robots have reached or drive to, and the frame after it.
fn now_and_next(world: &World) -> (usize, Option<usize>) {
    let run = world.controller.snapshot(world.now).run.expect("a show is played");
    (run.frame, run.next)
}

/// A walk over the complete graph of `frames`, self-loops included, that uses each directed edge once.
fn each_to_each(frames: usize) -> Vec<usize> {
    let mut left: Vec<Vec<usize>> = (0..frames).map(|_| (0..frames).collect()).collect();
    let (mut path, mut walk) = (vec![0], Vec::new());
    while let Some(&at) = path.last() {
        match left[at].pop() {
            Some(next) => path.push(next),
            None => walk.extend(path.pop()),
        }
    }
    walk.reverse();
    walk
}

#[test]
fn robots_go_from_each_frame_that_waits_to_each_other_and_the_show_goes_on_from_there() {
    for loss in [0, 5] {
        let mut world = World::ready(12, 0, waiting(5, 12));
        let frames = world.controller.show().unwrap().frames.clone();
        world.play();
        world.loss = loss;
        world.run_until(60.0, reached(0));
        let walk = each_to_each(5);
        assert_eq!(walk.len(), 26, "{walk:?}");
        for &to in &walk[1..] {
            world.operate(Operation::GoTo(to)).unwrap();
            assert_eq!(now_and_next(&world), (to, (to < 4).then_some(to + 1)));
            world.run_until(60.0, reached(to));
            world.run_for(0.5);
            assert_eq!(world.lit(&frames[to]), 12, "frame {to}: {}", world.story());
        }
        assert_eq!(world.stood(), walk);
        for next in 1..5 {
            world.operate(Operation::Go).unwrap();
            world.run_until(60.0, reached(next));
        }
        world.operate(Operation::Go).unwrap();
        assert_eq!(
            world.count(|kind| matches!(kind, EventKind::RunEnded { outcome: RunOutcome::Finished, .. })),
            1
        );
        assert!(world.closest_m >= CONTACT_M, "{} m", world.closest_m);
    }
}

#[test]
fn robots_that_are_held_on_their_way_go_to_each_frame() {
    for (number, loss) in [(1, 0), (1, 5), (3, 0), (3, 5)] {
        for to in 0..5 {
            let mut world = World::ready(12, 0, show(5, 12, 0.2));
            world.operate(Operation::Play { from: number - 1, missing: MissingPolicy::Refuse }).unwrap();
            world.run_until(30.0, reached(number - 1));
            world.run_until(30.0, started);
            world.loss = loss;
            // A pause in the last 0.3 s of a drive has no effect: the drive ends first.
            world.run_for(0.3 + 0.15 * to as f64);
            world.operate(Operation::Pause).unwrap();
            world.run_for(if to % 2 == 0 { 0.0 } else { 3.0 });
            world.operate(Operation::GoTo(to)).unwrap();
            assert_eq!(now_and_next(&world).0, to);
            world.run_until(60.0, reached(to));
            let (outcome, ..) = world.run_to_end(90.0);
            let wanted: Vec<usize> = [number - 1].into_iter().chain(to..5).collect();
            assert_eq!((outcome, world.stood()), (RunOutcome::Finished, wanted), "{}", world.story());
            assert!(world.closest_m >= CONTACT_M, "to {to}: {} m", world.closest_m);
        }
    }
}

#[test]
fn robots_that_drive_are_not_sent_elsewhere() {
    let mut world = World::ready(9, 0, show(4, 9, 0.4));
    assert_eq!(world.operate(Operation::GoTo(1)), Err(Refusal::NoRun));
    world.play();
    assert_eq!(world.operate(Operation::GoTo(4)), Err(Refusal::NoSuchFrame { frame: 4, frames: 4 }));
    world.run_until(30.0, started);
    world.run_for(1.0);
    for operation in [Operation::GoTo(2), Operation::Skip] {
        assert_eq!(world.operate(operation), Err(Refusal::Driving));
    }
    world.run_until(30.0, reached(0));
    world.operate(Operation::GoTo(2)).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished);
    assert_eq!(world.stood(), [0, 2, 3], "its air time was cut");
    world.operate(Operation::Preview { frame: 1, missing: MissingPolicy::Refuse }).unwrap();
    world.run_for(1.0);
    assert_eq!(world.operate(Operation::GoTo(2)), Err(Refusal::Busy(ControllerState::Preview)));
    world.run_to_end(30.0);
    world.operate(Operation::Home).unwrap();
    world.run_for(1.0);
    assert_eq!(world.operate(Operation::Skip), Err(Refusal::Busy(ControllerState::Preview)));
}

#[test]
fn a_skip_moves_no_robot_and_keeps_waiting() {
    let mut world = World::ready(9, 0, waiting(4, 9));
    world.play();
    world.run_until(30.0, reached(0));
    world.run_for(1.0);
    world.operate(Operation::Skip).unwrap();
    assert_eq!(now_and_next(&world), (0, Some(2)));
    world.run_for(30.0);
    assert_eq!((world.stood(), world.count(started)), (vec![0], 1));
    world.operate(Operation::Go).unwrap();
    world.run_until(30.0, reached(2));
    world.operate(Operation::Pause).unwrap();
    world.operate(Operation::Skip).unwrap();
    assert_eq!(now_and_next(&world), (2, None), "the last frame is left out");
    assert_eq!(world.operate(Operation::Skip), Err(Refusal::NothingToSkip));
    world.run_for(10.0);
    assert_eq!(world.controller.state(), ControllerState::Paused);
    world.operate(Operation::Resume).unwrap();
    world.operate(Operation::Go).unwrap();
    assert!(!world.controller.has_run(), "{}", world.story());
    assert_eq!(world.stood(), [0, 2]);
}

#[test]
fn the_frame_that_held_robots_drive_to_is_skipped_once_the_pause_ends() {
    let mut world = World::ready(9, 0, show(4, 9, 0.2));
    world.play();
    world.run_until(30.0, reached(0));
    world.run_until(30.0, started);
    world.run_for(0.6);
    world.operate(Operation::Pause).unwrap();
    world.run_for(1.0);
    world.operate(Operation::Skip).unwrap();
    assert_eq!(now_and_next(&world), (2, Some(3)));
    world.run_for(20.0);
    assert_eq!((world.stood(), world.controller.state()), (vec![0], ControllerState::Paused));
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(60.0).0, RunOutcome::Finished, "{}", world.story());
    assert_eq!(world.stood(), [0, 2, 3]);
}

#[test]
fn a_show_without_a_path_to_the_frame_stays_where_it_is() {
    let given_up = |kind: &EventKind| matches!(kind, EventKind::JumpGivenUp { frame: 3 });
    let mut world = World::ready(9, 0, waiting(4, 9));
    world.play();
    world.run_until(30.0, reached(0));
    world.slow_plans = 1;
    world.operate(Operation::GoTo(3)).unwrap();
    assert_eq!((world.count(given_up), now_and_next(&world)), (1, (0, Some(1))));
    world.run_for(30.0);
    assert_eq!(world.stood(), [0]);
    world.operate(Operation::Go).unwrap();
    world.run_until(30.0, reached(1));
    let mut world = World::ready(9, 0, show(4, 9, 20.0));
    world.play();
    world.run_until(30.0, reached(0));
    world.slow_plans = 1;
    world.operate(Operation::GoTo(3)).unwrap();
    assert_eq!((world.count(given_up), world.controller.state()), (1, ControllerState::Paused));
    world.run_for(60.0);
    world.operate(Operation::Resume).unwrap();
    world.run_until(30.0, reached(1));
}

#[test]
fn a_controller_that_is_killed_on_the_way_goes_on_to_the_chosen_frame() {
    let mut world = World::ready(9, 0, waiting(4, 9));
    world.controller.keep_journal();
    world.play();
    world.run_until(30.0, reached(0));
    world.operate(Operation::GoTo(2)).unwrap();
    world.run_for(0.1);
    world.kill_controller();
    world.run_for(2.0);
    assert!(world.return_controller(OnReturn::GoOrAsk));
    world.run_until(60.0, reached(2));
    world.operate(Operation::Go).unwrap();
    world.run_until(60.0, reached(3));
}

#[test]
fn a_show_that_begins_again_goes_on_from_the_chosen_frame() {
    let mut world = World::ready(6, 0, show(3, 6, 0.3));
    world.operate(Operation::Loop(true)).unwrap();
    world.play();
    world.run_until(60.0, reached(2));
    world.operate(Operation::GoTo(1)).unwrap();
    for frame in [1, 2, 0] {
        world.run_until(60.0, reached(frame));
    }
    world.operate(Operation::Skip).unwrap();
    world.run_until(60.0, reached(2));
    assert_eq!(world.stood(), [0, 1, 2, 1, 2, 0, 2]);
}

#[test]
fn robots_that_die_on_the_way_do_not_keep_the_others_from_the_frame() {
    let mut world = World::ready(9, 0, waiting(4, 9));
    world.operate(Operation::Play { from: 0, missing: MissingPolicy::LeaveOut }).unwrap();
    world.run_until(30.0, reached(0));
    world.operate(Operation::GoTo(3)).unwrap();
    world.run_until(10.0, started);
    world.run_for(0.5);
    world.robots[4].dead = true;
    world.run_until(60.0, reached(3));
    assert_eq!(world.stood(), [0, 3], "{}", world.story());
    assert!(world.closest_m >= CONTACT_M);
}

#[test]
fn robots_that_know_target_only_go_to_other_frames() {
    for loss in [0, 5] {
        let mut world = World::ready(8, 2, waiting(5, 8));
        let frames = world.controller.show().unwrap().frames.clone();
        world.play();
        world.loss = loss;
        world.run_until(120.0, reached(0));
        for to in [3, 1, 1, 4, 2] {
            world.operate(Operation::GoTo(to)).unwrap();
            world.run_until(120.0, reached(to));
            world.run_for(1.0);
            assert_eq!(world.lit(&frames[to]), 8, "frame {to}: {}", world.story());
        }
        assert_eq!(world.stood(), [0, 3, 1, 1, 4, 2]);
        assert!(world.closest_m >= CONTACT_M, "{} m", world.closest_m);
    }
}

/// A show with pulses from the second frame to the last one. Their time counts from the second frame.
fn pulses(robots: usize) -> Show {
    let span = LayerSpan::Frames { first: "f1".into(), last: "f4".into(), phase: Default::default() };
    let settings = vec![("speed_hz".to_owned(), Setting::Number(0.11))];
    let layer = Layer { name: String::new(), kind: "rainbow".into(), span, settings };
    Show { layers: vec![layer], identity: Identity::Fixed, ..waiting(5, robots) }
}

#[test]
fn layers_go_on_at_the_show_time_of_the_frame() {
    // Colours 0.8 s after the frame was reached.
    let shown = |world: &mut World, frame: usize| {
        let at = world.run_until(60.0, reached(frame)).at;
        world.run_for(1.0);
        world.controller.layered_lights(at + Span::from_secs(0.8))
    };
    let mut through = World::ready(9, 0, pulses(9));
    through.play();
    let mut known = Vec::new();
    for frame in 0..5 {
        known.push(shown(&mut through, frame));
        through.operate(Operation::Go).unwrap();
    }
    let mut jumping = World::ready(9, 0, pulses(9));
    jumping.play();
    jumping.run_until(60.0, reached(0));
    for to in [3, 1, 4, 2, 2] {
        jumping.operate(Operation::GoTo(to)).unwrap();
        let lights = shown(&mut jumping, to);
        assert_eq!(lights.len(), 9);
        let off = |(one, other): (&(_, lightbots_base::Rgb), &(_, lightbots_base::Rgb))| {
            let of = |one: u8, other: u8| one.abs_diff(other);
            of(one.1.r, other.1.r).max(of(one.1.g, other.1.g)).max(of(one.1.b, other.1.b))
        };
        let most = lights.iter().zip(&known[to]).map(off).max();
        assert!(most < Some(12), "frame {to}: {lights:?}, and {:?}", known[to]);
    }
    let anchors =
        jumping.robots[0].stretches.iter().filter(|one| matches!(one.anchor, LightAnchor::Start(_)));
    assert!(anchors.count() >= 6, "the first stretch of each drive came with its route");
}
