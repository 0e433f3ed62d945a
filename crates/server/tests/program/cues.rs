//! Frames that wait for GO, which comes from the terminal of `play` or from MQTT.

use serde_json::{Value, json};

use crate::child::Child;
use crate::mosquitto::Mosquitto;
use crate::plain_mqtt::Mqtt;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// Topic of GO messages.
const CUE: &str = "T/LightBot/Controller/Cue";

/// Writes a show of three frames whose second one waits for GO. Returns its path.
fn show_file() -> String {
    let mut show: Value = serde_json::from_str(&shows::row(3, &[0.1, 0.1, 0.1])).unwrap();
    show["lightbots"] = json!(2);
    show["frames"][1]["id"] = json!("second");
    show["cues"] = json!([{"name": "Curtain", "frame": "second"}]);
    shows::file("cue.lightbots.json", show.to_string())
}

fn assert_played(mut play: Child) {
    let code = play.end();
    let report: Value = serde_json::from_str(&play.out()).unwrap_or_default();
    assert_eq!((code, report["frames_played"].as_u64()), (0, Some(3)), "{report} {}", play.err());
}

fn arguments<'a>(show: &'a str, broker: &'a str) -> [&'a str; 8] {
    ["play", show, "--broker", broker, "--json", "--log", "info", "--patience=90"]
}

#[test]
fn enter_at_the_terminal_is_go() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = Child::lightbots(&["robots", "--count", "3", "--broker", &broker.url()]);
    let mut play = Child::lightbots_at_terminal(&arguments(&show_file(), &broker.url()));
    play.complains("Frame 2 waits for GO: Curtain.");
    play.complains("press Enter for GO");
    std::thread::sleep(std::time::Duration::from_secs(3));
    assert!(!play.err().contains("To frame 3"), "{}", play.err());
    play.press_enter();
    wait_for("the third frame", || play.err().contains("To frame 3").then_some(()));
    assert_played(play);
}

#[test]
fn without_a_terminal_go_is_given_after_the_air_time() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = Child::lightbots(&["robots", "--count", "3", "--broker", &broker.url()]);
    let mut play = Child::lightbots(&arguments(&show_file(), &broker.url()));
    play.complains("GO is given after each air time");
    assert_played(play);
}

/// Writes a show of three frames, of which the first two repeat until GO. Returns its path.
fn loop_file() -> String {
    let mut show: Value = serde_json::from_str(&shows::row(3, &[0.1, 0.1, 0.1])).unwrap();
    show["lightbots"] = json!(2);
    (show["frames"][0]["id"], show["frames"][1]["id"]) = (json!("first"), json!("second"));
    show["cues"] = json!([{"name": "Encore", "frame": "second", "loop_from": "first"}]);
    shows::file("loop.lightbots.json", show.to_string())
}

#[test]
fn frames_repeat_until_enter_or_once_without_a_terminal() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = Child::lightbots(&["robots", "--count", "3", "--broker", &broker.url()]);
    let show = loop_file();
    let mut once = Child::lightbots(&arguments(&show, &broker.url()));
    once.complains("frames that repeat are played once");
    assert_played(once);
    let mut play = Child::lightbots_at_terminal(&arguments(&show, &broker.url()));
    play.complains("Frames 1 to 2 repeat until GO.");
    play.complains("press Enter for GO");
    wait_for("the third round", || (play.err().matches("To frame 1").count() >= 3).then_some(()));
    play.press_enter();
    let code = play.end();
    let report: Value = serde_json::from_str(&play.out()).unwrap_or_default();
    let played = report["frames_played"].as_u64().unwrap_or_default();
    assert!(code == 0 && played >= 7, "{report} {}", play.err());
    assert!(play.err().contains("GO: the show leaves the loop after frame 2."), "{}", play.err());
}

#[test]
fn a_pedal_gives_go_by_its_own_topic_and_can_do_nothing_else() {
    let _turn = alone();
    let users = shows::file("cue-users", "stage:secret:controller\npedal:tread:cue\n");
    let (_server, address, broker) = start(&["--robots", "3", "--mqtt-users", &users, &show_file()]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(3);
    let pedal = Mqtt::open_as(&broker, "pedal", ("pedal", "tread"), &[]);
    pedal.publish(CUE, "GO");
    screen.wait_for_log("GO by MQTT was refused");
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.wait_for_log("Frame 2 waits for GO: Curtain.");
    pedal.publish(CUE, "STOP");
    pedal.publish("T/LightBot/Broadcast", "|STOP|");
    screen.wait_for_log("a user of the role cue publishes on");
    assert_eq!(screen.phase(), "playing");
    pedal.publish(CUE, "GO");
    screen.wait_for_log("To frame 3");
}
