//! Layers of light: robots show the colours of the layers in time, even if the drive is disturbed.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_lighting::Tolerance;
use lightbots_show::{Cue, CuePlace, Frame, FramePhase, Layer, LayerSpan, Pixel, Setting, Show, Stage};
use lightbots_sim::{Conditions, Faults, Mishap, RehearsalOptions, RehearsalReport, rehearse};

fn layer(kind: &str, span: LayerSpan, settings: Vec<(&str, Setting)>) -> Layer {
    let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    Layer { name: String::new(), kind: kind.into(), span, settings }
}

/// Three layers: a rainbow over the whole show, a chase in drives and a twinkle in pictures.
fn layers() -> Vec<Layer> {
    let frames = |phase| LayerSpan::Frames { first: "0".into(), last: "2".into(), phase };
    let rising =
        ("palette", Setting::List(["#000000", "#ffffff"].map(|text| Setting::Text(text.into())).to_vec()));
    vec![
        layer("rainbow", LayerSpan::Show, vec![("speed_hz", Setting::Number(0.2))]),
        layer(
            "chase",
            frames(FramePhase::Transition),
            vec![rising.clone(), ("blend", Setting::Text("add".into()))],
        ),
        layer("twinkle", frames(FramePhase::Picture), vec![rising, ("blend", Setting::Text("add".into()))]),
    ]
}

/// A show of `count` robots: a row, a ring and a row again.
fn show(count: u32, air_time_s: f64) -> Show {
    let frame = |number: usize| Frame {
        id: Some(number.to_string()),
        air_time_s,
        pixels: (0..count)
            .map(|id| Pixel {
                id,
                at: place(number, id, count),
                color: Rgb::new(255, 80, 0),
                ..Pixel::default()
            })
            .collect(),
        ..Frame::default()
    };
    Show { stage: Stage::default(), frames: (0..3).map(frame).collect(), layers: layers(), ..Show::default() }
}

fn place(frame: usize, id: u32, count: u32) -> Vec2 {
    let share = f64::from(id) / f64::from(count);
    match frame {
        1 => Vec2::unit(share * std::f64::consts::TAU) * (0.2 + 0.02 * f64::from(count)),
        _ => Vec2::new((share - 0.5) * 0.1 * f64::from(count), if frame == 0 { 0.9 } else { -0.8 }),
    }
}

fn play(show: &Show, faults: &str, seed: u64) -> RehearsalReport {
    play_in(show, faults, seed, Conditions::default())
}

