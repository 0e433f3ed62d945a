//! Pulls ways back under their limits: step by step speed, acceleration and turning.

use lightbots_base::Vec2;

use crate::instance::Scene;
use crate::spline::set::Weave;
use crate::spline::turn_rate::{Look, Turning};

/// Passes over a way in one sweep.
const PASSES: usize = 2;

/// The limits of a scene, in lengths of a span.
pub(crate) struct Slow<'a> {
    scene: &'a Scene<'a>,
    turning: Turning,
    easings: usize,
    /// How far rims stay off the floor's edge, metres.
    off_edge_m: f64,
    /// The longest step between control points, metres.
    step_m: f64,
    /// The longest second difference of control points, metres.
    bow_m: f64,
}

impl<'a> Slow<'a> {
    /// For a weave of this span, so far off the floor's edge, metres; against fast turns there are `easings` passes.
    pub fn new(scene: &'a Scene<'a>, weave: &Weave, off_edge_m: f64, easings: usize) -> Self {
        Self {
            scene,
            turning: Turning::new(weave.span_s, &scene.limits),
            easings,
            off_edge_m,
            step_m: scene.limits.speed_mps * weave.span_s,
            bow_m: scene.limits.accel_mps2 * weave.span_s * weave.span_s,
        }
    }

    /// Pulls a robot's way towards its limits where `look` says that it changed; where to look again, `None` where it
    /// keeps them all.
    pub fn pull(&self, weave: &mut Weave, robot: usize, mut look: Look) -> Option<Look> {
        let mut beyond = false;
        for _ in 0..PASSES {
            beyond = slow(weave, robot, self.step_m, self.bow_m, &mut look);
            let (left, eased) = weave.ease(robot, &self.turning, self.easings, look);
            (look, beyond) = (left, beyond | eased);
            if !beyond {
                break;
            }
        }
        let last = weave.spans;
        for (point, place) in weave.way_mut(robot)[2..=last].iter_mut().enumerate() {
            let on_floor = self.scene.on_floor(robot, *place, self.off_edge_m);
            if on_floor != *place {
                *place = on_floor;
                look.add_point(point + 2);
            }
        }
        weave.tie_ends(robot);
        beyond.then_some(look)
    }
}

/// One pass over a way: control points at most `step` apart, with second differences at most `bow`. Adds to `look`
/// where it changed.
fn slow(weave: &mut Weave, robot: usize, step: f64, bow: f64, look: &mut Look) -> bool {
    let (start, end) = weave.ends(robot);
    let last = weave.spans;
    let way = weave.way_mut(robot);
    let mut moved = |point: usize| look.add_point(point);
    // At the ends acceleration is three times the first point's offset.
    let mut changed = tether(&mut way[2], start, bow / 3.0, || moved(2));
    if let Some(end) = end {
        changed |= tether(&mut way[last], end, bow / 3.0, || moved(last));
    }
    for j in 2..last {
        let gap = way[j + 1] - way[j];
        let square = gap.length_squared();
        if square > step * step {
            let length = square.sqrt();
            let half = gap * (0.5 * (1.0 - step / length));
            way[j] += half;
            way[j + 1] -= half;
            changed |= length > step * 1.003;
            moved(j);
            moved(j + 1);
        }
    }
    way[1] = start * 1.5 - way[2] * 0.5;
    way[last + 1] = end.map_or(way[last], |end| end * 1.5 - way[last] * 0.5);
    for j in 2..=last {
        let curl = way[j - 1] - way[j] * 2.0 + way[j + 1];
        let square = curl.length_squared();
        if square > bow * bow {
            let length = square.sqrt();
            let (before, after) = (f64::from(j > 2), f64::from(j < last));
            let force = curl * ((1.0 - bow / length) / (4.0 + before + after));
            way[j - 1] -= force * before;
            way[j] += force * 2.0;
            way[j + 1] -= force * after;
            changed |= length > bow * 1.006;
            (j - 1..=j + 1).for_each(&mut moved);
        }
    }
    weave.tie_ends(robot);
    changed
}

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
