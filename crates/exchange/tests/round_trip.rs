//! The parts of a show that a format keeps come back unchanged from its files.

mod extras;
mod played;

use lightbots_base::{Limits, Rgb, Vec2};
use lightbots_exchange::{FORMATS, LIGHTBOTS, ORIGINAL, Part, for_file, named, read, sniff};
use lightbots_plan::ShowPlan;
use lightbots_show::{
    Easing, Frame, Identity, Obstacle, PictureMotion, Pixel, Show, Stage, validate, with_floor,
};

/// A show that uses every field of version 1.
fn rich() -> Show {
    let pixel = |id: u32, x: f64| Pixel {
        id,
        at: Vec2::new(x, -0.1234),
        color: Rgb::new(id as u8, 165, 0),
        robot: (id == 2).then(|| "abfe6805".to_owned()),
        ..Pixel::default()
    };
    let frame = |name: &str, easing, identity: Option<Identity>| Frame {
        name: name.into(),
        air_time_s: 0.25,
        transition_s: identity.map(|_| 12.5),
        easing,
        identity,
        pixels: vec![pixel(0, -0.5), pixel(2, 0.0), pixel(9, 0.75)],
        ..Frame::default()
    };
    Show {
        name: "All \"fields\"\\\n\u{7f}ä😀".into(),
        stage: Stage {
            width_m: 4.5,
            depth_m: 2.0,
            obstacles: vec![
                Obstacle::Disc { at: Vec2::new(1.0, 0.5), radius_m: 0.2 },
                Obstacle::Rect { min: Vec2::new(-1.0, 0.25), max: Vec2::new(-0.5, 0.5) },
            ],
            limits: Limits { accel_mps2: 0.5, ..Limits::default() },
        },
        identity: Identity::Fixed,
        starts: Some(vec![Vec2::new(-0.1, 0.8), Vec2::new(0.0, 0.8), Vec2::new(0.1, 0.8)]),
        music: Some("march.ogg".into()),
        frames: vec![frame("one", Easing::Swift, None), frame("", Easing::Gentle, Some(Identity::Any))],
        ..Show::default()
    }
}

#[test]
fn ours_keeps_everything() {
    let show = rich();
    assert_eq!(validate(&show), []);
    let loaded = read(&LIGHTBOTS.write(&show, None).bytes, None).unwrap();
    assert!(loaded.has_stage && loaded.issues.is_empty());
    assert_eq!(loaded.show, show);
}

#[test]
fn our_layout_is_a_pixel_a_line() {
    let mut show = rich();
    show = Show { stage: Stage::default(), starts: None, music: None, identity: Identity::Any, ..show };
    show.name = "Two".into();
    show.frames.truncate(1);
    show.frames[0].pixels.truncate(2);
    let expected = r##"{
  "lightbots": 1,
  "name": "Two",
  "stage": {
    "width_m": 3,
    "depth_m": 3
  },
  "frames": [
    {
      "name": "one",
      "air_time_s": 0.25,
      "pixels": [
        { "id": 0, "place": [-0.5, -0.1234], "color": "#00a500" },
        { "id": 2, "place": [0, -0.1234], "color": "#02a500", "robot": "abfe6805" }
      ]
    }
  ]
}
"##;
    assert_eq!(String::from_utf8(LIGHTBOTS.write(&show, None).bytes).unwrap(), expected);
}

#[test]
fn the_originals_format_has_every_field_its_editor_needs() {
    let json: serde_json::Value = serde_json::from_slice(&ORIGINAL.write(&rich(), None).bytes).unwrap();
    let frame = &json[0];
    assert_eq!((&frame["selected"], &json[1]["selected"]), (&true.into(), &false.into()));
    assert_eq!((&frame["airTime"], &frame["selectedPixels"]), (&0.25.into(), &serde_json::json!([])));
    let pixel = &frame["pixels"][2];
    let canvas = serde_json::json!({"X": 540.0, "Y": 389.616});
    assert_eq!(pixel["pixelId"], 2, "numbered without gaps");
    assert_eq!(pixel["physicalLocation"], serde_json::json!({"X": 0.75, "Y": -0.1234}));
    assert_eq!((&pixel["pixelLocation"], &pixel["pixelPreviewLocation"]), (&canvas, &canvas));
    assert_eq!(pixel["pixelTimelineLocation"], serde_json::json!({"X": 75.0, "Y": 54.1133}));
    assert_eq!(pixel["color"], pixel["previewColor"]);
    assert_eq!(pixel["color"]["G"], 0.6470588445663452);
}

#[test]
fn every_colour_survives_the_originals_format() {
    let mut show = rich();
    show.frames.truncate(1);
    for byte in 0..=255 {
        show.frames[0].pixels.truncate(1);
        show.frames[0].pixels[0].color = Rgb::new(byte, 0, 255 - byte);
        let back = read(&ORIGINAL.write(&show, None).bytes, None).unwrap().show;
        assert_eq!(back.frames, show.frames);
        let rounded = format!(
            "[{{\"name\":\"\",\"airTime\":0,\"pixels\":[{{\"pixelId\":0,\"physicalLocation\":{{\"X\":0,\"Y\":0}},\
             \"color\":{{\"R\":{:.3},\"G\":0,\"B\":1}}}}]}}]",
            f64::from(byte) / 255.0
        );
        assert_eq!(read(rounded.as_bytes(), None).unwrap().show.frames[0].pixels[0].color.r, byte);
    }
}

