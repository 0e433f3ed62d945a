//! Broken and hostile files: each gets one clear line that says where, what and what to do.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Format, Frame, Pixel, Show, Stage, read, validate, write};

/// What reading says; panics if it is read.
fn refusal(text: &str) -> String {
    read(text.as_bytes(), Some("json")).expect_err("must not be read").to_string()
}

/// A show of ours with one frame "A", from its pixels.
fn ours(pixels: &str) -> String {
    format!("{{\"lightbots\": 1, \"frames\": [{{\"name\": \"A\", \"pixels\": [\n{pixels}]}}]}}")
}

/// A show of the original's with one frame "A", from the fields of its only pixel.
fn original(pixel: &str) -> String {
    format!("[{{\"name\": \"A\", \"airTime\": 0, \"pixels\": [{{{pixel}, \"pixelId\": 7}}]}}]")
}

/// `count` pixels on a line, 0.1 m apart.
fn row(count: u32) -> Vec<Pixel> {
    let place = |id: u32| Vec2::new(f64::from(id) * 0.1 - 1.4, 0.0);
    (0..count).map(|id| Pixel { id, at: place(id), color: Rgb::new(255, 165, 0), robot: None }).collect()
}

fn show(frames: Vec<Vec<Pixel>>) -> Show {
    let frame = |pixels| Frame {
        name: "Row".into(),
        air_time_s: 1.0,
        transition_s: None,
        easing: lightbots_show::Easing::Swift,
        identity: None,
        pixels,
    };
    Show { frames: frames.into_iter().map(frame).collect(), ..Show::default() }
}

/// The messages for a show, one a line, with their codes.
fn messages(show: &Show) -> String {
    let lines: Vec<String> =
        validate(show).iter().map(|issue| format!("{}: {}", issue.code, issue.message)).collect();
    lines.join("\n")
}

#[test]
fn what_is_not_json() {
    assert_eq!(refusal("hello"), "line 1, column 1: this is not JSON; a show file is");
    assert_eq!(refusal("  \n \t"), "the file is empty; a show has at least one frame");
    assert_eq!(
        refusal("[}"),
        "line 1, column 2, frame 1: expected an object in { }, found '}'; is this a show file?"
    );
    assert_eq!(
        refusal("{\"a\": 1}"),
        "this is JSON, but no show: it has no field \"lightbots\" (and is no list of frames)"
    );
    let picture = read(&[0x89, b'P', b'N', b'G', 0xff], Some("png")).unwrap_err().to_string();
    assert!(
        picture.starts_with("line 1, column 1: this is no UTF-8 text; a .png file is not read"),
        "{picture}"
    );
}

#[test]
fn what_is_cut_off_says_where() {
    let whole = String::from_utf8(write(&show(vec![row(3), row(3)]), Format::LightBots)).unwrap();
    let cut = &whole[..whole.rfind("#ff").unwrap()];
    let error = read(cut.as_bytes(), None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 23, column 50, frame 2 \"Row\", pixel 2: \
         the file ends in the middle; it was not saved or copied to its end: get it again"
    );
    for end in 0..whole.trim_end().len() {
        assert!(read(&whole.as_bytes()[..end], None).is_err(), "cut at {end}");
    }
}

