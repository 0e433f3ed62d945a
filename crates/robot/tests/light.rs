//! Light records that are sent ahead, on a robot that drives.

#[allow(dead_code)]
mod plant;

use lightbots_base::{Instant, LightCursor, LightRecord, Rgb, Span, Vec2};
use lightbots_wire::{Command, Fade, LightAnchor, LightRecords, LightStretch, Route};
use plant::{Flaws, Plant, straight};

/// Start of the route, stage metres.
const START: Vec2 = Vec2::new(-0.8, 0.0);
/// End of the route, stage metres.
const END: Vec2 = Vec2::new(0.8, 0.0);
/// Number of the route that the robot drives.
const SEQ: u32 = 1;

/// A stretch of ten seconds with lines and steps that repeat.
fn stretch(number: u32, anchor: LightAnchor, skip: Span) -> LightStretch {
    let records = [
        LightRecord::Line { ticks: 60, to: Rgb::new(255, 0, 40) },
        LightRecord::Step { ticks: 30, to: Rgb::new(0, 0, 255) },
        LightRecord::Line { ticks: 35, to: Rgb::new(10, 200, 0) },
        LightRecord::Repeat { records: 3, times: 7 },
    ];
    let records = LightRecords::from_slice(&records).unwrap();
    LightStretch { number, anchor, skip, over: Span::ZERO, start: Rgb::new(9, 9, 9), records }
}

/// Path time at `show` in a drive that begins at `began` and is held from `hold` to `resume`, all show clock, by R38 of
/// docs/protocol.md.
fn path_time(show: Instant, [began, hold, resume]: [Instant; 3]) -> Span {
    let ease = Route::EASE;
    // Progress along an ease, in which the rate falls or rises linearly.
    let eased = |since: Span| {
        let since = since.clamp(Span::ZERO, ease).as_secs();
        Span::from_secs(since * since / (2.0 * ease.as_secs()))
    };
    let slowing = (show - hold).clamp(Span::ZERO, ease);
    let after = (show - resume - ease).max(Span::ZERO);
    (show - began).min(hold - began) + slowing - eased(slowing) + eased(show - resume) + after
}

/// Largest difference between a channel of the shown colour and of the wanted one. The clock is accurate to 5 ms, so
/// the moment within ±5 ms that fits best counts.
fn off(plant: &Plant, colour: impl Fn(Instant) -> Rgb) -> u8 {
    let moments = (-5..=5).map(|ms| colour(plant.show() + Span::from_millis(ms)));
    let differs = |wanted: Rgb| {
        let shown = plant.last.light;
        [shown.r.abs_diff(wanted.r), shown.g.abs_diff(wanted.g), shown.b.abs_diff(wanted.b)]
    };
    moments.map(|wanted| differs(wanted).into_iter().max().unwrap_or(0)).min().unwrap_or(0)
}

#[test]
fn a_robot_shows_its_records_at_every_step_and_stands_in_a_hold() {
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 3);
    plant.tell(&Command::Route(straight(SEQ, START, END)));
    let began = plant.show() + Span::from_millis(400);
    plant.tell(&Command::Light(stretch(1, LightAnchor::Start(SEQ), Span::ZERO)));
    plant.tell(&Command::Start { seq: SEQ, at: began });
    let (hold, resume) = (began + Span::from_millis(2_000), began + Span::from_millis(4_500));
    let skip = Span::from_millis(7_000);
    let shown = |show: Instant| {
        let time = path_time(show, [began, hold, resume]);
        let (from, number) = if time < skip { (Span::ZERO, 1) } else { (skip, 2) };
        let stretch = stretch(number, LightAnchor::Moment(began), from);
        LightCursor::default().at(stretch.track(), time - from)
    };
    let mut told = 0;
    while plant.show() < began + Span::from_millis(16_000) {
        let messages = [
            (hold, Command::Hold { at: hold }),
            (resume, Command::Resume { at: resume }),
            (began + Span::from_millis(6_000), Command::Light(stretch(2, LightAnchor::Moment(began), skip))),
        ];
        if let Some((_, command)) =
            messages.get(told).filter(|(at, _)| plant.show() > *at - Span::from_millis(150))
        {
            plant.tell(command);
            told += 1;
        }
        plant.step();
        if plant.show() > began + Span::from_millis(5) {
            let off = off(&plant, shown);
            assert!(off <= 2, "{} s after the start: {off} codes", (plant.show() - began).as_secs());
        }
    }
    assert_eq!(told, 3);
}

#[test]
fn a_fade_and_a_colour_take_over_in_the_middle_of_a_line() {
    let mut plant = Plant::ready(START, 0.0, Flaws::NONE, 3);
    let began = plant.show() + Span::from_millis(100);
    let line = LightRecord::Line { ticks: 400, to: Rgb::new(200, 0, 0) };
    let records = LightRecords::from_slice(&[line]).unwrap();
    let red =
        LightStretch { start: Rgb::BLACK, records, ..stretch(1, LightAnchor::Moment(began), Span::ZERO) };
    plant.tell(&Command::Light(red));
    plant.run(0.3);
    let fades = began + Span::from_millis(2_000);
    plant.tell(&Command::Fade(Fade { to: Rgb::new(100, 0, 200), at: fades, over: Span::from_millis(1_000) }));
    let shown = |show: Instant| match show - fades {
        since if since < Span::ZERO => Rgb::BLACK.mixed(Rgb::new(200, 0, 0), (show - began).as_secs() / 4.0),
        since => Rgb::new(100, 0, 0).mixed(Rgb::new(100, 0, 200), since.as_secs()),
    };
    while plant.show() < began + Span::from_millis(4_000) {
        plant.step();
        let off = off(&plant, shown);
        assert!(off <= 2, "{} s after the start: {off} codes", (plant.show() - began).as_secs());
    }
    plant.tell(&Command::Light(stretch(2, LightAnchor::Moment(plant.show()), Span::ZERO)));
    plant.run(0.3);
    assert!(plant.last.light.r > 100 && plant.last.light.b < 40, "the stretch plays: {:?}", plant.last.light);
    plant.tell(&Command::Color(Rgb::new(1, 2, 3)));
    plant.run(1.0);
    assert_eq!(plant.last.light, Rgb::new(1, 2, 3));
}
