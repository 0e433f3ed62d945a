//! Whole runs of a fleet of perfect robots.

mod fleet;

use fleet::{World, show};
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_control::{ControllerState, EventKind, MissingPolicy, Operation, Refusal, RunOutcome};
use lightbots_show::{Identity, Show};
use std::sync::Arc;

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;

#[test]
fn a_show_plays_to_its_end() {
    let show = show(5, 12, 0.5);
    let mut world = World::ready(12, 0, show.clone());
    world.play();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 5, 0), "{}", world.story());
    assert_eq!(world.lit(&show.frames[4]), 12);
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
    assert_eq!(world.controller.state(), ControllerState::Ready);
    let snapshot = world.controller.snapshot(world.now);
    assert!(snapshot.robots.iter().all(|robot| robot.pixel.is_some()));
}

#[test]
fn between_frames_little_time_is_lost() {
    for air_time_s in [0.0, 1.0] {
        let mut world = World::ready(20, 0, show(6, 20, air_time_s));
        world.play();
        world.run_to_end(90.0);
        let mut lost: Vec<f64> = Vec::new();
        let mut ends: Option<Instant> = None;
        for event in &world.events {
            if let EventKind::TransitionStarted { starts, duration, .. } = event.kind {
                if let Some(end) = ends {
                    lost.push(Span::as_secs(starts - end) - air_time_s);
                }
                ends = Some(starts + duration);
            }
        }
        assert_eq!(lost.len(), 5);
        let most = if air_time_s == 0.0 { 0.35 } else { 0.001 };
        assert!(lost.iter().all(|&lost| (-0.001..=most).contains(&lost)), "{lost:?}");
    }
}

#[test]
fn it_plays_from_a_frame_and_previews_one() {
    let show = show(4, 9, 0.2);
    let mut world = World::ready(9, 0, show.clone());
    world.operate(Operation::Preview { frame: 1, missing: MissingPolicy::Refuse }).unwrap();
    world.run_for(2.0);
    assert_eq!(world.controller.state(), ControllerState::Preview);
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 1, 0));
    assert_eq!(world.lit(&show.frames[1]), 9);
    world.operate(Operation::Play { from: 2, missing: MissingPolicy::Refuse }).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 2, 0));
    assert_eq!(world.lit(&show.frames[3]), 9);
}

#[test]
fn a_loop_goes_round_until_it_is_told_not_to() {
    let mut world = World::ready(6, 0, show(2, 6, 0.1));
    world.operate(Operation::Loop(true)).unwrap();
    world.play();
    for _ in 0..7 {
        world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    }
    world.operate(Operation::Loop(false)).unwrap();
    let (outcome, frames, _) = world.run_to_end(30.0);
    assert_eq!(outcome, RunOutcome::Finished);
    assert_eq!(frames % 2, 0, "it ends with the last frame");
}

#[test]
fn pause_holds_a_drive_and_resume_finishes_it() {
    let mut world = World::ready(9, 0, show(2, 9, 0.2));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(1.5);
    world.operate(Operation::Pause).unwrap();
    assert_eq!(world.controller.state(), ControllerState::Paused);
    world.run_for(1.0);
    let stood: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    world.run_for(20.0);
    assert!(world.robots.iter().zip(&stood).all(|(robot, at)| robot.at == *at));
    assert_eq!(
        world.controller.operate(world.now, Operation::Play { from: 0, missing: MissingPolicy::Refuse }),
        Err(Refusal::Busy(ControllerState::Paused))
    );
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 2, 0), "{}", world.story());
}

#[test]
fn pause_stops_the_air_time_and_step_goes_one_picture_on() {
    let mut world = World::ready(4, 0, show(4, 4, 1.0));
    world.play();
    let reached = |frame| move |kind: &EventKind| matches!(kind, EventKind::FrameReached { frame: f, .. } if *f == frame);
    world.run_until(20.0, reached(0));
    world.operate(Operation::Pause).unwrap();
    let starts = |world: &World| world.count(|kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(10.0);
    assert_eq!(starts(&world), 1);
    world.operate(Operation::Step).unwrap();
    world.run_until(20.0, reached(1));
    world.run_for(5.0);
    assert_eq!((starts(&world), world.controller.state()), (2, ControllerState::Paused));
    world.operate(Operation::Resume).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 4, 0));
}

