//! Recorded rehearsals are replayed bit by bit, and no input makes a replay panic.

use lightbots_base::{Rgb, Vec2};
use lightbots_control::{LogEnd, LogError, ReplayReport, replay};
use lightbots_show::{Asset, AssetHash, Frame, Layer, LayerPicture, LayerSpan, Pixel, Setting, Show};
use lightbots_sim::{
    Conditions, Faults, Progress, RehearsalOptions, RehearsalReport, rehearse, rehearse_recorded,
};

fn example() -> Show {
    lightbots_exchange::read(include_bytes!("../../../../shows/hello.json"), None).unwrap().show
}

/// The example show, repeated for this number of frames.
fn long(frames: usize) -> Show {
    let example = example();
    let again = example.frames.iter().cycle().take(frames);
    let frames = again.map(|frame| Frame { air_time_s: 4.0, ..frame.clone() }).collect();
    Show { frames, ..example }
}

fn options(faults: &str, seed: u64) -> RehearsalOptions {
    let conditions = Faults::parse(faults).unwrap().added_to(Conditions::default());
    RehearsalOptions { seed, conditions, robots: None }
}

fn recorded(show: &Show, options: &RehearsalOptions) -> (RehearsalReport, Vec<u8>) {
    let mut log = Vec::new();
    let notes = vec![("seed".to_owned(), options.seed.to_string())];
    let report = rehearse_recorded(show, options, notes, &mut |progress| {
        if let Progress::Logged(bytes) = progress {
            log.extend_from_slice(bytes);
        }
    });
    (report, log)
}

fn replayed(log: &[u8]) -> ReplayReport {
    replay(log, &mut |_| {}).unwrap()
}

#[test]
fn minutes_with_dead_robots_and_lost_messages_are_replayed_to_the_bit() {
    let show = long(24);
    let options = options("loss=5%,double=2%,reorder=2%,kill=3@20s,kill=11@45s,cut=5@60s+4s,mute=7@80s", 7);
    let (report, log) = recorded(&show, &options);
    assert!(report.duration_s > 150.0 && report.replans >= 3 && report.dropouts >= 3, "{report:#?}");
    let again = replayed(&log);
    assert_eq!(again.difference, None);
    assert_eq!((again.end, again.robots), (LogEnd::Complete, 30));
    assert_eq!(again.notes, [("seed".to_owned(), "7".to_owned())]);
    assert!(again.messages > 5_000 && again.plans > 5 && again.outputs > 5_000, "{again:#?}");
    assert!(again.lasted.as_secs() >= report.duration_s);
}

#[test]
fn recording_changes_nothing() {
    let options = options("loss=10%,kill=random", 3);
    let (report, _) = recorded(&example(), &options);
    assert_eq!(report, rehearse(&example(), &options, &mut |_| {}));
}

#[test]
fn a_log_that_was_cut_is_replayed_up_to_there() {
    let (_, log) = recorded(&example(), &options("loss=5%", 1));
    let whole = replayed(&log);
    let mut before = 0;
    for share in [0.2, 0.5, 0.9] {
        let again = replayed(&log[..(log.len() as f64 * share) as usize]);
        assert!(matches!(again.end, LogEnd::Cut(at) if (at as usize) < log.len()));
        assert_eq!(again.difference, None);
        assert!(again.inputs > before && again.inputs < whole.inputs);
        before = again.inputs;
    }
    assert_eq!(replay(&log[..3], &mut |_| {}), Err(LogError::NoLog));
    assert_eq!(replay(&log[..10], &mut |_| {}), Err(LogError::NoHeader));
    assert_eq!(replay(b"LBotsLog\xff\xff", &mut |_| {}), Err(LogError::OtherVersion(0xffff)));
}

#[test]
fn no_bytes_make_the_reader_panic() {
    let mut show = example();
    show.frames.truncate(2);
    let (_, log) = recorded(&show, &options("loss=5%", 1));
    let blocks = blocks(&log);
    let mut random = 1_u64;
    let mut next = |bound: usize| {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 33) as usize % bound
    };
    for _ in 0..300 {
        let mut changed = blocks.clone();
        for _ in 0..=next(3) {
            let block = next(changed.len());
            let byte = next(changed[block].len());
            changed[block][byte] = next(256) as u8;
        }
        // Any outcome except a panic is right.
        let _ = replay(&joined(&log, &changed), &mut |_| {});
    }
}

/// The contents of the blocks of a log.
fn blocks(log: &[u8]) -> Vec<Vec<u8>> {
    let (mut at, mut blocks) = (10, Vec::new());
    while at < log.len() {
        let length = u32::from_le_bytes(log[at..at + 4].try_into().unwrap()) as usize;
        blocks.push(log[at + 8..at + 8 + length].to_vec());
        at += 8 + length;
    }
    blocks
}

/// A log of these blocks with correct checksums. Its header is that of `log`.
fn joined(log: &[u8], blocks: &[Vec<u8>]) -> Vec<u8> {
    let mut joined = log[..10].to_vec();
    for block in blocks {
        let length = (block.len() as u32).to_le_bytes();
        joined.extend_from_slice(&length);
        joined.extend_from_slice(&crc32(&[&length[..], block].concat()).to_le_bytes());
        joined.extend_from_slice(block);
    }
    joined
}

/// CRC-32 as in ISO 3309, calculated bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
    !bytes.iter().fold(u32::MAX, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), step))
}

/// A show of twelve robots that drive from one row to another, over a film of three pictures.
fn over_a_film() -> Show {
    let pixel = |id: u32, y: f64| Pixel {
        id,
        at: Vec2::new(f64::from(id) * 0.2 - 1.1, y),
        color: Rgb::new(255, 80, 0),
        ..Pixel::default()
    };
    let frame = |y: f64| Frame {
        air_time_s: 6.0,
        pixels: (0..12).map(|id| pixel(id, y)).collect(),
        ..Frame::default()
    };
    let hash = AssetHash([7; 32]);
    let codes = (0..3 * 8 * 8 * 3u32).map(|n| (n * 31 % 256) as u8).collect();
    let asset = Asset {
        name: "film.gif".into(),
        media_type: "image/gif".into(),
        bytes: 99,
        content: None,
        picture: Some(LayerPicture { width: 8, height: 8, codes }.into()),
    };
    let settings = [
        ("picture", Setting::Text(hash.to_string())),
        ("size_m", Setting::Number(3.0)),
        ("speed_hz", Setting::Number(0.5)),
    ];
    let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    let layer = Layer { name: String::new(), kind: "picture".into(), span: LayerSpan::Show, settings };
    let frames = vec![frame(0.9), frame(-0.8)];
    Show { layers: vec![layer], assets: [(hash, asset)].into(), frames, ..Show::default() }
}

#[test]
fn a_film_on_the_floor_is_shown_and_a_recorded_run_with_it_repeats() {
    let (report, log) = recorded(&over_a_film(), &options("loss=0%", 2));
    let lights = report.lights;
    assert!(report.contacts == 0 && lights.compared > 1_000, "{lights:?}");
    assert!(lights.wrong * 500 <= lights.compared, "{lights:?}");
    let again = replayed(&log);
    assert_eq!((again.difference, again.robots), (None, 12));
    // The log holds the film's pixels, because a run with another film is another run.
    assert!(log.windows(8).any(|codes| codes == [0, 31, 62, 93, 124, 155, 186, 217]));
}
