//! Measures the repair on hard transitions: `cargo run --release --example repair [seed]`.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use lightbots_base::{Limits, Vec2};
use lightbots_plan::{Path, TransitionProblem, repair};
use lightbots_show::{Easing, Obstacle};

struct Dice(u64);

impl Dice {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn places(&mut self, count: usize, half: f64, apart: f64) -> Vec<Vec2> {
        let mut places: Vec<Vec2> = Vec::new();
        while places.len() < count {
            let reach = half - 0.027;
            let place = Vec2::new((self.share() * 2.0 - 1.0) * reach, (self.share() * 2.0 - 1.0) * reach);
            if places.iter().all(|other| other.distance(place) >= apart) {
                places.push(place);
            }
        }
        places
    }
}

fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>, half: f64) -> TransitionProblem {
    TransitionProblem {
        pinned: Vec::new(),
        starts,
        goals,
        standing: Vec::new(),
        obstacles: Vec::new(),
        half_floor: Vec2::new(half, half),
        limits: Limits::ELISA_3,
        duration: None,
        easing: Easing::Swift,
    }
}

fn random(count: usize, per_9_m2: f64, apart: f64, seed: u64) -> TransitionProblem {
    let half = (count as f64 * 9.0 / per_9_m2).sqrt() / 2.0;
    let mut dice = Dice(seed);
    let starts = dice.places(count, half, apart);
    let goals = dice.places(count, half, apart);
    problem(starts, goals, half)
}

fn grid(side: usize, pitch: f64, middle: Vec2) -> Vec<Vec2> {
    let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * pitch;
    (0..side * side).map(|i| middle + Vec2::new(at(i % side), at(i / side))).collect()
}

fn halves(side: usize) -> TransitionProblem {
    let (left, right) = (Vec2::new(-0.8, 0.0), Vec2::new(0.8, 0.0));
    let (a, b) = (grid(side, 0.08, left), grid(side, 0.08, right));
    let starts = [a.clone(), b.clone()].concat();
    problem(starts, [b, a].concat(), 1.5)
}

fn mirrored(count: usize, seed: u64) -> TransitionProblem {
    let mut scene = random(count, 500.0, 0.0774, seed);
    scene.goals = scene.starts.iter().map(|at| Vec2::new(-at.x, at.y)).collect();
    scene
}

fn ring(count: usize) -> TransitionProblem {
    let at = |i: usize| Vec2::unit(i as f64 / count as f64 * std::f64::consts::TAU) * 1.2;
    problem((0..count).map(at).collect(), (0..count).map(|i| -at(i)).collect(), 1.5)
}

fn walled(count: usize, seed: u64) -> TransitionProblem {
    let mut scene = random(count, 30.0, 0.0774, seed);
    let half = scene.half_floor.x;
    scene.obstacles = vec![
        Obstacle::Rect { min: Vec2::new(-0.1, -half * 0.6), max: Vec2::new(0.1, half * 0.6) },
        Obstacle::Disc { at: Vec2::new(half * 0.5, 0.0), radius_m: 0.15 },
    ];
    scene.standing = vec![Vec2::new(-half * 0.5, 0.1), Vec2::new(-half * 0.5, -0.3)];
    let clear = |at: &Vec2| {
        let rect = at.x.abs() > 0.14 || at.y.abs() > half * 0.6 + 0.04;
        rect && at.distance(Vec2::new(half * 0.5, 0.0)) > 0.19
            && scene.standing.iter().all(|s| s.distance(*at) > 0.06)
    };
    let (starts, goals): (Vec<_>, Vec<_>) =
        scene.starts.iter().zip(&scene.goals).filter(|(s, g)| clear(s) && clear(g)).unzip();
    (scene.starts, scene.goals) = (starts, goals);
    scene
}

fn closest(paths: &[Path]) -> f64 {
    let duration = paths.first().map_or(0.0, |path| path.as_ref().duration().as_secs());
    let mut closest = f64::MAX;
    let steps = (duration / 0.02) as usize;
    for step in 0..=steps {
        let t = lightbots_base::Span::from_secs(step as f64 * 0.02);
        let mut at: Vec<Vec2> = paths.iter().map(|path| path.as_ref().at(t).position).collect();
        at.sort_by(|a, b| a.x.total_cmp(&b.x));
        for (i, a) in at.iter().enumerate() {
            for b in at[i + 1..].iter().take_while(|b| b.x - a.x < 0.08) {
                closest = closest.min(a.distance(*b));
            }
        }
    }
    closest
}

fn measure(name: &str, scene: &TransitionProblem) {
    let goal_of: Vec<Option<usize>> =
        (0..scene.starts.len()).map(|i| (i < scene.goals.len()).then_some(i)).collect();
    let longest = scene.starts.iter().zip(&scene.goals).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    let began = Instant::now();
    let paths = repair(scene, &goal_of);
    let millis = began.elapsed().as_secs_f64() * 1e3;
    match paths {
        Some(paths) => {
            let duration = paths[0].as_ref().duration().as_secs();
            let pieces = paths.iter().map(|path| path.pieces.len()).max().unwrap_or(0);
            println!(
                "{name:28} {millis:8.1} ms  {duration:6.2} s  /bound {:.3}  /T_min {:.3}  closest {:.1} mm  pieces {pieces}",
                duration / (longest / 0.27),
                duration / (longest / 0.27 + 0.62),
                closest(&paths) * 1e3
            );
        }
        None => println!("{name:28} {millis:8.1} ms  NOT SOLVED"),
    }
}

fn main() {
    let seed = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1);
    measure(
        "two swap",
        &problem(
            vec![Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)],
            vec![Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0)],
            1.5,
        ),
    );
    for seed in seed..seed + 3 {
        measure(&format!("30 sparse, seed {seed}"), &random(30, 30.0, 0.0774, seed));
        measure(&format!("30 dense, seed {seed}"), &random(30, 500.0, 0.0774, seed));
        measure(&format!("100 sparse, seed {seed}"), &random(100, 100.0, 0.0774, seed));
        measure(&format!("100 dense, seed {seed}"), &random(100, 500.0, 0.0774, seed));
        measure(&format!("walled, seed {seed}"), &walled(40, seed));
    }
    measure("ring of 30", &ring(30));
    measure("halves 2x25", &halves(5));
    measure("mirrored 100", &mirrored(100, seed));
    measure("300 dense", &random(300, 500.0, 0.0774, seed));
    measure("halves 2x225", &halves(15));
    measure("1000 dense", &random(1000, 500.0, 0.0774, seed));
    measure("mirrored 1000", &mirrored(1000, seed));
}
