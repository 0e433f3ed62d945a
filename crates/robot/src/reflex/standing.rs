//! Where it is that sensors see, if it stands: the place that explains best what they said over the last steps, in which
//! the robot itself moved as its wheels say. What no place explains is on its own way.

use super::{NOISE_M, NOISE_SHARE, Reflex, SENSORS, SIGHT_M};

/// How many steps are explained at most.
pub(super) const STEPS: usize = 7;
/// Fewer readings than this explain nothing.
const READINGS_MIN: u32 = 3;
/// Rounds of least squares (Gauss-Newton), and how far beside a sensor's axis they begin, radians.
const ROUNDS: usize = 3;
const BEGINS: [f32; 2] = [-0.2, 0.2];
/// Readings off by more than so many sigma count no more than that: another may be nearer.
const OUTLIER: f32 = 3.0;
/// A sensor sees what lies within this of its axis, cosine.
const CONE_COS: f32 = 0.68;
/// What lies nearer than this share of its range it sees for sure.
const SURELY: f32 = 0.8;
/// Where it begins counts as a reading so uncertain, metres.
const BEGIN_M: f32 = 0.02;
const HALF: f32 = core::f32::consts::FRAC_1_SQRT_2;
/// Directions of the sensors in body space.
const AXES: [Point; SENSORS] = [
    Point { x: 1.0, y: 0.0 },
    Point { x: HALF, y: HALF },
    Point { x: 0.0, y: 1.0 },
    Point { x: -HALF, y: HALF },
    Point { x: -1.0, y: 0.0 },
    Point { x: -HALF, y: -HALF },
    Point { x: 0.0, y: -1.0 },
    Point { x: HALF, y: -HALF },
];

/// A disc of the robot's own size that stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing {
    /// Its centre in body space, metres.
    pub at: Point,
    /// How badly that explains the readings: mean square, in sigma.
    pub misfit: f32,
}

/// A place or direction in body space; half as precise as the rest, and twice as quick.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Point {
    pub x: f32,
    pub y: f32,
}

impl Point {
    fn dot(self, other: Self) -> f32 {
        self.x * other.x + self.y * other.y
    }

    /// Turned by the angle of a unit vector.
    fn turned(self, by: Self) -> Self {
        Self { x: self.x * by.x - self.y * by.y, y: self.x * by.y + self.y * by.x }
    }

    /// The unit vector of a small angle.
    fn small(angle: f32) -> Self {
        let square = angle * angle;
        Self { x: 1.0 - 0.5 * square, y: angle * (1.0 - square * (1.0 / 6.0)) }
    }
}

/// Where the robot was and which way it faced, in the body space of now.
#[derive(Clone, Copy)]
struct Was {
    at: Point,
    facing: Point,
}

impl Reflex {
    /// The disc that a sensor sees, if it stands, by the latest `steps` steps. `None`: too little was seen.
    pub(super) fn standing(&self, sensor: usize, steps: usize, radius_m: f32) -> Option<Standing> {
        let poses = self.poses();
        let far_m = 2.0 * radius_m + self.past_m[0][sensor];
        let found = BEGINS.iter().filter_map(|&begin| {
            let towards = AXES[sensor].turned(Point::small(begin));
            let begin = Point { x: towards.x * far_m, y: towards.y * far_m };
            self.explain(begin, &poses[..steps.min(STEPS)], radius_m)
        });
        found.min_by(|one, other| one.misfit.total_cmp(&other.misfit))
    }

    /// `[steps ago]`: where it was.
    fn poses(&self) -> [Was; STEPS] {
        let mut was = Was { at: Point::default(), facing: Point { x: 1.0, y: 0.0 } };
        let mut poses = [was; STEPS];
        for (pose, &(way_m, turn)) in poses[1..].iter_mut().zip(&self.moves) {
            let half = Point::small(-0.5 * turn);
            let middle = was.facing.turned(half);
            was.at.x -= way_m * middle.x;
            was.at.y -= way_m * middle.y;
            was.facing = middle.turned(half);
            *pose = was;
        }
        poses
    }

    /// The place near `begin` that explains best what was seen from these poses.
    fn explain(&self, begin: Point, poses: &[Was], radius_m: f32) -> Option<Standing> {
        let mut at = begin;
        for _ in 0..ROUNDS {
            let shift = self.sums(begin, at, poses, radius_m).shift();
            at = Point { x: at.x + shift.x, y: at.y + shift.y };
        }
        let sums = self.sums(begin, at, poses, radius_m);
        (sums.count >= READINGS_MIN).then(|| Standing { at, misfit: sums.misfit / sums.count as f32 })
    }

    fn sums(&self, begin: Point, at: Point, poses: &[Was], radius_m: f32) -> Sums {
        let weight = 1.0 / (BEGIN_M * BEGIN_M);
        let pull = Point { x: weight * (begin.x - at.x), y: weight * (begin.y - at.y) };
        let mut sums = Sums { xx: weight, yy: weight, pull, ..Sums::default() };
        for (was, readings) in poses.iter().zip(&self.past_m) {
            sums.add(was, readings, at, radius_m);
        }
        sums
    }
}

/// Sums of least squares for a place.
#[derive(Clone, Copy, Default)]
struct Sums {
    xx: f32,
    xy: f32,
    yy: f32,
    pull: Point,
    misfit: f32,
    count: u32,
}

