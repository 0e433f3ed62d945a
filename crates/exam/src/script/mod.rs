//! What is done with a robot, in order. One file a subject; each tries some rules and leaves the robot at rest.

mod course;
mod greeting;
mod junk;
mod light;
mod parsing;
mod pilot;
mod routes;
mod silence;
mod stopping;
mod targets;
mod time;

use std::rc::Rc;

use crate::desk::Desk;
use crate::exam::{Ending, News};
use crate::rules::{RULES, Scope};
use pilot::Pilot;

/// Why the script cannot go on, for people.
pub(crate) struct Halt(String);

/// A part of the script that may have to end early.
pub(crate) type Step<T = ()> = Result<T, Halt>;

/// The whole script.
pub(crate) async fn run(desk: Rc<Desk>) -> Ending {
    let known = match greeting::choose(&desk).await {
        Ok(known) => known,
        Err(ending) => return ending,
    };
    let mut pilot = Pilot::new(desk.clone(), known);
    if let Err(Halt(why)) = examine(&mut pilot).await {
        desk.set_stopped(&why);
        desk.leave();
    }
    Ending::Done
}

async fn examine(pilot: &mut Pilot) -> Step {
    doing(pilot, "how it introduces itself");
    greeting::introduce(pilot).await?;
    note_abilities(pilot);
    doing(pilot, "how it reads payloads");
    parsing::run(pilot).await?;
    if pilot.is_placed() {
        greeting::ask_for_room(pilot).await;
        doing(pilot, "targets");
        targets::run(pilot).await?;
    }
    light::colours(pilot).await;
    if pilot.can.route {
        doing(pilot, "its clock");
        let has_time = time::run(pilot).await?;
        if has_time {
            light::fades(pilot).await;
        }
        if has_time && pilot.is_placed() {
            drive_routes(pilot).await?;
        }
    }
    light::blink(pilot).await;
    doing(pilot, "senseless payloads");
    junk::run(pilot).await
}

async fn drive_routes(pilot: &mut Pilot) -> Step {
    doing(pilot, "routes");
    routes::run(pilot).await?;
    if pilot.desk.is_broken(32) {
        pilot.desk.excuse(&[27, 31, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 45], "it keeps no routes");
        return Ok(());
    }
    doing(pilot, "holding, stopping and giving up");
    stopping::run(pilot).await?;
    doing(pilot, "silence");
    silence::run(pilot).await
}

fn doing(pilot: &Pilot, what: &'static str) {
    pilot.desk.tell(News::Doing(what));
}

/// What it does not know it need not keep.
fn note_abilities(pilot: &Pilot) {
    let can = pilot.can;
    for rule in &RULES {
        let lacks = match rule.scope {
            Scope::Route if !can.route => Some("it does not say can=route"),
            Scope::Fade if !can.fade => Some("it does not say can=fade"),
            Scope::Blink if !can.blink => Some("it does not say can=blink"),
            Scope::Details if !pilot.has_details => Some("it reports name and place only"),
            _ => None,
        };
        if let Some(what) = lacks {
            pilot.desk.lacks(rule.number, what);
        }
    }
}
