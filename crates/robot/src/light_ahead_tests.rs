use super::*;

const WHITE: Rgb = Rgb::new(255, 255, 255);

/// From black to white within a second.
fn stretch(number: u32, anchor: LightAnchor, skip: Span) -> LightStretch {
    let records =
        heapless::Vec::from_slice(&[LightRecord::Line { ticks: 100, to: WHITE }]).expect("one record fits");
    LightStretch { number, anchor, skip, over: Span::ZERO, start: Rgb::BLACK, records }
}

fn ms(ms: u64) -> Instant {
    Instant(ms * 1000)
}

fn stored() -> StoredTracks {
    [StoredTrack::EMPTY, StoredTrack::EMPTY, StoredTrack::EMPTY]
}

#[test]
fn a_stretch_waits_for_its_start_and_stands_in_a_hold() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(1, LightAnchor::Start(7), Span::ZERO), &mut storage);
    assert_eq!((tracks.newest(), tracks.step(ms(900), WHITE, &storage)), (1, None));
    tracks.start(7, ms(1000));
    tracks.start(7, ms(2000));
    tracks.start(7, ms(1500));
    assert_eq!(tracks.step(ms(1990), WHITE, &storage), None, "the later moment counts");
    assert_eq!(tracks.step(ms(2200), WHITE, &storage), Some(Rgb::new(51, 51, 51)));
    tracks.note(ms(2400), true);
    // 0.4 s until the hold, and half of the 0.3 s in which it falls to rest.
    let held = Some(Rgb::new(140, 140, 140));
    assert_eq!([2_700, 9_000].map(|at| tracks.step(ms(at), WHITE, &storage)), [held, held]);
    tracks.note(ms(10_000), false);
    assert_eq!(tracks.step(ms(10_300), WHITE, &storage), Some(Rgb::new(179, 179, 179)));
    assert_eq!(tracks.step(ms(20_000), WHITE, &storage), Some(WHITE));
    assert!(!tracks.is_any());
}

#[test]
fn a_free_stretch_goes_on_in_a_hold() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.note(ms(1100), true);
    tracks.keep(&stretch(1, LightAnchor::Free(ms(1000)), Span::ZERO), &mut storage);
    assert_eq!(tracks.step(ms(1600), WHITE, &storage), Some(Rgb::new(153, 153, 153)));
}

#[test]
fn the_next_stretch_takes_over_at_its_time_and_blends_from_what_is_shown() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(1, LightAnchor::Moment(ms(1000)), Span::ZERO), &mut storage);
    let next = stretch(2, LightAnchor::Moment(ms(1000)), Span::from_millis(500));
    tracks.keep(&LightStretch { over: Span::from_millis(500), ..next }, &mut storage);
    let at = |tracks: &mut LightAhead, at: u64, shown: u8| {
        tracks.step(ms(at), Rgb::new(shown, 0, 0), &storage).map(|colour| colour.r)
    };
    assert_eq!(at(&mut tracks, 1499, 0), Some(127));
    assert_eq!(at(&mut tracks, 1500, 127), Some(127), "it begins with the colour shown");
    assert_eq!(at(&mut tracks, 1750, 127), Some(96), "half of 127 and half of 64");
    assert_eq!(at(&mut tracks, 2000, 96), Some(128));
}

#[test]
fn a_start_deletes_what_waits_for_a_moment() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(1, LightAnchor::Start(7), Span::ZERO), &mut storage);
    tracks.keep(&stretch(2, LightAnchor::Moment(ms(1500)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(3, LightAnchor::Start(8), Span::ZERO), &mut storage);
    tracks.start(7, ms(1000));
    assert_eq!(tracks.step(ms(1000), WHITE, &storage), Some(Rgb::BLACK));
    assert_eq!((tracks.waiting.len(), tracks.waiting[0].seq), (1, Some(8)));
}

#[test]
fn a_stretch_replaces_those_sent_before_it_that_wait_for_a_moment() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(1, LightAnchor::Start(7), Span::ZERO), &mut storage);
    tracks.keep(&stretch(2, LightAnchor::Moment(ms(3000)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(3, LightAnchor::Moment(ms(1000)), Span::ZERO), &mut storage);
    assert_eq!(tracks.step(ms(1000), WHITE, &storage), Some(Rgb::BLACK));
    assert!(tracks.waiting.iter().map(|kept| kept.number).eq([1]));
    tracks.keep(&stretch(4, LightAnchor::Moment(ms(2000)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(5, LightAnchor::Moment(ms(3000)), Span::ZERO), &mut storage);
    tracks.step(ms(2000), WHITE, &storage);
    assert!(tracks.waiting.iter().map(|kept| kept.number).eq([1, 5]), "a later one waits on");
}

#[test]
fn a_late_resume_brings_a_stretch_that_waits_to_its_time() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(1, LightAnchor::Moment(ms(1000)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(2, LightAnchor::Moment(ms(1000)), Span::from_millis(3_000)), &mut storage);
    tracks.step(ms(1000), WHITE, &storage);
    tracks.note(ms(1500), true);
    tracks.step(ms(4000), WHITE, &storage);
    assert_eq!(tracks.waiting.len(), 1, "its time stands at 0.65 s");
    tracks.note(ms(1800), false);
    assert_eq!(tracks.step(ms(4700), WHITE, &storage), Some(Rgb::new(102, 102, 102)));
}

#[test]
fn a_late_stretch_begins_in_its_middle_and_an_old_one_changes_nothing() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    tracks.keep(&stretch(9, LightAnchor::Moment(ms(1000)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(8, LightAnchor::Moment(ms(0)), Span::ZERO), &mut storage);
    tracks.keep(&stretch(9, LightAnchor::Moment(ms(0)), Span::ZERO), &mut storage);
    assert_eq!(tracks.waiting.len(), 1);
    assert_eq!(tracks.step(ms(1800), WHITE, &storage), Some(Rgb::new(204, 204, 204)));
}

#[test]
fn more_stretches_than_there_is_room_for_replace_the_last_that_waits() {
    let (mut tracks, mut storage) = (LightAhead::default(), stored());
    for number in 1..=6 {
        let from = ms(u64::from(number) * 1000);
        tracks.keep(&stretch(number, LightAnchor::Moment(from), Span::ZERO), &mut storage);
    }
    assert_eq!(tracks.newest(), 6);
    assert!(tracks.waiting.iter().map(|kept| kept.from).eq([1000, 2000, 6000].map(|at| Some(ms(at)))));
}
