//! Decides which requests are admitted. Where sign-in is required, these are requests of signed-in people and of
//! programs with a token.

use std::net::IpAddr;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use axum::extract::{MatchedPath, Request, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use lightbots_api::AccountRole;

use super::access::{self, Need};
use super::refused::{Refused, refuse};
use super::sign_in_page;
use crate::accounts::{
    Accounts, HashThread, Person, Secret, Sessions, SignInTries, TriesLeft, hash_password, is_password,
};

/// Name of the cookie that holds the token of a session.
pub const COOKIE: &str = "lightbots";
/// Refusal of a request whose password could not be hashed.
const HASHING_FAILED: &str = "the server failed at the password: try again, and report its log";
/// Longest body of a request before sign-in, bytes: name, password and token fit.
const BODY_MAX: usize = 4 << 10;

/// The person or program that sent a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Caller {
    /// Name of the person or the token; `None` where sign-in is not required.
    pub name: Option<String>,
    pub role: AccountRole,
}

/// What a request presents to be admitted.
#[derive(Clone, Debug)]
pub enum Ticket {
    /// Nothing, where sign-in is not required.
    Loopback,
    /// Hash of the token of a person's session.
    Session(Secret),
    /// Hash of the token of a program.
    Token(Secret),
}

/// Why a sign-in led to no session.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SignInError {
    /// Name or password is wrong.
    Wrong(TriesLeft),
    /// Too many tries: the next one is possible after this time.
    Wait(Duration),
    /// The server failed: a line for people.
    Failed(String),
}

/// Accounts, sessions and counted wrong passwords of one server.
#[derive(Debug)]
pub struct Admission {
    is_required: bool,
    pub accounts: Accounts,
    pub sessions: Sessions,
    tries: Mutex<SignInTries>,
    /// Hash of the token with which the first operator is made. `None` if people had accounts when the server started, or if
    /// sign-in is not required.
    first: Option<Secret>,
    /// A hash that no password has. A password for an unknown name is checked against it, so that the answer takes as long
    /// as for a known name.
    unknown_hash: String,
    hashing: HashThread,
}

impl Admission {
    /// Returns the admission of a server. Also returns the token for its first operator, if sign-in is required
    /// (`is_required`) and no person has an account yet.
    pub fn new(data: &Path, is_required: bool) -> Result<(Self, Option<String>), String> {
        let accounts = Accounts::of(data);
        let (mut token, mut first, mut unknown_hash) = (None, None, String::new());
        if is_required {
            unknown_hash = hash_password(&Secret::fresh()?.0)?;
            if accounts.read()?.people.is_empty() {
                let (text, hash) = Secret::fresh()?;
                (token, first) = (Some(text), Some(hash));
            }
        }
        let (sessions, tries) = (Sessions::default(), Mutex::default());
        let hashing = HashThread::start()?;
        Ok((Self { is_required, accounts, sessions, tries, first, unknown_hash, hashing }, token))
    }

    /// Returns the person or program of a ticket, by the present accounts. `None` if the session or the token is not
    /// valid, if the accounts cannot be read, or for a `Loopback` ticket where sign-in is required.
    pub fn caller(&self, ticket: &Ticket) -> Option<Caller> {
        match ticket {
            Ticket::Loopback => {
                (!self.is_required).then_some(Caller { name: None, role: AccountRole::Operator })
            }
            Ticket::Session(session) => {
                let (name, password) = self.sessions.find(session, Instant::now())?;
                let list = self.read()?;
                let person = list.people.get(&name).filter(|person| person.password == password)?;
                Some(Caller { name: Some(name), role: person.role })
            }
            Ticket::Token(hash) => {
                let list = self.read()?;
                let (name, token) = list.tokens.iter().find(|(_, token)| token.hash == *hash)?;
                Some(Caller { name: Some(name.clone()), role: list.role_of(token)? })
            }
        }
    }

    /// Returns the name of a session's person, or of the person that made a token. `None` if no person is known.
    pub fn person(&self, ticket: &Ticket) -> Option<String> {
        match ticket {
            Ticket::Loopback => None,
            Ticket::Session(session) => Some(self.sessions.find(session, Instant::now())?.0),
            Ticket::Token(hash) => self.read()?.tokens.into_values().find(|token| token.hash == *hash)?.maker,
        }
    }

    fn read(&self) -> Option<crate::accounts::AccountList> {
        self.accounts.read().inspect_err(|line| tracing::error!("{line}")).ok()
    }

    /// Returns the ticket in the headers of a request. `None` if sign-in is required and the headers hold no token.
    fn ticket(&self, headers: &HeaderMap) -> Option<Ticket> {
        if !self.is_required {
            return Some(Ticket::Loopback);
        }
        if let Some(value) = headers.get(header::AUTHORIZATION) {
            let token = value.to_str().ok()?.strip_prefix("Bearer ")?;
            return Some(Ticket::Token(Secret::of(token.trim())));
        }
        let cookies = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
        let pairs = cookies.flat_map(|line| line.split(';')).filter_map(|pair| pair.trim().split_once('='));
        let token = pairs.filter(|(name, _)| *name == COOKIE).map(|(_, token)| token).next();
        token.map(|token| Ticket::Session(Secret::of(token)))
    }

