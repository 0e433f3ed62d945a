//! A small simulated world for tests of a whole robot: a unicycle with one step of dead time, wheel slip and noisy
//! sensors. The controller's clock is the show clock.

use lightbots_base::{Instant, Limits, Piece, RobotId, Span, Vec2, wrap};
use lightbots_robot::{Config, Fix, Inputs, Message, Outputs, Robot, SENSORS};
use lightbots_wire::{Command, Pieces, Report, Route, TimeAnswer, TimeQuestion, Topic, encode};

/// Duration of one step.
pub const STEP: Span = Span(16_000);

/// Errors of this world.
#[derive(Clone, Copy)]
pub struct Flaws {
    /// Standard deviation of each coordinate of a fix, metres.
    pub fix_sigma_m: f64,
    /// Standard deviation of a fix's heading, radians. `None`: fixes have no heading.
    pub heading_sigma_rad: Option<f64>,
    /// Share of its turning that the left and the right wheel lose.
    pub slip: [f64; 2],
    /// Delay of a fix, steps.
    pub fix_delay_steps: usize,
}

impl Flaws {
    /// The standard conditions of a rehearsal.
    pub const STANDARD: Self =
        Self { fix_sigma_m: 0.002, heading_sigma_rad: Some(0.0175), slip: [0.03, 0.0], fix_delay_steps: 0 };
    /// A world without errors.
    pub const NONE: Self =
        Self { fix_sigma_m: 0.0, heading_sigma_rad: Some(0.0), slip: [0.0, 0.0], fix_delay_steps: 0 };
}

/// An input of a robot, recorded for benchmarks.
#[allow(dead_code)]
#[derive(Clone)]
pub enum Turn {
    /// A message on the robot's own topic, and its arrival.
    Message(Instant, Vec<u8>),
    /// A step, and its inputs.
    Step(Instant, Inputs),
}

/// A robot, its floor and its controller.
pub struct Plant {
    pub robot: Robot,
    pub id: RobotId,
    /// The robot's own clock, which here is 5 s behind the show clock.
    pub now: Instant,
    /// How far this world lags behind the robot's own clock.
    pub lag: Span,
    /// Its true place.
    pub at: Vec2,
    pub heading: f64,
    pub flaws: Flaws,
    /// Whether the robot receives fixes.
    pub sees: bool,
    /// What its proximity sensors read, if anything is there.
    pub gaps_m: Option<[f32; SENSORS]>,
    /// Whether time requests are answered.
    pub answers: bool,
    pub last: Outputs,
    /// Everything that the robot sent except time requests.
    pub said: Vec<(Topic, Report)>,
    /// All inputs of the robot, if they are recorded.
    pub turns: Option<Vec<Turn>>,
    /// True wheel rates of the present step.
    wheels: [f64; 2],
    past: Vec<(Vec2, f64)>,
    seed: u64,
}

impl Plant {
    pub fn new(at: Vec2, heading: f64, flaws: Flaws, seed: u64) -> Self {
        let id = RobotId::new("r1").unwrap();
        let config = Config { fix_delay: STEP * flaws.fix_delay_steps as i64, ..Config::new(id) };
        let mut robot = Robot::new(config);
        robot.link(Instant::ZERO, true);
        Self {
            robot,
            id,
            now: Instant::ZERO,
            lag: Span::ZERO,
            at,
            heading,
            flaws,
            sees: true,
            gaps_m: None,
            answers: true,
            last: Outputs::default(),
            said: Vec::new(),
            turns: None,
            wheels: [0.0; 2],
            past: Vec::new(),
            seed: seed * 2 + 1,
        }
    }

    /// A plant whose clock is already synchronised.
    pub fn ready(at: Vec2, heading: f64, flaws: Flaws, seed: u64) -> Self {
        let mut plant = Self::new(at, heading, flaws, seed);
        plant.run(3.0);
        plant.said.clear();
        plant
    }

    pub fn show(&self) -> Instant {
        self.now + Span::from_secs(5.0)
    }

    pub fn tell(&mut self, command: &Command) {
        let mut text = String::new();
        encode(command, &mut text).unwrap();
        self.tell_text(text.as_bytes());
    }

