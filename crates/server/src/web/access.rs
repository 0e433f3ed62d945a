//! The role that each request and operation needs. The table in SECURITY.md says the same, and a test tries each of its
//! cells.

use axum::http::Method;
use lightbots_api::{AccountRole, Operation};

/// What a request needs to be carried out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// Nothing: the request is answered before sign-in.
    Nothing,
    /// The caller must have this role or a greater one.
    Role(AccountRole),
}

/// Returns what a request to a route needs. A route that is not listed needs the greatest role.
pub fn of_route(route: &str, method: &Method) -> Need {
    let is_read = matches!(*method, Method::GET | Method::HEAD);
    match route {
        "/api/session" if *method == Method::POST => Need::Nothing,
        "/api/first" if *method == Method::POST => Need::Nothing,
        // Over `/ws` and `/api/operate`, an operation needs the role of `of_operation` as well.
        "/ws" | "/api/operate" | "/api/session" => Need::Role(AccountRole::Viewer),
        "/api/playlist" if is_read => Need::Role(AccountRole::Viewer),
        "/api/check" | "/api/convert" => Need::Role(AccountRole::Editor),
        "/api/shows"
        | "/api/shows/{name}"
        | "/api/shows/{name}/file"
        | "/api/shows/{name}/states"
        | "/api/shows/{name}/states/{number}"
        | "/api/assets/{hash}"
        | "/api/plan"
        | "/api/runs"
        | "/api/runs/{number}/report" => {
            Need::Role(if is_read { AccountRole::Viewer } else { AccountRole::Editor })
        }
        _ => Need::Role(AccountRole::Operator),
    }
}

/// Returns the least role that may carry out an operation. Stop needs the least role of all, because any witness of
/// danger must be able to stop.
pub fn of_operation(operation: &Operation) -> AccountRole {
    match operation {
        Operation::StopAll => AccountRole::Viewer,
        Operation::Open { .. } => AccountRole::Editor,
        Operation::Play { .. }
        | Operation::Preview { .. }
        | Operation::Pause
        | Operation::Resume
        | Operation::Step
        | Operation::Go
        | Operation::GoTo { .. }
        | Operation::Skip
        | Operation::LiveLight { .. }
        | Operation::Loop { .. }
        | Operation::Speed { .. }
        | Operation::Home
        | Operation::Preflight
        | Operation::Abort
        | Operation::GoOn
        | Operation::DismissFailure
        | Operation::ReadIncident { .. }
        | Operation::Refresh
        | Operation::Identify { .. }
        | Operation::Forget { .. }
        | Operation::Call { .. }
        | Operation::OnlyListed { .. }
        | Operation::List { .. }
        | Operation::Pin { .. }
        | Operation::Connect { .. }
        | Operation::Disconnect => AccountRole::Operator,
    }
}
