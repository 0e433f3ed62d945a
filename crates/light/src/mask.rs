//! Where a layer shines: masks.

use crate::colour::within_one;
use crate::lit_robot::LitRobot;
use lightbots_base::Vec2;

/// What a mask lets through.
#[derive(Clone, Debug, PartialEq)]
pub enum MaskShape {
    /// Robots whose pixel in the frame that they show or drive to has one of these ids. Ids are in increasing order.
    Selection(Vec<u32>),
    /// All robots while they show, or drive to, one of these frames, counted from 0.
    Frames {
        /// The first frame.
        first: u32,
        /// The last frame, included.
        last: u32,
    },
    /// A rectangle.
    Rectangle {
        /// Centre of the rectangle, stage metres.
        centre: Vec2,
        /// Half of the rectangle's extents along its own x and y axes, metres.
        half: Vec2,
        /// Angle from the x axis of the stage to that of the rectangle, radians counter-clockwise.
        angle: f64,
    },
    /// A circle.
    Circle {
        /// Centre of the circle, stage metres.
        centre: Vec2,
        /// Radius, metres.
        radius_m: f64,
    },
    /// The corners of a polygon of any form, in order, stage metres. A place is inside if a ray from the place crosses an
    /// odd number of edges.
    Polygon(Vec<Vec2>),
}

/// A mask of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct LightMask {
    /// What the mask lets through.
    pub shape: MaskShape,
    /// Width of the soft edge inside of an area, metres; 0: a hard edge. Selections and frames have no edge.
    pub feather_m: f64,
    /// Whether the mask lets through everything but its shape.
    pub inverted: bool,
}

impl LightMask {
    /// A mask with a hard edge.
    pub fn new(shape: MaskShape) -> Self {
        Self { shape, feather_m: 0.0, inverted: false }
    }

    /// The share of a layer's light that the mask lets through for a robot, 0 to 1.
    pub fn share(&self, robot: &LitRobot) -> f64 {
        let share = match &self.shape {
            MaskShape::Selection(ids) => truth(robot.pixel.is_some_and(|id| ids.binary_search(&id).is_ok())),
            MaskShape::Frames { first, last } => truth((*first..=*last).contains(&robot.frame)),
            area => self.softened(depth_m(area, robot.place)),
        };
        if self.inverted { 1.0 - share } else { share }
    }

    /// Returns the share for a place at `depth_m` inside of an area: 0 outside, rising to 1 over `feather_m` inside.
    fn softened(&self, depth_m: f64) -> f64 {
        if self.feather_m > 0.0 { within_one(depth_m / self.feather_m) } else { truth(depth_m >= 0.0) }
    }
}

fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// Distance from `place` to the edge of an area, metres. Negative if the place is outside; only the sign is then exact.
/// 0 for shapes that are no area.
fn depth_m(area: &MaskShape, place: Vec2) -> f64 {
    match area {
        MaskShape::Rectangle { centre, half, angle } => {
            let (along, from_centre) = (Vec2::unit(*angle), place - *centre);
            (half.x - along.dot(from_centre).abs()).min(half.y - along.cross(from_centre).abs())
        }
        MaskShape::Circle { centre, radius_m } => radius_m - place.distance(*centre),
        MaskShape::Polygon(corners) => polygon_depth_m(corners, place),
        MaskShape::Selection(_) | MaskShape::Frames { .. } => 0.0,
    }
}

fn polygon_depth_m(corners: &[Vec2], place: Vec2) -> f64 {
    let mut nearest_m = f64::INFINITY;
    let mut inside = false;
    for (index, &to) in corners.iter().enumerate() {
        let from = corners[index.checked_sub(1).unwrap_or(corners.len() - 1)];
        nearest_m = nearest_m.min(place.distance(nearest_on(from, to, place).0));
        let crosses = (from.y > place.y) != (to.y > place.y)
            && place.x < from.x + (to.x - from.x) * (place.y - from.y) / (to.y - from.y);
        inside ^= crosses;
    }
    if inside { nearest_m } else { -nearest_m }
}

/// Returns the point of the line segment from `from` to `to` that is nearest to `place`. The second value is the point's
/// position on the segment, 0 (at `from`) to 1 (at `to`).
pub(crate) fn nearest_on(from: Vec2, to: Vec2, place: Vec2) -> (Vec2, f64) {
    let line = to - from;
    let squared = line.length_squared();
    let share = if squared > 0.0 { within_one((place - from).dot(line) / squared) } else { 0.0 };
    (from.lerp(to, share), share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(mask: &LightMask, x: f64, y: f64) -> f64 {
        mask.share(&LitRobot { place: Vec2::new(x, y), ..LitRobot::default() })
    }

    #[test]
    fn a_feather_rises_inside_the_edge() {
        let shape = MaskShape::Circle { centre: Vec2::new(1.0, 0.0), radius_m: 1.0 };
        let mask = LightMask { feather_m: 0.5, ..LightMask::new(shape) };
        assert_eq!([-0.1, 0.0, 0.25, 0.5, 1.0].map(|x| share(&mask, x, 0.0)), [0.0, 0.0, 0.5, 1.0, 1.0]);
    }

    #[test]
    fn a_turned_rectangle_is_met() {
        let half = Vec2::new(1.0, 0.1);
        let quarter = core::f64::consts::FRAC_PI_2;
        let mask = LightMask::new(MaskShape::Rectangle { centre: Vec2::ZERO, half, angle: quarter });
        assert_eq!((share(&mask, 0.0, 0.9), share(&mask, 0.9, 0.0)), (1.0, 0.0));
        let inverted = LightMask { inverted: true, ..mask };
        assert_eq!((share(&inverted, 0.0, 0.9), share(&inverted, 0.9, 0.0)), (0.0, 1.0));
    }

    #[test]
    fn a_polygon_may_be_concave() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5), (0.0, 2.0)];
        let mask = LightMask::new(MaskShape::Polygon(corners.map(|(x, y)| Vec2::new(x, y)).to_vec()));
        assert_eq!((share(&mask, 1.0, 0.2), share(&mask, 1.0, 1.5), share(&mask, 0.1, 1.5)), (1.0, 0.0, 1.0));
    }

    #[test]
    fn robots_and_frames_are_picked() {
        let robot = LitRobot { pixel: Some(7), frame: 3, ..LitRobot::default() };
        let through = |shape| LightMask::new(shape).share(&robot);
        assert_eq!(through(MaskShape::Selection(vec![2, 7])), 1.0);
        assert_eq!(through(MaskShape::Selection(vec![2, 8])), 0.0);
        assert_eq!(through(MaskShape::Frames { first: 0, last: 3 }), 1.0);
        assert_eq!(through(MaskShape::Frames { first: 4, last: 9 }), 0.0);
    }
}
