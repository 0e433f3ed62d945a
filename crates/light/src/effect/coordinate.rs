//! Coordinates: where along an effect a robot is.

use crate::ease::fraction;
use crate::lit_robot::LitRobot;
use crate::look::Look;
use crate::mask::nearest_on;
use core::f64::consts::TAU;
use lightbots_base::Vec2;

/// What an effect runs along: a number for each robot. It rises by 1 over one span of the effect, such as `Look::size_m`.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Coordinate {
    /// Distance of the robot from the effect's place along the effect's direction, divided by the effect's size; negative
    /// behind the place.
    #[default]
    Line,
    /// Distance of the robot from the effect's place, divided by the effect's size.
    Distance,
    /// Angle of the robot around the effect's place, counter-clockwise from the effect's direction, as a share of a
    /// whole turn: 0 (included) to 1 (excluded).
    Angle,
    /// Number of the robot, counted from 0, divided by the number of all robots.
    Order,
    /// Position of the polyline's point that is nearest to the robot: the share of the polyline's length before the
    /// point, 0 to 1; 0 if the polyline has no length. The corners are in stage metres.
    Curve(Vec<Vec2>),
}

impl Coordinate {
    pub(crate) fn at(&self, look: &Look, robot: &LitRobot) -> f64 {
        let from_place = robot.place - look.place;
        match self {
            Self::Line => from_place.dot(Vec2::unit(look.angle)) / look.size_m,
            Self::Distance => from_place.length() / look.size_m,
            Self::Angle => fraction((from_place.angle() - look.angle) / TAU),
            Self::Order => f64::from(robot.index) / f64::from(robot.count.max(1)),
            Self::Curve(points) => share_of_curve(points, robot.place),
        }
    }
}

fn share_of_curve(points: &[Vec2], place: Vec2) -> f64 {
    let (mut nearest_m, mut at_m, mut length_m) = (f64::INFINITY, 0.0, 0.0);
    for line in points.windows(2) {
        let line_m = line[0].distance(line[1]);
        let (point, share) = nearest_on(line[0], line[1], place);
        let distance_m = point.distance(place);
        if distance_m < nearest_m {
            (nearest_m, at_m) = (distance_m, length_m + share * line_m);
        }
        length_m += line_m;
    }
    if length_m > 0.0 { at_m / length_m } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_counts_its_length() {
        let points = [(0.0, 0.0), (1.0, 0.0), (1.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
        assert_eq!(share_of_curve(&points, Vec2::new(0.5, -1.0)), 0.125);
        assert_eq!(share_of_curve(&points, Vec2::new(2.0, 1.0)), 0.5);
        assert_eq!(share_of_curve(&points[..1], Vec2::ZERO), 0.0);
    }
}
