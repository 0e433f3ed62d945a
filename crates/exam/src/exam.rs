//! The exam from outside: inputs with `now`, outputs drained, the script polled by hand.

use std::future::Future;
use std::pin::Pin;
use std::rc::Rc;
use std::task::{Context, Waker};

use lightbots_base::{Instant, RobotId, Vec2};

use crate::desk::Desk;
use crate::finding::Finding;
use crate::script;
use crate::sight::Question;

/// How the robot is examined.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which robot; `None`: the only one there is.
    pub robot: Option<RobotId>,
    /// Width and depth of the floor, metres: the robot is not sent off it, and places off it are wrong.
    pub floor: (f64, f64),
    /// Whether somebody answers questions about the light.
    pub looks: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self { robot: None, floor: (3.0, 3.0), looks: false }
    }
}

/// A message to publish at QoS 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Send {
    /// On what.
    pub topic: String,
    /// Mostly text; sometimes junk on purpose.
    pub payload: Vec<u8>,
}

/// What whoever runs the exam wants to know.
#[derive(Clone, Debug, PartialEq)]
pub enum News {
    /// The robot is about to be driven; it waits for [`Exam::go`].
    Ready {
        /// Which.
        robot: RobotId,
        /// Where it stands, stage metres; `None`: it does not know, and nothing will be driven.
        at: Option<Vec2>,
        /// Where the floor must be free for it up to 0.5 m, stage metres.
        towards: Option<Vec2>,
    },
    /// What is tried now.
    Doing(&'static str),
    /// A question about the light; it waits for [`Exam::answer`].
    Look(Question),
}

/// How an exam ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Everything was tried, or nothing more could be: see the findings.
    Done,
    /// No robot speaks on this broker, or not the one that was named.
    Nobody,
    /// Several robots speak; which is meant was not said.
    Several(Vec<RobotId>),
}

/// One exam of one robot.
pub struct Exam {
    desk: Rc<Desk>,
    script: Option<Pin<Box<dyn Future<Output = Ending>>>>,
    ending: Option<Ending>,
}

impl Exam {
    /// An exam that begins once it is [`connected`](Self::connected).
    pub fn new(options: Options) -> Self {
        let desk = Rc::new(Desk::new(options));
        let script = Box::pin(script::run(desk.clone()));
        Self { desk, script: Some(script), ending: None }
    }

    /// The broker is there and everything under `T/LightBot/` that robots publish is subscribed.
    pub fn connected(&mut self, now: Instant) {
        self.poll(now);
    }

    /// A message came in.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        self.desk.hear(now, topic, payload);
        self.poll(now);
    }

    /// The robot may be driven.
    pub fn go(&mut self, now: Instant) {
        self.desk.go();
        self.poll(now);
    }

    /// The answer to [`News::Look`]; `None`: nobody could tell.
    pub fn answer(&mut self, now: Instant, yes: Option<bool>) {
        self.desk.answer(yes);
        self.poll(now);
    }

    /// Time has passed.
    pub fn wake(&mut self, now: Instant) {
        self.poll(now);
    }

    /// When to call [`wake`](Self::wake) at the latest; `None`: it waits for something else, or is over.
    pub fn wake_at(&self) -> Option<Instant> {
        self.desk.alarm().filter(|_| self.script.is_some())
    }

    /// The next message to publish.
    pub fn next_send(&mut self) -> Option<Send> {
        self.desk.next_send()
    }

    /// The next thing to tell.
    pub fn next_news(&mut self) -> Option<News> {
        self.desk.next_news()
    }

    /// Gives up: the robot is told to stand where it is. Drain the messages afterwards.
    pub fn give_up(&mut self) {
        self.script = None;
        self.desk.leave();
    }

    /// How it ended; `None` while it goes on.
    pub fn ending(&self) -> Option<&Ending> {
        self.ending.as_ref()
    }

    /// Which robot is examined, once that is known.
    pub fn robot(&self) -> Option<RobotId> {
        self.desk.subject()
    }

    /// What has been found so far, one finding a rule in the order of the rules.
    pub fn findings(&self) -> Vec<Finding> {
        self.desk.findings()
    }

    fn poll(&mut self, now: Instant) {
        self.desk.set_now(now);
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
