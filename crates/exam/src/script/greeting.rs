//! Who is there, how it introduces itself, and where there is room: R3, R5, R9, R10, R13.

use std::collections::BTreeSet;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_wire::{RobotState, Topic};

use super::pilot::{ANSWER, ONCE, Pilot, WAY_M};
use super::{Halt, Step};
use crate::desk::{Desk, Other, To};
use crate::exam::{Ending, News};
use crate::heard::Heard;

/// Long enough for the status reports that come every two seconds.
const LISTEN: Span = Span::from_millis(2_500);
/// How often it is asked who is there: somebody may be connecting just now.
const CALLS: u32 = 4;
/// A robot that was just switched on gets so long to find its place.
const FIRST_FIX: Span = Span::from_millis(5_000);

/// Chooses the robot; everybody else's names.
pub(super) async fn choose(desk: &Desk) -> Result<BTreeSet<String>, Ending> {
    let mut found = Err(Ending::Nobody);
    for _ in 0..CALLS {
        desk.say(To::All, "|UUID|");
        desk.pause(LISTEN).await;
        found = only_one(desk);
        if !matches!(found, Err(Ending::Nobody)) {
            break;
        }
    }
    let subject = found?;
    let names = desk.others().into_keys().collect();
    desk.set_subject(subject);
    desk.judge(3, true, "|UUID|", "a name of 1 to 36 bytes of printable ASCII", subject.as_str());
    Ok(names)
}

/// The robot that was named, or the only one there is.
fn only_one(desk: &Desk) -> Result<RobotId, Ending> {
    let ids: Vec<RobotId> = desk.others().keys().filter_map(|name| RobotId::new(name)).collect();
    match (desk.options.robot, ids.as_slice()) {
        (Some(named), _) if ids.contains(&named) => Ok(named),
        (Some(_), _) | (None, []) => Err(Ending::Nobody),
        (None, [only]) => Ok(*only),
        (None, _) => Err(Ending::Several(ids)),
    }
}

/// How it answers `UUID`, on both topics and on no other.
pub(super) async fn introduce(pilot: &mut Pilot) -> Step {
    pilot.blame.set(13);
    for (to, sent) in [(To::Robot, "|UUID| on its own topic"), (To::All, "|UUID| on Broadcast")] {
        answer_once(pilot, to, sent).await;
    }
    not_for_it(pilot).await;
    let mut heard = pilot.ask().await?;
    let until = pilot.desk.now() + FIRST_FIX;
    while heard.place().is_none() && pilot.desk.now() < until {
        pilot.desk.pause(Span::from_millis(500)).await;
        heard = pilot.ask().await?;
    }
    read_report(pilot, &heard);
    match heard.place() {
        None => pilot.desk.excuse(&DRIVING, "it does not know where it is"),
        Some(at) => on_the_floor(pilot, at)?,
    }
    Ok(())
}

/// Rules that take a robot that knows its place.
const DRIVING: [u8; 24] =
    [8, 12, 16, 17, 18, 19, 20, 27, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 45, 29, 30];

async fn answer_once(pilot: &Pilot, to: To, sent: &str) {
    let desk = &pilot.desk;
    let mark = desk.mark();
    desk.say(to, "|UUID|");
    let on_uuid = |heard: &Heard| (heard.topic == Topic::Uuid && heard.report.is_some()).then_some(());
    let came = desk.wait_for(mark, ANSWER, on_uuid).await.is_some();
    if !came {
        let elsewhere = desk.since(mark, |heard| {
            heard.iter().find(|heard| heard.topic != Topic::Time).map(|heard| heard.topic.write().to_string())
        });
        let came = elsewhere.map_or_else(|| "silence".into(), |topic| format!("a report on {topic}"));
        // Silence on one topic only is a missing subscription.
        let rule = if to == To::All && !desk.is_broken(13) { 5 } else { 13 };
        return desk.judge(rule, false, sent, "a report on T/LightBot/UUID at once", came);
    }
    desk.pause(ONCE).await;
    let count = desk.since(mark, |heard| heard.iter().filter(|heard| heard.topic == Topic::Uuid).count());
    desk.judge(13, count == 1, sent, "one report on T/LightBot/UUID", format!("{count}"));
    desk.judge(5, true, sent, "a report", "a report");
}

