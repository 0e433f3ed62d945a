//! Fleets with fixed identity: each robot has its own goal.

use super::dice::Dice;
use super::places::{Bound, problem as bound, square};
use lightbots_base::Vec2;
use lightbots_plan::TransitionProblem;
use lightbots_show::Obstacle;

/// A function that makes a scene from a number of robots and a seed.
type Build = fn(usize, u64) -> TransitionProblem;

/// Names and generators of all scenes.
pub const ALL: [(&str, Build); 14] = [
    ("sparse", |robots, seed| random(robots, 30.0, seed)),
    ("dense", |robots, seed| random(robots, 500.0, seed)),
    ("mirrored", |robots, seed| mirrored(robots, 100.0, seed)),
    ("mirrored dense", |robots, seed| mirrored(robots, 500.0, seed)),
    ("halves", |robots, seed| halves(robots, 0.12, seed)),
    ("halves close", |robots, seed| halves(robots, 0.08, seed)),
    ("rings", rings),
    ("turned", turned),
    ("turned half", turned_half),
    ("shuffled", shuffled),
    ("full", full),
    ("hopeless", hopeless),
    ("rows", rows),
    ("dead", dead),
];

/// Least distance between random places, metres.
const APART_M: f64 = 0.0774;

/// Random places on a square floor that are clear and at least `APART_M` apart.
fn places(dice: &mut Dice, count: usize, half: f64, clear: &dyn Fn(Vec2) -> bool) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = Vec::new();
    let inner = Vec2::new(half - 0.027, half - 0.027);
    while places.len() < count {
        let place = dice.place(inner);
        if clear(place) && places.iter().all(|other| other.distance(place) >= APART_M) {
            places.push(place);
        }
    }
    places
}

fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>, half: f64) -> TransitionProblem {
    bound(starts, goals, Vec2::new(half, half), Bound::Yes)
}

fn half_floor(robots: usize, per_9_m2: f64) -> f64 {
    (robots as f64 * 9.0 / per_9_m2).sqrt() / 2.0
}

fn random(robots: usize, per_9_m2: f64, seed: u64) -> TransitionProblem {
    let (half, mut dice) = (half_floor(robots, per_9_m2), Dice::new(0, seed));
    let mut places = || places(&mut dice, robots, half, &|_| true);
    problem(places(), places(), half)
}

fn mirrored(robots: usize, per_9_m2: f64, seed: u64) -> TransitionProblem {
    let mut scene = random(robots, per_9_m2, seed);
    scene.goals = scene.starts.iter().map(|at| Vec2::new(-at.x, at.y)).collect();
    scene
}

/// Two blocks that change places. The seed sets the distance between them.
fn halves(robots: usize, pitch: f64, seed: u64) -> TransitionProblem {
    let block = square(robots / 2, pitch);
    let reach = block.iter().map(|at| at.x.abs()).fold(0.0, f64::max);
    let by = Vec2::new(reach + 0.1 + 0.05 * seed as f64, 0.0);
    let (left, right): (Vec<Vec2>, Vec<Vec2>) = block.iter().map(|&at| (at - by, at + by)).unzip();
    problem([left.clone(), right.clone()].concat(), [right, left].concat(), by.x + reach + 0.3)
}

/// Rings around the origin, 0.1 m apart. The innermost becomes the outermost, slightly turned.
fn rings(robots: usize, seed: u64) -> TransitionProblem {
    let mut starts: Vec<(usize, f64)> = Vec::new();
    let mut ring = 1;
    while starts.len() < robots {
        let count = (ring * 6).min(robots - starts.len());
        starts.extend((0..count).map(|part| (ring, part as f64 / (ring * 6) as f64 * std::f64::consts::TAU)));
        ring += 1;
    }
    let turn = 0.1 * seed as f64;
    let goals = starts.iter().map(|&(at, angle)| Vec2::unit(angle + turn) * (0.1 * (2 * ring - at) as f64));
    let half = 0.2 * ring as f64;
    let goals = goals.collect();
    problem(starts.iter().map(|&(at, angle)| Vec2::unit(angle) * (0.1 * at as f64)).collect(), goals, half)
}

