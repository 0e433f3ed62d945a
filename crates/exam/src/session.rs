//! State that the script and [`crate::Exam`] share: the time, received messages, messages to publish, findings.
//!
//! Script and exam run on one thread. The state is never borrowed across an `await`.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::future::poll_fn;
use std::task::Poll;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_wire::Topic;

use crate::finding::{Finding, RuleTest};
use crate::interface::{ExamEvent, Options, Publish};
use crate::ledger::Ledger;
use crate::received::{Received, ReceivedLog};
use crate::sight::Question;

/// Largest number of names of other robots that are stored: twice the largest fleet of docs/benchmarks.md.
const OTHERS_MAX: usize = 20_000;
/// Time that a person has to answer a question about the light. Without an answer in this time, the exam continues and
/// the rule counts as not tried. Chosen generously, not measured.
const LOOK_MAX: Span = Span::from_millis(300_000);

/// Robots to which a message is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Addressee {
    /// The robot under test, on its own topic.
    Robot,
    /// All robots, on `Broadcast`.
    AllRobots,
    /// A robot that does not exist, by a topic that no robot should have.
    AbsentRobot,
}

/// Which time questions are answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimeAnswers {
    /// Each at once (R26).
    All,
    /// One more, then none.
    One,
    /// None.
    None,
}

/// A robot that is not under test.
#[derive(Clone, Debug)]
pub(crate) struct OtherRobot {
    /// Time of arrival of its last message, on the exam's clock.
    pub last: Instant,
    /// Position in its last report with a position, stage metres; `None`: it has reported none.
    pub at: Option<Vec2>,
}

struct State {
    now: Instant,
    alarm: Option<Instant>,
    subject: Option<RobotId>,
    log: ReceivedLog,
    others: BTreeMap<String, OtherRobot>,
    publishes: VecDeque<Publish>,
    events: VecDeque<ExamEvent>,
    ledger: Ledger,
    stopped: Option<String>,
    time_answers: TimeAnswers,
    /// Show clock minus the exam's clock.
    shift: Span,
    answered: u32,
    last_answer: String,
    is_permitted: bool,
    answer: Option<Option<bool>>,
}

/// Shared state of an exam.
pub(crate) struct Session {
    pub options: Options,
    state: RefCell<State>,
}

impl Session {
    pub fn new(options: Options) -> Self {
        let state = State {
            now: Instant::ZERO,
            alarm: None,
            subject: None,
            log: ReceivedLog::default(),
            others: BTreeMap::new(),
            publishes: VecDeque::new(),
            events: VecDeque::new(),
            ledger: Ledger::new(),
            stopped: None,
            time_answers: TimeAnswers::All,
            shift: Span::ZERO,
            answered: 0,
            last_answer: String::new(),
            is_permitted: false,
            answer: None,
        };
        Self { options, state: RefCell::new(state) }
    }

    // Used by `Exam`.

    pub fn set_now(&self, now: Instant) {
        let mut state = self.state.borrow_mut();
        state.now = state.now.max(now);
    }

    pub fn receive(&self, now: Instant, topic: &str, payload: &[u8]) {
        self.set_now(now);
        let Some(received) = Received::new(now, topic, payload) else { return };
        let mut state = self.state.borrow_mut();
        if state.subject.is_none() || received.id() != state.subject {
            state.note_other(&received);
            return;
        }
        state.answer_time(&received);
        state.log.push(received);
    }

    pub fn permit(&self) {
        self.state.borrow_mut().is_permitted = true;
    }

    pub fn answer(&self, yes: Option<bool>) {
        self.state.borrow_mut().answer = Some(yes);
    }

    pub fn alarm(&self) -> Option<Instant> {
        self.state.borrow().alarm
    }

    pub fn next_publish(&self) -> Option<Publish> {
        self.state.borrow_mut().publishes.pop_front()
    }

    pub fn next_event(&self) -> Option<ExamEvent> {
        self.state.borrow_mut().events.pop_front()
    }

    pub fn findings(&self) -> Vec<Finding> {
        let state = self.state.borrow();
        state.ledger.findings(state.stopped.as_deref())
    }

    /// Commands the robot to stand: a robot with routes by `STOP`, an original robot by a target at its last reported
    /// position. An original robot that has reported none drives on. Does nothing before a robot is chosen: no robot
    /// was told to move, and others may play a show.
    pub fn make_stand(&self) {
        let place = self.last_place();
        let stay = place.map_or_else(String::new, |at| format!("|TARGET {:.6} {:.6}|", at.x, at.y));
        self.send(Addressee::Robot, format!("{stay}|STOP|"));
    }

    // Used by the script.

    pub fn now(&self) -> Instant {
        self.state.borrow().now
    }

    /// Present time on the show clock that the exam gives the robot.
    pub fn show(&self) -> Instant {
        let state = self.state.borrow();
        state.now + state.shift
    }

    /// Sets the show clock forward by a span.
    pub fn jump_clock(&self, by: Span) {
        let mut state = self.state.borrow_mut();
        state.shift = Span(state.shift.0 + by.0);
    }

    pub fn shift(&self) -> Span {
        self.state.borrow().shift
    }

    pub fn set_time_answers(&self, time_answers: TimeAnswers) {
        let mut state = self.state.borrow_mut();
        state.time_answers = time_answers;
        state.answered = 0;
    }

