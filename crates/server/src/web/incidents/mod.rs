//! What went wrong, as cards: one cause is one card, which grows while more robots have the same trouble.

mod words;

use std::sync::{Arc, Mutex, PoisonError};

use axum::extract::ws::Utf8Bytes;
use lightbots_api::{Incident, IncidentTone, Incidents, ToScreen};
use lightbots_base::RobotId;
use lightbots_control::{EventKind, RunOutcome, Trouble};
use tokio::sync::{broadcast, watch};

use super::socket::text;
use crate::live::clock::unix_ms;
use crate::live::conductor::News;
use words::Card;

/// Incidents that are kept. A screen shows the unread ones; older ones are dropped, read ones first.
const KEPT: usize = 40;
/// Names that an incident keeps.
const NAMED: usize = 50;
/// Robots that drop out for one reason within this time of each other, milliseconds, are one incident.
const TOGETHER_MS: u64 = 4_000;

/// What an incident is about. Events with the same subject change the same incident.
#[derive(Clone, Debug, PartialEq)]
enum Subject {
    Dropouts { why: Trouble, frame: Option<usize> },
    Link,
    Broker,
    Names(RobotId),
    Flood(RobotId),
    Fleet,
    Plan(usize),
    Controller,
    Run,
    Place(RobotId),
}

#[derive(Debug)]
struct Entry {
    subject: Subject,
    incident: Incident,
    /// All its robots, not only those that the card names.
    robots: Vec<RobotId>,
    last_ms: u64,
}

#[derive(Debug, Default)]
struct Book {
    entries: Vec<Entry>,
    last_id: u32,
    /// The frame that is to be reached or stands, counted from 0.
    frame: Option<usize>,
}

/// The incidents that every screen shows. Clones share them.
#[derive(Clone, Debug)]
pub struct IncidentBoard {
    book: Arc<Mutex<Book>>,
    message: watch::Sender<Utf8Bytes>,
}

impl IncidentBoard {
    /// No incidents.
    pub fn new() -> Self {
        let message = text(&ToScreen::Incidents(Incidents::default()));
        Self { book: Arc::default(), message: watch::channel(message).0 }
    }

    /// The message with all incidents, and each later one.
    pub fn watch(&self) -> watch::Receiver<Utf8Bytes> {
        self.message.subscribe()
    }

    /// The operator has read an incident.
    pub fn read(&self, id: u32) {
        self.change(|book| {
            let entry = book.entries.iter_mut().find(|entry| entry.incident.id == id && !entry.incident.read);
            entry.map(|entry| entry.incident.read = true).is_some()
        });
    }

    /// Notes the conductor's events until it ends.
    pub async fn follow(self, mut news: broadcast::Receiver<News>) {
        loop {
            match news.recv().await {
                Ok(News::Event(event)) => self.change(|book| book.note(&event.kind, unix_ms())),
                Ok(_) | Err(broadcast::error::RecvError::Lagged(_)) => {}
                Err(broadcast::error::RecvError::Closed) => return,
            }
        }
    }

    /// Changes the book; if that changed anything, screens are told.
    fn change(&self, act: impl FnOnce(&mut Book) -> bool) {
        let mut book = self.book.lock().unwrap_or_else(PoisonError::into_inner);
        if act(&mut book) {
            let list = book.entries.iter().map(|entry| entry.incident.clone()).collect();
            self.message.send_replace(text(&ToScreen::Incidents(Incidents { list })));
        }
    }
}

