//! The example of docs/api.md, a Python program that uses the server.

use std::process::Command;

use crate::child::{Child, run};
use crate::sign_in::{session, start_with, token};
use crate::{alone, http, shows};

/// Runs docs/run_show.py until it ends. Returns exit code, stdout and stderr.
fn run_show(token: &str, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new("python3");
    command.arg(format!("{}/../../docs/run_show.py", env!("CARGO_MANIFEST_DIR")));
    command.args(arguments).env("LIGHTBOTS_TOKEN", token).env("PYTHONDONTWRITEBYTECODE", "1");
    let mut child = Child::start(command, "run_show.py");
    let code = child.end();
    (code, child.out(), child.err())
}

#[test]
fn the_python_example_runs_a_show_and_reads_its_report() {
    let _turn = alone();
    let (_server, data, site) = start_with(&[("ann", "operator")], "4");
    let operator = session(&site, "ann", "password of ann");
    let program = token(&site, &operator, "lights", "operator");
    let program = program.trim_start_matches("Bearer ");
    let (address, ca) = (format!("https://{}", site.address), format!("{data}/certs/server.pem"));
    let (show, report) =
        (shows::row_file(4, &[0.2, 0.1]), format!("{data}/../report-{}.html", std::process::id()));
    let arguments = [&address, &*show, "--ca", &ca, "--report", &report];

    let (code, out, err) = run_show(program, &arguments);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let lines: Vec<&str> = out.lines().collect();
    for (line, expected) in [
        (0, "Signed in as lights (operator)."),
        (1, "Saved rows: 2 frames, 4 pixels."),
        (3, "4 robots, 4 of them simulated."),
        (lines.len() - 2, "Run 1: All 2 frames shown, no robot lost."),
    ] {
        assert_eq!(lines[line], expected, "{out}");
    }
    assert!(lines[2].starts_with("Planned: ") && lines.contains(&"Frame 2 of 2"), "{out}");
    let page = std::fs::read_to_string(&report).unwrap();
    assert_eq!(lines[lines.len() - 1], format!("Report: {report}, {} bytes.", page.len()));
    let served = http::request(&site, "GET", "/api/runs/1/report", &[("Cookie", &operator)], "");
    assert!(
        page == served.body && page.contains("All 2 frames shown, no robot lost."),
        "the report of this run"
    );

    let viewer = token(&site, &operator, "watch", "viewer");
    for (token, expected) in [
        ("0", "401: sign in first, or send the header Authorization: Bearer TOKEN"),
        (
            viewer.trim_start_matches("Bearer "),
            "403: This needs the role editor; you are signed in as viewer.",
        ),
    ] {
        let (code, out, err) = run_show(token, &arguments);
        assert!(code == 1 && err.contains(expected) && err.lines().count() == 1, "{out}{err}");
    }
    let (code, _, err) = run_show(program, &[&address, &*show, "--report", &report]);
    assert!(code == 1 && err.contains("CERTIFICATE_VERIFY_FAILED"), "{err}");
    let touching = shows::file("touching.lightbots.json", shows::row(2, &[0.1]).replace("0.050", "0.001"));
    let (code, out, err) = run_show(program, &[&address, &*touching, "--ca", &ca]);
    assert!(code == 1 && out.contains("error: ") && err == "this show cannot be played", "{out}{err}");
}

#[test]
fn planned_and_driven_paths_are_drawn() {
    let show = shows::row_file(3, &[0.5, 0.5]);
    let [plan, steps, out] = ["plan.json", "steps.csv", "paths.svg"].map(|name| shows::file(name, ""));
    assert_eq!(run(&["plan", &show, "--out", &plan]).0, 0);
    assert_eq!(run(&["rehearse", &show, "--steps", &steps]).0, 0);
    let rows = std::fs::read_to_string(&steps).unwrap();
    assert!(rows.starts_with("time_s,robot,x_m,y_m\n") && rows.lines().count() > 60, "{}", rows.len());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/draw_paths.py");
    let drawn = Command::new("python3").args([script, &plan, &steps, &out]).output().unwrap();
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    assert!(String::from_utf8_lossy(&drawn.stdout).starts_with("6 planned and 3 driven lines"));
    assert_eq!(std::fs::read_to_string(out).unwrap().matches("<polyline").count(), 9);
}
