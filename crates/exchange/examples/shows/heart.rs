//! A heart that beats, becomes two, and becomes one again.

use lightbots_base::Vec2;
use lightbots_show::{Easing, Frame, Show};

use super::color::{GOLD, ORANGE, RED, ROSE, VIOLET, gradient};
use super::draw::{frame, shaded, show as on_floor};
use super::stroke::{around, row};

/// Number of robots of the show.
const ROBOTS: usize = 30;

pub fn show() -> Show {
    let mut frames = vec![
        frame("Line", 0.5, shaded(row(Vec2::new(0.0, 0.9), 0.09, ROBOTS), |_| VIOLET)),
        whole("Heart", 0.95, 0.8),
        whole("Beat", 1.2, 0.1),
        whole("Rest", 0.95, 0.6),
        whole("Beat", 1.2, 0.1),
        whole("Rest", 0.95, 0.6),
        two(),
        whole("One", 1.3, 2.0),
    ];
    for frame in &mut frames {
        frame.easing = Easing::Gentle;
    }
    on_floor("Heart", 3.0, frames)
}

fn whole(name: &str, size_m: f64, air_time_s: f64) -> Frame {
    let places = around(&outline(Vec2::new(0.0, 0.05), size_m), ROBOTS);
    frame(name, air_time_s, shaded(places, |at| gradient(&[RED, ROSE, ORANGE], (at.y / size_m + 1.0) / 2.0)))
}

fn two() -> Frame {
    let left = around(&outline(Vec2::new(-0.75, 0.2), 0.6), ROBOTS / 2);
    let right = around(&outline(Vec2::new(0.75, -0.2), 0.6), ROBOTS / 2);
    let mut dots = shaded(left, |at| gradient(&[RED, ROSE], at.y + 0.3));
    dots.extend(shaded(right, |at| gradient(&[ORANGE, GOLD], at.y + 0.7)));
    frame("Two", 1.0, dots)
}

/// The heart curve x = 16 sin³t, y = 13 cos t − 5 cos 2t − 2 cos 3t − cos 4t, which extends about `size_m` to each
/// side.
pub fn outline(centre: Vec2, size_m: f64) -> Vec<Vec2> {
    /// Number of straight segments of the outline.
    const PARTS: usize = 720;
    let at = |part: usize| {
        let angle = std::f64::consts::TAU * part as f64 / PARTS as f64;
        let cos = |times: f64| Vec2::unit(angle * times).x;
        let sin = Vec2::unit(angle).y;
        let y = 13.0 * cos(1.0) - 5.0 * cos(2.0) - 2.0 * cos(3.0) - cos(4.0);
        centre + Vec2::new(16.0 * sin * sin * sin, y + 2.5) * (size_m / 16.0)
    };
    (0..=PARTS).map(at).collect()
}
