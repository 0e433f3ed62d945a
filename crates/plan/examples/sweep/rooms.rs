//! Floors with no-go areas, standing robots and spare robots.

use super::Kind;
use super::dice::Dice;
use super::places::{Bound, blob, problem, ring, scattered};
use lightbots_base::Vec2;
use lightbots_plan::TransitionProblem;
use lightbots_show::Obstacle;

/// Names and generators of all kinds.
pub const ALL: [Kind; 10] = [
    ("narrow through", |case| corridor(case, Traffic::OneWay, (NARROWEST_M, 0.09))),
    ("wide through", |case| corridor(case, Traffic::OneWay, (0.12, 0.17))),
    ("wide both ways", |case| corridor(case, Traffic::BothWays, (0.12, 0.17))),
    ("narrow both ways", |case| corridor(case, Traffic::BothWays, (NARROWEST_M, 0.09))),
    ("bay", bay),
    ("standing any", |case| standing(case, Bound::No)),
    ("standing fixed", |case| standing(case, Bound::Yes)),
    ("behind standing", behind_standing),
    ("spares", spares),
    ("spares in a ring", spares_in_a_ring),
];

/// Least width of a corridor, metres: a robot, two margins of 3 mm and 1 mm of play.
const NARROWEST_M: f64 = 0.061;
/// Half the length of a corridor, metres.
const HALF_LENGTH_M: f64 = 0.25;

/// Directions in which robots pass a corridor.
enum Traffic {
    OneWay,
    BothWays,
}

fn wall(min: (f64, f64), max: (f64, f64)) -> Obstacle {
    Obstacle::Rect { min: Vec2::new(min.0, min.1), max: Vec2::new(max.0, max.1) }
}

/// Two rooms with one corridor between them.
fn corridor(case: u64, traffic: Traffic, width: (f64, f64)) -> TransitionProblem {
    let mut dice = Dice::new(21, case);
    let (count, width_m) = (dice.whole(1, 10), dice.between(width.0, width.1));
    let y = dice.between(-0.1, 0.1);
    let half = Vec2::new(0.8, 0.3);
    let room = |dice: &mut Dice, side: f64| -> Vec<Vec2> {
        let places = scattered(dice, count, Vec2::new(0.27, 0.3), 0.07, &|_| true);
        places.into_iter().map(|at| at + Vec2::new(0.53 * side, 0.0)).collect()
    };
    let (mut starts, mut goals) = (room(&mut dice, -1.0), room(&mut dice, 1.0));
    if matches!(traffic, Traffic::BothWays) {
        // Every second robot starts in the other room.
        for i in (0..count).step_by(2) {
            std::mem::swap(&mut starts[i], &mut goals[i]);
        }
    }
    let is_apart = |places: &[Vec2]| {
        places.iter().enumerate().all(|(i, a)| places[..i].iter().all(|b| a.distance(*b) >= 0.06))
    };
    if !is_apart(&starts) || !is_apart(&goals) {
        return corridor(case + 1_000_003, traffic, width);
    }
    let obstacles = vec![
        wall((-HALF_LENGTH_M, y + width_m / 2.0), (HALF_LENGTH_M, half.y)),
        wall((-HALF_LENGTH_M, -half.y), (HALF_LENGTH_M, y - width_m / 2.0)),
    ];
    TransitionProblem { obstacles, ..problem(starts, goals, half, Bound::Yes) }
}

/// Two robots that change places in a corridor one robot wide with a bay.
fn bay(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(22, case);
    let (width_m, wide_m, deep_m) =
        (dice.between(NARROWEST_M, 0.085), dice.between(0.07, 0.16), dice.between(0.07, 0.12));
    let (half, at) = (Vec2::new(0.6, width_m / 2.0 + deep_m), dice.between(-0.2, 0.2));
    // The corridor lies along the lower edge, the bay above it.
    let top = width_m - half.y;
    let y = -half.y + width_m / 2.0;
    let starts = vec![Vec2::new(-0.4, y), Vec2::new(0.4, y)];
    let goals = starts.iter().rev().copied().collect();
    let obstacles = vec![
        wall((-half.x, top), (at - wide_m / 2.0, half.y)),
        wall((at + wide_m / 2.0, top), (half.x, half.y)),
    ];
    TransitionProblem { obstacles, ..problem(starts, goals, half, Bound::Yes) }
}

