//! Whether a look-out that knows the one before finds as many.

use super::*;
use crate::TransitionProblem;
use crate::optimise::neighbours::STIR_M;
use crate::seeded::Seeded;
use lightbots_base::Limits;

const WISH: Wish = Wish { robots_m: 0.06, walls_m: 0.006, edge_m: 0.0, slack_m: 0.002 };
const ROBOTS: usize = 60;

/// Every pair and span that is nearer than a contact need be, by `less_m`.
fn near(watch: &Watch, scene: &Scene, weave: &Weave, less_m: f64) -> Vec<Contact> {
    let pairs = (0..ROBOTS).flat_map(|a| (a + 1..ROBOTS).map(move |b| (a, b)));
    let all = pairs
        .flat_map(|(a, b)| (0..weave.spans).map(move |span| Contact::of_robots(span, a, b, WISH.robots_m)));
    let is_near = |contact: &Contact| {
        let Other::Robot(b) = contact.b else { return false };
        let wish_m = WISH.robots_m.min(scene.ends_apart(contact.a, b));
        watch.closest(scene, weave, contact).apart < wish_m + SKIN_M - less_m
    };
    all.filter(is_near).collect()
}

#[test]
fn who_comes_near_is_found_though_most_have_hardly_moved() {
    let (mut seeded, watch) = (Seeded::new(7), Watch::new());
    let mut place = || Vec2::new(seeded.between(-0.6, 0.6), seeded.between(-0.6, 0.6));
    let (starts, goals): (Vec<Vec2>, Vec<Vec2>) = (0..ROBOTS).map(|_| (place(), place())).unzip();
    let floor = TransitionProblem::on_floor(Vec2::new(0.8, 0.8), Limits::ELISA_3);
    let problem = TransitionProblem { starts, goals, ..floor };
    let scene = Scene::new(&problem, &(0..ROBOTS).map(Some).collect::<Vec<_>>()).unwrap();
    let mut weave = Weave::new(&scene, 12, 0.3, |robot, step| {
        problem.starts[robot].lerp(problem.goals[robot], step as f64 / 12.0)
    });
    let (mut travel, mut known) = (Travel::new(ROBOTS, 15), Vec::new());
    let mut stayed = 0;
    for round in 0..60 {
        // Now and then all stir, else a few do much and some hardly.
        for robot in 0..ROBOTS {
            let far_m = [0.0, 0.0004, 0.02][if round % 20 == 0 { 2 } else { seeded.below(20) / 9 }];
            let shift = Vec2::new(seeded.between(-far_m, far_m), seeded.between(-far_m, far_m));
            let span = seeded.below(12);
            let pull = weave.pull(robot, span, &basis(seeded.between(0.0, 1.0)));
            weave.bend(robot, span, &pull, shift);
            travel.bend(robot, span, &pull, shift);
        }
        let before = known.len();
        known = watch.look_out(&scene, &weave, WISH, &travel, &known);
        stayed += known.len().min(before);
        travel.mark(STIR_M);
        let key = |contact: &Contact| match contact.b {
            Other::Robot(b) => (contact.span, contact.a, b),
            Other::Wall(_) => (contact.span, contact.a, usize::MAX),
        };
        let mut found: Vec<_> = known.iter().map(key).collect();
        assert!(found.is_sorted_by_key(|&(span, ..)| span));
        found.sort_unstable();
        found.dedup();
        assert_eq!(found.len(), known.len(), "round {round}: twice");
        for contact in near(&watch, &scene, &weave, 2.0 * STIR_M) {
            assert!(found.binary_search(&key(&contact)).is_ok(), "round {round}: {:?}", key(&contact));
        }
        for contact in &known {
            let spare_m = watch.closest(&scene, &weave, contact).apart - contact.least;
            assert!(contact.clear_until <= travelled(&travel, contact) + spare_m.max(0.0) + 1e-9);
        }
    }
    assert!(stayed > 1000);
}
