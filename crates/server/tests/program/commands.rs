//! Behaviour of the commands that only compute: exit codes, output and errors.

use serde_json::Value;

use crate::child::run;
use crate::shows;

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

fn has(value: &Value, keys: &[&str]) {
    for key in keys {
        assert!(value.get(key).is_some(), "{key} is missing in {value}");
    }
}

#[test]
fn check_says_what_it_promises() {
    let (code, out, err) = run(&["check", &shows::example("countdown.json"), "--json"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let report = json(&out);
    has(
        &report,
        &[
            "ok",
            "frames",
            "pixels",
            "duration_s",
            "lower_bound_s",
            "closest_m",
            "plan_ms",
            "issues",
            "transitions",
            "stop_safe",
        ],
    );
    has(&report["transitions"][0], &["from", "to", "duration_s", "lower_bound_s", "closest_m", "stop_safe"]);
    has(&report["stop_safe"], &["share", "worst"]);
    assert_eq!((report["ok"].as_bool(), report["pixels"].as_u64()), (Some(true), Some(30)));
    assert!(report["closest_m"].as_f64().unwrap() > 0.054);
    assert!(report["duration_s"].as_f64() > report["lower_bound_s"].as_f64());
    assert_eq!(report["transitions"].as_array().unwrap().len() as u64, report["frames"].as_u64().unwrap());
}

#[test]
fn check_names_the_closest_robots_with_time_and_place() {
    // Two robots that change places and pass each other, and a third one far away.
    let show = r##"{"lightbots":1,"identity":"fixed","starts":[[-0.5,0],[0.5,0],[0,1]],"frames":[
        {"name":"A","air_time_s":1,"pixels":[{"id":4,"place":[-0.5,0],"color":"#ffffff"},
            {"id":7,"place":[0.5,0],"color":"#ffffff"},{"id":9,"place":[0,1],"color":"#ffffff"}]},
        {"name":"B","air_time_s":1,"pixels":[{"id":4,"place":[0.5,0],"color":"#ffffff"},
            {"id":7,"place":[-0.5,0],"color":"#ffffff"},{"id":9,"place":[0,1],"color":"#ffffff"}]}]}"##;
    let file = shows::file("swap.lightbots.json", show);
    let report = json(&run(&["check", &file, "--json"]).1);
    let closest = &report["closest"];
    assert_eq!(closest["distance_m"], report["closest_m"]);
    assert_eq!((&closest["to"], &closest["pixels"]), (&Value::from(1), &serde_json::json!([4, 7])));
    let (at_s, show_at_s) = (closest["at_s"].as_f64().unwrap(), closest["show_at_s"].as_f64().unwrap());
    assert!(at_s > 1.0 && (show_at_s - at_s - 1.0).abs() < 1e-9, "{closest}");
    assert!(closest["place"][0].as_f64().unwrap().abs() < 0.1, "{closest}");
    let (code, text, _) = run(&["check", &file]);
    assert_eq!(code, 0);
    let line = text.lines().find(|line| line.starts_with("closest: the robots for pixels 4 and 7")).unwrap();
    assert!(line.ends_with("on the way to frame 2 \"B\""), "{line}");
}

#[test]
fn check_names_layers_that_stay_dark_and_light_that_flashes() {
    // Sixteen robots, 0.2 m apart.
    let pixel = |id: u32| {
        let place = [f64::from(id % 4) * 0.2 - 0.3, f64::from(id / 4) * 0.2 - 0.3];
        format!(r##"{{"id":{id},"place":{place:?},"color":"#000000"}}"##)
    };
    let pixels: Vec<String> = (0..16).map(pixel).collect();
    let show = format!(
        r##"{{"lightbots":2,"layers":[{{"name":"Flash","kind":"strobe","settings":{{"speed_hz":3}}}},
        {{"name":"Sparks","kind":"strobe","settings":{{"speed_hz":1000}}}}],
        "frames":[{{"name":"A","air_time_s":12,"pixels":[{}]}}]}}"##,
        pixels.join(",")
    );
    let (code, out, _) = run(&["check", &shows::file("flashes", &show), "--json"]);
    let issues = json(&out)["issues"].as_array().unwrap().clone();
    let said =
        |code: &str| issues.iter().find(|issue| issue["code"] == code).map(|issue| issue["message"].clone());
    assert_eq!(code, 0, "{issues:?}");
    assert_eq!(
        said("bad-layer").unwrap(),
        "the layer \"Sparks\": speed_hz is 1000: choose a number from -3 to 3"
    );
    let flashes = said("flashes").unwrap().to_string();
    assert!(flashes.contains("Flash") && flashes.contains("3 flashes in a second"), "{flashes}");
}

