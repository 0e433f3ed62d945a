//! `robot-check` on real brokers: our robot on the embedded broker, and the robot of docs/build-a-robot.md on
//! Mosquitto.

use std::collections::BTreeMap;
use std::process::Command;

use serde_json::Value;

use crate::child::Child;
use crate::mosquitto::Mosquitto;
use crate::{run, shows};

/// Starts an examination without asking for permission to drive.
fn check(broker: &str, more: &[&str]) -> Child {
    Child::lightbots(&[&["robot-check", "--broker", broker, "--json", "--yes"], more].concat())
}

/// Waits for the end of an examination. Returns the exit code, and the rules by their verdict.
fn verdicts(examination: &mut Child) -> (i32, BTreeMap<String, Vec<String>>) {
    let code = examination.end();
    let answer: Value = serde_json::from_str(&examination.out()).expect("one JSON object");
    let mut rules = BTreeMap::<String, Vec<String>>::new();
    for rule in answer["rules"].as_array().expect("a list") {
        let verdict = rule["verdict"].as_str().expect("a word").to_owned();
        if verdict == "breaks" {
            eprintln!("{rule:#}");
        }
        rules.entry(verdict).or_default().push(rule["rule"].as_str().expect("a word").to_owned());
    }
    (code, rules)
}

/// Starts the Python robot of the document. `None` if Python or paho is missing.
fn python_robot(port: &str) -> Option<Child> {
    let page = include_str!("../../../../docs/build-a-robot.md");
    let (_, after) = page.split_once("```python\n").expect("the page has a robot");
    let (code, _) = after.split_once("```").expect("it ends");
    let file = shows::folder().join("robot.py");
    std::fs::write(&file, code).expect("the folder of the tests can be written");
    let has_paho = Command::new("python3")
        .args(["-c", "import paho.mqtt.client as m; m.CallbackAPIVersion.VERSION2"])
        .output();
    if !has_paho.is_ok_and(|output| output.status.success()) {
        eprintln!("NOT TESTED: the robot of docs/build-a-robot.md: python3 with paho-mqtt 2 is missing");
        return None;
    }
    let mut command = Command::new("python3");
    command.arg(file).args(["127.0.0.1", port]);
    Some(Child::start(command, "the robot of docs/build-a-robot.md"))
}

#[test]
fn our_robot_and_the_documents_robot_keep_the_protocol() {
    let (_server, _, embedded) = run::start(&["--robots", "0"]);
    // `run` is a controller too and answers time requests, so this robot is examined on its own broker.
    let Some(mosquitto) = Mosquitto::start() else { return };
    let other = Mosquitto::start().expect("there is one");
    let url = mosquitto.url();
    let port = url.rsplit(':').next().expect("a port");
    let python = python_robot(port);
    let mut ours =
        Child::lightbots(&["robots", "--count", "1", "--start", "0.2,-0.5", "--broker", &other.url()]);
    ours.said("connected to ");
    let mut examined = check(&other.url(), &[]);
    let mut python_examined = python.as_ref().map(|_| check(&url, &[]));

    no_robot_and_several(&embedded);
    let (code, rules) = verdicts(&mut examined);
    assert_eq!((code, rules.get("breaks")), (0, None), "{rules:?}");
    assert_eq!(rules["keeps"].len(), 39, "{rules:?}");
    assert_eq!(rules["not-tried"], ["R21", "R22", "R23", "R24", "R56", "R57", "R58", "R60", "R61", "R62"]);
    if let Some(examined) = python_examined.as_mut() {
        let (code, rules) = verdicts(examined);
        assert_eq!((code, rules.get("breaks")), (0, None), "{rules:?}");
        let keeps = [
            "R3", "R4", "R5", "R6", "R7", "R8", "R9", "R13", "R15", "R16", "R17", "R18", "R19", "R20", "R48",
        ];
        assert_eq!(rules["keeps"], keeps);
        assert!(rules["does-not-know"].contains(&"R31".to_owned()), "{rules:?}");
    }
}

/// Checks that a missing robot is reported as a problem, and several robots without a chosen name as wrong use.
fn no_robot_and_several(broker: &str) {
    let mut absent = check(broker, &["--robot", "no-robot-of-this-name"]);
    assert_eq!(absent.end(), 1);
    let answer: Value = serde_json::from_str(&absent.out()).expect("one JSON object");
    assert_eq!(answer["ok"], false);
    let mut robots = Child::lightbots(&["robots", "--count", "2", "--broker", broker]);
    robots.said("connected to ");
    let mut several = check(broker, &[]);
    assert_eq!(several.end(), 2);
    assert!(several.err().contains("--robot ID"), "{}", several.err());
}

#[test]
fn places_of_simulated_robots_are_understood_or_refused() {
    for (start, why) in [
        (vec!["0,0 0.1,nowhere"], "neither 'rows', a show nor a place"),
        (vec!["0,0"], "--start has 1 place for 2 robots"),
        (vec!["no-such-show.json"], "no-such-show.json"),
    ] {
        let arguments =
            [vec!["robots", "--count", "2", "--broker", "mqtt://127.0.0.1:1", "--start"], start].concat();
        let mut child = Child::lightbots(&arguments);
        assert_eq!(child.end(), 2);
        assert!(child.err().contains(why), "{}", child.err());
    }
}