#[test]
fn numbers_that_are_none_are_named_with_frame_and_pixel() {
    let text = ours(r##"{"place": [0.1, NaN], "color": "#ffffff", "id": 5}"##);
    let error = read(text.as_bytes(), None).unwrap_err();
    let expected = "line 2, column 17, frame 1 \"A\", pixel 5: \
                    y of the place is NaN, which is no number; give it a number";
    assert_eq!(error.to_string(), expected);
    assert_eq!((error.issue().frame, error.issue().pixels), (Some(0), vec![5]));

    let color = r#""color": {"R": 1, "G": 0, "B": 0}"#;
    let error = refusal(&original(&format!(r#"{color}, "physicalLocation": {{"X": NaN, "Y": 0.5}}"#)));
    assert!(error.contains("frame 1 \"A\", pixel 7: X is NaN, which is no number"), "{error}");
    let error = refusal(&original(&format!(r#"{color}, "physicalLocation": {{"X": 0, "Y": 1e999}}"#)));
    assert!(error.contains("pixel 7: Y is infinite"), "{error}");
    let error = refusal(&original(&format!(r#"{color}, "physicalLocation": {{"X": "0", "Y": 0}}"#)));
    assert!(error.contains("pixel 7: X is the text \"0\", not a number"), "{error}");
    let error = refusal("[{\"name\": \"A\", \"airTime\": NaN, \"pixels\": []}]");
    assert!(error.contains("frame 1 \"A\": airTime is NaN"), "{error}");
}

#[test]
fn colours_outside_their_range() {
    let place = r#""physicalLocation": {"X": 0, "Y": 0}"#;
    let error = refusal(&original(&format!(r#"{place}, "color": {{"R": 2.0, "G": 0, "B": 0}}"#)));
    assert!(
        error.ends_with("frame 1 \"A\", pixel 7: colour component R is 2; it must be from 0 to 1"),
        "{error}"
    );
    let error = refusal(&ours(r#"{"id": 3, "place": [0, 0], "color": "orange"}"#));
    assert!(error.ends_with("pixel 3: \"orange\" is no colour; write it like \"#ffa500\""), "{error}");
    for bad in ["#+12345", "#ffa5001", "#fffffg", "#ä1234", ""] {
        refusal(&ours(&format!(r#"{{"id": 3, "place": [0, 0], "color": "{bad}"}}"#)));
    }
}

#[test]
fn what_is_missing_or_of_another_kind() {
    for (pixel, part) in [
        (r##"{"place": [0, 0], "color": "#ffffff"}"##, "pixel number 1 of the list: the id is missing"),
        (r##"{"id": 1, "color": "#ffffff"}"##, "pixel 1: the place is missing"),
        (r##"{"id": 1, "place": [0], "color": "#ffffff"}"##, "too few numbers"),
        (r##"{"id": 1, "place": [0, 1, 2], "color": "#ffffff"}"##, "more than two numbers"),
        (
            r##"{"id": -1, "place": [0, 0], "color": "#ffffff"}"##,
            "id is -1; give it a whole number from 0 on",
        ),
        (r##"{"id": 1.5, "place": [0, 0], "color": "#ffffff"}"##, "id is 1.5"),
        (r##"{"id": 1, "place": 7, "color": "#ffffff"}"##, "expected a list in [ ], found '7'"),
    ] {
        let error = refusal(&ours(pixel));
        assert!(error.contains(part), "{error}");
    }
    assert!(refusal("{\"lightbots\": 1}").contains("the list \"frames\" is missing"));
    assert!(refusal("{\"lightbots\": 2, \"frames\": []}").contains("format version 2"));
    let error =
        refusal("{\"lightbots\": 1, \"frames\": [{\"name\": \"A\", \"easing\": \"slow\", \"pixels\": []}]}");
    assert!(error.contains("easing is \"slow\"; it can be \"swift\" or \"gentle\""), "{error}");
}

#[test]
fn files_without_bounds() {
    let spaces = read(&vec![b' '; 100_000_000], Some("json")).unwrap_err().to_string();
    assert_eq!(spaces, "the file has 100.0 MB; a show has at most 67.1 MB (64 MiB): split it into several");
    let deep = refusal(&format!("{{\"x\": {}", "[".repeat(100_000)));
    assert!(deep.contains("more than 32 lists in each other"), "{deep}");
    let frames = format!("[{}]", vec!["{\"name\":\"\",\"airTime\":0,\"pixels\":[]}"; 10_001].join(","));
    assert!(refusal(&frames).contains("more than 10000 frames"));
    let pixel = r##"{"id":1,"place":[0,0],"color":"#ffffff"}"##;
    assert!(refusal(&ours(&vec![pixel; 20_001].join(","))).contains("more than 20000 pixels"));
}

#[test]
fn unknown_fields_are_told_once() {
    let pixel = r##"{"id": 1, "place": [0, 0], "color": "#ffffff", "glow": [1, {"a": 2}]}"##;
    let loaded = read(ours(&[pixel; 3].join(",")).as_bytes(), None).unwrap();
    assert_eq!(loaded.issues.len(), 1);
    assert_eq!(
        loaded.issues[0].message,
        "line 2: the field \"glow\" of the pixel is not known; it is ignored and lost when the show is saved"
    );
}

#[test]
fn frames_of_different_sizes() {
    let found = messages(&show(vec![row(29), row(28), row(29)]));
    assert_eq!(
        found,
        "pixel-count: frame 2 \"Row\": 28 pixels, but other frames have 29; \
         add 1, every robot needs a place in every frame"
    );
    assert_eq!(messages(&show(vec![])), "no-frames: the show has no frames; add one");
    assert!(messages(&show(vec![row(2), vec![]])).contains("empty-frame: frame 2 \"Row\": it has no pixels"));
}

#[test]
fn pixels_too_close_together() {
    let mut broken = show(vec![row(5)]);
    broken.frames[0].pixels[1].at = Vec2::new(-1.4, 0.0);
    broken.frames[0].pixels[3].at = Vec2::new(-1.0 - 0.05, 0.0);
    broken.frames[0].pixels[4].at = Vec2::new(-1.0, 0.0);
    broken.frames[0].pixels[2].at = Vec2::new(-1.0 - 0.05, 0.0555);
    assert_eq!(
        messages(&broken),
        "pixels-overlap: frame 1 \"Row\", pixels 0 and 1: they are on one place; move one away\n\
         pixels-overlap: frame 1 \"Row\", pixels 3 and 4: they are 50.0 mm apart, \
         but robots touch at 54.0 mm; move one away\n\
         pixels-too-close: frame 1 \"Row\", pixels 2 and 3: they are 55.5 mm apart, \
         too close to prove that robots do not touch; leave 57.0 mm"
    );
}

#[test]
fn pixels_off_the_floor_and_ids_given_twice() {
    let mut broken = show(vec![row(3)]);
    broken.frames[0].pixels[0].at = Vec2::new(1.48, 0.0);
    broken.frames[0].pixels[2].id = 1;
    assert_eq!(
        messages(&broken),
        "duplicate-id: frame 1 \"Row\", pixel 1: 2 pixels have this id; give each its own\n\
         pixel-off-floor: frame 1 \"Row\", pixel 0: (1.480, 0.000) is off the 3 m x 3 m floor; \
         keep x within ±1.473 m and y within ±1.473 m"
    );
}

#[test]
fn times_and_stages_that_make_no_sense() {
    for air_time_s in [-1.0, f64::NAN, f64::INFINITY, 1e9] {
        let mut broken = show(vec![row(3)]);
        broken.frames[0].air_time_s = air_time_s;
        let found = messages(&broken);
        assert!(found.starts_with("bad-air-time: frame 1 \"Row\": the air time is"), "{found}");
    }
    for side_m in [0.0, -3.0, f64::NAN, 1e9] {
        let broken = Show { stage: Stage { depth_m: side_m, ..Stage::default() }, ..show(vec![row(3)]) };
        assert!(messages(&broken).starts_with("bad-stage: the stage's depth is"));
    }
    let mut broken = show(vec![row(3)]);
    broken.stage.limits.speed_mps = 0.7;
    assert!(messages(&broken).contains("its wheels make at most 0.598 m/s"));
    broken.stage.limits.radius_m = -1.0;
    assert!(messages(&broken).contains("bad-limits: the robot's radius_m is -1"));
}

#[test]
fn the_list_of_issues_is_bounded() {
    let heap = vec![Pixel { at: Vec2::ZERO, ..row(1).remove(0) }; 10_000];
    let issues = validate(&show(vec![heap; 100]));
    assert!((100..=1_001).contains(&issues.len()), "{}", issues.len());
    let more = issues.iter().find(|issue| issue.message.contains("more like this")).unwrap();
    assert!(!more.pixels.is_empty(), "{more:?}");
}
