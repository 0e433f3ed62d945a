//! The commands `robots` and `play` on Mosquitto.

use serde_json::Value;

use crate::child::Child;
use crate::mosquitto::Mosquitto;
use crate::{alone, shows, wait_for};

fn robots(count: &str, broker: &str) -> Child {
    Child::lightbots(&["robots", "--count", count, "--broker", broker])
}

fn play(show: &str, broker: &str, more: &[&str]) -> Child {
    let mut all = vec!["play", show, "--broker", broker, "--json", "--log", "info", "--patience", "90"];
    all.extend(more);
    Child::lightbots(&all)
}

/// Waits for the end of `play`, asserts that the whole show was played, and returns the report.
fn report(mut play: Child) -> Value {
    let code = play.end();
    let report: Value = serde_json::from_str(&play.out()).unwrap_or_default();
    assert_eq!((code, report["ok"].as_bool()), (0, Some(true)), "{report}");
    report
}

#[test]
fn thirty_robots_play_a_show() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = robots("30", &broker.url());
    let report = report(play(&shows::row_file(30, &[0.1, 0.1]), &broker.url(), &[]));
    assert_eq!((report["robots"].as_u64(), report["frames_played"].as_u64()), (Some(30), Some(2)));
    assert_eq!(report["dropouts"], 0);
    assert!(report["position_error_m"]["max"].as_f64().unwrap() <= 0.03, "{report}");
    for key in ["duration_s", "arrival_spread_s", "issues"] {
        assert!(!report[key].is_null(), "{key} is missing in {report}");
    }
}

#[test]
fn the_controller_may_come_first() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let play = play(&shows::row_file(30, &[0.1]), &broker.url(), &[]);
    wait_for("the controller on the broker", || play.err().contains("Connected").then_some(()));
    let _robots = robots("30", &broker.url());
    assert_eq!(report(play)["robots"], 30);
}

#[test]
fn a_run_survives_a_restart_of_the_broker() {
    let _turn = alone();
    let Some(mut broker) = Mosquitto::start() else { return };
    let _robots = robots("30", &broker.url());
    let play = play(&shows::row_file(30, &[4.0, 0.1, 0.1]), &broker.url(), &[]);
    wait_for("the first picture", || play.err().contains("Frame 1 stands").then_some(()));
    broker.restart();
    assert_eq!(report(play)["frames_played"], 3);
}

#[test]
fn fewer_robots_than_pixels_play_what_they_can() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = robots("28", &broker.url());
    let show = shows::row_file(30, &[0.1]);
    let report = report(play(&show, &broker.url(), &["--wait", "28"]));
    assert_eq!(report["robots"], 28);
    assert!(report["issues"].to_string().contains("left-out"), "{report}");
}

#[test]
fn a_run_that_is_stopped_tells_how_long_it_was() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = robots("2", &broker.url());
    let mut play = play(&shows::row_file(2, &[30.0]), &broker.url(), &[]);
    wait_for("the first picture", || play.err().contains("Frame 1 stands").then_some(()));
    play.terminate();
    assert_eq!(play.end(), 1);
    let report: Value = serde_json::from_str(&play.out()).expect("one object");
    // The drive of 0.1 m takes 0.99 s, so the report covers a whole drive.
    assert!(report["duration_s"].as_f64().unwrap() > 0.98, "{report}");
    assert_eq!((report["ok"].as_bool(), report["frames_played"].as_u64()), (Some(false), Some(1)));
}

#[test]
fn two_controllers_on_one_broker_say_so() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let one = play(&shows::row_file(2, &[0.1]), &broker.url(), &[]);
    wait_for("the first controller", || one.err().contains("Connected").then_some(()));
    assert!(!one.err().contains("Another controller"), "{}", one.err());
    let other = play(&shows::row_file(2, &[0.1]), &broker.url(), &[]);
    for controller in [&one, &other] {
        wait_for("a warning", || controller.err().contains("Another controller").then_some(()));
    }
}

#[test]
fn programs_get_one_object_of_a_run_that_never_began() {
    let show = shows::row_file(2, &[0.1]);
    // Nothing listens on port 1.
    let (broker, patience) = (["--broker", "mqtt://127.0.0.1:1"], ["--patience", "1"]);
    let mut child =
        Child::lightbots(&[&["play", &show, "--json", "--log", "off"], &broker[..], &patience[..]].concat());
    assert_eq!(child.end(), 1);
    let report: Value = serde_json::from_str(&child.out()).unwrap();
    assert_eq!((report["ok"].as_bool(), report["frames_played"].as_u64()), (Some(false), Some(0)));
    assert!(report["issues"][0]["message"].to_string().contains("no broker answers"), "{report}");
    assert_eq!(child.err().lines().count(), 1, "{}", child.err());
}

#[test]
fn waiting_ends_with_a_clear_line() {
    let show = shows::row_file(2, &[0.1]);
    // Nothing listens on port 1.
    let mut child = Child::lightbots(&[
        "play",
        &show,
        "--broker",
        "mqtt://127.0.0.1:1",
        "--patience",
        "1",
        "--log",
        "off",
    ]);
    assert_eq!(child.end(), 1);
    let err = child.err();
    assert!(err.contains("no broker answers") && err.lines().count() == 1, "{err}");
}
