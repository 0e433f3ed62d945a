//! Dense fleets on an empty floor.

use super::Kind;
use super::dice::Dice;
use super::places::{Bound, blob, problem, ring, scattered, square};
use lightbots_base::Vec2;
use lightbots_plan::TransitionProblem;

/// Names and generators of all kinds.
pub const ALL: [Kind; 18] = [
    ("close any", |case| scattered_crowd(1, case, (2, 300), 55.6, (0.06, 0.0764), Bound::No)),
    ("close fixed", |case| scattered_crowd(2, case, (2, 300), 55.6, (0.06, 0.0764), Bound::Yes)),
    ("close any wide", |case| scattered_crowd(3, case, (2, 300), 22.0, (0.06, 0.0764), Bound::No)),
    ("close fixed wide", |case| scattered_crowd(4, case, (2, 300), 22.0, (0.06, 0.0764), Bound::Yes)),
    ("packed any", |case| scattered_crowd(5, case, (2, 300), 90.0, (0.06, 0.0764), Bound::No)),
    ("packed fixed", |case| scattered_crowd(6, case, (2, 150), 80.0, (0.06, 0.0764), Bound::Yes)),
    ("dense fixed", |case| scattered_crowd(7, case, (2, 300), 55.6, (0.0774, 0.0774), Bound::Yes)),
    ("thousand any", |case| scattered_crowd(8, case, (1_000, 1_000), 55.6, (0.06, 0.0764), Bound::No)),
    ("thousand wide", |case| scattered_crowd(9, case, (1_000, 1_000), 22.0, (0.06, 0.0764), Bound::No)),
    ("pairs swap", pairs_swap),
    ("blob pairs swap", blob_pairs_swap),
    ("chain", chain),
    ("ring", rotated_ring),
    ("ring in blob", ring_in_blob),
    ("blob shuffled", blob_shuffled),
    ("square shuffled", square_shuffled),
    ("edge", edge),
    ("corner", corner),
];

fn half_of(count: usize, per_m2: f64) -> Vec2 {
    // The floor is at least large enough for two robots to pass each other.
    let half = ((count as f64 / per_m2).sqrt() / 2.0).max(0.1);
    Vec2::new(half, half)
}

fn scattered_crowd(
    kind: u64,
    case: u64,
    robots: (usize, usize),
    per_m2: f64,
    apart: (f64, f64),
    bound: Bound,
) -> TransitionProblem {
    let mut dice = Dice::new(kind, case);
    let count = dice.count(robots.0, robots.1);
    let apart_m = dice.between(apart.0, apart.1);
    let half = half_of(count, per_m2);
    let mut starts = scattered(&mut dice, count, half, apart_m, &|_| true);
    let mut goals = scattered(&mut dice, starts.len(), half, apart_m, &|_| true);
    starts.truncate(goals.len());
    dice.shuffle(&mut goals);
    problem(starts, goals, half, bound)
}

/// Pairs of robots 60 to 76 mm apart that change places. Each pair is far from the others.
fn pairs_swap(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(10, case);
    let (pairs, apart_m) = (dice.count(1, 40), dice.between(0.06, 0.076));
    let half = half_of(pairs, 12.0) + Vec2::new(0.06, 0.06);
    let inner = half - Vec2::new(0.04, 0.04);
    let middles = scattered(&mut dice, pairs, inner, apart_m * 2.0 + 0.06, &|_| true);
    let (mut starts, mut goals) = (Vec::new(), Vec::new());
    for middle in middles {
        let aside = Vec2::unit(dice.between(0.0, std::f64::consts::TAU)) * (apart_m / 2.0);
        starts.extend([middle - aside, middle + aside]);
        goals.extend([middle + aside, middle - aside]);
    }
    problem(starts, goals, half, Bound::Yes)
}

/// Neighbours in a hexagonal block that change places, with free floor around the block.
fn blob_pairs_swap(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(11, case);
    let (count, pitch_m) = (dice.count(4, 120), dice.between(0.06, 0.076));
    let starts = blob(count, pitch_m);
    let mut goals = starts.clone();
    let mut free: Vec<usize> = (0..count).collect();
    dice.shuffle(&mut free);
    while let Some(one) = free.pop() {
        let is_beside = |&other: &usize| starts[one].distance(starts[other]) < pitch_m * 1.1;
        if let Some(at) = free.iter().position(is_beside) {
            goals.swap(one, free.swap_remove(at));
        }
    }
    around(starts, goals, 0.2)
}

/// The problem on a floor whose edges are `room_m` beyond the outermost rims, metres.
fn around(starts: Vec<Vec2>, goals: Vec<Vec2>, room_m: f64) -> TransitionProblem {
    let reach = starts.iter().chain(&goals).map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
    let half = Vec2::new(reach + 0.027 + room_m, reach + 0.027 + room_m);
    problem(starts, goals, half, Bound::Yes)
}