    /// Number of time questions that were answered since `set_time_answers`.
    pub fn answered(&self) -> u32 {
        self.state.borrow().answered
    }

    /// Payload of the last answer to a time question; empty: no answer yet.
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

    /// All other robots that have sent messages, by their names.
    pub fn others(&self) -> BTreeMap<String, OtherRobot> {
        self.state.borrow().others.clone()
    }

    pub fn send(&self, to: Addressee, text: impl Into<String>) {
        self.send_bytes(to, text.into().into_bytes());
    }

    /// Publishes a message. Before a robot is chosen, does nothing if the message is for the robot under test or the
    /// absent robot, because there is no topic for it.
    pub fn send_bytes(&self, to: Addressee, payload: Vec<u8>) {
        let mut state = self.state.borrow_mut();
        let topic = match (to, state.subject) {
            (Addressee::Robot, Some(id)) => Topic::Robot(id).write().to_string(),
            (Addressee::AbsentRobot, Some(id)) => absent_topic(&id),
            (Addressee::AllRobots, _) => Topic::Broadcast.write().to_string(),
            (Addressee::Robot | Addressee::AbsentRobot, None) => return,
        };
        state.publishes.push_back(Publish { topic, payload });
    }

    pub fn emit(&self, events: ExamEvent) {
        self.state.borrow_mut().events.push_back(events);
    }

    /// Records an attempt for a rule. `fits`: whether the robot did what the rule demands.
    pub fn record(&self, rule: u8, fits: bool, sent: &str, expected: &str, came: impl Into<String>) {
        let attempt = RuleTest { sent: sent.into(), expected: expected.into(), came: came.into(), fits };
        self.state.borrow_mut().ledger.note(rule, attempt);
    }

    pub fn mark_unsupported(&self, rule: u8, what: &str) {
        self.state.borrow_mut().ledger.mark_unsupported(rule, what);
    }

    pub fn mark_untried(&self, rules: &[u8], why: &str) {
        let mut state = self.state.borrow_mut();
        rules.iter().for_each(|&rule| state.ledger.mark_untried(rule, why));
    }

    pub fn is_broken(&self, rule: u8) -> bool {
        self.state.borrow().ledger.is_broken(rule)
    }

    pub fn set_stopped(&self, why: &str) {
        self.state.borrow_mut().stopped = Some(why.to_owned());
    }

    /// Number of stored messages of the robot under test. Messages that are stored later have this index or a higher
    /// one.
    pub fn mark(&self) -> usize {
        self.state.borrow().log.len()
    }

    /// Passes the messages of the robot with index `mark` and higher to `look`. Returns the result of `look`.
    pub fn since<T>(&self, mark: usize, look: impl FnOnce(&[Received]) -> T) -> T {
        look(self.state.borrow().log.since(mark))
    }

    /// The position that the robot reported last, stage metres; `None` if it has reported none.
    pub fn last_place(&self) -> Option<Vec2> {
        self.since(0, |received| received.iter().rev().find_map(Received::place))
    }

    /// Waits for `span`.
    pub async fn pause(&self, span: Span) {
        let until = self.now() + span;
        self.until(until, || None::<()>).await;
    }

    /// Waits for at most `span` for a message with index `mark` or higher that `pick` accepts. Returns what `pick` made
    /// of it; `None` if there was no such message.
    pub async fn wait_for<T>(
        &self,
        mark: usize,
        span: Span,
        mut pick: impl FnMut(&Received) -> Option<T>,
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
    pub async fn wait_for_permission(&self) {
        self.until(Instant::FAR, || self.state.borrow().is_permitted.then_some(())).await;
    }

    /// Asks the observer of the robot a question. `None` if there is no answer, or the observer could not tell.
    pub async fn ask_person(&self, question: Question) -> Option<bool> {
        self.state.borrow_mut().answer = None;
        self.emit(ExamEvent::Look(question));
        let until = self.now() + LOOK_MAX;
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
    fn note_other(&mut self, received: &Received) {
        if self.others.len() >= OTHERS_MAX && !self.others.contains_key(received.name()) {
            return;
        }
        let fresh = OtherRobot { last: received.at, at: None };
        let other = self.others.entry(received.name().to_owned()).or_insert(fresh);
        other.last = received.at;
        other.at = received.place().or(other.at);
    }

    fn answer_time(&mut self, received: &Received) {
        let (Some(question), Some(id)) = (received.question, self.subject) else { return };
        match self.time_answers {
            TimeAnswers::None => return,
            TimeAnswers::One => self.time_answers = TimeAnswers::None,
            TimeAnswers::All => {}
        }
        self.answered += 1;
        let show = (self.now + self.shift).0;
        self.last_answer = format!("|TIME {} {show} {show}|", question.asked.0);
        let topic = Topic::Robot(id).write().to_string();
        self.publishes.push_back(Publish { topic, payload: self.last_answer.clone().into_bytes() });
    }
}

/// Topic of a robot that does not exist. Its name differs from `id` in the last byte.
fn absent_topic(id: &RobotId) -> String {
    let mut name = id.as_str().to_owned();
    let last = name.pop();
    name.push(if last == Some('x') { 'y' } else { 'x' });
    format!("T/LightBot/{name}")
}
