use super::record::{Record, RobotTopic};
use super::*;
use crate::{Config, Controller, OnReturn, Operation};
use lightbots_base::{Instant, Span, StateHash};
use lightbots_show::{Asset, AssetHash, Frame, LayerPicture, Pixel, Show};
use std::sync::Arc;

fn drain(controller: &mut RecordedController) {
    while controller.next_send().is_some() {}
    while controller.next_event().is_some() {}
    while controller.next_plan_request().is_some() {}
}

/// Returns the log of a controller that gets messages, operations and time. The fourth input is a time question.
fn log() -> Vec<u8> {
    let mut controller = RecordedController::new(Controller::new(Config::default()));
    assert!(controller.begin_log(Instant(1_000_000), vec![("command".into(), "test".into())]));
    controller.connected(Instant(1_000_000));
    drain(&mut controller);
    controller.message(Instant(1_000_100), "T/LightBot/UUID", b"a 0.5 1.3");
    controller.message(Instant(1_000_200), "T/LightBot/Strange", b"?");
    controller.message(Instant(1_000_300), "T/LightBot/Time", b"a 123456");
    drain(&mut controller);
    controller.wake(Instant(1_500_000));
    let frame = Frame { pixels: vec![Pixel::default()], ..Frame::default() };
    let show = Arc::new(Show { frames: vec![frame], ..Show::default() });
    controller.operate(Instant(3_000_000), Operation::Open(show)).unwrap();
    let play = Operation::Play { from: 7, missing: Default::default() };
    assert!(controller.operate(Instant(3_000_001), play).is_err());
    drain(&mut controller);
    controller.disconnected(Instant(4_000_000));
    drain(&mut controller);
    let mut log = controller.take_log();
    log.extend(controller.end_log());
    log
}

#[test]
fn a_replay_has_the_same_outputs() {
    let report = replay(&log(), &mut |_| {}).unwrap();
    assert_eq!((report.difference, report.end), (None, LogEnd::Complete));
    assert_eq!((report.inputs, report.messages, report.robots), (8, 3, 1));
    assert_eq!(report.lasted.as_secs(), 3.0);
    assert_eq!(report.notes, [("command".to_owned(), "test".to_owned())]);
}

#[test]
fn a_log_that_grows_is_replayed_as_its_bytes_come() {
    let log = log();
    let whole = replay(&log, &mut |_| {}).unwrap();
    for piece in [1, 7, 1_000] {
        let (mut growing, mut messages) = (GrowingReplay::default(), 0);
        for bytes in log.chunks(piece) {
            growing
                .feed(bytes, &mut |_, _, step| {
                    messages += u32::from(matches!(step, ReplayStep::Message { .. }))
                })
                .unwrap();
        }
        assert_eq!((growing.finish().unwrap(), messages), (whole.clone(), 3), "{piece} bytes at once");
    }
    let mut cut = GrowingReplay::default();
    cut.feed(&log[..log.len() - 1], &mut |_, _, _| {}).unwrap();
    assert!(matches!(cut.finish().unwrap().end, LogEnd::Cut(_)));
    assert_eq!(GrowingReplay::default().feed(b"no log at all", &mut |_, _, _| {}), Err(LogError::NoLog));
    assert_eq!(GrowingReplay::default().finish(), Err(LogError::NoHeader));
}

#[test]
fn an_input_that_was_changed_is_found_with_its_place() {
    let log = log();
    let mut blocks = crate::block::Blocks::new(&log, MAGIC.len() + 2);
    let mut changed = log[..MAGIC.len() + 2].to_vec();
    crate::block::append_block(&mut changed, blocks.next().unwrap());
    for block in blocks {
        let text = b"123456";
        let mut block = block.to_vec();
        if let Some(at) = block.windows(text.len()).position(|bytes| bytes == text) {
            block[at] = b'9';
        }
        crate::block::append_block(&mut changed, &block);
    }
    let report = replay(&changed, &mut |_| {}).unwrap();
    assert_eq!(report.end, LogEnd::NotReached, "the log is whole, but was not read to its end");
    let difference = report.difference.unwrap();
    assert_eq!((difference.input, difference.at), (4, Instant(1_000_300)));
    assert_eq!(difference.what, "T/LightBot/Time a 923456");
    assert_eq!(difference.outputs[0], "T/LightBot/a |TIME 923456 1000300 1000300|");
}

#[test]
fn a_log_begins_only_at_rest() {
    let mut controller = RecordedController::new(Controller::new(Config::default()));
    controller.connected(Instant(5));
    assert!(!controller.begin_log(Instant(5), Vec::new()), "messages wait");
    assert!(controller.take_log().is_empty() && controller.end_log().is_empty());
    drain(&mut controller);
    assert!(controller.begin_log(Instant(5), Vec::new()) && controller.is_recording());
}

/// A change of any type that is written changes these bytes. Then raise [`VERSION`], so that older logs are refused by
/// their number and not misread.
#[test]
fn the_format_is_that_of_its_version() {
    let mut controller = RecordedController::new(Controller::new(Config::default()));
    controller.connected(Instant(5));
    let pixel = Pixel { robot: Some("a".into()), ..Pixel::default() };
    let frame = Frame { pixels: vec![pixel], ..Frame::default() };
    let picture = Some(Arc::new(LayerPicture { width: 1, height: 1, codes: vec![7, 8, 9] }));
    let (name, media_type) = ("a.png".into(), "image/png".into());
    let asset = Asset { name, media_type, bytes: 9, content: None, picture };
    let assets = [(AssetHash([5; 32]), asset)].into();
    let show = Show { frames: vec![frame], starts: Some(Vec::new()), assets, ..Show::default() };
    controller.operate(Instant(5), Operation::Open(Arc::new(show))).unwrap();
    controller.message(Instant(6), "T/LightBot/Status", b"a 0.5 1.3 st=driving h=1 bat=5 off=0.01 fw=x");
    drain(&mut controller);
    let mut hash = StateHash::new();
    hash.bytes(&controller.checkpoint().unwrap());
    let after = Span(300);
    let records = [
        Record::Wake(after),
        Record::Message { after, topic: RobotTopic::Time, like: 1, front: 2, back: 3, middle: b"4" },
        Record::OtherMessage { after, topic: "T", payload: b"?" },
        Record::Connected(after),
        Record::Disconnected(after),
        Record::Operation { after, operation: Operation::Pin { pixel: 1, robot: None } },
        Record::Planned { after, number: 1, cancelled_at: 0 },
        Record::Outputs { taken: 15, digest: [1, 2] },
        Record::End { digest: 3 },
    ];
    // A record may hold a run of a journal.
    hash.word(crate::journal::VERSION.into());
    hash.bytes(
        &postcard::to_allocvec(&[OnReturn::GoOrAsk, OnReturn::Go, OnReturn::Ask, OnReturn::Stop]).unwrap(),
    );
    records.iter().for_each(|record| hash.bytes(&postcard::to_allocvec(record).unwrap()));
    assert_eq!((VERSION, hash.finish()), (28, 17_186_407_184_434_635_425));
}
