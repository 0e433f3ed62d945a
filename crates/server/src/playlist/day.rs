//! What a playlist does next: a function of its entries, of local time, and of what has happened. No clock, no IO.
//!
//! An entry with a time of day and the entries that follow it are a **chain**. A chain is played on a **day**, the local day
//! of its first entry's time, and may go on after midnight. A **turn** is an entry on a day. It is due at its time, or a
//! pause after the turn before it was over, in whatever way. It begins within [`LATE_S`] of that, or is skipped.

use std::collections::BTreeMap;

use chrono::{NaiveDate, TimeZone};
use serde::{Deserialize, Serialize};

use super::list::{PlaylistTurn, TurnStart};
use super::times::{date_of, moment};

/// How late a show may begin, seconds: an audience still waits then. A turn that is later is skipped and never caught up.
pub const LATE_S: i64 = 300;

/// The switch, and what happened to each entry last.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DayLog {
    /// When the playlist was switched on, seconds since 1970; `None`: it is off.
    #[serde(default)]
    pub on_since_s: Option<i64>,
    /// Why nothing starts until a person lets the playlist go on: one sentence.
    #[serde(default)]
    pub held: Option<String>,
    /// By the entries' numbers.
    #[serde(default)]
    pub turns: BTreeMap<u32, TurnRecord>,
}

/// What happened to an entry on a day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TurnRecord {
    /// The day of its chain.
    pub date: NaiveDate,
    pub stage: TurnStage,
    /// When that began, seconds since 1970.
    pub at_s: i64,
    /// Why it failed or was skipped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<String>,
}

/// How far an entry has come on a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TurnStage {
    /// Robots were sent to their starting places; the pause goes on.
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
    /// Why, with a remedy.
    Failed(String),
    /// Why, with a remedy.
    Skipped(String),
}

/// An entry on a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurnKey {
    pub id: u32,
    pub date: NaiveDate,
}

/// What is to be done now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaylistAct {
    Nothing,
    /// Drive robots to their starting places, because the pause before this turn began.
    Home(TurnKey),
    /// Begin the show, or go on trying until this moment, seconds since 1970.
    Play(TurnKey, i64),
    /// Its last moment is over, seconds since 1970.
    Skip(TurnKey, i64),
}

/// Where a turn is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnPlace<'a> {
    /// It plays or is over.
    Begun(&'a TurnRecord),
    /// It starts at this moment, seconds since 1970.
    Due { at_s: i64, is_home_asked: bool },
    /// The turn before it is not over.
    Unknown,
    /// The time of its chain was over when the playlist was switched on.
    Past,
}

impl TurnStage {
    fn is_over(self) -> bool {
        matches!(self, Self::Played | Self::Failed | Self::Skipped)
    }
}

impl DayLog {
    /// Notes how far a turn is.
    pub fn note(&mut self, key: TurnKey, stage: TurnStage, at_s: i64, line: Option<String>) {
        self.turns.insert(key.id, TurnRecord { date: key.date, stage, at_s, line });
    }

    /// The turn that plays, if one does.
    pub fn playing(&self) -> Option<TurnKey> {
        let mut playing = self.turns.iter().filter(|(_, record)| record.stage == TurnStage::Playing);
        playing.next().map(|(id, record)| TurnKey { id: *id, date: record.date })
    }
}

/// What to do now. `is_free`: robots do nothing, so a show could begin.
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
    // The earliest first; of two at one time the first of the list.
    acts.sort_by_key(|(at_s, act)| (matches!(act, PlaylistAct::Home(_)), *at_s));
    acts.into_iter().next().map_or(PlaylistAct::Nothing, |(_, act)| act)
}

/// The turns of a day, as far as the chains of the list are played on it.
pub fn places<'a, Z: TimeZone>(
    list: &'a [PlaylistTurn],
    log: &'a DayLog,
    (date, zone): (NaiveDate, &Z),
    on_since_s: i64,
) -> Vec<(&'a PlaylistTurn, TurnPlace<'a>)> {
    let mut found = Vec::new();
    // When the turn before was over; `None`: it is not.
    let mut before: Option<i64> = None;
    let (mut is_played, mut is_past) = (false, false);
    for turn in list {
        let record = log.turns.get(&turn.id);
        let own = record.filter(|record| record.date == date);
        let begun = own.filter(|record| record.stage != TurnStage::SentHome);
        let due = match &turn.start {
            TurnStart::At { time, .. } => {
                // A chain that has begun on a later day does not go on with this one.
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
