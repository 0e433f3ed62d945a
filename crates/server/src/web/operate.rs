//! Carries out the operations that screens and programs ask for.

use std::sync::Arc;

use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};
use lightbots_api as api;
use lightbots_base::RobotId;
use lightbots_control::{MissingPolicy, Operation, Refusal};
use lightbots_exchange::read_layer;

use super::access;
use super::admission::{Caller, not_allowed};
use super::refused::refuse;
use super::state::Shared;
use crate::broker_settings::Settings;
use crate::sentences::capitalised;

/// Longest message with an operation, bytes: room for the longest settings of a broker in `connect`, with line ends that
/// take two bytes each. Bounds memory for hostile clients.
pub const LONGEST: usize = 128 << 10;

/// Why an operation was refused, and another operation that the screen may offer instead.
type Refused = (String, Option<api::Choice>);

/// Carries out an operation and returns the answer for the screen.
pub async fn operate(shared: &Shared, request: api::Request) -> api::Answer {
    let api::Request { id, operation } = request;
    match act(shared, operation).await {
        Ok(()) => api::Answer { id, ok: true, error: None, choice: None },
        Err((error, choice)) => api::Answer { id, ok: false, error: Some(error), choice },
    }
}

/// `POST /api/operate`: carries out the operation of the body, if the caller's role allows it.
pub async fn post(
    State(shared): State<Arc<Shared>>,
    Extension(caller): Extension<Caller>,
    Json(operation): Json<api::Operation>,
) -> Response {
    let needed = access::of_operation(&operation);
    if caller.role < needed {
        return refuse(StatusCode::FORBIDDEN, &not_allowed(needed, caller.role)).into_response();
    }
    match act(&shared, operation).await {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err((error, choice)) => {
            (StatusCode::CONFLICT, Json(api::RefusedOperation { error, choice })).into_response()
        }
    }
}

async fn act(shared: &Shared, operation: api::Operation) -> Result<(), Refused> {
    use api::Operation as Wish;
    let plain = |line: String| (line, None);
    let wish = match operation {
        Wish::Play { .. } | Wish::Preview { .. } => return play(shared, operation).await,
        Wish::Open { name } => return open(shared, name).await.map_err(plain),
        Wish::Connect { address, user, password, ca, client_cert, client_key } => {
            let stated = |text: Option<String>| text.filter(|text| !text.trim().is_empty());
            let (user, ca) = (stated(user), stated(ca));
            let (client_cert, client_key) = (stated(client_cert), stated(client_key));
            let address = address.trim().to_owned();
            let wanted = Settings { address, user, password, ca, client_cert, client_key, connect: true };
            return shared
                .broker
                .connect(wanted, &shared.handle)
                .await
                .map_err(|line| plain(capitalised(&line)));
        }
        Wish::ReadIncident { incident } => {
            shared.incidents.read(incident);
            return Ok(());
        }
        Wish::Call { robot, called } => {
            return shared.book.call(robot_id(&robot).map_err(plain)?, &called).map_err(plain);
        }
        Wish::List { robots, listed } => {
            let robots: Vec<RobotId> =
                robots.iter().map(|robot| robot_id(robot)).collect::<Result<_, _>>().map_err(plain)?;
            shared.book.list(&robots, listed).map_err(plain)?;
            if listed {
                shared.incidents.joined(&robots);
            }
            Operation::Admit(shared.book.admitted())
        }
        Wish::OnlyListed { on } => only_listed(shared, on).await.map_err(plain)?,
        Wish::Disconnect => {
            shared.broker.disconnect(&shared.handle).await;
            return Ok(());
        }
        Wish::Home | Wish::Preflight => {
            shared.desk.hand_over().await.map_err(|refusal| plain(refusal.to_string()))?;
            if matches!(operation, Wish::Home) { Operation::Home } else { Operation::Preflight }
        }
        Wish::Pause => Operation::Pause,
        Wish::Resume => Operation::Resume,
        Wish::Step => Operation::Step,
        Wish::Go => Operation::Go,
        Wish::GoTo { frame } => Operation::GoTo(frame),
        Wish::Skip => Operation::Skip,
        Wish::LiveLight { name, layer } => live_light(name, layer).map_err(plain)?,
        Wish::Speed { percent } => Operation::Speed(percent),
        Wish::Loop { on } => Operation::Loop(on),
        Wish::Abort => Operation::Abort,
        Wish::GoOn => return go_on(shared).await.map_err(plain),
        Wish::StopAll => Operation::StopAll,
        Wish::DismissFailure => Operation::DismissFailure,
        Wish::Refresh => Operation::Refresh,
        Wish::Identify { robot } => Operation::Identify(robot_id(&robot).map_err(plain)?),
        Wish::Forget { robot } => Operation::Forget(robot_id(&robot).map_err(plain)?),
        Wish::Pin { pixel, robot } => {
            let robot = robot.map(|robot| robot_id(&robot)).transpose().map_err(plain)?;
            Operation::Pin { pixel, robot }
        }
    };
    shared.handle.operate(wish).await.map_err(|refusal| (refusal.to_string(), None))
}

