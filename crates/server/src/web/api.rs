//! The library and the planner over HTTP.

use std::sync::Arc;

use axum::Json;
use axum::body::Bytes;
use axum::extract::rejection::BytesRejection;
use axum::extract::{ConnectInfo, Path, Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use lightbots_api::{Plan, ShowEntry, ShowState};
use lightbots_exchange::{FORMATS, Format, Loaded, Written, named, read};
use lightbots_lighting::validate;
use lightbots_plan::Cancelled;

use super::connection::Ends;
use super::planner::CutOff;
use super::refused::{Refused, refuse};
use super::state::Shared;
use crate::library::{Condition, Kept, LibraryError};
use crate::show_plan;

/// The answer to a request, or its refusal.
type Answer<T> = Result<T, Refused>;

/// Largest body that is read, bytes, on routes without a smaller bound. The longest show file fits.
pub const BODY_MAX: usize = lightbots_exchange::MAX_BYTES;

/// Runs work that blocks on the disk or the processor on a separate thread, so that other requests are served meanwhile.
async fn beside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Answer<T> {
    let done = tokio::task::spawn_blocking(work).await;
    done.map_err(|error| {
        refuse(
            StatusCode::INTERNAL_SERVER_ERROR,
            &format!("the server failed: {error}; try again, and report its log"),
        )
    })
}

fn library_problem(error: LibraryError) -> Refused {
    let status = match error {
        LibraryError::BadName(_) => StatusCode::BAD_REQUEST,
        LibraryError::Missing(_) => StatusCode::NOT_FOUND,
        LibraryError::Conflict(_) => StatusCode::PRECONDITION_FAILED,
        LibraryError::ReadOnly(_) => StatusCode::FORBIDDEN,
        LibraryError::NoShow(_) => StatusCode::UNPROCESSABLE_ENTITY,
        LibraryError::Disk(_) => StatusCode::INTERNAL_SERVER_ERROR,
    };
    refuse(status, error.line())
}

fn body(body: Result<Bytes, BytesRejection>) -> Answer<Bytes> {
    body.map_err(|rejection| match rejection.status() {
        StatusCode::PAYLOAD_TOO_LARGE => too_long(),
        status => refuse(status, &rejection.body_text()),
    })
}

/// Returns the refusal of a body that is longer than [`BODY_MAX`].
pub fn too_long() -> Refused {
    let line =
        format!("this is too long for a show: at most {} MB; split it into several", BODY_MAX / 1_000_000);
    refuse(StatusCode::PAYLOAD_TOO_LARGE, &line)
}

fn condition(headers: &HeaderMap) -> Answer<Condition> {
    let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or("").trim().to_owned());
    match (text(header::IF_MATCH), text(header::IF_NONE_MATCH)) {
        (Some(tag), _) if tag != "*" => Ok(Condition::Is(tag.trim_start_matches("W/").to_owned())),
        (_, Some(star)) if star == "*" => Ok(Condition::IsNew),
        (_, Some(_)) => Err(refuse(StatusCode::BAD_REQUEST, "If-None-Match is only understood with *")),
        _ => Ok(Condition::Any),
    }
}

/// `GET /api/shows`: lists the shows of the library.
pub async fn list(State(shared): State<Arc<Shared>>) -> Answer<Json<Vec<ShowEntry>>> {
    let library = shared.library.clone();
    beside(move || library.list()).await.map(Json)
}

/// `GET /api/shows/{name}`: returns the document of a show.
pub async fn get(State(shared): State<Arc<Shared>>, Path(name): Path<String>) -> Answer<Response> {
    let library = shared.library.clone();
    Ok(document(beside(move || library.get(&name)).await?.map_err(library_problem)?))
}

/// Returns the response with a show's document. The ETag of the response is the version of the show's file.
fn document(kept: Kept) -> Response {
    let about = [
        (header::CONTENT_TYPE, "application/json"),
        (header::ETAG, &kept.etag),
        (header::CACHE_CONTROL, "no-cache"),
    ];
    (about, kept.bytes).into_response()
}

/// `GET /api/shows/{name}/states`: lists the saved states of a show, the newest first.
pub async fn states(
    State(shared): State<Arc<Shared>>,
    Path(name): Path<String>,
) -> Answer<Json<Vec<ShowState>>> {
    let library = shared.library.clone();
    beside(move || library.states(&name)).await?.map(Json).map_err(library_problem)
}

