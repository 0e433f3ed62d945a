//! Parts of version 2 of our format. They are kept exactly, are bounded, and are absent from files that do not need
//! them.

mod extras;
mod numbers;
mod random;
#[path = "../../show/tests/rows/mod.rs"]
mod rows;

use extras::with_every_part;
use lightbots_exchange::{LIGHTBOTS, read};
use lightbots_show::{MAX_LAYERS, MAX_SETTING_VALUES, Setting, Show, setting, validate};
use numbers::Numbers;
use rows::{row, show};

fn text_of(show: &Show) -> String {
    String::from_utf8(LIGHTBOTS.write(show, None).bytes).unwrap()
}

/// The message of the refusal. Panics if the text is read.
fn refusal(text: &str) -> String {
    read(text.as_bytes(), None).expect_err("must not be read").to_string()
}

/// A show in our format with one empty frame and these fields.
fn with(fields: &str) -> String {
    format!("{{\"lightbots\": 2, {fields}, \"frames\": [{{\"pixels\": []}}]}}")
}

#[test]
fn random_shows_come_back_as_they_were() {
    let mut numbers = Numbers(2);
    for seed in 0..2_000 {
        let show = numbers.show();
        let text = text_of(&show);
        let loaded = read(text.as_bytes(), None).unwrap_or_else(|error| panic!("{seed}: {error}\n{text}"));
        assert_eq!(loaded.issues, [], "{seed}");
        assert_eq!(loaded.show, show, "{seed}:\n{text}");
        assert_eq!(text_of(&loaded.show), text, "{seed}");
        assert!(validate(&show).iter().all(|issue| !issue.message.contains('\n')), "{seed}");
        serde_json::from_str::<serde_json::Value>(&text).expect("it is JSON for others too");
    }
}

#[test]
fn a_show_is_of_version_2_only_if_it_uses_a_part_of_it() {
    let plain = show(vec![row(3)]);
    assert!(text_of(&plain).contains("\"lightbots\": 1,"));
    assert!(text_of(&with_every_part(plain.clone())).contains("\"lightbots\": 2,"));
    let mut named = plain;
    named.frames[0].id = Some("one".into());
    assert!(text_of(&named).contains("\"lightbots\": 2,"));
    // A reader takes parts of version 2 also from a file whose version is lower.
    let text = text_of(&with_every_part(show(vec![row(3)])));
    let low = text.replace("\"lightbots\": 2", "\"lightbots\": 1");
    assert_eq!(text_of(&read(low.as_bytes(), None).unwrap().show), text);
}

#[test]
fn every_prefix_of_a_show_with_every_part_is_cut_off() {
    let text = text_of(&with_every_part(show(vec![row(3)])));
    for end in 0..text.trim_end().len() {
        assert!(read(&text.as_bytes()[..end], None).is_err(), "cut at {end}");
    }
}

#[test]
fn a_sound_show_with_every_part_plays() {
    let show = with_every_part(show(vec![row(3)]));
    assert_eq!(validate(&show), []);
    let mut later = show;
    later.trajectories[0].frame = None;
    let codes: Vec<String> = validate(&later).into_iter().map(|issue| issue.code).collect();
    assert_eq!(codes, ["not-played-yet"], "trajectories of the whole show are not played");
}

