//! What the embedded broker lets a robot do: speak for itself, and hear what is for it.

use serde_json::json;

use crate::child::Child;
use crate::plain_mqtt::Mqtt;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// The next message but those of others; waits for it.
fn next(mqtt: &mut Mqtt) -> (String, String) {
    wait_for("a message", || mqtt.next())
}

#[test]
fn a_robot_that_poses_as_another_or_listens_to_all_is_refused_and_named() {
    let _turn = alone();
    let (mut server, address, broker) = start(&["--robots", "0"]);
    let mut screen = Screen::open(&address);
    let mut robot = Mqtt::open(&broker, "LightBot/r7", &["T/LightBot/r7", "#", "T/LightBot/+"]);
    let line = screen.wait_for_log("the subscription to #");
    assert!(line.contains("LightBot/r7") && line.contains("user default"), "{line}");
    server.complains("the subscription to #");

    // It says it is another, then who it is: only that is heard.
    let posing = Mqtt::open(&broker, "LightBot/r9", &[]);
    posing.publish("T/LightBot/UUID", "r8 0.1 0.2");
    posing.publish("T/LightBot/UUID", "r9 0.3 0.4");
    let line = screen.wait_for_log("T/LightBot/UUID");
    assert!(line.contains("LightBot/r9") && line.contains("'r8'"), "{line}");
    screen.until("the robot that says who it is", |screen| (screen.places() == [(0.3, 0.4)]).then_some(()));
    assert_eq!(screen.get("fleet")["rows"].as_array().unwrap().len(), 1);

    // What is for others does not reach it, what is for it does.
    let controller = Mqtt::open(&broker, "BotControl/a", &[]);
    controller.publish("T/LightBot/r8", "|STOP|");
    controller.publish("T/LightBot/UUID", "r7 1.0 1.0");
    controller.publish("T/LightBot/r7", "|BLINK 3|");
    assert_eq!(next(&mut robot), ("T/LightBot/r7".into(), "|BLINK 3|".into()));
    // Nor does a robot speak to others.
    Mqtt::open(&broker, "LightBot/r5", &[]).publish("T/LightBot/r9", "|STOP|");
    screen.wait_for_log("a message on T/LightBot/r9");
}

#[test]
fn users_have_passwords_and_roles() {
    let _turn = alone();
    let file = shows::file("users", "stage:secret:controller\nr7:seven:robot\ndefault:default:any-robot\n");
    let (mut server, address, broker) = start(&["--robots", "2", "--mqtt-users", &file]);
    let mut screen = Screen::open(&address);
    // Its own robots and controller get in by themselves.
    screen.wait_for_robots(2);
    let robots = |login: &str, together: &str, variables: &[(&str, &str)]| {
        let url = format!("mqtt://{login}{broker}");
        let all = ["robots", "--count", "2", "--log", "info", "--together", together, "--broker", &url];
        Child::lightbots_with(&all, variables)
    };
    robots("default:wrong@", "1", &[]).complains("refuses this user and password");
    screen.wait_for_log("user or password is wrong");
    robots("", "1", &[]).complains("refuses this user and password");
    // Many on one connection are no robot, and none of them is r7.
    robots("default:default@", "2", &[]).complains("refuses this user and password");
    robots("r7:seven@", "1", &[]).complains("refuses this user and password");
    screen.wait_for_log("user r7 is that robot only");
    let mut others = robots(
        "default@",
        "1",
        &[("LIGHTBOTS_BROKER_USER", "nobody"), ("LIGHTBOTS_BROKER_PASSWORD", "default")],
    );
    others.said("2 robots connected");
    let password = shows::file("password", "secret\n");
    let url = format!("mqtt://{broker}");
    let login = ["--broker-user", "stage", "--broker-password-file", &password];
    let mut crowd = Child::lightbots(&[&["robots", "--count", "3", "--broker", &url][..], &login].concat());
    crowd.said("3 robots connected");
    screen.until("everybody", |screen| (screen.places().len() == 7).then_some(()));
    // A robot hears broadcasts, and its own user is only itself.
    let mut seven = Mqtt::open_as(&broker, "LightBot/r7", ("r7", "seven"), &["T/LightBot/Broadcast"]);
    screen.must(json!({"do": "refresh"}));
    assert_eq!(next(&mut seven).1, "|UUID|");
    server.complains("user or password is wrong");
    assert!(!server.err().contains("secret") && !server.err().contains("seven"), "{}", server.err());
}

#[test]
fn a_last_will_is_a_message_like_any_other() {
    let _turn = alone();
    let (mut server, _, broker) = start(&["--robots", "0"]);
    let (host, port) = broker.rsplit_once(':').unwrap();
    let mut options = rumqttc::MqttOptions::new("LightBot/r7", (host, port.parse::<u16>().unwrap()));
    let will = rumqttc::LastWill::new("T/LightBot/Broadcast", "|STOP|", rumqttc::QoS::AtMostOnce, false);
    options.set_last_will(will);
    let (_client, mut connection) = rumqttc::Client::builder(options).capacity(10).build();
    let first = connection.iter().next().unwrap();
    assert!(matches!(first, Err(rumqttc::ConnectionError::ConnectionRefused(_))), "{first:?}");
    server.complains("its last will on T/LightBot/Broadcast");
}
