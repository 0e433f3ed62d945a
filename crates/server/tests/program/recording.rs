//! Recorded rehearsals and runs, and `replay`.

use serde_json::{Value, json};

use crate::child::{Child, run};
use crate::http;
use crate::mosquitto::Mosquitto;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows, wait_for};

/// Runs `replay --json`. Returns its exit code and its output.
fn replay(arguments: &[&str]) -> (i32, Value) {
    let (code, out, err) = run(&[&["replay", "--json"], arguments].concat());
    assert_eq!(err, "");
    (code, serde_json::from_str(&out).unwrap())
}

fn recorded_file(name: &str) -> String {
    shows::folder().join(name).to_str().unwrap().to_owned()
}

#[test]
fn a_recorded_rehearsal_is_replayed_to_the_bit() {
    let file = recorded_file("rehearsal.lblog");
    let faults = ["--faults", "loss=5%,kill=2@1s", "--seed", "4"];
    let show = shows::row_file(6, &[0.5, 0.5]);
    let reading = ["--floor", "4x3.5", "--identity", "fixed"];
    run(&[&["rehearse", &show, "--record", &file], &faults[..], &reading[..]].concat());
    let (code, report) = replay(&[&file]);
    assert_eq!((code, &report["ok"], &report["complete"]), (0, &json!(true), &json!(true)), "{report}");
    assert_eq!(report["difference"], Value::Null);
    let notes = json!({
        "command": "rehearse", "show": show, "seed": "4", "faults": faults[1], "ideal": "false", "speed": "100",
        "floor": "4x3.5", "identity": "fixed"
    });
    assert_eq!((&report["notes"], &report["robots"]), (&notes, &json!(6)));
    let (code, text, _) = run(&["replay", &file]);
    assert!(code == 0 && text.starts_with("the same to the bit: "), "{text}");

    let lines = shows::folder().join("rehearsal.jsonl");
    run(&["replay", &file, "--lines", lines.to_str().unwrap()]);
    let lines = std::fs::read_to_string(lines).unwrap();
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.last().unwrap()["digest"], report["digest"]);
    let of = |kind: &str| lines.iter().filter(|line| line["of"] == kind).count();
    assert_eq!(json!(of("message")), report["messages"]);
    assert!(of("sent") >= 6 && of("event") >= 6 && of("input") >= 3, "{}", lines.len());

    let (code, _, err) = run(&["replay", &file, "--lines", &file]);
    assert!(code == 2 && err.contains("choose another file"), "{err}");

    let mut bytes = std::fs::read(&file).unwrap();
    bytes.truncate(bytes.len() / 2);
    std::fs::write(&file, &bytes).unwrap();
    let (code, report) = replay(&[&file]);
    assert_eq!((code, &report["complete"]), (0, &json!(false)), "{report}");
}

#[test]
fn what_is_no_recorded_run_is_refused_in_one_line() {
    let show = shows::row_file(6, &[0.5]);
    let lines = shows::file("lines-of-another-run", "kept");
    for (file, why) in
        [(show.as_str(), "it is no recorded run"), ("/", "not a regular file"), ("77", "cannot be read")]
    {
        let data = shows::folder();
        let (code, out, err) = run(&["replay", file, "--data", data.to_str().unwrap(), "--lines", &lines]);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
        assert!(err.contains(why), "{err}");
        assert_eq!(std::fs::read_to_string(&lines).unwrap(), "kept");
    }
}

#[test]
fn a_run_on_the_screen_is_recorded_in_the_data_folder() {
    let _turn = alone();
    let data = shows::folder().join("recorded");
    let data = data.to_str().unwrap();
    let (mut server, address, _) =
        start(&["--robots", "4", "--data", data, &shows::row_file(4, &[0.2, 0.1])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    for number in ["1", "2"] {
        screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
        wait_for("the whole log", || {
            let (_, out, _) = run(&["replay", "--json", number, "--data", data]);
            let report: Value = serde_json::from_str(&out).unwrap_or_default();
            assert_eq!(report["difference"], Value::Null, "{report}");
            (report["complete"] == true).then_some(())
        });
        screen.until("ready", |screen| (screen.phase() == "ready").then_some(()));
    }
    reports_are_read_over_http(&address);
    server.terminate();
    assert_eq!(server.end(), 0);
}

/// Checks the list of runs and their reports after two runs of the server have ended well.
fn reports_are_read_over_http(address: &str) {
    let get = |path: &str| http::request(address, "GET", path, &[], "");
    let runs = wait_for("the end of the second run in the list", || {
        let runs = get("/api/runs").json();
        runs[0]["ended_ms"].is_u64().then_some(runs)
    });
    let numbers: Vec<_> = runs.as_array().unwrap().iter().map(|run| &run["number"]).collect();
    assert_eq!(numbers, [2, 1]);
    let outcome = "All 2 frames shown, no robot lost.";
    for (key, value) in [("outcome", json!(outcome)), ("ok", json!(true)), ("has_report", json!(true))] {
        assert_eq!(runs[1][key], value, "{runs}");
    }
    let report = get("/api/runs/1/report");
    assert!(report.status == 200 && report.body.contains(outcome), "{} {}", report.status, report.body);
    assert!(report.header("Content-Security-Policy").contains("sandbox"), "{}", report.head);
    assert_eq!(get("/api/runs/1/report").body, report.body, "it is kept");
    for (path, status) in [("3", 404), ("..%2f1", 400), ("-1", 400), ("1x", 400)] {
        let answer = get(&format!("/api/runs/{path}/report"));
        assert_eq!(answer.status, status, "{path}: {}", answer.body);
    }
}

#[test]
fn a_played_show_is_recorded() {
    let _turn = alone();
    let Some(broker) = Mosquitto::start() else { return };
    let _robots = Child::lightbots(&["robots", "--count", "5", "--broker", &broker.url()]);
    let file = recorded_file("played.lblog");
    let show = shows::row_file(5, &[0.2, 0.1]);
    let mut play = Child::lightbots(&["play", &show, "--broker", &broker.url(), "--json", "--record", &file]);
    assert_eq!(play.end(), 0, "{}", play.err());
    let (code, report) = replay(&[&file]);
    assert_eq!((code, &report["complete"], &report["robots"]), (0, &json!(true), &json!(5)), "{report}");
}

#[test]
fn a_report_says_what_happened_in_one_file_of_its_own() {
    let (file, page) = (recorded_file("reported.lblog"), recorded_file("report.html"));
    let show = shows::row_file(6, &[0.5, 0.5]);
    run(&["rehearse", &show, "--record", &file, "--faults", "kill=2@1s", "--seed", "4"]);
    let (code, out, err) = run(&["report", &file, "--out", &page, "--json"]);
    let report: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{out} {err}"));
    assert_eq!((code, &report["ok"], &report["frames_played"]), (1, &json!(false), &json!(2)), "{report}");
    assert_eq!(report["losses"].as_array().map(Vec::len), Some(1), "{report}");
    assert_eq!(report["per_robot"].as_array().map(Vec::len), Some(6), "{report}");
    let first = std::fs::read_to_string(&page).unwrap();
    assert!(first.contains("All 2 frames shown, one robot lost."), "{first}");
    run(&["report", &file, "--out", &page]);
    assert_eq!(std::fs::read_to_string(&page).unwrap(), first, "the same bytes");
    let (code, _, err) = run(&["report", &show]);
    assert!(code == 2 && err.contains("it is no recorded run"), "{err}");
}
