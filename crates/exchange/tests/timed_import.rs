//! Files that other programs wrote: the shows that they become, and the files that are refused.

mod zipped;

use lightbots_base::{Rgb, Vec2};
use lightbots_exchange::{Loaded, ReadError, read};
use zipped::archive;

/// A Skybrush show with one drone per pair. A pair has the points of its path and its further settings.
fn skybrush(drones: &[(&str, &str)]) -> String {
    let drone = |(points, more): &(&str, &str)| {
        format!(
            "{{\"type\":\"generic\",\"settings\":{{\"trajectory\":{{\"version\":1,\"points\":{points}}}{more}}}}}"
        )
    };
    let drones: Vec<String> = drones.iter().map(drone).collect();
    format!("{{\"version\":1,\"swarm\":{{\"drones\":[{}]}}}}", drones.join(","))
}

fn open(document: &str) -> Result<Loaded, ReadError> {
    read(&archive(&[("show.json", document.as_bytes())]), Some("a.skyc"))
}

/// The message of the refusal. Panics if the document is read.
fn refusal(document: &str) -> String {
    let error = open(document).expect_err("must not be read").to_string();
    assert!(!error.contains('\n') && error.len() < 400, "{error}");
    error
}

#[test]
fn stands_become_pictures_and_flights_trajectories() {
    let first = "[[0,[0,0,0],[]],[2,[0,0,0],[]],[6,[1,0,9],[[0.2,0.3,5],[0.8,0.3,8]]],[10,[1,0,9],[]],[11,[1,2,0],[]]]";
    let second = "[[0,[0,5,0]],[2.2,[0,5,0]],[5,[0,6,0]],[20,[0,6,0]]]";
    // Red for 8 s, then green: the light changes while the robot stands.
    let lights = ",\"name\":\"D 1\",\"lights\":{\"version\":1,\"data\":\"BP8AAJADBAD/AJADAA==\"}";
    let loaded = open(&skybrush(&[(first, lights), (second, ",\"name\":\"r7\"")])).unwrap();
    let show = &loaded.show;
    let air: Vec<f64> = show.frames.iter().map(|frame| (frame.air_time_s * 1e3).round() / 1e3).collect();
    // The drives include quarter turns of 0.35 s.
    assert_eq!(air, [1.65, 3.65, 9.0]);
    assert_eq!((show.stage.width_m, show.stage.depth_m), (3.0, 13.0));
    assert_eq!(show.starts, Some(vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, 5.0)]));
    let places: Vec<Vec2> = show.frames.iter().map(|frame| frame.pixels[0].at).collect();
    assert_eq!(places, [Vec2::ZERO, Vec2::new(1.0, 0.0), Vec2::new(1.0, 2.0)]);
    assert_eq!(show.frames[0].pixels[0].color, Rgb::new(255, 0, 0));
    assert_eq!(show.frames[2].pixels[1].color, Rgb::new(255, 255, 255), "without lights, a drone is white");
    let robots: Vec<Option<&str>> =
        show.frames[1].pixels.iter().map(|pixel| pixel.robot.as_deref()).collect();
    assert_eq!(robots, [None, Some("r7")], "a robot's name has no blank");
    let ways: Vec<(Option<&str>, u32, usize)> =
        show.trajectories.iter().map(|way| (way.frame.as_deref(), way.pixel, way.pieces.len())).collect();
    assert_eq!(ways, [(Some("f2"), 0, 1), (Some("f2"), 1, 1), (Some("f3"), 0, 1)]);
    let (curve, line) = (&show.trajectories[0], &show.trajectories[1]);
    assert_eq!(curve.pieces[0].controls, Some([Vec2::new(0.2, 0.3), Vec2::new(0.8, 0.3)]));
    assert!((line.at_s - 0.55).abs() < 1e-9 && line.pieces[0].controls.is_none());
    assert_eq!(show.layers.len(), 1, "the change from red to green");
    let codes: Vec<&str> = loaded.issues.iter().map(|issue| issue.code.as_str()).collect();
    assert_eq!(codes, ["flies", "named-robots", "sudden-speeds"]);
    assert_eq!(loaded.issues[0].message, "1 robot flies up to 9.0 m: places on the floor are kept");
}

