//! Tests of the bytes of journals.

use super::*;
use crate::computer_time::{ComputerTime, Uptime};
use crate::frame_cursor::FrameCursor;
use crate::run::{AirTime, Membership, PathClock, Probation, RunPurpose, StopTimes, Whereabouts};
use lightbots_base::{Instant, Rgb, RobotId, Span, StateHash, Vec2};
use lightbots_show::{
    Asset, AssetHash, Cue, CuePlace, Frame, Layer, LayerPicture, LayerSpan, Pixel, Setting, Show,
};
use std::sync::Arc;

fn state() -> JournalState {
    let frame = Frame { pixels: vec![Pixel::default()], ..Frame::default() };
    let id = RobotId::new("a").unwrap();
    let settings = vec![("speed_hz".to_owned(), Setting::Number(2.0))];
    let layer = Layer { kind: "rainbow".into(), name: String::new(), span: LayerSpan::Show, settings };
    let picture = Some(Arc::new(LayerPicture { width: 1, height: 1, codes: vec![7, 8, 9] }));
    let (name, media_type) = ("a.png".into(), "image/png".into());
    let asset = Asset { name, media_type, bytes: 9, content: None, picture };
    let assets = [(AssetHash([5; 32]), asset)].into();
    let cue = Cue { name: String::new(), at: CuePlace::Seconds(1.0), loop_from: Some("b".into()) };
    let show = Show { frames: vec![frame], cues: vec![cue], layers: vec![layer], assets, ..Show::default() };
    JournalState {
        begun: RunBegun {
            at: Instant(5),
            show: Arc::new(show),
            purpose: RunPurpose::Play,
            missing: Default::default(),
        },
        participants: vec![ParticipantEntry {
            id,
            abilities: Default::default(),
            at: Some(Vec2::new(1.0, 2.0)),
            membership: Membership::default(),
            probation: Probation::Turning { from: 1.0, since: Instant(7), tries: 1 },
            last_seen: Whereabouts { possible: vec![Vec2::ZERO], likely: vec![Vec2::ZERO] },
        }],
        leg: None,
        pins: vec![(1, id)],
        owners: vec![(2, id)],
        found: vec![Vec2::ZERO],
        ignores_strangers: true,
        progress: RunProgress {
            next: FrameCursor { frame: 0, round: 1, pass: 2 },
            leaves_loop: Some(FrameCursor { frame: 0, round: 1, pass: 2 }),
            looping: true,
            paused: false,
            stepping: true,
            waits_for_go: true,
            frames_played: 3,
            dropouts: 4,
            taken_up: 1,
            position: Position {
                drive: None,
                stops: Some(StopTimes { began: Instant(5), stood: Instant(6) }),
                stood: Some(AirTime {
                    since: Instant(1),
                    until: Instant(2),
                    left: Some(Span(3)),
                    is_at_goals: true,
                }),
            },
        },
        ended: None,
    }
}

fn leg() -> LegEntry {
    let path = lightbots_plan::Path {
        start: Vec2::new(0.5, 0.0),
        pieces: vec![lightbots_base::Piece::straight(Vec2::ZERO, Vec2::new(0.25, 1.5), Span(900))],
    };
    let step = crate::leg::RobotLeg {
        task: crate::leg::Task::Path(path),
        pixel: Some(3),
        color: Rgb::new(1, 2, 3),
        ..crate::leg::RobotLeg::stay(Vec2::new(0.25, 1.5))
    };
    LegEntry::of(&crate::leg::Leg {
        frame: 0,
        round: 0,
        pass: 0,
        seq: 9,
        kind: crate::leg::LegKind::Routes,
        robots: vec![step],
        drives: Vec::new(),
        drivers: 1,
        duration: Span(900),
        reaches_frame: true,
        room_m: 0.0,
        around: Arc::default(),
    })
}

