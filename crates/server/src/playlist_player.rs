//! The task that plays the playlist, by the same operations that a person uses.

use std::sync::Arc;
use std::time::Duration;

use chrono::Local;
use lightbots_api::{Level, Missing, Operation, Request, Severity};
use lightbots_control::{ControllerState, EventKind, RunOutcome, Snapshot};
use tokio::sync::broadcast::{self, error::RecvError, error::TryRecvError};
use tokio::time::MissedTickBehavior;

use crate::live::conductor::News;
use crate::playlist::{PlaylistAct, PlaylistTurn, TurnEnd, TurnKey, clock_text, now_s};
use crate::sentences::sentence;
use crate::stop::Stop;
use crate::web::{Shared, operate};

/// Time between two checks of the playlist.
const LOOK_EVERY: Duration = Duration::from_secs(1);
/// A turn without a run at this number of consecutive checks counts as over, although no event ended it. At the first check,
/// the event may still be on its way.
const LOOKS_WITHOUT_RUN: u32 = 3;
/// Most turns that are skipped in one check. Each pass of the check skips one entry whose time is past.
const ACTS_MAX: usize = 200;

/// Why a turn waits whose show is not planned.
const NOT_PLANNED: &str = "its plan is not made yet: give the planner more time";

/// A turn that is about to begin.
#[derive(Debug)]
struct Attempt {
    key: TurnKey,
    /// Revision of the show that this attempt opened; `None` if it has not opened the show yet.
    revision: Option<u32>,
    /// Why the turn could not begin, as the latest check that found a reason says. `None` if no check found one.
    refusal: Option<String>,
}

#[derive(Debug)]
struct Player {
    shared: Arc<Shared>,
    stop: Stop,
    attempt: Option<Attempt>,
    /// The operator's speed (percent) and loop setting, to be restored after a show of the playlist. `None`: nothing is to
    /// be restored.
    settings: Option<(u32, bool)>,
    /// Whether the present turn has a run: this player began the run, or found it when the program started.
    is_playing: bool,
    looks_without_run: u32,
}

/// Plays shows by schedule until the program stops.
pub async fn play(shared: Arc<Shared>, stop: Stop) {
    let mut news = shared.handle.news();
    let mut looks = tokio::time::interval(LOOK_EVERY);
    looks.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let ends = stop.clone();
    let mut player =
        Player { shared, stop, attempt: None, settings: None, is_playing: false, looks_without_run: 0 };
    player.find_run().await;
    loop {
        tokio::select! {
            biased;
            () = ends.wait() => return,
            _ = looks.tick() => player.look(&mut news).await,
            heard = news.recv() => match heard {
                Ok(news) => player.hear(&news),
                Err(RecvError::Lagged(_)) => {}
                Err(RecvError::Closed) => return,
            },
        }
    }
}

impl Player {
    /// Handles a turn that was playing when the program ended. Its run continues, or the turn has failed.
    async fn find_run(&mut self) {
        let Some(key) = self.shared.playlist.playing() else { return };
        let Some(snapshot) = self.shared.handle.look().await else { return };
        self.is_playing = snapshot.run.is_some();
        if !self.is_playing {
            let line = "LightBots was ended while it played: look at the log of the machine";
            self.end(key, TurnEnd::Failed(line.into()));
        }
    }

    /// Handles an event: records how the run of a turn ends, and holds the playlist if a person stopped the robots or
    /// ended that run.
    fn hear(&mut self, news: &News) {
        let News::Event(event) = news else { return };
        // The end of the program stops robots too, and must not hold the playlist.
        if self.stop.is_wanted() {
            return;
        }
        match &event.kind {
            EventKind::StoppedAll => self.hold("Stop all was pressed"),
            EventKind::RunEnded { outcome, .. } if self.is_playing => {
                let Some(key) = self.shared.playlist.playing() else { return };
                match outcome {
                    RunOutcome::Finished => self.end(key, TurnEnd::Played),
                    RunOutcome::Failed(line) => {
                        self.end(key, TurnEnd::Failed(format!("{line}: look at the floor")))
                    }
                    RunOutcome::Aborted => {
                        self.hold("the show was ended by a person");
                        self.end(
                            key,
                            TurnEnd::Failed("a person ended it: press Go on for the next show".into()),
                        );
                    }
                }
            }
            _ => {}
        }
    }

