//! The recorded runs and their reports over HTTP.
//!
//! A report is made while its run is on, or from the recorded inputs at the first request, and is kept beside them.
//! Reports on request are made one at a time, on a separate thread, because each takes a processor for a while.

use std::fs::File;
use std::io::Read;
use std::panic::catch_unwind;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, UNIX_EPOCH};

use axum::Json;
use axum::extract::{Path as UrlPath, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use lightbots_api::RunEntry;
use lightbots_control::{HEAD_BYTES, check_head};
use lightbots_report::{GrowingReport, Scrub, ShowReport, page};
use tokio::sync::Semaphore;

use super::refused::{Refused, refuse};
use crate::disk::{self, Readers};
use crate::live::conductor::Handle;
use crate::live::run_facts::RunFacts;
use crate::live::run_files::{facts_file, recorded_runs, report_file, run_file};

/// Longest page of a report that is read, bytes. Pages are shorter, because a report bounds its samples and robots. A
/// longer page is made again.
const PAGE_MAX: u64 = 64 << 20;
/// Longest wait of a request for a report. The report is made even if that takes longer, and a later request finds it.
const PATIENCE: Duration = Duration::from_secs(60);
/// Time between two checks whether a report has been made.
const POLL: Duration = Duration::from_millis(20);
/// Content security policy of a report: it loads nothing, and its script has no access to this server.
const POLICY: &str = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; \
                      sandbox allow-scripts allow-downloads; frame-ancestors 'none'";

/// The runs of a data folder.
#[derive(Clone, Debug)]
pub struct Runs {
    data: Arc<Path>,
    handle: Handle,
    /// The one permit of this semaphore lets one report be made at a time.
    turn: Arc<Semaphore>,
}

impl Runs {
    /// Returns the runs of this data folder. The newest run may still be going on.
    pub fn of(data: &Path, handle: Handle) -> Self {
        Self { data: data.into(), handle, turn: Arc::new(Semaphore::new(1)) }
    }

    fn list(&self) -> std::io::Result<Vec<RunEntry>> {
        let runs = recorded_runs(&self.data)?;
        Ok(runs.into_iter().map(|(number, _)| entry(&self.data, number)).collect())
    }

    /// Returns the page of a run's report, and makes it if there is none. `is_running`: whether the newest run is still
    /// going on; its report is refused then.
    async fn report(&self, number: u64, is_running: bool) -> Result<Vec<u8>, Refused> {
        let failed = |line: String| refuse(StatusCode::INTERNAL_SERVER_ERROR, &line);
        let (data, turn) = (self.data.clone(), self.turn.clone());
        let (log, reports) = (run_file(&self.data, number), self.handle.reports().clone());
        // In a task of its own, so that a client that leaves or waits no longer does not stop it.
        let made = tokio::spawn(async move {
            // The report of a run that has just ended is nearly ready.
            while !is_running && reports.contains(&log) {
                tokio::time::sleep(POLL).await;
            }
            let turn = turn.acquire_owned().await;
            let made = tokio::task::spawn_blocking(move || {
                let _turn = turn;
                report(&data, number, is_running)
            });
            made.await.unwrap_or_else(|error| Err(failed(format!("the report failed: {error}"))))
        });
        match tokio::time::timeout(PATIENCE, made).await {
            Ok(made) => made.unwrap_or_else(|error| Err(failed(error.to_string()))),
            Err(_) => Err(refuse(
                StatusCode::SERVICE_UNAVAILABLE,
                "this report takes long to make: ask for it again in a minute",
            )),
        }
    }
}

/// Returns the entry of a run in the list.
fn entry(data: &Path, number: u64) -> RunEntry {
    let log = run_file(data, number);
    let facts = RunFacts::read(&facts_file(&log)).unwrap_or_else(|| of_file(&log));
    RunEntry {
        number,
        kind: facts.kind,
        show: facts.show,
        began_ms: facts.began_ms,
        ended_ms: facts.ended_ms,
        ok: facts.ok,
        outcome: facts.outcome,
        has_report: report_file(&log).is_file() || is_readable(&log).unwrap_or(false),
    }
}

/// Returns facts for a log whose facts are missing. Only the beginning is set, to the time of the log's last change.
fn of_file(log: &Path) -> RunFacts {
    let modified = std::fs::metadata(log).and_then(|file| file.modified()).ok();
    let since = modified.and_then(|modified| modified.duration_since(UNIX_EPOCH).ok()).unwrap_or_default();
    RunFacts { began_ms: since.as_millis() as u64, ..RunFacts::default() }
}

fn is_readable(log: &Path) -> std::io::Result<bool> {
    let mut head = [0; HEAD_BYTES];
    File::open(log)?.read_exact(&mut head)?;
    Ok(check_head(&head).is_ok())
}

fn report(data: &Path, number: u64, is_running: bool) -> Result<Vec<u8>, Refused> {
    let newest = recorded_runs(data).ok().and_then(|runs| runs.first().map(|run| run.0));
    if is_running && newest == Some(number) {
        let line = "this run is still on: its report can be read when it has ended";
        return Err(refuse(StatusCode::CONFLICT, line));
    }
    let log = run_file(data, number);
    let kept = report_file(&log);
    if let Ok(page) = disk::read_regular(&kept, PAGE_MAX) {
        return Ok(page);
    }
    let file = disk::open_regular(&log).map_err(|_| none(number))?;
    let unfit =
        |why: String| refuse(StatusCode::UNPROCESSABLE_ENTITY, &format!("run {number} has no report: {why}"));
    // If the recorded controller panicked, the replayed one panics as well.
    let made = catch_unwind(|| report_of_file(file));
    let (report, scrub) =
        made.map_err(|_| unfit("the controller failed in this run".into()))?.map_err(unfit)?;
    let page = page(&report, &scrub).into_bytes();
    if let Err(error) = disk::replace(&kept, &page, Readers::All) {
        tracing::warn!("the report of run {number} is not kept: {error}");
    }
    Ok(page)
}

/// Makes the report of a log, which is read in pieces.
fn report_of_file(mut log: File) -> Result<(ShowReport, Scrub), String> {
    let (mut report, mut piece) = (GrowingReport::default(), vec![0; 1 << 20]);
    loop {
        let length = log.read(&mut piece).map_err(|error| error.to_string())?;
        if length == 0 {
            return report.finish().map_err(|error| error.to_string());
        }
        report.feed(&piece[..length]).map_err(|error| error.to_string())?;
    }
}

fn none(number: u64) -> Refused {
    refuse(StatusCode::NOT_FOUND, &format!("there is no recorded run {number}"))
}

/// `GET /api/runs`: lists the recorded runs, the newest first.
pub async fn list(State(runs): State<Runs>) -> Result<Json<Vec<RunEntry>>, Refused> {
    let listed = tokio::task::spawn_blocking(move || runs.list()).await;
    let failed = |error: String| {
        refuse(StatusCode::INTERNAL_SERVER_ERROR, &format!("the runs cannot be listed: {error}"))
    };
    listed.map_err(|error| failed(error.to_string()))?.map(Json).map_err(|error| failed(error.to_string()))
}

/// `GET /api/runs/{number}/report`: returns the report of a recorded run as a page.
pub async fn read_report(
    State(runs): State<Runs>,
    UrlPath(number): UrlPath<u64>,
) -> Result<Response, Refused> {
    let is_running = runs.handle.look().await.is_some_and(|snapshot| snapshot.run.is_some());
    let page = runs.report(number, is_running).await?;
    let about = [
        (header::CONTENT_TYPE, "text/html; charset=utf-8"),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "private, no-cache"),
    ];
    Ok((about, page).into_response())
}