#[test]
fn a_show_that_is_stopped_says_in_which_frame_until_it_begins_again() {
    let stopped = |world: &World| world.controller.snapshot(world.now).stopped_in;
    let reached = |kind: &EventKind| matches!(kind, EventKind::FrameReached { frame: 1, .. });
    let mut world = World::ready(4, 0, show(3, 4, 0.2));
    for operation in [Operation::StopAll, Operation::Abort] {
        world.play();
        assert_eq!(stopped(&world), None);
        world.run_until(30.0, reached);
        world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 2, .. }));
        world.run_for(0.3);
        world.operate(operation).unwrap();
        world.run_for(5.0);
        assert_eq!((stopped(&world), world.controller.state()), (Some(2), ControllerState::Ready));
    }
    world.operate(Operation::DismissFailure).unwrap();
    assert_eq!(stopped(&world), None);
    world.operate(Operation::Play { from: 2, missing: MissingPolicy::Refuse }).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 1, 0));
    assert_eq!(stopped(&world), None);
    world.operate(Operation::Preview { frame: 0, missing: MissingPolicy::Refuse }).unwrap();
    world.run_for(1.0);
    world.operate(Operation::Abort).unwrap();
    assert_eq!(stopped(&world), None, "it was no show");
}

#[test]
fn stop_lets_a_drive_come_to_rest_first_and_pressed_again_halts_at_once() {
    let stops = |world: &World| world.robots.iter().map(|robot| robot.stops).sum::<u32>();
    let held = |world: &World| world.robots.iter().filter(|robot| robot.hold_since.is_some()).count();
    for operation in [Operation::StopAll, Operation::Abort] {
        for again in [false, true] {
            let mut world = World::under_way(6);
            world.operate(operation.clone()).unwrap();
            world.run_for(0.1);
            assert_eq!((held(&world), stops(&world)), (6, 0), "{operation:?}");
            if again {
                world.operate(operation.clone()).unwrap();
                world.run_for(0.05);
                assert!(stops(&world) >= 6, "{operation:?}");
            }
            world.run_for(0.4);
            assert!(world.robots.iter().all(|robot| robot.stops > 0 && robot.running.is_none()));
            world.run_for(2.0);
            assert_eq!(world.controller.state(), ControllerState::Ready);
        }
    }
}

#[test]
fn no_robot_is_forgotten_while_robots_are_being_stopped() {
    for operation in [Operation::StopAll, Operation::Abort] {
        let mut world = World::under_way(6);
        world.deaf = vec![5];
        world.operate(operation.clone()).unwrap();
        world.run_for(0.1);
        let forgotten = world.operate(Operation::Forget(world.robots[5].id));
        world.run_for(0.2);
        world.deaf.clear();
        world.run_for(1.0);
        assert!(world.robots[5].stops > 0, "{operation:?}: the robot missed `STOP at`, and drives on");
        world.run_for(1.0);
        assert_eq!(forgotten, Err(Refusal::Busy(ControllerState::Aborting)));
        assert_eq!(world.operate(Operation::Forget(world.robots[5].id)), Ok(()));
        assert_eq!(world.controller.robots(), 5);
    }
}

#[test]
fn a_run_says_for_which_clocks_it_waits() {
    let mut world = World::ready(3, 0, show(1, 3, 0.2));
    world.robots[1].clock_us = 40_000;
    world.run_for(2.5);
    world.play();
    world.run_for(1.0);
    let run = world.controller.snapshot(world.now).run.unwrap();
    assert_eq!(run.doing, "waiting for robots to set their clocks");
    assert_eq!(run.wait.robots, [world.robots[1].id]);
    world.robots[1].clock_us = 500;
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 1, 0), "{}", world.story());
}

#[test]
fn stop_does_not_wait_for_robots_that_are_about_to_go_on() {
    let mut world = World::under_way(6);
    world.operate(Operation::Pause).unwrap();
    world.run_for(1.0);
    world.operate(Operation::Resume).unwrap();
    world.operate(Operation::StopAll).unwrap();
    let stop = world.to_robots().into_iter().find_map(|text| {
        let moment = text.strip_prefix("|STOP ")?.strip_suffix('|')?.parse().ok()?;
        Some(Instant(moment))
    });
    assert!(stop.unwrap() <= world.now + Span::from_millis(200), "{stop:?}, now {:?}", world.now);
    let stood: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    world.run_for(2.0);
    assert!(world.robots.iter().zip(stood).all(|(robot, stood)| robot.at.distance(stood) < 1e-3));
}

