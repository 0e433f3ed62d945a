//! Makes shows of words, shapes and files on the command line, and rehearses them.

use serde_json::Value;

use crate::child::run;
use crate::shows;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

/// An SVG of a face that consists of areas and a line.
const FACE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
    <circle cx="50" cy="50" r="45" fill="orange"/><circle cx="33" cy="40" r="7" fill="#003366"/>
    <circle cx="67" cy="40" r="7" fill="#003366"/>
    <path d="M30 62 Q50 82 70 62" stroke="white" stroke-width="4" fill="none"/></svg>"##;

#[test]
fn words_shapes_and_files_become_a_show_that_is_played_without_contact() {
    let svg = shows::file("face.svg", FACE);
    let out = shows::file("made.lightbots.zip", "");
    let (code, text, err) =
        run(&["make", "text:HI", "shape:heart", &svg, "--robots", "30", "--out", &out, "--json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let made = json(&text);
    assert_eq!((&made["ok"], &made["frames"], &made["pixels"]), (&Value::from(true), &3.into(), &30.into()));
    assert!(made["pictures"][0]["correlation"].as_f64().unwrap() > 0.9, "{made}");
    let report = json(&run(&["rehearse", &out, "--json"]).1);
    assert_eq!((&report["ok"], &report["contacts"]), (&Value::from(true), &Value::from(0)));
}

#[test]
fn the_same_command_writes_the_same_bytes() {
    let files = ["one.lightbots.json", "two.lightbots.json"].map(|name| shows::file(name, ""));
    for file in &files {
        assert_eq!(run(&["make", "text:LOVE", "--robots", "60", "--floor", "5x5", "--out", file]).0, 0);
    }
    let read =
        |file: &String| std::fs::read_to_string(file).unwrap().replace("\"one\"", "").replace("\"two\"", "");
    assert_eq!(read(&files[0]), read(&files[1]));
}

#[test]
fn a_made_show_is_fitted_to_another_fleet() {
    let made = shows::file("fleet.lightbots.json", "");
    assert_eq!(run(&["make", "text:HI", "shape:grid", "--robots", "40", "--out", &made]).0, 0);
    let fitted = shows::file("fitted.lightbots.json", "");
    assert_eq!(run(&["convert", &made, &fitted, "--robots", "25"]).0, 0);
    assert_eq!(json(&run(&["check", &fitted, "--json"]).1)["pixels"], 25);
}

#[test]
fn a_show_with_its_drawing_is_drawn_anew_for_another_fleet() {
    let svg = shows::file("face.svg", FACE);
    let made = shows::file("face.lightbots.zip", "");
    assert_eq!(run(&["make", &svg, "--robots", "40", "--out", &made]).0, 0);
    let fitted = shows::file("fitted.lightbots.zip", "");
    assert_eq!(run(&["convert", &made, &fitted, "--robots", "90",]).0, 0);
    let direct = shows::file("face.lightbots.zip", "");
    assert_eq!(run(&["make", &svg, "--robots", "90", "--out", &direct]).0, 0);
    assert_eq!(std::fs::read(fitted).unwrap(), std::fs::read(direct).unwrap());
}

#[test]
fn too_few_robots_are_said_with_the_number_that_would_do() {
    let out = shows::file("few.lightbots.json", "");
    let (code, text, _) = run(&["make", "text:HELLO", "--robots", "9", "--out", &out, "--json"]);
    let made = json(&text);
    assert_eq!(code, 0);
    assert_eq!(made["issues"][0]["code"], "hard-to-read");
    assert!(made["pictures"][0]["enough"].as_u64().unwrap() > 25, "{made}");
}

#[test]
fn sources_that_cannot_be_drawn_are_refused_in_one_line() {
    let bomb = "<svg xmlns=\"http://www.w3.org/2000/svg\">".to_owned() + &"<g>".repeat(100_000);
    let cases = [
        (shows::file("bomb.svg", &bomb), "bomb.svg"),
        (shows::file("cut.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><path"), "cut off"),
        (shows::file("notes.txt", "nothing to see here"), "unknown kind"),
        ("missing.svg".to_owned(), "cannot be read"),
        ("shape:blob".to_owned(), "heart"),
    ];
    let out = shows::file("refused.lightbots.json", "");
    for (source, word) in cases {
        let (code, _, err) = run(&["make", &source, "--robots", "9", "--out", &out]);
        assert_eq!(code, 2, "{source}: {err}");
        assert!(err.contains(word) && err.lines().count() == 1, "{source}: {err}");
    }
}
