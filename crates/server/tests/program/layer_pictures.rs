//! Pictures that layers project on the floor: a separate process reads them, robots show them, and errors are reported.

use lightbots_exchange::{ARCHIVE, asset_of, read};
use lightbots_show::{Layer, LayerSpan, Setting, Show};
use serde_json::{Value, json};

use crate::run::start;
use crate::screen::Screen;
use crate::{alone, child, http, shows};

/// A GIF of 2 by 1 pixels, blue and red.
const GIF: &[u8] = b"GIF89a\x02\0\x01\0\x80\0\0\0\0\xff\xff\0\0,\0\0\0\0\x02\0\x01\0\0\x02\x02D\n\0;";

/// A PNG whose header claims 31,250 x 32,000 pixels.
const HUGE: &[u8] =
    b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x7a\x12\0\0\x7d\0\x08\x02\0\0\0\x06\x80\x01\x0c\0\0\0\x09IDATx";

/// A show of four robots in a row, and a picture 0.2 m wide over the two in the middle.
fn show(picture: &[u8], name: &str) -> Show {
    let mut show = read(shows::row(4, &[60.0]).as_bytes(), None).unwrap().show;
    let (hash, asset) = asset_of(name, "image/gif", picture.into());
    let settings = vec![
        ("picture".to_owned(), Setting::Text(hash.to_string())),
        ("place".to_owned(), Setting::List(vec![Setting::Number(0.0), Setting::Number(1.2)])),
        ("size_m".to_owned(), Setting::Number(0.2)),
    ];
    show.layers =
        vec![Layer { name: "Halves".into(), kind: "picture".into(), span: LayerSpan::Show, settings }];
    show.assets = [(hash, asset)].into();
    show
}

fn archive(show: &Show) -> String {
    shows::file("picture.lightbots.zip", ARCHIVE.write(show, None).bytes)
}

/// Messages of the issues about pictures.
fn said(plan: &Value) -> Vec<String> {
    let issues = plan["issues"].as_array().unwrap().iter();
    let of_pictures = issues.filter(|issue| issue["code"] == "layer-picture");
    of_pictures.map(|issue| issue["message"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn check_says_which_picture_of_which_layer_cannot_be_shown() {
    let checked = |picture: &[u8]| {
        let (_, text, err) = child::run(&["check", &archive(&show(picture, "sun.gif")), "--json"]);
        said(&serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}{err}")))
    };
    assert_eq!(checked(GIF), [""; 0]);
    for (picture, why) in [
        (&GIF[..20], "The animation is damaged or cut off"),
        (HUGE, "The picture is too large"),
        (b"<svg xmlns='http://www.w3.org/2000/svg'/>", "Save it as PNG."),
        (b"", "The file is empty. Choose another."),
    ] {
        let [message] = checked(picture).try_into().unwrap();
        let begin = "the layer \"Halves\": \"sun.gif\" cannot be shown: ";
        assert!(message.starts_with(begin) && message.contains(why), "{message}");
    }
}

#[test]
fn a_recorded_rehearsal_with_a_picture_is_replayed_to_the_bit() {
    let file = archive(&show(GIF, "sun.gif"));
    let log = shows::folder().join("picture.lblog");
    let log = log.to_str().unwrap();
    let (_, text, err) = child::run(&["rehearse", &file, "--record", log, "--json"]);
    let report: Value = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {err}"));
    assert!(report["lights"]["compared"].as_u64().unwrap() > 100, "{report}");
    assert_eq!(report["lights"]["wrong"], 0);
    assert_eq!(child::run(&["replay", log]).0, 0);
}

#[test]
fn robots_of_the_live_program_show_the_picture_of_a_saved_show() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "4", &archive(&show(GIF, "sun.gif"))]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(4);
    assert_eq!(said(&screen.get("plan")), [""; 0]);
    screen.must(json!({"do": "play", "from": 0, "missing": "refuse"}));
    let own = 0xff_80_00;
    screen.until("the picture", |screen| {
        let robots = screen.get("robots");
        let mut lights: Vec<(f64, u64)> =
            screen.places().iter().map(|place| place.0).zip(numbers(&robots)).collect();
        lights.sort_by(|a, b| a.0.total_cmp(&b.0));
        let colours: Vec<u64> = lights.into_iter().map(|(_, colour)| colour).collect();
        (colours == [own, 0x00_00_ff, 0xff_00_00, own]).then_some(())
    });
    // The document refers to a picture whose file the library does not have.
    let bad = show(&GIF[..20], "moon.gif");
    let document = lightbots_exchange::LIGHTBOTS.write(&bad, None).bytes;
    let missing =
        http::request(&address, "POST", "/api/check", &[], std::str::from_utf8(&document).unwrap()).json();
    let [message] = said(&missing).try_into().unwrap();
    assert!(message.contains("moon.gif") && message.contains("choose the picture again"), "{message}");
}

fn numbers(robots: &Value) -> Vec<u64> {
    robots["colour"]
        .as_array()
        .map(|list| list.iter().filter_map(Value::as_u64).collect())
        .unwrap_or_default()
}
