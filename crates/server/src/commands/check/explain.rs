//! Which solvers ran for each transition and why its plan was chosen, for `check --explain`.

use lightbots_api::rounded;
use lightbots_plan::{ExplainedRow, RowOutcome, ShowPlan};
use lightbots_show::Show;
use serde::Serialize;

use super::show_places::frame_name;

/// One transition.
#[derive(Debug, Serialize)]
pub(super) struct Explained {
    /// The frame that the transition leads to, counted from 0.
    to: usize,
    /// Index of the row whose plan was chosen; null: there is no plan.
    chosen: Option<usize>,
    reason: String,
    rows: Vec<Row>,
}

/// One solver.
#[derive(Debug, Serialize)]
struct Row {
    solver: String,
    /// Outcome in a few words. The fields below hold the numbers in it.
    outcome: String,
    duration_s: Option<f64>,
    stop_safe_percent: Option<u8>,
    contacts: Option<usize>,
}

impl Explained {
    /// Explains all transitions of a plan.
    pub fn all(plan: &ShowPlan) -> Vec<Self> {
        let explained = |(to, of): (usize, &lightbots_plan::Explanation)| Self {
            to,
            chosen: of.chosen,
            reason: of.reason.clone(),
            rows: of.rows.iter().map(Row::new).collect(),
        };
        plan.explanations.iter().enumerate().map(explained).collect()
    }

    /// Returns one line for the transition and one for each solver.
    pub fn lines(&self, show: &Show) -> Vec<String> {
        let head = format!("to {}: {}", frame_name(show, self.to), self.reason);
        let line = |(index, row): (usize, &Row)| {
            let mark = if self.chosen == Some(index) { '*' } else { ' ' };
            format!("  {mark} {}: {}", row.solver, row.outcome)
        };
        [head].into_iter().chain(self.rows.iter().enumerate().map(line)).collect()
    }
}

impl Row {
    fn new(row: &ExplainedRow) -> Self {
        let (duration_s, stop_safe_percent, contacts) = match row.outcome {
            RowOutcome::Solved { duration, stop_safe_percent } => {
                (Some(rounded(duration.as_secs(), 3)), stop_safe_percent, None)
            }
            RowOutcome::Rejected { contacts } => (None, None, Some(contacts)),
            RowOutcome::Skipped(_) | RowOutcome::NoGuess | RowOutcome::Unfinished => (None, None, None),
        };
        let (solver, outcome) = (row.solver.clone(), row.outcome.to_string());
        Self { solver, outcome, duration_s, stop_safe_percent, contacts }
    }
}
