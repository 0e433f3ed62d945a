//! The screen's server: pages, library and WebSocket. A slow or hostile screen never holds up the show.

mod api;
mod broker;
mod desk;
mod log;
mod operate;
mod origin;
mod pages;
mod picture;
mod socket;
mod sums;
mod uploads;

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicUsize};

use axum::Router;
use axum::routing::{any, get, post};
use axum::serve::ListenerExt;
use tokio::net::TcpListener;

pub use broker::BrokerDesk;
pub use desk::{Desk, Shown};
pub use log::Log;

use crate::failure::Failure;
use crate::library::Library;
use crate::live::conductor::Handle;
use picture::Pictures;

/// What every request may use.
#[derive(Debug)]
pub struct Shared {
    pub handle: Handle,
    pub library: Library,
    pub desk: Desk,
    pub log: Log,
    pub pictures: Pictures,
    pub broker: BrokerDesk,
    /// How many simulated robots there are.
    pub simulated: Arc<AtomicUsize>,
    pub screens: AtomicU32,
}

impl Shared {
    /// Everything a screen's server needs; starts the tasks that watch the conductor.
    pub fn new(handle: Handle, library: Library, broker: BrokerDesk) -> Arc<Self> {
        let log = Log::new();
        tokio::spawn(log.clone().follow(handle.news()));
        let desk = Desk::new(handle.clone());
        tokio::spawn(desk.clone().follow(handle.news()));
        let pictures = Pictures::new();
        tokio::spawn(pictures.clone().follow(handle.clone(), desk.clone()));
        let (screens, simulated) = (AtomicU32::new(0), Arc::default());
        Arc::new(Self { handle, library, desk, log, pictures, broker, simulated, screens })
    }
}

/// Takes the address; one line with what to do where it is taken.
pub async fn listen(address: SocketAddr) -> Result<TcpListener, Failure> {
    TcpListener::bind(address).await.map_err(|error| {
        if error.kind() == std::io::ErrorKind::AddrInUse {
            let line = "stop the program there, or choose a port with --listen";
            return Failure::problem(format!("the address {address} is taken: {line}"));
        }
        Failure::problem(format!("cannot listen on {address}: {error}; choose another --listen"))
    })
}

/// Serves until the task is dropped.
pub async fn serve(listener: TcpListener, shared: Arc<Shared>) {
    let local = listener.local_addr().is_ok_and(|address| address.ip().is_loopback());
    let routes = Router::new()
        .route("/ws", any(socket::open))
        .route("/api/shows", get(api::list))
        .route("/api/shows/{name}", get(api::get).put(api::put).delete(api::delete))
        .route("/api/check", post(api::check))
        .route("/api/convert", post(api::convert))
        .route("/api/plan", get(api::plan))
        .route("/api/broker", get(broker::settings))
        .route("/api/{*rest}", any(api::unknown))
        .fallback(pages::page)
        .layer(axum::middleware::from_fn_with_state(uploads::Uploads::new(), uploads::bound))
        .layer(axum::extract::DefaultBodyLimit::max(api::BODY_MAX))
        .layer(axum::middleware::from_fn_with_state(local, origin::guard))
        .with_state(shared);
    let listener = listener.tap_io(|stream| {
        // Without it a snapshot may wait for the one before it to be acknowledged.
        let _ = stream.set_nodelay(true);
    });
    if let Err(error) = axum::serve(listener, routes).await {
        tracing::error!("the web server failed: {error}");
    }
}
