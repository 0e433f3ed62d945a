//! The playlist for screens.

use chrono::{Days, TimeZone};
use lightbots_api::{PlaylistNext, PlaylistResult, PlaylistToday};

use super::day::{DayLog, LATE_S, TurnPlace, TurnStage, places};
use super::list::PlaylistTurn;
use super::times::{clock_text, date_of, day_text};

/// Number of days after today in which the next start is searched. Each weekday thus occurs once, and that of today twice.
const AHEAD: u64 = 7;

/// Returns, for each entry, what became of it today. An entry of yesterday's chain that is still playing, or is still to
/// come, is reported as playing or waiting.
pub fn today<Z: TimeZone>(
    list: &[PlaylistTurn],
    log: &DayLog,
    (now_s, zone): (i64, &Z),
) -> Vec<PlaylistToday> {
    let on_since_s = log.on_since_s.unwrap_or(now_s);
    let date = date_of(zone, now_s);
    let yesterday = date.pred_opt().unwrap_or(date);
    let of_today = places(list, log, (date, zone), on_since_s);
    let of_yesterday = going_on(places(list, log, (yesterday, zone), on_since_s), now_s);
    list.iter()
        .map(|turn| {
            let of = |places: &[(&PlaylistTurn, TurnPlace<'_>)]| {
                places.iter().find(|(other, _)| other.id == turn.id).map(|(_, place)| said(*place, zone))
            };
            of(&of_yesterday).or_else(|| of(&of_today)).unwrap_or(PlaylistToday {
                result: PlaylistResult::NotToday,
                time: None,
                line: None,
            })
        })
        .collect()
}

/// Keeps the turns that are playing at `now_s` or are still to come. A turn without a known start is still to come if the
/// preceding turn was kept.
fn going_on<'a>(
    places: Vec<(&'a PlaylistTurn, TurnPlace<'a>)>,
    now_s: i64,
) -> Vec<(&'a PlaylistTurn, TurnPlace<'a>)> {
    let mut goes_on = false;
    let mut is_kept = |place: &TurnPlace<'_>| {
        goes_on = match place {
            TurnPlace::Begun(record) => record.stage == TurnStage::Playing,
            TurnPlace::Due { at_s, .. } => at_s + LATE_S >= now_s,
            TurnPlace::Unknown => goes_on,
            TurnPlace::Past => false,
        };
        goes_on
    };
    places.into_iter().filter(|(_, place)| is_kept(place)).collect()
}

fn said<Z: TimeZone>(place: TurnPlace<'_>, zone: &Z) -> PlaylistToday {
    let plain = |result, at_s: Option<i64>| PlaylistToday {
        result,
        time: at_s.map(|at_s| clock_text(zone, at_s)),
        line: None,
    };
    match place {
        TurnPlace::Past => plain(PlaylistResult::Past, None),
        TurnPlace::Unknown => plain(PlaylistResult::Waiting, None),
        TurnPlace::Due { at_s, .. } => plain(PlaylistResult::Waiting, Some(at_s)),
        TurnPlace::Begun(record) => {
            let result = match record.stage {
                TurnStage::SentHome => PlaylistResult::Waiting,
                TurnStage::Playing => PlaylistResult::Playing,
                TurnStage::Played => PlaylistResult::Played,
                TurnStage::Failed => PlaylistResult::Failed,
                TurnStage::Skipped => PlaylistResult::Skipped,
            };
            PlaylistToday { line: record.line.clone(), ..plain(result, Some(record.at_s)) }
        }
    }
}

/// Returns the entry that starts next, or is late by at most `LATE_S` seconds; `None` if none starts within [`AHEAD`]
/// days. If the playlist is off, returns the entry that would start next after switching the playlist on at `now_s`.
pub fn next<Z: TimeZone>(
    list: &[PlaylistTurn],
    log: &DayLog,
    (now_s, zone): (i64, &Z),
) -> Option<PlaylistNext> {
    let on_since_s = log.on_since_s.unwrap_or(now_s);
    let date = date_of(zone, now_s);
    let days = (0..=AHEAD + 1).filter_map(|days| date.pred_opt()?.checked_add_days(Days::new(days)));
    let due = days.flat_map(|date| {
        places(list, log, (date, zone), on_since_s).into_iter().filter_map(|(turn, place)| match place {
            TurnPlace::Due { at_s, .. } if at_s + LATE_S >= now_s => Some((at_s, turn)),
            _ => None,
        })
    });
    let (at_s, turn) = due.min_by_key(|(at_s, _)| *at_s)?;
    Some(PlaylistNext {
        id: turn.id,
        show: turn.show.clone(),
        time: day_text(zone, at_s, now_s),
        in_s: u32::try_from(at_s - now_s).unwrap_or(0),
    })
}
