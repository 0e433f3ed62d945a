//! Where the script sits: what was heard, what is to be sent, what time it is.
//!
//! Shared between the script and [`crate::Exam`] on one thread. No borrow lives over an `await`.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::future::poll_fn;
use std::task::Poll;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_wire::Topic;

use crate::exam::{News, Options, Send};
use crate::finding::{Finding, Trial};
use crate::heard::{Heard, Log};
use crate::ledger::Ledger;
use crate::sight::Question;

/// Names of other robots that are remembered.
const OTHERS: usize = 20_000;
/// People take their time to look at a light.
const LOOKING: Span = Span::from_millis(300_000);

/// To whom something is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum To {
    /// The robot under test, on its own topic.
    Robot,
    /// Everybody, on `Broadcast`.
    All,
    /// A robot that does not exist.
    Neighbour,
}

/// Whether time questions are answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Duty {
    /// Each at once, as R26 says.
    Answer,
    /// One more, then none.
    Once,
    /// None.
    Silent,
}

/// A robot that is not under test.
#[derive(Clone, Debug)]
pub(crate) struct Other {
    /// When it was heard last.
    pub last: Instant,
    /// Where it said it was.
    pub at: Option<Vec2>,
}

struct State {
    now: Instant,
    alarm: Option<Instant>,
    subject: Option<RobotId>,
    log: Log,
    others: BTreeMap<String, Other>,
    sends: VecDeque<Send>,
    news: VecDeque<News>,
    ledger: Ledger,
    stopped: Option<String>,
    duty: Duty,
    /// Show clock less the exam's clock.
    shift: Span,
    answered: u32,
    last_answer: String,
    may_go: bool,
    answer: Option<Option<bool>>,
}

/// What script and shell share.
pub(crate) struct Desk {
    pub options: Options,
    state: RefCell<State>,
}

impl Desk {
    pub fn new(options: Options) -> Self {
        let state = State {
            now: Instant::ZERO,
            alarm: None,
            subject: None,
            log: Log::default(),
            others: BTreeMap::new(),
            sends: VecDeque::new(),
            news: VecDeque::new(),
            ledger: Ledger::new(),
            stopped: None,
            duty: Duty::Answer,
            shift: Span::ZERO,
            answered: 0,
            last_answer: String::new(),
            may_go: false,
            answer: None,
        };
        Self { options, state: RefCell::new(state) }
    }

    // What the shell does.

    pub fn set_now(&self, now: Instant) {
        let mut state = self.state.borrow_mut();
        state.now = state.now.max(now);
    }

    pub fn hear(&self, now: Instant, topic: &str, payload: &[u8]) {
        self.set_now(now);
        let Some(heard) = Heard::new(now, topic, payload) else { return };
        let mut state = self.state.borrow_mut();
        if state.subject.is_none() || heard.id() != state.subject {
            state.meet(&heard);
            return;
        }
        state.answer_time(&heard);
        state.log.push(heard);
    }

    pub fn go(&self) {
        self.state.borrow_mut().may_go = true;
    }

    pub fn answer(&self, yes: Option<bool>) {
        self.state.borrow_mut().answer = Some(yes);
    }

    pub fn alarm(&self) -> Option<Instant> {
        self.state.borrow().alarm
    }

    pub fn next_send(&self) -> Option<Send> {
        self.state.borrow_mut().sends.pop_front()
    }

    pub fn next_news(&self) -> Option<News> {
        self.state.borrow_mut().news.pop_front()
    }

    pub fn findings(&self) -> Vec<Finding> {
        let state = self.state.borrow();
        state.ledger.findings(state.stopped.as_deref())
    }

    /// Makes the robot stand: our robots by STOP, original ones by a target where they were last.
    pub fn leave(&self) {
        let place = self.last_place();
        let stay = place.map_or_else(String::new, |at| format!("|TARGET {:.6} {:.6}|", at.x, at.y));
        self.say(To::Robot, format!("{stay}|STOP|"));
    }

    // What the script does.

    pub fn now(&self) -> Instant {
        self.state.borrow().now
    }

    /// The show clock that the robot is told.
    pub fn show(&self) -> Instant {
        let state = self.state.borrow();
        state.now + state.shift
    }

    /// Sets the show clock forward.
    pub fn jump_clock(&self, by: Span) {
        let mut state = self.state.borrow_mut();
        state.shift = Span(state.shift.0 + by.0);
    }

    pub fn shift(&self) -> Span {
        self.state.borrow().shift
    }

    pub fn set_duty(&self, duty: Duty) {
        let mut state = self.state.borrow_mut();
        state.duty = duty;
        state.answered = 0;
    }

    /// Questions answered since the duty was set.
    pub fn answered(&self) -> u32 {
        self.state.borrow().answered
    }

    /// The answer sent last, as a payload.
    pub fn last_answer(&self) -> String {
        self.state.borrow().last_answer.clone()
    }

    pub fn subject(&self) -> Option<RobotId> {
        self.state.borrow().subject
    }

    pub fn set_subject(&self, id: RobotId) {
        let mut state = self.state.borrow_mut();
        state.subject = Some(id);
        state.others.remove(id.as_str());
    }

