//! Random shows of mixed identities. Any robot may show some pixels, and others keep their robot. Others request a
//! robot by name, a different one in every frame.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Identity, Pixel, Show, Stage, robots_needed};
use lightbots_sim::{Dice, Purpose};

/// Least distance between two places, metres.
const APART_M: f64 = 0.1;

/// A show, and the starts of the robots that play it.
pub struct Scene {
    pub show: Show,
    /// Places of the robots at the start: more than pixels, as many, or fewer. Robot `n` has the name `robot-n`.
    pub starts: Vec<Vec2>,
}

/// The name by which pixels request this robot.
pub fn name(robot: usize) -> String {
    format!("robot-{robot}")
}

/// Draws a random scene. The same number gives the same scene.
pub fn scene(number: u64) -> Scene {
    let mut dice = Dice::new(number, Purpose::Scene);
    let pixels = 2 + dice.below(9) as usize;
    let robots = match dice.below(4) {
        0 => pixels + 1 + dice.below(4) as usize,
        1 => pixels.saturating_sub(1 + dice.below(3) as usize).max(1),
        _ => pixels,
    };
    let identity = any_or_fixed(&mut dice);
    let is_mixed = dice.chance(0.5);
    let pinned = [0.0, 0.3, 0.7, 1.0][dice.below(4) as usize];
    let ids = ids(&mut dice, pixels);
    let frames = (0..2 + dice.below(4)).map(|nth| {
        let own = (is_mixed && dice.chance(0.6)).then(|| any_or_fixed(&mut dice));
        // With fixed identity every frame has the same ids.
        let strange = nth > 0 && own.unwrap_or(identity) == Identity::Any && dice.chance(0.2);
        let ids = if strange { self::ids(&mut dice, pixels) } else { ids.clone() };
        frame(&mut dice, &ids, own, (pinned, robots))
    });
    let frames = frames.collect();
    let starts = places(&mut dice, robots);
    let mut show = Show { identity, frames, starts: Some(starts.clone()), ..Show::default() };
    // A show must not state starts if the fleet lacks robots for it.
    if starts.len() < robots_needed(&show) {
        show.starts = None;
    }
    Scene { show, starts }
}

fn any_or_fixed(dice: &mut Dice) -> Identity {
    if dice.chance(0.5) { Identity::Fixed } else { Identity::Any }
}

/// Draws `count` different ids, sorted.
fn ids(dice: &mut Dice, count: usize) -> Vec<u32> {
    let mut all: Vec<u32> = (0..count as u32 * 2).collect();
    while all.len() > count {
        all.remove(dice.below(all.len() as u64) as usize);
    }
    all
}

fn frame(dice: &mut Dice, ids: &[u32], identity: Option<Identity>, (pinned, robots): (f64, usize)) -> Frame {
    let mut free: Vec<usize> = (0..robots).collect();
    let pins = dice.chance(pinned);
    let places = places(dice, ids.len());
    let pixels = ids.iter().zip(places).map(|(&id, at)| {
        let asks = pins && dice.chance(0.4) && !free.is_empty();
        let robot = asks.then(|| name(free.swap_remove(dice.below(free.len() as u64) as usize)));
        let mut part = || 40 + dice.below(200) as u8;
        let color = Rgb::new(part(), part(), part());
        Pixel { id, at, color: if dice.chance(0.1) { Rgb::BLACK } else { color }, robot, ..Pixel::default() }
    });
    Frame {
        name: String::new(),
        air_time_s: 0.6,
        transition_s: None,
        easing: Default::default(),
        identity,
        pixels: pixels.collect(),
        ..Frame::default()
    }
}

fn places(dice: &mut Dice, count: usize) -> Vec<Vec2> {
    let stage = Stage::default();
    let half = Vec2::new(stage.width_m, stage.depth_m) / 2.0 - Vec2::new(0.1, 0.1);
    let mut places: Vec<Vec2> = Vec::new();
    while places.len() < count {
        let place = Vec2::new(dice.between(-half.x, half.x), dice.between(-half.y, half.y));
        if places.iter().all(|other| other.distance(place) >= APART_M) {
            places.push(place);
        }
    }
    places
}
