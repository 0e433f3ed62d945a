//! Shows that were played to their end, kept in a file of the data folder. A screen offers other shows at half speed.

use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbots_control::{Age, Event, EventKind, RobotView, RunOutcome};
use serde::{Deserialize, Serialize};
use tokio::sync::broadcast;

use crate::disk::{self, Readers};
use crate::json_file;
use crate::live::conductor::{Handle, News};
use crate::web::Desk;

/// Name of the file in the data folder.
const FILE: &str = "played.json";
/// Most shows that are kept. If there are more, the one that was entered first is forgotten. An entry has about 100 bytes.
const SHOWS_MAX: usize = 1_000;
/// Longest file that is read, bytes. A longer one cannot be used; see [`json_file::load`].
const FILE_MAX: u64 = 1 << 20;

/// The shows that were played to their end. Clones share them.
#[derive(Clone, Debug)]
pub struct PlayedShows {
    path: PathBuf,
    kept: Arc<Mutex<Kept>>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
struct Kept {
    /// Shows in the order in which they were first played to their end.
    #[serde(default)]
    shows: VecDeque<Entry>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
struct Entry {
    /// Name of the show, for people.
    show: String,
    #[serde(flatten)]
    played: Played,
}

/// A show and the kind of robots that play it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Played {
    /// Hash of all that robots' drives depend on, and of the names of frames. A show that differs only in the show's name or
    /// in colours has the same hash.
    drives: u64,
    /// Whether real robots report on the broker.
    real: bool,
}

impl Played {
    /// Combines a show, by its `show_plan::drives_hash`, with the kind of robots that report on the broker. A show that
    /// only simulated robots have played counts as not played if a real robot reports.
    pub fn of(drives: u64, robots: &[RobotView]) -> Self {
        Self { drives, real: has_real(robots) }
    }
}

fn has_real(robots: &[RobotView]) -> bool {
    robots.iter().any(|robot| robot.contact.age == Age::Active && !robot.reported.simulated)
}

impl PlayedShows {
    /// Reads the file in the data folder. If the file is missing or cannot be used, the list is empty, so that all shows are
    /// offered at half speed; see [`json_file::load`].
    pub fn load(folder: &Path) -> Self {
        let path = folder.join(FILE);
        let kept: Kept = json_file::load(&path, FILE_MAX);
        Self { path, kept: Arc::new(Mutex::new(kept)) }
    }

    /// Whether robots of this kind have played the show to its end.
    pub fn has(&self, played: Played) -> bool {
        self.lock().shows.iter().any(|entry| entry.played == played)
    }

    /// Notes that robots played a show to its end.
    fn add(&self, show: &str, played: Played) {
        let text = {
            let mut kept = self.lock();
            if kept.shows.iter().any(|entry| entry.played == played) {
                return;
            }
            kept.shows.push_back(Entry { show: show.into(), played });
            if kept.shows.len() > SHOWS_MAX {
                kept.shows.pop_front();
            }
            serde_json::to_vec_pretty(&*kept)
        };
        // The lock is free again, because screens query the shows while the file is written.
        let written =
            text.map_err(io::Error::other).and_then(|text| disk::replace(&self.path, &text, Readers::Owner));
        if let Err(error) = written {
            tracing::warn!("{} cannot be written: {error}", self.path.display());
        }
    }

    /// Notes each show that is played to its end, until the conductor ends.
    pub async fn follow(self, handle: Handle, desk: Desk) {
        let mut news = handle.news();
        let mut run = PresentRun::default();
        loop {
            let event = match news.recv().await {
                Ok(News::Event(event)) => event,
                Ok(News::Link(_) | News::Warning(_)) | Err(broadcast::error::RecvError::Lagged(_)) => {
                    continue;
                }
                Err(broadcast::error::RecvError::Closed) => return,
            };
            if matches!(event.kind, EventKind::RunBegun { .. } | EventKind::TakenUp { .. }) {
                let Some(snapshot) = handle.look().await else { return };
                let shown = desk.shown();
                let played = Played::of(shown.drives(), &snapshot.robots);
                run.show = Some((shown.show.name.clone(), played, shown.show.frames.len()));
            }
            if let Some((name, played)) = run.ends(&event) {
                self.add(&name, played);
            }
        }
    }

    fn lock(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The run that is under way.
#[derive(Debug, Default)]
struct PresentRun {
    /// Name of the show, the show with its kind of robots, and its number of frames. `None` if no run is under way.
    show: Option<(String, Played, usize)>,
}

impl PresentRun {
    /// Returns the show if this event ends the run, the outcome is `Finished`, and at least as many frames were played as
    /// the show has. Otherwise returns `None`.
    fn ends(&mut self, event: &Event) -> Option<(String, Played)> {
        let EventKind::RunEnded { outcome, frames_played, .. } = &event.kind else { return None };
        let (name, played, frames) = self.show.take()?;
        (*outcome == RunOutcome::Finished && *frames_played >= frames).then_some((name, played))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::show_plan::drives_hash;
    use lightbots_base::{Instant, Rgb};
    use lightbots_show::{Frame, Pixel, Show};

    fn show() -> Show {
        let frame = Frame { pixels: vec![Pixel::default()], ..Frame::default() };
        Show { name: "Hello".into(), frames: vec![frame.clone(), frame], ..Show::default() }
    }

    #[test]
    fn a_show_is_known_by_its_drives_and_its_kind_of_robots() {
        let played = Played::of(drives_hash(&show()), &[]);
        let mut other = Show { name: "Night".into(), ..show() };
        other.frames[0].pixels[0].color = Rgb::new(1, 2, 3);
        assert_eq!(Played::of(drives_hash(&other), &[]), played, "colours and names are no drives");
        other.frames[1].pixels[0].at.x = 0.25;
        assert_ne!(Played::of(drives_hash(&other), &[]), played);
        assert_ne!(Played { real: true, ..played }, played);
    }

    #[test]
    fn shows_come_back_at_the_next_start_and_have_an_end() {
        let folder = std::env::temp_dir().join(format!("lightbots-played-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        let played = |drives| Played { drives, real: true };
        let shows = PlayedShows::load(&folder);
        assert!(!shows.has(played(7)));
        shows.add("Hello", played(7));
        assert!(PlayedShows::load(&folder).has(played(7)));
        assert!(!PlayedShows::load(&folder).has(Played { real: false, ..played(7) }));
        (100..100 + SHOWS_MAX as u64).for_each(|drives| shows.add("Many", played(drives)));
        let shows = PlayedShows::load(&folder);
        assert!(!shows.has(played(7)) && shows.has(played(100)), "the first one is forgotten");
        std::fs::write(folder.join(FILE), b"{").unwrap();
        assert!(!PlayedShows::load(&folder).has(played(100)));
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn only_a_run_that_showed_all_frames_counts() {
        let played = Played::of(drives_hash(&show()), &[]);
        let ended = |outcome, frames_played| {
            let kind = EventKind::RunEnded { outcome, frames_played, dropouts: 0 };
            let mut run = PresentRun { show: Some(("Hello".into(), played, 2)) };
            run.ends(&Event { at: Instant::ZERO, kind })
        };
        assert_eq!(ended(RunOutcome::Finished, 2), Some(("Hello".into(), played)));
        assert_eq!(ended(RunOutcome::Finished, 1), None, "it began with the second frame");
        assert_eq!(ended(RunOutcome::Aborted, 2), None);
        assert_eq!(ended(RunOutcome::Failed("no path".into()), 2), None);
    }
}
