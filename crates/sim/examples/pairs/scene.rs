//! Random pairs of frames: the starts and the goals of robots.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Pixel, Show, Stage};
use lightbots_sim::{Dice, Purpose};

/// A show of one drive: 2 to `most` robots on the usual floor, with starts and goals 60 to 200 mm apart. They are
/// interchangeable or, for odd numbers, each bound to its pixel. The same number gives the same pair.
pub fn pair(number: u64, most: u64) -> Show {
    let mut dice = Dice::new(number, Purpose::Scene);
    let stage = Stage::default();
    let apart_m = dice.between(0.06, 0.2);
    let wanted = 2 + dice.below(most - 1) as usize;
    let starts = places(&mut dice, &stage, wanted, apart_m);
    let goals = places(&mut dice, &stage, starts.len(), apart_m);
    let count = starts.len().min(goals.len());
    let fixed = number % 2 == 1;
    let pixels = goals[..count].iter().enumerate().map(|(id, at)| Pixel {
        id: id as u32,
        at: *at,
        color: Rgb::new(255, 160, 0),
        ..Pixel::default()
    });
    let frame = Frame {
        name: format!("Pair {number}"),
        air_time_s: 0.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: pixels.collect(),
        ..Frame::default()
    };
    // Fixed identity binds robots from the first frame on, so the starts are a separate frame in which all stay.
    let frames = if fixed { vec![standing(&starts[..count]), frame] } else { vec![frame] };
    Show {
        name: format!("pair {number}"),
        identity: if fixed { Identity::Fixed } else { Identity::Any },
        starts: Some(starts[..count].to_vec()),
        frames,
        stage,
        ..Show::default()
    }
}

fn standing(starts: &[Vec2]) -> Frame {
    let pixels = starts.iter().enumerate().map(|(id, at)| Pixel {
        id: id as u32,
        at: *at,
        color: Rgb::new(40, 40, 80),
        ..Pixel::default()
    });
    Frame {
        name: "Start".into(),
        air_time_s: 0.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: pixels.collect(),
        ..Frame::default()
    }
}

/// Up to `count` random places at least `apart_m` apart. Fewer if the floor is full.
fn places(dice: &mut Dice, stage: &Stage, count: usize, apart_m: f64) -> Vec<Vec2> {
    let half = Vec2::new(stage.width_m / 2.0 - 0.03, stage.depth_m / 2.0 - 0.03);
    let mut places: Vec<Vec2> = Vec::new();
    for _ in 0..count * 200 {
        if places.len() == count {
            break;
        }
        let place = Vec2::new(dice.between(-half.x, half.x), dice.between(-half.y, half.y));
        if places.iter().all(|other| other.distance(place) >= apart_m) {
            places.push(place);
        }
    }
    places
}
