//! Whether a detection that reuses the last one finds as many contacts as a new one.

use super::*;
use crate::TransitionProblem;
use crate::optimise::neighbours::MOVED_M;
use crate::seeded::Seeded;
use lightbots_base::Limits;

const WISH: Clearances = Clearances { robots_m: 0.06, walls_m: 0.006, edge_m: 0.0, slack_m: 0.002 };
/// Number of robots.
const ROBOTS: usize = 60;

/// Contacts of every pair and span closer than the wanted distance minus `less_m`.
fn near(detector: &ContactDetector, instance: &Instance, splines: &SplineSet, less_m: f64) -> Vec<Contact> {
    let pairs = (0..ROBOTS).flat_map(|a| (a + 1..ROBOTS).map(move |b| (a, b)));
    let all = pairs
        .flat_map(|(a, b)| (0..splines.spans).map(move |span| Contact::of_robots(span, a, b, WISH.robots_m)));
    let is_near = |contact: &Contact| {
        let Other::Robot(b) = contact.b else { return false };
        let wanted_m = WISH.robots_m.min(instance.ends_apart(contact.a, b));
        detector.closest(instance, splines, contact).apart < wanted_m + SKIN_M - less_m
    };
    all.filter(is_near).collect()
}

#[test]
fn robots_that_come_near_are_found_though_most_have_hardly_moved() {
    let (mut seeded, detector) = (Seeded::new(7), ContactDetector::new());
    let mut place = || Vec2::new(seeded.between(-0.6, 0.6), seeded.between(-0.6, 0.6));
    let (starts, goals): (Vec<Vec2>, Vec<Vec2>) = (0..ROBOTS).map(|_| (place(), place())).unzip();
    let floor = TransitionProblem::on_floor(Vec2::new(0.8, 0.8), Limits::ELISA_3);
    let problem = TransitionProblem { starts, goals, ..floor };
    let instance = Instance::new(&problem, &(0..ROBOTS).map(Some).collect::<Vec<_>>()).unwrap();
    let mut splines = SplineSet::new(&instance, 12, 0.3, |robot, step| {
        problem.starts[robot].lerp(problem.goals[robot], step as f64 / 12.0)
    });
    let (mut displacement, mut known) = (Displacement::new(ROBOTS, 15), Vec::new());
    let mut stayed = 0;
    for round in 0..60 {
        // Now and then all robots move, else a few move far and some hardly.
        for robot in 0..ROBOTS {
            let far_m = [0.0, 0.0004, 0.02][if round % 20 == 0 { 2 } else { seeded.below(20) / 9 }];
            let shift = Vec2::new(seeded.between(-far_m, far_m), seeded.between(-far_m, far_m));
            let span = seeded.below(12);
            let pull = splines.influence(robot, span, &basis(seeded.between(0.0, 1.0)));
            splines.displace(robot, span, &pull, shift);
            displacement.displace(robot, span, &pull, shift);
        }
        let before = known.len();
        known = detector.detect(&instance, &splines, WISH, &displacement, &known);
        stayed += known.len().min(before);
        displacement.mark(MOVED_M);
        let key = |contact: &Contact| match contact.b {
            Other::Robot(b) => (contact.span, contact.a, b),
            Other::Wall(_) => (contact.span, contact.a, usize::MAX),
        };
        let mut found: Vec<_> = known.iter().map(key).collect();
        assert!(found.is_sorted_by_key(|&(span, ..)| span));
        found.sort_unstable();
        found.dedup();
        assert_eq!(found.len(), known.len(), "round {round}: twice");
        for contact in near(&detector, &instance, &splines, 2.0 * MOVED_M) {
            assert!(found.binary_search(&key(&contact)).is_ok(), "round {round}: {:?}", key(&contact));
        }
        for contact in &known {
            let spare_m = detector.closest(&instance, &splines, contact).apart - contact.least;
            assert!(contact.clear_until <= displacement_m(&displacement, contact) + spare_m.max(0.0) + 1e-9);
        }
    }
    assert!(stayed > 1000);
}
