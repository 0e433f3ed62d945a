//! The show that is open on every screen, and its plan.

use std::sync::{Arc, OnceLock, PoisonError};

use axum::extract::ws::Utf8Bytes;
use lightbots_api as api;
use lightbots_control::{ControllerState, EventKind, Operation, Refusal};
use lightbots_lighting::validate;
use lightbots_show::{Issues, Show};
use tokio::sync::{Mutex, broadcast, watch};

use crate::library::Kept;
use crate::live::conductor::{Handle, News};
use crate::show_plan;

use super::planner::GiveUp;

/// The open show and its plan. Clones share them.
#[derive(Clone, Debug)]
pub struct Desk {
    handle: Handle,
    shown: watch::Sender<Arc<Shown>>,
    plan: watch::Sender<Arc<api::Plan>>,
    /// Cancels the running plan as soon as another value replaces this one. Locked while another show replaces the open one.
    planning: Arc<std::sync::Mutex<GiveUp>>,
    last_plan: Arc<show_plan::LastPlan>,
    /// Revision of the show that this value gave to the controller last; 0 if none. Locked while the controller gets another
    /// revision.
    given: Arc<Mutex<u32>>,
}

/// The open show with its message to screens.
#[derive(Debug)]
pub struct Shown {
    /// Number of the document's state, increased with every change; 0 before a show is opened.
    pub revision: u32,
    /// Name of the show in the library; `None` before a show is opened.
    pub name: Option<String>,
    /// The show.
    pub show: Arc<Show>,
    /// The message to screens, ready to send.
    pub message: Utf8Bytes,
    /// [`show_plan::drives_hash`] of the show, once it was computed.
    drives: OnceLock<u64>,
}

impl Desk {
    /// A state without an open show.
    pub fn new(handle: Handle) -> Self {
        let nothing = Shown::new(api::OpenShow::default(), Arc::default());
        let (shown, _) = watch::channel(Arc::new(nothing));
        let (plan, _) = watch::channel(Arc::default());
        Self {
            handle,
            shown,
            plan,
            planning: Arc::default(),
            last_plan: Arc::default(),
            given: Arc::default(),
        }
    }

    /// Opens a show on every screen and in the controller, and begins to plan it. During a run, the controller gets the show
    /// when the run is over.
    pub async fn open(&self, name: String, kept: Kept) {
        let message = api::OpenShow {
            revision: 0,
            name: Some(name),
            etag: Some(kept.etag),
            read_only: kept.read_only,
            document: serde_json::from_slice(&kept.bytes).unwrap_or_default(),
        };
        self.show_and_plan(message, Arc::new(kept.show), kept.issues);
        // During a run the controller keeps its show and gets this one when the run is over.
        let _ = self.hand_over().await;
    }

    /// Gives the open show to the controller if the controller has another revision.
    pub async fn hand_over(&self) -> Result<(), Refusal> {
        let mut given = self.given.lock().await;
        let shown = self.shown();
        if shown.revision != *given {
            self.handle.operate(Operation::Open(shown.named())).await?;
            *given = shown.revision;
        }
        Ok(())
    }

    /// The open show.
    pub fn shown(&self) -> Arc<Shown> {
        self.shown.borrow().clone()
    }

    /// A receiver of the open show and its changes.
    pub fn watch(&self) -> watch::Receiver<Arc<Shown>> {
        self.shown.subscribe()
    }

    /// The plan of the open show, with paths. While that plan is being made, an empty one with `planning` true.
    pub fn plan(&self) -> Arc<api::Plan> {
        self.plan.borrow().clone()
    }

    /// A receiver of the plan and its changes.
    pub fn watch_plan(&self) -> watch::Receiver<Arc<api::Plan>> {
        self.plan.subscribe()
    }

    /// Gives the controller a show that was opened during a run, once the run is over. Returns when the conductor has ended.
    pub async fn follow(self, mut news: broadcast::Receiver<News>) {
        loop {
            match news.recv().await {
                Ok(News::Event(event)) if event.kind == EventKind::StateChanged(ControllerState::Ready) => {
                    // If another run has begun already, the event comes again at its end.
                    let _ = self.hand_over().await;
                }
                Err(broadcast::error::RecvError::Closed) => return,
                _ => {}
            }
        }
    }

