//! The schedule of solvers: which first guesses are deformed, with which clearances, time scale and budget. A first
//! guess is a set of paths on which robots may still touch; the deformation then separates them.
//!
//! [`super::run`] goes through the groups in order. It skips a group whose condition does not hold, and leaves a group
//! as soon as its target is reached. To add a solver, add a variant to [`Solver`], a row here, and its first guess in
//! `Run::row` (`run.rs`). Either all rows of a group need [`super::guesses`], or none does. At most [`MOST_TRIES`] rows
//! of a group run, so the last rows of a longer group may never run.

use super::facts::Facts;
use super::guess::Manner;

use crate::margins::EDGE_M;
use crate::optimise::contacts::Clearances;

/// The method that makes the first guess of a row.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solver {
    /// Shortest paths in minimum time, in one [`Manner`].
    MinimumTime(Pick),
    /// Shortest paths of a large fleet in several manners. The first one or two guesses get a few sweeps of the
    /// deformation. Then guesses are deformed to the end in turn, the guess with the fewest contacts first.
    SuccessiveHalving,
    /// Shortest paths with slack. The duration is `times` × the least duration of the guess, or `times` × `least_s`
    /// seconds if that is longer.
    WithSlack { manner: Manner, times: f64, least_s: f64 },
    /// Paths of a multi-agent path finding over a hexagonal lattice of this pitch, metres. No two robots meet on them.
    FromLattice { pitch_m: f64 },
    /// As `FromLattice`, but the lattice also has nodes in the gaps between walls.
    ThroughGaps { pitch_m: f64 },
    /// Stop-and-go trajectories over a roadmap of this pitch, with nodes `off_edge_m` off the floor's edge, metres.
    /// They are not deformed.
    StopAndGo { pitch_m: f64, off_edge_m: f64 },
}

/// Which of the guesses in minimum time a row takes. Guesses are ranked by their badness, the least first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pick {
    /// The guess of rank 0.
    Best,
    /// The guess in which robots drive their shortest paths with the same progress. The row is skipped if this is the
    /// guess of rank 0.
    Plain,
    /// The guess of this rank, from 0. The row is skipped if there are fewer guesses.
    Ranked(usize),
}

/// One row of the schedule: a first guess, and how it is deformed.
#[derive(Clone, Copy, Debug)]
pub(super) struct SolverRow {
    pub solver: Solver,
    /// Distances that the deformation aims at.
    pub clearances: Clearances,
    /// Largest factor by which the deformation may lengthen the duration of the guess, while more than a few contacts
    /// are left. In minimum time, it counts from the least duration, but at least 1.8 from the guess. Successive
    /// halving uses [`MOST_STRETCH`], stop-and-go uses none.
    pub stretch: f64,
    /// Most sweeps of the deformation. A sweep handles each contact once.
    pub sweeps: usize,
}

/// Rows that share a condition (`when`), a budget of work and a target (`until`).
pub(super) struct Group {
    pub name: &'static str,
    pub when: When,
    pub budget: Budget,
    pub until: Until,
    pub rows: &'static [SolverRow],
}

/// Limit on the work of a group. One unit of work is one robot on one span in one sweep, or one contact in one sweep.
#[derive(Clone, Copy, Debug)]
pub(super) enum Budget {
    /// The work that the groups before left.
    Left,
    /// The work that the groups before left, but at most this.
    AtMost(usize),
    /// The work that the groups before left, but at least this.
    AtLeast(usize),
    /// This amount, whatever the groups before left.
    Of(usize),
}

/// Condition under which a group runs. [`Facts`] has the values that it depends on.
#[derive(Clone, Copy, Debug)]
pub(super) enum When {
    /// There are too many robots to compare solutions; or there are many robots, and the best guess needs much
    /// additional time.
    Large,
    /// There are few enough robots to compare solutions, and no solution is acceptable yet.
    SmallUnsolved,
    /// There are too many robots to compare solutions, and no solution is acceptable yet.
    LargeUnsolved,
    /// No solution is acceptable yet. If there is no solution at all, the best attempt left so few contacts that more
    /// time may resolve them.
    SlackMayHelp,
    /// There are few enough robots to compare solutions, and no solution is acceptable yet or the best is slow. A
    /// solution over a lattice may be faster.
    SmallSlow,
    /// There are walls, and there is no solution, or the best one is slow or has less than the usual clearance between
    /// robots.
    WallsSlowOrClose,
    /// There are walls, and there is no solution or the best one is slow.
    WallsSlow,
    /// There is no solution.
    NoSolution,
}

