//! Numbers that no sensible show contains. Validation and planning must end with any of them, and report faults in
//! short lines.

use std::cell::Cell;

use lightbots_base::{Limits, Rgb, Vec2};
use lightbots_exchange::{FORMATS, read};
use lightbots_plan::{ShowOptions, TransitionProblem, show_unless, transition_unless};
use lightbots_show::{
    Easing, Frame, Identity, Issue, Obstacle, Pixel, Show, Stage, back_rows, robots_needed, validate,
};

/// Replacements for the numbers of a file.
const WORDS: [&str; 16] = [
    "0",
    "-1",
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "1e300",
    "1e155",
    "1e9",
    "20000",
    "1e-9",
    "1e-155",
    "1e-300",
    "1e-320",
    "5e-324",
    "1e999",
    "4294967296",
];
/// Most cancellation checks of a plan of three robots: far more than any needs, far fewer than an endless plan makes.
const ENOUGH: u64 = 200_000;

fn seed_show() -> Show {
    let frame = |y: f64, shift: usize| Frame {
        name: "a".into(),
        air_time_s: 1.5,
        transition_s: Some(6.5),
        easing: Easing::Gentle,
        identity: Some(Identity::Fixed),
        pixels: (0..3)
            .map(|id| Pixel {
                id,
                at: Vec2::new(((id as usize + shift) % 3) as f64 * 0.25 - 0.25, y),
                color: Rgb::new(255, 165, 0),
                ..Pixel::default()
            })
            .collect(),
        ..Frame::default()
    };
    let obstacles = vec![
        Obstacle::Disc { at: Vec2::new(-1.1, 0.15), radius_m: 0.2 },
        Obstacle::Rect { min: Vec2::new(0.6, -0.4), max: Vec2::new(0.9, 0.35) },
    ];
    Show {
        stage: Stage { obstacles, ..Stage::default() },
        starts: Some(vec![Vec2::new(0.1, 1.2), Vec2::new(0.35, 1.2), Vec2::new(-0.2, 1.2)]),
        frames: vec![frame(0.5, 0), frame(-0.45, 1)],
        ..Show::default()
    }
}

/// A change that puts a number into a show.
type Change<'a> = &'a dyn Fn(&mut Show);

/// Validates and plans a show as the program does. Returns whether it is valid.
fn take(show: &Show, what: &str) -> bool {
    let issues = validate(show);
    let starts = show.starts.clone().unwrap_or_else(|| back_rows(&show.stage, robots_needed(show).min(100)));
    let asked = Cell::new(0);
    let is_wanted = || {
        asked.set(asked.get() + 1);
        asked.get() > ENOUGH
    };
    let plan = show_unless(show, &starts, &ShowOptions::default(), &is_wanted);
    let plan = plan.unwrap_or_else(|_| panic!("{what} is planned without end"));
    for issue in issues.iter().chain(&plan.issues) {
        assert!(!issue.message.contains('\n') && issue.message.len() < 500, "{what}: {}", issue.message);
    }
    let is_fit = !issues.iter().any(Issue::is_error);
    assert!(is_fit || plan.transitions.is_empty(), "{what} is planned though {:?}", issues[0]);
    assert!(!is_fit || plan.transitions.len() == show.frames.len(), "{what}");
    is_fit
}

/// The ranges of the numbers in a text.
fn numbers(text: &str) -> Vec<std::ops::Range<usize>> {
    let is_part = |byte: u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E');
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let begins = bytes[at].is_ascii_digit() || bytes[at] == b'-';
        let end = (at..bytes.len()).find(|&end| !is_part(bytes[end])).unwrap_or(bytes.len());
        if begins && end > at {
            found.push(at..end);
        }
        at = end.max(at + 1);
    }
    found
}

