//! Tests with exact bytes, round trips, and truncation at every byte.

use lightbots_base::{Instant, LightRecord, Piece, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{
    Abilities, Blink, Blocked, Command, Details, Fade, Firmware, LightAnchor, LightStretch, LiveColours,
    LiveRelease, MAX_LIVE_COLOURS, MAX_PAYLOAD, MAX_PIECES, Pieces, Report, RobotState, Route, TimeAnswer,
    TimeQuestion, Unknown, commands, encode,
};

fn text(command: &Command) -> String {
    let mut out = String::new();
    encode(command, &mut out).unwrap();
    out
}

fn said(report: &Report) -> String {
    let mut out = String::new();
    report.encode(&mut out).unwrap();
    out
}

fn id(name: &str) -> RobotId {
    RobotId::new(name).unwrap()
}

fn route(pieces: &[Piece]) -> Route {
    Route {
        seq: 4_000_000_007,
        start: Vec2::new(-1.25, 1.3),
        pieces: Pieces::from_slice(pieces).unwrap(),
        room_mm: Some(12),
        neighbours: Default::default(),
    }
}

/// A route that turns, speeds up, cruises and slows down, as most transitions do.
fn usual_route() -> Route {
    let at = |y| Vec2::new(-1.25, y);
    route(&[
        Piece::rest(at(1.3), Span(350_000)),
        Piece { duration: Span(270_000), c1: at(1.3), c2: at(1.2879), end: at(1.2636) },
        Piece::straight(at(1.2636), at(-0.1), Span(5_050_370)),
        Piece { duration: Span(270_000), c1: at(-0.1243), c2: at(-0.1364), end: at(-0.1364) },
    ])
}

fn every_command() -> Vec<Command> {
    vec![
        Command::Target(Vec2::new(0.5, -1.25)),
        Command::Color(Rgb::new(255, 165, 0)),
        Command::Uuid,
        Command::Route(usual_route()),
        Command::Start { seq: 7, at: Instant(12_345_678) },
        Command::Hold { at: Instant(1) },
        Command::Resume { at: Instant(i64::MAX as u64) },
        Command::Stop,
        Command::StopFrom { at: Instant(1_540_450_000) },
        Command::Time(TimeAnswer { asked: Instant(5), received: Instant(900), sent: Instant(950) }),
        Command::Fade(Fade { to: Rgb::new(0, 0, 255), at: Instant(77), over: Span(500_000) }),
        Command::Blink(Blink { over: Span(2_000_000) }),
        Command::Light(light(LightAnchor::Start(12))),
        Command::Light(light(LightAnchor::Free(Instant(5_000_000)))),
        Command::Slot(65_535),
        Command::Live(live(MAX_LIVE_COLOURS)),
        Command::Release(LiveRelease { number: 4_294_967_295, first: 7, count: 65_535 }),
        Command::Status,
    ]
}

/// Live colours of `colours` consecutive slots, all different.
fn live(colours: usize) -> LiveColours {
    let colour = |place: usize| Rgb::new(place as u8, 255 - place as u8, 7);
    LiveColours { number: 9, first: 12, colours: (0..colours).map(colour).collect() }
}

fn light(anchor: LightAnchor) -> LightStretch {
    let records = [
        LightRecord::Line { ticks: 300, to: Rgb::new(255, 136, 0) },
        LightRecord::Step { ticks: 1, to: Rgb::BLACK },
        LightRecord::Repeat { records: 2, times: 9 },
    ];
    LightStretch {
        number: 7,
        anchor,
        skip: Span(10_000_000),
        over: Span(500_000),
        start: Rgb::new(1, 2, 3),
        records: heapless::Vec::from_slice(&records).unwrap(),
    }
}

fn full_report() -> Report {
    let details = Details {
        heading: Some(1.25),
        battery: Some(87),
        state: RobotState::Driving,
        route: 12,
        light: 41,
        slot: Some(169),
        starts: Some(Instant(8_000_000)),
        off_m: Some(0.0034),
        err_m: Some(0.0012),
        clock_us: Some(450),
        firmware: Firmware::try_from("lightbots-0.1.0").unwrap(),
        abilities: Abilities::ALL,
        unknown: 3,
        blocked: Some(Blocked { gap_m: 0.0021, towards: -1.5 }),
        simulated: true,
        brakes: 3,
        near_m: Some(0.0123),
    };
    Report {
        id: id("abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8"),
        at: Some(Vec2::new(-0.73, 1e-4)),
        details: Some(details),
    }
}

#[test]
fn the_originals_messages_byte_for_byte() {
    let payload =
        text(&Command::Target(Vec2::new(0.5, -1.25))) + &text(&Command::Color(Rgb::new(255, 165, 0)));
    assert_eq!(payload, "|TARGET 0.500000 -1.250000||COLOR 16753920|");
    assert_eq!(text(&Command::Uuid), "|UUID|");
    let bare = Report { at: Some(Vec2::new(1.3, -0.73)), details: None, ..full_report() };
    assert_eq!(said(&bare), "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8 1.3 -0.73");
    assert_eq!(said(&Report { at: None, ..bare }), "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8 NaN NaN");
}

#[test]
fn our_messages_byte_for_byte() {
    let route = text(&Command::Route(usual_route()));
    assert_eq!(
        route,
        "|PATH 4000000007 -12500 13000 R 350000 C 270000 -12500 13000 -12500 12879 -12500 12636 \
         L 5050370 -12500 -1000 C 270000 -12500 -1243 -12500 -1364 -12500 -1364 G 12|"
    );
    assert!(route.len() < 200);
    assert_eq!(
        said(&full_report()),
        "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8 -0.73 1.0E-4 state=driving h=1.25 off=0.0034 route=12 \
         starts=8000000 clock=450 bat=87 light=41 slot=169 unknown=3 \
         can=route+fade+blink+room+neighbours+light+live fw=lightbots-0.1.0 err=0.0012 \
         blocked=0.0021@-1.5 sim=1 brakes=3 near=0.0123"
    );
}

#[test]
fn only_a_robot_that_reports_it_in_these_bytes_is_simulated() {
    let said = |fields: &str| Report::decode(format!("r7 0.5 1.3{fields}").as_bytes()).unwrap().details;
    for (fields, simulated) in [
        (" sim=1", true),
        (" state=idle sim=1 more=1", true),
        (" sim=0", false),
        (" sim=yes", false),
        (" state=idle", false),
    ] {
        assert_eq!(said(fields).unwrap().simulated, simulated, "{fields}");
    }
    assert_eq!(said(""), None);
}

#[test]
fn every_command_comes_back() {
    let all = every_command();
    let payload: String = all.iter().map(text).collect();
    let back: Vec<_> = commands(payload.as_bytes()).map(Result::unwrap).collect();
    assert_eq!(back, all);
}

#[test]
fn whatever_follows_stop_is_a_stop() {
    for text in ["|STOP|", "|STOP now|", "|STOP -5|", "|STOP 1e9|", "|STOP 99999999999999999999|"] {
        assert_eq!(commands(text.as_bytes()).collect::<Vec<_>>(), [Ok(Command::Stop)], "{text}");
    }
}

#[test]
fn every_report_comes_back() {
    let states = [
        RobotState::Idle,
        RobotState::Ready,
        RobotState::Held,
        RobotState::Lost,
        RobotState::Cut,
        RobotState::Faulty,
    ];
    let mut all = vec![full_report(), Report { details: None, ..full_report() }];
    all.extend(states.map(|state| Report {
        at: None,
        details: Some(Details { state, ..Details::default() }),
        ..full_report()
    }));
    for report in all {
        assert_eq!(Report::decode(said(&report).as_bytes()), Some(report));
    }
    let question = TimeQuestion { id: id("r7"), asked: Instant(42) };
    let mut asked = String::new();
    question.encode(&mut asked).unwrap();
    assert_eq!(asked, "r7 42");
    assert_eq!(TimeQuestion::decode(asked.as_bytes()), Some(question));
}

#[test]
fn a_cut_off_payload_never_panics_and_never_invents_a_command() {
    let payload: String = every_command().iter().map(text).collect();
    let whole: Vec<_> = commands(payload.as_bytes()).collect();
    for cut in 0..payload.len() {
        let part: Vec<_> = commands(&payload.as_bytes()[..cut]).collect();
        let sure = part.len().saturating_sub(1);
        assert_eq!(part[..sure], whole[..sure], "cut at {cut}");
    }
    let report = said(&full_report());
    for cut in 0..report.len() {
        if let Some(read) = Report::decode(&report.as_bytes()[..cut]) {
            assert_eq!(read.id, full_report().id, "cut at {cut}");
        }
    }
}

#[test]
fn hostile_payloads_are_refused_whole() {
    assert_eq!(commands(b"").next(), None);
    assert_eq!(commands(b"||||  ||").next(), None);
    let megabyte = vec![b'|'; 1 << 20];
    assert_eq!(commands(&megabyte).collect::<Vec<_>>(), [Err(Unknown::TooLong)]);
    assert_eq!(commands(b"|STOP|\xff").collect::<Vec<_>>(), [Err(Unknown::NotText)]);
    assert_eq!(commands("x".repeat(MAX_PAYLOAD).as_bytes()).collect::<Vec<_>>(), [Err(Unknown::Word)]);
    assert_eq!(Report::decode(&megabyte), None);
    assert_eq!(Report::decode(b"\xff 1 2"), None);
    assert_eq!(Report::decode(b""), None);
}

#[test]
fn what_we_do_not_know_is_told_apart_and_the_rest_is_read() {
    let read: Vec<_> =
        commands(b"|JUMP 3||TARGET 1||UUID|COLOR 16777216|color 1|COLOR 3 later fields|").collect();
    assert_eq!(
        read,
        [
            Err(Unknown::Word),
            Err(Unknown::Fields),
            Ok(Command::Uuid),
            Err(Unknown::Fields),
            Err(Unknown::Word),
            Ok(Command::Color(Rgb::new(0, 0, 3))),
        ]
    );
}

#[test]
fn live_colours_take_four_bytes_each_and_name_slots_in_order() {
    let two = LiveColours { colours: heapless::Vec::from_slice(&live(2).colours).unwrap(), ..live(1) };
    assert_eq!(text(&Command::Live(two.clone())), "|LIVE 9 12 AP8HAf4H|");
    assert_eq!(
        [11, 12, 13, 14].map(|slot| two.of(slot)),
        [None, Some(Rgb::new(0, 255, 7)), Some(Rgb::new(1, 254, 7)), None]
    );
    let most = text(&Command::Live(live(MAX_LIVE_COLOURS)));
    assert_eq!(most.len(), "|LIVE 9 12 |".len() + 4 * MAX_LIVE_COLOURS);
    let one_more = most.replace(" AP8H", " AAAAAP8H");
    assert_eq!(commands(one_more.as_bytes()).next(), Some(Err(Unknown::Fields)));
    let release = LiveRelease { number: 1, first: 65_535, count: 2 };
    assert_eq!([0, 65_534, 65_535].map(|slot| release.covers(slot)), [false, false, true]);
}

#[test]
fn fields_out_of_range_are_refused() {
    let bad = [
        "PATH 0 0 0",
        "PATH 1 0",
        "PATH 1 0 0 L 100 5",
        "PATH 1 0 0 R 0",
        "PATH 1 0 0 R -5",
        "PATH 1 0 0 R 3600000001",
        "PATH 1 0 0 X 5",
        "PATH 1 10000001 0",
        "PATH 1 0.5 0",
        "START 0 5",
        "START 1",
        "START 1 -5",
        "HOLD",
        "RESUME x",
        "TIME 1 5 4",
        "FADE 1 2",
        "BLINK -1",
        "TARGET x 1",
        "COLOR -1",
        "SLOT",
        "SLOT 65536",
        "SLOT -1",
        "LIVE 0 0 AAAA",
        "LIVE 1 65536 AAAA",
        "LIVE 1 0",
        "LIVE 1 0 AAAAA",
        "LIVE 1 0 AAAAAA",
        "LIVE 1 0 ====",
        "RELEASE 0 0 1",
        "RELEASE 1 0 0",
        "RELEASE 1 0",
    ];
    for part in bad {
        assert_eq!(commands(part.as_bytes()).collect::<Vec<_>>(), [Err(Unknown::Fields)], "{part}");
    }
}

#[test]
fn a_target_is_read_for_what_it_is() {
    let target = |text: &str| match commands(text.as_bytes()).next() {
        Some(Ok(Command::Target(at))) => at,
        other => panic!("{other:?}"),
    };
    assert_eq!(target("TARGET 0,500000 -1,250000"), Vec2::new(0.5, -1.25));
    assert_eq!(target("TARGET  1.0E-4 1e0"), Vec2::new(1e-4, 1.0));
    assert_eq!(target("TARGET Infinity 0").x, f64::INFINITY);
    assert!(target("TARGET NaN 0").x.is_nan());
}

#[test]
fn a_route_may_say_how_much_room_it_leaves() {
    let room_mm = |text: &str| match commands(text.as_bytes()).next() {
        Some(Ok(Command::Route(route))) => Some(route.room_mm),
        Some(Err(Unknown::Fields)) => None,
        other => panic!("{other:?}"),
    };
    assert_eq!(room_mm("|PATH 7 0 0 R 5|"), Some(None));
    assert_eq!(room_mm("|PATH 7 0 0 R 5 G 0|"), Some(Some(0)));
    assert_eq!(room_mm("|PATH 7 0 0 G 65535 later|"), Some(Some(65_535)));
    for bad in ["|PATH 7 0 0 G|", "|PATH 7 0 0 G -1|", "|PATH 7 0 0 G 65536|", "|PATH 7 0 0 G 1.5|"] {
        assert_eq!(room_mm(bad), None, "{bad}");
    }
}

#[test]
fn a_route_of_the_most_pieces_fits_and_one_more_does_not() {
    let far = Vec2::new(-1000.0, -1000.0);
    let curve = Piece { duration: Span(3_600_000_000), c1: far, c2: Vec2::ZERO, end: far };
    let full = text(&Command::Route(route(&[curve; MAX_PIECES])));
    assert!(full.len() <= MAX_PAYLOAD, "{}", full.len());
    assert!(commands(full.as_bytes()).next().unwrap().is_ok());
    let over = full.replace(" G 12|", " R 1 G 12|");
    assert_eq!(commands(over.as_bytes()).next(), Some(Err(Unknown::Fields)));
}

#[test]
fn a_blink_lasts_a_minute_at_most() {
    assert_eq!(
        commands(b"BLINK 3000000000").next(),
        Some(Ok(Command::Blink(Blink { over: Span(60_000_000) })))
    );
}

#[test]
fn reports_of_others_are_read() {
    let original = Report::decode(b"r1 -0.29999999999999993 1.3000000000000003").unwrap();
    assert_eq!(original.at, Some(Vec2::new(-0.299_999_999_999_999_93, 1.300_000_000_000_000_3)));
    assert_eq!(original.details, None);
    let odd =
        Report::decode(b"r1 0,5 1.0E-4 later mood=fine state=sleepy bat=250 off=-1 route=x can=fly+route")
            .unwrap();
    let details =
        Details { abilities: Abilities { route: true, ..Abilities::default() }, ..Details::default() };
    assert_eq!(odd, Report { id: id("r1"), at: Some(Vec2::new(0.5, 1e-4)), details: Some(details) });
    for bad in ["r1", "r1 1", "r1 a b", "r/1 1 2", "|UUID|"] {
        assert_eq!(Report::decode(bad.as_bytes()), None, "{bad}");
    }
}

#[test]
fn hostile_brakes_and_gaps_are_no_values() {
    let said =
        |fields: &str| Report::decode(format!("r7 0.5 1.3 {fields}").as_bytes()).unwrap().details.unwrap();
    for value in ["-1", "4294967296", "1.5", "x", "", "NaN"] {
        assert_eq!(said(&format!("brakes={value}")).brakes, 0, "{value}");
    }
    for value in ["-0.1", "NaN", "Infinity", "1e300", "x", ""] {
        assert_eq!(said(&format!("near={value}")).near_m, None, "{value}");
    }
    let fine = said("brakes=4294967295 near=0,0123");
    assert_eq!((fine.brakes, fine.near_m), (u32::MAX, Some(0.0123)));
}
