//! The web server of the screens: pages, library and WebSocket. It is separate from the task that plays a show, so that
//! a slow or hostile screen does not delay the show.

mod access;
mod address;
mod admission;
mod api;
mod broker;
mod broker_desk;
mod certificate;
mod connection;
mod desk;
mod guests;
mod incidents;
mod log;
mod message;
mod names;
mod operate;
mod origin;
mod pages;
mod people;
mod picture;
mod planner;
mod playlist;
mod preflight;
mod refused;
mod runs;
mod scheme;
mod sign_in;
mod sign_in_page;
mod socket;
mod state;
mod stream;
mod sums;
mod uploads;

use std::sync::Arc;

use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::{any, delete, get, post, put};
use tokio::net::TcpListener;
use tokio_rustls::TlsAcceptor;

pub use address::url;
pub use admission::Admission;
pub use broker_desk::BrokerDesk;
pub use certificate::WebCertificate;
pub use desk::{Desk, Shown};
pub use log::ScreenLog;
pub use names::{Exposure, Names};
pub use operate::operate;
pub use planner::Planner;
pub use scheme::Scheme;
pub use state::Shared;

use crate::failure::Failure;
use crate::playlist::PlaylistStore;
use connection::{Connections, Ends};
use runs::Runs;

/// Binds the address of the web app. Returns the listener and the names of this server. The failure is one line with a
/// remedy.
pub async fn listen(exposure: &Exposure) -> Result<(TcpListener, Names), Failure> {
    let address = exposure.listen();
    let listener = TcpListener::bind(address).await.map_err(|error| {
        if error.kind() == std::io::ErrorKind::AddrInUse {
            let line = "stop the program there, or choose a port with --listen";
            return Failure::problem(format!("the address {address} is taken: {line}"));
        }
        Failure::problem(format!("cannot listen on {address}: {error}; choose another --listen"))
    })?;
    let port = listener.local_addr().unwrap_or(address).port();
    Ok((listener, exposure.names(port)?))
}

/// Serves the web app until the task is dropped, over TLS if there is an acceptor.
pub async fn serve(listener: TcpListener, acceptor: Option<TlsAcceptor>, shared: Arc<Shared>) {
    let longest_wait = shared.planner.longest_wait();
    let connections = Connections::new(listener, acceptor, shared.log.clone(), longest_wait);
    let routes = Router::new()
        .route("/ws", any(socket::open))
        .route("/api/shows", get(api::list))
        .route("/api/shows/{name}", get(api::get).put(api::put).delete(api::delete))
        .route("/api/shows/{name}/file", get(api::file))
        .route("/api/shows/{name}/states", get(api::states))
        .route("/api/shows/{name}/states/{number}", get(api::state))
        .route("/api/assets/{hash}", get(api::asset).put(api::put_asset))
        .route("/api/check", post(api::check))
        .route("/api/convert", post(api::convert))
        .route("/api/plan", get(api::plan))
        .route("/api/broker", get(broker::settings))
        .route("/api/operate", post(operate::post).layer(DefaultBodyLimit::max(operate::LONGEST)))
        .merge(accounts(shared.admission.clone()))
        .merge(recorded(shared.runs.clone()))
        .merge(scheduled(shared.playlist.clone()))
        .route("/api/{*rest}", any(api::unknown))
        .fallback(pages::page)
        .layer(axum::middleware::from_fn_with_state(uploads::Uploads::new(), uploads::bound))
        .layer(DefaultBodyLimit::max(api::BODY_MAX))
        .layer(axum::middleware::from_fn(refused::uniform))
        .layer(axum::middleware::from_fn_with_state(shared.admission.clone(), admission::guard))
        .layer(axum::middleware::from_fn_with_state(shared.clone(), origin::guard))
        .with_state(shared);
    let routes = routes.into_make_service_with_connect_info::<Ends>();
    if let Err(error) = axum::serve(connections, routes).await {
        tracing::error!("the web server failed: {error}");
    }
}

/// Returns the routes of sign-in, people and tokens.
fn accounts(admission: Arc<Admission>) -> Router<Arc<Shared>> {
    Router::new()
        .route("/api/session", get(sign_in::session).post(sign_in::sign_in).delete(sign_in::sign_out))
        .route("/api/first", post(sign_in::first))
        .route("/api/people", get(sign_in::people).post(people::add))
        .route("/api/people/{name}", put(people::change).delete(people::remove))
        .route("/api/tokens", get(sign_in::tokens).post(sign_in::make_token))
        .route("/api/tokens/{name}", delete(sign_in::revoke_token))
        .with_state(admission)
}

/// Returns the routes of the recorded runs.
fn recorded(runs: Runs) -> Router<Arc<Shared>> {
    Router::new()
        .route("/api/runs", get(runs::list))
        .route("/api/runs/{number}/report", get(runs::read_report))
        .with_state(runs)
}

/// Returns the routes of the playlist.
fn scheduled(playlist: PlaylistStore) -> Router<Arc<Shared>> {
    Router::new()
        .route("/api/playlist", get(playlist::read).put(playlist::change))
        .layer(DefaultBodyLimit::max(playlist::LONGEST))
        .with_state(playlist)
}
