//! The controller is killed in a show of 30 robots, and another controller continues it from the journal.

use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, rehearse};

/// Time without a controller, seconds. Robots still drive when it is back, or have stopped by themselves.
const AWAY_S: [f64; 5] = [0.2, 0.8, 1.7, 2.5, 6.0];
/// Longest time until all robots stand without a controller, seconds: R43 of docs/protocol.md, and the time to stop.
const STAND_S: f64 = 2.2;

fn play(faults: &str, seed: u64) -> RehearsalReport {
    let show = lightbots_exchange::read(include_bytes!("../../../../shows/hello.json"), None).unwrap().show;
    let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
    let report = rehearse(&show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {});
    let seen = (report.frames_played, report.contacts, report.dropouts);
    assert_eq!(seen, (report.frames, 0, 0), "{faults}, seed {seed}: {:#?}", report.issues);
    let stop_s = report.stop_after_crash_s.unwrap();
    assert!(stop_s <= STAND_S, "{faults}, seed {seed}: robots stand after {stop_s} s");
    report
}

fn count(report: &RehearsalReport, code: &str) -> usize {
    report.issues.iter().filter(|issue| issue.code == code).count()
}

#[test]
fn a_show_whose_controller_is_killed_at_any_moment_is_finished() {
    for number in 0..20_u32 {
        // The moments are spread evenly over the show.
        let at_s = 0.1 + (0.618 * f64::from(number)).fract() * 17.0;
        let faults = format!("crash={at_s:.3}s+{}s", AWAY_S[number as usize % AWAY_S.len()]);
        let report = play(&faults, number.into());
        assert_eq!((count(&report, "taken-up"), count(&report, "pressed")), (1, 0), "{:#?}", report.issues);
    }
}

#[test]
fn a_controller_may_be_killed_again_while_it_gathers_robots() {
    let report = play("crash=3s+1s,crash=4.3s+1s,crash=5.5s+3s,crash=12s+40s", 1);
    assert_eq!((count(&report, "taken-up"), count(&report, "pressed")), (4, 1), "{:#?}", report.issues);
}

#[test]
fn messages_may_be_lost_and_late_when_the_controller_is_back() {
    for seed in 1..=3 {
        play("crash=2.1s+1s,crash=9s+3s,loss=5%,delay=20..80ms,double=1%", seed);
    }
}

#[test]
fn the_same_seed_gives_the_same_crash() {
    assert_eq!(play("crash=4s+2s", 7), play("crash=4s+2s", 7));
}
