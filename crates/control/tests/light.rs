//! Light of shows with layers: which messages robots get, and how often.

mod fleet;

use fleet::{World, reached, show};
use lightbots_base::{Rgb, Span};
use lightbots_control::{EventKind, Operation};
use lightbots_show::{Cue, CuePlace, Layer, LayerSpan, Setting, Show};
use lightbots_wire::{LightAnchor, LightStretch};

/// A show with a rainbow over its whole length. The second frame waits for GO.
fn rainbow(robots: usize) -> Show {
    let settings = vec![("speed_hz".to_owned(), Setting::Number(0.5))];
    let layer = Layer { name: String::new(), kind: "rainbow".into(), span: LayerSpan::Show, settings };
    let mut show = show(3, robots, 2.0);
    show.layers = vec![layer];
    show.frames[1].id = Some("second".into());
    show.cues = vec![Cue { name: String::new(), at: CuePlace::Frame("second".into()), loop_from: None }];
    show
}

/// The stretches that the first robot received after its first `count`.
fn since(world: &World, count: usize) -> &[LightStretch] {
    &world.robots[0].stretches[count..]
}

#[test]
fn the_first_stretch_comes_with_the_route_and_others_while_a_frame_waits_for_go() {
    let mut world = World::ready(9, 0, rainbow(9));
    world.play();
    world.run_until(30.0, reached(1));
    let first = &world.robots[0].stretches[0];
    assert!(matches!(first.anchor, LightAnchor::Start(_)), "{first:?}");
    let count = world.robots[0].stretches.len();
    world.run_for(60.0);
    let waiting = since(&world, count);
    let moments = waiting.iter().filter(|stretch| matches!(stretch.anchor, LightAnchor::Moment(_))).count();
    assert!((6..=7).contains(&moments), "one of 10 s after the other: {waiting:?}");
    let starts = since(&world, 0).iter().filter(|stretch| matches!(stretch.anchor, LightAnchor::Start(_)));
    assert_eq!(starts.count(), 3, "that of the drive to come was sent ahead of GO");
    assert!(waiting.iter().all(|stretch| stretch.track().duration() <= Span::from_secs(10.0)));
    world.operate(Operation::Go).unwrap();
    world.run_to_end(30.0);
}

#[test]
fn stretches_are_numbered_upwards_and_none_is_sent_without_layers() {
    let mut world = World::ready(9, 0, rainbow(9));
    world.play();
    world.run_until(30.0, reached(1));
    for robot in &world.robots {
        let numbers: Vec<u32> = robot.stretches.iter().map(|stretch| stretch.number).collect();
        assert!(numbers.windows(2).all(|two| two[0] < two[1]), "{numbers:?}");
    }
    let mut world = World::ready(9, 0, show(3, 9, 2.0));
    world.play();
    world.run_to_end(60.0);
    assert!(world.robots.iter().all(|robot| robot.stretches.is_empty()));
}

#[test]
fn original_robots_get_colours_at_a_bounded_rate() {
    let mut world = World::ready(4, 2, rainbow(4));
    world.play();
    world.run_until(60.0, reached(1));
    let mut shown = Vec::new();
    for _ in 0..100 {
        world.run_for(0.05);
        shown.push(world.robots.iter().find(|robot| robot.original).expect("there are two").light);
    }
    shown.dedup();
    assert!((15..=21).contains(&shown.len()), "{} colours in 5 s", shown.len());
    assert!(shown.iter().all(|&colour| colour != Rgb::BLACK));
}

fn solid(colour: &str) -> Layer {
    let palette = Setting::List(vec![Setting::Text(colour.into())]);
    let settings = vec![("palette".to_owned(), palette)];
    Layer { name: String::new(), kind: "solid".into(), span: LayerSpan::Show, settings }
}

fn live(name: &str, colour: Option<&str>) -> Operation {
    Operation::LiveLight { name: name.into(), layer: colour.map(solid) }
}

/// The colour at the end of a stretch.
fn last(stretch: &LightStretch) -> Rgb {
    let track = stretch.track();
    lightbots_base::LightCursor::default().at(track, track.duration())
}

/// The live lights that are on, as the snapshot for screens lists them.
fn on(world: &World) -> Vec<String> {
    world.controller.snapshot(world.now).run.map(|run| run.live_light).unwrap_or_default()
}

const RED: Rgb = Rgb::new(255, 0, 0);

#[test]
fn live_light_reaches_all_within_a_moment_and_goes_with_its_release() {
    for shows in [rainbow(9), show(3, 9, 20.0)] {
        let has_layers = !shows.layers.is_empty();
        let mut world = World::ready(9, 0, shows);
        world.play();
        world.run_until(30.0, reached(0));
        let count = world.robots[0].stretches.len();
        world.operate(live("red", Some("#ff0000"))).unwrap();
        assert_eq!(on(&world), ["red"]);
        world.run_for(0.15);
        for robot in &world.robots {
            let newest = robot.stretches.last().expect("each robot got one");
            assert_eq!((newest.start, last(newest)), (RED, RED), "layers before: {has_layers}");
        }
        world.run_for(30.0);
        let sent = since(&world, count).len();
        assert!((4..=9).contains(&sent), "a short one, then one every 10 s, and one for a drive: {sent}");
        world.operate(live("red", None)).unwrap();
        world.run_for(0.15);
        for robot in &world.robots {
            assert_ne!(last(robot.stretches.last().expect("each robot got one")), RED);
        }
        assert!(on(&world).is_empty());
    }
}

