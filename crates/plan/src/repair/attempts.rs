//! What is tried in which order, until one way is good enough or the work is used up.

use lightbots_show::Easing;

use super::around::courses;
use super::contacts::Wish;
use super::guess::{Pace, along, length};
use super::lattice::Lattice;
use super::ordered::ordered;
use super::relax::{Effort, relax};
use super::scene::Scene;
use super::weave::Weave;

/// Distance of lattice nodes, metres: robots that follow each other around corners stay 0.83 of it apart.
const PITCH_M: f64 = 0.072;
/// The same, where the first did not do.
const LOOSE_PITCH_M: f64 = 0.078;
/// Robots times spans times sweeps, for all attempts: some seconds.
const MOST_WORK: usize = 30_000_000;
/// Where this much work is left, a better way is still looked for.
const WORK_TO_SPARE: usize = 24_000_000;
/// So much longer than the least is good enough.
const GOOD: f64 = 1.15;
/// Larger crowds do not bow: the lattice is quicker.
const MOST_TO_BOW: usize = 600;
/// Bows tried although a way is known; more are only for those who have none.
const ENOUGH_BOWS: usize = 4;
/// What the first guess aims at: room for robots that follow curves with poor sensors on slippery floors.
const ROOMY: Wish = Wish { robots_m: 0.0675, walls_m: 0.0115, slack_m: 0.002 };
/// What further guesses aim at, and the lattice, which is not as wide.
const WIDE: Wish = Wish { robots_m: 0.0625, walls_m: 0.0075, slack_m: 0.002 };
const NARROW: Wish = Wish { robots_m: 0.0595, walls_m: 0.0065, slack_m: 0.0015 };

/// The swiftest of what was found and `holds`; `None` where nothing was.
pub(super) fn best(scene: &Scene, easing: Easing, holds: &dyn Fn(&Weave) -> bool) -> Option<Weave> {
    let lattice = Lattice::new(scene, PITCH_M)?;
    let courses = courses(scene, &lattice)?;
    let longest = courses.iter().map(|course| length(course)).fold(0.0, f64::max);
    let least_s = Pace::new(longest, &scene.limits, easing, 1.0).drive_s;
    let mut work = MOST_WORK;
    let mut best: Option<Weave> = None;
    let bows: &[f64] = if scene.robots() > MOST_TO_BOW {
        &[0.0]
    } else {
        &[0.0, 0.0, 0.12, 0.25, 0.05, -0.05, 0.18, -0.12, 0.08, -0.2]
    };
    for (tries, &bow) in bows.iter().enumerate() {
        let wish = if tries == 0 && bows.len() > 1 { ROOMY } else { WIDE };
        let pace = Pace::new(longest, &scene.limits, easing, 1.0 + 2.0 * bow * bow);
        let effort = Effort { sweeps: 300, stretch: 2.0, wary: true, wish };
        let found = relax(scene, along(scene, &courses, &pace, bow), effort, &mut work);
        best = swifter(scene, best, found.filter(|weave| holds(weave)));
        if best.as_ref().is_some_and(|weave| {
            tries >= ENOUGH_BOWS || lasts(scene, weave) < least_s * GOOD || work < WORK_TO_SPARE
        }) {
            return best;
        }
    }
    for pitch_m in [PITCH_M, LOOSE_PITCH_M] {
        if best.is_some() && pitch_m > PITCH_M {
            break;
        }
        let effort = Effort { sweeps: 300, stretch: 2.5, wary: false, wish: NARROW };
        let lattice = Lattice::new(scene, pitch_m)?;
        let found = ordered(scene, &lattice).and_then(|weave| relax(scene, weave, effort, &mut work));
        best = swifter(scene, best, found.filter(|weave| holds(weave)));
    }
    best
}

/// How long a weave must take, seconds.
fn lasts(scene: &Scene, weave: &Weave) -> f64 {
    weave.span_s * weave.spans as f64 * weave.greatest_haste(&scene.limits)
}

fn swifter(scene: &Scene, one: Option<Weave>, other: Option<Weave>) -> Option<Weave> {
    match (one, other) {
        (Some(one), Some(other)) if lasts(scene, &other) < lasts(scene, &one) => Some(other),
        (one, other) => one.or(other),
    }
}
