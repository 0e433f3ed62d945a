//! Rehearses a few of the random pairs of frames that `cargo xtask pairs` rehearses by the thousand.

#[path = "../../examples/pairs/scene.rs"]
mod scene;

use lightbots_show::{Identity, Show};
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

#[test]
fn random_pairs_of_frames_are_solved_proven_and_driven_without_contact() {
    let mut fixed = 0;
    for number in 0..60 {
        let show = scene::pair(number, 40);
        fixed += usize::from(show.identity == Identity::Fixed);
        let options = RehearsalOptions { seed: number, conditions: Conditions::default(), robots: None };
        let report = rehearse(&show, &options, &mut |_| {});
        assert!(report.ok, "pair {number}: {:?}", report.issues);
        assert_eq!((report.contacts, report.frames_played), (0, report.frames), "pair {number}");
        // Noise and slip are on: no robot is exactly at its place.
        assert!(report.position_error_m.max > 1e-4, "pair {number}: {report:?}");
    }
    assert_eq!(fixed, 30);
}

/// Rehearses a random pair of up to 200 robots. With fixed identity a frame is put before it, in which robots are
/// sorted by x, so that they drive through a crowd twice.
fn run(number: u64, faults: &str) -> RehearsalReport {
    let mut show = scene::pair(number, 200);
    if show.identity == Identity::Fixed {
        let mut before = show.frames[0].clone();
        before.pixels.sort_by(|a, b| a.at.x.total_cmp(&b.at.x));
        (0..).zip(&mut before.pixels).for_each(|(id, pixel)| pixel.id = id);
        show.frames.insert(0, before);
    }
    rehearsed(&show, number, faults)
}

fn rehearsed(show: &Show, seed: u64, faults: &str) -> RehearsalReport {
    let faults = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = faults.added_to(Conditions::default());
    rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// A robot in a very dense crowd once braked for a neighbour that only crossed. It fell behind by more than others had
/// left room for, and they drove into it, or it dropped out.
#[test]
fn no_robot_brakes_for_one_that_crosses() {
    for number in [2763, 3331, 4523, 5045, 5355, 7953, 8737, 8855] {
        let report = run(number, "");
        assert!(report.ok, "pair {number}: {:?}", report.issues);
        assert_eq!((report.contacts, report.dropouts), (0, 0), "pair {number}");
    }
}

/// A slow robot once estimated the distance of a dead robot as growing while it came nearer, and sped up.
#[test]
fn no_robot_creeps_into_one_that_died() {
    let report = run(103, "kill=random");
    assert_eq!((report.contacts, report.dropouts), (0, 1), "{:?}", report.issues);
}

/// Three mistakes of a robot that had braked for a dead one beside its path. It took the dead robot for a moving one,
/// because the distance hardly changed. Or it did that because one of two sensors lost sight of the dead robot. Or it
/// crept on until nothing seemed to block it, and drove into the dead robot.
#[test]
fn a_robot_that_brakes_for_one_that_died_beside_its_path_does_not_go_on() {
    for number in [39, 561, 367] {
        let report = rehearsed(&scene::pair(number, 200), number, "kill=random");
        assert_eq!((report.contacts, report.dropouts), (0, 1), "pair {number}: {:?}", report.issues);
    }
}

/// A robot that brakes for noise falls behind, and another one that is held blocks its path. The late robot needs a new
/// plan and must not drop out.
#[test]
fn a_blocked_robot_that_fell_behind_is_planned_anew_and_not_given_up() {
    let report = run(73, "slip=10%,gps=5mm,heading=2deg,fix-delay=100ms,fix-dropout=1s");
    assert!(report.ok, "{:?}", report.issues);
    assert_eq!((report.contacts, report.dropouts), (0, 0));
}
