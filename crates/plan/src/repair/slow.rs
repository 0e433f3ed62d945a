//! Pulls ways back under their limits: step by step speed, acceleration and turning.

use lightbots_base::Vec2;

use super::scene::Scene;
use super::turning::Turning;
use super::weave::Weave;

/// Passes over a way in one sweep.
const PASSES: usize = 2;

/// The limits of a scene, in lengths of a span.
pub(super) struct Slow<'a> {
    scene: &'a Scene,
    turning: Turning,
    easings: usize,
    /// The longest step between control points, metres.
    step_m: f64,
    /// The longest second difference of control points, metres.
    bow_m: f64,
}

impl<'a> Slow<'a> {
    /// For a weave of this span; against fast turns there are `easings` passes.
    pub fn new(scene: &'a Scene, weave: &Weave, easings: usize) -> Self {
        Self {
            scene,
            turning: Turning::new(weave.span_s, &scene.limits),
            easings,
            step_m: scene.limits.speed_mps * weave.span_s,
            bow_m: scene.limits.accel_mps2 * weave.span_s * weave.span_s,
        }
    }

    /// Pulls a robot's way towards its limits; whether it was beyond them.
    pub fn pull(&self, weave: &mut Weave, robot: usize) -> bool {
        let mut beyond = false;
        for _ in 0..PASSES {
            beyond = slow(weave, robot, self.step_m, self.bow_m);
            beyond |= weave.ease(robot, &self.turning, self.easings);
            if !beyond {
                break;
            }
        }
        let last = weave.spans;
        for point in &mut weave.way_mut(robot)[2..=last] {
            *point = self.scene.on_floor(robot, *point);
        }
        weave.tie_ends(robot);
        beyond
    }
}

/// One pass over a way: control points at most `step` apart, with second differences at most `bow`.
fn slow(weave: &mut Weave, robot: usize, step: f64, bow: f64) -> bool {
    let (start, end) = weave.ends(robot);
    let last = weave.spans;
    let way = weave.way_mut(robot);
    // At the ends acceleration is three times the first point's offset.
    let mut changed = tether(&mut way[2], start, bow / 3.0);
    if let Some(end) = end {
        changed |= tether(&mut way[last], end, bow / 3.0);
    }
    for j in 2..last {
        let gap = way[j + 1] - way[j];
        let length = gap.length();
        if length > step {
            let half = gap * (0.5 * (1.0 - step / length));
            way[j] += half;
            way[j + 1] -= half;
            changed |= length > step * 1.003;
        }
    }
    way[1] = start * 1.5 - way[2] * 0.5;
    way[last + 1] = end.map_or(way[last], |end| end * 1.5 - way[last] * 0.5);
    for j in 2..=last {
        let curl = way[j - 1] - way[j] * 2.0 + way[j + 1];
        let length = curl.length();
        if length > bow {
            let (before, after) = (f64::from(j > 2), f64::from(j < last));
            let force = curl * ((1.0 - bow / length) / (4.0 + before + after));
            way[j - 1] -= force * before;
            way[j] += force * 2.0;
            way[j + 1] -= force * after;
            changed |= length > bow * 1.006;
        }
    }
    weave.tie_ends(robot);
    changed
}

fn tether(point: &mut Vec2, to: Vec2, reach: f64) -> bool {
    let out = *point - to;
    let length = out.length();
    if length <= reach {
        return false;
    }
    *point = to + out * (reach / length);
    length > reach * 1.006
}
