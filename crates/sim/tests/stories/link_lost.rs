//! The broker freezes or is gone during a show of 30 robots. All of them play the show to its end.

use lightbots_show::Show;
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// When outages begin, seconds after the first departure: in a drive, at its end, and after robots have reached the
/// frame.
const MOMENTS_S: [f64; 3] = [0.7, 3.9, 6.1];

fn hello() -> Show {
    lightbots_exchange::read(include_bytes!("../../../../shows/hello.json"), None).unwrap().show
}

fn play(faults: &str, seed: u64) -> RehearsalReport {
    let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
    let report = rehearse(&hello(), &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    let RehearsalReport { issues, frames, robots, .. } = &report;
    assert_eq!((*robots, report.frames_played), (30, *frames), "{faults}, seed {seed}: {issues:#?}");
    assert_eq!(report.contacts, 0, "{faults}, seed {seed}: {issues:#?}");
    report
}

fn count(report: &RehearsalReport, code: &str) -> usize {
    report.issues.iter().filter(|issue| issue.code == code).count()
}

#[test]
fn a_broker_that_freezes_or_is_gone_costs_no_robot() {
    for kind in ["freeze", "gone"] {
        for (over_s, presses) in [(1, 0), (4, 0), (20, 0), (40, 1)] {
            for (at_s, seed) in MOMENTS_S.into_iter().zip(1..) {
                let faults = format!("{kind}={at_s}s+{over_s}s");
                let report = play(&faults, seed);
                let seen = (report.dropouts, count(&report, "pressed"));
                assert_eq!(seen, (0, presses), "{faults}, seed {seed}: {:#?}", report.issues);
            }
        }
    }
}

#[test]
fn three_of_thirty_robots_that_die_together_are_lost_robots() {
    for seed in 1..=3 {
        let report = play("kill=3@1.7s,kill=11@1.7s,kill=20@1.7s", seed);
        let seen = (report.dropouts, count(&report, "link-lost"));
        assert_eq!(seen, (3, 0), "seed {seed}: {:#?}", report.issues);
    }
}

/// A third of the robots use one access point, which has no power for 6 s.
#[test]
fn a_third_of_the_robots_cut_off_together_is_a_lost_link() {
    let cut: Vec<String> = (0..10).map(|robot| format!("cut={robot}@2s+6s")).collect();
    for seed in 1..=3 {
        let report = play(&cut.join(","), seed);
        let seen = (report.dropouts, count(&report, "link-lost"));
        assert_eq!(seen, (0, 1), "seed {seed}: {:#?}", report.issues);
    }
}
