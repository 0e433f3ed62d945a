extern crate std;
use std::println;

use super::estimator_tests::{Dice, Disc, readings};
use super::scan::Expectation;
use super::{Point, Reflex, Wish};
use crate::config::Config;
use lightbots_base::RobotId;

const DT: f32 = 0.016;

fn run(gap_m: f32, aside_m: f32, speed: f32, dice: &mut Dice) -> (bool, usize, usize) {
    let mut reflex = Reflex::new(&Config::new(RobotId::from_random(1)));
    let (mut x, mut now, mut told) = (0.0f32, speed, speed);
    let far = 0.054 + gap_m;
    let ahead = libm::sqrtf(far * far - aside_m * aside_m);
    let off = Point::new(0.0025 * dice.normal(), 0.0025 * dice.normal());
    let mut other = Point::new(ahead, aside_m);
    let mut other_mps = speed;
    let plan =
        |step: usize, x: f32| Point::new(ahead + off.x + speed * DT * step as f32 - x, aside_m + off.y);
    let dies = 40 + (dice.uniform() * 10.0) as usize;
    let (mut brakes, mut late) = (0, 0);
    for step in 1..dies + 40 {
        if step == dies {
            other_mps = speed * 0.3
        } else if step > dies {
            other_mps = 0.0
        }
        x += now * DT;
        other.x += other_mps * DT;
        let at = Point::new(other.x - x, other.y);
        if at.length() < 0.054 {
            return (true, brakes, late);
        }
        let gaps = readings(&[Disc { at, velocity: Point::new(other_mps, 0.0) }], dice);
        let expected = Expectation {
            index: 0,
            at: plan(step, x),
            velocity: Point::new(speed, 0.0),
            acceleration: Point::ZERO,
            clearance_m: gap_m,
        };
        reflex.look(Some(&gaps), (f64::from(now * DT), 0.0), f64::from(DT), &[expected]);
        let limit = reflex.limit(Wish { speed_mps: speed, told_mps: told, dt: DT }, None);
        now = told.max(now - 0.188);
        let most = limit.map_or(speed, |mps| mps as f32);
        if most < speed - 0.001 {
            if step < dies {
                brakes += 1
            }
        } else if step >= dies {
            late += 1
        }
        told = most.min(told + 0.18);
        if reflex.block().is_some() {
            told = 0.0
        }
    }
    (false, brakes, late)
}

#[test]
fn deaths() {
    for (gap, aside) in [
        (0.010, 0.01),
        (0.010, 0.03),
        (0.0125, 0.005),
        (0.015, 0.005),
        (0.018, 0.005),
        (0.018, 0.03),
        (0.022, 0.005),
    ] {
        let mut dice = Dice(3);
        let n = 4000;
        let (mut hit, mut brakes, mut late) = (0, 0, 0);
        for _ in 0..n {
            let (touched, b, l) = run(gap, aside, 0.27, &mut dice);
            hit += usize::from(touched);
            brakes += b;
            late += l;
        }
        println!(
            "D gap {gap} aside {aside}: hit {:.2} % false {:.3} /1000 steps  free steps after death {:.2}",
            hit as f32 / n as f32 * 100.0,
            brakes as f32 / (n * 45) as f32 * 1000.0,
            late as f32 / n as f32
        );
    }
}
