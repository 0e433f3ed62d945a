//! Coordinates: where along an effect a robot is.

use crate::ease::fraction;
use crate::lit_robot::LitRobot;
use crate::look::Look;
use crate::mask::nearest_on;
use core::f64::consts::TAU;
use lightbots_base::Vec2;

/// What an effect runs along: a number for each robot, which rises by 1 over the span of the effect.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Coordinate {
    /// Distance from the effect's place along its direction, divided by its size.
    #[default]
    Line,
    /// Distance from the effect's place, divided by its size.
    Distance,
    /// Angle around the effect's place, counter-clockwise from its direction, as a share of a turn, 0 to 1.
    Angle,
    /// Number of the robot, divided by the number of robots.
    Order,
    /// Share of a polyline's length up to its point nearest to the robot. Corners in stage metres.
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
