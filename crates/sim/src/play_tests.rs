//! The same run in both orders of turns.

use super::*;
use crate::conditions::Conditions;
use crate::faults::Faults;
use crate::options::RehearsalOptions;
use lightbots_base::Rgb;
use lightbots_show::{Cue, CuePlace, Layer, LayerSpan, Setting, back_rows};
use std::sync::Arc;

#[test]
fn robots_that_take_turns_there_and_back_play_the_same_to_the_bit() {
    let show =
        Arc::new(lightbots_exchange::read(include_bytes!("../../../shows/hello.json"), None).unwrap().show);
    let starts = back_rows(&show.stage, 30);
    for faults in ["kill=random", "slip=10%,gps=5mm", "fix-dropout=0.5s"] {
        let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
        let options = RehearsalOptions { seed: 3, conditions, robots: None };
        let play = |cached| {
            let mut play = Play::new(show.clone(), &starts, &[], &options, 30.0);
            play.robots.cached = cached;
            play.run(None, &mut |_| {})
        };
        let (there, back) = (play(starts.len()), play(0));
        assert_eq!(there, back, "{faults}");
        assert_eq!(there.frames_played, show.frames.len(), "{faults}");
    }
}

/// Largest change of a channel from one step to the next while a frame waits for GO and after it, and how long it waited.
fn largest_change(faults: &str, seed: u64) -> (u8, f64) {
    let mut show = lightbots_exchange::read(include_bytes!("../../../shows/hello.json"), None).unwrap().show;
    let settings = vec![("speed_hz".to_owned(), Setting::Number(0.05))];
    show.layers =
        vec![Layer { name: String::new(), kind: "rainbow".into(), span: LayerSpan::Show, settings }];
    show.frames[1].id = Some("waits".into());
    show.cues = vec![Cue { name: String::new(), at: CuePlace::Frame("waits".into()), loop_from: None }];
    let conditions = Conditions { go_after: Span::from_millis(9_000), ..Conditions::default() };
    let conditions = Faults::parse(faults).unwrap().added_to(conditions);
    let options = RehearsalOptions { seed, conditions, robots: None };
    let starts = back_rows(&show.stage, 30);
    let mut play = Play::new(Arc::new(show), &starts, &[], &options, 30.0);
    play.switch_on(None);
    let (mut most, mut waited_s, mut before) = (0, 0.0, None::<Vec<Rgb>>);
    while !play.is_over() {
        play.step();
        play.plan(&mut |_| {});
        let lights: Vec<Rgb> = (0..starts.len()).map(|robot| play.robots.light(robot)).collect();
        waited_s += if play.controller.is_at_cue(play.now) { STEP.as_secs() } else { 0.0 };
        if play.record.frames_played() >= 2
            && let Some(before) = before.replace(lights.clone())
        {
            let change =
                |(a, b): (&Rgb, &Rgb)| a.r.abs_diff(b.r).max(a.g.abs_diff(b.g)).max(a.b.abs_diff(b.b));
            most = lights.iter().zip(&before).map(change).fold(most, u8::max);
        }
    }
    assert_eq!(play.record.frames_played(), play.show.frames.len());
    (most, waited_s)
}

#[test]
fn go_ends_a_wait_without_a_jump_of_colour() {
    for (faults, seed) in [("loss=0%", 1), ("loss=5%", 2), ("loss=5%", 3)] {
        let (most, waited_s) = largest_change(faults, seed);
        assert!(waited_s > 8.0, "{faults}, seed {seed}: waited {waited_s} s");
        // Show time leaps back by half a cycle of the rainbow. Over 0.5 s that is at most 8.2 codes a step, and its own
        // motion 1.3.
        assert!(most <= 12, "{faults}, seed {seed}: a channel changes by {most} codes");
    }
}