/// Target of a group: no further row of the group runs once it is reached.
#[derive(Clone, Copy, Debug)]
pub(super) enum Until {
    /// A solution is acceptable.
    Acceptable,
    /// A solution is good. After [`ENOUGH_TRIES`] rows of the group, or with less than [`WORK_TO_SPARE`] work left, an
    /// acceptable solution is enough.
    Good,
    /// A row of the group found a solution faster than all before the group, or the best solution is acceptable.
    Faster,
    /// The best solution is not slow. Also, one more row has run since a row of the group found a solution faster than
    /// all before the group.
    FasterAndNotSlow,
    /// There is a solution.
    Solved,
}

impl When {
    pub fn holds(self, facts: &Facts) -> bool {
        match self {
            Self::Large => facts.is_large || facts.promises_little,
            Self::SmallUnsolved => !facts.is_large && !facts.is_acceptable(),
            Self::LargeUnsolved => facts.is_large && !facts.is_acceptable(),
            Self::SlackMayHelp => !facts.is_acceptable() && !facts.is_hopeless,
            Self::SmallSlow => !facts.is_large && (!facts.is_acceptable() || facts.is_slow()),
            Self::WallsSlowOrClose => facts.has_walls && (facts.is_slow() || facts.is_close),
            Self::WallsSlow => facts.has_walls && facts.is_slow(),
            Self::NoSolution => !facts.is_solved,
        }
    }

    /// Returns why a group is skipped, for the explanation.
    pub fn why_not(self) -> &'static str {
        match self {
            Self::Large => "the fleet is small enough to compare solutions",
            Self::SmallUnsolved | Self::LargeUnsolved | Self::SlackMayHelp => {
                "a solution is acceptable, or the fleet has another size or too many contacts"
            }
            Self::SmallSlow => "the best solution is fast enough, or the fleet is large",
            Self::WallsSlowOrClose | Self::WallsSlow => {
                "there are no walls, or the best solution is fast enough"
            }
            Self::NoSolution => "there is a solution",
        }
    }
}

impl Until {
    pub fn is_reached(self, facts: &Facts) -> bool {
        match self {
            Self::Acceptable => facts.is_acceptable(),
            Self::Good if facts.tries >= ENOUGH_TRIES || facts.work < WORK_TO_SPARE => facts.is_acceptable(),
            Self::Good => facts.lasts_s < facts.least_s * GOOD,
            Self::Faster => facts.is_faster || facts.is_acceptable(),
            Self::FasterAndNotSlow => facts.was_faster && !facts.is_slow(),
            Self::Solved => facts.is_solved,
        }
    }
}

/// Number of rows of a group after which a solution need not be good, only acceptable. With more, planning takes
/// longer.
const ENOUGH_TRIES: usize = 4;
/// Work left, in units of [`Budget`], below which a solution need not be good, only acceptable.
const WORK_TO_SPARE: usize = 14_000_000;
/// Work that is left before the first group, in units of [`Budget`]: some seconds on one core. Groups with budgets of
/// their own may exceed it.
pub(super) const MOST_WORK: usize = 22_000_000;
/// Most work for the group "with slack", in units of [`Budget`].
const SLACK_WORK: usize = 8_000_000;
/// Work for each group "from lattice", in units of [`Budget`]. Each group through gaps gets at least half of it.
const LATTICE_WORK: usize = 18_000_000;
/// A solution is good if its [`Facts::lasts_s`] is less than this many times the least duration.
const GOOD: f64 = 1.15;