fn journal_of(entries: &[Entry]) -> Vec<u8> {
    let mut bytes = [&MAGIC[..], &VERSION.to_le_bytes(), &[0]].concat();
    for entry in entries {
        crate::block::append_block(&mut bytes, &postcard::to_allocvec(entry).unwrap());
    }
    bytes
}

fn entry(changes: Vec<Change>) -> Entry {
    Entry {
        at: Instant(8),
        clocks: ComputerTime { wall_us: 9, uptime: Some(Uptime { boot: 10, us: 11 }) },
        changes,
    }
}

/// A change of any type that is written changes these bytes. Then raise [`VERSION`], so that older journals are refused
/// by their number and not misread.
#[test]
fn the_format_is_that_of_its_version() {
    let clock = PathClock::new(Instant(1), Span(2));
    let progress =
        RunProgress { position: Position { drive: Some(clock), ..Position::default() }, ..state().progress };
    let entry = entry(vec![
        Change::State(Box::new(state())),
        Change::Participant { number: 1, entry: state().participants[0].clone() },
        Change::Leg(leg()),
        Change::Pins(Vec::new()),
        Change::Owners(Vec::new()),
        Change::Obstacles { found: Vec::new(), ignores_strangers: false },
        Change::Progress(progress),
        Change::Operated("pause".into()),
        Change::Ended("finished".into()),
    ]);
    let mut hash = StateHash::new();
    let bytes = postcard::to_allocvec(&entry).unwrap();
    assert!(
        postcard::from_bytes::<Entry>(&bytes).unwrap() == entry,
        "a layer keeps its settings, a picture its codes"
    );
    hash.bytes(&bytes);
    assert_eq!((VERSION, hash.finish()), (13, 15_318_963_236_114_024_097));
}

#[test]
fn a_leg_is_the_same_to_the_micrometre() {
    let again = leg().to_leg(1).unwrap();
    assert_eq!(LegEntry::of(&again), leg());
    assert!(leg().to_leg(0).is_none(), "it has more robots than the run");
}

#[test]
fn entries_that_no_controller_writes_are_refused() {
    let run = |entries: &[Entry]| UnfinishedRun::read(&journal_of(entries));
    let first = entry(vec![Change::State(Box::new(state()))]);
    assert!(run(std::slice::from_ref(&first)).unwrap().is_some());
    let participant = |number| Change::Participant { number, entry: state().participants[0].clone() };
    let drive = Position { drive: Some(PathClock::new(Instant(1), Span(2))), ..Position::default() };
    let drives = |leg: Vec<Change>| {
        let progress = Change::Progress(RunProgress { position: drive, ..state().progress });
        entry([leg, vec![progress]].concat())
    };
    assert!(run(&[first.clone(), drives(vec![Change::Leg(leg())])]).unwrap().is_some());
    let held = |seconds: f64| {
        let mut clock = PathClock::new(Instant(1), Span(2));
        clock.stand(Instant(8) + Span::from_secs(seconds));
        let position = Position { drive: Some(clock), ..Position::default() };
        let progress = Change::Progress(RunProgress { position, ..state().progress });
        entry(vec![Change::Leg(leg()), progress])
    };
    assert!(run(&[first.clone(), held(4.0)]).unwrap().is_some());
    for bad in [
        vec![entry(Vec::new())],
        vec![entry(vec![participant(0)])],
        vec![first.clone(), entry(vec![participant(2)])],
        // Two robots have one name.
        vec![first.clone(), entry(vec![participant(1)])],
        vec![first.clone(), drives(Vec::new())],
        // Each START waits for a hold.
        vec![first.clone(), held(3_600.0)],
        vec![
            first.clone(),
            entry(vec![Change::Obstacles {
                found: vec![Vec2::new(f64::NAN, 0.0)],
                ignores_strangers: false,
            }]),
        ],
    ] {
        assert_eq!(run(&bad), Err(JournalError::BadEntry), "{bad:?}");
    }
}
