//! A broker freezes or is gone while 30 robots drive. The show pauses, and all robots play it to its end.

use serde_json::{Value, json};

use crate::child::{self, Child};
use crate::mosquitto::Mosquitto;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// A show of two rows of 30 robots, 0.9 m apart.
fn far_rows() -> String {
    let mut show: Value = serde_json::from_str(&shows::row(30, &[0.1, 0.1])).unwrap();
    for pixel in show["frames"][1]["pixels"].as_array_mut().unwrap() {
        pixel["place"][1] = json!(0.3);
    }
    shows::file("rows.lightbots.json", show.to_string())
}

/// Text of the log when robots have not reported for 6 s. By then all have stopped by themselves.
const LONG_SILENT: &str = "not reported lately";

#[cfg(target_os = "linux")]
#[test]
fn the_embedded_broker_freezes_and_the_show_is_played_to_its_end() {
    let _turn = alone();
    let (server, address, _) = start(&["--robots", "30", &far_rows()]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(30);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.wait_for_log("To frame 2");
    let broker = server.children()[0];
    child::send_signal(broker, "-STOP");
    let line = screen.wait_for_log("Link lost");
    assert!(line.contains("of 30 robots"), "{line}");
    screen.until("the state", |screen| (screen.phase() == "link_lost").then_some(()));
    let early = screen.operate(json!({"do": "go_on"}));
    assert_eq!(early["ok"], false, "no robot reports: {early}");
    screen.wait_for_log(LONG_SILENT);
    child::send_signal(broker, "-CONT");
    screen.wait_for_log("30 of 30 robots report again");
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
}

/// Plays a show on Mosquitto and calls `disturb` while robots drive to the second frame. Returns the report, or null
/// without Mosquitto.
fn played_on_mosquitto(disturb: impl FnOnce(&mut Mosquitto, &Child)) -> Value {
    let Some(mut broker) = Mosquitto::start() else { return Value::Null };
    let url = broker.url();
    let _robots = Child::lightbots(&["robots", "--count", "30", "--broker", &url]);
    let show = far_rows();
    let all = ["play", &show, "--broker", &url, "--json", "--log", "info", "--patience", "90"];
    let mut play = Child::lightbots(&all);
    wait_until_said(&play, "To frame 2");
    disturb(&mut broker, &play);
    assert_eq!(play.end(), 0);
    let report: Value = serde_json::from_str(&play.out()).unwrap();
    let figures = (report["frames_played"].as_u64(), report["dropouts"].as_u64(), report["ok"].as_bool());
    assert_eq!(figures, (Some(2), Some(0), Some(true)), "{report}");
    report
}

fn wait_until_said(child: &Child, part: &str) {
    wait_for(part, || child.err().contains(part).then_some(()));
}

#[cfg(unix)]
#[test]
fn mosquitto_freezes_and_the_show_is_played_to_its_end() {
    let _turn = alone();
    let report = played_on_mosquitto(|broker, play| {
        broker.signal("-STOP");
        wait_until_said(play, "Link lost");
        wait_until_said(play, LONG_SILENT);
        broker.signal("-CONT");
    });
    assert!(report.is_null() || report["issues"].to_string().contains("link-back"), "{report}");
}

#[test]
fn mosquitto_is_gone_and_the_show_is_played_to_its_end() {
    let _turn = alone();
    played_on_mosquitto(|broker, play| {
        broker.kill();
        wait_until_said(play, LONG_SILENT);
        broker.start_again();
    });
}