#[test]
fn every_number_of_a_document_may_be_any_number() {
    assert!(take(&seed_show(), "the seed"));
    let (mut fit, mut unfit) = (0, 0);
    for format in FORMATS.into_iter().filter(|format| !format.needs_plan) {
        // An archive holds the text of another format. Its bytes are tested in `exchange`.
        let Ok(text) = String::from_utf8(format.write(&seed_show(), None).bytes) else { continue };
        let places = numbers(&text);
        assert!(places.len() > 20, "{}", places.len());
        for place in places {
            for word in WORDS {
                let mut other = text.clone();
                other.replace_range(place.clone(), word);
                let Ok(loaded) = read(other.as_bytes(), None) else { continue };
                let around = text[place.start.saturating_sub(30)..place.start].replace('\n', " ");
                let is_fit = take(&loaded.show, &format!("{word} after {around}"));
                *(if is_fit { &mut fit } else { &mut unfit }) += 1;
            }
        }
    }
    assert!(fit > 20 && unfit > 200, "{fit} {unfit}");
}

#[test]
fn values_that_no_file_holds_are_no_shows() {
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MIN_POSITIVE, -0.0] {
        let changes: [(&str, Change); 9] = [
            ("x", &|show| show.frames[1].pixels[2].at.x = value),
            ("air time", &|show| show.frames[0].air_time_s = value),
            ("transition", &|show| show.frames[1].transition_s = Some(value)),
            ("width", &|show| show.stage.width_m = value),
            ("radius", &|show| show.stage.limits.radius_m = value),
            ("speed", &|show| show.stage.limits.speed_mps = value),
            ("turn", &|show| show.stage.limits.turn_radps = value),
            ("start", &|show| show.starts.as_mut().unwrap()[1].y = value),
            ("disc", &|show| {
                show.stage.obstacles[0] = Obstacle::Disc { at: Vec2::new(value, 1.0), radius_m: value };
            }),
        ];
        for (name, change) in changes {
            let mut show = seed_show();
            change(&mut show);
            take(&show, &format!("{value} as {name}"));
        }
    }
}

#[test]
fn robots_may_say_that_they_are_anywhere() {
    let numbers = WORDS.iter().map(|word| word.parse::<f64>().unwrap());
    for value in numbers.chain([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]) {
        let base = TransitionProblem {
            starts: vec![Vec2::new(-0.5, 1.0), Vec2::new(0.0, 1.0), Vec2::new(0.5, 1.0)],
            goals: vec![Vec2::new(0.5, -0.5), Vec2::new(0.0, -0.5)],
            ..TransitionProblem::on_floor(Vec2::new(1.5, 1.5), Limits::default())
        };
        let mut problems = vec![base.clone(); 7];
        problems[0].starts[1].x = value;
        problems[1].goals[1].y = value;
        problems[2].standing = vec![Vec2::new(value, value)];
        problems[3].half_floor.x = value;
        problems[4].obstacles = vec![Obstacle::Rect { min: Vec2::ZERO, max: Vec2::new(value, value) }];
        problems[5].limits.radius_m = value;
        problems[6].limits.accel_mps2 = value;
        for (which, problem) in problems.iter().enumerate() {
            for problem in
                [problem.clone(), TransitionProblem { pinned: vec![Some(2), Some(0)], ..problem.clone() }]
            {
                let asked = Cell::new(0);
                let is_wanted = || {
                    asked.set(asked.get() + 1);
                    asked.get() > ENOUGH
                };
                let planned = transition_unless(&problem, &is_wanted);
                let planned = planned.unwrap_or_else(|_| panic!("{value} in {which} is planned without end"));
                if let Err(stuck) = planned {
                    assert!(stuck.message.len() < 500, "{}", stuck.message);
                }
            }
        }
    }
}

#[test]
fn a_place_off_every_floor_is_said_in_a_line_that_names_it() {
    let mut show = seed_show();
    show.frames[1].pixels[2].at.y = 1e308;
    let plan = show_unless(&show, &[], &ShowOptions::default(), &|| false).unwrap();
    let [issue] = &plan.issues[..] else { panic!("{:?}", plan.issues) };
    assert_eq!((issue.code.as_str(), issue.frame, &issue.pixels[..]), ("pixel-off-floor", Some(1), &[2][..]));
    assert!(issue.message.contains("1e308") && issue.message.contains("keep x within"), "{}", issue.message);
}
