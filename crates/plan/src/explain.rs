//! Why a transition has its plan: the rows of the schedule of solvers that ran, and the reason for the choice.

use core::fmt;

use lightbots_base::Span;

/// The solvers that the planner tried for one transition, and its choice.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// Rows of the schedule of solvers, in the order in which they ran. A skipped group of rows is one row here, and
    /// rows that were not reached are missing. Attempts with straight lines and prescribed drives have rows too.
    pub rows: Vec<ExplainedRow>,
    /// Index in `rows` of the chosen plan; `None` if there is no plan.
    pub chosen: Option<usize>,
    /// Reason for the choice, one line.
    pub reason: String,
}

/// One row of the schedule of solvers, a skipped group of rows, or an attempt with straight lines or a prescribed
/// drive.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplainedRow {
    /// Solver and its parameters in a few words; for a skipped group, the name of the group.
    pub solver: String,
    /// Outcome of the row.
    pub outcome: RowOutcome,
}

/// Outcome of a row of the schedule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowOutcome {
    /// Skipped, because the condition of its group does not hold; the text names that condition. Groups that are
    /// skipped because the planner is cancelled, or a robot has no shortest path, have the same text.
    Skipped(&'static str),
    /// The row has no paths to prove or to deform: its search found none, or its graph could not be built.
    NoGuess,
    /// The paths of the row are rejected, because robots touch or their motion is illegal.
    Rejected {
        /// For straight lines, the number of contacts and faults that are left. For other rows, the number of pairs
        /// that still touch: two robots, or a robot and a wall. It is 0 if it is only known that the paths are
        /// rejected.
        contacts: usize,
    },
    /// The search for paths ended before it was known which contacts are left: its work was used up, planning was
    /// cancelled, or the last contacts appeared at its end.
    Unfinished,
    /// A plan that the proof accepts.
    Solved {
        /// Duration of the plan at full speed; 0 for trajectories that the show contains.
        duration: Span,
        /// Share of moments at which a robot may stop dead without a contact, in percent. `None` if it was not
        /// measured, because the choice did not depend on it.
        stop_safe_percent: Option<u8>,
    },
}

impl Explanation {
    /// Adds a row at the end.
    pub(crate) fn add(&mut self, solver: String, outcome: RowOutcome) {
        self.rows.push(ExplainedRow { solver, outcome });
    }

    /// Marks the last row as chosen, for the reason `reason`.
    pub(crate) fn choose(&mut self, reason: &str) {
        (self.chosen, self.reason) = (self.rows.len().checked_sub(1), reason.into());
    }

    /// Adds the rows of a later attempt at the same transition. The choice and the reason of `later` replace those of
    /// `self`.
    pub(crate) fn append(&mut self, later: Self) {
        let before = self.rows.len();
        self.rows.extend(later.rows);
        self.chosen = later.chosen.map(|row| before + row);
        self.reason = later.reason;
    }
}

impl fmt::Display for RowOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Skipped(why) => write!(f, "skipped: {why}"),
            Self::NoGuess => f.write_str("no first guess"),
            Self::Rejected { contacts: 0 } => f.write_str("rejected by the proof"),
            Self::Rejected { contacts: 1 } => f.write_str("1 contact or fault left"),
            Self::Rejected { contacts } => write!(f, "{contacts} contacts or faults left"),
            Self::Unfinished => f.write_str("not finished"),
            Self::Solved { duration, stop_safe_percent } => {
                write!(f, "solved in {:.2} s", duration.as_secs())?;
                stop_safe_percent.map_or(Ok(()), |percent| write!(f, ", {percent} % stop-safe"))
            }
        }
    }
}
