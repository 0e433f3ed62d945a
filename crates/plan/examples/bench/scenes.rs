//! Legal scenes that lie on the floor. Pixels are at least 76.4 mm apart, except in scenes that are called close.

use crate::dice::Dice;
use lightbots_base::{Limits, Vec2};
use lightbots_plan::{TransitionProblem, transition};

/// A kind of transition for the benchmark.
pub struct Scene {
    pub name: &'static str,
    pub build: fn(usize) -> TransitionProblem,
    /// Most robots with which it is measured.
    pub most: usize,
}

impl Scene {
    const fn new(name: &'static str, build: fn(usize) -> TransitionProblem) -> Self {
        Self { name, build, most: 10_000 }
    }

    const fn up_to(name: &'static str, most: usize, build: fn(usize) -> TransitionProblem) -> Self {
        Self { name, build, most }
    }
}

/// All scenes.
pub const ALL: [Scene; 19] = [
    Scene::new("random S", |robots| random(robots, 30.0 / 9.0)),
    Scene::new("random D", |robots| random(robots, 500.0 / 9.0)),
    Scene::new("disc slides", disc_slides),
    Scene::new("grid turns 45°", grid_turns),
    Scene::new("halves change", halves_change),
    Scene::new("rings inside out", rings_inside_out),
    Scene::new("mirrored", mirrored),
    Scene::new("rows to random", rows_to_random),
    Scene::new("rows to middle", rows_to_middle),
    Scene::up_to("close pairs S", 1_000, |robots| pairs(robots, 30.0 / 9.0)),
    Scene::up_to("close D", 1_000, |robots| random_apart(robots, 500.0 / 9.0, CLOSE_M)),
    Scene::up_to("fixed S", 1_000, |robots| fixed(random(robots, 30.0 / 9.0))),
    Scene::up_to("fixed D", 1_000, |robots| fixed(random(robots, 500.0 / 9.0))),
    Scene::up_to("fixed mirrored", 1_000, |robots| fixed(mirrored(robots))),
    Scene::up_to("fixed halves", 1_000, |robots| fixed(halves_change(robots))),
    Scene::up_to("fixed grid", 1_000, |robots| fixed(grid_shuffled(robots))),
    Scene::up_to("anew S", 1_000, |robots| midway(&random(robots, 30.0 / 9.0))),
    Scene::up_to("anew D", 1_000, |robots| midway(&random(robots, 500.0 / 9.0))),
    Scene::up_to("anew fixed S", 1_000, |robots| midway(&fixed(random(robots, 30.0 / 9.0)))),
];

/// Least distance between pixels, metres: slightly more than the 76.4 mm of Turpin et al.
const APART_M: f64 = 0.0774;
/// Least distance at which a plan must always be found, metres.
const CLOSE_M: f64 = 0.06;

fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>) -> TransitionProblem {
    let reach = starts.iter().chain(&goals).map(|at| at.x.abs().max(at.y.abs())).fold(0.0, f64::max);
    let half = Vec2::new(reach + 0.03, reach + 0.03);
    TransitionProblem { starts, goals, ..TransitionProblem::on_floor(half, Limits::ELISA_3) }
}

/// Random places on a square floor with this density (robots per m²), at least `apart_m` apart.
fn scatter(dice: &mut Dice, robots: usize, density: f64, apart_m: f64) -> Vec<Vec2> {
    let half = (robots as f64 / density).sqrt() / 2.0 - 0.03;
    let cells = (2.0 * half / apart_m) as usize + 2;
    let cell_of = |at: Vec2| (((at.x + half) / apart_m) as usize, ((at.y + half) / apart_m) as usize);
    let mut grid: Vec<Option<Vec2>> = vec![None; cells * cells];
    let mut places = Vec::new();
    while places.len() < robots {
        let at = Vec2::new((dice.share() * 2.0 - 1.0) * half, (dice.share() * 2.0 - 1.0) * half);
        let (x, y) = cell_of(at);
        let mut around = (y.saturating_sub(1)..(y + 2).min(cells))
            .flat_map(|y| (x.saturating_sub(1)..(x + 2).min(cells)).map(move |x| y * cells + x));
        if grid[y * cells + x].is_none()
            && around.all(|cell| grid[cell].is_none_or(|other| other.distance(at) >= apart_m))
        {
            grid[y * cells + x] = Some(at);
            places.push(at);
        }
    }
    places
}

