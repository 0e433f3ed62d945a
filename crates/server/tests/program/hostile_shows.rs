//! Shows that are made to overload the planner.

use serde_json::{Value, json};

use crate::run::start;
use crate::screen::Screen;
use crate::{alone, child, http, shows};

/// A show of one pixel whose y is this text.
fn pixel_at(y: &str) -> String {
    format!(
        r##"{{"lightbots": 1, "frames": [{{"name": "Far", "air_time_s": 1, "pixels": [{{"id": 0, "place": [0, {y}], "color": "#ffffff"}}]}}]}}"##
    )
}

/// A show in which the robots of a dense crowd exchange places: much more than a second of planning on any machine.
fn endless() -> String {
    let side = 100;
    let pixel = |id: usize, place: usize| {
        let at = |number: usize| number as f64 * 0.1 - 4.95;
        json!({"id": id, "place": [at(place % side), at(place / side)], "color": "#ffffff"})
    };
    let count = side * side;
    let frame = |place: &dyn Fn(usize) -> usize| -> Value {
        let pixels: Vec<Value> = (0..count).map(|id| pixel(id, place(id))).collect();
        json!({"name": "Crowd", "air_time_s": 0, "pixels": pixels})
    };
    let frames = [frame(&|id| id), frame(&|id| id * 7_919 % count), frame(&|id| count - 1 - id)];
    json!({
        "lightbots": 1, "identity": "fixed", "stage": {"width_m": 14, "depth_m": 14}, "frames": frames,
    })
    .to_string()
}

fn codes(plan: &Value) -> Vec<&str> {
    plan["issues"].as_array().unwrap().iter().map(|issue| issue["code"].as_str().unwrap()).collect()
}

#[test]
fn a_show_that_is_not_fit_is_planned_nowhere() {
    let _turn = alone();
    for y in ["1e308", "-1.7976931348623157e308", "1e9"] {
        let file = shows::file("far.lightbots.json", pixel_at(y));
        let out = shows::folder().join("far-plan.json");
        for arguments in
            [&["check", &file][..], &["plan", &file, "--out", out.to_str().unwrap()], &["rehearse", &file]]
        {
            let (code, text, err) = child::run(&[arguments, &["--json"]].concat());
            assert_eq!(code, 1, "{arguments:?}: {err}");
            let report: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(codes(&report), ["pixel-off-floor"], "{arguments:?}");
            let message = report["issues"][0]["message"].as_str().unwrap();
            assert!(message.len() < 300 && message.contains("pixel 0"), "{message}");
        }
    }
    let file = shows::file("far.lightbots.json", pixel_at("1e308"));
    let (_server, address, _) = start(&["--robots", "1", &file]);
    let checked = http::request(&address, "POST", "/api/check", &[], &pixel_at("1e308")).json();
    assert_eq!(
        (codes(&checked), checked["transitions"].as_array().unwrap().len()),
        (vec!["pixel-off-floor"], 0)
    );
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(1);
    assert_eq!(codes(&screen.get("plan")), ["pixel-off-floor"]);
    let refused = screen.operate(json!({"do": "play", "from": 0, "missing": "refuse"}));
    assert!(refused["error"].as_str().unwrap().contains("pixel 0"), "{refused}");
}

#[test]
fn a_plan_that_takes_too_long_is_cut_off_and_is_no_plan() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0", "--plan-budget", "1"]);
    let late = http::request(&address, "POST", "/api/check", &[], &endless()).json();
    assert_eq!((codes(&late), &late["ok"]), (vec!["planning-cut-off"], &json!(false)), "{}", late["issues"]);
    assert_eq!(late["transitions"], json!([]));
    let next = http::request(&address, "POST", "/api/check", &[], &shows::row(2, &[1.0])).json();
    assert_eq!(next["ok"], true, "{}", next["issues"]);
}
