use super::*;
use crate::seeded::Seeded;
use lightbots_base::Rgb;
use lightbots_base::Span;
use lightbots_show::{Easing, Obstacle, Pixel, Stage};

fn frame(places: &[(u32, f64, f64)]) -> Frame {
    let pixel = |&(id, x, y): &(u32, f64, f64)| Pixel {
        id,
        at: Vec2::new(x, y),
        color: Rgb::default(),
        ..Pixel::default()
    };
    Frame {
        name: String::new(),
        air_time_s: 1.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels: places.iter().map(pixel).collect(),
        ..Frame::default()
    }
}

fn of(frames: Vec<Frame>) -> Show {
    Show {
        name: "test".into(),
        stage: Stage::default(),
        identity: Identity::Any,
        starts: None,
        music: None,
        frames,
        ..Show::default()
    }
}

/// Plans a show without validating it.
fn show(show: &Show, starts: &[Vec2], options: &ShowOptions) -> ShowPlan {
    whole(show, starts, options, &OneThread, Cancel::NEVER)
}

/// Starts of three robots, stage metres.
const STARTS: [Vec2; 3] = [Vec2::new(-0.5, 1.3), Vec2::new(0.0, 1.3), Vec2::new(0.5, 1.3)];

fn codes(plan: &ShowPlan) -> Vec<&str> {
    plan.issues.iter().map(|issue| issue.code.as_str()).collect()
}

#[test]
fn frames_follow_each_other_from_the_starts() {
    let first = frame(&[(0, 0.5, 0.0), (1, -0.5, 0.0), (2, 0.0, 0.2)]);
    let second = frame(&[(0, -0.5, -0.5), (1, 0.5, -0.5), (2, 0.0, -0.5)]);
    let plan = show(&of(vec![first, second]), &STARTS, &ShowOptions::default());
    assert!(plan.ok() && plan.issues.is_empty());
    assert_eq!(plan.mapping, [[Some(1), Some(2), Some(0)], [Some(0), Some(2), Some(1)]]);
    for (before, after) in plan.transitions.iter().zip(&plan.transitions[1..]) {
        for (path, next) in before.paths.iter().zip(&after.paths) {
            assert_eq!(path.as_ref().end(), next.start);
        }
    }
    let driven: f64 = plan.transitions.iter().map(|transition| transition.duration.as_secs()).sum();
    assert!((plan.duration_s - driven - 2.0).abs() < 1e-9);
    assert!(plan.lower_bound_s > 2.0 && plan.lower_bound_s < plan.duration_s);
    assert!(plan.closest.unwrap().closest.distance_m > 0.3);
}

#[test]
fn frames_that_miss_their_absolute_times_say_what_would_resolve_that() {
    let show_of = |at_s: Option<f64>| {
        let first = frame(&[(0, 0.5, 0.0), (1, -0.5, 0.0), (2, 0.0, 0.2)]);
        let second = Frame { at_s, ..frame(&[(0, -0.5, -0.5), (1, 0.5, -0.5), (2, 0.0, -0.5)]) };
        show(&of(vec![first, second]), &STARTS, &ShowOptions::default())
    };
    let begins_s = 1.0 + show_of(None).transitions[1].duration.as_secs();
    assert!(show_of(Some(begins_s + 0.04)).issues.is_empty());
    let early = show_of(Some(begins_s + 2.0));
    assert_eq!((codes(&early), early.ok()), (vec!["not-in-time"], true));
    assert!(
        early.issues[0].message.contains("let the frame before it stand 2.00 s longer"),
        "{:?}",
        early.issues
    );
    let late = show_of(Some(begins_s - 0.5));
    assert!(late.issues[0].message.contains("make the frames before it 0.50 s shorter"), "{:?}", late.issues);
}

