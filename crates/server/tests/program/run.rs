//! The command `run`, observed through its screens.

use serde_json::json;

use crate::child::{self, Child};
use crate::original_robot::OriginalRobot;
use crate::screen::Screen;
use crate::{alone, http, shows};

/// Starts `run` on free ports. Returns the process, the screen's address and the broker's address.
pub fn start(arguments: &[&str]) -> (Child, String, String) {
    let data = shows::own_folder();
    let data = data.to_str().unwrap();
    let mut all = vec!["run", "--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0"];
    if !arguments.contains(&"--data") {
        all.extend(["--data", data]);
    }
    all.extend(arguments);
    let mut child = Child::lightbots(&all);
    let (screen, broker) = (child.said("http://"), child.said("Broker mqtt://"));
    (child, screen, broker)
}

#[test]
fn a_show_plays_to_its_end_on_two_screens() {
    let _turn = alone();
    let (mut server, address, _) = start(&["--robots", "4", &shows::row_file(4, &[0.2, 0.1])]);
    let (mut one, mut two) = (Screen::open(&address), Screen::open(&address));
    one.wait_for_robots(4);
    assert_eq!(one.get("hello")["simulated"], 4);
    assert_eq!(one.get("show")["document"]["name"], "Rows");
    one.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    two.until("playing on the other screen", |screen| (screen.phase() == "playing").then_some(()));
    let last = one.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
    two.wait_for_log("Run finished");
    two.wait_for_robots(4);
    one.wait_for_robots(4);
    assert_eq!(one.get("fleet")["rows"].as_array().unwrap().len(), 4);
    assert_eq!(names(&one), names(&two));
    for (index, (x, y)) in sorted(one.places()).into_iter().enumerate() {
        let goal = 0.1 * (index as f64 - 1.5);
        assert!((x - goal).abs() < 0.025 && (y - 1.1).abs() < 0.025, "robot {index} is at {x} {y}");
    }
    server.terminate();
    assert_eq!(server.end(), 0);
}

/// The robots' names, in the order in which they were found.
fn names(screen: &Screen) -> Vec<String> {
    let fleet = screen.get("fleet");
    fleet["rows"].as_array().unwrap().iter().map(|row| row["id"].to_string()).collect()
}

#[test]
fn pins_of_a_show_fit_when_the_program_is_started_again() {
    let _turn = alone();
    let show = shows::row_file(3, &[0.1]);
    let of_a_start = |more: &[&str]| {
        let (_server, address, _) = start(&[&["--robots", "3", &show], more].concat());
        let mut screen = Screen::open(&address);
        screen.wait_for_robots(3);
        let mut names = names(&screen);
        names.sort();
        names
    };
    let first = of_a_start(&[]);
    assert_eq!(first, of_a_start(&[]));
    assert_ne!(first, of_a_start(&["--seed", "2"]));
}

fn sorted(mut places: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    places
}

