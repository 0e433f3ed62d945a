//! The texts of events, for people.

use crate::event::{EventKind, RunOutcome, Trouble};
use core::fmt;

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Late => "is behind its path",
            Self::Silent => "does not report",
            Self::Deaf => "does not acknowledge",
            Self::Lost => "does not know where it is",
            Self::Unsure => "is not sure enough of its place",
            Self::Faulty => "reports a fault",
            Self::Cut => "was cut off or restarted",
            Self::Missed => "did not reach its goal",
            Self::Blocked => "is blocked",
            Self::Shared => "shares its name with another robot",
            Self::Clock => "is still setting its clock, as the link is slow",
        })
    }
}

impl fmt::Display for RunOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finished => f.write_str("finished"),
            Self::Aborted => f.write_str("aborted"),
            Self::Failed(line) => f.write_str(line),
        }
    }
}

/// A number and a noun. `Display` writes both, and adds an `s` to the noun unless the number is 1.
struct Count<'a>(usize, &'a str);

impl fmt::Display for Count<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}{}", self.0, self.1, if self.0 == 1 { "" } else { "s" })
    }
}

/// Writes the line for a frame with `count` dark pixels. `pixels`: the ids that the line lists.
fn write_dark(f: &mut fmt::Formatter<'_>, (frame, count): (usize, usize), pixels: &[u32]) -> fmt::Result {
    let more = if count > pixels.len() { " and more" } else { "" };
    let dark = if count == 1 { "1 pixel stays dark" } else { &format!("{count} pixels stay dark") };
    write!(f, "Frame {}: {dark}: {pixels:?}{more}.", frame + 1)
}

