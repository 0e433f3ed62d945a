//! Random floors with obstacles: walls with a gap, discs and rectangles.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};
use lightbots_sim::{Dice, Purpose};

/// Range of the floor's width and depth, metres.
const SIDES_M: (f64, f64) = (1.0, 2.6);
/// Range of the gaps' width, metres: from too narrow for a robot to wide enough for two.
const GAPS_M: (f64, f64) = (0.058, 0.15);
/// Least distance of pixels and starts from obstacles and the floor's edge, metres.
const OFF_M: f64 = 0.031;
/// Number of floors, of three, that a wall with a gap divides.
const WALLED: u64 = 2;

/// A show of one drive over a floor with one to six obstacles. Its 5 to `most` robots are interchangeable or, for odd
/// numbers, each bound to its pixel. The same number gives the same floor.
pub fn floor(number: u64, most: u64) -> Show {
    let mut dice = Dice::new(number, Purpose::Scene);
    let (width_m, depth_m) = (dice.between(SIDES_M.0, SIDES_M.1), dice.between(SIDES_M.0, SIDES_M.1));
    let mut stage = Stage { width_m, depth_m, ..Stage::default() };
    stage.obstacles = things(&mut dice, &stage);
    let apart_m = dice.between(0.062, 0.15);
    let wanted = 5 + dice.below(most - 4) as usize;
    let starts = places(&mut dice, &stage, wanted, apart_m);
    let goals = places(&mut dice, &stage, starts.len(), apart_m);
    let count = starts.len().min(goals.len());
    let (starts, goals) = (&starts[..count], &goals[..count]);
    let fixed = number % 2 == 1;
    // Fixed identity binds robots from the first frame on, so the starts are a separate frame.
    let frames =
        if fixed { vec![frame("Start", starts), frame("Goal", goals)] } else { vec![frame("Goal", goals)] };
    Show {
        name: format!("floor {number}"),
        identity: if fixed { Identity::Fixed } else { Identity::Any },
        starts: Some(starts.to_vec()),
        frames,
        stage,
        ..Show::default()
    }
}

fn things(dice: &mut Dice, stage: &Stage) -> Vec<Obstacle> {
    let mut things = Vec::new();
    if dice.below(3) < WALLED {
        things.extend(wall(dice, stage));
    }
    let more = 1 + dice.below(6 - things.len() as u64) as usize;
    while things.len() < more {
        let middle = anywhere(dice, stage, 0.0);
        let thing = match dice.below(3) {
            0 => Obstacle::Disc { at: middle, radius_m: dice.between(0.02, 0.2) },
            1 => beside(dice, &things, middle),
            _ => {
                let half = Vec2::new(dice.between(0.01, 0.25), dice.between(0.01, 0.25));
                Obstacle::Rect { min: middle - half, max: middle + half }
            }
        };
        things.push(thing);
    }
    things
}

/// A wall across the whole floor, with a gap.
fn wall(dice: &mut Dice, stage: &Stage) -> [Obstacle; 2] {
    let half = Vec2::new(stage.width_m / 2.0, stage.depth_m / 2.0);
    let (thick_m, gap_m) = (dice.between(0.01, 0.2), dice.between(GAPS_M.0, GAPS_M.1));
    let upright = dice.below(2) == 1;
    let half = if upright { Vec2::new(half.y, half.x) } else { half };
    let at = dice.between(-0.5, 0.5) * half.y;
    let gap_at = dice.between(-0.8, 0.8) * (half.x - gap_m);
    let part = |from: f64, to: f64| {
        let (min, max) = (Vec2::new(from, at - thick_m / 2.0), Vec2::new(to, at + thick_m / 2.0));
        let turned = |place: Vec2| if upright { Vec2::new(place.y, place.x) } else { place };
        Obstacle::Rect { min: turned(min), max: turned(max) }
    };
    [part(-half.x, gap_at - gap_m / 2.0), part(gap_at + gap_m / 2.0, half.x)]
}

/// A disc beside the last obstacle, with a gap to its corner or rim. Without an obstacle it is at `otherwise`.
fn beside(dice: &mut Dice, things: &[Obstacle], otherwise: Vec2) -> Obstacle {
    let radius_m = dice.between(0.02, 0.15);
    let away = Vec2::unit(dice.between(0.0, core::f64::consts::TAU));
    let gap_m = dice.between(GAPS_M.0, GAPS_M.1);
    let at = match things.last() {
        Some(Obstacle::Disc { at, radius_m: other_m }) => *at + away * (radius_m + other_m + gap_m),
        Some(Obstacle::Rect { max, .. }) => *max + Vec2::new(away.x.abs(), away.y.abs()) * (radius_m + gap_m),
        None => otherwise,
    };
    Obstacle::Disc { at, radius_m }
}

fn frame(name: &str, places: &[Vec2]) -> Frame {
    let pixels =
        (0..).zip(places).map(|(id, &at)| Pixel { id, at, color: Rgb::new(255, 160, 0), ..Pixel::default() });
    Frame {
        name: name.into(),
        air_time_s: 0.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: pixels.collect(),
        ..Frame::default()
    }
}

fn anywhere(dice: &mut Dice, stage: &Stage, off_m: f64) -> Vec2 {
    let half = Vec2::new(stage.width_m / 2.0 - off_m, stage.depth_m / 2.0 - off_m);
    Vec2::new(dice.between(-half.x, half.x), dice.between(-half.y, half.y))
}

/// Up to `count` random places at least `apart_m` apart. Fewer if the floor is full.
fn places(dice: &mut Dice, stage: &Stage, count: usize, apart_m: f64) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = Vec::new();
    for _ in 0..count * 200 {
        if places.len() == count {
            break;
        }
        let place = anywhere(dice, stage, OFF_M);
        let is_free = stage.obstacles.iter().all(|thing| thing.gap_m(place) >= OFF_M);
        if is_free && places.iter().all(|other| other.distance(place) >= apart_m) {
            places.push(place);
        }
    }
    places
}
