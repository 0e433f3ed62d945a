//! Prediction of what a proximity sensor reads for an outline of a standing object.

use super::outline::{Form, Outline};
use super::point::Point;
use super::sensors::Sensors;

/// If the sine of the angle between an edge and the side of a sensor's cone is below this, the two count as not
/// meeting. They would meet far outside the sensor's range.
const LEAST_SLOPE: f32 = 0.2;
/// A distance along an edge that is farther than any sensor sees, metres.
const FAR_M: f32 = 10.0;

/// Predicted reading of an outline by a sensor, and its derivatives over the outline's state: distance, direction, end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    /// The reading, metres.
    pub gap_m: f32,
    pub gradient: [f32; 3],
    /// Gradient, over the state, of the quantity in which the reading is quadratic.
    pub across: [f32; 3],
    /// Second derivative of the reading over the quantity of `across`.
    pub bend: f32,
}

/// A sensor and an outline, in the axes of the outline. Their x points along the normal (from the robot to the edge),
/// their y to the left of it.
struct Sight<'a> {
    of: &'a Outline,
    radius_m: f32,
    /// Direction of the sensor in these axes: `cos` along the normal, `sin` to its left.
    cos: f32,
    sin: f32,
    /// Distance from the sensor to the edge along the normal, metres.
    height_m: f32,
}

impl Outline {
    /// Predicts what a sensor reads for the outline; `None` if the outline is not in the sensor's cone.
    pub fn view(&self, sensor: usize, sensors: &Sensors) -> Option<View> {
        let sight = self.sight(sensor, sensors);
        if self.form == Form::Disc {
            return sight.disc(sensors.cone.x);
        }
        let rays = self.edges_of_cone(sensor, sensors);
        let [mut right_m, mut left_m] = rays.map(|ray| sight.meets_m(ray));
        let end_m = self.along_m - sight.radius_m * sight.sin;
        let (cone_right_m, cone_left_m) = (right_m, left_m);
        match self.form {
            Form::EdgeToLeft => right_m = right_m.max(end_m),
            Form::EdgeToRight => left_m = left_m.min(end_m),
            Form::Edge | Form::Disc => {}
        }
        if right_m >= left_m || sight.cos < -0.5 {
            return None;
        }
        if right_m <= 0.0 && left_m >= 0.0 {
            return Some(sight.foot());
        }
        let (nearest_m, cone_m, ray) =
            if right_m > 0.0 { (right_m, cone_right_m, rays[0]) } else { (left_m, cone_left_m, rays[1]) };
        if nearest_m != cone_m {
            return Some(sight.point(nearest_m));
        }
        (nearest_m.abs() < FAR_M).then(|| sight.edge_of_cone(ray))
    }

    /// Innovation of the reading `read_m` against its prediction `view`, metres, and the variance of the innovation,
    /// square metres.
    pub fn innovation(&self, view: &View, read_m: f32, sensors: &Sensors) -> (f32, f32) {
        // The reading is quadratic in the direction of the edge, or in the place of a point across the line of sight.
        // Its mean and variance are of second order.
        let bend_m = 0.5 * view.bend * self.variance_of(view.across);
        let variance =
            self.variance_of(view.gradient) + 2.0 * bend_m * bend_m + sensors.variance_m2(view.gap_m);
        (read_m - view.gap_m - bend_m, variance)
    }

    /// The part of the edge, taken as endless, that a sensor sees within its range. Returns the positions of the part's
    /// right and left end along the edge, metres. `None` if the sensor sees no part.
    pub fn stretch(&self, sensor: usize, sensors: &Sensors) -> Option<[f32; 2]> {
        let sight = self.sight(sensor, sensors);
        let far_m2 = sensors.range_m * sensors.range_m - sight.height_m * sight.height_m;
        if far_m2 <= 0.0 || sight.height_m < 0.0 {
            return None;
        }
        let far_m = libm::sqrtf(far_m2);
        let foot_m = sight.radius_m * sight.sin;
        let [right_m, left_m] =
            self.edges_of_cone(sensor, sensors).map(|ray| foot_m + sight.meets_m(ray).clamp(-far_m, far_m));
        (right_m < left_m).then_some([right_m, left_m])
    }

    fn sight(&self, sensor: usize, sensors: &Sensors) -> Sight<'_> {
        let axis = sensors.axes[sensor];
        let (cos, sin) = (axis.dot(self.normal), axis.dot(self.normal.left()));
        let height_m = self.distance_m - sensors.radius_m * cos;
        Sight { of: self, radius_m: sensors.radius_m, cos, sin, height_m }
    }

    /// Unit vectors along the sides of a sensor's cone, in the axes of the outline; the right side first.
    fn edges_of_cone(&self, sensor: usize, sensors: &Sensors) -> [Point; 2] {
        let axis = sensors.axes[sensor];
        let in_axes = Point::new(axis.dot(self.normal), axis.dot(self.normal.left()));
        [-1.0, 1.0].map(|side| in_axes.rotated(Point::new(sensors.cone.x, side * sensors.cone.y)))
    }
}

impl Sight<'_> {
    /// Place where a ray from the sensor meets the edge, metres to the left of the foot of the normal through the
    /// sensor. ±[`FAR_M`] if the ray hardly meets the edge.
    fn meets_m(&self, ray: Point) -> f32 {
        if ray.x < LEAST_SLOPE { FAR_M.copysign(ray.y) } else { self.height_m * ray.y / ray.x }
    }

    /// The view of an edge whose point nearest to the sensor is the foot of the normal through the sensor.
    fn foot(&self) -> View {
        let gradient = [1.0, -self.radius_m * self.sin, 0.0];
        View { gap_m: self.height_m, gradient, across: [0.0, 1.0, 0.0], bend: self.radius_m * self.cos }
    }

    /// The view of an edge whose nearest visible point is where the side `ray` of the cone meets it.
    fn edge_of_cone(&self, ray: Point) -> View {
        let gap_m = self.height_m / ray.x;
        let gradient = [1.0 / ray.x, (-self.radius_m * self.sin - gap_m * ray.y) / ray.x, 0.0];
        View { gap_m, gradient, across: [0.0, 1.0, 0.0], bend: self.radius_m * self.cos / ray.x }
    }

    /// The view of an edge whose nearest visible point is its end. `aside_m`: place of the end, metres to the left of
    /// the foot of the normal through the sensor.
    fn point(&self, aside_m: f32) -> View {
        let (height_m, of) = (self.height_m, self.of);
        let far_m = libm::sqrtf(height_m * height_m + aside_m * aside_m).max(1e-3);
        let turning_m = aside_m * of.distance_m - height_m * of.along_m;
        let turned_m = aside_m * of.along_m + height_m * of.distance_m;
        View {
            gap_m: far_m,
            gradient: [height_m, turning_m, aside_m].map(|part| part / far_m),
            across: [-aside_m, turned_m, height_m].map(|part| part / far_m),
            bend: 1.0 / far_m,
        }
    }

    /// The view of the rim of a disc; `None` if the centre of the disc is not in the cone. `cone_cos`: cosine of half
    /// the opening angle of the cone.
    fn disc(&self, cone_cos: f32) -> Option<View> {
        let aside_m = self.of.along_m - self.radius_m * self.sin;
        let centre = self.point(aside_m);
        let is_inside = self.height_m * self.cos + aside_m * self.sin > cone_cos * centre.gap_m;
        is_inside.then_some(View { gap_m: centre.gap_m - self.radius_m, ..centre })
    }
}