    /// Signs a person in from the network address `address`. Returns the token of the session.
    pub async fn sign_in(&self, name: &str, password: &str, address: IpAddr) -> Result<String, SignInError> {
        let failed = |line: String| SignInError::Failed(line);
        // One try at a time, so that parallel tries cannot pass the bound before they are counted.
        let turn = self.hashing.turn().await;
        self.tries().may_try(name, address, Instant::now()).map_err(SignInError::Wait)?;
        let person = self.accounts.read().map_err(failed)?.people.remove(name);
        let hash = person.as_ref().map_or(&self.unknown_hash, |person| &person.password).clone();
        let password = password.to_owned();
        let checked = self.hashing.run(turn, move || is_password(&password, &hash)).await;
        let (is_right, _turn) = checked.ok_or_else(|| failed(HASHING_FAILED.into()))?;
        match person.filter(|_| is_right) {
            Some(Person { password, .. }) => {
                self.tries().right(name, address);
                self.sessions.begin(name, &password, Instant::now()).map_err(failed)
            }
            None => Err(SignInError::Wrong(self.tries().wrong(name, address, Instant::now()))),
        }
    }

    /// Makes the first operator and signs that person in. `token` must be the one that [`Self::new`] returned. Returns
    /// the token of the session. `Err`: status and line of the refusal, for example if any person has an account
    /// already.
    pub async fn begin_first(
        &self,
        token: &str,
        name: &str,
        password: &str,
    ) -> Result<String, (StatusCode, String)> {
        let used = || {
            let line = "This address was used before or belongs to another start. Sign in, or set a password on the \
                        machine: lightbots passwd NAME";
            (StatusCode::FORBIDDEN, line.to_owned())
        };
        if self.first.as_ref() != Some(&Secret::of(token)) {
            return Err(used());
        }
        let wrong = |line| (StatusCode::UNPROCESSABLE_ENTITY, line);
        crate::accounts::check_name(name).map_err(wrong)?;
        let failed = |line: String| (StatusCode::INTERNAL_SERVER_ERROR, line);
        let hash = self.hash(password).await?;
        let person = Person { role: AccountRole::Operator, password: hash.clone() };
        let added = self.accounts.change(|list| {
            let is_first = list.people.is_empty();
            if is_first {
                list.people.insert(name.to_owned(), person);
            }
            Ok(is_first)
        });
        if !added.map_err(failed)? {
            return Err(used());
        }
        self.sessions.begin(name, &hash, Instant::now()).map_err(failed)
    }

    /// Checks and hashes a new password. `Err`: status and line of the refusal if the password is too short or too long, or
    /// if hashing fails.
    pub async fn hash(&self, password: &str) -> Result<String, (StatusCode, String)> {
        crate::accounts::check_password(password).map_err(|line| (StatusCode::UNPROCESSABLE_ENTITY, line))?;
        let turn = self.hashing.turn().await;
        let failed = |line: String| (StatusCode::INTERNAL_SERVER_ERROR, line);
        let text = password.to_owned();
        let hashed = self.hashing.run(turn, move || hash_password(&text)).await;
        hashed.ok_or_else(|| failed(HASHING_FAILED.into()))?.0.map_err(failed)
    }

    fn tries(&self) -> std::sync::MutexGuard<'_, SignInTries> {
        self.tries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Passes on requests that are admitted, and short requests to sign in. A request for a page from a caller that is not
/// signed in gets the sign-in page. Other requests of that caller, and requests beyond the caller's role, are refused.
pub async fn guard(State(admission): State<Arc<Admission>>, mut request: Request, next: Next) -> Response {
    let route = request.extensions().get::<MatchedPath>().map(|path| path.as_str().to_owned());
    let ticket = admission.ticket(request.headers());
    let admitted = ticket.and_then(|ticket| admission.caller(&ticket).map(|caller| (ticket, caller)));
    let need = route.as_deref().map(|route| access::of_route(route, request.method()));
    match (need, admitted) {
        // A page of the app.
        (None, None) => return sign_in_page::page(request.method()),
        (Some(Need::Nothing), _) => {
            if !is_short(request.headers()) {
                return refuse(StatusCode::PAYLOAD_TOO_LARGE, "this is too long for a sign-in")
                    .into_response();
            }
        }
        (Some(Need::Role(_)), None) => return unknown().into_response(),
        (Some(Need::Role(role)), Some((_, caller))) if caller.role < role => {
            return refuse(StatusCode::FORBIDDEN, &not_allowed(role, caller.role)).into_response();
        }
        (_, Some((ticket, caller))) => {
            request.extensions_mut().insert(ticket);
            request.extensions_mut().insert(caller);
        }
    }
    next.run(request).await
}

fn unknown() -> Refused {
    refuse(StatusCode::UNAUTHORIZED, "sign in first, or send the header Authorization: Bearer TOKEN")
}

/// Returns the line that says why a role is not enough.
pub fn not_allowed(needed: AccountRole, role: AccountRole) -> String {
    format!("This needs the role {needed}; you are signed in as {role}. An operator can change that.")
}

/// Whether a body is short enough to be read before sign-in. False without a Content-Length header.
fn is_short(headers: &HeaderMap) -> bool {
    let length =
        headers.get(header::CONTENT_LENGTH).and_then(|length| length.to_str().ok()?.parse::<usize>().ok());
    length.is_some_and(|length| length <= BODY_MAX)
}
