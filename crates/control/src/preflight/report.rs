//! What a preflight found for each robot, with cause and remedy for people.

use crate::event::Trouble;
use core::fmt;
use lightbots_base::RobotId;

/// Largest distance from its planned place at which a robot passes, metres.
pub(crate) const OFF_M: f64 = 0.005;
/// Largest angle at which a robot passes, radians: three degrees. It bounds the angle from the planned heading, and the
/// one from reported headings to the direction of the drive.
pub(crate) const OFF_RAD: f64 = 3.0 * core::f64::consts::PI / 180.0;

/// The result of a preflight.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PreflightReport {
    /// Whether the preflight was carried out to its end.
    pub finished: bool,
    /// The robots that took part, and all other admitted robots, in the order of the fleet.
    pub robots: Vec<PreflightRobot>,
}

/// What a preflight found for one robot.
#[derive(Clone, Debug, PartialEq)]
pub struct PreflightRobot {
    /// Its name.
    pub id: RobotId,
    /// What is wrong with the robot; empty if it passed.
    pub findings: Vec<PreflightFinding>,
    /// Largest measured distance of the robot from a planned place, metres; `None` if none was measured.
    pub off_m: Option<f64>,
    /// Largest measured angle, radians: from a planned heading, or from the reported headings to the direction of the
    /// drive. `None` if none was measured.
    pub off_rad: Option<f64>,
    /// Whether the robot has the original firmware (TARGET and COLOR only). If so, its heading, STOP and blinking were
    /// not tested.
    pub limited: bool,
}

/// What is wrong with a robot. `Display` writes it for people.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PreflightFinding {
    /// The robot stood too far from its planned place.
    OffPlace {
        /// Metres.
        off_m: f64,
    },
    /// The robot was turned too far from its planned heading.
    OffHeading {
        /// Radians.
        off_rad: f64,
    },
    /// The heading that the robot reports is not the direction in which it drives.
    DrivesAskew {
        /// Radians.
        off_rad: f64,
    },
    /// The robot did not stop when it was told to, stopped at a wrong place, or did not report in time that it stands.
    DidNotStop,
    /// It could not be tested whether the robot stops on its way: the link is too slow, or the stop came too late.
    StopNotTested,
    /// The robot dropped out of the preflight, or could not take part.
    Failed(Trouble),
    /// There is no free floor around the robot for its test drive, or no path to its goal was found.
    NoRoom,
    /// The preflight ended before the test of the robot was complete, or the robot came during the preflight.
    Unfinished,
}

impl PreflightReport {
    /// Returns the number of robots that passed.
    pub fn passed(&self) -> usize {
        self.robots.iter().filter(|robot| robot.passed()).count()
    }

    /// Returns the result for a robot; `None` if the report has none.
    pub fn of(&self, robot: RobotId) -> Option<&PreflightRobot> {
        self.robots.iter().find(|tested| tested.id == robot)
    }
}

impl PreflightRobot {
    /// Whether there is no finding.
    pub fn passed(&self) -> bool {
        self.findings.is_empty()
    }
}

impl PreflightFinding {
    /// Returns in one sentence what people can do about this finding.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::OffPlace { .. } => {
                "Clean its wheels and the floor, and look at its marker and the camera over it."
            }
            Self::OffHeading { .. } => "Look whether one wheel is bent, worn or blocked.",
            Self::DrivesAskew { .. } => "Turn its marker straight, and look whether one wheel is bent.",
            Self::DidNotStop => "Keep it off the floor until its firmware is updated or replaced.",
            Self::StopNotTested => "Look at the network, then run the preflight again.",
            Self::Failed(Trouble::Silent | Trouble::Deaf | Trouble::Cut | Trouble::Clock) => {
                "Charge it, switch it off and on, and look at the network."
            }
            Self::Failed(Trouble::Lost | Trouble::Unsure) => "Bring it into sight of the positioning.",
            Self::Failed(Trouble::Faulty) => "Look at its wheels and sensors, then switch it off and on.",
            Self::Failed(Trouble::Shared) => "Give one of the two robots another name.",
            Self::Failed(Trouble::Late | Trouble::Missed | Trouble::Blocked) => {
                "Look whether its wheels turn freely, and clear the floor around it."
            }
            Self::NoRoom => "Move it 12 cm away from robots, walls and no-go areas.",
            Self::Unfinished => "Run the preflight again.",
        }
    }
}

impl fmt::Display for PreflightFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OffPlace { off_m } => {
                write!(f, "stood {:.1} mm off its planned place (at most {:.0} mm)", off_m * 1e3, OFF_M * 1e3)
            }
            Self::OffHeading { off_rad } => {
                let (off, most) = (off_rad.to_degrees(), OFF_RAD.to_degrees());
                write!(f, "was turned {off:.1}° off its planned heading (at most {most:.0}°)")
            }
            Self::DrivesAskew { off_rad } => {
                let (off, most) = (off_rad.to_degrees(), OFF_RAD.to_degrees());
                write!(
                    f,
                    "reports a heading {off:.1}° off the direction in which it drives (at most {most:.0}°)"
                )
            }
            Self::DidNotStop => f.write_str("did not stop when it was told to"),
            Self::StopNotTested => f.write_str(
                "was not tested for Stop, because the link is too slow, or the stop came too late",
            ),
            Self::Failed(why) => write!(f, "{why}"),
            Self::NoRoom => f.write_str("has no room to drive 50 mm in any direction"),
            Self::Unfinished => f.write_str("was not tested, because the preflight ended before"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_state_the_measure_and_the_bound() {
        let off = PreflightFinding::OffPlace { off_m: 0.0123 };
        assert_eq!(off.to_string(), "stood 12.3 mm off its planned place (at most 5 mm)");
        let turned = PreflightFinding::OffHeading { off_rad: 0.2 };
        assert_eq!(turned.to_string(), "was turned 11.5° off its planned heading (at most 3°)");
        assert_eq!(PreflightFinding::Failed(Trouble::Silent).to_string(), "does not report");
    }
}
