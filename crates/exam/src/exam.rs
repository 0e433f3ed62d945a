//! An exam as its caller sees it: the caller passes inputs with the time `now`, and drains outputs. After each input
//! the script runs on.

use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Waker};

use lightbots_base::{Instant, RobotId};

use crate::finding::Finding;
use crate::interface::{Ending, ExamEvent, Options, Publish};
use crate::script;
use crate::session::Session;

/// One exam of one robot.
pub struct Exam {
    session: Rc<Session>,
    script: Option<Pin<Box<dyn Future<Output = Ending>>>>,
    ending: Option<Ending>,
}

impl Exam {
    /// Makes an exam. It begins when [`connected`](Self::connected) is called.
    pub fn new(options: Options) -> Self {
        let session = Rc::new(Session::new(options));
        let script = Box::pin(script::run(session.clone()));
        Self { session, script: Some(script), ending: None }
    }

    /// Begins the exam. Before this call, the broker must be connected and all topics of robots below `T/LightBot/`
    /// subscribed.
    pub fn connected(&mut self, now: Instant) {
        self.poll(now);
    }

    /// Handles a message that arrived.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        self.session.receive(now, topic, payload);
        self.poll(now);
    }

    /// Permits driving the robot.
    pub fn go(&mut self, now: Instant) {
        self.session.permit();
        self.poll(now);
    }

    /// Answers the question of [`ExamEvent::Look`]. `None`: the person could not tell.
    pub fn answer(&mut self, now: Instant, yes: Option<bool>) {
        self.session.answer(yes);
        self.poll(now);
    }

    /// Lets the script go on after time has passed.
    pub fn wake(&mut self, now: Instant) {
        self.poll(now);
    }

    /// Time at which [`wake`](Self::wake) must be called at the latest. `None` if the exam waits for another input, or
    /// is over.
    pub fn wake_at(&self) -> Option<Instant> {
        self.session.alarm().filter(|_| self.script.is_some())
    }

    /// Removes and returns the next message to publish; `None` if there is none.
    pub fn next_publish(&mut self) -> Option<Publish> {
        self.session.next_publish()
    }

    /// Removes and returns the next event; `None` if there is none.
    pub fn next_event(&mut self) -> Option<ExamEvent> {
        self.session.next_event()
    }

    /// Aborts the exam and commands the robot to stand, if one is chosen. Publish the remaining messages afterwards.
    pub fn give_up(&mut self) {
        self.script = None;
        self.session.make_stand();
    }

    /// How the exam ended; `None` while it runs, and if [`give_up`](Self::give_up) aborted it.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// The examined robot; `None` until it is chosen.
    pub fn robot(&self) -> Option<RobotId> {
        self.session.subject()
    }

    /// The findings until now, one for each rule, in the order of the rules' numbers.
    pub fn findings(&self) -> Vec<Finding> {
        self.session.findings()
    }

    fn poll(&mut self, now: Instant) {
        self.session.set_now(now);
        let Some(script) = self.script.as_mut() else { return };
        let mut context = Context::from_waker(Waker::noop());
        if let std::task::Poll::Ready(ending) = script.as_mut().poll(&mut context) {
            self.script = None;
            self.ending = Some(ending);
        }
    }
}

impl std::fmt::Debug for Exam {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Exam").field("robot", &self.robot()).field("ending", &self.ending).finish()
    }
}
