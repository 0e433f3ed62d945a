//! Incidents: what went wrong, as cards for people. One cause makes one card, which grows while more robots have the
//! same trouble.

mod cards;
mod subject;
mod words;

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

use axum::extract::ws::Utf8Bytes;
use lightbots_api::{Incident, IncidentTone, Incidents, ToScreen};
use lightbots_base::RobotId;
use lightbots_control::{EventKind, Trouble};
use tokio::sync::{broadcast, watch};

use super::message::text;
use crate::live::clock::unix_ms;
use crate::live::conductor::News;
use cards::card_of;
use subject::Subject;
use words::Card;

/// Most incidents that are kept. A screen shows the unread ones. If there are too many, the oldest read one is dropped, or
/// the oldest of all if none was read.
const KEPT: usize = 40;
/// Most robot names that an incident keeps.
const NAMED: usize = 50;
/// Robots that drop out for the same reason in the same frame make one incident if each follows the one before within this
/// time, milliseconds. An incident that the operator has read gets no further robots.
const TOGETHER_MS: u64 = 4_000;

#[derive(Debug)]
struct Entry {
    subject: Subject,
    incident: Incident,
    /// All robots of the incident, not only those that the card names.
    robots: BTreeSet<RobotId>,
    /// The robots of the incident that still have the trouble.
    affected: BTreeSet<RobotId>,
    last_ms: u64,
}

#[derive(Debug, Default)]
struct Book {
    entries: Vec<Entry>,
    last_id: u32,
    /// The frame that robots drive to or have reached, counted from 0.
    frame: Option<usize>,
}

/// The incidents that every screen shows. Clones share them.
#[derive(Clone, Debug)]
pub struct IncidentBoard {
    book: Arc<Mutex<Book>>,
    message: watch::Sender<Utf8Bytes>,
}

impl IncidentBoard {
    /// A board without incidents.
    pub fn new() -> Self {
        let message = text(&ToScreen::Incidents(Incidents::default()));
        Self { book: Arc::default(), message: watch::channel(message).0 }
    }

    /// Returns a receiver of the message with all incidents. Each change of the incidents gives a new message.
    pub fn watch(&self) -> watch::Receiver<Utf8Bytes> {
        self.message.subscribe()
    }

    /// Marks an incident as read by the operator.
    pub fn read(&self, id: u32) {
        self.change(|book| {
            let entry = book.entries.iter_mut().find(|entry| entry.incident.id == id && !entry.incident.read);
            entry.map(|entry| entry.incident.read = true).is_some()
        });
    }

    /// Notes that robots no longer want to join, because they were put on the list of robots that take part.
    pub fn joined(&self, robots: &[RobotId]) {
        self.change(|book| {
            let mut changed = false;
            for robot in robots {
                changed |= book.leave(*robot, |subject| *subject == Subject::Joining);
            }
            changed
        });
    }

    /// Opens an incident: an entry of the playlist was not played, or not to its end. `why` is a line for people.
    pub fn playlist_failed(&self, entry: u32, title: &str, why: &str) {
        self.change(|book| {
            let card = Card::new(title, why, "The playlist goes on with the next show.");
            book.open(Subject::Playlist(entry), IncidentTone::Look, card, Vec::new(), unix_ms());
            true
        });
    }

    /// Ends the incident of a playlist entry, because the entry is played after all.
    pub fn playlist_goes_on(&self, entry: u32) {
        self.change(|book| book.end(|subject| *subject == Subject::Playlist(entry)));
    }

    /// Updates incidents by the conductor's events until the conductor ends.
    pub async fn follow(self, mut news: broadcast::Receiver<News>) {
        loop {
            match news.recv().await {
                Ok(News::Event(event)) => self.change(|book| book.note(&event.kind, unix_ms())),
                Ok(_) | Err(broadcast::error::RecvError::Lagged(_)) => {}
                Err(broadcast::error::RecvError::Closed) => return,
            }
        }
    }

    /// Changes the book. If `act` returns true, screens get the new incidents.
    fn change(&self, act: impl FnOnce(&mut Book) -> bool) {
        let mut book = self.book.lock().unwrap_or_else(PoisonError::into_inner);
        if act(&mut book) {
            let list = book.entries.iter().map(|entry| entry.incident.clone()).collect();
            self.message.send_replace(text(&ToScreen::Incidents(Incidents { list })));
        }
    }
}

