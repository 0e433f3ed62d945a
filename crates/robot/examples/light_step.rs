//! Measures how much longer a step takes with light tracks:
//! `cargo run --release -p lightbots-robot --example light_step`. `cargo xtask bench light-step` runs it.
//!
//! Two robots drive the same route in the same world, one of them with light. Their inputs are recorded and then played
//! repeatedly to robots that were just switched on. Only steps are timed.
#![allow(clippy::print_stdout, dead_code)]

#[path = "../tests/plant/mod.rs"]
mod plant;

use std::hint::black_box;
use std::time::{Duration, Instant as Moment};

use lightbots_base::{Instant, PathRef, Rgb, RobotId, Span, TICK, Vec2};
use lightbots_light::{BlendMode, Coordinate, Layers, LightEffect, LightLayer, Look, Palette};
use lightbots_lighting::{DrivenLight, FrameLight, LightMoment, Tolerance, fit};
use lightbots_robot::{Config, Message, Robot};
use lightbots_wire::{Command, LightAnchor, LightRecords, LightStretch, MAX_LIGHT_RECORDS, Route, Topic};
use plant::{Flaws, Plant, STEP, Turn, straight};

/// Number of interleaved runs. It is odd, for the median.
const ROUNDS: usize = 101;
/// Start of a route that takes 18.9 s, stage metres.
const START: Vec2 = Vec2::new(-2.5, 0.0);
/// End of that route, stage metres.
const END: Vec2 = Vec2::new(2.5, 0.0);
/// Number of that route.
const SEQ: u32 = 1;
/// Duration of a stretch.
const STRETCH: Span = Span::from_millis(10_000);
/// Remaining time of a stretch at which the next one is sent, as by the controller.
const REFILL: Span = Span::from_millis(5_000);
/// How long the robot stands after its drive.
const STANDS: Span = Span::from_millis(20_000);
/// Steps that are timed together, because reading the clock takes as long as a part of a step.
const AT_ONCE: usize = 32;

/// Inputs of a robot, and the times of its own clock at which its drive begins and ends.
struct Recording {
    turns: Vec<Turn>,
    drives: (Instant, Instant),
}

/// Duration and number of the steps of one run: while the robot drives, and while it stands.
type Taken = [(Duration, usize); 2];

fn main() {
    let [dark, lit] = [false, true].map(record);
    let mut runs: Vec<(Taken, Taken)> = Vec::new();
    for round in 0..=ROUNDS {
        // The order alternates, because the second run finds a warmer machine.
        let dark_first = round % 2 == 0;
        let first = play(if dark_first { &dark } else { &lit });
        let second = play(if dark_first { &lit } else { &dark });
        runs.push(if dark_first { (first, second) } else { (second, first) });
    }
    // The first round is left out, because it loads code.
    runs.remove(0);
    for (phase, name) in ["drives", "stands"].into_iter().enumerate() {
        let without = median(runs.iter().map(|run| nanoseconds(run.0[phase])));
        let with = median(runs.iter().map(|run| nanoseconds(run.1[phase])));
        let ratio = median(runs.iter().map(|run| nanoseconds(run.1[phase]) / nanoseconds(run.0[phase])));
        let more = 100.0 * (ratio - 1.0);
        println!(
            "{{\"robot\":\"{name}\",\"runs\":{ROUNDS},\"without_light_ns\":{without:.1},\"with_light_ns\":{with:.1},\
             \"more_%\":{more:.1}}}"
        );
    }
}

fn nanoseconds((taken, steps): (Duration, usize)) -> f64 {
    taken.as_secs_f64() * 1e9 / steps.max(1) as f64
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or_default()
}