fn random(robots: usize, density: f64) -> TransitionProblem {
    random_apart(robots, density, APART_M)
}

fn random_apart(robots: usize, density: f64, apart_m: f64) -> TransitionProblem {
    let mut dice = Dice::new(0, 1);
    let mut places = || scatter(&mut dice, robots, density, apart_m);
    problem(places(), places())
}

/// Random places in pairs. The two places of a pair are at the least distance.
fn pairs(robots: usize, density: f64) -> TransitionProblem {
    let mut dice = Dice::new(0, 4);
    let mut places = || {
        let mut firsts = scatter(&mut dice, robots.div_ceil(2), density / 2.0, APART_M + 2.0 * CLOSE_M);
        let beside: Vec<Vec2> = firsts
            .iter()
            .map(|&at| at + Vec2::unit(dice.share() * std::f64::consts::TAU) * CLOSE_M)
            .collect();
        firsts.extend(beside);
        firsts.truncate(robots);
        firsts
    };
    problem(places(), places())
}

/// The same problem with each robot bound to the pixel of its number.
fn fixed(problem: TransitionProblem) -> TransitionProblem {
    let pinned = (0..problem.goals.len()).map(Some).collect();
    TransitionProblem { pinned, ..problem }
}

/// The same problem planned anew, as in a run: one robot died in the middle of the drive, and all stand where they
/// were. The pixel of the dead robot and pixels on which it stands are left out.
fn midway(problem: &TransitionProblem) -> TransitionProblem {
    let plan = transition(problem).expect("legal scenes are solved");
    let places: Vec<Vec2> =
        plan.paths.iter().map(|path| path.as_ref().at(plan.duration / 2).position).collect();
    let dead = places.len() / 2;
    let contact_m = problem.limits.contact_m();
    let is_shown = |goal: &usize| {
        plan.goal_of[dead] != Some(*goal) && places[dead].distance(problem.goals[*goal]) > contact_m + 0.001
    };
    let shown: Vec<usize> = (0..problem.goals.len()).filter(is_shown).collect();
    let pinned = shown.iter().filter_map(|&goal| problem.pinned.get(goal).copied());
    TransitionProblem {
        starts: (0..places.len()).filter(|&robot| robot != dead).map(|robot| places[robot]).collect(),
        goals: shown.iter().map(|&goal| problem.goals[goal]).collect(),
        pinned: pinned.map(|robot| robot.map(|robot| robot - usize::from(robot > dead))).collect(),
        standing: vec![places[dead]],
        ..problem.clone()
    }
}

/// A square grid around the origin with spacing `step`, metres.
fn grid(robots: usize, step: f64) -> Vec<Vec2> {
    let side = (robots as f64).sqrt().ceil() as usize;
    let middle = (side as f64 - 1.0) / 2.0;
    (0..robots).map(|i| Vec2::new((i % side) as f64 - middle, (i / side) as f64 - middle) * step).collect()
}

/// The places of a hexagonal grid that are nearest to the origin.
fn disc(robots: usize) -> Vec<Vec2> {
    let reach = (robots as f64).sqrt() as i32 + 2;
    let mut places: Vec<Vec2> = (-reach..=reach)
        .flat_map(|row| (-reach..=reach).map(move |column| (column, row)))
        .map(|(column, row)| {
            let shift = 0.5 * f64::from(row.rem_euclid(2));
            Vec2::new(f64::from(column) + shift, f64::from(row) * 3f64.sqrt() / 2.0) * 0.08
        })
        .collect();
    places.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    places.truncate(robots);
    places
}

fn disc_slides(robots: usize) -> TransitionProblem {
    let places = disc(robots);
    let by = Vec2::new(places[robots - 1].length() * 1.5, 0.013);
    problem(
        places.iter().map(|&at| at - by / 2.0).collect(),
        places.iter().map(|&at| at + by / 2.0).collect(),
    )
}

fn grid_turns(robots: usize) -> TransitionProblem {
    let places = grid(robots, 0.1);
    let unit = Vec2::unit(std::f64::consts::FRAC_PI_4);
    let turned =
        places.iter().map(|at| Vec2::new(unit.x * at.x - unit.y * at.y, unit.y * at.x + unit.x * at.y));
    problem(places.clone(), turned.collect())
}

