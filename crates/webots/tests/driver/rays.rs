//! One ray per sensor is almost enough. A robot that drives towards a standing robot brakes before it touches. The
//! exception is a robot that stands about a radius beside the middle of the path.

use Controller::proximity::RAYS;
use lightbots_base::{Instant, Pose, RobotId, Span, Vec2};
use lightbots_robot::{Config, Fix, Inputs, Message, Robot};
use lightbots_show::Stage;
use lightbots_sim::{STEP, World};
use lightbots_webots::rays::gaps_m;
use lightbots_wire::{Command, TimeAnswer, TimeQuestion, Topic, encode};

use crate::eyes::Eyes;
use crate::lead::route;

/// How far the show clock is ahead of the robot's clock.
const AHEAD: Span = Span::from_millis(1_000);

/// A robot with our core, and one without power.
struct Meeting {
    world: World,
    robot: Robot,
    eyes: Eyes,
    now: Instant,
}

impl Meeting {
    fn new(start: Vec2, dead: Vec2, seed: u64) -> Self {
        let poses = [Pose::new(start, std::f64::consts::FRAC_PI_2), Pose::new(dead, 0.3)];
        let id = RobotId::new("r").expect("a name");
        let mut robot =
            Robot::new(Config { fix_sigma_m: 0.0005, heading_sigma_rad: 0.002, ..Config::new(id) });
        robot.link(Instant::ZERO, true);
        let world = World::new(&Stage::default(), &poses, 0.0, seed);
        Self { world, robot, eyes: Eyes::new(seed), now: Instant::ZERO }
    }

    fn tell(&mut self, command: &Command) {
        let mut text = String::new();
        encode(command, &mut text).expect("a text takes everything");
        self.robot.receive(self.now, Topic::Robot(self.robot.id()), text.as_bytes());
    }

    /// Makes a step. Returns whether the robot reports that its path is blocked.
    fn step(&mut self) -> bool {
        self.world.step();
        self.now += STEP;
        let (pose, places) = (self.world.pose(0), self.world.places().to_vec());
        let clockwise_m = self.eyes.near_m(pose, &places);
        // As the driver does: from the sensor at 24 mm to the rim at 27 mm, and counter-clockwise.
        let along_m: [f64; RAYS] =
            std::array::from_fn(|ray| (clockwise_m[(RAYS - ray) % RAYS] - 0.003).max(0.0));
        let inputs = Inputs {
            wheel_turns_rad: self.world.wheel_turns(0),
            fix: Some(Fix { at: pose.at, heading: Some(pose.heading) }),
            proximity_m: Some(if std::env::var_os("IDEAL").is_some() {
                self.world.proximity_m(0)
            } else {
                gaps_m(&along_m)
            }),
            ..Inputs::default()
        };
        let outputs = self.robot.step(self.now, &inputs);
        self.world.command(0, outputs.wheels_radps);
        let (mut message, mut blocked) = (Message::new(), false);
        while let Some(topic) = self.robot.outgoing(&mut message) {
            if topic == Topic::Time {
                let asked = TimeQuestion::decode(message.as_bytes()).expect("a question").asked;
                let show = self.now + AHEAD;
                self.tell(&Command::Time(TimeAnswer { asked, received: show, sent: show }));
            } else {
                blocked |= message.contains("blocked=");
            }
        }
        blocked
    }

    fn steps(&mut self, count: usize) -> bool {
        (0..count).fold(false, |blocked, _| self.step() | blocked)
    }
}

/// Speed at which a robot that drives at 0.25 m/s touches a standing one, m/s. `aside_m` is how far that one is beside
/// the middle of the path. `None` if they do not touch.
fn touches_mps(aside_m: f64, seed: u64) -> Option<f64> {
    let (start, end) = (Vec2::new(0.0, -0.5), Vec2::new(0.0, 0.5));
    let mut meeting = Meeting::new(start, Vec2::new(aside_m, 0.0), seed);
    meeting.steps(200);
    let at = meeting.now + AHEAD + Span::from_millis(200);
    meeting.tell(&Command::Route(route(start, end)));
    meeting.tell(&Command::Start { seq: 1, at });
    let mut before = meeting.world.places()[0];
    for _ in 0..300 {
        meeting.step();
        let now = meeting.world.places()[0];
        if meeting.world.contacts().count() > 0 {
            return Some(now.distance(before) / STEP.as_secs());
        }
        before = now;
    }
    None
}

#[test]
#[allow(clippy::print_stdout)]
fn a_robot_brakes_for_one_that_stands_in_its_way() {
    let mut touched = Vec::new();
    for (aside_mm, seed) in (-52..=52_i32).flat_map(|aside_mm| (1..=8).map(move |seed| (aside_mm, seed))) {
        if let Some(mps) = touches_mps(f64::from(aside_mm) * 1e-3, seed) {
            println!("{aside_mm} mm beside, seed {seed}: touches at {mps:.3} m/s");
            touched.push(aside_mm.abs());
        }
    }
    // They touch only where the ray ahead just misses the other robot and the next ray hits it beside its middle.
    assert!(touched.len() <= 16, "{} of 840 touch", touched.len());
    assert!(touched.iter().all(|aside_mm| (26..=30).contains(aside_mm)), "{touched:?}");
}
