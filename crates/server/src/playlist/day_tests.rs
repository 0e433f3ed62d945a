//! Tests of days of a playlist: midnight, weekdays, clocks that are put forward and back, overlap, failures.

use chrono::{FixedOffset, NaiveDateTime, NaiveTime};
use lightbots_api::PlaylistResult;

use super::*;

/// Central European time: put forward on 29 March 2026 at 2:00, back on 25 October at 3:00.
#[derive(Clone, Copy, Debug)]
struct Berlin;

const FORWARD: &str = "2026-03-29T01:00:00";
const BACK: &str = "2026-10-25T01:00:00";

fn utc(text: &str) -> NaiveDateTime {
    text.parse().unwrap()
}

fn hours(count: i32) -> FixedOffset {
    FixedOffset::east_opt(count * 3600).unwrap()
}

impl TimeZone for Berlin {
    type Offset = FixedOffset;

    fn from_offset(_: &FixedOffset) -> Self {
        Self
    }

    fn offset_from_local_date(&self, local: &NaiveDate) -> chrono::LocalResult<FixedOffset> {
        self.offset_from_local_datetime(&local.and_time(NaiveTime::MIN))
    }

    fn offset_from_local_datetime(&self, local: &NaiveDateTime) -> chrono::LocalResult<FixedOffset> {
        let fits = |offset: FixedOffset| self.offset_from_utc_datetime(&(*local - offset)) == offset;
        match [hours(2), hours(1)].into_iter().filter(|offset| fits(*offset)).collect::<Vec<_>>()[..] {
            [one] => chrono::LocalResult::Single(one),
            [one, other] => chrono::LocalResult::Ambiguous(one, other),
            _ => chrono::LocalResult::None,
        }
    }

    fn offset_from_utc_date(&self, date: &NaiveDate) -> FixedOffset {
        self.offset_from_utc_datetime(&date.and_time(NaiveTime::MIN))
    }

    fn offset_from_utc_datetime(&self, at: &NaiveDateTime) -> FixedOffset {
        if (utc(FORWARD)..utc(BACK)).contains(at) { hours(2) } else { hours(1) }
    }
}

/// Returns a local time that occurs once, in summer or winter, as seconds since 1970.
fn at(text: &str) -> i64 {
    Berlin.from_local_datetime(&utc(text)).single().unwrap().timestamp()
}

fn date(text: &str) -> NaiveDate {
    text.parse().unwrap()
}

fn set(id: u32, time: &str) -> PlaylistTurn {
    on_days(id, time, [true; 7])
}

fn on_days(id: u32, time: &str, days: [bool; 7]) -> PlaylistTurn {
    let time = format!("{time}:00").parse().unwrap();
    let start = TurnStart::At { time, days };
    PlaylistTurn { id, show: format!("show {id}"), start, speed_percent: 100 }
}

fn after(id: u32, pause_min: i64, home: bool) -> PlaylistTurn {
    let start = TurnStart::After { pause_s: pause_min * 60, home };
    PlaylistTurn { id, show: format!("show {id}"), start, speed_percent: 100 }
}

fn on_since(text: &str) -> DayLog {
    DayLog { on_since_s: Some(at(text)), ..DayLog::default() }
}

fn key(id: u32, day: &str) -> TurnKey {
    TurnKey { id, date: date(day) }
}

fn act(list: &[PlaylistTurn], log: &DayLog, now: &str) -> PlaylistAct {
    next_act(list, log, (at(now), &Berlin), true)
}

/// Plays a day on which each turn takes `run_s` seconds. Returns when each turn began and which were skipped, in order.
fn played(list: &[PlaylistTurn], log: &mut DayLog, span: (i64, i64), run_s: i64) -> Vec<String> {
    let mut told = Vec::new();
    let mut runs: Option<(TurnKey, i64)> = None;
    let mut now_s = span.0;
    while now_s < span.1 {
        if let Some((key, _)) = runs.take_if(|(_, until_s)| *until_s <= now_s) {
            log.note(key, TurnStage::Played, now_s, None);
        }
        let clock = crate::playlist::clock_text(&Berlin, now_s);
        match next_act(list, log, (now_s, &Berlin), runs.is_none()) {
            PlaylistAct::Nothing => now_s += 60,
            PlaylistAct::Home(key) => {
                told.push(format!("{clock} home for {}", key.id));
                log.note(key, TurnStage::SentHome, now_s, None);
            }
            PlaylistAct::Play(key, _) => {
                told.push(format!("{clock} {}", key.id));
                log.note(key, TurnStage::Playing, now_s, None);
                runs = Some((key, now_s + run_s));
            }
            PlaylistAct::Skip(key, at_s) => {
                told.push(format!("{clock} without {}", key.id));
                log.note(key, TurnStage::Skipped, at_s, None);
            }
        }
    }
    told
}

#[test]
fn a_day_has_its_times_pauses_and_drives_home() {
    let list = [set(1, "19:00"), after(2, 20, true), set(3, "21:30")];
    let mut log = on_since("2026-05-04T10:00:00");
    let days = (at("2026-05-04T18:00:00"), at("2026-05-05T22:00:00"));
    let day = ["19:00 1", "19:10 home for 2", "19:30 2", "21:30 3"];
    assert_eq!(played(&list, &mut log, days, 600), [day, day].concat());
}

