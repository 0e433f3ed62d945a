//! Chooses the robot, checks its first reports, and finds free floor for its drives: R3, R5, R9, R10, R13.

use std::collections::BTreeSet;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_wire::{RobotState, Topic};

use super::pilot::{ANSWER, ONCE, Pilot, WAY_M};
use super::step::{Halt, Step};
use crate::interface::{Ending, ExamEvent};
use crate::received::Received;
use crate::session::{Addressee, OtherRobot, Session};

/// Time to wait for reports of robots. It is longer than the two seconds between status reports (R41).
const LISTEN: Span = Span::from_millis(2_500);
/// Largest number of `UUID` commands that are sent to find robots. A robot may just be connecting, and would be missed
/// with fewer commands.
const CALLS: u32 = 4;
/// Time that a robot has to find its position after power-on: ten times the limit of R14.
const FIRST_FIX: Span = Span::from_millis(5_000);

/// Chooses the robot. Returns the names of all robots that were found. Fails if there is no robot, if the requested
/// robot is missing, or if there are several and none was requested.
pub(super) async fn choose(session: &Session) -> Result<BTreeSet<String>, Ending> {
    let mut found = Err(Ending::NoRobot);
    for _ in 0..CALLS {
        session.send(Addressee::AllRobots, "|UUID|");
        session.pause(LISTEN).await;
        found = only_one(session);
        if !matches!(found, Err(Ending::NoRobot)) {
            break;
        }
    }
    let subject = found?;
    let names = session.others().into_keys().collect();
    session.set_subject(subject);
    session.record(3, true, "|UUID|", "a name of 1 to 36 bytes of printable ASCII", subject.as_str());
    Ok(names)
}

/// The requested robot, or the only robot on the broker if none was requested.
fn only_one(session: &Session) -> Result<RobotId, Ending> {
    let ids: Vec<RobotId> = session.others().keys().filter_map(|name| RobotId::new(name)).collect();
    match (session.options.robot, ids.as_slice()) {
        (Some(named), _) if ids.contains(&named) => Ok(named),
        (Some(_), _) | (None, []) => Err(Ending::NoRobot),
        (None, [only]) => Ok(*only),
        (None, _) => Err(Ending::Several(ids)),
    }
}

/// Tests that the robot answers `UUID` on its own topic and on Broadcast, and not on another robot's topic. Then reads
/// its abilities and position from a report, and tests that the position is on the floor. If the robot does not know
/// its position after [`FIRST_FIX`], marks the rules in [`DRIVING`] as not tried.
pub(super) async fn introduce(pilot: &mut Pilot) -> Step {
    pilot.rule_if_silent.set(13);
    for (to, sent) in
        [(Addressee::Robot, "|UUID| on its own topic"), (Addressee::AllRobots, "|UUID| on Broadcast")]
    {
        answer_once(pilot, to, sent).await;
    }
    not_for_it(pilot).await;
    let mut received = pilot.ask().await?;
    let until = pilot.session.now() + FIRST_FIX;
    while received.place().is_none() && pilot.session.now() < until {
        pilot.session.pause(Span::from_millis(500)).await;
        received = pilot.ask().await?;
    }
    read_report(pilot, &received);
    match received.place() {
        None => pilot.session.mark_untried(&DRIVING, "it does not know where it is"),
        Some(at) => on_the_floor(pilot, at)?,
    }
    Ok(())
}

/// Rules whose tests need a robot that knows its position.
const DRIVING: [u8; 24] =
    [8, 12, 16, 17, 18, 19, 20, 27, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 45, 29, 30];

async fn answer_once(pilot: &Pilot, to: Addressee, sent: &str) {
    let session = &pilot.session;
    let mark = session.mark();
    session.send(to, "|UUID|");
    let on_uuid =
        |received: &Received| (received.topic == Topic::Uuid && received.report.is_some()).then_some(());
    let came = session.wait_for(mark, ANSWER, on_uuid).await.is_some();
    if !came {
        let elsewhere = session.since(mark, |received| {
            received
                .iter()
                .find(|received| received.topic != Topic::Time)
                .map(|received| received.topic.write().to_string())
        });
        let came = elsewhere.map_or_else(|| "silence".into(), |topic| format!("a report on {topic}"));
        // A robot that answers on its own topic but not on Broadcast has not subscribed to Broadcast: R5.
        let rule = if to == Addressee::AllRobots && !session.is_broken(13) { 5 } else { 13 };
        return session.record(rule, false, sent, "a report on T/LightBot/UUID at once", came);
    }
    session.pause(ONCE).await;
    let count = session
        .since(mark, |received| received.iter().filter(|received| received.topic == Topic::Uuid).count());
    session.record(13, count == 1, sent, "one report on T/LightBot/UUID", format!("{count}"));
    session.record(5, true, sent, "a report", "a report");
}