#[test]
fn robots_that_never_stand_together_have_a_first_and_a_last_picture() {
    let show = open(&skybrush(&[("[[0,[0,0,0]],[2,[1,0,0]]]", ""), ("[[1,[0,5,0]],[3,[1,5,0]]]", "")]))
        .unwrap()
        .show;
    let places: Vec<f64> = show.frames.iter().map(|frame| frame.pixels[0].at.x).collect();
    assert_eq!(places, [0.0, 1.0]);
    assert!(show.frames.iter().all(|frame| frame.air_time_s == 0.0));
    let still = open(&skybrush(&[("[[0,[0,0,0]]]", "")])).unwrap().show;
    assert_eq!((still.frames.len(), still.trajectories.len()), (1, 0));
}

#[test]
fn a_name_means_one_robot() {
    let still = "[[0,[0,0,0]]]";
    let named = ",\"name\":\"r7\"";
    let show = open(&skybrush(&[(still, named), ("[[0,[1,0,0]]]", named)])).unwrap().show;
    let names: Vec<Option<&str>> = show.frames[0].pixels.iter().map(|pixel| pixel.robot.as_deref()).collect();
    assert_eq!(names, [Some("r7"), None]);
}

#[test]
fn parts_in_files_of_their_own_are_read() {
    let document = "{\"version\":1,\"meta\":{\"title\":\"Parts\"},\"swarm\":{\"drones\":[{\"settings\":{\"trajectory\":\
                    {\"$ref\":\"./drones/1/path.json#\"},\"lights\":{\"$ref\":\"./drones/1/lights.json#\"},\
                    \"yawControl\":{\"version\":1}}}]}}";
    let path = b"{\"version\":1,\"points\":[[0,[0,0,0],[]],[5,[1,0,0],[[0.5,1,0]]]],\"takeoffTime\":3}";
    let lights = b"{\"version\":1,\"data\":\"B6MQAA==\"}";
    let files: [(&str, &[u8]); 3] =
        [("show.json", document.as_bytes()), ("drones/1/path.json", path), ("drones/1/lights.json", lights)];
    let loaded = read(&archive(&files), None).unwrap();
    assert_eq!(loaded.show.name, "Parts");
    let [c1, c2] = loaded.show.trajectories[0].pieces[0].controls.unwrap();
    // A quadratic curve becomes a cubic one.
    assert!(
        c1.distance(Vec2::new(1.0 / 3.0, 2.0 / 3.0)) < 1e-12
            && c2.distance(Vec2::new(2.0 / 3.0, 2.0 / 3.0)) < 1e-12
    );
    assert_eq!(loaded.show.frames[0].air_time_s, 2.65, "the take-off is after 3 s");
    assert!(loaded.issues.iter().any(|issue| issue.message.ends_with("left out: yawControl")));
    let error = read(&archive(&files[..2]), None).unwrap_err().to_string();
    assert!(error.contains("drones/1/lights.json\", which is not in the archive"), "{error}");
    let broken = read(&archive(&[files[0], ("drones/1/path.json", b"[1,"), files[2]]), None).unwrap_err();
    assert!(broken.to_string().contains("(in drones/1/path.json)"), "{broken}");
}