/// Records a robot that drives and then stands, with or without light.
fn record(is_lit: bool) -> Recording {
    let mut plant = Plant::new(START, 0.0, Flaws::STANDARD, 1);
    plant.turns = Some(Vec::new());
    plant.run(3.0);
    let route = straight(SEQ, START, END);
    let drive = PathRef::new(route.start, &route.pieces).duration();
    plant.tell(&Command::Route(route.clone()));
    let begins = plant.show() + Span::from_millis(400);
    let mut number = 1;
    if is_lit {
        plant.tell(&Command::Light(stretch(&route, number, LightAnchor::Start(SEQ))));
    }
    plant.tell(&Command::Start { seq: SEQ, at: begins });
    while plant.show() < begins + drive + STANDS {
        if is_lit && plant.show() > begins + STRETCH * i64::from(number) - REFILL {
            number += 1;
            plant.tell(&Command::Light(stretch(&route, number, LightAnchor::Moment(begins))));
        }
        plant.step();
    }
    let own = |show: Instant| show - (plant.show() - plant.now);
    Recording { drives: (own(begins), own(begins + drive)), turns: plant.turns.take().unwrap_or_default() }
}

/// A stretch of ten seconds of three moving layers, for a robot that drives `route` and then stands.
fn stretch(route: &Route, number: u32, anchor: LightAnchor) -> LightStretch {
    let path = PathRef::new(route.start, &route.pieces);
    let robot = DrivenLight {
        number: (3, 9),
        frame: 0,
        pixel: Some(3),
        colours: [Rgb::new(255, 80, 0); 3],
        shines: [true; 2],
        path: Some(path),
        goal: END,
        drive: path.duration(),
    };
    let skip = STRETCH * i64::from(number - 1);
    let light = FrameLight { layers: layers(), ..FrameLight::default() };
    let samples = robot.samples(&light, &[], (STRETCH.0 / TICK.0) as u32, |time| {
        let elapsed = skip + time;
        LightMoment { elapsed, show_s: elapsed.as_secs(), lead_s: 0.0, clock_s: 0.0 }
    });
    let fitted = fit(&samples, Tolerance::SIDE_BY_SIDE, MAX_LIGHT_RECORDS);
    let records = LightRecords::from_slice(&fitted.records).expect("the fit has no more");
    LightStretch { number, anchor, skip, over: Span::ZERO, start: fitted.start, records }
}

/// Three layers: a rainbow, a chase and a twinkle.
fn layers() -> Layers {
    let rainbow = LightEffect::Rainbow { along: Coordinate::Line, saturation: 1.0 };
    let rising = || Look { palette: Palette::rising(Rgb::new(255, 255, 255)), ..Look::default() };
    let added = |effect| LightLayer { blend: BlendMode::Add, ..LightLayer::new(effect, rising()) };
    let layers = vec![
        LightLayer::new(rainbow, Look { speed_hz: 0.2, ..Look::default() }),
        added(LightEffect::Chase(Coordinate::Line)),
        added(LightEffect::Twinkle { density: 0.5 }),
    ];
    Layers::new(layers).expect("the layers are valid")
}

/// Plays the inputs to a robot that was just switched on. Returns the durations of its steps.
fn play(recording: &Recording) -> Taken {
    let id = RobotId::new("r1").expect("a name");
    let mut robot = Robot::new(Config::new(id));
    robot.link(Instant::ZERO, true);
    let (begins, ends) = recording.drives;
    let mut message = Message::new();
    let mut taken = Taken::default();
    let mut turns = recording.turns.as_slice();
    while let Some(first) = turns.first() {
        if let Turn::Message(now, text) = first {
            robot.receive(*now, Topic::Robot(id), text);
            turns = &turns[1..];
            continue;
        }
        let steps: Vec<_> = turns.iter().take(AT_ONCE).map_while(step).collect();
        let since = Moment::now();
        for (now, inputs) in &steps {
            black_box(robot.step(*now, inputs));
        }
        let took = since.elapsed();
        let from = steps[0].0;
        let phase = match from + STEP * AT_ONCE as i64 {
            _ if from < begins => None,
            until if until <= ends => Some(0),
            _ => (from > ends).then_some(1),
        };
        if let Some(phase) = phase {
            taken[phase] = (taken[phase].0 + took, taken[phase].1 + steps.len());
        }
        while robot.outgoing(&mut message).is_some() {}
        turns = &turns[steps.len()..];
    }
    taken
}

fn step(turn: &Turn) -> Option<(Instant, lightbots_robot::Inputs)> {
    match turn {
        Turn::Step(now, inputs) => Some((*now, *inputs)),
        Turn::Message(..) => None,
    }
}
