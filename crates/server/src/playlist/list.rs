//! The entries of a playlist: read, checked, and written.

use chrono::{Datelike, NaiveDate, NaiveTime};
use lightbots_api::{PlaylistDay, PlaylistEntry};
use lightbots_show::SPEED_MIN_PERCENT;

/// The most entries: a show every quarter of an hour, all day.
pub const ENTRIES_MAX: usize = 96;
/// Longest pause, minutes: half a day. Only the chains of today and yesterday are looked at. With longer pauses,
/// entries would not be played, because their chain began earlier.
const PAUSE_MAX_MIN: u32 = 720;
/// The longest name of a show, bytes: as in the library.
const NAME_MAX: usize = 200;
/// Days of the week, Monday first.
const DAYS: [PlaylistDay; 7] = [
    PlaylistDay::Mon,
    PlaylistDay::Tue,
    PlaylistDay::Wed,
    PlaylistDay::Thu,
    PlaylistDay::Fri,
    PlaylistDay::Sat,
    PlaylistDay::Sun,
];

/// A checked entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlaylistTurn {
    /// Number by which records refer to the entry; 0 before it got one.
    pub id: u32,
    /// Name of the show in the library.
    pub show: String,
    pub start: TurnStart,
    /// Speed of drives, percent.
    pub speed_percent: u32,
}

/// When an entry starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TurnStart {
    /// At a local time of day.
    At {
        time: NaiveTime,
        /// Days of the week, Monday first.
        days: [bool; 7],
    },
    /// After the end of the preceding entry and a pause of `pause_s` seconds.
    After {
        pause_s: i64,
        /// Whether robots drive to their starting places at the beginning of the pause.
        home: bool,
    },
}

impl PlaylistTurn {
    /// Whether the entry has a time of day and is played on this day of the week.
    pub fn is_on(&self, date: NaiveDate) -> bool {
        let day = date.weekday().num_days_from_monday() as usize;
        matches!(&self.start, TurnStart::At { days, .. } if days[day])
    }
}

/// Checks all entries. The error names the entry, what is wrong, and what to do.
pub fn read(entries: &[PlaylistEntry]) -> Result<Vec<PlaylistTurn>, String> {
    if entries.len() > ENTRIES_MAX {
        return Err(format!("{} entries are too many: at most {ENTRIES_MAX} are possible", entries.len()));
    }
    let mut turns = Vec::with_capacity(entries.len());
    for (index, entry) in entries.iter().enumerate() {
        let turn = turn(entry, index).map_err(|fault| format!("entry {}: {fault}", index + 1))?;
        if turn.id != 0 && turns.iter().any(|other: &PlaylistTurn| other.id == turn.id) {
            return Err(format!("entry {}: another entry has its id {} already", index + 1, turn.id));
        }
        turns.push(turn);
    }
    Ok(turns)
}

fn turn(entry: &PlaylistEntry, index: usize) -> Result<PlaylistTurn, String> {
    let PlaylistEntry { id, show, speed_percent, .. } = entry;
    if show.is_empty() || show.len() > NAME_MAX || show.chars().any(char::is_control) {
        return Err("show is no name of a show: name one of the library".into());
    }
    if !(SPEED_MIN_PERCENT..=100).contains(speed_percent) {
        return Err(format!("speed_percent is {speed_percent}: say {SPEED_MIN_PERCENT} to 100"));
    }
    let start = start(entry)?;
    if index == 0 && matches!(start, TurnStart::After { .. }) {
        return Err("the first entry has no entry before it: give it a time of day (at)".into());
    }
    Ok(PlaylistTurn { id: *id, show: show.clone(), start, speed_percent: *speed_percent })
}