/// Tests that the robot ignores commands on another robot's topic.
async fn not_for_it(pilot: &Pilot) {
    let mark = pilot.session.mark();
    pilot.session.send(Addressee::AbsentRobot, "|UUID|");
    pilot.session.pause(ONCE).await;
    let count = pilot
        .session
        .since(mark, |received| received.iter().filter(|received| received.topic == Topic::Uuid).count());
    let came = if count == 0 { "nothing".into() } else { format!("{count} reports of this robot") };
    pilot.session.record(5, count == 0, "|UUID| on another robot's topic", "nothing", came);
}

/// Tests the form of a report, and reads the robot's abilities from it.
fn read_report(pilot: &mut Pilot, received: &Received) {
    let fields: Vec<&str> = received.text.split_ascii_whitespace().collect();
    let is_java = |text: &str| text == "NaN" || (text.parse::<f64>().is_ok() && text.contains('.'));
    let fits = fields.len() >= 3 && fields[1..3].iter().all(|field| is_java(field));
    pilot.session.record(
        9,
        fits,
        "|UUID|",
        "<name> <x> <y>, numbers like 1.3, 1.0E-4 or NaN",
        received.text.clone(),
    );
    let details = received.report.as_ref().and_then(|report| report.details.as_ref());
    pilot.has_details = details.is_some() || fields.len() > 3;
    pilot.can = details.map(|details| details.abilities).unwrap_or_default();
    if pilot.has_details {
        let wrong = fields.iter().skip(3).find(|field| !is_sensible(field));
        let came =
            wrong.map_or_else(|| received.text.clone(), |field| format!("{field} in: {}", received.text));
        pilot.session.record(10, wrong.is_none(), "|UUID|", "fields key=value that make sense", came);
    }
}

/// Whether a field of a report has the form `key=value`, with a possible value if the key is known (R10).
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

/// Tests that the reported position is on the floor. If it is not, its unit is probably wrong, and the script ends.
fn on_the_floor(pilot: &mut Pilot, at: Vec2) -> Step {
    let (width_m, depth_m) = pilot.session.options.floor;
    let fits = at.x.abs() <= width_m / 2.0 + 0.1 && at.y.abs() <= depth_m / 2.0 + 0.1;
    let expected = format!("metres on a floor of {width_m} x {depth_m}");
    pilot.session.record(9, fits, "|UUID|", &expected, format!("x {}, y {}", at.x, at.y));
    if !fits {
        return Err(Halt("its places are not on the floor: another unit, or another --floor".into()));
    }
    pilot.set_home(at);
    pilot.away = at + direction(pilot, at) * WAY_M;
    Ok(())
}

/// Unit vector of the direction from `home` in which there is most free floor before the edge and other robots. Sixteen
/// directions are compared, all over the distance [`WAY_M`].
fn direction(pilot: &Pilot, home: Vec2) -> Vec2 {
    let (width_m, depth_m) = pilot.session.options.floor;
    let others: Vec<Vec2> =
        pilot.session.others().values().filter_map(|other: &OtherRobot| other.at).collect();
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

/// Announces where the robot will drive, and waits for permission.
pub(super) async fn ask_for_room(pilot: &Pilot) {
    let Some(robot) = pilot.session.subject() else { return };
    let towards = pilot.is_placed().then_some(pilot.away);
    pilot.session.emit(ExamEvent::Ready { robot, at: towards.map(|_| pilot.home), towards });
    pilot.session.wait_for_permission().await;
}

/// Time between two moments, seconds.
pub(super) fn seconds(from: Instant, to: Instant) -> f64 {
    (to - from).as_secs()
}
