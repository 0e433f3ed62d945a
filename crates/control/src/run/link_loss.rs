//! Link lost or robots lost: many robots that fall silent at once have lost their link, a few have died.

use crate::event::Trouble;
use crate::mutant::Mutant;
use crate::run::next::Dropout;
use crate::run::run_context::RunContext;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, RobotState};

/// How many robots that fall silent at once are a lost link.
struct Many {
    /// At least this many …
    least: usize,
    /// … and at least this share of the run's robots, percent.
    percent: usize,
}

/// Fewer would stop the show for a few dead robots; more would take a broken access point for dead robots.
const MANY: Many = Many { least: 3, percent: 30 };

/// Longest time until a robot reports again, by R41 of docs/protocol.md.
struct ReportInterval {
    /// While it drives or its route is held.
    driving: Span,
    /// Otherwise.
    standing: Span,
    /// Added for the time that a report is under way.
    late: Span,
}

const REPORTS: ReportInterval = ReportInterval {
    driving: Span::from_millis(500),
    standing: Span::from_millis(2_000),
    late: Span::from_millis(300),
};

/// How often all are asked whether they are there, and how far apart. With one message in ten lost, two robots of 100
/// miss both the questions and their reports.
const COPIES: (u32, Span) = (3, Span::from_millis(150));
/// A robot that does not answer within this is silent; a round trip comes on top. It is shorter than the time from the hold
/// for a silent robot to its dropout, so that the question costs no time.
const ANSWER: Span = Span::from_millis(600);

/// What it means that robots are silent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// These robots are lost; the others answer.
    RobotsLost,
    /// The others have not answered yet.
    Unknown,
    /// The link is lost; number of robots that are silent.
    LinkLost(usize),
}

/// Whether a dropout is because a robot is silent, and not because of what it says.
pub(crate) fn is_by_silence(cx: &RunContext, &(participant, why): &Dropout) -> bool {
    let silent =
        || cx.now - cx.robot(participant).contact.heard > cx.io.config.silence + cx.link.round_trip * 2;
    why == Trouble::Silent || why == Trouble::Deaf && silent()
}

/// What it means that these participants are silent. All others are asked first, unless `is_starting`: all that are there
/// have confirmed a START lately then, and the next one must not pass meanwhile.
pub(crate) fn judge(cx: &mut RunContext, silent: &[Dropout], is_starting: bool) -> Verdict {
    if cx.roster.active().count() < MANY.least || Mutant::LinkLossIsDeath.is_planted() {
        return Verdict::RobotsLost;
    }
    let patience = cx.io.config.silence + cx.link.round_trip * 2;
    let asked = if is_starting {
        Instant(cx.now.0.saturating_sub(patience.0 as u64))
    } else {
        let last_heard = silent.iter().map(|&(one, _)| cx.robot(one).contact.heard).max();
        match cx.link.all_asked.filter(|&asked| last_heard.is_none_or(|heard| heard < asked)) {
            Some(asked) if cx.now - asked >= ANSWER + cx.link.round_trip => asked,
            Some(_) => return Verdict::Unknown,
            None => {
                ask_all(cx);
                return Verdict::Unknown;
            }
        }
    };
    let is_silent = |one: &usize| cx.robot(*one).contact.heard < asked;
    many(cx, is_silent).map_or(Verdict::RobotsLost, Verdict::LinkLost)
}

/// Participants that are stale, which is three reports missed. Where a frame waits for GO, these drop out at once, so that
/// GO does not wait for a plan without them; elsewhere the next START finds them. Original robots may report only when they
/// are asked.
pub(crate) fn stale(cx: &RunContext) -> Vec<usize> {
    let is_stale = |&one: &usize| {
        let robot = cx.robot(one);
        robot.contact.age != Age::Active && !robot.is_original()
    };
    cx.roster.active().map(|(one, _)| one).filter(is_stale).collect()
}

/// Number of silent robots, if the link is lost by what robots report of their own accord: many are stale, which is three
/// reports missed.
pub(crate) fn apparent(cx: &RunContext) -> Option<usize> {
    many(cx, |one| cx.robot(*one).contact.age != Age::Active)
}

/// Asks all robots for a report, as some are silent; not where they are too few for a lost link.
pub(crate) fn ask_all(cx: &mut RunContext) {
    if cx.roster.active().count() < MANY.least {
        return;
    }
    cx.link.all_asked = Some(cx.now);
    cx.io.outbox.broadcast(cx.now, Command::Uuid, COPIES.0, COPIES.1);
}

/// Asks all robots for a report, unless they were asked since.
pub(crate) fn ask_all_once(cx: &mut RunContext, since: Instant) {
    if cx.link.all_asked.is_none_or(|asked| asked < since) {
        ask_all(cx);
    }
}

/// The least number of robots of a run that are many.
pub(crate) fn many_of(robots: usize) -> usize {
    MANY.least.max((robots * MANY.percent).div_ceil(100))
}

/// Number of silent participants, if they are many that may have fallen silent at one moment.
fn many(cx: &RunContext, is_silent: impl Fn(&usize) -> bool) -> Option<usize> {
    let silent = cx.roster.active().map(|(one, _)| one).filter(is_silent);
    let silences: Vec<Silence> = silent.map(|one| silence_of(cx, one)).collect();
    let many = many_of(cx.roster.active().count());
    let silent = silences.len();
    (silent >= many && most_at_once(silences) >= many).then_some(silent)
}

/// When a robot fell silent: after its last report, and before the next one was due.
#[derive(Clone, Copy, Debug)]
struct Silence {
    after: Instant,
    before: Instant,
}

fn silence_of(cx: &RunContext, participant: usize) -> Silence {
    let robot = cx.robot(participant);
    let interval = match robot.reported.state {
        Some(RobotState::Driving | RobotState::Held) => REPORTS.driving,
        Some(_) => REPORTS.standing,
        // A robot that knows TARGET only is asked that often.
        None => cx.io.config.ageing.stale_after / 2,
    };
    let after = robot.contact.heard;
    Silence { after, before: after + interval + REPORTS.late + cx.link.round_trip }
}

/// Number of robots that may have fallen silent at one moment: most intervals that overlap.
fn most_at_once(silences: Vec<Silence>) -> usize {
    let begins = silences.iter().map(|silence| (silence.after, false));
    let mut ends: Vec<(Instant, bool)> =
        begins.chain(silences.iter().map(|silence| (silence.before, true))).collect();
    ends.sort_unstable();
    let (mut open, mut most) = (0_usize, 0);
    for (_, is_end) in ends {
        open = if is_end { open - 1 } else { open + 1 };
        most = most.max(open);
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_robots_or_three_in_ten_are_many() {
        let many: Vec<usize> = [1, 3, 10, 11, 30, 1_000].into_iter().map(many_of).collect();
        assert_eq!(many, [3, 3, 3, 4, 9, 300]);
    }

    #[test]
    fn robots_that_died_one_after_the_other_did_not_fall_silent_at_once() {
        let silence = |after, before| Silence { after: Instant(after), before: Instant(before) };
        assert_eq!(most_at_once(vec![silence(0, 5), silence(6, 11), silence(12, 17)]), 1);
        assert_eq!(most_at_once(vec![silence(0, 5), silence(3, 8), silence(5, 10), silence(9, 12)]), 3);
        assert_eq!(most_at_once(Vec::new()), 0);
    }
}
