//! Who may ask, and how much: pages of this server only, and nothing without end.

use std::time::Duration;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::api::{BODY_MAX, refuse, too_long};

/// A request that takes longer to come in and be answered is given up.
const PATIENCE: Duration = Duration::from_secs(300);

/// Turns away what a page of another site sends through a visitor's browser. `local`: the server can only be reached
/// from this machine, so that any other name for it is one a stranger made.
pub async fn guard(State(local): State<bool>, request: Request, next: Next) -> Response {
    let changes = !matches!(*request.method(), Method::GET | Method::HEAD) || request.uri().path() == "/ws";
    if changes && !is_ours(request.headers(), local) {
        let line = "this page belongs to another site: open the address that lightbots printed";
        return refuse(StatusCode::FORBIDDEN, line).into_response();
    }
    let length = request.headers().get(header::CONTENT_LENGTH).and_then(|length| length.to_str().ok());
    if length.and_then(|length| length.parse::<usize>().ok()).is_some_and(|length| length > BODY_MAX) {
        return too_long().into_response();
    }
    match tokio::time::timeout(PATIENCE, next.run(request)).await {
        Ok(response) => response,
        Err(_) => refuse(StatusCode::REQUEST_TIMEOUT, "this took too long: try again").into_response(),
    }
}

/// Whether the page that asks came from this server or, such as a development server's, from this machine. Programs
/// that are no browser state no origin and may ask.
fn is_ours(headers: &HeaderMap, local: bool) -> bool {
    let Some(origin) = headers.get(header::ORIGIN) else { return true };
    let origin = origin.to_str().ok().and_then(|origin| origin.split_once("://")).map(|(_, host)| host);
    let host = headers.get(header::HOST).and_then(|host| host.to_str().ok());
    let (Some(origin), Some(host)) = (origin, host) else { return false };
    is_loopback(origin) && is_loopback(host) || !local && host.eq_ignore_ascii_case(origin)
}

fn is_loopback(host: &str) -> bool {
    let host = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or(rest),
        None => host.split(':').next().unwrap_or(host),
    };
    host.eq_ignore_ascii_case("localhost")
        || host.parse::<std::net::IpAddr>().is_ok_and(|ip| ip.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ours(host: &str, origin: &str, local: bool) -> bool {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        headers.insert(header::ORIGIN, origin.parse().unwrap());
        is_ours(&headers, local)
    }

    #[test]
    fn only_own_pages_may_ask() {
        assert!(is_ours(&HeaderMap::new(), true));
        for local in [true, false] {
            assert!(ours("127.0.0.1:8420", "http://127.0.0.1:8420", local));
            assert!(ours("localhost:8420", "http://127.0.0.1:5173", local));
            assert!(ours("[::1]:8420", "http://[::1]:8420", local));
            assert!(!ours("127.0.0.1:8420", "http://evil.example", local));
            assert!(!ours("127.0.0.1:8420", "null", local));
            assert!(!ours("192.168.0.7:8420", "http://localhost:8420", local));
            // A server that can be reached from elsewhere may well have a name.
            assert_eq!(ours("stage.example:8420", "http://stage.example:8420", local), !local);
        }
    }
}
