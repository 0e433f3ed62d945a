//! Guard of requests: passes on only requests to a name of this server and from pages of this server, and bounds their
//! time.

use std::net::IpAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::extract::{ConnectInfo, Request, State};
use axum::http::{HeaderMap, HeaderName, Method, StatusCode, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::api::{BODY_MAX, too_long};
use super::connection::Ends;
use super::names::Names;
use super::refused::{Refused, refuse};
use super::scheme::Scheme;
use super::state::Shared;

/// Longest time from the end of a request's headers until its answer begins, beyond the budget of a plan. The longest upload
/// (20 s of waiting and 74 s of transfer) fits. A longer time would keep hostile connections open.
const PATIENCE: Duration = Duration::from_secs(270);

/// Passes on requests that are for this server. Refuses requests to other names (DNS rebinding) and requests that pages of
/// other servers send through a visitor's browser (cross-site request forgery). Also refuses bodies that are too long. On a
/// server with TLS, redirects or refuses requests without TLS.
pub async fn guard(
    State(shared): State<Arc<Shared>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    request: Request,
    next: Next,
) -> Response {
    if shared.names.scheme() == Scheme::Https && !ends.is_secure {
        return elsewhere(&shared.names, ends.local.ip(), &request);
    }
    if let Err(refused) = check(&shared.names, ends.local.ip(), request.uri(), request.headers()) {
        return refused.into_response();
    }
    let length = request.headers().get(header::CONTENT_LENGTH).and_then(|length| length.to_str().ok());
    if length.and_then(|length| length.parse::<usize>().ok()).is_some_and(|length| length > BODY_MAX) {
        return too_long().into_response();
    }
    match tokio::time::timeout(PATIENCE + shared.planner.budget(), next.run(request)).await {
        Ok(response) => response,
        Err(_) => refuse(StatusCode::REQUEST_TIMEOUT, "this took too long: try again").into_response(),
    }
}

/// Redirects a GET or HEAD request without TLS to the same address with TLS, if it names this server and has no
/// Authorization header. Refuses any other request. A program that sends its token without TLS then gets an error and
/// not an answer.
fn elsewhere(names: &Names, local: IpAddr, request: &Request) -> Response {
    let host = only(request.headers(), header::HOST).flatten();
    let own = host.filter(|host| {
        Names::host(Scheme::Http, host).is_some_and(|authority| names.hold(&authority, local))
    });
    let is_page = matches!(*request.method(), Method::GET | Method::HEAD)
        && !request.headers().contains_key(header::AUTHORIZATION);
    match own.filter(|_| is_page) {
        Some(host) => {
            let path = request.uri().path_and_query().map_or("/", |path| path.as_str());
            let to = [(header::LOCATION, format!("https://{host}{path}"))];
            let line = refuse(StatusCode::TEMPORARY_REDIRECT, "this server speaks HTTPS");
            (StatusCode::TEMPORARY_REDIRECT, [(header::CACHE_CONTROL, "no-store")], to, line).into_response()
        }
        None => {
            let line = "this server speaks HTTPS: begin its address with https://";
            refuse(StatusCode::BAD_REQUEST, line).into_response()
        }
    }
}

/// Checks that a request on a connection to the address `local` is for this server and from one of its pages. Programs
/// other than browsers send no origin and are allowed. `Err`: the refusal.
fn check(names: &Names, local: IpAddr, uri: &Uri, headers: &HeaderMap) -> Result<(), Refused> {
    let unclear = || refuse(StatusCode::BAD_REQUEST, "a request needs one Host header with host and port");
    let host = only(headers, header::HOST).ok_or_else(unclear)?;
    let read = |host: &str| Names::host(names.scheme(), host);
    let host = host.and_then(read).ok_or_else(unclear)?;
    // The request line may name the host, too.
    if uri.authority().is_some_and(|named| read(named.as_str()).as_ref() != Some(&host)) {
        return Err(unclear());
    }
    if !names.hold(&host, local) {
        let line = "this server is not served under that name: open the address that lightbots printed, or start it \
                    with --host-name NAME";
        return Err(refuse(StatusCode::MISDIRECTED_REQUEST, line));
    }
    match only(headers, header::ORIGIN) {
        Some(None) => Ok(()),
        Some(Some(origin)) if names.origin(origin) == Some(host) => Ok(()),
        _ => {
            let line = "this page belongs to another site: open the address that lightbots printed";
            Err(refuse(StatusCode::FORBIDDEN, line))
        }
    }
}

/// Returns the value of a header that may occur once. `Some(None)` if it is missing. `None` if it occurs twice or is
/// not text.
fn only(headers: &HeaderMap, name: HeaderName) -> Option<Option<&str>> {
    let mut values = headers.get_all(name).iter();
    let Some(value) = values.next() else { return Some(None) };
    let text = value.to_str().ok()?;
    values.next().is_none().then_some(Some(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::web::names::Exposure;

    fn status(uri: &str, headers: &[(&str, &str)]) -> u16 {
        let listen: std::net::SocketAddr = "127.0.0.1:8420".parse().unwrap();
        let names = Exposure::new(listen, false, Vec::new()).unwrap().names(8420).unwrap();
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(HeaderName::try_from(*name).unwrap(), value.parse().unwrap());
        }
        let checked = check(&names, listen.ip(), &uri.parse().unwrap(), &map);
        checked.map_or_else(|refused| refused.into_response().status().as_u16(), |()| 200)
    }

    #[test]
    fn one_host_header_names_this_server() {
        for (host, expected) in [
            (&[("host", "127.0.0.1:8420")][..], 200),
            (&[], 400),
            (&[("host", "")], 400),
            (&[("host", "127.0.0.1:8420"), ("host", "127.0.0.1:8420")], 400),
            (&[("host", "evil.example:8420"), ("host", "127.0.0.1:8420")], 400),
            (&[("host", "evil.example:8420")], 421),
            (&[("host", "127.0.0.1")], 421),
        ] {
            assert_eq!(status("/api/shows", host), expected, "{host:?}");
        }
        let ours = [("host", "127.0.0.1:8420")];
        assert_eq!(status("http://127.0.0.1:8420/api/shows", &ours), 200);
        assert_eq!(status("http://evil.example:8420/api/shows", &ours), 400);
    }

    #[test]
    fn an_origin_is_that_of_the_host() {
        for (host, origin, expected) in [
            ("127.0.0.1:8420", "http://127.0.0.1:8420", 200),
            ("LOCALHOST:8420", "http://localhost:8420", 200),
            ("[::1]:8420", "http://[::1]:8420", 200),
            ("localhost:8420", "http://127.0.0.1:8420", 403),
            ("localhost:8420", "http://localhost:5173", 403),
            ("localhost:8420", "http://localhost", 403),
            ("localhost:8420", "https://localhost:8420", 403),
            ("localhost:8420", "http://evil.example", 403),
            ("localhost:8420", "http://localhost:8420/", 403),
            ("localhost:8420", "null", 403),
            ("localhost:8420", "", 403),
            ("evil.example:8420", "http://evil.example:8420", 421),
        ] {
            assert_eq!(status("/ws", &[("host", host), ("origin", origin)]), expected, "{host} {origin}");
        }
        let own = "http://localhost:8420";
        assert_eq!(status("/", &[("host", "localhost:8420"), ("origin", own), ("origin", own)]), 403);
    }
}
