//! Converts between local times of day and moments.

use chrono::{NaiveDate, NaiveTime, TimeDelta, TimeZone};

/// Longest gap in local time that is searched, minutes: no clock was ever put forward by more than a day.
const GAP_MAX_MIN: usize = 26 * 60;

/// Returns the moment of a local time on a day, seconds since 1970. If the clock is put back and the time occurs twice,
/// the first occurrence counts. If the clock is put forward past the time, the end of that gap counts. A zone with a
/// longer gap than `GAP_MAX_MIN` gets the time that many minutes later, taken as UTC.
pub fn moment<Z: TimeZone>(zone: &Z, date: NaiveDate, time: NaiveTime) -> i64 {
    let mut local = date.and_time(time);
    for _ in 0..GAP_MAX_MIN {
        if let Some(found) = zone.from_local_datetime(&local).earliest() {
            return found.timestamp();
        }
        local += TimeDelta::minutes(1);
    }
    local.and_utc().timestamp()
}

/// Returns the local day of a moment, which is in seconds since 1970.
pub fn date_of<Z: TimeZone>(zone: &Z, at_s: i64) -> NaiveDate {
    local(zone, at_s).date_naive()
}

/// Formats the local time of day of a moment as `HH:MM`.
pub fn clock_text<Z: TimeZone>(zone: &Z, at_s: i64) -> String {
    local(zone, at_s).naive_local().format("%H:%M").to_string()
}

/// Formats the local time of a moment as `19:00`, or as `Fri 19:00` if its day is not that of `now_s`.
pub fn day_text<Z: TimeZone>(zone: &Z, at_s: i64, now_s: i64) -> String {
    let is_today = date_of(zone, at_s) == date_of(zone, now_s);
    let format = if is_today { "%H:%M" } else { "%a %H:%M" };
    local(zone, at_s).naive_local().format(format).to_string()
}

/// Converts a moment to local time. A moment that cannot be a date becomes 1970, which clocks of machines never show.
fn local<Z: TimeZone>(zone: &Z, at_s: i64) -> chrono::DateTime<Z> {
    let utc = chrono::DateTime::from_timestamp(at_s, 0).unwrap_or_default();
    utc.with_timezone(zone)
}
