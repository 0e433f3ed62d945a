//! State and results of a preflight, for screens.

use std::collections::HashMap;

use lightbots_api as api;
use lightbots_api::rounded;
use lightbots_base::RobotId;
use lightbots_control::{PreflightFinding, PreflightProgress, PreflightRobot, Snapshot};

/// Returns the results of the last preflight: for each robot that has one, by the name of the robot.
pub fn results(snapshot: &Snapshot) -> HashMap<RobotId, &PreflightRobot> {
    let robots = snapshot.preflight.iter().flat_map(|report| &report.robots);
    robots.map(|robot| (robot.id, robot)).collect()
}

/// Converts the result of one robot for screens.
pub fn result(robot: &PreflightRobot) -> api::PreflightResult {
    let fault = |finding: &PreflightFinding| api::PreflightFault {
        cause: finding.to_string(),
        remedy: finding.remedy().to_owned(),
    };
    api::PreflightResult {
        faults: robot.findings.iter().map(fault).collect(),
        off_mm: robot.off_m.map(|off_m| rounded(off_m * 1e3, 1)),
        off_deg: robot.off_rad.map(|off_rad| rounded(off_rad.to_degrees(), 1)),
        limited: robot.limited,
    }
}

/// Returns the state of the preflight that is under way, or else of the last preflight. `None` if there was no preflight
/// yet.
pub fn state(snapshot: &Snapshot) -> Option<api::PreflightState> {
    if let Some(progress) = snapshot.run.as_ref().and_then(|run| run.preflight) {
        let PreflightProgress { round, rounds, doing } = progress;
        let doing = Some(doing.to_owned());
        return Some(api::PreflightState {
            doing,
            round: round + 1,
            rounds,
            finished: false,
            passed: 0,
            named: 0,
        });
    }
    let report = snapshot.preflight.as_ref()?;
    let (passed, finished) = (report.passed(), report.finished);
    let named = report.robots.len() - passed;
    Some(api::PreflightState { doing: None, round: 0, rounds: 0, finished, passed, named })
}