    fn hold(&self, why: &str) {
        let time = clock_text(&Local, now_s());
        let line = format!("At {time} {why}: no show starts by schedule until you press Go on.");
        if self.shared.playlist.hold(&line) {
            self.shared.log.say(Level::Warn, format!("Playlist held. {line}"));
        }
    }

    async fn look(&mut self, news: &mut broadcast::Receiver<News>) {
        if !self.shared.playlist.is_on() && self.settings.is_none() {
            // A snapshot costs time in proportion to the fleet.
            return self.attempt = None;
        }
        let Some(snapshot) = self.shared.handle.look().await else { return };
        if self.shared.playlist.playing().is_some() {
            return self.watch(&snapshot);
        }
        let is_free = matches!(snapshot.state, ControllerState::Ready | ControllerState::Idle);
        if is_free {
            self.restore_settings().await;
        }
        for _ in 0..ACTS_MAX {
            match self.shared.playlist.next_act(is_free) {
                PlaylistAct::Nothing => return self.attempt = None,
                PlaylistAct::Home(key) => return self.drive_home(key).await,
                PlaylistAct::Play(key, _) => return self.begin(key, &snapshot, news).await,
                PlaylistAct::Skip(key, at_s) => self.skip(key, at_s, is_free),
            }
        }
    }

    /// Ends the turn that is playing as failed, if at `LOOKS_WITHOUT_RUN` consecutive checks it had no run. Its end may
    /// have gone unnoticed, because events are lost if too many come at once.
    fn watch(&mut self, snapshot: &Snapshot) {
        self.looks_without_run = if snapshot.run.is_some() { 0 } else { self.looks_without_run + 1 };
        if self.looks_without_run < LOOKS_WITHOUT_RUN {
            return;
        }
        if let Some(key) = self.shared.playlist.playing() {
            let why = snapshot.failure.clone().unwrap_or_else(|| "its run is over".into());
            self.end(
                key,
                TurnEnd::Failed(format!("{}: look at the floor and the log", why.trim_end_matches('.'))),
            );
        }
    }

    async fn drive_home(&mut self, key: TurnKey) {
        self.shared.playlist.sent_home(key);
        match self.operate(Operation::Home).await {
            Ok(()) => self.shared.log.say(Level::Info, "Playlist: robots drive home for the pause."),
            Err(line) => {
                self.shared.log.say(Level::Warn, format!("Playlist: robots do not drive home. {line}"))
            }
        }
    }

    fn skip(&mut self, key: TurnKey, at_s: i64, is_free: bool) {
        let refusal =
            self.attempt.take().filter(|attempt| attempt.key == key).and_then(|attempt| attempt.refusal);
        let end = match refusal {
            Some(line) => TurnEnd::Failed(line),
            None if self.shared.playlist.is_held() => {
                TurnEnd::Skipped("the playlist was held: press Go on".into())
            }
            None if !is_free => TurnEnd::Skipped(
                "robots were still at something else: give shows more time between them".into(),
            ),
            None => TurnEnd::Skipped("its time was over before LightBots could play it".into()),
        };
        self.end_at(key, end, at_s);
    }

    /// Begins a turn, or records why it cannot begin yet. Ends the turn as failed if waiting would not help.
    async fn begin(&mut self, key: TurnKey, snapshot: &Snapshot, news: &mut broadcast::Receiver<News>) {
        let Some(turn) = self.shared.playlist.turn(key.id) else { return };
        if self.attempt.as_ref().is_none_or(|attempt| attempt.key != key) {
            self.attempt = Some(Attempt { key, revision: None, refusal: None });
        }
        match self.start(&turn, key, snapshot, news).await {
            Ok(()) => {
                if let Some(attempt) = &mut self.attempt {
                    attempt.refusal = None;
                }
            }
            Err(Refused::ForGood(line)) => {
                self.attempt = None;
                self.end(key, TurnEnd::Failed(line));
            }
            Err(Refused::ForNow(line)) => {
                if let Some(attempt) = &mut self.attempt {
                    attempt.refusal = Some(line);
                }
            }
        }
    }