#[test]
fn music_in_the_document_or_in_a_file_of_its_own_is_read() {
    let open = |media: &str, files: &[(&str, &[u8])]| {
        let drones = skybrush(&[("[[0,[0,0,0]],[5,[0,0,0]],[9,[1,0,0]],[12,[1,0,0]]]", "")]);
        let document = drones.replacen("\"version\":1,", &format!("\"version\":1,\"media\":{media},"), 1);
        read(&archive(&[&[("show.json", document.as_bytes())], files].concat()), None)
    };
    let inline = "{\"audio\":{\"data\":\"SUQz\",\"mediaType\":\"audio/mpeg\",\"startTime\":0}}";
    let loaded = open(inline, &[]).unwrap();
    assert_eq!(loaded.show.music.as_deref(), Some("music.mp3"));
    let asset = loaded.show.assets.values().next().unwrap();
    assert_eq!(
        (asset.content.as_deref(), asset.media_type.as_str()),
        (Some(b"ID3".as_slice()), "audio/mpeg")
    );
    assert!(loaded.issues.iter().all(|issue| issue.code != "music-moved"));

    let named = "{\"audio\":{\"data\":{\"$ref\":\"assets/a/march.ogg\"},\"mediaType\":\"text/html\",\"startTime\":1.5},\
                 \"video\":1}";
    let loaded = open(named, &[("assets/a/march.ogg", b"OggS")]).unwrap();
    assert_eq!(loaded.show.music.as_deref(), Some("march.ogg"));
    assert_eq!(loaded.show.assets.values().next().unwrap().media_type, "audio/mpeg");
    let messages: Vec<&str> = loaded.issues.iter().map(|issue| issue.message.as_str()).collect();
    assert!(messages.iter().any(|line| line.contains("began 1.50 s after the first frame")), "{messages:?}");
    assert!(messages.iter().any(|line| line.ends_with("left out: media besides music")), "{messages:?}");

    let missing = open(named, &[]).unwrap();
    assert_eq!((missing.show.music, missing.show.assets.len()), (None, 0));
    for (media, part) in [
        (inline.replace("SUQz", "*"), "the sound of the music is not base64"),
        (inline.replace(":0}", ":1e9}"), "it must start within a day"),
    ] {
        let error = open(&media, &[]).unwrap_err().to_string();
        assert!(error.contains(part) && error.ends_with("(in show.json)"), "{error}");
    }
}

#[test]
fn what_is_wrong_in_a_skybrush_show_is_named() {
    for (points, more, part) in [
        ("[[0,[1,2]]]", "", "drone 1: a place has 2 coordinates"),
        ("[[0,[1,NaN,0]]]", "", "drone 1: a coordinate is NaN"),
        ("[[1e999,[1,0,0]]]", "", "drone 1: the time of a point is infinite"),
        ("[[5,[1,0,0]],[2,[1,0,0]]]", "", "drone 1: the place at 2 s stands behind one at 5 s"),
        ("[[5,[1,0,0]],[5,[2,0,0]]]", "", "a robot cannot jump"),
        ("[[1e6,[1,0,0]]]", "", "times go from 0 s to a day"),
        ("[]", "", "it has no place"),
        ("[[0]]", "", "a point has a time and a place"),
        ("[[0,[0,0,0]],[1,[1,0,0],[[0,0,0],[0,0,0],[0,0,0]]]]", "", "3 control points; at most two"),
        ("[[0,[0,0,0]]]", ",\"lights\":{\"version\":1,\"data\":\"*\"}", "not base64"),
        ("[[0,[0,0,0]]]", ",\"lights\":{\"version\":1,\"data\":\"QA==\"}", "operation 0x40"),
        ("[[0,[0,0,0]]]", ",\"lights\":{\"version\":2,\"data\":\"\"}", "its light program has version 2"),
        ("[[0,[0,0,0]]]", ",\"lights\":{\"data\":\"\"}", "the version of its light program is missing"),
    ] {
        let error = refusal(&skybrush(&[(points, more)]));
        assert!(error.contains(part) && error.ends_with("(in show.json)"), "{error}");
    }
    assert!(refusal("{\"version\":1,\"swarm\":{\"drones\":[]}}").contains("0 robots"));
    assert!(refusal("{\"version\":1}").contains("the swarm of the show is missing"));
    assert!(refusal("{\"swarm\":{\"drones\":[]}}").contains("the version of the show is missing"));
    assert!(refusal("{\"version\":3}").contains("the show has version 3"));
    assert!(refusal("{\"version\":1,\"swarm\":{\"drones\":[{}]}}").contains("drone 1: it has no trajectory"));
    assert!(refusal("").contains("the file ends here"));
}

