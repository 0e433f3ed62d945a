//! Compares the contacts of the simulated world with those of a physics engine: the same robots drive in both.

use lightbots_base::{Pose, Vec2};
use lightbots_show::Stage;
use lightbots_sim::{Dice, Purpose, World};
use rapier2d::prelude as rapier;
use rapier2d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle};

/// Radius of a disc in the engine, metres: that of a robot.
const RADIUS_M: f64 = 0.027;
/// Distance of two centres at which discs touch, metres.
const CONTACT_M: f64 = 2.0 * RADIUS_M;
/// Gap between rims at which grazing discs slide past each other in the engine, metres.
const HAIR_M: f64 = 0.001;
/// Wheel rate of all robots, rad/s.
const WHEELS_RADPS: f64 = 60.0;
/// Speed of a robot at [`WHEELS_RADPS`], m/s. The engine's discs are driven with it.
const SPEED_MPS: f64 = 0.27;

/// The same discs in both worlds, driven at full speed along their headings.
struct Pair {
    ours: World,
    theirs: PhysicsWorld,
    discs: Vec<(RigidBodyHandle, Vec2)>,
    touched: (bool, bool),
    steps: usize,
}

impl Pair {
    fn new(starts: &[Pose]) -> Self {
        let mut theirs = PhysicsWorld { gravity: rapier::Vector::new(0.0, 0.0), ..PhysicsWorld::default() };
        theirs.integration_parameters.dt = 0.016;
        theirs.integration_parameters.length_unit = 0.05;
        for (x, y, half_x, half_y) in
            [(-2.5, 0.0, 1.0, 3.0), (2.5, 0.0, 1.0, 3.0), (0.0, -2.5, 3.0, 1.0), (0.0, 2.5, 3.0, 1.0)]
        {
            let wall =
                ColliderBuilder::cuboid(half_x, half_y).translation(rapier::Vector::new(x, y)).friction(0.0);
            theirs.colliders.insert(wall);
        }
        let mut ours = World::new(&Stage::default(), starts, 0.0, 1);
        let mut discs = Vec::new();
        for (robot, start) in starts.iter().enumerate() {
            let place = rapier::Vector::new(start.at.x as f32, start.at.y as f32);
            let body = RigidBodyBuilder::dynamic().translation(place).lock_rotations().can_sleep(false);
            let handle = theirs.bodies.insert(body);
            let disc = ColliderBuilder::ball(RADIUS_M as f32).friction(0.0).density(17.0);
            theirs.colliders.insert_with_parent(disc, handle, &mut theirs.bodies);
            discs.push((handle, Vec2::unit(start.heading) * SPEED_MPS));
            ours.command(robot, [WHEELS_RADPS; 2]);
        }
        // Our robots take five steps to reach a steady speed. The engine's discs start after that, at the places of
        // ours.
        for _ in 0..8 {
            ours.step();
        }
        for (robot, (handle, _)) in discs.iter().enumerate() {
            let at = ours.pose(robot).at;
            theirs.bodies[*handle].set_translation(rapier::Vector::new(at.x as f32, at.y as f32), true);
        }
        Self { ours, theirs, discs, touched: (false, false), steps: 0 }
    }

    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            for (handle, velocity) in &self.discs {
                let velocity = rapier::Vector::new(velocity.x as f32, velocity.y as f32);
                self.theirs.bodies[*handle].set_linvel(velocity, true);
            }
            self.theirs.step();
            self.ours.step();
            self.steps += 1;
            self.touched.0 |= self.ours.contacts().count() > 0;
            self.touched.1 |= self.closest_theirs() < CONTACT_M + HAIR_M;
        }
    }

    fn theirs(&self, robot: usize) -> Vec2 {
        let at = self.theirs.bodies[self.discs[robot].0].translation();
        Vec2::new(f64::from(at.x), f64::from(at.y))
    }

    fn closest_theirs(&self) -> f64 {
        let mut closest = f64::MAX;
        for a in 0..self.discs.len() {
            for b in a + 1..self.discs.len() {
                closest = closest.min(self.theirs(a).distance(self.theirs(b)));
            }
        }
        closest
    }

    /// Distance between a robot's places in the two worlds, metres.
    fn apart(&self, robot: usize) -> f64 {
        self.ours.pose(robot).at.distance(self.theirs(robot))
    }
}

fn pose(x: f64, y: f64, heading: f64) -> Pose {
    Pose::new(Vec2::new(x, y), heading)
}

#[test]
fn head_on_both_worlds_stop_at_the_same_place() {
    let mut pair = Pair::new(&[pose(-0.4, 0.0, 0.0), pose(0.3, 0.0, std::f64::consts::PI)]);
    pair.run(150);
    for robot in 0..2 {
        assert!(
            pair.apart(robot) < 0.002,
            "robot {robot}: {:?}",
            (pair.ours.pose(robot).at, pair.theirs(robot))
        );
    }
}

#[test]
fn at_a_wall_both_worlds_stand_a_radius_from_it() {
    let mut pair = Pair::new(&[pose(1.2, 0.3, 0.0), pose(-0.4, -1.2, -1.2)]);
    pair.run(200);
    assert!((pair.ours.pose(0).at.x - 1.473).abs() < 1e-9);
    assert!(pair.apart(0) < 0.001);
    // Both robots slide along the wall with the part of their speed that is parallel to it.
    assert!(pair.apart(1) < 0.01, "{:?}", (pair.ours.pose(1).at, pair.theirs(1)));
}

#[test]
fn whether_two_touch_is_the_same_in_both_worlds() {
    let mut dice = Dice::new(11, Purpose::Robots);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..150 {
        let aim = |dice: &mut Dice| {
            let angle = dice.between(-3.0, 3.0);
            let target = Vec2::new(dice.between(-0.08, 0.08), dice.between(-0.08, 0.08));
            Pose::new(target - Vec2::unit(angle) * 0.4, angle)
        };
        let starts = [aim(&mut dice), aim(&mut dice)];
        if starts[0].at.distance(starts[1].at) < 0.1 {
            continue;
        }
        let mut pair = Pair::new(&starts);
        pair.run(120);
        let closest = pair.ours.contacts().closest_m().unwrap_or(f64::MAX);
        let grazes = (closest - CONTACT_M).abs() < 2.0 * HAIR_M;
        assert!(pair.touched.0 == pair.touched.1 || grazes, "{starts:?}: {:?}", pair.touched);
        if pair.touched.0 { met += 1 } else { missed += 1 }
    }
    assert!(met > 20 && missed > 20, "{met} met, {missed} missed");
}

#[test]
fn three_driven_into_one_another_hold_each_other_up_alike() {
    let starts: Vec<Pose> = (0..3)
        .map(|index| {
            let angle = f64::from(index) * std::f64::consts::TAU / 3.0 + 0.3;
            Pose::new(Vec2::unit(angle) * 0.4, angle + std::f64::consts::PI)
        })
        .collect();
    let mut pair = Pair::new(&starts);
    // The robots meet after 83 steps. Much later the two worlds differ, because three round discs do not stay in
    // balance.
    pair.run(90);
    for robot in 0..3 {
        assert!(pair.ours.pose(robot).at.length() < 0.035);
        assert!(pair.apart(robot) < 0.004, "{:?}", (pair.ours.pose(robot).at, pair.theirs(robot)));
    }
}
