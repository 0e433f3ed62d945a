//! The WebSocket of one screen.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

use axum::Extension;
use axum::extract::State;
use axum::extract::ws::{Message, Utf8Bytes, WebSocket, WebSocketUpgrade};
use axum::response::Response;
use lightbots_api::{Answer, FromScreen, Hello, ToScreen, plan_summary};
use tokio::sync::broadcast::error::RecvError;

use super::access;
use super::admission::{Caller, Ticket, not_allowed};
use super::message::text;
use super::operate::{self, operate};
use super::picture::Picture;
use super::scheme::Scheme;
use super::state::Shared;

/// Longest time to send one message. A screen that takes longer is disconnected; its page connects again by itself.
const PATIENCE: Duration = Duration::from_secs(20);
/// Most pictures that a screen has not acknowledged: one is on its way while the screen draws another. With 1, a screen
/// would idle for a round trip; with more, a slow screen would lag behind.
const AHEAD: usize = 2;
/// Time between two checks that the session or token of a screen is still valid. It bounds how long a screen sees the
/// show after its sign-out. Operations are checked one by one.
const CHECK_EVERY: Duration = Duration::from_secs(1);

/// `/ws`: opens the WebSocket of a screen and serves it.
pub async fn open(
    State(shared): State<Arc<Shared>>,
    Extension(ticket): Extension<Ticket>,
    upgrade: WebSocketUpgrade,
) -> Response {
    upgrade.max_message_size(operate::LONGEST).max_frame_size(operate::LONGEST).on_upgrade(
        move |socket| async move {
            let mut screen = Screen { socket, shared, ticket, ahead: 0 };
            // A screen that disconnects is a normal event.
            let _ = screen.serve().await;
        },
    )
}

/// The connection ends: the screen has gone, is too slow, is no longer signed in, or sent a message that cannot be read. It
/// also ends if the server ends.
struct Gone;

struct Screen {
    socket: WebSocket,
    shared: Arc<Shared>,
    /// The session or token with which the screen was admitted.
    ticket: Ticket,
    /// Number of pictures that the screen has not acknowledged.
    ahead: usize,
}

impl Screen {
    async fn serve(&mut self) -> Result<(), Gone> {
        let shared = self.shared.clone();
        let (mut shown, mut plan) = (shared.desk.watch(), shared.desk.watch_plan());
        let (mut states, mut fleets) = (shared.pictures.states(), shared.pictures.fleets());
        let (lines, mut log) = shared.log.read();
        let mut incidents = shared.incidents.watch();
        self.greet().await?;
        let message = shown.borrow_and_update().message.clone();
        self.send(message).await?;
        let summary = plan_summary(&plan.borrow_and_update());
        self.send(text(&ToScreen::Plan(summary))).await?;
        let message = incidents.borrow_and_update().clone();
        self.send(message).await?;
        for line in lines {
            self.send(text(&ToScreen::Log(line))).await?;
        }
        let mut checks = tokio::time::interval(CHECK_EVERY);
        loop {
            tokio::select! {
                biased;
                _ = checks.tick() => {
                    self.caller()?;
                }
                received = self.socket.recv() => self.handle(received).await?,
                Ok(()) = shown.changed() => {
                    let message = shown.borrow_and_update().message.clone();
                    self.send(message).await?;
                }
                Ok(()) = plan.changed() => {
                    let summary = plan_summary(&plan.borrow_and_update());
                    self.send(text(&ToScreen::Plan(summary))).await?;
                }
                Ok(()) = fleets.changed(), if self.ahead < AHEAD => {
                    let message = fleets.borrow_and_update().clone();
                    self.send(message).await?;
                }
                Ok(()) = incidents.changed() => {
                    let message = incidents.borrow_and_update().clone();
                    self.send(message).await?;
                }
                line = log.recv() => match line {
                    Ok(line) => self.send(text(&ToScreen::Log(line))).await?,
                    Err(RecvError::Lagged(_)) => {}
                    Err(RecvError::Closed) => return Err(Gone),
                },
                Ok(()) = states.changed(), if self.ahead < AHEAD => {
                    let picture = states.borrow_and_update().clone();
                    self.show(picture).await?;
                }
            }
        }
    }

    async fn greet(&mut self) -> Result<(), Gone> {
        let screen = self.shared.screens.fetch_add(1, Ordering::Relaxed);
        let version = env!("CARGO_PKG_VERSION").to_owned();
        let simulated = self.shared.simulated.load(Ordering::Relaxed);
        let names = &self.shared.names;
        let plain_http = names.is_open() && names.scheme() == Scheme::Http;
        self.send(text(&ToScreen::Hello(Hello { version, screen, simulated, plain_http }))).await
    }

    /// Carries out the request of a message. A message that cannot be read ends the connection.
    async fn handle(&mut self, received: Option<Result<Message, axum::Error>>) -> Result<(), Gone> {
        let message = match received {
            Some(Ok(Message::Text(text))) => text,
            Some(Ok(Message::Ping(_) | Message::Pong(_))) => return Ok(()),
            _ => return Err(Gone),
        };
        let wish = serde_json::from_str(&message).map_err(|error| {
            tracing::debug!("a message of a screen cannot be read: {error}");
            Gone
        })?;
        match wish {
            FromScreen::Operate(request) => {
                let (caller, needed) = (self.caller()?, access::of_operation(&request.operation));
                let answer = if caller.role < needed {
                    let error = Some(not_allowed(needed, caller.role));
                    Answer { id: request.id, ok: false, error, choice: None }
                } else {
                    operate(&self.shared, request).await
                };
                self.send(text(&ToScreen::Answer(answer))).await
            }
            FromScreen::Took => {
                self.ahead = self.ahead.saturating_sub(1);
                Ok(())
            }
        }
    }

    /// Returns the person or program at this screen. `Err` if the session or token is no longer valid, which ends the
    /// connection.
    fn caller(&self) -> Result<Caller, Gone> {
        self.shared.admission.caller(&self.ticket).ok_or(Gone)
    }

    async fn show(&mut self, picture: Picture) -> Result<(), Gone> {
        self.ahead += 1;
        self.give(Message::Binary(picture.robots)).await?;
        self.send(picture.state).await
    }

    async fn send(&mut self, message: Utf8Bytes) -> Result<(), Gone> {
        self.give(Message::Text(message)).await
    }

    async fn give(&mut self, message: Message) -> Result<(), Gone> {
        match tokio::time::timeout(PATIENCE, self.socket.send(message)).await {
            Ok(Ok(())) => Ok(()),
            _ => Err(Gone),
        }
    }
}
