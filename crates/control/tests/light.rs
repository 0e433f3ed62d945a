//! Light of shows with layers: what is sent to robots, and how often.

mod fleet;

use fleet::{World, show};
use lightbots_base::{Rgb, Span};
use lightbots_control::{EventKind, Operation};
use lightbots_show::{Cue, CuePlace, Layer, LayerSpan, Setting, Show};
use lightbots_wire::{LightAnchor, LightStretch};

/// A rainbow runs over the whole show; its second frame waits for GO.
fn rainbow(robots: usize) -> Show {
    let settings = vec![("speed_hz".to_owned(), Setting::Number(0.5))];
    let layer = Layer { name: String::new(), kind: "rainbow".into(), span: LayerSpan::Show, settings };
    let mut show = show(3, robots, 2.0);
    show.layers = vec![layer];
    show.frames[1].id = Some("second".into());
    show.cues = vec![Cue { name: String::new(), at: CuePlace::Frame("second".into()) }];
    show
}

fn reached(frame: usize) -> impl Fn(&EventKind) -> bool {
    move |kind| matches!(kind, EventKind::FrameReached { frame: one, .. } if *one == frame)
}

/// The stretches of the first robot since it had `count`.
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
