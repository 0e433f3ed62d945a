//! A robot with senseless messages and sensor readings. It never panics, its wheels stay within bounds, and the same
//! inputs give the same outputs.

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_robot::{Config, Fix, Inputs, Message, Robot};
use lightbots_wire::Topic;

const PAYLOADS: [&str; 14] = [
    "|TARGET 0.3 -0.2|",
    "|TARGET Infinity NaN|",
    "|PATH 7 0 0 R 100000 C 400000 100 0 900 500 1000 1000 L 1 -10000000 3|",
    "|PATH 8 0 0|",
    "|START 7 {}|",
    "|START 8 {}|",
    "|HOLD {}|",
    "|RESUME {}|",
    "|TIME {} {} {}|",
    "|FADE 255 {} 300000|",
    "|BLINK 100000|",
    "|STOP|",
    "|STATUS||UUID|",
    "|",
];

struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % sides
    }

    fn number(&mut self) -> f64 {
        match self.roll(40) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => 1e300,
            3 => -1e9,
            _ => (self.roll(2001) as f64 - 1000.0) / 1000.0,
        }
    }

    fn inputs(&mut self) -> Inputs {
        let fix = Fix { at: Vec2::new(self.number(), self.number()), heading: Some(self.number()) };
        Inputs {
            wheel_turns_rad: [self.number(), self.number()],
            fix: (self.roll(3) > 0).then_some(fix),
            lag: Span(self.roll(4_000_000) as i64 - 1_000_000),
            battery: Some(self.roll(256) as u8),
            proximity_m: (self.roll(2) > 0).then(|| core::array::from_fn(|_| self.number() as f32 * 0.1)),
        }
    }

    fn payload(&mut self, now: Instant) -> Vec<u8> {
        let mut text = PAYLOADS[self.roll(PAYLOADS.len() as u64) as usize].to_string();
        while text.contains("{}") {
            let moment = [0, now.0, now.0 + self.roll(2_000_000), i64::MAX as u64][self.roll(4) as usize];
            text = text.replacen("{}", &moment.to_string(), 1);
        }
        let mut bytes = text.into_bytes();
        if self.roll(4) == 0 {
            let place = self.roll(bytes.len() as u64) as usize;
            bytes[place] = self.roll(256) as u8;
        }
        bytes
    }
}

/// Runs a robot for 4000 random steps. Returns all its outputs and messages as text.
fn life(seed: u64) -> String {
    let mut dice = Dice(seed * 2 + 1);
    let id = RobotId::new("r1").unwrap();
    let mut robot = Robot::new(Config::new(id));
    let mut now = Instant(1000);
    let mut told = String::new();
    let mut message = Message::new();
    for _ in 0..4000 {
        now = match dice.roll(500) {
            0 => Instant(dice.roll(1 << 40)),
            _ => Instant(now.0 + 16_000),
        };
        match dice.roll(20) {
            0 => robot.link(now, dice.roll(2) == 0),
            1..6 => robot.receive(now, Topic::Robot(id), &dice.payload(now)),
            _ => {}
        }
        let outputs = robot.step(now, &dice.inputs());
        assert!(outputs.wheels_radps.iter().all(|rate| rate.abs() <= 133.0), "seed {seed}: {outputs:?}");
        told += &format!("{outputs:?}\n");
        for _ in 0..5 {
            if robot.outgoing(&mut message).is_some() {
                told += &message;
            }
        }
        assert_eq!(robot.outgoing(&mut message), None, "seed {seed}: it has too much to say");
    }
    told
}

#[test]
fn nothing_makes_it_panic_or_race_and_its_life_can_be_replayed() {
    for seed in 0..8 {
        assert!(life(seed) == life(seed), "seed {seed}");
    }
}