#[test]
fn large_files_end_with_words() {
    let many = |text: &str, count: usize| vec![text; count].join(",");
    let drones = format!("{{\"version\":1,\"swarm\":{{\"drones\":[{}]}}}}", many("{}", 100_000));
    assert!(refusal(&drones).contains("drone 1: it has no trajectory"));
    let point = "[[0,[0,0,0]]]";
    assert!(refusal(&skybrush(&vec![(point, ""); 20_001])).contains("more than 20000 drones"));
    let points: Vec<String> = (0..1_000_100).map(|at| format!("[{at}e-2,[{},0,0]]", at % 7)).collect();
    assert!(
        refusal(&skybrush(&[(&format!("[{}]", points.join(",")), "")])).contains("more than 1000000 pieces")
    );
    let ten_million = format!("[{}]", many("[0,[0,0,0],[]]", 5_000_000));
    let zip = archive(&[("show.json", skybrush(&[(&ten_million, "")]).as_bytes())]);
    assert_eq!(read(&zip, None).unwrap_err().code, "too-big");
    // Twenty thousand drones refer to one large file.
    let lights = format!("{{\"version\":1,\"data\":\"{}\"}}", "AQ".repeat(2_000_000));
    let own = ",\"lights\":{\"$ref\":\"l#\"}";
    let zip =
        archive(&[("show.json", skybrush(&vec![(point, own); 20_000]).as_bytes()), ("l", lights.as_bytes())]);
    let error = read(&zip, None).unwrap_err().to_string();
    assert!(error.contains("too many steps") || error.contains("refer to files"), "{error}");
}

#[test]
fn robots_that_stand_ten_thousand_times_are_too_many_pixels() {
    let moves: Vec<String> = (0..2_000).map(|nth| format!("[{},[{},0,0]]", nth, (nth / 2) % 2)).collect();
    let moving = format!("[{}]", moves.join(","));
    let mut drones = vec![(moving.as_str(), "")];
    drones.resize(1_500, ("[[0,[0,0,0]]]", ""));
    assert!(refusal(&skybrush(&drones)).contains("too many pictures"));
}

fn tables(files: &[(&str, &str)]) -> Result<Loaded, ReadError> {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    read(&archive(&files), Some("a.csv.zip"))
}

#[test]
fn tables_are_read_in_the_order_of_their_names() {
    let head = "time_msec,x_m,y_m,z_m,red,green,blue\r\n";
    let table = |x: u8| {
        format!(
            "{head}0,{x},0,0,255,0,0\r\n1000,{x},0,0,255,0,0\n\n3000,{x},1,0,0,0,255\n4000,{x},1,0,0,0,255\n"
        )
    };
    let loaded = tables(&[
        ("show/r 10.csv", &table(3)),
        ("show/r 9.csv", &table(2)),
        ("show/readme.txt", "hello"),
        ("__MACOSX/show/._r 9.csv", "\u{1}"),
        ("show/r 1.csv", "Time [msec],x [m],y [m],z [m]\n0,1,0,0\n"),
    ]);
    let show = loaded.unwrap().show;
    let places: Vec<f64> = show.starts.unwrap().iter().map(|at| at.x).collect();
    assert_eq!(places, [1.0, 2.0, 3.0]);
    let colours: Vec<String> = show.frames[1].pixels.iter().map(|pixel| pixel.color.to_string()).collect();
    assert_eq!(colours, ["#ffffff", "#0000ff", "#0000ff"]);
}

#[test]
fn what_is_wrong_in_a_table_is_named_with_its_line() {
    let head = "Time [msec],x [m],y [m],z [m],Red,Green,Blue\n";
    for (rows, part) in [
        (
            "0,0,0,0,1.5,0,0\n",
            "line 2, column 1: \"0,0,0,0,1.5,0,0\": \"1.5\" is no whole number from 0 to 255",
        ),
        ("0,0,0,0,0,0,0\n5,inf,0,0,0,0,0\n", "line 3, column 1: \"5,inf,0,0,0,0,0\": \"inf\" is no number"),
        (
            "9,0,0,0,0,0,0\n5,0,0,0,0,0,0\n",
            "line 3, column 1: the place at 0.005 s stands behind one at 0.009 s",
        ),
        ("", "it has no place"),
        ("0,0\n", "2 columns"),
    ] {
        let error = tables(&[("a.csv", &format!("{head}{rows}"))]).unwrap_err().to_string();
        assert!(error.contains(part) && error.ends_with("(in the table \"a.csv\")"), "{error}");
    }
    let error = tables(&[("a.csv", "0,0,0,0\n")]).unwrap_err().to_string();
    assert!(error.contains("the first line is not"), "{error}");
    let good = format!("{head}0,0,0,0,0,0,0\n");
    assert!(
        tables(&[("a/r.csv", &good), ("b/r.csv", &good)]).unwrap_err().to_string().contains("two tables")
    );
    assert_eq!(tables(&[("../r.csv", &good)]).unwrap_err().code, "bad-path");
}