/// A row in which each robot moves to the next place, and the last one to the first.
fn chain(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(12, case);
    let (count, pitch_m) = (dice.whole(2, 20), dice.between(0.06, 0.076));
    let starts: Vec<Vec2> = (0..count).map(|i| Vec2::new(i as f64 * pitch_m - 0.6, 0.0)).collect();
    let mut goals = starts.clone();
    goals.rotate_left(1);
    around(starts, goals, 0.1)
}

/// A ring that turns by one place or more.
fn rotated_ring(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(13, case);
    let (count, pitch_m) = (dice.whole(3, 40), dice.between(0.06, 0.076));
    let starts = ring(count, pitch_m, Vec2::ZERO);
    let mut goals = starts.clone();
    goals.rotate_left(dice.whole(1, 3.min(count - 1)));
    around(starts, goals, 0.15)
}

/// A ring inside a block turns by one place, and all other robots stay.
fn ring_in_blob(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(14, case);
    let pitch_m = dice.between(0.06, 0.076);
    let starts = blob(dice.whole(37, 91), pitch_m);
    let radius_m = pitch_m * dice.whole(1, 2) as f64;
    let is_on_ring = |at: Vec2| {
        // Distance from the centre in the hexagonal metric: the greatest of three coordinates.
        let rows = at.y / 0.75_f64.sqrt();
        let most = rows.abs().max((at.x - rows / 2.0).abs()).max((at.x + rows / 2.0).abs());
        (most - radius_m).abs() < pitch_m * 0.1
    };
    let mut on_ring: Vec<usize> = (0..starts.len()).filter(|&i| is_on_ring(starts[i])).collect();
    on_ring.sort_by(|&a, &b| starts[a].angle().total_cmp(&starts[b].angle()));
    let mut goals = starts.clone();
    for (rank, &robot) in on_ring.iter().enumerate() {
        goals[robot] = starts[on_ring[(rank + 1) % on_ring.len()]];
    }
    around(starts, goals, 0.2)
}

fn blob_shuffled(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(15, case);
    let (count, pitch_m) = (dice.count(3, 150), dice.between(0.06, 0.076));
    let starts = blob(count, pitch_m);
    let mut goals = starts.clone();
    dice.shuffle(&mut goals);
    // The free floor allows 55 robots per square metre, or is two robots wide all around.
    let room_m = (count as f64 / 55.6).sqrt() / 2.0;
    around(starts, goals, (room_m * 0.5).max(0.13))
}

fn square_shuffled(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(16, case);
    let (count, pitch_m) = (dice.count(3, 200), dice.between(0.06, 0.09));
    let starts = square(count, pitch_m);
    let mut goals = starts.clone();
    dice.shuffle(&mut goals);
    let half = half_of(count, 55.6);
    let reach = starts.iter().map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
    around(starts, goals, (half.x - reach - 0.027).max(0.13))
}

/// Robots along the floor's edges, shuffled.
fn edge(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(17, case);
    let (count, pitch_m) = (dice.whole(2, 25), dice.between(0.06, 0.076));
    let long = count as f64 * pitch_m;
    let half = Vec2::new(long / 2.0 + dice.between(0.03, 0.1), dice.between(0.15, 0.4));
    let at = |i: usize, y: f64| Vec2::new((i as f64 - (count as f64 - 1.0) / 2.0) * pitch_m, y);
    let y = half.y - 0.027;
    let rows = dice.whole(1, 2);
    let starts: Vec<Vec2> = (0..rows)
        .flat_map(|row| (0..count).map(move |i| (i, row)))
        .map(|(i, row)| at(i, if row == 0 { y } else { -y }))
        .collect();
    let mut goals = starts.clone();
    dice.shuffle(&mut goals);
    problem(starts, goals, half, Bound::Yes)
}

/// A dense block in a corner, shuffled or moved to the opposite corner.
fn corner(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(18, case);
    let (count, pitch_m) = (dice.count(3, 64), dice.between(0.06, 0.076));
    let block = square(count, pitch_m);
    let reach = block.iter().map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
    let half = reach * 2.0 + dice.between(0.08, 0.3);
    let shift = Vec2::new(half - 0.027 - reach, half - 0.027 - reach);
    let starts: Vec<Vec2> = block.iter().map(|&at| at - shift).collect();
    let mut goals: Vec<Vec2> =
        if dice.share() < 0.5 { starts.clone() } else { block.iter().map(|&at| at + shift).collect() };
    dice.shuffle(&mut goals);
    problem(starts, goals, Vec2::new(half, half), Bound::Yes)
}