#[test]
fn only_its_weekdays_are_played() {
    // 4 May 2026 is a Monday.
    let mut days = [false; 7];
    (days[1], days[6]) = (true, true);
    let list = [on_days(1, "19:00", days), after(2, 0, false)];
    let mut log = on_since("2026-05-04T10:00:00");
    let week = (at("2026-05-04T12:00:00"), at("2026-05-11T12:00:00"));
    assert_eq!(played(&list, &mut log, week, 60), ["19:00 1", "19:01 2", "19:00 1", "19:01 2"]);
}

#[test]
fn a_chain_goes_on_after_midnight() {
    let list = [set(1, "23:50"), after(2, 20, true), after(3, 10, false)];
    let mut log = on_since("2026-05-04T10:00:00");
    let night = (at("2026-05-04T23:00:00"), at("2026-05-05T02:00:00"));
    let told = played(&list, &mut log, night, 900);
    assert_eq!(told, ["23:50 1", "00:05 home for 2", "00:25 2", "00:50 3"]);
    assert_eq!(log.turns[&3].date, date("2026-05-04"));
}

#[test]
fn a_time_in_the_hour_that_is_left_out_is_the_moment_after_it() {
    let list = [set(1, "02:30")];
    let mut log = on_since("2026-03-28T10:00:00");
    let night = (at("2026-03-29T00:00:00"), at("2026-03-29T12:00:00"));
    assert_eq!(played(&list, &mut log, night, 60), ["03:00 1"]);
}

#[test]
fn a_time_that_comes_twice_is_played_once() {
    let list = [set(1, "02:30"), after(2, 60, false)];
    let mut log = on_since("2026-10-24T10:00:00");
    let night = (at("2026-10-25T00:00:00"), at("2026-10-25T12:00:00"));
    // The pause is an hour of 3,600 s: the clock was put back meanwhile.
    assert_eq!(played(&list, &mut log, night, 60), ["02:30 1", "02:31 2"]);
    let first = log.turns[&1].at_s;
    assert_eq!(first, utc("2026-10-25T00:31:00").and_utc().timestamp());
}

#[test]
fn a_show_that_is_on_makes_the_next_one_wait_and_then_drop_out() {
    let list = [set(1, "19:00"), set(2, "19:10"), set(3, "19:13"), after(4, 2, false)];
    let mut log = on_since("2026-05-04T10:00:00");
    let evening = (at("2026-05-04T18:00:00"), at("2026-05-04T23:00:00"));
    // Each takes 14 minutes: 19:10 waits until 19:14, 19:13 drops out at 19:18, and its follower is due at 19:20.
    let told = played(&list, &mut log, evening, 840);
    assert_eq!(told, ["19:00 1", "19:14 2", "19:28 without 3", "19:28 without 4"]);
    assert_eq!(log.turns[&3].at_s, at("2026-05-04T19:18:00"));
}

#[test]
fn nothing_is_caught_up_after_a_start_and_what_is_due_goes_on() {
    let list = [set(1, "19:00"), after(2, 20, false), set(3, "21:00")];
    let log = on_since("2026-05-03T10:00:00");
    // Yesterday is over, too: its entries are skipped first, in order.
    let mut late = log.clone();
    let told = played(&list, &mut late, (at("2026-05-04T19:26:00"), at("2026-05-04T23:00:00")), 60);
    let today: Vec<_> = told.iter().filter(|line| !line.starts_with("19:26")).collect();
    assert_eq!(today, ["21:00 3"]);
    assert_eq!((late.turns[&1].stage, late.turns[&2].stage), (TurnStage::Skipped, TurnStage::Played));
    assert!(told.contains(&"19:26 2".to_owned()), "due at 19:25, one minute late: {told:?}");
}

#[test]
fn what_was_over_at_the_switch_is_not_played_nor_its_followers() {
    let list = [set(1, "19:00"), after(2, 120, true), set(3, "20:00")];
    let mut log = on_since("2026-05-04T19:30:00");
    let evening = (at("2026-05-04T19:30:00"), at("2026-05-05T12:00:00"));
    assert_eq!(played(&list, &mut log, evening, 60), ["20:00 3"]);
    // A turn that is late by at most `LATE_S` begins at once.
    let mut log = on_since("2026-05-04T19:05:00");
    assert_eq!(
        played(&list[..1], &mut log, (at("2026-05-04T19:05:00"), at("2026-05-04T20:00:00")), 60),
        ["19:05 1"]
    );
}

#[test]
fn a_failed_show_does_not_end_the_day() {
    let list = [set(1, "19:00"), after(2, 1, false), set(3, "20:00")];
    let mut log = on_since("2026-05-04T10:00:00");
    let now = "2026-05-04T19:00:00";
    assert_eq!(act(&list, &log, now), PlaylistAct::Play(key(1, "2026-05-04"), at("2026-05-04T19:05:00")));
    log.note(key(1, "2026-05-04"), TurnStage::Failed, at("2026-05-04T19:00:01"), Some("no such show".into()));
    let evening = (at("2026-05-04T19:01:01"), at("2026-05-04T21:00:00"));
    assert_eq!(played(&list, &mut log, evening, 60), ["19:01 2", "20:00 3"]);
}

