//! Decides whether the link or robots are lost. Many robots that fall silent at once have lost their link; a few have
//! died.

use crate::event::Trouble;
use crate::mutant::Mutant;
use crate::run::next::Dropout;
use crate::run::run_context::RunContext;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, RobotState};

/// How many robots that fall silent at once count as a lost link. Both bounds have to be reached.
struct Many {
    /// Least number of silent robots.
    least: usize,
    /// Least share of the run's active robots that are silent, percent.
    percent: usize,
}

/// Lower bounds would stop the show for a few dead robots. Higher bounds would take a broken access point for dead
/// robots.
const MANY: Many = Many { least: 3, percent: 30 };

/// Longest time between two reports of a robot, by R41 of docs/protocol.md.
struct ReportInterval {
    /// While the robot drives or its route is held.
    driving: Span,
    /// While the robot stands.
    standing: Span,
    /// Allowance for the time that a report takes to arrive.
    late: Span,
}

/// Report intervals of R41, and an allowance for slow links.
const REPORTS: ReportInterval = ReportInterval {
    driving: Span::from_millis(500),
    standing: Span::from_millis(2_000),
    late: Span::from_millis(300),
};

/// Number of copies of the question that is sent to all robots, and the time between them. With one message in ten
/// lost, fewer than one robot of 100 fails to answer all copies.
const COPIES: (u32, Span) = (3, Span::from_millis(150));
/// A robot counts as silent if it sends no report within this time after the question; a round trip is added. The
/// question delays no dropout, because this time is shorter than the time from the hold for a silent robot to its
/// dropout.
const ANSWER: Span = Span::from_millis(600);

/// What the silence of robots means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    /// The silent robots are lost, because enough other robots answer, too few take part to tell, or the robots fell
    /// silent one after the other.
    RobotsLost,
    /// It is not known yet: the other robots have not had enough time to answer.
    Unknown,
    /// The link is lost. Holds the number of silent robots.
    LinkLost(usize),
}

/// Whether a dropout counts as caused by silence. A reason from the robot's last report counts too if the robot is
/// silent by now, because that report may be out of date.
pub(crate) fn is_by_silence(cx: &RunContext, &(participant, why): &Dropout) -> bool {
    let silent =
        || cx.now - cx.robot(participant).contact.heard > cx.io.config.silence + cx.link.round_trip * 2;
    let is_reported = matches!(why, Trouble::Deaf | Trouble::Cut | Trouble::Lost | Trouble::Faulty);
    why == Trouble::Silent || is_reported && silent()
}

/// Decides what it means that these participants are silent. In runs with fewer active robots than a lost link needs,
/// the silent ones are lost. Otherwise all robots are first asked for a report, and the verdict is `Unknown` until they
/// have had time to answer. With `is_starting` they are not asked: robots within reach have lately confirmed a START,
/// whose moment must not pass during the wait.
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

/// Participants that are stale: they have missed three reports. While a frame waits for GO they drop out at once, so
/// that GO does not wait for a new plan. At other times the next START finds them. TARGET-only robots (they understand
/// the command TARGET but no routes) are left out, because they may report only when asked.
pub(crate) fn stale(cx: &RunContext) -> Vec<usize> {
    let is_stale = |&one: &usize| {
        let robot = cx.robot(one);
        robot.contact.age != Age::Active && !robot.is_original()
    };
    cx.roster.active().map(|(one, _)| one).filter(is_stale).collect()
}

/// Number of robots that have missed three reports (stale robots), if enough of them fell silent at once for a lost
/// link. `None` otherwise. Robots are not asked for reports first.
pub(crate) fn apparent(cx: &RunContext) -> Option<usize> {
    many(cx, |one| cx.robot(*one).contact.age != Age::Active)
}

/// Asks all robots for a report, because some are silent. Does nothing if fewer robots take part than a lost link
/// needs.
pub(crate) fn ask_all(cx: &mut RunContext) {
    if cx.roster.active().count() < MANY.least {
        return;
    }
    cx.link.all_asked = Some(cx.now);
    cx.io.outbox.broadcast(cx.now, Command::Uuid, COPIES.0, COPIES.1);
}

/// Asks all robots for a report, unless all were already asked at `since` or later.
pub(crate) fn ask_all_once(cx: &mut RunContext, since: Instant) {
    if cx.link.all_asked.is_none_or(|asked| asked < since) {
        ask_all(cx);
    }
}

/// The least number of silent robots, of `robots` in the run, that counts as a lost link.
pub(crate) fn many_of(robots: usize) -> usize {
    MANY.least.max((robots * MANY.percent).div_ceil(100))
}

/// Number of silent participants, if enough of them for a lost link may have fallen silent at one moment. `None`
/// otherwise.
fn many(cx: &RunContext, is_silent: impl Fn(&usize) -> bool) -> Option<usize> {
    let silent = cx.roster.active().map(|(one, _)| one).filter(is_silent);
    let silences: Vec<Silence> = silent.map(|one| silence_of(cx, one)).collect();
    let many = many_of(cx.roster.active().count());
    let silent = silences.len();
    (silent >= many && most_at_once(silences) >= many).then_some(silent)
}

/// When a robot fell silent: after its last report was received, and before the next report was due.
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
        // TARGET-only robots are asked for reports at this interval.
        None => cx.io.config.ageing.stale_after / 2,
    };
    let after = robot.contact.heard;
    Silence { after, before: after + interval + REPORTS.late + cx.link.round_trip }
}

/// Largest number of robots that may have fallen silent at one moment: the most intervals that contain the same moment.
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