/// Usual distance between neighbouring lattice nodes, metres: in the lattice for shortest paths, and in most rows.
/// Centres of robots that follow each other around a corner come as close as 0.83 of the pitch.
pub(super) const PITCH_M: f64 = 0.072;
/// Pitch of the second row "from lattice", and of later rows through gaps, metres. Fewer robots fit on this lattice,
/// but their paths have more clearance.
const LOOSE_PITCH_M: f64 = 0.078;
/// Pitch of the last row "through tight gaps", metres. 0.83 of this pitch is hardly more than the distance that the
/// proof demands of two centres.
const TIGHT_PITCH_M: f64 = 0.069_5;

/// Clearances of the first rows in minimum time. They suit robots that follow curves with poor sensors on slippery
/// floors.
pub(super) const ROOMY: Clearances =
    Clearances { robots_m: 0.067_5, walls_m: 0.011_5, edge_m: EDGE_M, slack_m: 0.002 };
/// Clearances of the other rows in minimum time, and of successive halving.
pub(super) const WIDE: Clearances =
    Clearances { robots_m: 0.062_5, walls_m: 0.007_5, edge_m: EDGE_M, slack_m: 0.002 };
/// Clearances of rows "from lattice" and most rows "with slack".
const NARROW: Clearances =
    Clearances { robots_m: 0.059_5, walls_m: 0.006_5, edge_m: EDGE_M, slack_m: 0.001_5 };
/// Clearances of the last rows "with slack" and of the last row "through tight gaps": hardly more than the proof
/// demands.
const TIGHT: Clearances = Clearances { robots_m: 0.057_5, walls_m: 0.003_3, edge_m: 0.0, slack_m: 0.000_2 };
/// [`TIGHT`], but with the clearance [`EDGE_M`] from the floor's edge.
const TIGHT_OFF_EDGE: Clearances = Clearances { edge_m: EDGE_M, ..TIGHT };

const _: () = assert!(TIGHT.robots_m < NARROW.robots_m);
const _: () = assert!(NARROW.robots_m < WIDE.robots_m);
const _: () = assert!(WIDE.robots_m < ROOMY.robots_m);
const _: () = assert!(WORK_TO_SPARE < MOST_WORK);

/// Clearances for a narrow gap between walls, through which one robot follows another. Rims keep `walls_m` from the
/// walls of the gap. Centres keep 65 mm from each other, more than with [`WIDE`].
const fn in_gap(walls_m: f64, slack_m: f64) -> Clearances {
    Clearances { robots_m: 0.065, walls_m, slack_m, ..TIGHT_OFF_EDGE }
}

/// The manner in which all robots drive their shortest paths with the same progress.
const TOGETHER: Manner = Manner { bow: 0.0, early: false, level: false, spread: false, staged: false };
/// [`TOGETHER`], but the fleet spreads on its way.
const LOOSE: Manner = Manner { spread: true, ..TOGETHER };
/// [`LOOSE`], but the fleet spreads before any robot drives to its goal.
const STAGED: Manner = Manner { staged: true, ..LOOSE };

/// Largest duration that the deformation aims at in minimum time, as a multiple of the least duration. A guess that is
/// slow from the start may become up to 1.8 times longer all the same.
pub(super) const MOST_STRETCH: f64 = 2.4;

const fn minimum_time(pick: Pick, clearances: Clearances) -> SolverRow {
    SolverRow { solver: Solver::MinimumTime(pick), clearances, stretch: MOST_STRETCH, sweeps: 300 }
}

const fn with_slack(manner: Manner, times: f64, least_s: f64, clearances: Clearances) -> SolverRow {
    SolverRow { solver: Solver::WithSlack { manner, times, least_s }, clearances, stretch: 1.8, sweeps: 300 }
}

const fn from_lattice(pitch_m: f64) -> SolverRow {
    SolverRow { solver: Solver::FromLattice { pitch_m }, clearances: NARROW, stretch: 2.5, sweeps: 300 }
}

const fn through_gaps(pitch_m: f64, clearances: Clearances) -> SolverRow {
    SolverRow { solver: Solver::ThroughGaps { pitch_m }, clearances, stretch: 4.0, sweeps: 600 }
}

const fn stop_and_go(pitch_m: f64, off_edge_m: f64) -> SolverRow {
    SolverRow {
        solver: Solver::StopAndGo { pitch_m, off_edge_m },
        clearances: TIGHT,
        stretch: 1.0,
        sweeps: 0,
    }
}