/// A grid with 80 mm spacing, whose robots exchange places at random. The floor is half as wide again as the grid.
fn grid_shuffled(robots: usize) -> TransitionProblem {
    let starts = grid(robots, 0.08);
    let mut goals = starts.clone();
    Dice::new(0, 5).shuffle(&mut goals);
    let problem = problem(starts, goals);
    TransitionProblem { half_floor: problem.half_floor * 1.5, ..problem }
}

/// The left and the right half of a grid change places, half a step aside.
fn halves_change(robots: usize) -> TransitionProblem {
    let places = grid(robots, 0.12);
    let across = places.iter().map(|at| at.x.abs()).fold(0.0, f64::max) + 0.2;
    let apart =
        |at: &Vec2| if at.x < 0.0 { Vec2::new(at.x - 0.3, at.y) } else { Vec2::new(at.x + 0.3, at.y) };
    let starts: Vec<Vec2> = places.iter().map(apart).collect();
    let swapped = starts.iter().map(|at| {
        let x = if at.x < 0.0 { at.x + across + 0.3 } else { at.x - across - 0.3 };
        Vec2::new(x, at.y + 0.06)
    });
    problem(starts.clone(), swapped.collect())
}

/// Rings around the origin, 0.1 m apart. The innermost becomes the outermost.
fn rings_inside_out(robots: usize) -> TransitionProblem {
    let rings = ((robots as f64 / std::f64::consts::PI).sqrt().ceil() as usize).max(2);
    let ring_of = |at: &Vec2| (at.length() / 0.1).round() as usize;
    let mut starts = Vec::new();
    let mut ring = 1;
    while starts.len() < robots {
        let count = ring * 6;
        for part in 0..count.min(robots - starts.len()) {
            let angle = part as f64 / count as f64 * std::f64::consts::TAU;
            starts.push(Vec2::unit(angle) * (0.1 * ring as f64));
        }
        ring += 1;
    }
    let outer = ring.max(rings);
    let goals = starts.iter().map(|at| {
        let radius = (outer + (outer - ring_of(at))) as f64 * 0.1;
        at.normalized().unwrap_or(Vec2::new(1.0, 0.0)) * radius
    });
    problem(starts.clone(), goals.collect())
}

fn mirrored(robots: usize) -> TransitionProblem {
    let starts = scatter(&mut Dice::new(0, 2), robots, 100.0 / 9.0, APART_M);
    problem(starts.clone(), starts.iter().map(|at| Vec2::new(-at.x, at.y)).collect())
}

/// Robots that drive from rows along the edge where y is largest to random places. A show without starts of its own
/// begins like this.
fn rows_to_random(robots: usize) -> TransitionProblem {
    let goals = scatter(&mut Dice::new(0, 3), robots, 100.0 / 9.0, APART_M);
    let half = (robots as f64 * 0.09).sqrt() / 2.0;
    let a_row = ((2.0 * half - 0.06) / 0.1) as usize + 1;
    let starts = (0..robots).map(|i| {
        Vec2::new(
            (i % a_row) as f64 * 0.1 - (a_row - 1) as f64 * 0.05,
            half - 0.05 - (i / a_row) as f64 * 0.1,
        )
    });
    problem(starts.collect(), goals)
}

/// Robots that drive from rows along the edge where y is smallest to random places in a square in the middle. The floor
/// is three times as wide as the square, as in a hall.
fn rows_to_middle(robots: usize) -> TransitionProblem {
    /// Robots per m² in the square: 1,000 in 4 m × 4 m.
    const DENSITY: f64 = 62.5;
    let goals = scatter(&mut Dice::new(0, 6), robots, DENSITY, APART_M);
    let half = 1.5 * (robots as f64 / DENSITY).sqrt();
    let a_row = ((2.0 * half - 0.1) / 0.1) as usize + 1;
    let starts = (0..robots).map(|i| {
        let in_row = (robots - i / a_row * a_row).min(a_row);
        Vec2::new(
            (i % a_row) as f64 * 0.1 - (in_row - 1) as f64 * 0.05,
            -half + 0.05 + (i / a_row) as f64 * 0.1,
        )
    });
    let starts = starts.collect();
    TransitionProblem { starts, goals, ..TransitionProblem::on_floor(Vec2::new(half, half), Limits::ELISA_3) }
}