#[test]
fn every_motion_comes_back_and_a_wrong_one_names_its_place() {
    let at = |x: f64| Vec2::new(x, -0.123_456_789);
    for motion in [
        PictureMotion::Travel { along: vec![at(0.1), at(0.2)] },
        PictureMotion::Turn { center: at(0.3), turn: -2.5, size: 0.75 },
        PictureMotion::Breathe { center: at(0.4), size: 1.25, times: 3 },
        PictureMotion::Follow { along: vec![at(0.5)] },
        PictureMotion::Wave { radius_m: 0.04, direction: 0.5, length_m: 0.8, times: 2 },
        PictureMotion::Stagger { direction: 3.0, delay_s: 1.5 },
        PictureMotion::Morph { through: vec![vec![at(0.1), at(0.2)], vec![at(0.3), at(0.4)]] },
    ] {
        let mut show = rich();
        show.frames[0].motion = Some(motion);
        let back = read(&LIGHTBOTS.write(&show, None).bytes, None).unwrap();
        assert_eq!((back.show.frames, back.unread), (show.frames, None));
    }
    let wrong = |motion: &str| {
        let text = format!("{{\"lightbots\": 2, \"frames\": [\n{{\"motion\": {motion}, \"pixels\": []}}]}}");
        read(text.as_bytes(), None).unwrap_err().to_string()
    };
    assert!(
        wrong("{\"kind\": \"jump\"}").contains("the kind of motion is \"jump\"; it can be \"travel\" or")
    );
    assert!(wrong("{\"kind\": \"turn\"}").contains("\"turn\" of the motion is missing"));
    assert!(wrong("{\"turn\": 1}").contains("\"kind\" of the motion is missing"));
}

#[test]
fn a_part_that_the_format_does_not_keep_is_a_warning() {
    let lost = ORIGINAL.write(&extras::with_every_part(rich()), None).issues;
    let codes: Vec<&str> = lost.iter().map(|issue| issue.code.as_str()).collect();
    assert_eq!(codes, [vec!["lost-in-format"; Part::SHOW.len() - 1], vec!["not-30-pixels"]].concat());
    assert!(lost.iter().any(|issue| issue.message.contains("no-go areas")));
    assert_eq!(LIGHTBOTS.write(&rich(), None).issues, []);
    let planned = LIGHTBOTS.write(&rich(), Some(&ShowPlan::default())).issues;
    assert_eq!(planned.len(), usize::from(!LIGHTBOTS.keeps(Part::Plan)));
}

#[test]
fn every_format_recognises_its_own_files() {
    let small = played::small_show();
    let plan = played::planned(&small);
    for format in FORMATS {
        let written =
            if format.needs_plan { format.write(&small, Some(&plan)) } else { format.write(&rich(), None) };
        assert_eq!(sniff(&written.bytes), Some(format));
        match read(&written.bytes, None) {
            Ok(loaded) => assert_eq!(loaded.show.frames.len(), if format.needs_plan { 3 } else { 2 }),
            Err(error) => assert_eq!(error.code, "no-places"),
        }
        assert_eq!(named(format.name), Some(format));
        assert_eq!(for_file(&format!("show{}", format.ending())), Some(format));
    }
}

#[test]
fn an_original_carries_no_stage_and_may_lack_what_can_be_derived() {
    let text = r#"[{"pixels": [{"pixelLocation": {"X": 720, "Y": 0}, "pixelId": 1.0,
        "previewColor": {"R": 0, "G": 1, "B": 0.5019608}}], "selected": true}]"#;
    let loaded = read(text.as_bytes(), None).unwrap();
    assert!(!loaded.has_stage);
    assert_eq!(loaded.issues.len(), 1, "no air time");
    let show = with_floor(loaded.show, 4.0, 5.0);
    assert_eq!((show.stage.width_m, show.stage.depth_m), (4.0, 5.0));
    let pixel = &show.frames[0].pixels[0];
    assert_eq!((pixel.at, pixel.color), (Vec2::new(1.5, 1.5), Rgb::new(0, 255, 128)));
}

#[test]
fn a_byte_order_mark_is_no_fault() {
    let bytes = [b"\xef\xbb\xbf".as_slice(), &LIGHTBOTS.write(&rich(), None).bytes].concat();
    assert_eq!(read(&bytes, None).unwrap().show, rich());
}

#[test]
fn ten_thousand_robots_are_read_and_found_sound() {
    let place = |id: u32| Vec2::new(f64::from(id % 100) * 0.2 - 9.9, f64::from(id / 100) * 0.2 - 9.9);
    let pixels =
        (0..10_000).map(|id| Pixel { id, at: place(id), color: Rgb::new(9, 9, 9), ..Pixel::default() });
    let frame = Frame { pixels: pixels.collect(), ..rich().frames.remove(0) };
    let show = with_floor(Show { frames: vec![frame; 10], ..Show::default() }, 24.0, 24.0);
    let loaded = read(&LIGHTBOTS.write(&show, None).bytes, None).unwrap();
    assert_eq!(validate(&loaded.show), []);
    assert_eq!(loaded.show.frames[9].pixels[9_999].id, 9_999);
    assert!((loaded.show.frames[9].pixels[9_999].at - Vec2::new(9.9, 9.9)).length() < 1e-9);
}