    async fn start(
        &mut self,
        turn: &PlaylistTurn,
        key: TurnKey,
        snapshot: &Snapshot,
        news: &mut broadcast::Receiver<News>,
    ) -> Result<(), Refused> {
        if !snapshot.connected {
            return Err(Refused::ForNow("there is no broker: look at the broker's settings".into()));
        }
        let opened = self.attempt.as_ref().and_then(|attempt| attempt.revision);
        let shown = self.shared.desk.shown();
        if opened != Some(shown.revision) || shown.name.as_deref() != Some(&turn.show) {
            let opened = self.operate(Operation::Open { name: turn.show.clone() }).await;
            let remedy = "choose another show for the entry, or mend this one";
            opened.map_err(|line| Refused::ForGood(format!("{}: {remedy}", line.trim_end_matches('.'))))?;
            if let Some(attempt) = &mut self.attempt {
                attempt.revision = Some(self.shared.desk.shown().revision);
            }
            return Err(Refused::ForNow(NOT_PLANNED.into()));
        }
        let plan = self.shared.desk.plan();
        if plan.planning || plan.revision != shown.revision {
            return Err(Refused::ForNow(NOT_PLANNED.into()));
        }
        if let Some(issue) = plan.issues.iter().find(|issue| issue.severity == Severity::Error) {
            return Err(Refused::ForGood(format!("this show cannot be played: {}", issue.message)));
        }
        self.settings = Some((snapshot.speed_percent, snapshot.looping));
        let play = Operation::Play { from: 0, missing: Missing::Refuse };
        let speed = Operation::Speed { percent: turn.speed_percent };
        for operation in [speed, Operation::Loop { on: false }] {
            self.operate(operation).await.map_err(Refused::ForNow)?;
        }
        // Handles the waiting events first, because they belong to earlier runs.
        self.hear_waiting(news);
        if self.shared.playlist.is_held() {
            return Ok(());
        }
        self.operate(play).await.map_err(Refused::ForNow)?;
        (self.attempt, self.is_playing, self.looks_without_run) = (None, true, 0);
        self.shared.playlist.begins(key);
        self.shared.incidents.playlist_goes_on(key.id);
        self.shared.log.say(Level::Info, format!("Playlist: {} begins.", turn.show));
        Ok(())
    }

    fn hear_waiting(&mut self, news: &mut broadcast::Receiver<News>) {
        loop {
            match news.try_recv() {
                Ok(news) => self.hear(&news),
                Err(TryRecvError::Lagged(_)) => {}
                Err(TryRecvError::Empty | TryRecvError::Closed) => return,
            }
        }
    }

    fn end(&mut self, key: TurnKey, end: TurnEnd) {
        self.end_at(key, end, now_s());
    }

    fn end_at(&mut self, key: TurnKey, end: TurnEnd, at_s: i64) {
        (self.is_playing, self.looks_without_run) = (false, 0);
        let end = match end {
            TurnEnd::Played => TurnEnd::Played,
            TurnEnd::Failed(line) => TurnEnd::Failed(sentence(&line)),
            TurnEnd::Skipped(line) => TurnEnd::Skipped(sentence(&line)),
        };
        let show = self.shared.playlist.turn(key.id).map(|turn| turn.show).unwrap_or_default();
        let (log, incidents) = (&self.shared.log, &self.shared.incidents);
        match &end {
            TurnEnd::Played => log.say(Level::Info, format!("Playlist: {show} was played.")),
            TurnEnd::Failed(line) => {
                log.say(Level::Error, format!("Playlist: {show} failed. {line}"));
                incidents.playlist_failed(key.id, &format!("{show} failed by schedule."), line);
            }
            TurnEnd::Skipped(line) => {
                log.say(Level::Warn, format!("Playlist: {show} was skipped. {line}"));
                incidents.playlist_failed(key.id, &format!("{show} was skipped by schedule."), line);
            }
        }
        self.shared.playlist.ends(key, end, at_s);
    }

    /// Restores the operator's settings of speed and loop, if a show of the playlist changed them.
    async fn restore_settings(&mut self) {
        let Some((percent, on)) = self.settings.take() else { return };
        for operation in [Operation::Speed { percent }, Operation::Loop { on }] {
            if let Err(line) = self.operate(operation).await {
                self.shared
                    .log
                    .say(Level::Warn, format!("Playlist: speed and loop stay as they are. {line}"));
            }
        }
    }

    /// Runs an operation as a person does on the screen. The error is a line for people.
    async fn operate(&self, operation: Operation) -> Result<(), String> {
        let answer = operate(&self.shared, Request { id: 0, operation }).await;
        answer.error.map_or(Ok(()), Err)
    }
}

/// Why a turn does not begin, with a remedy.
enum Refused {
    /// The start is tried again until the turn is too late, because robots and broker may still come.
    ForNow(String),
    /// Waiting would change nothing.
    ForGood(String),
}