fn turned_by(robots: usize, angle: f64) -> TransitionProblem {
    let places = square(robots, 0.1);
    let unit = Vec2::unit(angle);
    let turned = places.iter().map(|at| unit * at.x + unit.left() * at.y).collect::<Vec<_>>();
    let half = places.iter().chain(&turned).map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
    problem(places, turned, half * 1.1 + 0.1)
}

/// A grid that turns around its middle by 27° or more.
fn turned(robots: usize, seed: u64) -> TransitionProblem {
    turned_by(robots, 0.3 + 0.17 * seed as f64)
}

/// A grid that turns around its middle by about half a turn.
fn turned_half(robots: usize, seed: u64) -> TransitionProblem {
    turned_by(robots, std::f64::consts::PI - 0.04 * (seed - 1) as f64)
}

/// A grid with 80 mm spacing, whose robots exchange places at random. The floor is half as wide again as the grid.
fn shuffled(robots: usize, seed: u64) -> TransitionProblem {
    let starts = square(robots, 0.08);
    let half = starts.iter().map(|at| at.x.abs()).fold(0.0, f64::max) * 1.5 + 0.05;
    shuffled_on(starts, half, seed)
}

/// A shuffled grid with the spacing that messages recommend, on a floor that the grid fills.
fn full(robots: usize, seed: u64) -> TransitionProblem {
    let starts = square(robots, 0.1215);
    let half = starts.iter().map(|at| at.x.abs()).fold(0.0, f64::max) + 0.06;
    shuffled_on(starts, half, seed)
}

/// A shuffled grid in which no robot can pass another, to measure the cost of a problem without a plan.
fn hopeless(robots: usize, seed: u64) -> TransitionProblem {
    let starts = square(robots, 0.06);
    let half = starts.iter().map(|at| at.x.abs()).fold(0.0, f64::max) + 0.03;
    shuffled_on(starts, half, seed)
}

fn shuffled_on(starts: Vec<Vec2>, half: f64, seed: u64) -> TransitionProblem {
    let mut goals = starts.clone();
    Dice::new(0, seed).shuffle(&mut goals);
    problem(starts, goals, half)
}

/// Robots that drive from rows along the edge where y is largest to random places.
fn rows(robots: usize, seed: u64) -> TransitionProblem {
    let half = half_floor(robots, 300.0);
    let a_row = ((2.0 * half - 0.06) / 0.1) as usize + 1;
    let at = |i: usize| {
        let x = (i % a_row) as f64 * 0.1 - (a_row - 1) as f64 * 0.05;
        Vec2::new(x, half - 0.03 - (i / a_row) as f64 * 0.1)
    };
    let goals = places(&mut Dice::new(0, seed), robots, half, &|_| true);
    problem((0..robots).map(at).collect(), goals, half)
}

/// One robot in thirty is dead, and a column and a wall stand on the floor.
fn dead(robots: usize, seed: u64) -> TransitionProblem {
    let (half, mut dice) = (half_floor(robots, 200.0) + 0.1, Dice::new(0, seed));
    let obstacles = vec![
        Obstacle::Rect { min: Vec2::new(-0.05, -half * 0.5), max: Vec2::new(0.05, half * 0.3) },
        Obstacle::Disc { at: Vec2::new(half * 0.55, 0.0), radius_m: 0.1 },
    ];
    let clear_of_things = |at: Vec2, gap: f64| {
        let wall = at.x.abs() > 0.05 + gap || at.y < -half * 0.5 - gap || at.y > half * 0.3 + gap;
        wall && at.distance(Vec2::new(half * 0.55, 0.0)) > 0.1 + gap
    };
    let standing = places(&mut dice, robots / 30 + 1, half, &|at| clear_of_things(at, 0.1));
    let clear = |at: Vec2| clear_of_things(at, 0.04) && standing.iter().all(|s| s.distance(at) >= APART_M);
    let (starts, goals) = (places(&mut dice, robots, half, &clear), places(&mut dice, robots, half, &clear));
    TransitionProblem { obstacles, standing: standing.clone(), ..problem(starts, goals, half) }
}