impl Book {
    /// Notes an event; whether that changed an incident.
    fn note(&mut self, kind: &EventKind, now_ms: u64) -> bool {
        use EventKind as E;
        match kind {
            E::TransitionStarted { frame, .. } | E::FrameReached { frame, .. } => {
                self.frame = Some(*frame);
                false
            }
            E::RunBegun { .. } => {
                self.frame = None;
                self.end(|subject| matches!(subject, Subject::Plan(_) | Subject::Run | Subject::Controller))
            }
            E::Dropout { robot, why } => {
                self.drop_out(*robot, *why, now_ms);
                true
            }
            E::Rejoined(robot) => self.rejoin(*robot),
            E::LinkBack { asks_operator: false, .. } => self.end(|subject| *subject == Subject::Link),
            E::Connected => self.end(|subject| *subject == Subject::Broker),
            E::NameUnique(robot) => self.end(|subject| *subject == Subject::Names(*robot)),
            _ => match card_of(kind) {
                Some((subject, tone, card, robots)) => {
                    self.open(subject, tone, card, robots, now_ms);
                    true
                }
                None => false,
            },
        }
    }

    fn drop_out(&mut self, robot: RobotId, why: Trouble, now_ms: u64) {
        let subject = Subject::Dropouts { why, frame: self.frame };
        let known = self.entries.iter_mut().rev().find(|entry| {
            entry.subject == subject && !entry.incident.read && now_ms - entry.last_ms < TOGETHER_MS
        });
        let Some(entry) = known else {
            let names = [robot.to_string()];
            let card = words::dropped(why, &names, 1, self.frame);
            return self.open(subject, IncidentTone::Look, card, vec![robot], now_ms);
        };
        entry.robots.push(robot);
        entry.last_ms = now_ms;
        let incident = &mut entry.incident;
        incident.count = entry.robots.len();
        if incident.robots.len() < NAMED {
            incident.robots.push(robot.to_string());
        }
        let card = words::dropped(why, &incident.robots, incident.count, self.frame);
        (incident.title, incident.done, incident.advice) = (card.title, card.done, card.advice);
    }

    /// A robot takes part again: the incident is over once that holds for all of its robots.
    fn rejoin(&mut self, robot: RobotId) -> bool {
        let mut changed = false;
        for entry in &mut self.entries {
            let before = entry.robots.len();
            if matches!(entry.subject, Subject::Dropouts { .. }) {
                entry.robots.retain(|one| *one != robot);
            }
            if entry.robots.is_empty() && before > 0 {
                entry.incident.over = true;
                changed = true;
            }
        }
        changed
    }

    fn end(&mut self, of: impl Fn(&Subject) -> bool) -> bool {
        let mut changed = false;
        for entry in self.entries.iter_mut().filter(|entry| of(&entry.subject) && !entry.incident.over) {
            entry.incident.over = true;
            changed = true;
        }
        changed
    }

    /// A new incident, or a new state of one that holds.
    fn open(&mut self, subject: Subject, tone: IncidentTone, card: Card, robots: Vec<RobotId>, now_ms: u64) {
        let Card { title, done, advice } = card;
        let holds = |entry: &&mut Entry| entry.subject == subject && !entry.incident.over;
        let is_new = matches!(subject, Subject::Dropouts { .. });
        if let Some(entry) = self.entries.iter_mut().find(holds).filter(|_| !is_new) {
            let incident = &mut entry.incident;
            (incident.tone, incident.title, incident.done, incident.advice) = (tone, title, done, advice);
            (incident.read, entry.last_ms) = (false, now_ms);
            return;
        }
        self.make_room();
        self.last_id = self.last_id.wrapping_add(1);
        let names = robots.iter().map(RobotId::to_string).collect();
        let incident = Incident {
            id: self.last_id,
            time_ms: now_ms,
            tone,
            title,
            done,
            advice,
            robots: names,
            count: robots.len(),
            over: false,
            read: false,
        };
        self.entries.push(Entry { subject, incident, robots, last_ms: now_ms });
    }

    fn make_room(&mut self) {
        if self.entries.len() == KEPT {
            let oldest_read = self.entries.iter().position(|entry| entry.incident.read);
            self.entries.remove(oldest_read.unwrap_or(0));
        }
    }
}