/// Rows of both groups called "from lattice".
const LATTICES: &[SolverRow] = &[from_lattice(PITCH_M), from_lattice(LOOSE_PITCH_M)];

/// All groups, in the order in which they run.
pub(super) const SCHEDULE: [Group; 8] = [
    Group {
        name: "successive halving",
        when: When::Large,
        budget: Budget::Left,
        until: Until::Acceptable,
        rows: &[SolverRow {
            solver: Solver::SuccessiveHalving,
            clearances: WIDE,
            stretch: MOST_STRETCH,
            sweeps: 300,
        }],
    },
    Group {
        name: "minimum time",
        when: When::SmallUnsolved,
        budget: Budget::Left,
        until: Until::Good,
        rows: &[
            minimum_time(Pick::Best, ROOMY),
            minimum_time(Pick::Plain, ROOMY),
            minimum_time(Pick::Ranked(0), WIDE),
            minimum_time(Pick::Ranked(1), WIDE),
            minimum_time(Pick::Ranked(2), WIDE),
            minimum_time(Pick::Ranked(3), WIDE),
            minimum_time(Pick::Ranked(4), WIDE),
            minimum_time(Pick::Ranked(5), WIDE),
            minimum_time(Pick::Ranked(6), WIDE),
        ],
    },
    Group {
        name: "from lattice",
        when: When::LargeUnsolved,
        budget: Budget::Of(LATTICE_WORK),
        until: Until::Faster,
        rows: LATTICES,
    },
    Group {
        name: "with slack",
        when: When::SlackMayHelp,
        budget: Budget::AtMost(SLACK_WORK),
        until: Until::Acceptable,
        rows: &[
            with_slack(TOGETHER, 1.5, 1.3, NARROW),
            with_slack(LOOSE, 1.5, 1.3, NARROW),
            with_slack(STAGED, 1.0, 3.0, NARROW),
            with_slack(STAGED, 2.0, 3.0, NARROW),
            with_slack(TOGETHER, 4.0, 1.3, TIGHT),
            with_slack(STAGED, 4.0, 3.0, TIGHT),
        ],
    },
    Group {
        name: "from lattice",
        when: When::SmallSlow,
        budget: Budget::Of(LATTICE_WORK),
        until: Until::Faster,
        rows: LATTICES,
    },
    Group {
        name: "through gaps",
        when: When::WallsSlowOrClose,
        budget: Budget::AtLeast(LATTICE_WORK / 2),
        until: Until::FasterAndNotSlow,
        rows: &[
            through_gaps(PITCH_M, in_gap(0.006_5, 0.000_5)),
            through_gaps(PITCH_M, in_gap(0.005, 0.000_5)),
            through_gaps(PITCH_M, in_gap(0.004, 0.000_5)),
            through_gaps(PITCH_M, in_gap(0.003_3, 0.000_2)),
            through_gaps(LOOSE_PITCH_M, in_gap(0.003_3, 0.000_2)),
        ],
    },
    Group {
        name: "through tight gaps",
        when: When::WallsSlow,
        budget: Budget::AtLeast(LATTICE_WORK / 2),
        until: Until::Acceptable,
        rows: &[
            through_gaps(PITCH_M, TIGHT_OFF_EDGE),
            through_gaps(LOOSE_PITCH_M, TIGHT_OFF_EDGE),
            through_gaps(TIGHT_PITCH_M, TIGHT),
        ],
    },
    Group {
        name: "stop-and-go",
        when: When::NoSolution,
        budget: Budget::Left,
        until: Until::Solved,
        rows: &[stop_and_go(0.072, EDGE_M), stop_and_go(0.05, EDGE_M), stop_and_go(0.036, 0.0)],
    },
];

/// Most rows of a group that run, and most guesses of successive halving. Rows without a guess do not count.
pub(super) const MOST_TRIES: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_group_works_without_splines() {
        let is_stop_and_go = |row: &SolverRow| matches!(row.solver, Solver::StopAndGo { .. });
        let (last, groups) = SCHEDULE.split_last().unwrap();
        assert!(last.rows.iter().all(is_stop_and_go));
        assert!(!groups.iter().flat_map(|group| group.rows).any(is_stop_and_go));
    }
}
