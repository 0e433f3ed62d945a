//! Its clock: R25, R28 to R30.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::Step;
use super::pilot::{ANSWER, Pilot};
use crate::desk::Duty;
use crate::heard::Heard;

/// Robots ask each three seconds, and each five where nobody answers; with room for lost messages.
const PATIENCE: Span = Span::from_millis(12_000);
/// Questions that are compared came at least so far apart.
const APART: Span = Span::from_millis(3_000);
/// The show clock is set this much forward: no clock is off by so much.
const JUMP: Span = Span::from_millis(1_000_000);

/// Rules that take a robot that knows the time.
const TIMED: [u8; 20] = [12, 22, 23, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 43, 45];

/// Whether it can be told moments after this.
pub(super) async fn run(pilot: &Pilot) -> Step<bool> {
    pilot.blame.set(25);
    if !asks(pilot).await {
        return Ok(false);
    }
    synchronises(pilot).await?;
    if pilot.desk.is_broken(29) {
        pilot.desk.excuse(&TIMED, "it did not come to know the time");
        return Ok(false);
    }
    begins_afresh(pilot).await?;
    pace(pilot).await?;
    has_clock(pilot).await
}

/// Whether it asks at all, and in microseconds.
async fn asks(pilot: &Pilot) -> bool {
    let mark = pilot.desk.mark();
    let asked = |heard: &Heard| heard.question.map(|question| (heard.at, question.asked));
    let first = pilot.desk.wait_for(mark, PATIENCE, asked).await;
    let enough_later = |heard: &Heard| {
        let (from, (at, own)) = (first?.0, asked(heard)?);
        (at - from >= APART).then_some((at, own))
    };
    let second = pilot.desk.wait_for(mark, APART + PATIENCE, enough_later).await;
    let (Some((at, own)), Some((later_at, later_own))) = (first, second) else {
        pilot.desk.judge(
            25,
            false,
            "nothing",
            "<name> <now> on T/LightBot/Time",
            "no questions that make sense",
        );
        pilot.desk.excuse(&TIMED, "it never asked for the time");
        return false;
    };
    let (ours, its) = ((later_at - at).0 as f64, (later_own - own).0 as f64);
    // A question may be on its way for a while.
    let fits = (its - ours).abs() <= 0.02 * ours + 500_000.0;
    let came = format!("{its:.0} µs between two questions that came {ours:.0} µs apart");
    pilot.desk.judge(25, fits, "nothing", "microseconds of its own clock", came);
    if !fits {
        pilot.desk.excuse(&TIMED, "its questions make no sense, so it cannot know the time");
    }
    fits
}

/// Whether it reports a clock, asked now.
pub(super) async fn has_clock(pilot: &Pilot) -> Step<bool> {
    let mark = pilot.say("|STATUS|");
    let status = |heard: &Heard| (heard.topic == Topic::Status).then(|| heard.field("clock").is_some());
    match pilot.desk.wait_for(mark, ANSWER, status).await {
        Some(has) => Ok(has),
        None => Ok(pilot.ask().await?.field("clock").is_some()),
    }
}

/// Waits until it is synchronised.
async fn synchronises(pilot: &Pilot) -> Step {
    pilot.desk.set_duty(Duty::Answer);
    let until = pilot.desk.now() + Span::from_millis(30_000);
    let mut has = has_clock(pilot).await?;
    while !has && pilot.desk.now() < until {
        pilot.desk.pause(Span::from_millis(300)).await;
        has = has_clock(pilot).await?;
    }
    let came = if has { "clock= in its reports" } else { "no clock= after 30 s" };
    pilot.desk.judge(29, has, "answers to all questions", "clock= after four of them", came);
    Ok(())
}

/// The show clock jumps: one answer, also said over and over, is not enough for a new clock.
async fn begins_afresh(pilot: &Pilot) -> Step {
    pilot.desk.jump_clock(JUMP);
    pilot.desk.set_duty(Duty::Once);
    let until = pilot.desk.now() + PATIENCE;
    while pilot.desk.answered() == 0 && pilot.desk.now() < until {
        pilot.desk.pause(Span::from_millis(50)).await;
    }
    let sent = "an answer with the show clock 1000 s further";
    let has = has_clock(pilot).await?;
    let came = if has { "clock=: it still goes by the old one" } else { "no clock=" };
    pilot.desk.judge(30, !has, sent, "no clock= any more", came);
    let copy = pilot.desk.last_answer();
    pilot.say(copy.repeat(4));
    let has_by_copies = has_clock(pilot).await?;
    if !has {
        let came = if has_by_copies { "clock=" } else { "no clock=" };
        pilot.desk.judge(29, !has_by_copies, "the same answer four times more", "still no clock=", came);
    }
    pilot.desk.set_duty(Duty::Answer);
    let (began, limit) = (pilot.desk.now(), Span::from_millis(30_000));
    while pilot.desk.now() - began < limit {
        let before = pilot.desk.answered();
        if has_clock(pilot).await? {
            // The first answer after the jump counts too.
            let answers = before.max(pilot.desk.answered()) + 1;
            let came = format!("clock= after {answers} answers");
            pilot.desk.judge(
                29,
                answers >= 4 || has_by_copies,
                "answers to all questions",
                "clock= after four of them",
                came,
            );
            return Ok(());
        }
        pilot.desk.pause(Span::from_millis(20)).await;
    }
    pilot.desk.judge(30, false, sent, "a new clock by the next answers", "no clock= after 30 s");
    Ok(())
}

/// The pace of its questions since the jump.
async fn pace(pilot: &Pilot) -> Step {
    let mark = pilot.desk.mark();
    pilot.desk.pause(Span::from_millis(10_000)).await;
    let moments: Vec<Instant> = pilot.desk.since(mark, |heard| {
        heard.iter().filter(|heard| heard.question.is_some()).map(|heard| heard.at).collect()
    });
    let came = format!("{} within 10 s", moments.len());
    let fits = (2..=60).contains(&moments.len());
    pilot.desk.judge(28, fits, "answers to all questions", "2 to 60 questions within 10 s", came);
    let idle =
        pilot.desk.since(mark, |heard| heard.iter().filter(|heard| heard.topic == Topic::Status).count());
    pilot.desk.judge(
        41,
        (3..=8).contains(&idle),
        "nothing for 10 s",
        "a report on Status each 2 s",
        format!("{idle}"),
    );
    Ok(())
}