/// A VVIZ file of one performance.
fn vviz(home: &str, steps: &str, actions: &str) -> String {
    format!(
        "{{\"version\":\"1.0\",\"defaultPositionRate\":2,\"defaultColorRate\":10,\"timeOffsetSecs\":1,\"performances\":[{{\"id\":0,\
         \"agentDescription\":{{{home},\"agentTraversal\":[{steps}]}},\
         \"payloadDescription\":[{{\"type\":\"Pyro\"}},{{\"type\":\"Light\",\"payloadActions\":[{actions}]}}]}}]}}"
    )
}

const HOME: &str = "\"homeX\":1,\"homeY\":0.5,\"homeZ\":-2,\"homeH\":90";

#[test]
fn steps_of_vviz_are_added_up() {
    let steps = "{\"dx\":1,\"dy\":2,\"dz\":3},{\"dx\":0,\"dz\":1,\"dt\":4}";
    let file = vviz(HOME, steps, "{\"r\":255,\"g\":0,\"b\":0,\"frames\":45},{\"r\":0,\"g\":255,\"b\":0}");
    let loaded = read(file.as_bytes(), Some("a.vviz")).unwrap();
    let show = &loaded.show;
    assert_eq!(show.starts, Some(vec![Vec2::new(1.0, -2.0)]));
    let ends: Vec<(f64, Vec2)> =
        show.trajectories[0].pieces.iter().map(|piece| (piece.end_s, piece.end)).collect();
    assert_eq!(ends, [(0.5, Vec2::new(2.0, 1.0)), (4.5, Vec2::new(2.0, 2.0))]);
    let codes: Vec<&str> = loaded.issues.iter().map(|issue| issue.code.as_str()).collect();
    assert_eq!(codes, ["flies", "sudden-speeds", "parts-left-out"]);
}

#[test]
fn what_is_wrong_in_vviz_is_named() {
    let refusal = |file: &str| {
        let error = read(file.as_bytes(), Some("a.vviz")).expect_err("must not be read").to_string();
        assert!(!error.contains('\n') && error.len() < 400, "{error}");
        error
    };
    for (home, steps, actions, part) in [
        ("\"homeX\":1", "", "", "performance 1: the number \"homeY\" is missing"),
        (HOME, "{\"dx\":NaN}", "", "dx is NaN"),
        (HOME, "{\"dx\":1,\"dt\":-9}", "", "times go from 0 s to a day"),
        (HOME, "{\"dx\":1e9}", "", "none within 100 km"),
        (HOME, "", "{\"r\":300}", "\"r\" is 300; it must be 0 to 255"),
        (HOME, "", "{\"frames\":-1}", "a colour lasts -1 frames"),
        (HOME, "", "{\"frames\":1e9}", "lasts longer than a day"),
    ] {
        let error = refusal(&vviz(home, steps, actions));
        assert!(error.contains(part), "{error}");
    }
    let good = vviz(HOME, "", "");
    assert!(refusal(&good.replace("\"1.0\"", "\"2.0\"")).contains("another version"));
    assert!(refusal(&good.replace("Rate\":2", "Rate\":0")).contains("0.01 to 1000"));
    assert!(refusal(&good.replace("{\"v", "{\"coordinateFrame\":\"unity\",\"v")).contains("not \"ogl\""));
    for end in 1..good.len() {
        assert!(read(&good.as_bytes()[..end], None).is_err(), "cut at {end}");
    }
}
