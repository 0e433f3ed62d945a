//! The trajectories of a solution, from which its paths are made.

use lightbots_base::Span;

use super::verify::{least_span, span_of};
use crate::instance::Instance;
use crate::motion::quarter_turn;
use crate::spline::set::SplineSet;
use crate::{Repaired, TransitionProblem};

/// Trajectories of all robots in which no two touch.
pub(super) enum Trajectories {
    Splines(SplineSet),
    StopAndGo(Repaired),
}

impl Trajectories {
    /// The duration at full speed, including the first turn.
    pub fn least(&self, instance: &Instance) -> Span {
        match self {
            Self::StopAndGo(found) => found.least,
            Self::Splines(splines) => {
                let span = least_span(instance, splines);
                quarter_turn(&instance.limits) + Span(span.0 * splines.spans as i64)
            }
        }
    }

    /// Returns the paths, driven in the asked duration, or at full speed if that is longer.
    pub fn repaired(&self, problem: &TransitionProblem, instance: &Instance) -> Repaired {
        match self {
            Self::StopAndGo(found) => found.clone(),
            Self::Splines(splines) => {
                let span = span_of(problem, instance, splines, least_span(instance, splines));
                let paths = splines.paths(quarter_turn(&instance.limits), span);
                Repaired { paths, least: self.least(instance) }
            }
        }
    }
}