    /// Everybody else by name.
    pub fn others(&self) -> BTreeMap<String, Other> {
        self.state.borrow().others.clone()
    }

    pub fn say(&self, to: To, text: impl Into<String>) {
        self.say_bytes(to, text.into().into_bytes());
    }

    pub fn say_bytes(&self, to: To, payload: Vec<u8>) {
        let mut state = self.state.borrow_mut();
        let topic = match (to, state.subject) {
            (To::Robot, Some(id)) => Topic::Robot(id).write().to_string(),
            (To::Neighbour, Some(id)) => neighbour(&id),
            _ => Topic::Broadcast.write().to_string(),
        };
        state.sends.push_back(Send { topic, payload });
    }

    pub fn tell(&self, news: News) {
        self.state.borrow_mut().news.push_back(news);
    }

    /// Notes what was tried about a rule.
    pub fn judge(&self, rule: u8, fits: bool, sent: &str, expected: &str, came: impl Into<String>) {
        let trial = Trial { sent: sent.into(), expected: expected.into(), came: came.into(), fits };
        self.state.borrow_mut().ledger.note(rule, trial);
    }

    pub fn lacks(&self, rule: u8, what: &str) {
        self.state.borrow_mut().ledger.lacks(rule, what);
    }

    pub fn excuse(&self, rules: &[u8], why: &str) {
        let mut state = self.state.borrow_mut();
        rules.iter().for_each(|&rule| state.ledger.excuse(rule, why));
    }

    pub fn is_broken(&self, rule: u8) -> bool {
        self.state.borrow().ledger.is_broken(rule)
    }

    pub fn set_stopped(&self, why: &str) {
        self.state.borrow_mut().stopped = Some(why.to_owned());
    }

    /// What comes later stands behind this mark.
    pub fn mark(&self) -> usize {
        self.state.borrow().log.len()
    }

    /// Looks at what the robot said since a mark.
    pub fn since<T>(&self, mark: usize, look: impl FnOnce(&[Heard]) -> T) -> T {
        look(self.state.borrow().log.since(mark))
    }

    /// Where it said it was, last.
    pub fn last_place(&self) -> Option<Vec2> {
        self.since(0, |heard| heard.iter().rev().find_map(Heard::place))
    }

    /// Waits.
    pub async fn pause(&self, span: Span) {
        let until = self.now() + span;
        self.until(until, || None::<()>).await;
    }

    /// Waits for something the robot says after `mark`, for at most `span`.
    pub async fn wait_for<T>(
        &self,
        mark: usize,
        span: Span,
        mut pick: impl FnMut(&Heard) -> Option<T>,
    ) -> Option<T> {
        let until = self.now() + span;
        let mut read = mark;
        self.until(until, || {
            let state = self.state.borrow();
            let fresh = state.log.since(read);
            let found = fresh.iter().find_map(&mut pick);
            read += fresh.len();
            found
        })
        .await
    }

    /// Waits until the robot may be driven.
    pub async fn wait_to_go(&self) {
        self.until(Instant::FAR, || self.state.borrow().may_go.then_some(())).await;
    }

    /// Asks whoever sees the robot; `None`: nobody could tell.
    pub async fn look(&self, question: Question) -> Option<bool> {
        self.state.borrow_mut().answer = None;
        self.tell(News::Look(question));
        let until = self.now() + LOOKING;
        self.until(until, || self.state.borrow_mut().answer.take()).await.flatten()
    }

    async fn until<T>(&self, until: Instant, mut found: impl FnMut() -> Option<T>) -> Option<T> {
        poll_fn(|_| {
            let got = found();
            let over = got.is_some() || self.now() >= until;
            self.state.borrow_mut().alarm = (!over && until != Instant::FAR).then_some(until);
            if over { Poll::Ready(got) } else { Poll::Pending }
        })
        .await
    }
}

impl State {
    fn meet(&mut self, heard: &Heard) {
        if self.others.len() >= OTHERS && !self.others.contains_key(heard.name()) {
            return;
        }
        let fresh = Other { last: heard.at, at: None };
        let other = self.others.entry(heard.name().to_owned()).or_insert(fresh);
        other.last = heard.at;
        other.at = heard.place().or(other.at);
    }

    fn answer_time(&mut self, heard: &Heard) {
        let (Some(question), Some(id)) = (heard.question, self.subject) else { return };
        match self.duty {
            Duty::Silent => return,
            Duty::Once => self.duty = Duty::Silent,
            Duty::Answer => {}
        }
        self.answered += 1;
        let show = (self.now + self.shift).0;
        self.last_answer = format!("|TIME {} {show} {show}|", question.asked.0);
        let topic = Topic::Robot(id).write().to_string();
        self.sends.push_back(Send { topic, payload: self.last_answer.clone().into_bytes() });
    }
}

/// The topic of a robot whose name differs in its last byte.
fn neighbour(id: &RobotId) -> String {
    let mut name = id.as_str().to_owned();
    let last = name.pop();
    name.push(if last == Some('x') { 'y' } else { 'x' });
    format!("T/LightBot/{name}")
}
