//! Broken and hostile files. Each gives one line with place, cause and remedy.

#[path = "../../show/tests/rows/mod.rs"]
mod rows;

use lightbots_exchange::{LIGHTBOTS, read};
use rows::{row, show};

/// The message of the refusal. Panics if the text is read.
fn refusal(text: &str) -> String {
    read(text.as_bytes(), Some("a.json")).expect_err("must not be read").to_string()
}

/// A show in our format with one frame "A" that has these pixels.
fn ours(pixels: &str) -> String {
    format!("{{\"lightbots\": 1, \"frames\": [{{\"name\": \"A\", \"pixels\": [\n{pixels}]}}]}}")
}

/// A show in the original's format with one frame "A". Its only pixel has these fields.
fn original(pixel: &str) -> String {
    format!("[{{\"name\": \"A\", \"airTime\": 0, \"pixels\": [{{{pixel}, \"pixelId\": 7}}]}}]")
}

#[test]
fn what_is_not_json() {
    assert_eq!(
        refusal("hello"),
        "line 1, column 1: this is not JSON; the show in a .json file is: save the show again"
    );
    assert_eq!(refusal("  \n \t"), "the file is empty; a show has at least one frame");
    assert_eq!(
        refusal("[}"),
        "line 1, column 2, frame 1: expected an object in { }, found '}'; is this a show file?"
    );
    assert_eq!(
        refusal("{\"a\": 1}"),
        "this is JSON, but not a show: the field \"lightbots\" is missing; open another file"
    );
    let picture = read(&[0x89, b'P', b'N', b'G', 0xff], Some("a.png")).unwrap_err().to_string();
    assert!(
        picture.starts_with(
            "line 1, column 1: this is not UTF-8 text; a .png file is not read: open a show of LightBots ("
        ),
        "{picture}"
    );
}

#[test]
fn what_is_cut_off_says_where() {
    let whole = String::from_utf8(LIGHTBOTS.write(&show(vec![row(3), row(3)]), None).bytes).unwrap();
    let cut = &whole[..whole.rfind("#ff").unwrap()];
    let error = read(cut.as_bytes(), None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "line 23, column 50, frame 2 \"Row\", pixel 2: \
         the file ends here, in the middle of the show; save or copy it again"
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
                    y of the place is NaN, not a number; give it a number";
    assert_eq!(error.to_string(), expected);
    assert_eq!((error.issue().frame, error.issue().pixels), (Some(0), vec![5]));

    let color = r#""color": {"R": 1, "G": 0, "B": 0}"#;
    let error = refusal(&original(&format!(r#"{color}, "physicalLocation": {{"X": NaN, "Y": 0.5}}"#)));
    assert!(error.contains("frame 1 \"A\", pixel 7: X is NaN, not a number"), "{error}");
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
    assert!(error.ends_with("pixel 3: \"orange\" is not a colour; write it like \"#ffa500\""), "{error}");
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
            "id is -1; give it a whole number from 0 to 4294967295",
        ),
        (r##"{"id": 1.5, "place": [0, 0], "color": "#ffffff"}"##, "id is 1.5"),
        (r##"{"id": 1, "place": 7, "color": "#ffffff"}"##, "expected a list in [ ], found '7'"),
    ] {
        let error = refusal(&ours(pixel));
        assert!(error.contains(part), "{error}");
    }
    assert!(refusal("{\"lightbots\": 1}").contains("the list \"frames\" is missing"));
    assert!(refusal("{\"lightbots\": 0, \"frames\": []}").contains("no format version 0"));
    let error =
        refusal("{\"lightbots\": 1, \"frames\": [{\"name\": \"A\", \"easing\": \"slow\", \"pixels\": []}]}");
    assert!(error.contains("easing is \"slow\"; it can be \"swift\" or \"gentle\""), "{error}");
}

#[test]
fn files_without_bounds() {
    let spaces = read(&vec![b' '; 100_000_000], Some("a.json")).unwrap_err().to_string();
    assert_eq!(spaces, "the file has 100.0 MB; a show has at most 67.1 MB (64 MiB): split it into several");
    let deep = refusal(&format!("{{\"x\": {}", "[".repeat(100_000)));
    assert!(deep.contains("lists nest more than 32 deep"), "{deep}");
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
        "line 2: the field \"glow\" of the pixel is not known; it is neither played nor converted"
    );
}

#[test]
fn bytes_of_no_format_name_the_endings_of_all() {
    let text = read(b"ID3", Some("march.mp3")).unwrap_err().to_string();
    assert_eq!(
        text,
        "line 1, column 1: this is not JSON; a .mp3 file is not read: \
         open a show of LightBots (.lightbots.json) or of LightBots, with its files (.lightbots.zip) \
         or of the original LightBots (.json) or of Skybrush (.skyc) or of Skybrush, as tables (.csv.zip) \
         or of Finale 3D and other VVIZ programs (.vviz) or of xLights and the Falcon Player (.fseq)"
    );
    let damaged = read(b"[{\"name\": \"\xff\"}]", Some("a.json")).unwrap_err().to_string();
    assert_eq!(
        damaged,
        "line 1, column 12: this is not UTF-8 text; this file is damaged: save or copy it again"
    );
}
