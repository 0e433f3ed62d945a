//! Settings of brokers in the folder `brokers`, tested as far as the brokers are installed here.

use std::path::PathBuf;
use std::process::Command;

use crate::certificates::Certificates;
use crate::child::Child;
use crate::mosquitto::Mosquitto;
use crate::plain_mqtt::Mqtt;
use crate::{alone, shows, wait_for};

fn file(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../brokers").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_compose_file_names_files_that_are_there() {
    let text = file("compose.yaml");
    let documents = yaml_rust2::YamlLoader::load_from_str(&text).unwrap();
    let services = documents[0]["services"].as_hash().unwrap();
    let names: Vec<&str> = services.keys().filter_map(yaml_rust2::Yaml::as_str).collect();
    assert_eq!(names, ["mosquitto", "emqx", "hivemq", "rabbitmq", "solace"]);
    for (name, service) in services {
        assert_eq!(service["profiles"][0].as_str(), name.as_str());
        assert!(service["image"].as_str().is_some_and(|image| !image.is_empty()));
        for volume in service["volumes"].as_vec().into_iter().flatten() {
            let from = volume.as_str().and_then(|volume| volume.split(':').next()).unwrap();
            let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../brokers").join(from);
            assert!(from == "./certs" || path.exists(), "{from} is missing");
        }
    }
}

#[test]
fn mosquitto_runs_with_its_settings_and_keeps_robots_apart() {
    let _turn = alone();
    let made = Certificates::make();
    let passwords = shows::file("passwords", "controller:c\nrobot:r\n");
    if let Ok(status) = Command::new("mosquitto_passwd").args(["-U", &passwords]).status() {
        assert!(status.success());
    }
    let acl = shows::file("acl", file("mosquitto/acl"));
    let certs = made.file("");
    let user = std::env::var("USER").unwrap_or_else(|_| "root".into());
    let settings = |[plain, tls]: [u16; 2]| {
        let text = file("mosquitto/mosquitto.conf")
            .replace("listener 1883", &format!("listener {plain}"))
            .replace("listener 8883", &format!("listener {tls} 127.0.0.1"))
            .replace("/mosquitto/certs/", &certs)
            .replace("/mosquitto/config/passwords", &passwords)
            .replace("/mosquitto/config/acl", &acl);
        format!("user {user}\n{text}")
    };
    let Some((broker, [plain, tls])) = Mosquitto::with_settings(settings) else { return };
    let url = format!("mqtts://robot:r@127.0.0.1:{tls}");
    let mut robots = Child::lightbots(&[
        "robots",
        "--count",
        "2",
        "--together",
        "1",
        "--broker",
        &url,
        "--ca",
        &made.file("ca.pem"),
    ]);
    robots.said("2 robots connected");
    let url = format!("mqtt://controller:c@127.0.0.1:{plain}");
    let mut play = Child::lightbots(&["play", &shows::row_file(2, &[0.1]), "--broker", &url, "--json"]);
    assert_eq!(play.end(), 0, "{}", play.err());

    // A robot that subscribes to everything receives only its own messages.
    let address = format!("127.0.0.1:{plain}");
    let mut nosy = Mqtt::open_as(&address, "LightBot/r7", ("robot", "r"), &["#", "T/LightBot/r7"]);
    let controller = Mqtt::open_as(&address, "BotControl/a", ("controller", "c"), &[]);
    controller.publish("T/LightBot/r8", "|STOP|");
    controller.publish("T/LightBot/r7", "|BLINK 3|");
    assert_eq!(wait_for("its own message", || nosy.next()).0, "T/LightBot/r7");
    drop(broker);
}
