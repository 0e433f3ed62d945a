//! The cards of events each of which is an incident by itself.

use lightbots_api::IncidentTone::{self, Failed, Information, Look};
use lightbots_base::RobotId;
use lightbots_control::{EventKind, RunOutcome};

use super::subject::Subject;
use super::words::{self, Card};

/// Subject, tone and card of a new incident, and the robots that it is about.
type FirstCard = (Subject, IncidentTone, Card, Vec<RobotId>);

/// Returns the card of an event that makes an incident of its own; `None` for other events.
pub fn card_of(kind: &EventKind) -> Option<FirstCard> {
    of_link(kind).or_else(|| of_robot(kind)).or_else(|| of_run(kind))
}

/// Cards about the broker and the link.
fn of_link(kind: &EventKind) -> Option<FirstCard> {
    use EventKind as E;
    Some(match kind {
        E::Disconnected => {
            let done = "Robots on a route stop by themselves within 2 s. LightBots connects again by itself.";
            let advice = "Look whether the broker runs and the network is up. If robots must stop now, use their power switch.";
            (Subject::Broker, Failed, Card::new("The broker is lost.", done, advice), Vec::new())
        }
        E::LinkLost { silent, robots } => {
            let title =
                format!("{silent} of {robots} robots fell silent at once: this is the link, not the robots.");
            let done =
                "The show stands still until they report again, and then goes on from where they stand.";
            let advice =
                "Look at the access point and the broker. Keep people off the floor: robots may move again.";
            (Subject::Link, Look, Card::new(title, done, advice), Vec::new())
        }
        E::LinkBack { reported, robots, asks_operator: true, .. } => {
            let title = format!("{reported} of {robots} robots report again, and the show waits for you.");
            let done = "It was cut off for so long that it does not go on by itself.";
            (Subject::Link, Look, Card::new(title, done, "Look at the floor, then press Go on."), Vec::new())
        }
        E::Undelivered => {
            let title =
                "Robots report, but none acknowledges its route: the broker delivers nothing to them.";
            let advice = "Look at the broker's access rules for T/LightBot and the robots' logins.";
            (Subject::Link, Failed, Card::new(title, "The show waits.", advice), Vec::new())
        }
        _ => return None,
    })
}

/// Cards about one robot.
fn of_robot(kind: &EventKind) -> Option<FirstCard> {
    use EventKind as E;
    Some(match kind {
        E::NameShared { robot, .. } => {
            let title = format!("Two robots are called {robot}.");
            let done = "Both are kept out of the show.";
            let card = Card::new(title, done, "Switch one of them off, or give it another name.");
            (Subject::Names(*robot), Look, card, vec![*robot])
        }
        E::Flooding(robot) => {
            let title =
                format!("{} floods the broker with messages.", words::subject(&[robot.to_string()], 1));
            let done = "Only 100 of its messages a second count.";
            let card =
                Card::new(title, done, "Switch it off, and on again if its firmware is as it should be.");
            (Subject::Flood(*robot), Look, card, vec![*robot])
        }
        E::Misaligned { robot, off_m } => {
            let title = format!(
                "{} stands {:.0} mm off its place.",
                words::subject(&[robot.to_string()], 1),
                off_m * 1_000.0
            );
            let card =
                Card::new(title, "", "Look whether wheels slip, or the positioning system is off there.");
            (Subject::Place(*robot), Information, card, vec![*robot])
        }
        _ => return None,
    })
}

/// Cards about the run, the controller, the fleet, plans and music.
fn of_run(kind: &EventKind) -> Option<FirstCard> {
    use EventKind as E;
    Some(match kind {
        E::TakenUp { frame, robots, away, goes_on } => {
            let title =
                format!("LightBots was down for {:.0} s on the way to frame {}.", away.as_secs(), frame + 1);
            let done = if *goes_on {
                format!("It asks {robots} robots where they stand, and goes on with the show.")
            } else {
                format!("It told {robots} robots to stop, and ended the run.")
            };
            let advice = "Look at the floor. Read the log of the machine if this happens again.";
            (Subject::Controller, Information, Card::new(title, &done, advice), Vec::new())
        }
        E::FleetFull => {
            let card = Card::new(
                "There are more names than can be remembered.",
                "Further robots are not listed.",
                "Look whether a program makes up names; restart LightBots afterwards.",
            );
            (Subject::Fleet, Look, card, Vec::new())
        }
        E::PlanFailed { frame, message } => {
            let title = format!("There is no collision-free way to frame {}.", frame + 1);
            (
                Subject::Plan(*frame),
                Look,
                Card::new(title, message, "Take robots out of the way, or skip the frame."),
                Vec::new(),
            )
        }
        E::LeftOutForMusic { .. } => {
            let done = "The next picture stands until the music is there.";
            let card = Card::new(kind.to_string(), done, "Look at the robots that the others waited for.");
            (Subject::Music, Information, card, Vec::new())
        }
        E::RunEnded { outcome: RunOutcome::Failed(line), frames_played, .. } => {
            let done = format!("The run ended after {frames_played} frames. Robots stand.");
            let advice = "Look at the floor. Play on from the frame, or drive home.";
            (Subject::Run, Failed, Card::new(format!("{line}."), &done, advice), Vec::new())
        }
        _ => return None,
    })
}