/// Commands to a robot next to it are not for it.
async fn not_for_it(pilot: &Pilot) {
    let mark = pilot.desk.mark();
    pilot.desk.say(To::Neighbour, "|UUID|");
    pilot.desk.pause(ONCE).await;
    let count =
        pilot.desk.since(mark, |heard| heard.iter().filter(|heard| heard.topic == Topic::Uuid).count());
    let came = if count == 0 { "nothing".into() } else { format!("{count} reports of this robot") };
    pilot.desk.judge(5, count == 0, "|UUID| on another robot's topic", "nothing", came);
}

/// The form of a report.
fn read_report(pilot: &mut Pilot, heard: &Heard) {
    let fields: Vec<&str> = heard.text.split_ascii_whitespace().collect();
    let is_java = |text: &str| text == "NaN" || (text.parse::<f64>().is_ok() && text.contains('.'));
    let fits = fields.len() >= 3 && fields[1..3].iter().all(|field| is_java(field));
    pilot.desk.judge(
        9,
        fits,
        "|UUID|",
        "<name> <x> <y>, numbers like 1.3, 1.0E-4 or NaN",
        heard.text.clone(),
    );
    let details = heard.report.as_ref().and_then(|report| report.details.as_ref());
    pilot.has_details = details.is_some() || fields.len() > 3;
    pilot.can = details.map(|details| details.abilities).unwrap_or_default();
    if pilot.has_details {
        let wrong = fields.iter().skip(3).find(|field| !is_sensible(field));
        let came = wrong.map_or_else(|| heard.text.clone(), |field| format!("{field} in: {}", heard.text));
        pilot.desk.judge(10, wrong.is_none(), "|UUID|", "fields key=value that make sense", came);
    }
}

/// Whether a further field of a report is as R10 says.
fn is_sensible(field: &str) -> bool {
    let Some((key, value)) = field.split_once('=') else { return false };
    let number = value.parse::<f64>().ok();
    match key {
        "state" => RobotState::from_word(value).is_some(),
        "h" => number.is_some_and(|turn| turn.abs() <= 7.0),
        "off" => number.is_some_and(|off| off >= 0.0),
        "bat" => value.parse::<u32>().is_ok_and(|percent| percent <= 100),
        "route" | "unknown" | "clock" | "starts" => value.parse::<u64>().is_ok(),
        "fw" => !value.is_empty() && value.len() <= 24,
        _ => true,
    }
}

/// A place that no floor has shows a wrong unit.
fn on_the_floor(pilot: &mut Pilot, at: Vec2) -> Step {
    let (width_m, depth_m) = pilot.desk.options.floor;
    let fits = at.x.abs() <= width_m / 2.0 + 0.1 && at.y.abs() <= depth_m / 2.0 + 0.1;
    let expected = format!("metres on a floor of {width_m} x {depth_m}");
    pilot.desk.judge(9, fits, "|UUID|", &expected, format!("x {}, y {}", at.x, at.y));
    if !fits {
        return Err(Halt("its places are not on the floor: another unit, or another --floor".into()));
    }
    pilot.set_home(at);
    pilot.away = at + direction(pilot, at) * WAY_M;
    Ok(())
}

/// Where there is most room: away from the edge and from others.
fn direction(pilot: &Pilot, home: Vec2) -> Vec2 {
    let (width_m, depth_m) = pilot.desk.options.floor;
    let others: Vec<Vec2> = pilot.desk.others().values().filter_map(|other: &Other| other.at).collect();
    let room = |way: Vec2| {
        let end = home + way * (WAY_M + 0.1);
        let edge = (width_m / 2.0 - end.x.abs()).min(depth_m / 2.0 - end.y.abs());
        let near = (0..=8).flat_map(|step| {
            let at = home + way * (f64::from(step) * 0.05);
            others.iter().map(move |other| other.distance(at))
        });
        near.fold(edge, f64::min).min(0.5)
    };
    let mut best = Vec2::new(0.0, -1.0);
    for sixteenth in 0..16 {
        let way = Vec2::unit(f64::from(sixteenth) * std::f64::consts::PI / 8.0);
        if room(way) > room(best) + 1e-9 {
            best = way;
        }
    }
    best
}

/// Says where it will drive and waits to be allowed.
pub(super) async fn ask_for_room(pilot: &Pilot) {
    let Some(robot) = pilot.desk.subject() else { return };
    let towards = pilot.is_placed().then_some(pilot.away);
    pilot.desk.tell(News::Ready { robot, at: towards.map(|_| pilot.home), towards });
    pilot.desk.wait_to_go().await;
}

/// A moment in seconds, for people.
pub(super) fn seconds(from: Instant, to: Instant) -> f64 {
    (to - from).as_secs()
}
