//! The report of a run or rehearsal: what was planned, what happened, and a replay to scrub. The report exists as one
//! type and as one HTML page that needs no other file.
//!
//! It reads the recorded inputs of a controller ([`lightbots_control::replay_observed`]). It uses no files, sockets,
//! clocks or simulator: the same inputs give the same bytes. What only a simulator knows of a rehearsal is passed in as
//! [`Truth`].
//!
//! Read [`ShowReport`] first, then [`report_of`] and [`page`].

mod builder;
mod charts;
mod escape;
mod figures;
mod frames;
mod growing;
mod html;
mod lines;
mod model;
mod packed;
mod robots;
mod schema;
mod track;
mod truth;
mod words;

pub use builder::{report_of, report_with_truth};
pub use growing::GrowingReport;
pub use html::page;
pub use lines::{LogMessage, LogNote, RunLine, run_lines};
pub use model::{
    ClosestApproach, FrameFigures, Loss, MessageFigures, ReportBrakes, ReportedEvent, RobotFigures, RunKind,
    ShowReport,
};
pub use schema::schemas;
pub use track::{Scrub, ScrubTrack};
pub use truth::Truth;
pub use words::verdict;