/// Dead robots among starts and goals, down to 57.5 mm from them.
fn standing(case: u64, bound: Bound) -> TransitionProblem {
    let mut dice = Dice::new(23, case);
    let (count, dead) = (dice.count(2, 150), dice.count(1, 12));
    let half = ((count + 2 * dead) as f64 / 40.0).sqrt() / 2.0 + 0.05;
    let half = Vec2::new(half, half);
    let standing = scattered(&mut dice, dead, half, 0.06, &|_| true);
    let clear = |at: Vec2| standing.iter().all(|other| other.distance(at) >= 0.0575);
    let mut starts = scattered(&mut dice, count, half, 0.06, &clear);
    let mut goals = scattered(&mut dice, starts.len(), half, 0.06, &clear);
    starts.truncate(goals.len());
    dice.shuffle(&mut goals);
    TransitionProblem { standing: standing.clone(), ..problem(starts, goals, half, bound) }
}

/// One or two goals in a ring of dead robots with one gap, which is 62 to 106 mm wide between rims. In half of the
/// cases robots inside have to leave.
fn behind_standing(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(24, case);
    let apart_m = dice.between(0.06, 0.1);
    let count = dice.whole(9, 14);
    let gap_m = dice.between(0.116, 0.16);
    let radius = (apart_m / 2.0) / (std::f64::consts::PI / count as f64).sin();
    let gap_angle = 2.0 * (gap_m / 2.0 / radius).asin();
    let turn = dice.between(0.0, std::f64::consts::TAU);
    let angles = (0..).map(|i| gap_angle / 2.0 + apart_m / radius * f64::from(i));
    let within = angles.take_while(|angle| *angle <= std::f64::consts::TAU - gap_angle / 2.0);
    let standing: Vec<Vec2> = within.map(|angle| Vec2::unit(turn + angle) * radius).collect();
    let inside = dice.whole(1, 2);
    let half = Vec2::new(radius + 0.3, radius + 0.3);
    let clear = |at: Vec2| at.length() > radius + 0.07;
    let outside = scattered(&mut dice, inside + 6, half, 0.065, &clear);
    let within = |i: usize| Vec2::unit(turn) * (if i == 0 { -0.033 } else { 0.033 });
    let mut starts: Vec<Vec2> = outside.clone();
    let mut goals: Vec<Vec2> = outside;
    (0..inside).zip(&mut goals).for_each(|(i, goal)| *goal = within(i));
    if dice.share() < 0.5 {
        // Robots inside change places with those that go in.
        for i in 0..inside {
            starts.push(within(i));
            goals.push(starts[i]);
        }
    }
    TransitionProblem { standing, ..problem(starts, goals, half, Bound::Yes) }
}

/// Some robots have a goal, and the spare robots block their paths.
fn spares(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(25, case);
    let (count, apart_m) = (dice.count(3, 200), dice.between(0.06, 0.076));
    let half = (count as f64 / 55.6).sqrt() / 2.0 + 0.05;
    let half = Vec2::new(half, half);
    let starts = scattered(&mut dice, count, half, apart_m, &|_| true);
    let wanted = dice.whole(1, starts.len());
    let goals = scattered(&mut dice, wanted, half, apart_m, &|_| true);
    let bound = if dice.share() < 0.5 { Bound::Yes } else { Bound::No };
    problem(starts, goals, half, bound)
}

/// One robot in the middle of spare robots must leave, and another must get there.
fn spares_in_a_ring(case: u64) -> TransitionProblem {
    let mut dice = Dice::new(26, case);
    let apart_m = dice.between(0.06, 0.076);
    let (starts, half) = if dice.share() < 0.5 {
        (blob(dice.whole(7, 61), apart_m), 0.5)
    } else {
        let mut starts = vec![Vec2::ZERO];
        starts.extend(ring(dice.whole(6, 14), apart_m, Vec2::ZERO));
        (starts, 0.4)
    };
    let goals = vec![Vec2::new(half - 0.03, dice.between(-0.1, 0.1)), Vec2::ZERO];
    problem(starts, goals, Vec2::new(half, half), Bound::Yes)
}