#[test]
fn held_or_busy_or_off_no_robot_is_moved() {
    let list = [set(1, "19:00"), after(2, 20, true)];
    let mut log = on_since("2026-05-04T10:00:00");
    log.held = Some("Stop all".into());
    assert_eq!(act(&list, &log, "2026-05-04T19:01:00"), PlaylistAct::Nothing);
    let over = PlaylistAct::Skip(key(1, "2026-05-04"), at("2026-05-04T19:05:00"));
    assert_eq!(act(&list, &log, "2026-05-04T19:05:01"), over);
    log.note(key(1, "2026-05-04"), TurnStage::Skipped, at("2026-05-04T19:05:00"), None);
    assert_eq!(act(&list, &log, "2026-05-04T19:06:00"), PlaylistAct::Nothing, "no drive home");
    log.held = None;
    assert_eq!(act(&list, &log, "2026-05-04T19:06:00"), PlaylistAct::Home(key(2, "2026-05-04")));
    let busy = next_act(&list, &log, (at("2026-05-04T19:25:00"), &Berlin), false);
    assert_eq!(busy, PlaylistAct::Nothing);
    log.on_since_s = None;
    assert_eq!(act(&list, &log, "2026-05-04T19:25:00"), PlaylistAct::Nothing);
}

#[test]
fn the_next_start_is_said_with_its_day() {
    use crate::playlist::view;
    let mut days = [false; 7];
    days[2] = true;
    let list = [on_days(1, "19:00", days), after(2, 20, false)];
    let now = |text: &str| (at(text), &Berlin);
    let next = |log: &DayLog, text: &str| view::next(&list, log, now(text)).unwrap();
    let off = DayLog::default();
    let monday = next(&off, "2026-05-04T19:00:00");
    assert_eq!((monday.id, &*monday.time, monday.in_s), (1, "Wed 19:00", 2 * 86_400));
    assert_eq!(
        (next(&off, "2026-05-06T19:02:00").time.as_str(), next(&off, "2026-05-06T19:02:00").in_s),
        ("19:00", 0)
    );
    assert_eq!(next(&off, "2026-05-06T19:06:00").time, "Wed 19:00", "a week later");
    let mut log = on_since("2026-05-06T18:00:00");
    log.note(key(1, "2026-05-06"), TurnStage::Played, at("2026-05-06T19:10:00"), None);
    assert_eq!(
        (next(&log, "2026-05-06T19:11:00").id, &*next(&log, "2026-05-06T19:11:00").time),
        (2, "19:30")
    );
    let today = view::today(&list, &log, now("2026-05-06T19:11:00"));
    assert_eq!(today[0].result, PlaylistResult::Played);
    assert_eq!((today[1].result, today[1].time.as_deref()), (PlaylistResult::Waiting, Some("19:30")));
    assert_eq!(view::today(&list, &log, now("2026-05-07T12:00:00"))[0].result, PlaylistResult::NotToday);
}

/// What became of each entry today, with its time.
fn today(list: &[PlaylistTurn], log: &DayLog, now: &str) -> Vec<(PlaylistResult, Option<String>)> {
    let said = crate::playlist::view::today(list, log, (at(now), &Berlin));
    said.into_iter().map(|entry| (entry.result, entry.time)).collect()
}

#[test]
fn entries_of_yesterdays_chain_are_shown_while_they_are_to_come() {
    use PlaylistResult::{NotToday, Playing, Waiting};
    // 4 May 2026 is a Monday, the only day of the chain.
    let mut days = [false; 7];
    days[0] = true;
    let list = [on_days(1, "23:50", days), after(2, 20, true), after(3, 10, false)];
    let mut log = on_since("2026-05-04T10:00:00");
    log.note(key(1, "2026-05-04"), TurnStage::Playing, at("2026-05-04T23:50:00"), None);
    let time = |text: &str| Some(text.to_owned());
    let seen = today(&list, &log, "2026-05-05T00:01:00");
    assert_eq!(seen, [(Playing, time("23:50")), (Waiting, None), (Waiting, None)]);
    log.note(key(1, "2026-05-04"), TurnStage::Played, at("2026-05-05T00:05:00"), None);
    let seen = today(&list, &log, "2026-05-05T00:06:00");
    assert_eq!(seen, [(NotToday, None), (Waiting, time("00:25")), (Waiting, None)]);
    log.note(key(2, "2026-05-04"), TurnStage::Played, at("2026-05-05T00:40:00"), None);
    let seen = today(&list, &log, "2026-05-05T00:41:00");
    assert_eq!(seen, [(NotToday, None), (NotToday, None), (Waiting, time("00:50"))]);
    let late = today(&list, &log, "2026-05-05T00:56:00");
    assert_eq!(late[2], (NotToday, None), "it was to begin by 00:55");
}
