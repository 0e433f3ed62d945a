//! Shows in which robots drive close to walls and no-go areas.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};

/// A show of eight robots that drive from the edge where y is largest through a gap in a wall to a ring around the
/// middle. `wide_m`: width of the gap, metres.
pub fn gap(wide_m: f64) -> Show {
    queue(8, 0.5, wide_m)
}

/// The show of [`gap`] with this number of robots and this radius of the ring, metres.
pub fn queue(robots: u32, radius_m: f64, wide_m: f64) -> Show {
    let half_m = wide_m / 2.0;
    let walls = vec![rect((-1.5, 0.85), (-half_m, 0.95)), rect((half_m, 0.85), (1.5, 0.95))];
    let stage = Stage { obstacles: walls, ..Stage::default() };
    let ring = |id: u32| Vec2::unit(f64::from(id) / f64::from(robots) * std::f64::consts::TAU) * radius_m;
    Show { stage, frames: vec![frame(&(0..robots).map(ring).collect::<Vec<_>>())], ..Show::default() }
}

/// A show of two robots that change places in a corridor along the floor's edge. One of them steps aside into a bay.
pub fn bay() -> Show {
    let (width, wide, deep, at) = (0.0754, 0.0701, 0.1027, -0.1568);
    let half = Vec2::new(0.6, width / 2.0 + deep);
    let (top, y) = (width - half.y, width / 2.0 - half.y);
    let bay =
        vec![rect((-0.6, top), (at - wide / 2.0, half.y)), rect((at + wide / 2.0, top), (half.x, half.y))];
    let stage = Stage { width_m: 2.0 * half.x, depth_m: 2.0 * half.y, obstacles: bay, ..Stage::default() };
    let (a, b) = (Vec2::new(-0.4, y), Vec2::new(0.4, y));
    Show {
        stage,
        identity: Identity::Fixed,
        starts: Some(vec![a, b]),
        frames: vec![frame(&[a, b]), frame(&[b, a])],
        ..Show::default()
    }
}

/// A show of two rows of robots on a small floor, which drive along two of its edges with `off_m` between rim and edge,
/// metres.
pub fn along_edge(off_m: f64) -> Show {
    let stage = Stage { width_m: 0.8, depth_m: 0.8, ..Stage::default() };
    let far_m = 0.4 - stage.limits.radius_m - off_m;
    let rows = |aside_m: f64| {
        let place = |id: u32| {
            let along_m = 0.1 * f64::from(id / 2) - 0.3 + aside_m;
            Vec2::new(along_m, if id.is_multiple_of(2) { far_m } else { -far_m })
        };
        frame(&(0..8).map(place).collect::<Vec<_>>())
    };
    let frames = vec![rows(0.0), rows(0.25), rows(0.0)];
    Show { stage, identity: Identity::Fixed, frames, ..Show::default() }
}

fn frame(places: &[Vec2]) -> Frame {
    let pixels =
        (0..).zip(places).map(|(id, &at)| Pixel { id, at, color: Rgb::new(255, 160, 0), ..Pixel::default() });
    Frame {
        name: "there".into(),
        air_time_s: 0.3,
        transition_s: None,
        easing: Easing::Swift,
        pixels: pixels.collect(),
        ..Frame::default()
    }
}

fn rect(min: (f64, f64), max: (f64, f64)) -> Obstacle {
    Obstacle::Rect { min: Vec2::new(min.0, min.1), max: Vec2::new(max.0, max.1) }
}
