//! Decides what a playlist does next, as a function of its entries, of local time, and of what has happened. No clock,
//! no IO.
//!
//! A **chain** is an entry with a time of day and the entries without one that follow it. A chain is played on a
//! **day**, the local day of its first entry's time, and may continue after midnight. A **turn** is an entry on a day.
//! The first turn of a chain is due at its time of day. Each later turn is due when its pause is over, which begins
//! when the preceding turn was played, failed or skipped. A turn that has not begun [`LATE_S`] seconds after it was due
//! is not played.

use std::collections::BTreeMap;

use chrono::{NaiveDate, TimeZone};
use serde::{Deserialize, Serialize};

use super::list::{PlaylistTurn, TurnStart};
use super::times::{date_of, moment};

/// Longest delay of a show, seconds: an audience still waits for that long. A turn that would begin later counts as skipped
/// or failed, and is not played afterwards.
pub const LATE_S: i64 = 300;

/// Whether the playlist is on or held, and the latest turn of each entry.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DayLog {
    /// Time at which the playlist was switched on, seconds since 1970; `None` if it is off.
    #[serde(default)]
    pub on_since_s: Option<i64>,
    /// Why the playlist is held, one sentence: nothing starts until a person resumes it. `None` if it is not held.
    #[serde(default)]
    pub held: Option<String>,
    /// Latest turn of each entry that had one, by the entry's number.
    #[serde(default)]
    pub turns: BTreeMap<u32, TurnRecord>,
}

/// What happened to an entry on a day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TurnRecord {
    /// Day of the entry's chain.
    pub date: NaiveDate,
    pub stage: TurnStage,
    /// Time at which the stage began, seconds since 1970. For a skipped turn: the last moment at which it could have
    /// begun.
    pub at_s: i64,
    /// Why the turn failed or was skipped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<String>,
}

/// Stage of a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TurnStage {
    /// The drive to the starting places was ordered in the pause before the turn, even if the controller refused it.
    SentHome,
    Playing,
    Played,
    Failed,
    Skipped,
}

/// How a turn ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TurnEnd {
    Played,
    /// The turn failed: why, with a remedy.
    Failed(String),
    /// The turn was skipped: why, with a remedy.
    Skipped(String),
}

/// A turn: an entry on a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurnKey {
    pub id: u32,
    pub date: NaiveDate,
}

/// What the playlist does next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaylistAct {
    Nothing,
    /// Drive robots to their starting places, because the pause before this turn has begun.
    Home(TurnKey),
    /// Begin the show. The number is the last moment at which it may begin, seconds since 1970.
    Play(TurnKey, i64),
    /// Skip the turn. The number is the last moment at which it could have begun, seconds since 1970.
    Skip(TurnKey, i64),
}

/// State of a turn on a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnPlace<'a> {
    /// The turn is playing or is over.
    Begun(&'a TurnRecord),
    /// The turn starts at `at_s`, seconds since 1970. `is_home_asked`: robots are still to drive to their starting places
    /// before it.
    Due { at_s: i64, is_home_asked: bool },
    /// The start is unknown, because the preceding turn is not over.
    Unknown,
    /// The first turn of the chain has not begun, and was due more than [`LATE_S`] seconds before the playlist was
    /// switched on.
    Past,
}

impl TurnStage {
    fn is_over(self) -> bool {
        matches!(self, Self::Played | Self::Failed | Self::Skipped)
    }
}

impl DayLog {
    /// Records the stage of a turn. `at_s` is the time at which the stage began, seconds since 1970.
    pub fn note(&mut self, key: TurnKey, stage: TurnStage, at_s: i64, line: Option<String>) {
        self.turns.insert(key.id, TurnRecord { date: key.date, stage, at_s, line });
    }

    /// Returns the turn that is playing; `None` if none is.
    pub fn playing(&self) -> Option<TurnKey> {
        let mut playing = self.turns.iter().filter(|(_, record)| record.stage == TurnStage::Playing);
        playing.next().map(|(id, record)| TurnKey { id: *id, date: record.date })
    }
}

/// Returns what to do at `now_s`, seconds since 1970, for the chains of today and yesterday. `is_free`: robots do
/// nothing at present, so that a show could begin.
pub fn next_act<Z: TimeZone>(
    list: &[PlaylistTurn],
    log: &DayLog,
    (now_s, zone): (i64, &Z),
    is_free: bool,
) -> PlaylistAct {
    let Some(on_since_s) = log.on_since_s else { return PlaylistAct::Nothing };
    if log.playing().is_some() {
        return PlaylistAct::Nothing;
    }
    let may_move = is_free && log.held.is_none();
    let today = date_of(zone, now_s);
    let days = [today.pred_opt().unwrap_or(today), today];
    let mut acts: Vec<(i64, PlaylistAct)> = Vec::new();
    for date in days {
        for (turn, place) in places(list, log, (date, zone), on_since_s) {
            let TurnPlace::Due { at_s, is_home_asked } = place else { continue };
            let (key, until_s) = (TurnKey { id: turn.id, date }, at_s + LATE_S);
            match () {
                () if now_s > until_s => acts.push((at_s, PlaylistAct::Skip(key, until_s))),
                () if now_s >= at_s && may_move => acts.push((at_s, PlaylistAct::Play(key, until_s))),
                () if now_s < at_s && may_move && is_home_asked => {
                    acts.push((at_s, PlaylistAct::Home(key)));
                }
                () => {}
            }
        }
    }
    // Driving home comes last. Else the earliest comes first; of two at the same time, the first in the list.
    acts.sort_by_key(|(at_s, act)| (matches!(act, PlaylistAct::Home(_)), *at_s));
    acts.into_iter().next().map_or(PlaylistAct::Nothing, |(_, act)| act)
}

/// Returns the turns of the day `date` with their states. Chains that are not played on that day are left out.
/// `on_since_s`: when the playlist was switched on, seconds since 1970.
pub fn places<'a, Z: TimeZone>(
    list: &'a [PlaylistTurn],
    log: &'a DayLog,
    (date, zone): (NaiveDate, &Z),
    on_since_s: i64,
) -> Vec<(&'a PlaylistTurn, TurnPlace<'a>)> {
    let mut found = Vec::new();
    // Time at which the turn before was over; `None` if it is not.
    let mut before: Option<i64> = None;
    let (mut is_played, mut is_past) = (false, false);
    for turn in list {
        let record = log.turns.get(&turn.id);
        let own = record.filter(|record| record.date == date);
        let begun = own.filter(|record| record.stage != TurnStage::SentHome);
        let due = match &turn.start {
            TurnStart::At { time, .. } => {
                // A chain that has already begun on a later day is not played for this day any more.
                let is_newer = record.is_some_and(|record| record.date > date);
                is_played = begun.is_some() || turn.is_on(date) && !is_newer;
                let at_s = moment(zone, date, *time);
                is_past = begun.is_none() && at_s + LATE_S < on_since_s;
                Some((at_s, false))
            }
            TurnStart::After { pause_s, home } => {
                before.map(|over_s| (over_s + pause_s, *home && own.is_none()))
            }
        };
        if !is_played {
            continue;
        }
        let place = match (begun, due) {
            (Some(record), _) => TurnPlace::Begun(record),
            (None, _) if is_past => TurnPlace::Past,
            (None, Some((at_s, is_home_asked))) => TurnPlace::Due { at_s, is_home_asked },
            (None, None) => TurnPlace::Unknown,
        };
        before = begun.filter(|record| record.stage.is_over()).map(|record| record.at_s);
        found.push((turn, place));
    }
    found
}

#[cfg(test)]
#[path = "day_tests.rs"]
mod tests;