impl Sums {
    /// What the two sensors said at one step that looked there most nearly.
    fn add(&mut self, was: &Was, readings: &[f32; SENSORS], at: Point, radius_m: f32) {
        let from = Point { x: at.x - was.at.x, y: at.y - was.at.y };
        let body = from.turned(Point { x: was.facing.x, y: -was.facing.y });
        let towards = |sensor: &usize| AXES[*sensor].dot(body);
        let Some(nearest) = (0..SENSORS).max_by(|a, b| towards(a).total_cmp(&towards(b))) else { return };
        let [_, left, right] = super::around(nearest);
        let beside = if towards(&left) > towards(&right) { left } else { right };
        for sensor in [nearest, beside] {
            let axis = AXES[sensor];
            let ray = Point { x: body.x - axis.x * radius_m, y: body.y - axis.y * radius_m };
            let far_m = libm::sqrtf(ray.dot(ray)).max(1e-4);
            let in_sight = ray.dot(axis) > CONE_COS * far_m;
            let (read_m, gap_m) = (readings[sensor], far_m - radius_m);
            if read_m.is_finite() && (in_sight || sensor == nearest) {
                let ray = ray.turned(was.facing);
                let towards = Point { x: ray.x / far_m, y: ray.y / far_m };
                self.read(towards, read_m - gap_m, read_m, sensor == nearest);
            } else if !read_m.is_finite() && sensor == nearest && in_sight && gap_m < SURELY * SIGHT_M {
                // Had it been there, it would have been seen.
                self.misfit += OUTLIER * OUTLIER;
                self.count += 1;
            }
        }
    }

    /// A reading, off by so much, metres, from what a disc at the place in question would give, in that direction.
    fn read(&mut self, towards: Point, off_m: f32, read_m: f32, nearest: bool) {
        let sigma_m = NOISE_M + NOISE_SHARE * read_m;
        let off = off_m.abs() / sigma_m;
        if !nearest && off > OUTLIER {
            // The one beside sees something else.
            return;
        }
        let weight = (OUTLIER / off.max(OUTLIER)) / (sigma_m * sigma_m);
        self.xx += weight * towards.x * towards.x;
        self.xy += weight * towards.x * towards.y;
        self.yy += weight * towards.y * towards.y;
        self.pull.x += weight * towards.x * off_m;
        self.pull.y += weight * towards.y * off_m;
        self.misfit += (off * off).min(OUTLIER * OUTLIER);
        self.count += 1;
    }

    /// Where the place had better be, from where it is.
    fn shift(&self) -> Point {
        let share = 1.0 / (self.xx * self.yy - self.xy * self.xy).max(1e-9);
        let Self { xx, xy, yy, pull, .. } = *self;
        Point { x: (yy * pull.x - xy * pull.y) * share, y: (xx * pull.y - xy * pull.x) * share }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS_M: f32 = 0.027;
    const DT: f64 = 0.016;

    /// What a robot has seen that drove 4 mm and turned a little each step, and passes a disc at `other`, in its body space
    /// by now, that moved so far each step.
    fn seeing(other: Point, step: Point) -> Reflex {
        let mut reflex = Reflex::new();
        let (way_m, turn) = (0.004, 0.02);
        reflex.moves = [(way_m, turn); STEPS - 1];
        let poses = reflex.poses();
        for (ago, was) in poses.iter().enumerate().rev() {
            let ago = ago as f32;
            let from = Point { x: other.x - step.x * ago - was.at.x, y: other.y - step.y * ago - was.at.y };
            let body = from.turned(Point { x: was.facing.x, y: -was.facing.y });
            let readings = core::array::from_fn(|sensor| {
                let ray =
                    Point { x: body.x - AXES[sensor].x * RADIUS_M, y: body.y - AXES[sensor].y * RADIUS_M };
                let far_m = libm::sqrtf(ray.dot(ray));
                if ray.dot(AXES[sensor]) > 0.643 * far_m { far_m - RADIUS_M } else { f32::INFINITY }
            });
            reflex.look(Some(&readings), (f64::from(way_m), f64::from(turn)), DT);
        }
        reflex
    }

    #[test]
    fn what_stands_is_found_where_it_stands() {
        for (degrees, sensor) in [(5.0f32, 0), (30.0, 1), (50.0, 1), (75.0, 2), (-40.0, 7)] {
            let angle = degrees.to_radians();
            let other = Point { x: 0.064 * libm::cosf(angle), y: 0.064 * libm::sinf(angle) };
            let found = seeing(other, Point::default()).standing(sensor, STEPS, RADIUS_M).unwrap();
            let off_m = libm::hypotf(found.at.x - other.x, found.at.y - other.y);
            let away_m = libm::hypotf(found.at.x, found.at.y) - 0.064;
            assert!(off_m < 0.007 && away_m.abs() < 0.001, "{degrees}: {found:?} for {other:?}");
            assert!(found.misfit < 0.1, "{degrees}: {found:?}");
        }
    }

    #[test]
    fn no_place_explains_one_that_drives_along_or_comes_the_other_way() {
        for step in [Point { x: 0.004, y: 0.0 }, Point { x: 0.003, y: 0.003 }, Point { x: -0.004, y: -0.002 }]
        {
            let found = seeing(Point { x: 0.045, y: 0.045 }, step).standing(1, STEPS, RADIUS_M).unwrap();
            assert!(found.misfit > 2.5, "{step:?}: {found:?}");
        }
    }

    #[test]
    fn what_was_not_seen_before_has_only_just_come() {
        let mut reflex = Reflex::new();
        let mut readings = [f32::INFINITY; SENSORS];
        readings[0] = 0.01;
        reflex.look(Some(&readings), (0.004, 0.0), DT);
        assert!(reflex.standing(0, STEPS, RADIUS_M).unwrap().misfit > 2.5);
        readings[0] = 0.028;
        reflex = Reflex::new();
        reflex.look(Some(&readings), (0.004, 0.0), DT);
        assert!(reflex.standing(0, STEPS, RADIUS_M).is_none());
    }
}