/// `GET /api/shows/{name}/states/{number}`: returns the document of an earlier state of a show.
pub async fn state(
    State(shared): State<Arc<Shared>>,
    Path((name, number)): Path<(String, u32)>,
) -> Answer<Response> {
    let library = shared.library.clone();
    Ok(document(beside(move || library.state(&name, number)).await?.map_err(library_problem)?))
}

/// `GET /api/shows/{name}/file`: returns the file of a show as the library keeps it.
pub async fn file(State(shared): State<Arc<Shared>>, Path(name): Path<String>) -> Answer<Response> {
    let library = shared.library.clone();
    let (bytes, format) = beside(move || library.file(&name)).await?.map_err(library_problem)?;
    let about = [(header::CONTENT_TYPE, format.media_type), (header::CACHE_CONTROL, "no-cache")];
    Ok((about, bytes).into_response())
}

/// `PUT /api/shows/{name}`: saves a show. If that show is open on screens, they get the new version. A copy that was saved
/// under another name, because the show is built-in, is not opened.
pub async fn put(
    State(shared): State<Arc<Shared>>,
    Path(name): Path<String>,
    headers: HeaderMap,
    bytes: Result<Bytes, BytesRejection>,
) -> Answer<Response> {
    let (bytes, condition) = (body(bytes)?, condition(&headers)?);
    let library = shared.library.clone();
    let put = beside(move || {
        let entry = library.put(&name, &bytes, &condition)?;
        library.get(&entry.name).map(|kept| (entry, kept))
    });
    let (entry, kept) = put.await?.map_err(library_problem)?;
    let etag = entry.etag.clone();
    if shared.desk.shown().name.as_ref() == Some(&entry.name) {
        let library = shared.library.clone();
        let kept = beside(move || library.with_pictures(kept)).await?;
        shared.desk.open(entry.name.clone(), kept).await;
    }
    Ok(([(header::ETAG, etag)], Json(entry)).into_response())
}

/// `GET /api/assets/{hash}`: returns an asset. The asset is sent without its media type, so that no browser runs scripts in
/// a drawing.
pub async fn asset(State(shared): State<Arc<Shared>>, Path(hash): Path<String>) -> Answer<Response> {
    let library = shared.library.clone();
    let content = beside(move || library.asset(&hash)).await?.map_err(library_problem)?;
    let about = [
        (header::CONTENT_TYPE, "application/octet-stream"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::CACHE_CONTROL, "private, max-age=31536000, immutable"),
    ];
    Ok((about, content.to_vec()).into_response())
}

/// `PUT /api/assets/{hash}`: stores an asset.
pub async fn put_asset(
    State(shared): State<Arc<Shared>>,
    Path(hash): Path<String>,
    bytes: Result<Bytes, BytesRejection>,
) -> Answer<StatusCode> {
    let (library, bytes) = (shared.library.clone(), body(bytes)?);
    beside(move || library.put_asset(&hash, &bytes)).await?.map_err(library_problem)?;
    Ok(StatusCode::NO_CONTENT)
}

/// The query parameters of `delete`.
#[derive(Debug, serde::Deserialize)]
pub struct Renamed {
    /// If the show was renamed: its new name, under which its earlier states are kept.
    renamed_to: Option<String>,
}

/// `DELETE /api/shows/{name}?renamed_to=NAME`: deletes a show. With `renamed_to`, its earlier states are kept under that
/// name.
pub async fn delete(
    State(shared): State<Arc<Shared>>,
    Path(name): Path<String>,
    Query(Renamed { renamed_to }): Query<Renamed>,
    headers: HeaderMap,
) -> Answer<StatusCode> {
    let (library, condition) = (shared.library.clone(), condition(&headers)?);
    beside(move || library.delete(&name, &condition, renamed_to.as_deref()))
        .await?
        .map_err(library_problem)?;
    Ok(StatusCode::NO_CONTENT)
}

/// `POST /api/check`: plans the show of the body and returns the plan with its issues. A body that is no show gives an
/// empty plan with one issue. Each client address has one plan at a time: a newer request cancels the older one.
pub async fn check(
    State(shared): State<Arc<Shared>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    bytes: Result<Bytes, BytesRejection>,
) -> Answer<Json<Plan>> {
    let bytes = body(bytes)?;
    let (budget, library) = (shared.planner.budget(), shared.library.clone());
    let plan = shared.planner.work(ends.remote.ip().to_canonical(), move |is_cancelled| {
        let mut loaded = match read(&bytes, None) {
            Ok(loaded) => loaded,
            Err(error) => {
                return Plan { issues: vec![lightbots_api::Issue::from(&error.issue())], ..Plan::default() };
            }
        };
        let mut found = loaded.issues;
        found.extend(validate(&loaded.show));
        found.extend(library.attach_pictures(&mut loaded.show));
        match show_plan::plan_unless(&loaded.show, &found, is_cancelled) {
            Ok((_, plan)) => plan,
            Err(Cancelled) => show_plan::cut_off(&found, budget),
        }
    });
    match plan.await {
        Ok(plan) => Ok(Json(plan)),
        Err(CutOff::TimeUp) => Ok(Json(show_plan::cut_off(&Vec::new(), budget))),
        Err(CutOff::Superseded) => Err(superseded()),
        Err(CutOff::Failed) => Err(failed()),
    }
}