impl Entry {
    /// Adds a robot to the incident, which then is not over. A robot that was in it before is named and counted once.
    fn grow(&mut self, robot: RobotId, now_ms: u64) {
        self.affected.insert(robot);
        (self.last_ms, self.incident.over) = (now_ms, false);
        let is_new = self.robots.insert(robot);
        self.incident.count = self.robots.len();
        if is_new && self.incident.robots.len() < NAMED {
            self.incident.robots.push(robot.to_string());
        }
    }
}

impl Book {
    /// Updates the incidents by an event. Returns whether an incident has changed.
    fn note(&mut self, kind: &EventKind, now_ms: u64) -> bool {
        use EventKind as E;
        match kind {
            E::TransitionStarted { frame, .. } | E::FrameReached { frame, .. } => {
                self.frame = Some(*frame);
                false
            }
            E::RunBegun { .. } => {
                self.frame = None;
                self.end(|subject| {
                    matches!(subject, Subject::Plan(_) | Subject::Run | Subject::Controller | Subject::Music)
                })
            }
            E::Dropout { robot, why } => {
                self.drop_out(*robot, *why, now_ms);
                true
            }
            E::WantsToJoin(robot) => {
                self.want_to_join(*robot, now_ms);
                true
            }
            E::Rejoined(robot) => self.leave(*robot, |subject| matches!(subject, Subject::Dropouts { .. })),
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
        entry.grow(robot, now_ms);
        let incident = &mut entry.incident;
        let card = words::dropped(why, &incident.robots, incident.count, self.frame);
        (incident.title, incident.done, incident.advice) = (card.title, card.done, card.advice);
    }

    /// Notes that a robot no longer has the trouble of the incidents whose subject `of` accepts. An incident without an
    /// affected robot is over. Returns whether an incident is over because of this call. The card still names and counts the
    /// robot, because it says what happened.
    fn leave(&mut self, robot: RobotId, of: impl Fn(&Subject) -> bool) -> bool {
        let mut changed = false;
        for entry in self.entries.iter_mut().filter(|entry| of(&entry.subject)) {
            if entry.affected.remove(&robot) && entry.affected.is_empty() {
                entry.incident.over = true;
                changed = true;
            }
        }
        changed
    }

    /// Notes that a robot wants to join. All robots that want to join share one incident, until the operator has read it or
    /// all of them have joined.
    fn want_to_join(&mut self, robot: RobotId, now_ms: u64) {
        let holds = |entry: &&mut Entry| {
            entry.subject == Subject::Joining && !entry.incident.over && !entry.incident.read
        };
        let Some(entry) = self.entries.iter_mut().find(holds) else {
            let card = words::joining(&[robot.to_string()], 1);
            self.open(Subject::Joining, IncidentTone::Information, card, vec![robot], now_ms);
            return;
        };
        entry.grow(robot, now_ms);
        let incident = &mut entry.incident;
        incident.title = words::joining(&incident.robots, incident.count).title;
    }

    fn end(&mut self, of: impl Fn(&Subject) -> bool) -> bool {
        let mut changed = false;
        for entry in self.entries.iter_mut().filter(|entry| of(&entry.subject) && !entry.incident.over) {
            entry.incident.over = true;
            changed = true;
        }
        changed
    }

    /// Opens an incident. If an incident with the same subject is not over, that incident gets the new card instead and
    /// becomes unread. Dropouts and wishes to join always open another incident.
    fn open(&mut self, subject: Subject, tone: IncidentTone, card: Card, robots: Vec<RobotId>, now_ms: u64) {
        let Card { title, done, advice } = card;
        let holds = |entry: &&mut Entry| entry.subject == subject && !entry.incident.over;
        let is_new = matches!(subject, Subject::Dropouts { .. } | Subject::Joining);
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
            wants_to_join: subject == Subject::Joining,
            over: false,
            read: false,
        };
        let robots = BTreeSet::from_iter(robots);
        self.entries.push(Entry { subject, incident, affected: robots.clone(), robots, last_ms: now_ms });
    }

    fn make_room(&mut self) {
        if self.entries.len() == KEPT {
            let oldest_read = self.entries.iter().position(|entry| entry.incident.read);
            self.entries.remove(oldest_read.unwrap_or(0));
        }
    }
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