#[test]
fn robots_are_stopped_before_they_are_asked_anything_where_the_broker_was_gone() {
    for (before, meanwhile) in
        [(Some(Operation::StopAll), None), (None, Some(Operation::StopAll)), (None, Some(Operation::Abort))]
    {
        let mut world = World::under_way(6);
        before.into_iter().for_each(|operation| world.operate(operation).unwrap());
        world.link(false);
        meanwhile.into_iter().for_each(|operation| world.operate(operation).unwrap());
        world.run_for(0.5);
        world.link(true);
        assert_eq!(world.to_robots().first().map(String::as_str), Some("|STOP|"), "{:?}", world.to_robots());
        world.run_for(0.5);
        assert!(world.robots.iter().all(|robot| robot.stops > 0));
    }
}

#[test]
fn half_the_speed_takes_twice_the_time_and_holds_until_it_is_changed() {
    let durations = |world: &World| -> Vec<f64> {
        let drive = |kind: &EventKind| match kind {
            EventKind::TransitionStarted { duration, .. } => Some(duration.as_secs()),
            _ => None,
        };
        world.events.iter().filter_map(|event| drive(&event.kind)).collect()
    };
    let played = |percent: u32| {
        let mut world = World::ready(9, 0, show(3, 9, 0.2));
        world.operate(Operation::Speed(percent)).unwrap();
        world.play();
        assert_eq!(
            world.operate(Operation::Speed(100)),
            Err(Refusal::Busy(ControllerState::Preparing)),
            "not during a run"
        );
        assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 0));
        assert_eq!(world.controller.snapshot(world.now).speed_percent, percent);
        durations(&world)
    };
    for (slow, usual) in played(50).iter().zip(played(100)) {
        assert!((slow / usual - 2.0).abs() < 0.1, "{slow} s, {usual} s");
    }
    let mut world = World::ready(4, 0, show(1, 4, 0.2));
    assert_eq!(world.operate(Operation::Speed(0)), Err(Refusal::NoSuchSpeed));
    assert_eq!(world.operate(Operation::Speed(101)), Err(Refusal::NoSuchSpeed));
}

#[test]
fn abort_stops_all_robots_at_once() {
    let mut world = World::ready(9, 2, show(2, 9, 0.2));
    world.play();
    world.run_until(10.0, |kind| matches!(kind, EventKind::TransitionStarted { .. }));
    world.run_for(1.0);
    world.operate(Operation::Abort).unwrap();
    assert_eq!(world.controller.state(), ControllerState::Aborting);
    world.run_for(0.3);
    let stood: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    world.run_for(4.0);
    let most = world.robots.iter().zip(&stood).map(|(robot, at)| robot.at.distance(*at)).fold(0.0, f64::max);
    assert!(most < 0.2, "an original may return to where it said it was: {most}");
    assert_eq!(world.controller.state(), ControllerState::Ready);
    world.play();
    assert_eq!(world.run_to_end(90.0).0, RunOutcome::Finished, "{}", world.story());
}

#[test]
fn too_few_robots_is_a_choice() {
    let show = show(2, 9, 0.1);
    let mut world = World::ready(7, 0, show.clone());
    let refusal = world.operate(Operation::Play { from: 0, missing: MissingPolicy::Refuse }).unwrap_err();
    assert_eq!(refusal, Refusal::TooFewRobots { pixels: 9, robots: 7, without_place: 0, unfit: 0 });
    world.operate(Operation::Play { from: 0, missing: MissingPolicy::LeaveOut }).unwrap();
    assert_eq!(world.run_to_end(30.0), (RunOutcome::Finished, 2, 0));
    assert_eq!(world.lit(&show.frames[1]), 7);
    assert_eq!(world.count(|kind| matches!(kind, EventKind::LeftOut { count: 2, .. })), 2);
}

