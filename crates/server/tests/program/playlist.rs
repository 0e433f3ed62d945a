//! A day that a playlist controls, and operations over HTTP.

use serde_json::{Value, json};

use crate::child::Child;
use crate::http::{self, Answer};
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

fn ask(address: &str, method: &str, path: &str, body: &Value) -> Answer {
    http::request(address, method, path, &[("Content-Type", "application/json")], &body.to_string())
}

fn state(address: &str) -> Value {
    let answer = ask(address, "GET", "/api/playlist", &json!(null));
    assert_eq!(answer.status, 200, "{}", answer.body);
    answer.json()
}

/// Replaces the playlist. Returns the answer of the server.
fn change(address: &str, on: bool, entries: &Value) -> Answer {
    let revision = &state(address)["revision"];
    ask(address, "PUT", "/api/playlist", &json!({"revision": revision, "on": on, "entries": entries}))
}

/// The results of today's entries, in order.
fn results(state: &Value) -> Vec<String> {
    let today = state["today"].as_array().unwrap();
    today.iter().map(|one| one["result"].as_str().unwrap().to_owned()).collect()
}

fn save(address: &str, name: &str, pixels: usize, air_s: f64) {
    let path = format!("/api/shows/{name}");
    let saved = http::request(address, "PUT", &path, &[], &shows::row(pixels, &[air_s, 0.1]));
    assert_eq!(saved.status, 200, "{}", saved.body);
}

/// An entry whose time is the present minute. If the next minute begins meanwhile, it is still not too late.
fn now(address: &str, show: &str) -> Value {
    json!({"show": show, "at": state(address)["now"], "speed_percent": 100})
}

fn then(show: &str) -> Value {
    json!({"show": show, "pause_min": 0, "speed_percent": 60})
}

fn wait_for_results(address: &str, wanted: &[&str]) -> Value {
    wait_for(&format!("{wanted:?}, now {:?}", results(&state(address))), || {
        Some(state(address)).filter(|state| results(state) == wanted)
    })
}

#[test]
fn two_shows_are_played_with_one_between_that_fails() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "3"]);
    save(&address, "one", 3, 0.1);
    save(&address, "two", 3, 0.1);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(3);
    let entries = json!([now(&address, "one"), then("missing"), then("two")]);
    let changed = change(&address, true, &entries);
    assert_eq!(changed.status, 200, "{}", changed.body);
    assert_eq!(changed.json()["next"]["in_s"], 0, "{}", changed.body);
    let over = wait_for_results(&address, &["played", "failed", "played"]);
    let line = over["today"][1]["line"].as_str().unwrap();
    assert!(
        line.contains("missing") && line.ends_with("choose another show for the entry, or mend this one."),
        "{line}"
    );
    screen.wait_for_log("Playlist: one was played.");
    screen.wait_for_log("Playlist: missing failed.");
    screen.wait_for_log("Playlist: two was played.");
    let incidents = screen.get("incidents").to_string();
    assert!(incidents.contains("missing failed by schedule."), "{incidents}");
    let runs = ask(&address, "GET", "/api/runs", &json!(null)).json();
    assert_eq!(runs.as_array().unwrap().len(), 2, "{runs}");
    // The operator's speed is set again.
    screen.until("the usual speed", |screen| {
        (screen.get("state")["playback"]["speed_percent"] == 100).then_some(())
    });
}

