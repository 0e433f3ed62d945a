//! Tests of the robot's clock: R25, R28 to R30.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::pilot::{ANSWER, Pilot};
use super::step::Step;
use crate::received::Received;
use crate::session::TimeAnswers;

/// Longest time to wait for a time question: four times the 3 s of R28.
const PATIENCE: Span = Span::from_millis(12_000);
/// Least time between two time questions that are compared. At this distance, a network delay of 0.5 s is smaller than
/// the error of a clock in another unit (R25).
const APART: Span = Span::from_millis(3_000);
/// Time by which the show clock is set forward: far more than the 0.5 s of R30.
const JUMP: Span = Span::from_millis(1_000_000);

/// Rules whose tests need a robot that is synchronised with the show clock.
const TIMED: [u8; 20] = [12, 22, 23, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40, 41, 43, 45];

/// Tests the clock. Returns whether the robot is synchronised with the show clock afterwards.
pub(super) async fn run(pilot: &Pilot) -> Step<bool> {
    pilot.rule_if_silent.set(25);
    if !asks(pilot).await {
        return Ok(false);
    }
    synchronises(pilot).await?;
    if pilot.session.is_broken(29) {
        pilot.session.mark_untried(&TIMED, "it did not synchronise");
        return Ok(false);
    }
    begins_afresh(pilot).await?;
    pace(pilot).await?;
    has_clock(pilot).await
}

/// Tests that the robot asks for the time, and states the time of its own clock in microseconds.
async fn asks(pilot: &Pilot) -> bool {
    let mark = pilot.session.mark();
    let asked = |received: &Received| received.question.map(|question| (received.at, question.asked));
    let first = pilot.session.wait_for(mark, PATIENCE, asked).await;
    let enough_later = |received: &Received| {
        let (from, (at, own)) = (first?.0, asked(received)?);
        (at - from >= APART).then_some((at, own))
    };
    let second = pilot.session.wait_for(mark, APART + PATIENCE, enough_later).await;
    let (Some((at, own)), Some((later_at, later_own))) = (first, second) else {
        pilot.session.record(25, false, "nothing", "<name> <now> on T/LightBot/Time", "no valid questions");
        pilot.session.mark_untried(&TIMED, "it never asked for the time");
        return false;
    };
    let (ours, its) = ((later_at - at).0 as f64, (later_own - own).0 as f64);
    // The network may delay a question.
    let fits = (its - ours).abs() <= 0.02 * ours + 500_000.0;
    let came = format!("{its:.0} µs between two questions that came {ours:.0} µs apart");
    pilot.session.record(25, fits, "nothing", "microseconds of its own clock", came);
    if !fits {
        pilot.session.mark_untried(&TIMED, "its questions are invalid, so it cannot synchronise");
    }
    fits
}

/// Requests a status. Returns whether the report has the field `clock=`.
pub(super) async fn has_clock(pilot: &Pilot) -> Step<bool> {
    let mark = pilot.send("|STATUS|");
    let status =
        |received: &Received| (received.topic == Topic::Status).then(|| received.field("clock").is_some());
    match pilot.session.wait_for(mark, ANSWER, status).await {
        Some(has) => Ok(has),
        None => Ok(pilot.ask().await?.field("clock").is_some()),
    }
}

/// Tests that the robot synchronises with the show clock within 30 s.
async fn synchronises(pilot: &Pilot) -> Step {
    pilot.session.set_time_answers(TimeAnswers::All);
    let until = pilot.session.now() + Span::from_millis(30_000);
    let mut has = has_clock(pilot).await?;
    while !has && pilot.session.now() < until {
        pilot.session.pause(Span::from_millis(300)).await;
        has = has_clock(pilot).await?;
    }
    let came = if has { "clock= in its reports" } else { "no clock= after 30 s" };
    pilot.session.record(29, has, "answers to all questions", "clock= after four of them", came);
    Ok(())
}

/// Tests a jump of the show clock. One answer to a time question, even if repeated, must not be enough to synchronise
/// again.
async fn begins_afresh(pilot: &Pilot) -> Step {
    pilot.session.jump_clock(JUMP);
    pilot.session.set_time_answers(TimeAnswers::One);
    let until = pilot.session.now() + PATIENCE;
    while pilot.session.answered() == 0 && pilot.session.now() < until {
        pilot.session.pause(Span::from_millis(50)).await;
    }
    let sent = "an answer with the show clock 1000 s further";
    let has = has_clock(pilot).await?;
    let came = if has { "clock=: it still uses the old clock" } else { "no clock=" };
    pilot.session.record(30, !has, sent, "no clock= any more", came);
    let copy = pilot.session.last_answer();
    pilot.send(copy.repeat(4));
    let has_by_copies = has_clock(pilot).await?;
    if !has {
        let came = if has_by_copies { "clock=" } else { "no clock=" };
        pilot.session.record(29, !has_by_copies, "the same answer four times more", "still no clock=", came);
    }
    pilot.session.set_time_answers(TimeAnswers::All);
    let (began, limit) = (pilot.session.now(), Span::from_millis(30_000));
    while pilot.session.now() - began < limit {
        let before = pilot.session.answered();
        if has_clock(pilot).await? {
            // The first answer after the jump counts as well.
            let answers = before.max(pilot.session.answered()) + 1;
            let came = format!("clock= after {answers} answers");
            pilot.session.record(
                29,
                answers >= 4 || has_by_copies,
                "answers to all questions",
                "clock= after four of them",
                came,
            );
            return Ok(());
        }
        pilot.session.pause(Span::from_millis(20)).await;
    }
    pilot.session.record(30, false, sent, "a new clock by the next answers", "no clock= after 30 s");
    Ok(())
}

/// Tests how often the robot asks for the time after the jump, and how often it reports without commands.
async fn pace(pilot: &Pilot) -> Step {
    let mark = pilot.session.mark();
    pilot.session.pause(Span::from_millis(10_000)).await;
    let moments: Vec<Instant> = pilot.session.since(mark, |received| {
        received.iter().filter(|received| received.question.is_some()).map(|received| received.at).collect()
    });
    let came = format!("{} within 10 s", moments.len());
    let fits = (2..=60).contains(&moments.len());
    pilot.session.record(28, fits, "answers to all questions", "2 to 60 questions within 10 s", came);
    let idle = pilot
        .session
        .since(mark, |received| received.iter().filter(|received| received.topic == Topic::Status).count());
    pilot.session.record(
        41,
        (3..=8).contains(&idle),
        "nothing for 10 s",
        "a report on Status each 2 s",
        format!("{idle}"),
    );
    Ok(())
}