#[test]
fn fixed_identity_keeps_every_id_on_its_robot() {
    let first = frame(&[(4, -0.5, 0.0), (7, 0.0, 0.0), (9, 0.5, 0.0)]);
    let second = frame(&[(4, 0.5, -0.9), (7, 0.0, -0.4), (9, -0.5, -0.6)]);
    let third = frame(&[(7, 0.3, 0.3), (9, 0.6, 0.3)]);
    let options = ShowOptions { identity: Some(Identity::Fixed), ..ShowOptions::default() };
    let plan = show(&of(vec![first, second, third]), &STARTS, &options);
    assert!(plan.ok(), "{:?}", plan.issues);
    assert_eq!(plan.mapping[0], [Some(4), Some(7), Some(9)]);
    assert_eq!(plan.mapping[1], plan.mapping[0]);
    assert_eq!(plan.mapping[2], [None, Some(7), Some(9)]);
    let longest = plan.transitions[0].paths.iter().zip(&plan.transitions[1].paths);
    let longest =
        longest.map(|(from, to)| from.as_ref().end().distance(to.as_ref().end())).fold(0.0, f64::max);
    assert!((plan.transitions[1].lower_bound_s - longest / 0.27).abs() < 1e-9);
}

#[test]
fn a_named_robot_shows_its_pixel() {
    let mut first = frame(&[(0, -0.5, 0.0), (1, 0.0, 0.0), (2, 0.5, 0.0)]);
    first.pixels[2].robot = Some("left".into());
    let mut second = frame(&[(0, -0.5, -0.4), (1, 0.0, -0.4), (2, 0.5, -0.4)]);
    second.pixels[0].robot = Some("left".into());
    second.pixels[1].robot = Some("nobody".into());
    let both = of(vec![first, second]);
    let robots = ["left", "middle", "right"].map(String::from).to_vec();
    let plan = show(&both, &STARTS, &ShowOptions { robots, ..ShowOptions::default() });
    assert_eq!((plan.mapping[0][0], plan.mapping[1][0]), (Some(2), Some(0)));
    // Only the robot that a pixel asks for may show it.
    assert_eq!(codes(&plan), ["unknown-robot"]);
    assert!(!plan.mapping[1].contains(&Some(1)));
    // If names are not known, a name still means one robot: the first that showed a pixel with this name.
    let plan = show(&both, &STARTS, &ShowOptions::default());
    assert!(plan.ok() && plan.issues.is_empty());
    let robot = plan.mapping[0].iter().position(|&id| id == Some(2)).unwrap();
    assert_eq!(plan.mapping[1][robot], Some(0));
}

#[test]
fn what_is_wrong_is_said_with_its_pixels() {
    let mut close = of(vec![frame(&[(3, 0.0, 0.0), (5, 0.04, 0.0)]), frame(&[(3, 0.2, 0.0), (5, 0.5, 0.0)])]);
    let plan = show(&close, &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), ["too-close"]);
    assert_eq!((plan.issues[0].frame, &plan.issues[0].pixels[..]), (Some(0), &[3, 5][..]));
    assert_eq!(plan.transitions.len(), 2);
    close.frames = vec![frame(&[(1, 1.48, 0.0)]), frame(&[(2, 0.5, 0.5)])];
    close.stage.obstacles = vec![Obstacle::Disc { at: Vec2::new(0.5, 0.5), radius_m: 0.1 }];
    let plan = show(&close, &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), ["off-floor", "in-obstacle"]);
    let many = of(vec![frame(&[(0, -0.5, 0.0), (1, 0.0, 0.0), (2, 0.5, 0.0), (3, 0.0, 0.5)])]);
    let plan = show(&many, &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), ["too-few-robots"]);
    assert_eq!(plan.issues[0].pixels, [3]);
}

#[test]
fn a_time_too_short_is_a_warning_that_names_the_least() {
    let mut far = frame(&[(0, -0.5, 0.22), (1, 0.0, 0.22), (2, 0.5, 0.22)]);
    far.transition_s = Some(2.0);
    let mut back = frame(&[(0, -0.5, 1.3), (1, 0.0, 1.3), (2, 0.5, 1.3)]);
    back.transition_s = Some(9.5);
    let plan = show(&of(vec![far, back]), &STARTS, &ShowOptions::default());
    // 1.08 m at 0.27 m/s, a quarter turn and a ramp: 4.62 s.
    assert!(plan.ok() && codes(&plan) == ["takes-longer"], "{:?}", plan.issues);
    assert!(plan.issues[0].message.contains("4.62 s") && plan.issues[0].message.contains("2.00 s"));
    let [first, second] = &plan.transitions[..] else { panic!() };
    assert_eq!((first.duration, first.least), (Span::from_millis(4_620), Span::from_millis(4_620)));
    assert_eq!((second.duration, second.least), (Span::from_millis(9_500), Span::from_millis(4_620)));
}

