//! Why a transition has the plan it has: the rows of the schedule that ran, and the reason for the choice.

use core::fmt;

use lightbots_base::Span;

/// What the planner tried for one transition.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Explanation {
    /// Rows of the schedule, in the order in which they ran or were skipped.
    pub rows: Vec<ExplainedRow>,
    /// Index in `rows` of the chosen plan; `None` if there is no plan.
    pub chosen: Option<usize>,
    /// Reason for the choice, one line.
    pub reason: String,
}

/// One row of the schedule, and its outcome.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplainedRow {
    /// Solver and parameters, a few words.
    pub solver: String,
    /// Outcome of the row.
    pub outcome: RowOutcome,
}

/// Outcome of a row of the schedule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RowOutcome {
    /// Skipped, because a condition of the row does not hold; the text names the condition.
    Skipped(&'static str),
    /// The row has no first guess: a search found no path, or there are no nodes.
    NoGuess,
    /// The paths of the row still have contacts or illegal motion.
    Rejected {
        /// Number of contacts and faults; 0 if only the proof's verdict is known.
        contacts: usize,
    },
    /// A plan that the proof accepts.
    Solved {
        /// Duration of the plan at full speed.
        duration: Span,
        /// Stop-safe share of the plan in percent; `None` if no other candidate was left to compare it with.
        stop_safe_percent: Option<u8>,
    },
}

impl Explanation {
    /// Adds a row.
    pub(crate) fn add(&mut self, solver: String, outcome: RowOutcome) {
        self.rows.push(ExplainedRow { solver, outcome });
    }

    /// Marks the last row as chosen.
    pub(crate) fn choose(&mut self, reason: &str) {
        (self.chosen, self.reason) = (self.rows.len().checked_sub(1), reason.into());
    }

    /// Adds the rows of a later attempt at the same transition. The choice of `later` replaces the earlier one.
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
            Self::Solved { duration, stop_safe_percent } => {
                write!(f, "solved in {:.2} s", duration.as_secs())?;
                stop_safe_percent.map_or(Ok(()), |percent| write!(f, ", {percent} % stop-safe"))
            }
        }
    }
}