    pub fn tell_text(&mut self, payload: &[u8]) {
        if let Some(turns) = &mut self.turns {
            turns.push(Turn::Message(self.now, payload.to_vec()));
        }
        self.robot.receive(self.now, Topic::Robot(self.id), payload);
    }

    pub fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds / STEP.as_secs()).round() as usize {
            self.step();
        }
    }

    pub fn step(&mut self) {
        let dt = STEP.as_secs();
        self.now += STEP;
        let Limits { wheel_radius_m, track_m, .. } = Limits::ELISA_3;
        let ground =
            [0, 1].map(|side| self.wheels[side] * (1.0 - self.flaws.slip[side]) * wheel_radius_m * dt);
        let (way, turn) = ((ground[0] + ground[1]) / 2.0, (ground[1] - ground[0]) / track_m);
        self.at += Vec2::unit(self.heading + turn / 2.0) * way;
        self.heading = wrap(self.heading + turn);
        let turns = self.wheels.map(|rate| rate * dt);
        // Rates that the robot commands in this step take effect in the next one.
        self.wheels = self.last.wheels_radps;
        let (fix, lag) = (self.fix(), self.lag);
        let proximity_m = self.gaps_m;
        let inputs = Inputs { wheel_turns_rad: turns, fix, battery: Some(80), lag, proximity_m };
        if let Some(turns) = &mut self.turns {
            turns.push(Turn::Step(self.now, inputs));
        }
        self.last = self.robot.step(self.now, &inputs);
        self.drain();
    }

    fn fix(&mut self) -> Option<Fix> {
        self.past.push((self.at, self.heading));
        let then = self.past.len().saturating_sub(1 + self.flaws.fix_delay_steps);
        let (at, heading) = self.past[then];
        let sigma = self.flaws.fix_sigma_m;
        let at = at + Vec2::new(self.gauss(), self.gauss()) * sigma;
        let heading = self.flaws.heading_sigma_rad.map(|sigma| wrap(heading + self.gauss() * sigma));
        self.sees.then_some(Fix { at, heading })
    }

    fn drain(&mut self) {
        let mut message = Message::new();
        while let Some(topic) = self.robot.outgoing(&mut message) {
            if topic != Topic::Time {
                self.said.push((topic, Report::decode(message.as_bytes()).unwrap()));
            } else if self.answers {
                let question = TimeQuestion::decode(message.as_bytes()).unwrap();
                let show = self.show();
                self.tell(&Command::Time(TimeAnswer { asked: question.asked, received: show, sent: show }));
            }
        }
    }

    /// The reports on a topic until now.
    pub fn heard(&self, topic: Topic) -> Vec<&Report> {
        self.said.iter().filter(|(on, _)| *on == topic).map(|(_, report)| report).collect()
    }

    pub fn stands(&self) -> bool {
        self.last.wheels_radps == [0.0; 2]
    }

    fn uniform(&mut self) -> f64 {
        self.seed = self.seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.seed >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A standard normal random number, as the sum of twelve uniform ones.
    fn gauss(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// A route that turns for 0.35 s and then goes straight at 0.27 m/s, with ramps of 1 m/s².
pub fn straight(seq: u32, start: Vec2, end: Vec2) -> Route {
    let way = end - start;
    let direction = way.normalized().unwrap();
    let ramp = Span::from_secs(0.27);
    let ramp_way = direction * (0.27 * 0.27 / 2.0);
    let cruise = Span::from_secs(way.length() / 0.27 - 0.27);
    let (a, b) = (start + ramp_way, end - ramp_way);
    let v = direction * 0.27;
    let pieces = [
        Piece::rest(start, Span::from_secs(0.35)),
        Piece::hermite(start, Vec2::ZERO, a, v, ramp),
        Piece::straight(a, b, cruise),
        Piece::hermite(b, v, end, Vec2::ZERO, ramp),
    ];
    Route {
        seq,
        start,
        pieces: Pieces::from_slice(&pieces).unwrap(),
        room_mm: None,
        neighbours: Default::default(),
    }
}