fn play_in(show: &Show, faults: &str, seed: u64, conditions: Conditions) -> RehearsalReport {
    let faults = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = faults.added_to(conditions);
    rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// Asserts that at most one in `one_in` of the compared lights is wrong.
fn assert_lit(report: &RehearsalReport, one_in: u64) {
    let (lights, seed) = (report.lights, report.seed);
    assert!(report.contacts == 0 && report.frames_played >= 3, "seed {seed}: {:?}", report.issues);
    assert!(lights.compared > 1_000, "seed {seed}: {lights:?}");
    assert!(lights.wrong * one_in <= lights.compared, "seed {seed}: {lights:?}");
}

#[test]
fn robots_show_what_layers_say_within_25_ms() {
    for seed in 1..=3 {
        assert_lit(&play(&show(12, 14.0), "", seed), 2_000);
    }
}

#[test]
fn lost_messages_are_sent_again_before_they_are_due() {
    for seed in 1..=3 {
        assert_lit(&play(&show(12, 14.0), "loss=5%", seed), 500);
    }
}

#[test]
fn light_stands_in_a_hold_and_goes_on_with_it() {
    for seed in 1..=3 {
        let report = play(&show(12, 4.0), "blind=3@9s+2500ms,loss=5%", seed);
        assert!(report.duration_s > report.planned_s + 0.5, "seed {seed}: robots were never held");
        assert_lit(&report, 500);
    }
}

#[test]
fn light_goes_on_with_the_others_when_a_robot_dies() {
    for seed in 1..=2 {
        let report = play(&show(12, 4.0), "kill=3@9s,loss=2%", seed);
        assert!(report.replans > 0 && report.dropouts == 1, "seed {seed}: {:?}", report.issues);
        assert_lit(&report, 200);
    }
}

/// The operator presses and releases live light while robots drive, stand, and are held.
#[test]
fn live_light_is_shown_within_0_3_s_while_robots_drive_stand_and_are_held() {
    let at = |ms: i64, mishap| (Span::from_millis(ms), mishap);
    for (number, shift) in [0, 700, 1_900, 3_100].into_iter().enumerate() {
        let mut mishaps = vec![at(9_000 + shift, Mishap::Pause), at(14_000 + shift, Mishap::Resume)];
        let presses = [1_000, 2_500, 8_000, 11_000, 12_000, 13_000, 17_000, 30_000].into_iter();
        mishaps.extend(
            presses.zip([true, false].into_iter().cycle()).map(|(ms, on)| at(ms, Mishap::Rainbow(on))),
        );
        mishaps.sort_by_key(|(at, _)| *at);
        for (layers, faults) in
            [(layers(), ""), (Vec::new(), ""), (layers(), "loss=5%"), (Vec::new(), "loss=5%")]
        {
            let show = Show { layers, ..show(12, 4.0) };
            let faults_of =
                if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
            let conditions =
                faults_of.added_to(Conditions { mishaps: mishaps.clone(), ..Conditions::default() });
            let options = RehearsalOptions { seed: number as u64 + 1, conditions, robots: None };
            let report = rehearse(&show, &options, &mut |_| {});
            assert_lit(&report, if faults.is_empty() { 2_000 } else { 100 });
        }
    }
}

/// Effects that move, with their speeds in cycles per second.
const MOVING: [(&str, f64); 12] = [
    ("gradient", 0.1),
    ("fade", 0.25),
    ("pulse", 1.0),
    ("strobe", 1.0),
    ("twinkle", 0.5),
    ("sparkle", 2.0),
    ("wave", 0.5),
    ("ripple", 0.3),
    ("plasma", 0.2),
    ("noise", 0.2),
    ("fire", 0.5),
    ("by-robot", 0.2),
];

/// Two layers: a slow rainbow that stops with show time, and over it an effect that may run freely.
fn over_a_rainbow(kind: &str, speed_hz: f64, runs_freely: bool) -> Vec<Layer> {
    let settings = vec![
        ("speed_hz", Setting::Number(speed_hz)),
        ("wrap", Setting::Text("mirror".into())),
        ("blend", Setting::Text("average".into())),
        ("runs_freely", Setting::Bool(runs_freely)),
    ];
    vec![
        layer("rainbow", LayerSpan::Show, vec![("speed_hz", Setting::Number(0.1))]),
        layer(kind, LayerSpan::Show, settings),
    ]
}

/// The operator pauses in the drive to the second frame, for longer than a stretch of light.
fn paused_on_the_way() -> Conditions {
    let [from, to] = [9_500, 23_500].map(Span::from_millis);
    Conditions { mishaps: vec![(from, Mishap::Pause), (to, Mishap::Resume)], ..Conditions::default() }
}

/// Asserts that robots were held in the drive to the second frame, and in no other.
fn assert_held(report: &RehearsalReport, what: &str) {
    let drives: Vec<f64> = report.per_frame.iter().map(|frame| frame.drive_s).collect();
    assert!(drives[1] > 14.0 && drives[0] < 14.0 && drives[2] < 14.0, "{what}: drives of {drives:?} s");
}

#[test]
fn effects_stand_in_a_pause_or_run_freely_through_it() {
    for (number, (kind, speed_hz)) in MOVING.into_iter().enumerate() {
        for runs_freely in [false, true] {
            let layers = over_a_rainbow(kind, speed_hz, runs_freely);
            let show = Show { layers, ..show(8, 4.0) };
            let report = play_in(&show, "loss=5%", 1 + number as u64, paused_on_the_way());
            assert_held(&report, kind);
            // If the stretch for a hold is lost, the robot's light stops until that stretch is sent again.
            assert_lit(&report, if runs_freely { 300 } else { 500 });
        }
    }
}

#[test]
fn effects_go_on_while_a_frame_waits_for_go() {
    for (number, (kind, speed_hz)) in MOVING.into_iter().enumerate() {
        let layers = over_a_rainbow(kind, speed_hz, number % 2 == 0);
        let cues = vec![Cue { name: String::new(), at: CuePlace::Frame("1".into()), loop_from: None }];
        let show = Show { layers, cues, ..show(8, 4.0) };
        let go_after = Span::from_millis(17_000);
        let conditions = Conditions { go_after, ..Conditions::default() };
        let report = play_in(&show, "loss=5%", 1 + number as u64, conditions);
        assert!(report.duration_s > report.planned_s + 16.0, "{kind}: {} s", report.duration_s);
        assert_lit(&report, 500);
    }
}

#[test]
fn robots_keep_to_one_step_of_each_channel_where_that_is_wanted() {
    for (number, (kind, speed_hz)) in MOVING.into_iter().enumerate() {
        let show = Show { layers: over_a_rainbow(kind, speed_hz, true), ..show(8, 4.0) };
        let conditions = Conditions { light_tolerance: Tolerance::OneStep, ..paused_on_the_way() };
        let report = play_in(&show, "loss=5%", 1 + number as u64, conditions);
        assert_held(&report, kind);
        assert_lit(&report, 300);
    }
}

/// A press also reaches a thousand robots in time.
#[test]
fn live_light_reaches_a_thousand_robots() {
    let place = |frame: usize, id: u32| {
        let turn = Vec2::unit(0.5 * frame as f64);
        (turn * (f64::from(id % 32) - 15.5) + turn.left() * (f64::from(id / 32) - 15.5)) * 0.1
    };
    let mut show = show(1, 4.0);
    show.stage = Stage { width_m: 7.0, depth_m: 7.0, ..Stage::default() };
    for (number, frame) in show.frames.iter_mut().enumerate() {
        let pixel = |id| Pixel { id, at: place(number, id), color: Rgb::new(255, 80, 0), ..Pixel::default() };
        frame.pixels = (0..1_000).map(pixel).collect();
    }
    show.starts = Some((0..1_000).map(|id| place(0, id)).collect());
    let at = |ms: i64, on| (Span::from_millis(ms), Mishap::Rainbow(on));
    let mishaps = vec![at(2_000, true), at(6_000, false), at(11_000, true), at(17_000, false)];
    let conditions = Conditions { mishaps, ..Conditions::default() };
    let report = rehearse(&show, &RehearsalOptions { seed: 1, conditions, robots: None }, &mut |_| {});
    assert_lit(&report, 2_000);
}