#[test]
fn live_light_runs_on_in_a_pause_and_is_released_in_it() {
    let mut world = World::ready(9, 0, show(3, 9, 2.0));
    world.play();
    world.run_until(30.0, |kind| matches!(kind, EventKind::TransitionStarted { frame: 1, .. }));
    world.run_for(0.5);
    world.operate(Operation::Pause).unwrap();
    world.run_for(3.0);
    let mut rainbow = rainbow(9).layers.remove(0);
    rainbow.span = LayerSpan::Show;
    world.operate(Operation::LiveLight { name: "rainbow".into(), layer: Some(rainbow) }).unwrap();
    let count = world.robots[0].stretches.len();
    world.run_for(30.0);
    let sent = since(&world, count);
    assert!((4..=5).contains(&sent.len()), "a short one, then one every 10 s: {}", sent.len());
    assert!(sent.iter().all(|stretch| matches!(stretch.anchor, LightAnchor::Free(_))), "{sent:?}");
    let count = world.robots[0].stretches.len();
    world.operate(live("rainbow", None)).unwrap();
    world.run_for(10.0);
    let newest = since(&world, count);
    assert_eq!(newest.len(), 1, "one colour until the pause is over: {newest:?}");
    world.operate(Operation::Resume).unwrap();
    world.run_to_end(60.0);
}

#[test]
fn a_hand_that_drums_on_the_pads_sends_ten_changes_a_second_and_the_last_one_counts() {
    let mut world = World::ready(9, 0, rainbow(9));
    world.play();
    world.run_until(30.0, reached(0));
    let count = world.robots[0].stretches.len();
    for press in 0..100 {
        world.operate(live("red", (press % 2 == 1).then_some("#ff0000"))).unwrap();
        world.run_for(0.01);
    }
    world.run_for(0.2);
    let sent = since(&world, count);
    assert!((10..=13).contains(&sent.len()), "{}", sent.len());
    assert_eq!(last(&sent[sent.len() - 1]), RED);
}

#[test]
fn live_light_ends_with_the_show_and_robots_show_their_frame() {
    let mut world = World::ready(9, 0, show(2, 9, 2.0));
    world.play();
    world.run_until(30.0, reached(0));
    world.operate(live("red", Some("#ff0000"))).unwrap();
    world.run_to_end(60.0);
    world.run_for(0.2);
    let colours: Vec<Rgb> =
        world.robots.iter().map(|robot| last(robot.stretches.last().expect("each got one"))).collect();
    assert!(colours.iter().all(|colour| *colour != RED), "{colours:?}");
}

#[test]
fn live_light_that_is_wrong_too_much_or_without_a_show_is_refused_with_a_remedy() {
    let mut world = World::ready(9, 0, show(2, 9, 20.0));
    let refused = world.operate(live("red", Some("#ff0000"))).unwrap_err();
    assert_eq!(refused.to_string(), "No show plays: live light needs one, so press Play first.");
    world.play();
    world.run_until(30.0, reached(0));
    let mut strobe = solid("#ff0000");
    strobe.kind = "strobe".into();
    strobe.settings.push(("speed_hz".into(), Setting::Number(1000.0)));
    let refused = world
        .operate(Operation::LiveLight { name: "x".into(), layer: Some(strobe) })
        .unwrap_err()
        .to_string();
    assert!(refused.starts_with("This light cannot be shown: layer 1: speed_hz is 1000: "), "{refused}");
    let refused = world.operate(live(&"x".repeat(65), Some("#ff0000"))).unwrap_err().to_string();
    assert!(refused.contains("1 to 64 characters"), "{refused}");
    for number in 0..8 {
        world.operate(live(&number.to_string(), Some("#ff0000"))).unwrap();
    }
    world.operate(live("7", Some("#00ff00"))).expect("one of the same name is replaced");
    let refused = world.operate(live("8", Some("#ff0000"))).unwrap_err().to_string();
    assert!(refused.starts_with("8 live lights are on"), "{refused}");
}

#[test]
fn a_robot_that_restarts_under_live_light_gets_what_is_left_of_it() {
    let mut world = World::ready(9, 0, show(3, 9, 30.0));
    world.play();
    world.run_until(30.0, reached(0));
    world.operate(live("red", Some("#ff0000"))).unwrap();
    world.run_for(4.0);
    world.robots[0].restart();
    world.run_for(1.0);
    let sent = since(&world, 0);
    let first = sent.first().expect("it gets a stretch");
    assert_eq!(last(first), RED);
    assert!(first.track().duration() > Span::from_secs(1.0), "{first:?}");
    assert!(matches!(first.anchor, LightAnchor::Free(_)), "{first:?}");
}
