//! Rights of a robot at the embedded broker: it sends only as itself, and receives only its own messages.

use serde_json::json;

use crate::child::Child;
use crate::plain_mqtt::Mqtt;
use crate::raw_mqtt::{RawMqtt, connect, packet, publish, text};
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// Waits for the next message of another client. Returns its topic and payload.
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

    // This robot reports first under another name and then under its own. Only the second report is delivered.
    let posing = Mqtt::open(&broker, "LightBot/r9", &[]);
    posing.publish("T/LightBot/UUID", "r8 0.1 0.2");
    posing.publish("T/LightBot/UUID", "r9 0.3 0.4");
    let line = screen.wait_for_log("T/LightBot/UUID");
    assert!(line.contains("LightBot/r9") && line.contains("'r8'"), "{line}");
    screen.until("the robot that says who it is", |screen| (screen.places() == [(0.3, 0.4)]).then_some(()));
    assert_eq!(screen.get("fleet")["rows"].as_array().unwrap().len(), 1);

    // Messages for others do not reach the robot, and its own do.
    let controller = Mqtt::open(&broker, "BotControl/a", &[]);
    controller.publish("T/LightBot/r8", "|STOP|");
    controller.publish("T/LightBot/UUID", "r7 1.0 1.0");
    controller.publish("T/LightBot/r7", "|BLINK 3|");
    assert_eq!(next(&mut robot), ("T/LightBot/r7".into(), "|BLINK 3|".into()));
    // A robot may not send to other robots either.
    Mqtt::open(&broker, "LightBot/r5", &[]).publish("T/LightBot/r9", "|STOP|");
    screen.wait_for_log("a message on T/LightBot/r9");
}

#[test]
fn users_have_passwords_and_roles() {
    let _turn = alone();
    let file = shows::file("users", "stage:secret:controller\nr7:seven:robot\ndefault:default:any-robot\n");
    let (mut server, address, broker) = start(&["--robots", "2", "--mqtt-users", &file]);
    let mut screen = Screen::open(&address);
    // The robots and the controller of the program itself need no login.
    screen.wait_for_robots(2);
    let robots = |login: &str, together: &str, variables: &[(&str, &str)]| {
        let url = format!("mqtt://{login}{broker}");
        let all = ["robots", "--count", "2", "--log", "info", "--together", together, "--broker", &url];
        Child::lightbots_with(&all, variables)
    };
    robots("default:wrong@", "1", &[]).complains("refuses this user and password");
    screen.wait_for_log("user or password is wrong");
    robots("", "1", &[]).complains("refuses this user and password");
    // The role `any-robot` excludes several robots on one connection. The user r7 may only be the robot r7.
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
    // A robot receives broadcasts. A robot's own user may only use that robot's name.
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

#[test]
fn a_forged_stop_is_dropped_and_its_sender_named() {
    let _turn = alone();
    let (_server, address, broker) = start(&["--robots", "0"]);
    let mut screen = Screen::open(&address);
    let mut robot = Mqtt::open(&broker, "LightBot/r7", &["T/LightBot/r7", "T/LightBot/Broadcast"]);
    let forger = Mqtt::open(&broker, "mosq-1", &[]);
    forger.publish("T/LightBot/Broadcast", "|STOP|");
    forger.publish("T/LightBot/r7", "|STOP|");
    let line = screen.wait_for_log("only controllers send commands");
    assert!(line.contains("mosq-1"), "{line}");
    Mqtt::open(&broker, "BotControl/a", &[]).publish("T/LightBot/r7", "|BLINK 3|");
    let (topic, payload) = wait_for("a command", || {
        std::iter::from_fn(|| robot.next()).find(|(topic, _)| topic == "T/LightBot/r7")
    });
    assert_eq!((topic.as_str(), payload.as_str()), ("T/LightBot/r7", "|BLINK 3|"));
}

#[test]
fn two_robots_of_one_name_are_named_and_the_show_plays_on() {
    let _turn = alone();
    let (_server, address, broker) = start(&["--robots", "4", &shows::row_file(4, &[0.2, 0.2])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    // Each connection takes the session from the one before, and reports where it stands.
    let mut connections = Vec::new();
    for x in ["1.4", "-1.4"].iter().cycle().take(8) {
        let mut robot = RawMqtt::silent(&broker);
        robot.send(&connect("LightBot/twin"));
        assert_eq!(robot.read(4), [0x20, 2, 0, 0]);
        robot.send(&publish("T/LightBot/UUID", format!("twin {x} -1.4").as_bytes()));
        assert!(robot.is_answered());
        connections.push(robot);
    }
    for part in
        ["Two robots are called twin: they take the connection", "Two robots are called twin: it reports"]
    {
        screen.wait_for_log(part);
    }
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
}

#[test]
fn a_session_belongs_to_the_user_that_began_it() {
    let users = shows::file("users", "one:first:fleet\ntwo:second:fleet\n");
    let mut process = Child::lightbots(&["broker", "--mqtt-listen", "127.0.0.1:0", "--mqtt-users", &users]);
    let broker = process.said("Broker mqtt://");
    // Connects and continues the session. Returns the client with the session flag and the code of CONNACK.
    let open = |user: &str, password: &str| {
        let mut client = RawMqtt::silent(&broker);
        let login =
            [&text("MQTT")[..], &[4, 0xc0, 0, 0], &text("tool"), &text(user), &text(password)].concat();
        client.send(&packet(0x10, &login));
        let answer = client.read(4);
        (client, [answer[2], answer[3]])
    };
    let (mut first, answer) = open("one", "first");
    assert_eq!(answer, [0, 0]);
    assert!(first.subscribe("secrets"));
    assert_eq!(open("two", "second").1, [0, 5], "a connected client id is not taken over");
    process.complains("belongs to another user");
    assert!(first.is_answered());
    let (second, answer) = open("one", "first");
    assert_eq!(answer, [1, 0], "the same login takes over");
    first.wait_for_close();
    drop(second);
    assert_eq!(open("two", "second").1, [0, 5], "nor is the session of a client that is away");
    assert_eq!(open("one", "first").1, [1, 0]);
}