impl EventKind {
    /// Returns the text that follows the robot's name in lines of the form "Robot NAME TEXT."; empty for events whose
    /// lines have another form.
    fn of_robot(&self) -> &'static str {
        match self {
            Self::RobotFound(_) => "is here",
            Self::WantsToJoin(_) => "is not in the list of robots, and wants to join",
            Self::RobotRestarted(_) => "has restarted",
            Self::RobotStale(_) => "has not reported lately",
            Self::RobotGone(_) => "is gone",
            Self::RobotBack(_) => "is back",
            Self::Flooding(_) => "floods the broker with messages: only 100 a second count; switch it off",
            _ => "",
        }
    }

    /// Writes the line for people if the event is about a preflight; otherwise writes nothing.
    fn write_preflight(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PreflightBegun { robots } => write!(f, "Preflight of {}.", Count(*robots, "robot")),
            Self::PreflightEnded { passed, robots } => {
                write!(f, "Preflight over: {passed} of {} passed.", Count(*robots, "robot"))
            }
            _ => Ok(()),
        }
    }

    /// Writes the line for people of an event about the drive to the starting places, or about a frame that waits for
    /// GO. Any other event gets the line of `AtHome`.
    fn write_stand(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GoingHome { robots } => write!(f, "{} to the starting places.", Count(*robots, "robot")),
            Self::WaitsForGo { frame, name } if name.is_empty() => {
                write!(f, "Frame {} waits for GO.", frame + 1)
            }
            Self::WaitsForGo { frame, name } => write!(f, "Frame {} waits for GO: {name}.", frame + 1),
            Self::PlannedHome => write!(f, "Planned the drive home."),
            _ => write!(f, "Robots stand at their starting places."),
        }
    }

    /// Writes the line for people if the event is about a jump to a frame, a frame that is left out, or a loop;
    /// otherwise writes nothing.
    fn write_jump(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GoesTo { frame } => write!(f, "Going to frame {}.", frame + 1),
            Self::LoopBegun { first, last } if first == last => {
                write!(f, "Frame {} repeats until GO.", first + 1)
            }
            Self::LoopBegun { first, last } => {
                write!(f, "Frames {} to {} repeat until GO.", first + 1, last + 1)
            }
            Self::LeavesLoop { last } => {
                write!(f, "GO: the show leaves the loop after frame {}.", last + 1)
            }
            Self::LeftOutForMusic { frame, late } => {
                write!(
                    f,
                    "Frame {} is left out: robots are {:.1} s behind the music.",
                    frame + 1,
                    late.as_secs()
                )
            }
            Self::Skipped { frame } => write!(f, "Frame {} is skipped.", frame + 1),
            Self::JumpGivenUp { frame } => {
                write!(f, "The show stays where it is: no path leads to frame {}.", frame + 1)
            }
            _ => Ok(()),
        }
    }

    /// Writes the line for people if the event is about a link that is lost or back, or about a run that was taken up;
    /// otherwise writes nothing.
    fn write_link(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LinkLost { silent, robots } => write!(
                f,
                "Link lost: {silent} of {} fell silent at once. The show stands still until they report again.",
                Count(*robots, "robot")
            ),
            Self::TakenUp { frame, robots, away, goes_on } => {
                let (robots, away_s) = (Count(*robots, "robot"), away.as_secs());
                let then =
                    if *goes_on { "are asked where they stand" } else { "are told to stop; the run is over" };
                write!(f, "The show was cut off {away_s:.0} s ago on the way to frame {}, ", frame + 1)?;
                write!(f, "because its controller ended. {robots} {then}.")
            }
            Self::LinkBack { reported, robots, after, asks_operator } => {
                let then =
                    if *asks_operator { "Look at the floor, then press Go on" } else { "The show goes on" };
                let robots = Count(*robots, "robot");
                write!(f, "{reported} of {robots} report again after {:.0} s. {then}.", after.as_secs())
            }
            _ => Ok(()),
        }
    }
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use EventKind::*;
        match self {
            Connected => write!(f, "Connected to the broker."),
            Disconnected => write!(f, "The broker is lost."),
            StateChanged(state) => write!(f, "Now {state}."),
            NameShared { robot, places } => {
                write!(f, "Two robots are called {robot}")?;
                for (index, at) in places.iter().enumerate() {
                    let before = if index == 0 { ": it reports from" } else { " and from" };
                    write!(f, "{before} ({:.2}, {:.2})", at.x, at.y)?;
                }
                write!(f, ". Both are kept out of the show; give one of them another name.")
            }
            RobotFound(id) | WantsToJoin(id) | RobotRestarted(id) | RobotStale(id) | RobotGone(id)
            | RobotBack(id) | Flooding(id) => {
                write!(f, "Robot {id} {}.", self.of_robot())
            }
            NameUnique(id) => write!(f, "One robot is called {id} again: it may take part."),
            FleetFull => write!(f, "Too many robots: further names are not remembered."),
            ShowOpened { name, frames } if name.trim().is_empty() => {
                write!(f, "A show without a name, with {}, is open.", Count(*frames, "frame"))
            }
            ShowOpened { name, frames } => {
                write!(f, "Show \"{name}\" with {} is open.", Count(*frames, "frame"))
            }
            RunBegun { from, robots } => {
                write!(f, "Run with {} from frame {}.", Count(*robots, "robot"), from + 1)
            }
            Planned { frames } => write!(f, "Planned the drive to {}.", Count(*frames, "frame")),
            PlanFailed { frame, message } => write!(f, "No plan for frame {}: {message}", frame + 1),
            LeftOut { frame, pixels, count } => write_dark(f, (*frame, *count), pixels),
            TransitionStarted { frame, duration, .. } => {
                write!(f, "To frame {} in {:.2} s.", frame + 1, duration.as_secs())
            }
            FrameReached { frame, spread, .. } => {
                write!(f, "Frame {} stands; arrivals within {:.2} s.", frame + 1, spread.as_secs())
            }
            GoingHome { .. } | PlannedHome | AtHome | WaitsForGo { .. } => self.write_stand(f),
            PreflightBegun { .. } | PreflightEnded { .. } => self.write_preflight(f),
            GoesTo { .. }
            | Skipped { .. }
            | LeftOutForMusic { .. }
            | JumpGivenUp { .. }
            | LoopBegun { .. }
            | LeavesLoop { .. } => self.write_jump(f),
            Waiting { robot, why } => write!(f, "Waiting for robot {robot}: it {why}."),
            Undelivered => write!(
                f,
                "No robot acknowledges its path, though robots report: the broker does not deliver messages to them."
            ),
            LinkLost { .. } | LinkBack { .. } | TakenUp { .. } => self.write_link(f),
            Resumed => write!(f, "Resumed."),
            Dropout { robot, why } => write!(f, "Robot {robot} drops out: it {why}."),
            Rejoined(id) => write!(f, "Robot {id} takes part from the next frame on."),
            Replanning { frame } => write!(f, "Planning the way to frame {} again.", frame + 1),
            Misaligned { robot, off_m } => {
                write!(f, "Robot {robot} stands {:.0} mm off its goal.", off_m * 1e3)
            }
            UnexpectedArrival(id) => write!(f, "Robot {id} arrived unexpectedly."),
            Suppressed(1) => write!(f, "One more event was not listed."),
            Suppressed(count) => write!(f, "{count} more events were not listed."),
            StoppedAll => write!(f, "All robots were told to stop."),
            RunEnded { outcome: RunOutcome::Failed(line), .. } => write!(f, "{line}."),
            RunEnded { outcome, frames_played, dropouts } => {
                let (frames, dropouts) = (Count(*frames_played, "frame"), Count(*dropouts, "dropout"));
                write!(f, "Run {outcome}; {frames}, {dropouts}.")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_count_with_the_right_noun() {
        let opened = |name: &str, frames| EventKind::ShowOpened { name: name.into(), frames }.to_string();
        assert_eq!(opened("Heart", 1), "Show \"Heart\" with 1 frame is open.");
        assert_eq!(opened(" ", 2), "A show without a name, with 2 frames, is open.");
        assert_eq!(EventKind::Planned { frames: 1 }.to_string(), "Planned the drive to 1 frame.");
        assert_eq!(EventKind::RunBegun { from: 0, robots: 1 }.to_string(), "Run with 1 robot from frame 1.");
        let dark = |count| EventKind::LeftOut { frame: 1, pixels: vec![7], count }.to_string();
        assert_eq!(dark(1), "Frame 2: 1 pixel stays dark: [7].");
        assert_eq!(dark(2), "Frame 2: 2 pixels stay dark: [7] and more.");
        let ended = EventKind::RunEnded { outcome: RunOutcome::Finished, frames_played: 1, dropouts: 0 };
        assert_eq!(ended.to_string(), "Run finished; 1 frame, 0 dropouts.");
    }
}