    /// Shows the document on every screen, and begins to plan it. Of two calls at once, all of one comes first, so that the
    /// plan is that of the show on the screens.
    fn show_and_plan(&self, mut message: api::OpenShow, show: Arc<Show>, found: Issues) {
        let mut planning = self.planning.lock().unwrap_or_else(PoisonError::into_inner);
        let mut revision = 0;
        self.shown.send_modify(|shown| {
            revision = shown.revision + 1;
            message.revision = revision;
            *shown = Arc::new(Shown::new(message, show.clone()));
        });
        self.plan.send_replace(Arc::new(api::Plan { revision, planning: true, ..api::Plan::default() }));
        let (sender, last_plan) = (self.plan.clone(), self.last_plan.clone());
        let give_up = GiveUp::default();
        let is_given_up = give_up.asked();
        // Cancels the plan of the previous show, which nothing needs.
        *planning = give_up;
        let shown = self.shown();
        tokio::task::spawn_blocking(move || {
            shown.drives();
            let found = validate(&show).into_iter().chain(found).collect();
            let planned = last_plan.plan_unless(&show, &found, &|| is_given_up.get());
            let Ok(mut plan) = planned else { return };
            plan.revision = revision;
            sender.send_if_modified(|current| {
                let wanted = current.revision == revision;
                if wanted {
                    *current = Arc::new(plan);
                }
                wanted
            });
        });
    }
}

impl Shown {
    /// [`show_plan::drives_hash`] of the show.
    pub fn drives(&self) -> u64 {
        *self.drives.get_or_init(|| show_plan::drives_hash(&self.show))
    }

    /// Returns [`Self::drives`] if it was computed already, which happens soon after the show was opened; else `None`.
    pub fn known_drives(&self) -> Option<u64> {
        self.drives.get().copied()
    }

    /// Returns the show. If its author gave it no name, its name becomes that in the library.
    fn named(&self) -> Arc<Show> {
        match &self.name {
            Some(name) if self.show.name.trim().is_empty() => {
                Arc::new(Show { name: name.clone(), ..(*self.show).clone() })
            }
            _ => self.show.clone(),
        }
    }

    fn new(open: api::OpenShow, show: Arc<Show>) -> Self {
        let (revision, name) = (open.revision, open.name.clone());
        let message = super::message::text(&api::ToScreen::Show(open));
        Self { revision, name, show, message, drives: OnceLock::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::clock::Clock;
    use crate::live::recorder::RecordingTarget;

    #[test]
    fn a_show_without_a_name_is_called_as_in_the_library() {
        let shown = |title: &str| {
            let show = Show { name: title.into(), ..Show::default() };
            let open = api::OpenShow { name: Some("heart 2".into()), ..api::OpenShow::default() };
            Shown::new(open, Arc::new(show)).named()
        };
        assert_eq!((&*shown("").name, &*shown("Heart").name), ("heart 2", "Heart"));
    }

    fn desk() -> (Desk, impl Sized) {
        let (handle, conductor) = Handle::start(
            RecordingTarget::Off,
            (Clock::start(), Default::default()),
            crate::stop::Stop::install(),
        );
        (Desk::new(handle), conductor)
    }

    fn kept() -> Kept {
        Kept {
            bytes: b"{}".to_vec(),
            show: Show::default(),
            etag: String::new(),
            read_only: None,
            issues: Issues::new(),
        }
    }

    #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
    async fn of_shows_that_are_opened_at_once_the_last_one_is_planned() {
        let (desk, _conductor) = desk();
        let runtime = tokio::runtime::Handle::current();
        for round in 1..=300 {
            let at_once = std::sync::Barrier::new(4);
            std::thread::scope(|threads| {
                for _ in 0..4 {
                    threads.spawn(|| {
                        let _entered = runtime.enter();
                        at_once.wait();
                        desk.show_and_plan(api::OpenShow::default(), Arc::default(), Issues::new());
                    });
                }
            });
            let revision = desk.shown().revision;
            assert_eq!((revision, desk.plan().revision), (4 * round, 4 * round));
        }
    }

    #[tokio::test]
    async fn the_plan_of_a_show_that_was_replaced_is_given_up() {
        let (desk, _conductor) = desk();
        let is_given_up = || desk.planning.lock().unwrap().asked();
        desk.open("one".into(), kept()).await;
        let of_first = is_given_up();
        assert!(!of_first.get());
        desk.open("two".into(), kept()).await;
        assert!(of_first.get() && !is_given_up().get());
        let mut plans = desk.watch_plan();
        plans.wait_for(|plan| plan.revision == 2 && !plan.planning).await.unwrap();
    }
}
