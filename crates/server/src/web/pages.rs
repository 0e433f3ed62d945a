//! The browser app that is built into the program.

use axum::http::{HeaderMap, HeaderName, Method, StatusCode, Uri, header};
use axum::response::{Html, IntoResponse, Response};

/// A file of the built browser app.
struct File {
    /// Path below the server's root, without a leading slash.
    path: &'static str,
    kind: &'static str,
    tag: &'static str,
    /// Content of the file, compressed with gzip, which every browser accepts.
    packed: &'static [u8],
}

include!(concat!(env!("OUT_DIR"), "/screen.rs"));

/// Content security policy: scripts only from this server, so that text in a show or a robot's name runs nothing.
/// `wasm-unsafe-eval` lets the page compile WebAssembly of this server; it allows no JavaScript from text.
const POLICY: &str = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
                      img-src 'self' data: blob:; media-src 'self' blob: data:; connect-src 'self' ws: wss:; frame-ancestors 'none'";

/// The page of a program that was built without the browser app.
const UNBUILT: &str = "<!doctype html><meta charset=utf-8><title>LightBots</title>\
    <body style='font:16px/1.6 sans-serif;background:#111;color:#ddd;max-width:40em;margin:4em auto'>\
    <h1>LightBots is running</h1><p>This build has no browser app in it. Build it, then the program again:</p>\
    <pre style='background:#222;padding:1em'>cargo xtask demo</pre>";

/// Returns a file of the app. Below `assets/`, an unknown address is an error. Any other address gets the app's page, whose
/// script handles addresses.
pub async fn page(method: Method, uri: Uri, headers: HeaderMap) -> Response {
    if !matches!(method, Method::GET | Method::HEAD) {
        return StatusCode::METHOD_NOT_ALLOWED.into_response();
    }
    let path = uri.path().trim_start_matches('/');
    let file = FILES.iter().find(|file| file.path == path);
    if let Some(file) = file {
        return send(file, &headers);
    }
    if path.starts_with("assets/") {
        return StatusCode::NOT_FOUND.into_response();
    }
    match FILES.iter().find(|file| file.path == "index.html") {
        Some(index) => send(index, &headers),
        None => Html(UNBUILT).into_response(),
    }
}

fn send(file: &File, headers: &HeaderMap) -> Response {
    // Files in assets/ have a hash in their names and never change. The page that names them must always be fresh.
    let lasting = file.path.starts_with("assets/");
    let caching = if lasting { "public, max-age=31536000, immutable" } else { "no-cache" };
    let about: [(HeaderName, &str); 7] = [
        (header::CONTENT_TYPE, file.kind),
        (header::CONTENT_ENCODING, "gzip"),
        (header::ETAG, file.tag),
        (header::CACHE_CONTROL, caching),
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
    ];
    if headers.get(header::IF_NONE_MATCH).is_some_and(|tag| tag.as_bytes() == file.tag.as_bytes()) {
        return (StatusCode::NOT_MODIFIED, about).into_response();
    }
    (about, file.packed).into_response()
}
