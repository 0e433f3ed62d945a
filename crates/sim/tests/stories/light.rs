//! Layers of light: robots show what the layers say, on time, whatever happens to the drive.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_show::{Frame, FramePhase, Layer, LayerSpan, Pixel, Setting, Show, Stage};
use lightbots_sim::{Conditions, Faults, Mishap, RehearsalOptions, RehearsalReport, rehearse};

fn layer(kind: &str, span: LayerSpan, settings: Vec<(&str, Setting)>) -> Layer {
    let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    Layer { name: String::new(), kind: kind.into(), span, settings }
}

/// A rainbow over the whole show, a chase in drives and a twinkle in pictures.
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

/// A row, a ring and a row again, of `count` robots.
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
    let faults = if faults.is_empty() { Faults::default() } else { Faults::parse(faults).unwrap() };
    let conditions = faults.added_to(Conditions::default());
    rehearse(show, &RehearsalOptions { seed, conditions, robots: None }, &mut |_| {})
}

/// At most one in `one_in` of the compared lights is wrong.
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

/// Live light is pressed and released while robots drive, stand, and are held.
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
