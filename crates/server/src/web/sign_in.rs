//! Sign-in, sign-out, and lists of people and tokens over HTTP.

use std::sync::Arc;
use std::time::Duration;

use axum::extract::{ConnectInfo, Path, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::{Extension, Json};
use lightbots_api::{AccountEntry, Credentials, FirstOperator, MadeToken, Whoami};

use super::admission::{Admission, COOKIE, Caller, SignInError, Ticket};
use super::connection::Ends;
use super::refused::{Refused, refuse};
use crate::accounts::{ApiToken, SESSION_LASTS, Secret, TriesLeft, check_name};

/// `POST /api/session`: signs a person in. The answer sets the cookie of the session.
pub async fn sign_in(
    State(admission): State<Arc<Admission>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    Json(Credentials { name, password }): Json<Credentials>,
) -> Response {
    match admission.sign_in(&name, &password, ends.remote.ip()).await {
        Ok(token) => cookie(&token, SESSION_LASTS, ends),
        Err(SignInError::Wrong(left)) => refuse(StatusCode::UNAUTHORIZED, &wrong(left)).into_response(),
        Err(SignInError::Wait(wait)) => {
            let line = format!("Too many wrong passwords. Try again in {}.", in_words(wait));
            let seconds = [(header::RETRY_AFTER, (wait.as_secs() + 1).to_string())];
            (seconds, refuse(StatusCode::TOO_MANY_REQUESTS, &line)).into_response()
        }
        Err(SignInError::Failed(line)) => refuse(StatusCode::INTERNAL_SERVER_ERROR, &line).into_response(),
    }
}

/// `POST /api/first`: makes the first operator and signs that person in.
pub async fn first(
    State(admission): State<Arc<Admission>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    Json(FirstOperator { token, name, password }): Json<FirstOperator>,
) -> Response {
    match admission.begin_first(&token, &name, &password).await {
        Ok(token) => cookie(&token, SESSION_LASTS, ends),
        Err((status, line)) => refuse(status, &line).into_response(),
    }
}

/// `GET /api/session`: returns name and role of the caller.
pub async fn session(Extension(caller): Extension<Caller>) -> Json<Whoami> {
    Json(Whoami { name: caller.name, role: caller.role })
}

/// `DELETE /api/session`: signs a person out, and removes the cookie of the session.
pub async fn sign_out(
    State(admission): State<Arc<Admission>>,
    ConnectInfo(ends): ConnectInfo<Ends>,
    Extension(ticket): Extension<Ticket>,
) -> Response {
    if let Ticket::Session(session) = &ticket {
        admission.sessions.end(session);
    }
    cookie("", Duration::ZERO, ends)
}

/// `GET /api/people`: lists all people with their roles.
pub async fn people(State(admission): State<Arc<Admission>>) -> Result<Json<Vec<AccountEntry>>, Refused> {
    let people = admission.accounts.read().map_err(failed)?.people;
    Ok(Json(people.into_iter().map(|(name, person)| AccountEntry { name, role: person.role }).collect()))
}

/// `GET /api/tokens`: lists all tokens without their text, with the roles that they were given.
pub async fn tokens(State(admission): State<Arc<Admission>>) -> Result<Json<Vec<AccountEntry>>, Refused> {
    let tokens = admission.accounts.read().map_err(failed)?.tokens;
    Ok(Json(tokens.into_iter().map(|(name, token)| AccountEntry { name, role: token.role }).collect()))
}

/// `POST /api/tokens`: makes a token. Only this answer holds the text of the token.
pub async fn make_token(
    State(admission): State<Arc<Admission>>,
    Extension(ticket): Extension<Ticket>,
    Json(AccountEntry { name, role }): Json<AccountEntry>,
) -> Result<Response, Refused> {
    check_name(&name).map_err(|line| refuse(StatusCode::UNPROCESSABLE_ENTITY, &line))?;
    let (text, hash) = Secret::fresh().map_err(failed)?;
    let maker = admission.person(&ticket);
    let made = admission.accounts.change(|list| {
        let is_new = !list.tokens.contains_key(&name);
        if is_new {
            list.tokens.insert(name.clone(), ApiToken { role, hash, maker });
        }
        Ok(is_new)
    });
    if !made.map_err(failed)? {
        let line = format!("There is a token {name}: revoke it first, or choose another name.");
        return Err(refuse(StatusCode::CONFLICT, &line));
    }
    let token = MadeToken { name, role, token: text };
    Ok(([(header::CACHE_CONTROL, "no-store")], Json(token)).into_response())
}

/// `DELETE /api/tokens/{name}`: revokes a token.
pub async fn revoke_token(
    State(admission): State<Arc<Admission>>,
    Path(name): Path<String>,
) -> Result<StatusCode, Refused> {
    let removed = admission.accounts.change(|list| Ok(list.tokens.remove(&name).is_some()));
    if removed.map_err(failed)? {
        return Ok(StatusCode::NO_CONTENT);
    }
    Err(refuse(StatusCode::NOT_FOUND, &format!("There is no token {name}.")))
}

fn failed(line: String) -> Refused {
    refuse(StatusCode::INTERNAL_SERVER_ERROR, &line)
}

fn cookie(token: &str, lasts: Duration, ends: Ends) -> Response {
    let seconds = lasts.as_secs();
    // With `Secure`, browsers take and send the cookie over TLS only.
    let secure = if ends.is_secure { "; Secure" } else { "" };
    let value = format!("{COOKIE}={token}; Path=/; HttpOnly; SameSite=Strict{secure}; Max-Age={seconds}");
    ([(header::SET_COOKIE, value)], StatusCode::NO_CONTENT).into_response()
}

fn wrong(left: TriesLeft) -> String {
    let pause = in_words(left.pause);
    match left.tries {
        0 => format!("Name or password is wrong. Try again in {pause}."),
        tries => {
            let numbers = ["No", "One", "Two", "Three", "Four"];
            let number = numbers.get(tries as usize).copied().unwrap_or("Some");
            let noun = if tries == 1 { "try" } else { "tries" };
            format!("Name or password is wrong. {number} more {noun}, then a pause of {pause}.")
        }
    }
}

/// Returns a time in words for people, rounded up.
fn in_words(time: Duration) -> String {
    match time.as_secs_f64().ceil() as u64 {
        0..=1 => "one second".into(),
        seconds @ 2..60 => format!("{seconds} seconds"),
        60 => "one minute".into(),
        seconds => format!("{} minutes", seconds.div_ceil(60)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_password_says_what_is_left() {
        let line = |tries, seconds| wrong(TriesLeft { tries, pause: Duration::from_secs(seconds) });
        assert_eq!(line(2, 60), "Name or password is wrong. Two more tries, then a pause of one minute.");
        assert_eq!(line(1, 120), "Name or password is wrong. One more try, then a pause of 2 minutes.");
        assert_eq!(line(0, 60), "Name or password is wrong. Try again in one minute.");
    }
}
