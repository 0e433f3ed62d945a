//! Music runs on while robots are late, and so do layers that run freely.

mod fleet;

use fleet::{World, reached, show, started};
use lightbots_base::Rgb;
use lightbots_control::{EventKind, Operation};
use lightbots_show::{Layer, LayerSpan, Setting, Show};

/// A show of four frames with music, and with a layer of light that pulses and runs freely.
fn with_music() -> Show {
    let text = |colour: &str| Setting::Text(colour.into());
    let settings = vec![
        ("speed_hz".to_owned(), Setting::Number(0.2)),
        ("palette".to_owned(), Setting::List(vec![text("#000000"), text("#ffffff")])),
        ("runs_freely".to_owned(), Setting::Bool(true)),
    ];
    let layer = Layer { name: String::new(), kind: "fade".into(), span: LayerSpan::Show, settings };
    let mut show = Show { music: Some("march.ogg".into()), layers: vec![layer], ..show(4, 9, 3.0) };
    show.frames.iter_mut().for_each(|frame| frame.transition_s = Some(4.0));
    show
}

/// A sample of a run: seconds since the first picture, the music's position, whether it runs, and a robot's light.
struct Moment {
    at_s: f64,
    music_s: f64,
    runs: bool,
    light: Option<Rgb>,
}

fn moment(world: &World, began_s: f64) -> Option<Moment> {
    let position = world.controller.snapshot(world.now).run?.position?;
    let lights = world.controller.layered_lights(world.now);
    Some(Moment {
        at_s: world.now.0 as f64 / 1e6 - began_s,
        music_s: position.show_s,
        runs: position.runs,
        light: lights.first().map(|light| light.1),
    })
}

/// Samples of a run from its first picture on. `act` is called before each.
fn played(act: impl Fn(&mut World, f64)) -> (World, Vec<Moment>) {
    let mut world = World::ready(9, 0, with_music());
    world.play();
    world.run_until(30.0, reached(0));
    let began_s = world.now.0 as f64 / 1e6;
    let mut moments = Vec::new();
    for _ in 0..600 {
        world.run_for(0.05);
        let at_s = world.now.0 as f64 / 1e6 - began_s;
        act(&mut world, at_s);
        moments.extend(moment(&world, began_s));
    }
    (world, moments)
}

/// An action for `played`: robot 2 is unsure of its place from `from_s` to `to_s`, so that all robots are held.
fn held(from_s: f64, to_s: f64) -> impl Fn(&mut World, f64) {
    move |world, at_s| world.robots[2].unsure = (from_s..to_s).contains(&at_s)
}

#[test]
fn music_runs_through_a_hold_and_stands_in_a_pause() {
    let (world, moments) = played(held(4.0, 5.5));
    assert!(world.count(|kind| matches!(kind, EventKind::Waiting { .. })) > 0, "{}", world.story());
    for pair in moments.windows(2) {
        let (passed_s, moved_s) = (pair[1].at_s - pair[0].at_s, pair[1].music_s - pair[0].music_s);
        assert!((moved_s - passed_s).abs() < 0.03, "{moved_s} s in {passed_s} s at {} s", pair[0].at_s);
    }
    let (_, paused) = played(|world, at_s| {
        if (4.0..4.05).contains(&at_s) {
            world.operate(Operation::Pause).unwrap();
        }
        if (7.0..7.05).contains(&at_s) {
            world.operate(Operation::Resume).unwrap();
        }
    });
    let within = |from_s: f64, to_s: f64| paused.iter().filter(move |one| (from_s..to_s).contains(&one.at_s));
    assert!(within(4.2, 6.9).all(|one| !one.runs && (one.music_s - 4.0).abs() < 0.15));
    assert!(within(7.3, 12.0).all(|one| one.runs && (one.at_s - one.music_s - 3.0).abs() < 0.2));
}

#[test]
fn layers_that_run_freely_are_where_the_music_is() {
    let (_, fine) = played(|_, _| {});
    let expected = |music_s: f64| {
        let nearest =
            fine.iter().min_by(|a, b| (a.music_s - music_s).abs().total_cmp(&(b.music_s - music_s).abs()));
        nearest.and_then(|one| one.light)
    };
    let (world, moments) = played(held(4.0, 5.5));
    assert!(world.count(|kind| matches!(kind, EventKind::Waiting { .. })) > 0, "{}", world.story());
    let mut compared = 0;
    for one in moments.iter().filter(|one| one.at_s > 6.0) {
        let (Some(light), Some(expected)) = (one.light, expected(one.music_s)) else { continue };
        compared += 1;
        let off = i32::from(light.r).abs_diff(i32::from(expected.r));
        assert!(
            off < 16,
            "at {} s of the music: {light:?}, not {expected:?}; {}",
            one.music_s,
            world.story()
        );
    }
    assert!(compared > 100, "{compared} moments");
}

#[test]
fn a_show_that_is_played_from_the_middle_has_its_music_there() {
    let mut world = World::ready(9, 0, with_music());
    world.operate(Operation::Play { from: 2, missing: lightbots_control::MissingPolicy::Refuse }).unwrap();
    world.run_until(30.0, started);
    world.run_until(30.0, reached(2));
    world.run_for(0.1);
    let now = moment(&world, 0.0).expect("a show is played");
    // Two air times of 3 s, and two drives of 4 s.
    assert!(now.runs && (now.music_s - 14.1).abs() < 0.2, "{} s", now.music_s);
}