#[test]
fn a_stop_holds_the_playlist_until_go_on_and_a_restart_plays_nothing_twice() {
    let _turn = alone();
    let data = shows::own_folder();
    let data = data.to_str().unwrap();
    let (server, address, _) = start(&["--robots", "3", "--data", data]);
    save(&address, "long", 3, 60.0);
    save(&address, "next", 3, 60.0);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(3);
    let entries = json!([now(&address, "long"), then("next")]);
    assert_eq!(change(&address, true, &entries).status, 200);
    screen.until("the show by schedule", |screen| (screen.phase() == "playing").then_some(()));
    assert_eq!(ask(&address, "POST", "/api/operate", &json!({"do": "stop_all"})).status, 204);
    let held = wait_for_results(&address, &["failed", "waiting"]);
    let why = held["held"].as_str().unwrap();
    assert!(why.contains("Stop all was pressed") && why.contains("Go on"), "{why}");
    // This is longer than the next entry would take to begin.
    std::thread::sleep(std::time::Duration::from_secs(4));
    assert_eq!(results(&state(&address)), ["failed", "waiting"]);

    let end = |mut server: Child| {
        server.terminate();
        assert_eq!(server.end(), 0);
    };
    end(server);
    let (server, address, _) = start(&["--robots", "3", "--data", data]);
    let again = state(&address);
    assert_eq!(
        (&again["on"], &again["held"], results(&again)),
        (&json!(true), &json!(why), vec!["failed".to_owned(), "waiting".to_owned()])
    );
    assert_eq!(ask(&address, "POST", "/api/operate", &json!({"do": "go_on"})).status, 204);
    wait_for_results(&address, &["failed", "playing"]);
    // The end of the program does not count as a stop by the operator.
    end(server);
    let (_server, address, _) = start(&["--robots", "3", "--data", data]);
    let last = wait_for_results(&address, &["failed", "failed"]);
    assert!(
        last["held"].is_null() && last["today"][1]["line"].as_str().unwrap().contains("LightBots was ended"),
        "{last}"
    );
}

#[test]
fn a_playlist_that_is_wrong_is_refused_with_place_and_remedy() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0"]);
    let good = json!({"show": "heart", "at": "03:00", "speed_percent": 100});
    let mut typo = good.clone();
    typo["spede"] = json!(1);
    let wrong = change(
        &address,
        false,
        &json!([good, then("heart"), {"show": "heart", "at": "3", "speed_percent": 100}]),
    );
    assert_eq!(wrong.status, 422);
    assert!(wrong.body.contains("entry 3: at is"), "{}", wrong.body);
    let unknown = change(&address, false, &json!([typo]));
    assert!(unknown.status == 422 && unknown.body.contains("unknown field `spede`"), "{}", unknown.body);
    let many = change(
        &address,
        false,
        &json!(vec![json!({"show": "x".repeat(2_000), "at": "03:00", "speed_percent": 100}); 96]),
    );
    assert_eq!(many.status, 413, "{}", many.body);
    let stale = json!({"revision": 1, "on": true, "entries": []});
    assert_eq!(ask(&address, "PUT", "/api/playlist", &stale).status, 412);
    assert_eq!(state(&address)["entries"], json!([]));
}

#[test]
fn a_program_gives_go_over_http() {
    let _turn = alone();
    let mut show: Value = serde_json::from_str(&shows::row(3, &[0.1, 0.1])).unwrap();
    show["lightbots"] = json!(2);
    show["frames"][0]["id"] = json!("first");
    show["cues"] = json!([{"name": "Curtain", "frame": "first"}]);
    let file = shows::file("cue.lightbots.json", show.to_string());
    let (_server, address, _) = start(&["--robots", "3", &file]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(3);
    let operate = |operation: Value| ask(&address, "POST", "/api/operate", &operation);
    let early = operate(json!({"do": "go"}));
    assert_eq!((early.status, &early.json()["error"]), (409, &json!("Nothing is being played.")));
    assert_eq!(operate(json!({"do": "play", "from": 0, "missing": "refuse"})).status, 204);
    screen.wait_for_log("Frame 1 waits for GO: Curtain.");
    assert_eq!(operate(json!({"do": "go"})).status, 204);
    screen.wait_for_log("Run finished");
    assert_eq!(operate(json!({"do": "dance"})).status, 422);
    let long = json!({"do": "open", "name": "x".repeat(140_000)});
    assert_eq!(operate(long).status, 413);
}
