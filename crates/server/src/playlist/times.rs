//! Local times of day and moments.

use chrono::{NaiveDate, NaiveTime, TimeDelta, TimeZone};

/// Longest gap in local time that is looked through, minutes: no clock was ever put forward by more than a day.
const GAP_MAX_MIN: usize = 26 * 60;

/// The moment of a local time on a day, seconds since 1970. Where the clock is put back and the time comes twice, it is the
/// first one; where the clock is put forward over it, it is the moment after the gap.
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

/// The local day of a moment.
pub fn date_of<Z: TimeZone>(zone: &Z, at_s: i64) -> NaiveDate {
    local(zone, at_s).date_naive()
}

/// The local time of day of a moment, `HH:MM`.
pub fn clock_text<Z: TimeZone>(zone: &Z, at_s: i64) -> String {
    local(zone, at_s).naive_local().format("%H:%M").to_string()
}

/// The local time of a moment as it is said at `now_s`: `19:00`, or `Fri 19:00` on another day.
pub fn day_text<Z: TimeZone>(zone: &Z, at_s: i64, now_s: i64) -> String {
    let is_today = date_of(zone, at_s) == date_of(zone, now_s);
    let format = if is_today { "%H:%M" } else { "%a %H:%M" };
    local(zone, at_s).naive_local().format(format).to_string()
}

/// A moment that cannot be written as a date is the earliest one: clocks of machines never show it.
fn local<Z: TimeZone>(zone: &Z, at_s: i64) -> chrono::DateTime<Z> {
    let utc = chrono::DateTime::from_timestamp(at_s, 0).unwrap_or_default();
    utc.with_timezone(zone)
}