#[test]
fn what_makes_no_part_is_named() {
    let source = |fields: &str| {
        format!("{{\"lightbots\": 2, \"frames\": [{{\"sources\": [{{{fields}}}], \"pixels\": []}}]}}")
    };
    let pieces = "\"trajectories\": [{\"pixel\": 1, \"start\": [0, 0], \"pieces\": [[1, 2]]}]";
    for (text, part) in [
        (source("\"seed\": 1"), "the kind of the source is missing"),
        (source("\"kind\": \"film\""), "kind is \"film\"; it can be \"text\" or \"svg\""),
        (source("\"kind\": \"svg\", \"asset\": \"00\""), "\"00\" is not the hash of an asset"),
        (source("\"kind\": \"svg\", \"seed\": -1"), "seed is -1"),
        (source("\"kind\": \"svg\", \"box\": {\"min\": [0, 0]}"), "min or max of the box is missing"),
        (source("\"kind\": \"svg\", \"settings\": {\"a\": 1, \"a\": 2}"), "\"a\" stands twice"),
        (source("\"kind\": \"svg\", \"settings\": {\"a\": NaN}"), "the setting \"a\" is NaN"),
        (source("\"kind\": \"svg\", \"settings\": {\"a\": [1e999]}"), "the setting \"a\" is infinite"),
        (with("\"layers\": [{\"kind\": \"fire\", \"from_s\": 1}]"), "\"from_s\" and \"to_s\""),
        (with("\"layers\": [{\"kind\": \"fire\", \"frames\": [\"a\"]}]"), "a layer has \"frames\""),
        (with("\"layers\": [{\"from_s\": 1, \"to_s\": 2}]"), "the kind of the layer is missing"),
        (with("\"cues\": [{\"frame\": \"a\", \"at_s\": 2}]"), "either \"frame\" or \"at_s\""),
        (with("\"beats\": {\"per_bar\": 3}"), "either \"bpm\""),
        (with("\"markers\": [{\"name\": \"a\"}]"), "at_s of the marker is missing"),
        (with(pieces), "a piece has 3 numbers"),
        (with("\"assets\": {\"AB\": {}}"), "\"AB\" is not the hash of an asset"),
        (with("\"spares\": 1.5"), "spares is 1.5"),
    ] {
        let error = refusal(&text);
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn parts_without_bounds_are_refused() {
    let many = |item: &str, count: usize| vec![item; count].join(",");
    let layers = with(&format!("\"layers\": [{}]", many("{\"kind\": \"fire\"}", MAX_LAYERS + 1)));
    assert!(refusal(&layers).contains("more than 1000 layers"));
    let curve = |points: usize| {
        with(&format!(
            "\"layers\": [{{\"kind\": \"fire\", \"settings\": {{\"a\": [{}]}}}}]",
            many("1", points)
        ))
    };
    assert!(
        refusal(&curve(1_000_000))
            .contains("more than 20000 values in one group of settings; simplify the setting \"a\"")
    );
    let loaded = read(curve(MAX_SETTING_VALUES - 1).as_bytes(), None).unwrap();
    let Some(Setting::List(points)) = setting(&loaded.show.layers[0].settings, "a") else { panic!() };
    assert_eq!(points.len(), MAX_SETTING_VALUES - 1);
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    let deep = with(&format!("\"layers\": [{{\"kind\": \"fire\", \"settings\": {{\"a\": {deep}}}}}]"));
    assert!(refusal(&deep).contains("settings nest more than 8 deep"));
    let long = with(&format!("\"markers\": [{{\"name\": \"{}\", \"at_s\": 1}}]", "ä".repeat(201)));
    assert!(refusal(&long).contains("name is longer than 200 characters"));
    let layer = format!("{{\"kind\": \"fire\", \"settings\": {{\"a\": [{}]}}}}", many("1", 19_000));
    let all = with(&format!("\"layers\": [{}]", many(&layer, 27)));
    assert!(refusal(&all).contains("more than 500000 values in settings"));
}

#[test]
fn what_is_not_known_is_told_and_keeps_the_file_from_being_replaced() {
    let whole = read(text_of(&with_every_part(show(vec![row(3)]))).as_bytes(), None).unwrap();
    assert_eq!(whole.unread, None);
    let fields = r#""glow": {"a": [1]}, "layers": [{"kind": "fire", "heat": 3}]"#;
    let loaded = read(with(fields).as_bytes(), None).unwrap();
    let reason = "it has unknown fields (\"glow\" of the show, \"heat\" of the layer)";
    assert_eq!(loaded.unread.as_deref(), Some(reason));
    let codes: Vec<&str> = loaded.issues.iter().map(|issue| issue.code.as_str()).collect();
    assert_eq!(codes, ["unknown-field"; 2]);

    let newer = with("\"glow\": 1, \"spares\": 4").replace("\"lightbots\": 2", "\"lightbots\": 3");
    let loaded = read(newer.as_bytes(), None).unwrap();
    assert_eq!(loaded.show.spares, 4);
    let reason = "it has format version 3 and it has unknown fields (\"glow\" of the show)";
    assert_eq!(loaded.unread.as_deref(), Some(reason));
    assert_eq!(loaded.issues[0].code, "newer-version");
    let changed = newer.replace("\"spares\": 4", "\"spares\": \"four\"");
    assert!(refusal(&changed).ends_with("or update this program, the show has format version 3"));

    let many: Vec<String> = (0..1_000).map(|nth| format!("\"x{nth}\": 1")).collect();
    let loaded = read(with(&many.join(",")).as_bytes(), None).unwrap();
    assert_eq!(loaded.issues.len(), 21, "the first twenty, and one line for the others");
    assert!(loaded.unread.unwrap().ends_with("\"x3\" of the show, more)"));
}

#[test]
fn the_example_of_the_documentation_is_what_is_written() {
    let page = include_str!("../../../docs/show-format.md");
    let example = page.split("```json\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let loaded = read(example.as_bytes(), None).unwrap();
    assert_eq!(loaded.issues, []);
    assert_eq!(text_of(&loaded.show), example);
    assert!(validate(&loaded.show).iter().all(|issue| issue.code == "not-played-yet"));
}
