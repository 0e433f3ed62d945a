//! Pulls ways back under their limits: step by step speed, acceleration and turning.

use lightbots_base::Vec2;

use super::scene::Scene;
use super::turning::Turning;
use super::weave::Weave;

/// Passes over a way in one sweep.
const PASSES: usize = 2;

/// Pulls every robot that changed towards its limits; who is within them is not dirty any more.
pub(super) fn slow_all(scene: &Scene, weave: &mut Weave, dirty: &mut [bool], stale: &mut [bool]) {
    let step = scene.limits.speed_mps * weave.span_s;
    let bow = scene.limits.accel_mps2 * weave.span_s * weave.span_s;
    let turning = Turning::new(weave.span_s, &scene.limits);
    for (robot, (dirty, stale)) in dirty.iter_mut().zip(stale).enumerate() {
        if !*dirty {
            continue;
        }
        *stale = true;
        let mut changed = false;
        for _ in 0..PASSES {
            let once = slow(weave, robot, step, bow) | weave.ease(robot, &turning);
            changed |= once;
            if !once {
                break;
            }
        }
        *dirty = changed;
        let last = weave.spans;
        for point in &mut weave.way_mut(robot)[2..=last] {
            *point = scene.on_floor(robot, *point);
        }
        weave.tie_ends(robot);
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
            way[j + 1] = way[j + 1] - half;
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
            way[j - 1] = way[j - 1] - force * before;
            way[j] += force * 2.0;
            way[j + 1] = way[j + 1] - force * after;
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