/// Resumes an interrupted show. If the controller refuses, releases the playlist, which a stop may have held. `Err` if the
/// playlist was not held either.
async fn go_on(shared: &Shared) -> Result<(), String> {
    match shared.handle.operate(Operation::GoOn).await {
        Err(refusal) if !shared.playlist.release() => Err(refusal.to_string()),
        _ => Ok(()),
    }
}

/// Sets whether only listed robots take part. If `on`, puts the robots that the controller knows on the list, too. Returns
/// the operation that the controller needs for it.
async fn only_listed(shared: &Shared, on: bool) -> Result<Operation, String> {
    let present = shared.handle.look().await.map(|snapshot| snapshot.robots).unwrap_or_default();
    let present: Vec<RobotId> = present.iter().map(|robot| robot.id).collect();
    shared.book.only_listed(on, &present)?;
    Ok(Operation::Admit(shared.book.admitted()))
}

/// Reads a layer of live light and returns the operation that shows it. Without a layer, the operation takes the layer
/// `name` off. `Err`: a sentence for people.
fn live_light(name: String, layer: Option<serde_json::Value>) -> Result<Operation, String> {
    let layer = layer.map(|layer| read_layer(layer.to_string().as_bytes())).transpose();
    let layer = layer.map_err(|fault| format!("This light cannot be shown: {fault}."))?;
    Ok(Operation::LiveLight { name, layer })
}

/// Gives the open show to the controller, and plays or previews it. Refused if the show's plan is complete and has
/// errors, or if the controller refuses.
async fn play(shared: &Shared, operation: api::Operation) -> Result<(), Refused> {
    let plan = shared.desk.plan();
    let red = plan.issues.iter().find(|issue| issue.severity == api::Severity::Error);
    if let (false, Some(issue)) = (plan.planning, red) {
        return Err((format!("This show cannot be played: {}", issue.message), None));
    }
    shared.desk.hand_over().await.map_err(|refusal| (refusal.to_string(), None))?;
    let policy = |missing: &api::Missing| match missing {
        api::Missing::Refuse => MissingPolicy::Refuse,
        api::Missing::LeaveOut => MissingPolicy::LeaveOut,
    };
    let wish = match &operation {
        api::Operation::Preview { frame, missing } => {
            Operation::Preview { frame: *frame, missing: policy(missing) }
        }
        api::Operation::Play { from, missing } => Operation::Play { from: *from, missing: policy(missing) },
        _ => return Ok(()),
    };
    shared.handle.operate(wish).await.map_err(|refusal| (refusal.to_string(), choice(&refusal, operation)))
}

/// Returns the operation that screens may offer after a refusal; `None` if there is none.
fn choice(refusal: &Refusal, operation: api::Operation) -> Option<api::Choice> {
    let missing = api::Missing::LeaveOut;
    let operation = match operation {
        api::Operation::Play { from, .. } => api::Operation::Play { from, missing },
        api::Operation::Preview { frame, .. } => api::Operation::Preview { frame, missing },
        other => other,
    };
    match refusal {
        Refusal::TooFewRobots { robots, .. } if *robots > 0 => {
            Some(api::Choice { label: format!("Play with {robots} robots"), operation })
        }
        Refusal::PinnedMissing { .. } => {
            Some(api::Choice { label: "Play without these pixels".into(), operation })
        }
        _ => None,
    }
}

async fn open(shared: &Shared, name: String) -> Result<(), String> {
    let library = shared.library.clone();
    let wanted = name.clone();
    let kept = tokio::task::spawn_blocking(move || {
        let kept = library.get(&wanted).map(|kept| library.with_pictures(kept));
        if kept.is_ok() {
            library.remember(&wanted);
        }
        kept
    })
    .await;
    let kept = kept.map_err(|error| error.to_string())?.map_err(|error| capitalised(error.line()))?;
    shared.desk.open(name, kept).await;
    Ok(())
}

fn robot_id(text: &str) -> Result<RobotId, String> {
    RobotId::new(text).ok_or_else(|| "That is no robot's name.".into())
}