/// The query parameters of `convert`.
#[derive(Debug, serde::Deserialize)]
pub struct To {
    /// Name of the wanted format in [`FORMATS`].
    to: String,
}

/// `POST /api/convert?to=FORMAT`: returns the show of the body as a file of a format of [`FORMATS`]. Assets that the
/// show names are added if the library has them. If the format needs a plan and the body brings none, the show is
/// planned as for `POST /api/check`.
pub async fn convert(
    State(shared): State<Arc<Shared>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    Query(To { to }): Query<To>,
    bytes: Result<Bytes, BytesRejection>,
) -> Answer<Response> {
    let Some(format) = named(&to) else {
        let names = FORMATS.map(|format| format!("?to={}", format.name)).join(" or ");
        return Err(refuse(StatusCode::BAD_REQUEST, &format!("there is no such format: say {names}")));
    };
    let bytes = body(bytes)?;
    let library = shared.library.clone();
    let loaded = beside(move || {
        read(&bytes, None).map(|mut loaded| {
            library.attach(&mut loaded.show);
            loaded
        })
    });
    let unprocessable = |line: &str| refuse(StatusCode::UNPROCESSABLE_ENTITY, line);
    let loaded = loaded.await?.map_err(|error| unprocessable(&error.to_string()))?;
    let written = if format.needs_plan && loaded.plan.is_none() {
        planned_file(&shared, ends, format, loaded).await?
    } else {
        beside(move || format.write(&loaded.show, loaded.plan.as_ref())).await?
    };
    match written.issues.iter().find(|issue| issue.is_error()) {
        Some(error) if written.bytes.is_empty() => Err(unprocessable(&error.message)),
        _ => Ok(([(header::CONTENT_TYPE, format.media_type)], written.bytes).into_response()),
    }
}

/// Plans a show and writes it in a format.
async fn planned_file(
    shared: &Shared,
    ends: Ends,
    format: &'static Format,
    mut loaded: Loaded,
) -> Answer<Written> {
    let library = shared.library.clone();
    let written = shared.planner.work(ends.remote.ip().to_canonical(), move |is_cancelled| {
        library.attach_pictures(&mut loaded.show);
        let plan = show_plan::plan_unless(&loaded.show, &loaded.issues, is_cancelled);
        plan.map(|(plan, _)| format.write(&loaded.show, Some(&plan)))
    });
    let refused = |line: &str| refuse(StatusCode::UNPROCESSABLE_ENTITY, line);
    match written.await {
        Ok(Ok(written)) => Ok(written),
        Ok(Err(Cancelled)) | Err(CutOff::TimeUp) => {
            Err(refused("planning the show took too long; export it on the command line: lightbots convert"))
        }
        Err(CutOff::Superseded) => Err(superseded()),
        Err(CutOff::Failed) => Err(failed()),
    }
}

fn superseded() -> Refused {
    refuse(StatusCode::CONFLICT, "a newer request of this client replaced this one; ask again")
}

fn failed() -> Refused {
    let line = "the server failed while planning: try again, and report its log";
    refuse(StatusCode::INTERNAL_SERVER_ERROR, line)
}

/// `GET /api/plan`: returns the plan of the open show, with paths. While that plan is being made, returns an empty one with
/// `planning` true.
pub async fn plan(State(shared): State<Arc<Shared>>) -> Answer<Response> {
    let plan = shared.desk.plan();
    let text = beside(move || serde_json::to_string(&*plan)).await?;
    let text = text.map_err(|error| refuse(StatusCode::INTERNAL_SERVER_ERROR, &error.to_string()))?;
    Ok(([(header::CONTENT_TYPE, "application/json"), (header::CACHE_CONTROL, "no-store")], text)
        .into_response())
}

/// Refuses a request to any other address below `/api`.
pub async fn unknown() -> Refused {
    refuse(StatusCode::NOT_FOUND, "the API has no such address")
}
