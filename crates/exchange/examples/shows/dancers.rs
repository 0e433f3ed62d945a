//! A show of thirty dancers with one colour each, whose rows pass through each other.

use lightbots_base::Vec2;
use lightbots_show::{Easing, Frame, Identity, Show};

use super::color::{CYAN, GOLD, ORANGE, ROSE, VIOLET, gradient};
use super::draw::{frame, show as on_floor};
use super::stroke::ring;

/// Number of dancers in each of the two groups.
const GROUP: usize = 15;

pub fn show() -> Show {
    let mut frames = vec![
        rows("Facing", 0.9),
        rows("Meeting", 0.25),
        rows("Passing", -0.25),
        rows("Passed", -0.9),
        circle("Circle", 1.25, 1.25, 0.0),
        circle("Round", 1.25, 1.25, 1.0 / 6.0),
        circle("Star", 1.35, 0.75, 1.0 / 6.0),
        circle("Through", 0.75, 1.35, 1.0 / 6.0),
        circle("Round", 1.25, 1.25, 1.0 / 3.0),
        rows("Bow", 0.9),
    ];
    for frame in &mut frames {
        frame.easing = Easing::Gentle;
    }
    Show { identity: Identity::Fixed, ..on_floor("Dancers", 3.0, frames) }
}

/// A frame with one row per group: the first at `y`, stage metres, the second at `-y`. The second is half a step aside,
/// so that the groups can pass.
fn rows(name: &str, y: f64) -> Frame {
    let place = |dancer: usize| {
        let (group, nth) = (dancer % 2, dancer / 2);
        let x = (nth as f64 - (GROUP as f64 - 1.0) / 2.0) * 0.18;
        if group == 0 { Vec2::new(x - 0.045, y) } else { Vec2::new(x + 0.045, -y) }
    };
    frame(name, 0.5, (0..2 * GROUP).map(|dancer| (place(dancer), costume(dancer))))
}

/// A frame with all dancers in a circle, turned by `turned` of a turn. Dancers of both groups alternate; `first_m` and
/// `second_m` are the radii of the groups, metres.
fn circle(name: &str, first_m: f64, second_m: f64, turned: f64) -> Frame {
    let (outer, inner) =
        (ring(Vec2::ZERO, first_m, 2 * GROUP, turned), ring(Vec2::ZERO, second_m, 2 * GROUP, turned));
    let place = |dancer: usize| if dancer.is_multiple_of(2) { outer[dancer] } else { inner[dancer] };
    frame(name, 0.5, (0..2 * GROUP).map(|dancer| (place(dancer), costume(dancer))))
}

fn costume(dancer: usize) -> lightbots_base::Rgb {
    let share = (dancer / 2) as f64 / (GROUP as f64 - 1.0);
    if dancer.is_multiple_of(2) {
        gradient(&[GOLD, ORANGE, ROSE], share)
    } else {
        gradient(&[CYAN, VIOLET], share)
    }
}