#[test]
fn check_explains_which_solvers_ran() {
    let file = shows::example("countdown.json");
    let report = json(&run(&["check", &file, "--json", "--explain"]).1);
    let explanations = report["explanations"].as_array().unwrap();
    assert_eq!(explanations.len(), report["transitions"].as_array().unwrap().len());
    has(&explanations[0], &["to", "chosen", "reason", "rows"]);
    let chosen = explanations[0]["chosen"].as_u64().unwrap() as usize;
    let row = &explanations[0]["rows"][chosen];
    has(row, &["solver", "outcome", "duration_s", "stop_safe_percent", "contacts"]);
    assert!(row["outcome"].as_str().unwrap().starts_with("solved in"), "{row}");
    let (code, text, _) = run(&["check", &file, "--explain"]);
    assert_eq!(code, 0);
    assert!(text.lines().any(|line| line.starts_with("  * straight lines, slack")), "{text}");
    assert_eq!(json(&run(&["check", &file, "--json"]).1)["explanations"], Value::Null);
}

#[test]
fn check_says_where_no_robot_may_stop_dead() {
    // Two robots that drive 6 mm apart, one behind the other, in a time that the frame prescribes.
    let show = r##"{"lightbots":1,"identity":"fixed","starts":[[-1,0],[-1.06,0]],"frames":[
        {"name":"A","air_time_s":1,"transition_s":8.5,"pixels":[{"id":4,"place":[1,0],"color":"#ffffff"},
            {"id":7,"place":[0.94,0],"color":"#ffffff"}]}]}"##;
    let file = shows::file("queue.lightbots.json", show);
    let report = json(&run(&["check", &file, "--json"]).1);
    let (share, worst) = (report["stop_safe"]["share"].as_f64().unwrap(), &report["stop_safe"]["worst"]);
    assert!((0.5..0.8).contains(&share), "{report}");
    assert_eq!(report["transitions"][0]["stop_safe"], share);
    has(worst, &["robot", "pixel", "by", "by_pixel", "frame", "moment", "show_moment", "place", "missing_m"]);
    assert_eq!((&worst["pixel"], &worst["by_pixel"], &worst["frame"]), (&4.into(), &7.into(), &0.into()));
    // A robot needs 20 mm to stop and 3 mm to spare, and has 6 mm.
    assert!((0.010..0.0175).contains(&worst["missing_m"].as_f64().unwrap()), "{worst}");
    let (code, text, _) = run(&["check", &file]);
    assert_eq!(code, 0);
    assert!(text.contains("if the robot for pixel 4 does"), "{text}");
    assert!(text.contains("too tight for more on the way to: frame 1 \"A\""), "{text}");
    // The report of a show that cannot be played has no stop-safety.
    let off_floor = show.replace("[0.94,0]", "[9.4,0]");
    let file = shows::file("off-floor.lightbots.json", &off_floor);
    assert_eq!(json(&run(&["check", &file, "--json"]).1)["stop_safe"]["share"], Value::Null);
    assert!(!run(&["check", &file]).1.contains("stop dead"));
    // If the plan may take longer, the robot behind leaves a little later.
    let file = shows::file("queue.lightbots.json", show.replace(r#""transition_s":8.5,"#, ""));
    let report = json(&run(&["check", &file, "--json"]).1);
    assert_eq!((&report["stop_safe"]["share"], &report["stop_safe"]["worst"]), (&1.0.into(), &Value::Null));
    assert!(run(&["check", &file]).1.contains("any one robot may stop dead at any moment"));
}

/// Largest number of decimals among the numbers below keys with this ending. `None` if there is no such number.
fn most_decimals(value: &Value, key: &str, ending: &str) -> Option<usize> {
    let inside = |pairs: Vec<(String, &Value)>| {
        pairs.iter().filter_map(|(key, value)| most_decimals(value, key, ending)).max()
    };
    match value {
        Value::Object(map) => {
            // A nested value without a unit in its own key has the unit of the key above it.
            let key_of = |inner: &String| {
                let own = inner.ends_with("_s") || inner.ends_with("_m") || inner.ends_with("_ms");
                if own { inner.clone() } else { key.to_owned() }
            };
            inside(map.iter().map(|(inner, value)| (key_of(inner), value)).collect())
        }
        Value::Array(list) => inside(list.iter().map(|value| (key.to_owned(), value)).collect()),
        Value::Number(number) if key.ends_with(ending) => {
            let value = number.as_f64().unwrap();
            let is_whole = |&decimals: &usize| {
                let scaled = value * 10_f64.powi(decimals as i32);
                (scaled - scaled.round()).abs() < 1e-7
            };
            (0..15).find(is_whole)
        }
        _ => None,
    }
}

#[test]
fn numbers_are_as_long_in_a_rehearsal_as_in_a_check() {
    let show = shows::row_file(6, &[0.3, 0.2]);
    for command in ["check", "rehearse"] {
        let mut report = json(&run(&[command, &show, "--json"]).1);
        // This value is left out, because clocks differ by microseconds.
        report.as_object_mut().unwrap().remove("clock_spread_s");
        let decimals = ["_s", "_m"].map(|unit| most_decimals(&report, "", unit).unwrap());
        assert!(decimals[0] <= 3 && decimals[1] <= 5, "{command}: {decimals:?} {report}");
        // Planned places are round numbers, and places of robots are not.
        let least = if command == "check" { [2, 1] } else { [2, 4] };
        assert!(decimals[0] >= least[0] && decimals[1] >= least[1], "{command}: {decimals:?} {report}");
    }
}

#[test]
fn a_rehearsal_is_its_seed() {
    let show = shows::row_file(6, &[0.3, 0.2]);
    let rehearse = |more: &[&str]| {
        let mut all = vec!["rehearse", &show, "--json"];
        all.extend(more);
        let (code, out, err) = run(&all);
        assert_eq!((code, err.as_str()), (0, ""), "{out}");
        json(&out)
    };
    let (first, again) = (rehearse(&["--seed", "7"]), rehearse(&["--seed", "7"]));
    has(&first, &["ok", "robots", "frames_played", "duration_s", "lower_bound_s", "contacts", "closest_m"]);
    has(
        &first,
        &[
            "arrival_spread_s",
            "position_error_m",
            "tracking_error_m",
            "brakes",
            "messages",
            "seed",
            "state_hash",
            "real_time_factor",
            "issues",
        ],
    );
    has(&first["arrival_spread_s"], &["median", "p99", "max"]);
    has(&first["messages"], &["sent", "lost"]);
    has(&first["brakes"], &["all", "false"]);
    assert_eq!((first["contacts"].as_u64(), first["frames_played"].as_u64()), (Some(0), Some(2)));
    assert_eq!(first["state_hash"], again["state_hash"]);
    assert_ne!(first["state_hash"], rehearse(&["--seed", "8"])["state_hash"]);
    let hard = rehearse(&["--faults", "loss=5%"]);
    assert!(hard["messages"]["lost"].as_u64().unwrap() > 0, "{hard}");
    assert_eq!(rehearse(&["--ideal"])["ok"], true);
}

#[test]
fn a_show_that_must_not_be_played_is_not_rehearsed() {
    let (code, out, _) = run(&["rehearse", &shows::row_file(3, &[0.5]), "--floor", "1x1"]);
    assert_eq!(code, 1);
    assert!(out.contains("nothing was rehearsed") && !out.contains("contacts"), "{out}");
}

#[test]
fn a_rehearsal_can_be_read_by_people() {
    let page = shows::file("report.html", "");
    let (code, out, _) = run(&["rehearse", &shows::row_file(3, &[0.1]), "--report", &page]);
    assert_eq!(code, 0, "{out}");
    let text = std::fs::read_to_string(&page).unwrap();
    let said = [
        "The frame was shown, no contacts, no robot lost.",
        "Rehearsal",
        "closest, between rims",
        "no contacts",
        "0 false",
        "0 lost",
        "true place",
    ];
    for line in said {
        assert!(text.contains(line), "{line}: {text}");
    }
    let (code, _, _) = run(&["rehearse", &shows::row_file(3, &[0.5]), "--floor", "1x1", "--report", &page]);
    let text = std::fs::read_to_string(&page).unwrap();
    assert!(code == 1 && text.contains("nothing was rehearsed"), "{text}");
}

#[test]
fn shows_survive_the_way_through_the_original_format_and_back() {
    let (ours, theirs, back) =
        (shows::row_file(3, &[0.5, 1.0]), shows::file("a.json", ""), shows::file("b.lightbots.json", ""));
    assert_eq!(run(&["convert", &ours, &theirs]).0, 0);
    assert!(std::fs::read_to_string(&theirs).unwrap().trim_start().starts_with('['));
    assert_eq!(run(&["convert", &theirs, &back]).0, 0);
    let check = |file: &str| {
        let mut report = json(&run(&["check", file, "--json"]).1);
        report["plan_ms"] = Value::Null;
        report
    };
    assert_eq!(check(&ours), check(&back));
    assert_eq!(run(&["convert", &ours, &shows::file("a.txt", "")]).0, 2);
}

#[test]
fn convert_names_what_it_loses_and_does_not_replace_its_own_input_then() {
    let future = shows::row(3, &[0.5]).replacen("{\"lightbots\":1", "{\"lightbots\":3,\"glow\":1", 1);
    let file = shows::file("future.lightbots.json", &future);
    let out = shows::file("out.lightbots.json", "");
    let (code, _, notes) = run(&["convert", &file, &out]);
    assert_eq!(code, 0, "{notes}");
    assert!(notes.contains("[newer-version]") && notes.contains("\"glow\" of the show"), "{notes}");
    let (code, _, notes) = run(&["convert", &file, &file]);
    assert_eq!(code, 2);
    assert!(notes.contains("which would be lost; write to another file"), "{notes}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), future);
}

#[test]
fn convert_writes_and_reads_archives() {
    let (ours, archive) = (shows::row_file(3, &[0.5]), shows::file("a.lightbots.zip", ""));
    let back = shows::file("back.lightbots.json", "");
    assert_eq!(run(&["convert", &ours, &archive]).0, 0);
    assert!(std::fs::read(&archive).unwrap().starts_with(b"PK"));
    assert_eq!(run(&["check", &archive]).0, 0);
    assert_eq!(run(&["convert", &archive, &back]).0, 0);
    let again = shows::file("again.lightbots.json", "");
    assert_eq!(run(&["convert", &ours, &again]).0, 0);
    assert_eq!(std::fs::read(&back).unwrap(), std::fs::read(&again).unwrap());
}

#[test]
fn convert_plans_shows_for_other_programs_and_reads_them_again() {
    let ours = shows::row_file(3, &[0.5, 1.0]);
    for ending in ["skyc", "csv.zip", "vviz"] {
        let (theirs, back) = (shows::file(&format!("a.{ending}"), ""), shows::file("b.lightbots.json", ""));
        let (code, _, notes) = run(&["convert", &ours, &theirs]);
        assert_eq!(code, 0, "{notes}");
        assert!(notes.contains("[sampled]"), "{notes}");
        // A `.skyc` file holds curves and passes the check. The other formats hold timed lines, which need a new plan.
        assert_eq!(run(&["check", &theirs]).0, i32::from(ending != "skyc"));
        let (code, _, notes) = run(&["convert", &theirs, &back, "--replan"]);
        assert_eq!(code, 0, "{notes}");
        let (code, out, _) = run(&["check", &back, "--json"]);
        assert_eq!((code, json(&out)["transitions"].as_array().unwrap().len()), (0, 2), "{out}");
    }
}

#[test]
fn an_fseq_file_is_put_onto_a_show() {
    let ours = shows::row_file(3, &[0.5]);
    let (lights, lit) = (shows::file("a.fseq", ""), shows::file("lit.lightbots.zip", ""));
    assert_eq!(run(&["convert", &ours, &lights]).0, 0);
    assert_eq!(run(&["convert", &lights, &lit, "--onto", &ours]).0, 0);
    let (code, out, _) = run(&["check", &lit, "--json"]);
    assert_eq!(code, 0, "{out}");
    let (code, _, notes) = run(&["convert", &lights, &lit]);
    assert_eq!(code, 2);
    assert!(notes.contains("--onto SHOW"), "{notes}");
    // A show that cannot be planned leaves the output file as it was.
    let close = shows::file("close.lightbots.json", shows::row(3, &[0.5]).replace("\"id\":1", "\"id\":0"));
    let none = shows::file("none.skyc", "before");
    assert_eq!(run(&["convert", &close, &none]).0, 1);
    assert_eq!(std::fs::read(&none).unwrap(), b"before");
}

#[test]
fn a_plan_is_written_with_its_paths() {
    let out = shows::file("plan.json", "");
    assert_eq!(run(&["plan", &shows::row_file(3, &[0.5]), "--out", &out]).0, 0);
    let plan = json(&std::fs::read_to_string(out).unwrap());
    assert_eq!(plan["transitions"][0]["paths"].as_array().unwrap().len(), 3);
}

#[test]
fn identity_and_floor_can_be_stated() {
    let row = shows::row_file(3, &[0.5]);
    assert_eq!(run(&["check", &row, "--identity", "fixed"]).0, 0);
    // The pixels at y = 1.2 are off a floor that ends at 0.5.
    let (code, out, _) = run(&["check", &row, "--floor", "1x1", "--json"]);
    assert_eq!((code, json(&out)["ok"].as_bool()), (1, Some(false)));
}

#[test]
fn a_floor_that_is_not_used_is_told() {
    let staged = shows::row(3, &[0.5]).replacen("{", r#"{"stage":{"width_m":3,"depth_m":3},"#, 1);
    let staged = shows::file("staged.lightbots.json", staged);
    let codes = |floor: &str| {
        let (code, out, _) = run(&["check", &staged, "--floor", floor, "--json"]);
        assert_eq!(code, 0, "{out}");
        let issues = json(&out)["issues"].as_array().unwrap().clone();
        issues.iter().map(|issue| issue["code"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(codes("4x2"), ["floor-ignored"]);
    assert_eq!(codes("3x3"), [""; 0], "it is the floor the show has");
}

#[test]
fn unreadable_input_is_one_line_and_exit_code_2() {
    let good = shows::row(2, &[1.0]);
    let cases = [
        ("text.json", "hello".to_owned()),
        ("cut.json", good[..good.len() / 2].to_owned()),
        ("nan.json", good.replacen("-0.050", "NaN", 1)),
        ("colour.json", r#"[{"name":"A","airTime":0.0,"pixels":[{"pixelId":0,"color":{"R":"red","G":0,"B":0},"physicalLocation":{"X":0,"Y":0}}]}]"#.into()),
        ("spaces.json", " ".repeat(100_000_000)),
        ("empty.json", String::new()),
    ];
    for (name, bytes) in cases {
        let file = shows::file(name, bytes);
        for command in ["check", "rehearse"] {
            let (code, out, err) = run(&[command, &file, "--json"]);
            assert_eq!((code, out.as_str()), (2, ""), "{command} {name}: {err}");
            assert!(
                err.contains(name) && err.lines().count() == 1 && err.len() < 600,
                "{command} {name}: {err}"
            );
        }
        // One of the files is large.
        std::fs::remove_file(file).unwrap();
    }
    for missing in ["nothing.json", "."] {
        let (code, _, err) = run(&["check", missing]);
        assert_eq!((code, err.lines().count()), (2, 1), "{err}");
    }
}

#[test]
fn shows_that_must_not_be_played_are_issues_and_exit_code_1_or_2() {
    let good = shows::row(2, &[1.0]);
    for (what, show) in [
        ("two pixels on one place", good.replace("-0.050", "0.050")),
        ("a pixel off the floor", good.replace("-0.050", "-7.0")),
        ("an air time of -1", good.replace("\"air_time_s\":1", "\"air_time_s\":-1")),
    ] {
        let (code, out, err) = run(&["check", &shows::file("bad.lightbots.json", show), "--json"]);
        assert_eq!(code, 1, "{what}: {out} {err}");
        let report = json(&out);
        let error =
            report["issues"].as_array().unwrap().iter().find(|issue| issue["severity"] == "error").unwrap();
        assert_eq!(error["frame"], 0, "{what}: {error}");
    }
}

#[test]
fn wrong_use_is_one_line_and_exit_code_2() {
    for arguments in [
        &["check"][..],
        &["check", "a", "b"],
        &["fly"],
        &["check", "a.json", "--floor", "3"],
        &["play", "a.json", "--broker", "http://x"],
        &["robots", "--count", "0", "--broker", "x"],
        &["robots", "--count", "1", "--broker", "x", "--faults", "gremlins"],
        &["rehearse", "a.json", "--faults", "loss=lots"],
        &["rehearse", "a.json", "--faults", ""],
        &["rehearse", "a.json", "--seed", "-1"],
        &["check", "a.json", "--floor", "-1x3"],
        &["run", "--mqtt-listen", "0.0.0.0:0", "--listen", "127.0.0.1:0"],
        &["run", "--listen", "foo"],
    ] {
        let (code, out, err) = run(arguments);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{arguments:?}: {err}");
    }
    assert_eq!(run(&["--help"]).0, 0);
    assert_eq!(run(&["--version"]).0, 0);
}

#[test]
fn a_rehearsal_at_half_speed_drives_for_twice_as_long() {
    let show = shows::row_file(3, &[0.5]);
    let duration = |speed: &str| {
        let report = json(&run(&["rehearse", &show, "--ideal", "--speed", speed, "--json"]).1);
        assert_eq!(report["ok"], true, "{report}");
        report["per_frame"][0]["drive_s"].as_f64().unwrap()
    };
    let (whole_s, half_s) = (duration("100"), duration("50"));
    assert!((1.8..2.2).contains(&(half_s / whole_s)), "{whole_s} {half_s}");
    assert_eq!(run(&["rehearse", &show, "--speed", "10"]).0, 2);
}
