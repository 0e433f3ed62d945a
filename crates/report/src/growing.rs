//! The report of a run that is on.

use lightbots_control::{GrowingReplay, LogError};

use crate::builder::ReportBuilder;
use crate::model::ShowReport;
use crate::track::Scrub;

/// Reads the log of a run as it is written, so that the report is there when the run is over: from a whole log, that of
/// half an hour with a thousand robots takes minutes.
#[derive(Debug, Default)]
pub struct GrowingReport {
    replay: GrowingReplay,
    builder: ReportBuilder,
}

impl GrowingReport {
    /// Takes in the next bytes of the log.
    pub fn feed(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        let Self { replay, builder } = self;
        replay.feed(bytes, &mut |now, controller, step| builder.step(now, controller, step))
    }

    /// The run is over: its report and its replay.
    pub fn finish(self) -> Result<(ShowReport, Scrub), LogError> {
        Ok(self.builder.finish(self.replay.finish()?))
    }
}
