use super::*;

/// A pose in the middle of the floor with the front along x.
const FRONT: Pose = Pose::new(Vec2::ZERO, 0.0);

fn world(starts: &[Pose]) -> World {
    World::new(&Stage::default(), starts, 0.0, 1)
}

fn run(world: &mut World, steps: usize) {
    (0..steps).for_each(|_| world.step());
}

fn pose(x: f64, y: f64, heading: f64) -> Pose {
    Pose::new(Vec2::new(x, y), heading)
}

#[test]
fn a_straight_drive_is_straight_and_as_fast_as_measured() {
    let mut world = world(&[pose(-1.0, 0.0, 0.0)]);
    world.command(0, [60.0; 2]);
    run(&mut world, 10);
    let begin = world.pose(0).at.x;
    run(&mut world, 400);
    let driven = world.pose(0).at.x - begin;
    assert!((driven / (400.0 * STEP_S) - 0.27).abs() < 1e-9);
    assert_eq!(world.pose(0).at.y, 0.0);
    assert_eq!(world.wheel_turns(0), [60.0 * STEP_S; 2]);
}

#[test]
fn a_circle_closes_on_itself_and_heading_agrees_with_its_vector() {
    let mut world = world(&[FRONT]);
    world.command(0, [20.0, 40.0]);
    run(&mut world, 20_000);
    let heading = world.pose(0).heading;
    assert!((Vec2::unit(heading) - world.contact_states[0].forward).length() < 1e-9);
    // v = 0.135 m/s: a circle of v / ω stays within its diameter.
    assert!(world.pose(0).at.length() < 2.0 * 0.135 / 2.1);
}

#[test]
fn head_on_both_stop_dead() {
    let mut world = world(&[pose(-0.2, 0.0, 0.0), pose(0.2, 0.0, std::f64::consts::PI)]);
    world.command(0, [60.0; 2]);
    world.command(1, [60.0; 2]);
    run(&mut world, 100);
    let (a, b) = (world.pose(0).at, world.pose(1).at);
    assert!((a.distance(b) - 0.054).abs() < 1e-6, "{a:?} {b:?}");
    assert!((a.x + b.x).abs() < 1e-6);
    assert_eq!(world.contacts().count(), 1);
    assert!(world.contacts().closest_m().unwrap() > 0.054 - 2.0 * 0.0044);
}

/// A neighbour list made for the contact distance alone would hide robots from each other's sensors.
#[test]
fn robots_that_come_near_each_other_are_in_sight_wherever_they_began() {
    for apart_mm in 90..200 {
        let half_m = f64::from(apart_mm) / 2000.0;
        let mut world = world(&[pose(-half_m, 0.0, 0.0), pose(half_m, 0.0, std::f64::consts::PI)]);
        (0..2).for_each(|robot| world.command(robot, [60.0; 2]));
        while world.contacts().count() == 0 {
            world.step();
            let gap_m = world.pose(0).at.distance(world.pose(1).at) - 0.054;
            let sees = world.contacts().in_sight() == [(0, 1)];
            assert!(sees || gap_m >= 0.03, "begun {apart_mm} mm apart, {gap_m} m left");
        }
    }
}

#[test]
fn a_standing_robot_is_pushed_a_centimetre_along_its_wheels() {
    let mut world = world(&[pose(-0.2, 0.0, 0.0), FRONT]);
    world.command(0, [60.0; 2]);
    run(&mut world, 200);
    let pushed = world.pose(1).at.x;
    assert!((pushed / 0.01 - 1.0).abs() < 0.02, "{pushed}");
    assert!((world.pose(0).at.x - (pushed - 0.054)).abs() < 1e-4);
}

#[test]
fn a_standing_robot_is_pushed_slowly_from_its_side() {
    let mut world = world(&[pose(-0.2, 0.0, 0.0), pose(0.0, 0.0, std::f64::consts::FRAC_PI_2)]);
    world.command(0, [60.0; 2]);
    run(&mut world, 100);
    let before = world.pose(1).at.x;
    run(&mut world, 100);
    let speed = (world.pose(1).at.x - before) / (100.0 * STEP_S);
    assert!((speed / 0.06 - 1.0).abs() < 0.02, "{speed}");
}

#[test]
fn a_wall_holds_at_a_radius_and_counts_once() {
    let mut world = world(&[pose(1.3, 0.0, 0.0)]);
    world.command(0, [60.0; 2]);
    run(&mut world, 200);
    assert!((1.5 - world.pose(0).at.x - 0.027).abs() < 1e-9);
    assert_eq!((world.bumps().edges, world.bumps().obstacles, world.bumps().over), (1, 0, 1));
}

#[test]
fn a_crowd_pushed_together_never_overlaps_for_long() {
    let starts: Vec<Pose> = (0..12)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::TAU / 12.0;
            Pose::new(Vec2::unit(angle) * 0.5, angle + std::f64::consts::PI)
        })
        .collect();
    let mut world = world(&starts);
    (0..12).for_each(|robot| world.command(robot, [60.0; 2]));
    run(&mut world, 400);
    for a in 0..12 {
        for b in a + 1..12 {
            assert!(world.places()[a].distance(world.places()[b]) > 0.054 - 0.006);
        }
    }
}

#[test]
fn slip_shortens_the_way_and_a_seed_repeats_it() {
    let drive = |seed| {
        let mut world = World::new(&Stage::default(), &[pose(-1.4, 0.0, 0.0)], 0.03, seed);
        world.command(0, [60.0; 2]);
        run(&mut world, 300);
        let mut hash = StateHash::new();
        world.imprint(&mut hash);
        (world.pose(0).at.x + 1.4, hash.finish())
    };
    let way = drive(1).0 / (0.27 * STEP_S * 298.0);
    assert!((0.93..0.995).contains(&way), "{way}");
    assert_eq!(drive(1), drive(1));
    assert_ne!(drive(1).1, drive(2).1);
}

#[test]
fn robots_at_rest_stay_to_the_bit() {
    let mut world = world(&[FRONT, pose(0.0540001, 0.0, 1.0)]);
    run(&mut world, 50);
    assert_eq!(world.pose(0), FRONT);
    assert_eq!(world.contacts().count(), 0);
}
