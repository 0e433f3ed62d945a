//! Relaxation in space and time: whoever comes too close is bent aside a little, then speed and acceleration are
//! pulled back under their limits, again and again until neither is needed.

use lightbots_base::Vec2;

use super::contacts::{Contact, Other, Watch, Wish};
use super::scene::Scene;
use super::weave::Weave;

/// Sweeps between two look-outs.
const LOOK_OUT_EVERY: usize = 6;
/// Sweeps after which there must be half as many contacts, or there is more time.
const STAGE: usize = 12;
/// So many contacts for each robot are not resolved any more once they become more.
const HOPELESS: usize = 14;
/// How much more time.
const GROWTH: f64 = 1.04;
/// Bending aims beyond the wish by this, metres: otherwise it would only be neared for ever.
const BEYOND_M: f64 = 0.0002;
/// Control points that hardly move a place must not be moved far for it.
const LEAST_PULL: f64 = 0.35;
/// Bending goes this much farther than needed at once.
const OVERSHOOT: f64 = 1.15;
/// Haste that is worth no further sweeps.
const GOOD_HASTE: f64 = 1.015;

/// How hard to try.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// How many sweeps at most.
    pub sweeps: usize,
    /// Sweeps after the first free of contacts, to become faster.
    pub polish: usize,
    /// How much longer than at first it may take.
    pub stretch: f64,
    /// Whether to stop early where contacts become more.
    pub wary: bool,
    /// How far all shall stay apart.
    pub wish: Wish,
}

/// A weave free of contacts, or `None` where the effort did not do. Where a stage does not bring much there is a little
/// more time for the next. The weave's haste says how much slower still it must be driven.
pub(super) fn relax(scene: &Scene, mut weave: Weave, effort: Effort, work: &mut usize) -> Option<Weave> {
    let watch = Watch::new();
    let longest_s = weave.span_s * effort.stretch;
    let mut dirty = vec![true; weave.robots()];
    let mut contacts = Vec::new();
    let mut best: Option<(f64, Weave)> = None;
    let (mut since_best, mut hoped, mut last) = (0, usize::MAX, usize::MAX);
    for sweep in 0..effort.sweeps {
        let Some(left) = work.checked_sub(weave.robots() * weave.spans) else { break };
        *work = left;
        if sweep % LOOK_OUT_EVERY == 0 {
            contacts = watch.look_out(scene, &weave, effort.wish);
        }
        let mut bent = bend_all(scene, &mut weave, &watch, &contacts, &mut dirty);
        if bent == 0 {
            contacts = watch.look_out(scene, &weave, effort.wish);
            bent = bend_all(scene, &mut weave, &watch, &contacts, &mut dirty);
        }
        if bent == 0 {
            let span_s = weave.span_s * weave.greatest_haste(&scene.limits);
            if best.as_ref().is_none_or(|(least_s, _)| span_s < *least_s) {
                best = Some((span_s, weave.clone()));
            }
            if span_s < weave.span_s * GOOD_HASTE {
                break;
            }
        }
        since_best += usize::from(best.is_some());
        if since_best > effort.polish {
            break;
        }
        if sweep % STAGE == STAGE - 1 {
            let bearable = if sweep > 2 * STAGE { 2 } else { HOPELESS };
            if best.is_none() && effort.wary && bent > last.max(bearable * weave.robots()) {
                return None;
            }
            last = bent;
            if best.is_none() && bent > hoped {
                weave.span_s *= GROWTH;
                dirty.fill(true);
                if weave.span_s > longest_s {
                    return None;
                }
            }
            hoped = bent / 2;
        }
        slow_all(scene, &mut weave, &mut dirty);
    }
    best.map(|(_, weave)| weave)
}

/// Bends whoever is too close; how many were.
fn bend_all(
    scene: &Scene,
    weave: &mut Weave,
    watch: &Watch,
    contacts: &[Contact],
    dirty: &mut [bool],
) -> usize {
    let mut bent = 0;
    for contact in contacts {
        let closest = watch.closest(scene, weave, contact);
        if closest.apart >= contact.least {
            continue;
        }
        let lack = contact.wish + BEYOND_M - closest.apart;
        bent += 1;
        let mine = weave.pull(contact.a, contact.span, &closest.weights);
        let square = |pull: &[f64; 4]| pull.iter().map(|share| share * share).sum::<f64>();
        match contact.b {
            Other::Robot(b) => {
                let theirs = weave.pull(b, contact.span, &closest.weights);
                let force = lack * OVERSHOOT / (square(&mine) + square(&theirs)).max(LEAST_PULL);
                weave.bend(contact.a, contact.span, &mine, closest.away * force);
                weave.bend(b, contact.span, &theirs, closest.away * -force);
                dirty[b] = true;
            }
            Other::Wall(_) => {
                let force = lack * OVERSHOOT / square(&mine).max(LEAST_PULL);
                weave.bend(contact.a, contact.span, &mine, closest.away * force);
            }
        }
        dirty[contact.a] = true;
    }
    bent
}

/// Pulls every robot that changed towards its limits.
fn slow_all(scene: &Scene, weave: &mut Weave, dirty: &mut [bool]) {
    let step = scene.limits.speed_mps * weave.span_s;
    let bow = scene.limits.accel_mps2 * weave.span_s * weave.span_s;
    for (robot, dirty) in dirty.iter_mut().enumerate() {
        if !*dirty {
            continue;
        }
        let mut changed = false;
        for _ in 0..2 {
            let once = slow(weave, robot, step, bow);
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
