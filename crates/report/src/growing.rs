//! The report of a run under way.

use lightbots_control::{GrowingReplay, LogError};

use crate::builder::ReportBuilder;
use crate::model::ShowReport;
use crate::track::Scrub;

/// Reads the recording of a run while it is written, so that the report is ready as soon as the run is over. Reading it
/// afterwards would take minutes for half an hour with a thousand robots.
#[derive(Debug, Default)]
pub struct GrowingReport {
    replay: GrowingReplay,
    builder: ReportBuilder,
}

impl GrowingReport {
    /// Reads the next bytes of the recording.
    pub fn feed(&mut self, bytes: &[u8]) -> Result<(), LogError> {
        let Self { replay, builder } = self;
        replay.feed(bytes, &mut |now, controller, step| builder.step(now, controller, step))
    }

    /// Returns the report and the replay, once the run is over.
    pub fn finish(self) -> Result<(ShowReport, Scrub), LogError> {
        Ok(self.builder.finish(self.replay.finish()?))
    }
}
