//! Moves control points of splines so that speed, acceleration and turn rate keep their limits: a projection onto one
//! limit after the other. A span is one piece of a spline, determined by four successive control points.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::spline::set::SplineSet;
use crate::spline::turn_rate::{DirtySpans, TurnRate};

/// Most passes over a spline in one call of [`LimitProjector::project`].
const PASSES: usize = 2;

/// The limits of an instance's robots, for spans of one duration.
pub(crate) struct LimitProjector<'a> {
    instance: &'a Instance<'a>,
    turn_rate: TurnRate,
    smoothing_passes: usize,
    /// Least distance of robots' rims from the floor's edge, metres.
    off_edge_m: f64,
    /// Longest step between two neighbouring control points, metres, by the speed limit.
    step_m: f64,
    /// Longest second difference of three neighbouring control points, metres, by the acceleration limit.
    bow_m: f64,
}

impl<'a> LimitProjector<'a> {
    /// Prepares to project splines with spans of the same duration as those of `splines`. Rims stay `off_edge_m` metres
    /// from the floor's edge. Fast turns are smoothed in at most `smoothing_passes` passes.
    pub fn new(
        instance: &'a Instance<'a>,
        splines: &SplineSet,
        off_edge_m: f64,
        smoothing_passes: usize,
    ) -> Self {
        Self {
            instance,
            turn_rate: TurnRate::new(splines.span_s, &instance.limits),
            smoothing_passes,
            off_edge_m,
            step_m: instance.limits.speed_mps * splines.span_s,
            bow_m: instance.limits.accel_mps2 * splines.span_s * splines.span_s,
        }
    }

    /// Projects a robot's spline onto the limits of speed and acceleration, and in the spans of `dirty` onto the limit
    /// of the turn rate. Then moves control points onto the floor. Returns the spans to project again; `None` if the
    /// last pass found no limit clearly exceeded and changed no turn.
    pub fn project(
        &self,
        splines: &mut SplineSet,
        robot: usize,
        mut dirty: DirtySpans,
    ) -> Option<DirtySpans> {
        let mut beyond = false;
        for _ in 0..PASSES {
            beyond = project_once(splines, robot, self.step_m, self.bow_m, &mut dirty);
            let (left, eased) = splines.smooth_turns(robot, &self.turn_rate, self.smoothing_passes, dirty);
            (dirty, beyond) = (left, beyond | eased);
            if !beyond {
                break;
            }
        }
        let last = splines.spans;
        for (point, place) in splines.spline_mut(robot)[2..=last].iter_mut().enumerate() {
            let on_floor = self.instance.on_floor(robot, *place, self.off_edge_m);
            if on_floor != *place {
                *place = on_floor;
                dirty.add_point(point + 2);
            }
        }
        splines.tie_ends(robot);
        beyond.then_some(dirty)
    }
}

/// Makes one pass over a robot's spline. It moves control points so that neighbours are at most `step` metres apart,
/// and second differences are at most `bow` metres. Adds changed spans to `dirty`, and returns whether a limit was
/// clearly exceeded.
fn project_once(splines: &mut SplineSet, robot: usize, step: f64, bow: f64, dirty: &mut DirtySpans) -> bool {
    let (start, end) = splines.ends(robot);
    let last = splines.spans;
    let spline = splines.spline_mut(robot);
    let mut moved = |point: usize| dirty.add_point(point);
    // At the ends, the second difference is three times the distance of the first free point from the end.
    let mut changed = tether(&mut spline[2], start, bow / 3.0, || moved(2));
    if let Some(end) = end {
        changed |= tether(&mut spline[last], end, bow / 3.0, || moved(last));
    }
    for j in 2..last {
        let gap = spline[j + 1] - spline[j];
        let square = gap.length_squared();
        if square > step * step {
            let length = square.sqrt();
            let half = gap * (0.5 * (1.0 - step / length));
            spline[j] += half;
            spline[j + 1] -= half;
            changed |= length > step * 1.003;
            moved(j);
            moved(j + 1);
        }
    }
    spline[1] = start * 1.5 - spline[2] * 0.5;
    spline[last + 1] = end.map_or(spline[last], |end| end * 1.5 - spline[last] * 0.5);
    for j in 2..=last {
        let curl = spline[j - 1] - spline[j] * 2.0 + spline[j + 1];
        let square = curl.length_squared();
        if square > bow * bow {
            let length = square.sqrt();
            let (before, after) = (f64::from(j > 2), f64::from(j < last));
            let force = curl * ((1.0 - bow / length) / (4.0 + before + after));
            spline[j - 1] -= force * before;
            spline[j] += force * 2.0;
            spline[j + 1] -= force * after;
            changed |= length > bow * 1.006;
            (j - 1..=j + 1).for_each(&mut moved);
        }
    }
    splines.tie_ends(robot);
    changed
}

/// Moves `point` towards `to` if it is farther away than `reach` metres. Returns whether it was clearly farther.
fn tether(point: &mut Vec2, to: Vec2, reach: f64, moved: impl FnOnce()) -> bool {
    let out = *point - to;
    let length = out.length();
    if length <= reach {
        return false;
    }
    *point = to + out * (reach / length);
    moved();
    length > reach * 1.006
}
