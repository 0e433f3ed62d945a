//! A robot that stops sending messages, and the places where it may stand.

mod fleet;

use fleet::{World, show};
use lightbots_base::Vec2;
use lightbots_control::{EventKind, RunOutcome};
use lightbots_show::{Identity, Obstacle, Show};

/// Distance between the centres of two robots that touch, metres.
const CONTACT_M: f64 = 0.054;
/// Distance from the walls at which one robot drives past the bay, metres.
const LANE_M: f64 = 0.04;

/// A show with a bay between walls, 0.12 m wide and open at its upper end. Robot 0 is in the bay, and robot 3 drives
/// past its mouth from left to right. Then robot 0 drives out and along robot 3's lane. Robots 1 and 2 stand far away.
fn past_a_bay() -> Show {
    let wall = |x0, y0, x1, y1| Obstacle::Rect { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) };
    let mut show = show(3, 4, 0.3);
    show.stage.obstacles =
        vec![wall(-0.1, -0.3, -0.06, 0.0), wall(0.06, -0.3, 0.1, 0.0), wall(-0.1, -0.34, 0.1, -0.3)];
    let (far, bay) = ([Vec2::new(1.2, 1.2), Vec2::new(1.2, -1.2)], Vec2::new(0.0, -0.15));
    let lane = |x| Vec2::new(x, LANE_M);
    let places = [[bay, lane(-1.2)], [bay, lane(0.9)], [lane(-0.9), lane(1.2)]];
    for (frame, [of_bay, passing]) in show.frames.iter_mut().zip(places) {
        for (pixel, at) in frame.pixels.iter_mut().zip([of_bay, far[0], far[1], passing]) {
            pixel.at = at;
        }
    }
    show.frames[1].identity = Some(Identity::Fixed);
    show
}

/// Plays the show until the robot that is to pass the bay dies short of it. Returns the world and the number of that
/// robot.
fn one_dies_past_a_bay() -> (World, usize) {
    let mut world = World::ready(4, 0, past_a_bay());
    world.play();
    world.run_until(60.0, |kind| matches!(kind, EventKind::FrameReached { frame: 0, .. }));
    let passing = world.robots.iter().position(|robot| robot.at.x < -1.1).unwrap();
    while world.robots[passing].at.x < -0.54 {
        world.step();
    }
    world.robots[passing].dead = true;
    (world, passing)
}

/// The silent robot may have driven on until it noticed the lost link, and may stand in front of the bay. Then a robot
/// in the bay could not get out. It more likely stands where it last reported, and at least that place is driven
/// around.
#[test]
fn where_there_is_no_way_around_all_places_of_a_silent_robot_the_likely_ones_are_driven_around() {
    let (mut world, _) = one_dies_past_a_bay();
    let failed = |kind: &EventKind| matches!(kind, EventKind::PlanFailed { frame: 2, .. });
    let why = world.run_until(30.0, failed).kind.to_string();
    assert!(why.contains("walled in"), "{why}");
    let (outcome, frames, dropouts) = world.run_to_end(90.0);
    assert_eq!((outcome, frames, dropouts), (RunOutcome::Finished, 3, 1), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{} m: {}", world.closest_m, world.story());
    assert_eq!(world.lit(&past_a_bay().frames[2]), 3, "{}", world.story());
}

/// A robot that reports an unknown place still stands somewhere on the floor.
#[test]
fn a_robot_that_does_not_know_its_place_is_driven_around() {
    let (mut world, passing) = one_dies_past_a_bay();
    let report = format!("{} NaN NaN state=lost", world.robots[passing].id);
    world.inject("T/LightBot/Status", report.as_bytes());
    assert_eq!(world.run_to_end(90.0), (RunOutcome::Finished, 3, 1), "{}", world.story());
    assert!(world.closest_m >= CONTACT_M, "{} m: {}", world.closest_m, world.story());
}
