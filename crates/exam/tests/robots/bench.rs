//! A test bench that runs an exam in virtual time.

use std::collections::BTreeMap;

use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_exam::{Ending, Exam, ExamEvent, Finding, Options, Question, RuleVerdict, Sight};
use lightbots_show::Stage;
use lightbots_sim::{Conditions, Fleet, FleetConfig};

use crate::flaws::Flaw;

/// Difference between the exam's clock and the robots' clocks.
const EXAM_AHEAD: Span = Span::from_millis(7_000_000);
/// Time at which an exam is cut off.
const LONGEST: Instant = Instant(900_000_000);

/// A message: topic and payload.
pub type Message = (String, Vec<u8>);

/// Result of an exam.
pub struct Outcome {
    pub ending: Option<Ending>,
    pub findings: Vec<Finding>,
    pub took: Span,
    pub robot: Option<RobotId>,
}

pub struct Bench {
    fleet: Fleet,
    exam: Exam,
    flaw: Box<dyn Flaw>,
    now: Instant,
    /// Undelivered messages by arrival and order. `true` marks those to the robots.
    wires: BTreeMap<(Instant, u64), (bool, Message)>,
    said: u64,
    dice: u64,
    /// Colours of the first robot's light, and when each of them began.
    shown: Vec<(Instant, Rgb)>,
}

impl Bench {
    /// An exam with one robot in the middle of the edge where y is largest, and further robots beside it.
    pub fn new(robots: usize, flaw: impl Flaw + 'static, options: Options) -> Self {
        let starts = (0..robots).map(|index| Vec2::new(0.1 * index as f64, 1.3)).collect();
        let config =
            FleetConfig { stage: Stage::default(), starts, seed: 4, conditions: Conditions::default() };
        let options = Options { looks: true, ..options };
        Self {
            fleet: Fleet::new(&config),
            exam: Exam::new(options),
            flaw: Box::new(flaw),
            now: Instant::ZERO,
            wires: BTreeMap::new(),
            said: 0,
            dice: 99,
            shown: Vec::new(),
        }
    }

    /// The names of the robots.
    pub fn ids(&self) -> Vec<RobotId> {
        self.fleet.ids()
    }

    /// Limits the robots' speed.
    pub fn at_speed(mut self, speed_mps: f64) -> Self {
        let mut stage = Stage::default();
        stage.limits.speed_mps = speed_mps;
        let starts = vec![Vec2::new(0.0, 1.3)];
        self.fleet = Fleet::new(&FleetConfig { stage, starts, seed: 4, conditions: Conditions::default() });
        self
    }

    /// Runs the exam to its end.
    pub fn run(mut self) -> Outcome {
        self.fleet.link(Instant::ZERO, true);
        self.exam.connected(Instant::ZERO + EXAM_AHEAD);
        while self.exam.ending().is_none() && self.now < LONGEST {
            self.drain();
            self.now = self.next_moment();
            self.deliver();
            self.fleet.advance(self.now);
            self.see();
            self.exam.wake(self.now + EXAM_AHEAD);
        }
        Outcome {
            ending: self.exam.ending().cloned(),
            findings: self.exam.findings(),
            took: self.now - Instant::ZERO,
            robot: self.exam.robot(),
        }
    }

    fn next_moment(&self) -> Instant {
        let arrives = self.wires.keys().next().map_or(Instant::FAR, |key| key.0);
        let wakes =
            self.exam.wake_at().map_or(Instant::FAR, |at| Instant(at.0.saturating_sub(EXAM_AHEAD.0 as u64)));
        self.fleet.advance_at().min(arrives).min(wakes).max(self.now)
    }

    fn post(&mut self, to_robots: bool, message: Message) {
        self.dice = self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let late = Span(5_000 + ((self.dice >> 33) % 15_000) as i64);
        // Messages of one direction arrive in the order in which they were sent.
        let last = self.wires.iter().filter(|(_, (to, _))| *to == to_robots).map(|(key, _)| key.0).max();
        let at = (self.now + late).max(last.unwrap_or(Instant::ZERO));
        self.said += 1;
        self.wires.insert((at, self.said), (to_robots, message));
    }

    fn deliver(&mut self) {
        while let Some(entry) = self.wires.first_entry().filter(|entry| entry.key().0 <= self.now) {
            let (to_robots, (topic, payload)) = entry.remove();
            if to_robots {
                let mut says = Vec::new();
                let show = self.now + EXAM_AHEAD;
                for (topic, payload) in self.flaw.hear(show, (topic, payload), &mut says) {
                    self.fleet.receive(self.now, &topic, &payload);
                }
                says.into_iter().for_each(|message| self.post(false, message));
            } else {
                self.exam.message(self.now + EXAM_AHEAD, &topic, &payload);
            }
            self.drain();
        }
    }

    fn drain(&mut self) {
        while let Some(send) = self.exam.next_publish() {
            self.post(true, (send.topic, send.payload));
        }
        while let Some(message) = self.fleet.next_message() {
            let topic = message.topic.write().to_string();
            let says = if message.robot == 0 {
                self.flaw.say((topic, message.payload))
            } else {
                vec![(topic, message.payload)]
            };
            says.into_iter().for_each(|message| self.post(false, message));
        }
        while let Some(event) = self.exam.next_event() {
            let now = self.now + EXAM_AHEAD;
            match event {
                ExamEvent::Ready { .. } => self.exam.go(now),
                ExamEvent::Look(question) => {
                    let yes = self.saw(&question);
                    self.exam.answer(now, Some(yes));
                }
                ExamEvent::Doing(_) => {}
            }
        }
    }

    fn see(&mut self) {
        let Some(&light) = self.fleet.lights().first() else { return };
        if self.shown.last().is_none_or(|last| last.1 != light) {
            self.shown.push((self.now + EXAM_AHEAD, light));
        }
    }

    fn saw(&self, question: &Question) -> bool {
        question.sights.iter().all(|sight| match *sight {
            Sight::Colour { at, colour } => {
                let shown = self.shown.iter().rev().find(|(from, _)| *from <= at).map(|(_, light)| *light);
                shown.is_some_and(|shown| near(shown, colour))
            }
            Sight::Flashing { from, to } => {
                let flashes = self
                    .shown
                    .iter()
                    .filter(|(at, light)| (from..=to).contains(at) && near(*light, Rgb::new(255, 255, 255)));
                flashes.count() >= 8
            }
        })
    }
}

fn near(a: Rgb, b: Rgb) -> bool {
    [(a.r, b.r), (a.g, b.g), (a.b, b.b)].iter().all(|(a, b)| a.abs_diff(*b) <= 20)
}

impl Outcome {
    /// Numbers of the rules with this verdict.
    pub fn with(&self, verdict: RuleVerdict) -> Vec<u8> {
        self.findings
            .iter()
            .filter(|finding| finding.verdict == verdict)
            .map(|finding| finding.rule)
            .collect()
    }

    /// Fails with all findings unless exactly these rules are broken.
    pub fn assert_broken(&self, rules: &[u8]) {
        if self.with(RuleVerdict::Breaks) != rules {
            let wrong = self
                .findings
                .iter()
                .filter(|finding| finding.verdict == RuleVerdict::Breaks || rules.contains(&finding.rule));
            wrong.for_each(|finding| eprintln!("{finding:?}"));
            panic!("broken are R{:?}, not R{rules:?}", self.with(RuleVerdict::Breaks));
        }
    }
}
