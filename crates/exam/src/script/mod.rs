//! The script of an exam, with a file for each subject. Each file tests some rules and leaves the robot at rest.

mod encounters;
mod greeting;
mod junk;
mod light;
mod light_ahead;
mod live_light;
mod parsing;
mod pilot;
mod route_checks;
mod routes;
mod silence;
mod step;
mod stopping;
mod targets;
mod time;
mod timed_route;

use std::rc::Rc;

use crate::interface::{Ending, ExamEvent};
use crate::rules::{RULES, Scope};
use crate::session::Session;
use pilot::Pilot;
use step::{Halt, Step};

/// Runs the whole script. Returns how the exam ended.
pub(crate) async fn run(session: Rc<Session>) -> Ending {
    let known = match greeting::choose(&session).await {
        Ok(known) => known,
        Err(ending) => return ending,
    };
    let mut pilot = Pilot::new(session.clone(), known);
    if let Err(Halt(why)) = examine(&mut pilot).await {
        session.set_stopped(&why);
        session.make_stand();
    }
    Ending::Done
}

async fn examine(pilot: &mut Pilot) -> Step {
    doing(pilot, "first reports");
    greeting::introduce(pilot).await?;
    note_abilities(pilot);
    doing(pilot, "payloads");
    parsing::run(pilot).await?;
    if pilot.is_placed() {
        greeting::ask_for_room(pilot).await;
        doing(pilot, "targets");
        targets::run(pilot).await?;
    }
    light::colours(pilot).await;
    live_light::run(pilot).await;
    if pilot.can.route {
        doing(pilot, "clock");
        let has_time = time::run(pilot).await?;
        if has_time {
            light::fades(pilot).await;
            light_ahead::run(pilot).await;
        }
        if has_time && pilot.is_placed() {
            drive_routes(pilot).await?;
        }
    }
    light::blink(pilot).await;
    doing(pilot, "invalid payloads");
    junk::run(pilot).await?;
    encounters::judge(pilot);
    Ok(())
}

async fn drive_routes(pilot: &mut Pilot) -> Step {
    doing(pilot, "routes");
    routes::run(pilot).await?;
    if pilot.session.is_broken(32) {
        pilot.session.mark_untried(
            &[27, 31, 33, 34, 35, 36, 37, 38, 39, 40, 41, 42, 43, 45],
            "it does not keep routes",
        );
        return Ok(());
    }
    doing(pilot, "holding, stopping and aborting");
    stopping::run(pilot).await?;
    doing(pilot, "silence");
    silence::run(pilot).await
}

fn doing(pilot: &Pilot, what: &'static str) {
    pilot.session.emit(ExamEvent::Doing(what));
}

/// Marks each rule about an ability that the robot does not have as unsupported.
fn note_abilities(pilot: &Pilot) {
    let can = pilot.can;
    for rule in &RULES {
        let mark_unsupported = match rule.scope {
            Scope::Route if !can.route => Some("it does not say can=route"),
            Scope::Fade if !can.fade => Some("it does not say can=fade"),
            Scope::Ahead if !can.light => Some("it does not say can=light"),
            Scope::Live if !can.live => Some("it does not say can=live"),
            Scope::Blink if !can.blink => Some("it does not say can=blink"),
            Scope::Details if !pilot.has_details => Some("it reports name and place only"),
            _ => None,
        };
        if let Some(what) = mark_unsupported {
            pilot.session.mark_unsupported(rule.number, what);
        }
    }
}