#[test]
fn a_robot_that_does_not_know_where_it_is_is_told_apart() {
    let mut world = World::ready(3, 0, show(1, 4, 0.0));
    world.inject("T/LightBot/UUID", b"new-one NaN NaN");
    let refusal = world.operate(Operation::Play { from: 0, missing: MissingPolicy::Refuse }).unwrap_err();
    assert_eq!(refusal, Refusal::TooFewRobots { pixels: 4, robots: 3, without_place: 1, unfit: 0 });
    assert!(refusal.to_string().contains("do not know where they are"));
}

#[test]
fn spare_robots_stand_by_dark() {
    let show = show(3, 6, 0.1);
    let mut world = World::ready(10, 0, show.clone());
    world.play();
    assert_eq!(world.run_to_end(40.0), (RunOutcome::Finished, 3, 0));
    assert_eq!(world.lit(&show.frames[2]), 6);
    assert!(world.closest_m >= CONTACT_M);
}

#[test]
fn with_fixed_identity_a_pixel_is_always_the_same_robot() {
    let mut show = show(3, 6, 0.1);
    show.identity = Identity::Fixed;
    let mut world = World::ready(6, 0, show.clone());
    let starts: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    let checked = lightbots_plan::show(&show, &starts, &Default::default());
    // The second run starts from where the first one left the robots.
    for _ in 0..2 {
        world.play();
        for frame in 0..3 {
            world.run_until(
                30.0,
                |kind| matches!(kind, EventKind::FrameReached { frame: f, .. } if *f == frame),
            );
            for (robot, id) in world.robots.iter().zip(&checked.mapping[0]) {
                let pixel = &show.frames[frame].pixels[id.unwrap() as usize];
                assert!(robot.at.distance(pixel.at) < 0.001, "frame {frame}, pixel {}", pixel.id);
            }
        }
        assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
    }
}

#[test]
fn a_pin_binds_a_pixel_to_a_robot() {
    let show = show(2, 5, 0.1);
    let mut world = World::ready(5, 0, show.clone());
    let robot = Some(world.robots[4].id);
    world.operate(Operation::Pin { pixel: 0, robot }).unwrap();
    world.play();
    assert_eq!(world.run_to_end(40.0).0, RunOutcome::Finished);
    assert!(world.robots[4].at.distance(show.frames[1].pixels[0].at) < 0.001);
    let away = RobotId::new("away");
    world.operate(Operation::Pin { pixel: 1, robot: away }).unwrap();
    let refused = world.operate(Operation::Play { from: 0, missing: MissingPolicy::Refuse });
    assert_eq!(refused, Err(Refusal::PinnedMissing { pixels: vec![1] }));
}

#[test]
fn pixels_of_another_show_do_not_keep_the_robots_of_the_former_one() {
    let mut show = Show { identity: Identity::Fixed, ..show(2, 5, 0.1) };
    for frame in &mut show.frames {
        frame.pixels.iter_mut().zip(0..).for_each(|(pixel, id)| pixel.id = id);
    }
    let mut world = World::ready(5, 0, show.clone());
    world.play();
    assert_eq!(world.run_to_end(40.0).0, RunOutcome::Finished);
    let stood: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    let mut other = Show { name: "other".into(), frames: show.frames[1..].to_vec(), ..show };
    other.frames[0].pixels.reverse();
    other.frames[0].pixels.iter_mut().zip(0..).for_each(|(pixel, id)| pixel.id = id);
    world.operate(Operation::Open(Arc::new(other))).unwrap();
    world.play();
    assert_eq!(world.run_to_end(40.0).0, RunOutcome::Finished);
    assert!(world.robots.iter().zip(stood).all(|(robot, stood)| robot.at.distance(stood) < 1e-3));
}

#[test]
fn a_robot_is_simulated_only_while_its_last_report_says_so() {
    let mut world = World::new(0, 0);
    let mut said = |report: &str| {
        world.controller.message(world.now, "T/LightBot/UUID", report.as_bytes());
        world.controller.snapshot(world.now).robots[0].reported.simulated
    };
    assert!(said("r7 0.1 0.2 state=idle sim=1"));
    assert!(!said("r7 0.1 0.2 state=idle"));
    assert!(said("r7 0.1 0.2 state=idle sim=1"));
    assert!(!said("r7 0.1 0.2"), "an original robot is real");
}