/// The card of an event that is one by itself.
fn card_of(kind: &EventKind) -> Option<(Subject, IncidentTone, Card, Vec<RobotId>)> {
    use EventKind as E;
    use IncidentTone::{Failed, Information, Look};
    let none = Vec::new;
    Some(match kind {
        E::Disconnected => {
            let done = "Robots on a route stop by themselves within 2 s. LightBots connects again by itself.";
            let advice = "Look whether the broker runs and the network is up. If robots must stop now, use their power switch.";
            (Subject::Broker, Failed, Card::new("The broker is lost.", done, advice), none())
        }
        E::LinkLost { silent, robots } => {
            let title =
                format!("{silent} of {robots} robots fell silent at once: this is the link, not the robots.");
            let done =
                "The show stands still until they report again, and then goes on from where they stand.";
            let advice =
                "Look at the access point and the broker. Keep people off the floor: robots may move again.";
            (Subject::Link, Look, Card::new(title, done, advice), none())
        }
        E::LinkBack { reported, robots, asks_operator: true, .. } => {
            let title = format!("{reported} of {robots} robots report again, and the show waits for you.");
            let done = "It was cut off for so long that it does not go on by itself.";
            (Subject::Link, Look, Card::new(title, done, "Look at the floor, then press Go on."), none())
        }
        E::Undelivered => {
            let title =
                "Robots report, but none acknowledges its route: the broker delivers nothing to them.";
            let advice = "Look at the broker's access rules for T/LightBot and the robots' logins.";
            (Subject::Link, Failed, Card::new(title, "The show waits.", advice), none())
        }
        E::TakenUp { frame, robots, away, goes_on } => {
            let title =
                format!("LightBots was down for {:.0} s on the way to frame {}.", away.as_secs(), frame + 1);
            let done = if *goes_on {
                format!("It asks {robots} robots where they stand, and goes on with the show.")
            } else {
                format!("It told {robots} robots to stop, and ended the run.")
            };
            let advice = "Look at the floor. Read the log of the machine if this happens again.";
            (Subject::Controller, Information, Card::new(title, &done, advice), none())
        }
        E::NameShared { robot, .. } => {
            let title = format!("Two robots are called {robot}.");
            let done = "Both are kept out of the show.";
            let card = Card::new(title, done, "Switch one of them off, or give it another name.");
            (Subject::Names(*robot), Look, card, vec![*robot])
        }
        E::Flooding(robot) => {
            let title =
                format!("{} floods the broker with messages.", words::subject(&[robot.to_string()], 1));
            let done = "Only 100 of its messages a second count.";
            let card =
                Card::new(title, done, "Switch it off, and on again if its firmware is as it should be.");
            (Subject::Flood(*robot), Look, card, vec![*robot])
        }
        E::FleetFull => {
            let card = Card::new(
                "There are more names than can be remembered.",
                "Further robots are not listed.",
                "Look whether a program makes up names; restart LightBots afterwards.",
            );
            (Subject::Fleet, Look, card, none())
        }
        E::Misaligned { robot, off_m } => {
            let title = format!(
                "{} stands {:.0} mm off its place.",
                words::subject(&[robot.to_string()], 1),
                off_m * 1_000.0
            );
            let card =
                Card::new(title, "", "Look whether wheels slip, or the positioning system is off there.");
            (Subject::Place(*robot), Information, card, vec![*robot])
        }
        E::PlanFailed { frame, message } => {
            let title = format!("There is no collision-free way to frame {}.", frame + 1);
            (
                Subject::Plan(*frame),
                Look,
                Card::new(title, message, "Take robots out of the way, or skip the frame."),
                none(),
            )
        }
        E::RunEnded { outcome: RunOutcome::Failed(line), frames_played, .. } => {
            let done = format!("The run ended after {frames_played} frames. Robots stand.");
            let advice = "Look at the floor. Play on from the frame, or drive home.";
            (Subject::Run, Failed, Card::new(format!("{line}."), &done, advice), none())
        }
        _ => return None,
    })
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