#[test]
fn abort_stops_all_robots_and_the_next_run_begins_from_there() {
    let _turn = alone();
    // From the back row to the front edge, so that no robot has arrived before the abort.
    let far = shows::row(4, &[0.1]).replace("1.200", "-1.300");
    let (_server, address, _) = start(&["--robots", "4", &shows::file("far.lightbots.json", far)]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.until("robots on their way", |screen| {
        let places = screen.places();
        (screen.phase() == "playing" && places.iter().any(|(_, y)| *y < 1.2)).then_some(())
    });
    screen.must(json!({"do": "abort"}));
    screen.wait_for_robots(4);
    screen.until("robots that stand", |screen| {
        let states = screen.get("robots")["status"].as_array().cloned().unwrap_or_default();
        (states.len() == 4 && states.iter().all(|state| *state == 0)).then_some(())
    });
    assert!(screen.places().iter().all(|(_, y)| *y > -1.2), "{:?}", screen.places());
    screen.must(json!({"do": "preview", "frame": 0}));
    screen.until("the preview's end", |screen| screen.places().iter().all(|(_, y)| *y < -1.27).then_some(()));
}

#[test]
fn an_original_robot_takes_part() {
    let _turn = alone();
    let (_server, address, broker) = start(&["--robots", "3", &shows::row_file(4, &[0.1, 0.1])]);
    let robot = OriginalRobot::start(&broker, "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8", (0.35, 1.3));
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    let last = screen.wait_for_log("Run finished");
    assert!(last.contains("2 frames") && last.contains("0 dropouts"), "{last}");
    let diary = robot.end();
    assert!(diary.targets >= 2 && diary.arrivals >= 2, "{diary:?}");
    assert_eq!(diary.colours.last(), Some(&0xff8000), "{diary:?}");
}

#[test]
fn a_larger_show_gets_a_larger_cast_on_its_own_floor() {
    let _turn = alone();
    let (_server, address, _) = start(&[&shows::row_file(2, &[0.1])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(30);
    let before = names(&screen);
    let wide = shows::row(32, &[0.1]).replacen("\"name\"", r#""stage":{"width_m":4,"depth_m":4},"name""#, 1);
    assert_eq!(http::request(&address, "PUT", "/api/shows/Wide", &[], &wide).status, 200);
    screen.must(json!({"do": "open", "name": "Wide"}));
    screen.until("the back row of the larger floor", |screen| {
        let places = screen.places();
        (places.len() == 32 && places.iter().all(|(_, y)| *y > 1.6)).then_some(())
    });
    let after = names(&screen);
    assert!(before.iter().all(|name| after.contains(name)), "who had a name and pins has them still");
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.wait_for_log("Run finished");
}

#[test]
fn too_few_robots_are_a_message_and_a_choice() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "2", &shows::row_file(3, &[0.1])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(2);
    let answer = screen.operate(json!({"do": "play", "from": 0, "missing": "refuse"}));
    assert_eq!(answer["ok"], false);
    assert!(answer["error"].as_str().unwrap().contains('3'), "{answer}");
    screen.must(answer["choice"]["operation"].clone());
    screen.wait_for_log("Run finished");
}

#[test]
fn the_library_keeps_shows_and_no_client_overwrites_another() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0"]);
    let mut screen = Screen::open(&address);
    let show = shows::row(2, &[1.0]);
    let put = |headers: &[(&str, &str)], body: &str| {
        http::request(&address, "PUT", "/api/shows/My%20rows", headers, body)
    };
    let first = put(&[("If-None-Match", "*")], &show);
    assert_eq!(first.status, 200, "{}", first.body);
    assert_eq!(put(&[("If-None-Match", "*")], &show).status, 412);
    screen.must(json!({"do": "open", "name": "My rows"}));
    screen.until("the show", |screen| (screen.get("show")["name"] == "My rows").then_some(()));
    let etag = first.header("ETag");
    let second = put(&[("If-Match", &etag)], &show.replace("Rows", "Columns"));
    assert_eq!(second.status, 200, "{}", second.body);
    screen.until("the change", |screen| (screen.get("show")["document"]["name"] == "Columns").then_some(()));
    screen.until("its plan", |screen| (screen.get("plan")["ok"] == true).then_some(()));
    let late = put(&[("If-Match", &etag)], &show);
    assert_eq!(late.status, 412);
    assert!(late.json()["error"].as_str().unwrap().contains("somebody else"));
    let got = http::request(&address, "GET", "/api/shows/My%20rows", &[], "");
    assert_eq!((got.header("ETag"), got.json()["name"].as_str()), (second.header("ETag"), Some("Columns")));
    let plan = http::request(&address, "GET", "/api/plan", &[], "").json();
    assert_eq!(plan["transitions"][0]["paths"].as_array().unwrap().len(), 2);
    assert_eq!(http::request(&address, "DELETE", "/api/shows/My%20rows", &[], "").status, 204);
    assert_eq!(http::request(&address, "GET", "/api/shows/My%20rows", &[], "").status, 404);
}

#[test]
fn junk_from_the_web_is_turned_away() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0"]);
    for (method, path, body, status) in [
        ("PUT", "/api/shows/a", "{", 422),
        ("PUT", "/api/shows/..%2Fa", "[]", 400),
        ("GET", "/api/shows/..%2f..%2fetc%2fpasswd", "", 400),
        ("GET", "/api/nothing", "", 404),
        ("POST", "/api/convert?to=pdf", "[]", 400),
        ("POST", "/api/convert?to=original", "x", 422),
        ("POST", "/api/convert?to=skyc", r#"{"lightbots":1,"frames":[]}"#, 422),
        ("GET", "/api/shows/a/states/x", "", 400),
        ("DELETE", "/api/plan", "", 405),
        ("POST", "/api/operate", "{", 400),
        ("POST", "/api/operate", r#"{"do":"dance"}"#, 422),
    ] {
        let json = [("Content-Type", "application/json")];
        let answer = http::request(&address, method, path, &json, body);
        assert_eq!(answer.status, status, "{method} {path}: {}", answer.body);
        assert!(!answer.json()["error"].as_str().unwrap().contains('\n'));
    }
    let untyped = http::request(&address, "POST", "/api/operate", &[], "{}");
    assert!(untyped.status == 415 && untyped.json()["error"].as_str().unwrap().contains("Content-Type"));
    let long = http::request(&address, "POST", "/api/check", &[("Content-Length", "100000000")], "");
    assert_eq!(long.status, 413);
    let checked = http::request(&address, "POST", "/api/check", &[], "not a show").json();
    assert_eq!(
        (checked["ok"].as_bool(), checked["issues"][0]["severity"].as_str()),
        (Some(false), Some("error"))
    );
    let mut screen = Screen::open(&address);
    screen.send_text("{\"type\":\"operate\"}");
    assert!(screen.is_hung_up());
    assert_eq!(http::request(&address, "GET", "/", &[], "").status, 200);
}

#[test]
fn a_taken_port_is_one_line_with_what_to_do() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let taken = taken.local_addr().unwrap().to_string();
    let data = shows::folder().join("nothing");
    for (arguments, remedy) in [
        (["--listen", taken.as_str(), "--mqtt-listen", "127.0.0.1:0"], "--listen"),
        (["--listen", "127.0.0.1:0", "--mqtt-listen", taken.as_str()], "--mqtt-listen"),
    ] {
        let mut all = vec!["run", "--robots", "0", "--data", data.to_str().unwrap()];
        all.extend(arguments);
        let (code, out, err) = child::run(&all);
        assert_eq!((code, out.as_str()), (1, ""));
        assert!(err.contains("is taken") && err.contains(remedy) && err.lines().count() == 1, "{err}");
    }
}

#[test]
fn a_library_that_cannot_be_kept_ends_the_start_with_its_folder() {
    let file = shows::row_file(2, &[0.1]);
    let below = format!("{file}/library");
    let (code, out, err) =
        child::run(&["run", "--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0", "--data", &below]);
    assert_eq!((code, out.as_str(), err.lines().count()), (1, "", 1), "{err}");
    assert!(err.contains(&below) && err.contains("--data"), "{err}");
}

#[test]
fn everything_stops_cleanly_when_told_to() {
    let _turn = alone();
    let (mut server, _, broker) = start(&["--robots", "2"]);
    server.terminate();
    assert_eq!(server.end(), 0);
    // The broker is gone: robots still try to connect, and stop cleanly.
    let mut robots = Child::lightbots(&["robots", "--count", "2", "--broker", &broker]);
    crate::wait_for("a first attempt", || robots.err().contains("connecting").then_some(()));
    robots.terminate();
    assert_eq!(robots.end(), 0);
}

/// Starts `run` through another program, which `run` replaces. Returns the process and the addresses of screen and
/// broker.
#[cfg(target_os = "linux")]
pub fn start_by(starter: &[&str], arguments: &[&str]) -> (Child, String, String) {
    let data = shows::own_folder();
    let mut command = std::process::Command::new(starter[0]);
    command.args(&starter[1..]).arg(env!("CARGO_BIN_EXE_lightbots")).arg("run").args(arguments);
    command.args(["--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0", "--data"]).arg(data);
    let mut child = Child::start(command, starter[0]);
    let (screen, broker) = (child.said("http://"), child.said("Broker mqtt://"));
    (child, screen, broker)
}

#[cfg(target_os = "linux")]
#[test]
fn a_closed_terminal_stops_the_robots_as_ctrl_c_does() {
    let _turn = alone();
    let show = shows::row_file(2, &[60.0]);
    // The tests themselves may run under nohup, which ignores SIGHUP.
    let (mut server, address, broker) = start_by(&["env", "--default-signal=HUP"], &["--robots", "2", &show]);
    let mut robots = crate::plain_mqtt::Mqtt::open(&broker, "listener", &["T/LightBot/Broadcast"]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(2);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    screen.until("the show", |screen| (screen.phase() == "playing").then_some(()));
    server.signal("-HUP");
    // STOP is repeated, because the first copy may be lost and the broker ends with the program.
    let mut copies = 0;
    crate::wait_for("copies of STOP", || {
        copies +=
            std::iter::from_fn(|| robots.next()).filter(|(_, payload)| payload.contains("STOP")).count();
        (copies >= 3).then_some(())
    });
    assert_eq!(server.end(), 0);
    assert!(server.err().contains("Stopping the robots"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_program_that_outlives_its_terminal_does_so() {
    let (mut server, address, _) = start_by(&["nohup"], &["--robots", "0"]);
    server.signal("-HUP");
    assert_eq!(http::request(&address, "GET", "/api/shows", &[], "").status, 200);
    server.terminate();
    assert_eq!(server.end(), 0);
}