#[test]
fn no_show_panics() {
    let mut seeded = Seeded::new(17);
    let lengths = [0.0, -1.0, 1e-9, 0.05, 3.0, 1e6, f64::NAN, f64::INFINITY];
    for case in 0..200 {
        let frames = (0..seeded.below(4)).map(|_| {
            let count = seeded.below(6) as u32;
            let places: Vec<(u32, f64, f64)> =
                (0..count).map(|id| (id, seeded.between(-2.0, 2.0), seeded.between(-2.0, 2.0))).collect();
            let mut frame = frame(&places);
            frame.transition_s = (seeded.below(2) == 0).then(|| lengths[seeded.below(lengths.len())]);
            frame.air_time_s = lengths[seeded.below(lengths.len())];
            frame.easing = if seeded.below(2) == 0 { Easing::Gentle } else { Easing::Swift };
            frame
        });
        let mut odd = of(frames.collect());
        if case % 2 == 0 {
            odd.stage.width_m = lengths[seeded.below(lengths.len())];
            let limits = &mut odd.stage.limits;
            let strange = lengths[seeded.below(lengths.len())];
            match seeded.below(4) {
                0 => limits.radius_m = strange,
                1 => limits.speed_mps = strange,
                2 => limits.accel_mps2 = strange,
                _ => limits.turn_radps = strange,
            }
        }
        let starts = &STARTS[..seeded.below(4)];
        let identity = [None, Some(Identity::Any), Some(Identity::Fixed)][seeded.below(3)];
        let plan = show(&odd, starts, &ShowOptions { identity, ..ShowOptions::default() });
        assert_eq!(plan.transitions.len(), odd.frames.len());
        assert_eq!(plan.mapping.len(), odd.frames.len());
    }
}

#[test]
fn a_pixel_that_loses_its_robot_and_gets_no_other_is_told_to_stay_dark() {
    let first = asking(0.5, [None, None, Some("anna")]);
    let mut second = asking(0.0, [Some("anna"), None, None]);
    second.pixels.insert(2, Pixel { id: 5, at: Vec2::new(0.0, -0.5), ..Pixel::default() });
    let mut show_of = of(vec![first, second]);
    show_of.identity = Identity::Fixed;
    let plan = show(&show_of, &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), ["too-few-robots", "robot-bound-to-another"]);
    assert_eq!((&plan.issues[0].pixels[..], &plan.issues[1].pixels[..]), (&[2][..], &[2][..]));
    assert!(plan.issues[1].message.ends_with("pixel 2 stays dark"), "{}", plan.issues[1].message);
}

/// A frame whose pixels stand in a row and ask for robots by name, `None` for any.
fn asking(y: f64, names: [Option<&str>; 3]) -> Frame {
    let mut frame = frame(&[(0, -0.5, y), (1, 0.0, y), (2, 0.5, y)]);
    for (pixel, name) in frame.pixels.iter_mut().zip(names) {
        pixel.robot = name.map(str::to_owned);
    }
    frame
}

#[test]
fn two_names_are_two_robots_even_where_no_frame_asks_for_both() {
    // The robot nearest to the pixel that asks for bert is anna.
    let [first, second] = [("anna", 0.5), ("bert", 0.0)].map(|(name, y)| asking(y, [Some(name), None, None]));
    let both = asking(-0.5, [Some("anna"), Some("bert"), None]);
    let plan = show(&of(vec![first, second, both]), &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), Vec::<&str>::new());
    let shows = |frame: usize, id: u32| plan.mapping[frame].iter().position(|&shown| shown == Some(id));
    assert_ne!(shows(0, 0), shows(1, 0));
    assert_eq!((shows(2, 0), shows(2, 1)), (shows(0, 0), shows(1, 0)));
}

#[test]
fn a_name_that_takes_another_pixels_robot_is_told() {
    let mut show_of =
        of(vec![asking(0.5, [Some("anna"), None, None]), asking(0.0, [None, Some("anna"), None])]);
    show_of.identity = Identity::Fixed;
    let plan = show(&show_of, &STARTS, &ShowOptions::default());
    assert_eq!(codes(&plan), ["robot-bound-to-another"]);
    assert_eq!((plan.issues[0].frame, plan.issues[0].pixels.as_slice()), (Some(1), &[0][..]));
    assert!(plan.ok());
}