fn start(entry: &PlaylistEntry) -> Result<TurnStart, String> {
    match (&entry.at, entry.pause_min) {
        (Some(at), None) if !entry.home => {
            let is_short = at.len() == 5 && at.is_ascii();
            let time = NaiveTime::parse_from_str(at, "%H:%M").ok().filter(|_| is_short);
            let time = time.ok_or_else(|| format!("at is {at:?}: say a time of day such as \"19:00\""))?;
            let is_on = |day: &PlaylistDay| entry.weekdays.is_empty() || entry.weekdays.contains(day);
            Ok(TurnStart::At { time, days: DAYS.map(|day| is_on(&day)) })
        }
        (None, Some(pause)) if entry.weekdays.is_empty() => {
            if pause > PAUSE_MAX_MIN {
                return Err(format!("pause_min is {pause}: at most {PAUSE_MAX_MIN} minutes are possible"));
            }
            Ok(TurnStart::After { pause_s: i64::from(pause) * 60, home: entry.home })
        }
        (Some(_), None) => {
            Err("home belongs to a pause: leave it out, or say pause_min in place of at".into())
        }
        (None, Some(_)) => {
            Err("weekdays belong to a time of day: leave them out, or say at in place of pause_min".into())
        }
        _ => Err("say either at (a time of day) or pause_min (minutes after the entry before it)".into()),
    }
}

/// Converts a checked entry to the form that clients and files have.
pub fn entry(turn: &PlaylistTurn) -> PlaylistEntry {
    let mut entry = PlaylistEntry {
        id: turn.id,
        show: turn.show.clone(),
        speed_percent: turn.speed_percent,
        ..PlaylistEntry::default()
    };
    match &turn.start {
        TurnStart::At { time, days } => {
            entry.at = Some(time.format("%H:%M").to_string());
            if days.contains(&false) {
                entry.weekdays =
                    DAYS.iter().zip(days).filter(|(_, is_on)| **is_on).map(|(day, _)| *day).collect();
            }
        }
        TurnStart::After { pause_s, home } => {
            entry.pause_min = Some((pause_s / 60) as u32);
            entry.home = *home;
        }
    }
    entry
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(time: &str) -> PlaylistEntry {
        PlaylistEntry {
            show: "heart".into(),
            at: Some(time.into()),
            speed_percent: 100,
            ..PlaylistEntry::default()
        }
    }

    #[test]
    fn entries_are_written_as_they_were_read() {
        let weekend = PlaylistEntry { weekdays: vec![PlaylistDay::Sat, PlaylistDay::Sun], ..at("07:05") };
        let after =
            PlaylistEntry { id: 2, at: None, pause_min: Some(20), home: true, speed_percent: 50, ..at("") };
        let entries = [weekend, after];
        let read = read(&entries).unwrap();
        assert_eq!(read.iter().map(entry).collect::<Vec<_>>(), entries);
        let saturday = NaiveDate::from_ymd_opt(2026, 11, 28).unwrap();
        assert!(read[0].is_on(saturday) && !read[0].is_on(saturday.pred_opt().unwrap()));
    }

    #[test]
    fn impossible_entries_are_named_with_a_remedy() {
        let after = |pause| PlaylistEntry { at: None, pause_min: Some(pause), ..at("") };
        for (entries, part) in [
            (vec![at("25:00")], "entry 1: at is \"25:00\""),
            (vec![at("7:05")], "entry 1: at is \"7:05\""),
            (vec![at("+7:05")], "entry 1: at is \"+7:05\""),
            (vec![at("07:05"), PlaylistEntry { home: true, ..at("07:05") }], "entry 2: home belongs"),
            (vec![after(0)], "entry 1: the first entry"),
            (vec![at("07:05"), after(721)], "entry 2: pause_min is 721"),
            (vec![PlaylistEntry { pause_min: Some(1), ..at("07:05") }], "say either at"),
            (vec![PlaylistEntry { at: None, ..at("") }], "say either at"),
            (vec![at("07:05"), PlaylistEntry { weekdays: vec![PlaylistDay::Mon], ..after(1) }], "weekdays"),
            (vec![PlaylistEntry { speed_percent: 101, ..at("07:05") }], "speed_percent is 101"),
            (vec![PlaylistEntry { show: String::new(), ..at("07:05") }], "show is no name"),
            (vec![PlaylistEntry { id: 3, ..at("07:05") }; 2], "entry 2: another entry has its id 3"),
            (vec![at("07:05"); ENTRIES_MAX + 1], "97 entries are too many"),
        ] {
            let fault = read(&entries).unwrap_err();
            assert!(fault.contains(part), "{fault}");
        }
    }
}