#[test]
fn a_show_that_validation_rejects_is_not_begun() {
    let mut unfit = show(2, 2, 0.0);
    unfit.frames[1].pixels[1].at.y = 1e308;
    let mut world = World::ready(2, 0, unfit);
    for operation in [
        Operation::Play { from: 0, missing: MissingPolicy::LeaveOut },
        Operation::Preview { frame: 0, missing: MissingPolicy::Refuse },
    ] {
        let refused = world.operate(operation).unwrap_err();
        assert!(matches!(refused, Refusal::Unfit { .. }), "{refused:?}");
        assert!(
            refused.to_string().contains("frame 2") && refused.to_string().contains("1e308"),
            "{refused}"
        );
    }
}

/// A world whose run was aborted while robot 3 kept a route. The robot receives and sends nothing until `unheard_s`
/// later.
fn aborted_without_robot_3(unheard_s: f64) -> World {
    let mut world = World::ready(10, 0, show(3, 10, 3.0));
    world.play();
    world.run_until(20.0, |kind| matches!(kind, EventKind::FrameReached { .. }));
    world.run_for(1.0);
    assert!(world.robots[3].kept.is_some());
    world.robots[3].dead = true;
    world.operate(Operation::Abort).unwrap();
    world.run_for(unheard_s);
    world.robots[3].dead = false;
    world
}

/// Checks that the abort of a run reaches a robot that keeps a route and receives nothing for `unheard_s`. It must keep
/// no route `within_s` after it receives messages again.
fn is_stopped_after(unheard_s: f64, within_s: f64) {
    let mut world = aborted_without_robot_3(unheard_s);
    world.run_for(within_s);
    assert!(world.robots[3].kept.is_none(), "{}", world.story());
}

#[test]
fn abort_reaches_a_robot_that_stands_and_hears_nothing_for_a_second() {
    is_stopped_after(1.0, 0.5);
}

/// By then the controller no longer stops any robot.
#[test]
fn a_robot_that_is_back_long_after_a_run_is_told_that_it_keeps_no_route() {
    is_stopped_after(20.0, 3.0);
}

/// A lost robot does not report whether it keeps a route, and answers each STOP with a report.
#[test]
fn a_robot_that_is_lost_after_a_run_is_told_now_and_then_that_it_keeps_no_route() {
    let mut world = aborted_without_robot_3(20.0);
    world.robots[3].lost = true;
    world.run_for(3.0);
    assert!(world.robots[3].kept.is_none(), "{}", world.story());
    world.run_for(10.0);
    assert!((1..=14).contains(&world.robots[3].stops), "{}", world.robots[3].stops);
    world.robots[3].lost = false;
    world.run_for(3.0);
    let stops = world.robots[3].stops;
    world.run_for(10.0);
    assert_eq!(world.robots[3].stops, stops, "it said that it is idle");
}

#[test]
fn all_robots_drive_home_and_the_show_stays_open() {
    let show = show(3, 9, 0.2);
    let mut world = World::ready(11, 0, show.clone());
    let starts: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    world.operate(Operation::Pin { pixel: 0, robot: Some(world.robots[5].id) }).unwrap();
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { frame: 1, .. }));
    assert_eq!(world.operate(Operation::Home), Err(Refusal::Busy(ControllerState::Playing)));
    world.operate(Operation::StopAll).unwrap();
    world.run_for(5.0);
    assert_eq!(
        world.operate(Operation::Preflight),
        Err(Refusal::NotDismissed),
        "the floor was not looked at"
    );
    world.operate(Operation::Home).unwrap();
    world.run_for(1.0);
    assert!(world.story().contains("Planned the drive home."), "{}", world.story());
    assert_eq!(world.controller.state(), ControllerState::Preview);
    assert!(world.controller.snapshot(world.now).run.is_some_and(|run| run.home));
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 1, 0), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{}", world.closest_m);
    let rows = lightbots_show::back_rows(&show.stage, 11);
    let is_home = |at: Vec2| rows.iter().any(|place| place.distance(at) < 0.02);
    assert!(world.robots.iter().all(|robot| is_home(robot.at)), "{}", world.story());
    assert!(!starts.iter().all(|at| is_home(*at)), "they began elsewhere");
    let snapshot = world.controller.snapshot(world.now);
    assert!(snapshot.robots.iter().all(|robot| robot.pixel.is_none()));
    world.play();
    assert_eq!(world.run_to_end(60.0), (RunOutcome::Finished, 3, 0), "{}", world.story());
}
