//! A fleet of perfect robots, links that lose and delay messages, and a controller, in virtual time.
#![allow(dead_code)] // Each test file uses a part of it.

pub mod robot;

use lightbots_base::{Instant, Rgb, Span, Vec2};
use lightbots_control::{
    ComputerTime, Config, Controller, Event, EventKind, MissingPolicy, OnReturn, Operation, Refusal,
    RunOutcome, UnfinishedRun,
};
use lightbots_show::{Frame, Identity, Pixel, Show, Stage};
use lightbots_wire::Topic;
use robot::Robot;
use std::sync::Arc;

/// Virtual time between two steps of the robots.
const STEP: Span = Span::from_millis(10);

/// A seeded generator of random numbers.
pub struct Dice(pub u64);

impl Dice {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    pub fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }
}

/// Matches the event that robots have reached this frame.
pub fn reached(frame: usize) -> impl Fn(&EventKind) -> bool {
    move |kind| matches!(kind, EventKind::FrameReached { frame: one, .. } if *one == frame)
}

/// Matches the event that robots leave for a frame.
pub fn started(kind: &EventKind) -> bool {
    matches!(kind, EventKind::TransitionStarted { .. })
}

struct Letter {
    due: Instant,
    topic: Topic,
    payload: Vec<u8>,
    to_controller: bool,
}

pub struct World {
    pub now: Instant,
    pub controller: Controller,
    pub robots: Vec<Robot>,
    pub events: Vec<Event>,
    pub linked: bool,
    /// Whether the controller was killed and not yet replaced.
    pub is_killed: bool,
    /// Whether the broker drops all messages of the controller.
    pub mute: bool,
    /// Whether the broker holds all messages back until this is false again.
    pub frozen: bool,
    /// Numbers of the robots that receive nothing.
    pub deaf: Vec<usize>,
    /// Numbers of the robots with a broken link: nothing that they send arrives, and they receive nothing.
    pub cut: Vec<usize>,
    /// Share of messages lost, percent.
    pub loss: u64,
    /// Delay of messages, milliseconds: the least, and the largest addition to it.
    pub delay_ms: (u64, u64),
    pub closest_m: f64,
    /// How long each plan might take, in the order of the requests. `None` for a plan without a limit.
    pub budgets: Vec<Option<Span>>,
    /// How many of the next plans with a limit exceed it and are cancelled.
    pub slow_plans: usize,
    dice: Dice,
    letters: Vec<Letter>,
    /// Contents of the journal's file. `journal_ends` holds its length after each piece.
    pub journal: Vec<u8>,
    pub journal_ends: Vec<usize>,
}

impl World {
    /// Robots in rows along the back edge. The last `originals` of them understand only TARGET and COLOR.
    pub fn new(count: usize, originals: usize) -> Self {
        Self::with(Config::default(), count, originals)
    }

    /// The same world as [`Self::new`], with this configuration of the controller.
    pub fn with(config: Config, count: usize, originals: usize) -> Self {
        let place = |i: usize| Vec2::new((i % 29) as f64 * 0.1 - 1.4, 1.3 - (i / 29) as f64 * 0.1);
        let robots = (0..count).map(|i| Robot::new(i, place(i), i + originals >= count)).collect();
        let mut world = Self {
            now: Instant(1_000_000),
            controller: Controller::new(config),
            robots,
            events: Vec::new(),
            linked: false,
            is_killed: false,
            mute: false,
            frozen: false,
            deaf: Vec::new(),
            cut: Vec::new(),
            loss: 0,
            delay_ms: (5, 15),
            closest_m: f64::INFINITY,
            budgets: Vec::new(),
            slow_plans: 0,
            dice: Dice(7),
            letters: Vec::new(),
            journal: Vec::new(),
            journal_ends: Vec::new(),
        };
        world.robots.iter_mut().for_each(Robot::introduce);
        world.link(true);
        world
    }

    /// The same world as [`Self::new`], with an open show and all robots known.
    pub fn ready(count: usize, originals: usize, show: Show) -> Self {
        let mut world = Self::new(count, originals);
        world.operate(Operation::Open(Arc::new(show))).unwrap();
        world.run_for(1.0);
        world
    }

    /// A world one second after its robots left for the first of three frames.
    pub fn under_way(count: usize) -> Self {
        let mut world = Self::ready(count, 0, show(3, count, 0.3));
        world.play();
        world.run_until(10.0, started);
        world.run_for(1.0);
        world
    }

    pub fn link(&mut self, up: bool) {
        self.linked = up;
        self.letters.clear();
        if up {
            self.controller.connected(self.now);
        } else {
            self.controller.disconnected(self.now);
        }
        self.drain();
    }

    /// Replaces the controller by a new one without a journal.
    pub fn replace_controller(&mut self) {
        let config = Config { seq_base: 100_000, ..Config::default() };
        self.controller = Controller::new(config);
        self.controller.connected(self.now);
        self.drain();
    }

    /// Kills the controller. Messages that it has sent are still delivered.
    pub fn kill_controller(&mut self) {
        self.is_killed = true;
    }

    /// Starts another controller with the journal of the killed one. Returns whether the journal held a run.
    pub fn return_controller(&mut self, on_return: OnReturn) -> bool {
        self.is_killed = false;
        let config = Config { seq_base: 100_000, ..Config::default() };
        self.controller = Controller::new(config);
        self.controller.keep_journal();
        let unfinished = UnfinishedRun::read(&self.journal).unwrap();
        if let Some(run) = &unfinished {
            self.controller.take_up(self.now, run, on_return).unwrap();
        }
        self.controller.connected(self.now);
        self.drain();
        unfinished.is_some()
    }

    pub fn operate(&mut self, operation: Operation) -> Result<(), Refusal> {
        let done = self.controller.operate(self.now, operation);
        self.drain();
        done
    }

    pub fn play(&mut self) {
        self.operate(Operation::Play { from: 0, missing: MissingPolicy::Refuse }).unwrap();
    }

    /// Gives the controller a message as if the broker had delivered it.
    pub fn inject(&mut self, topic: &str, payload: &[u8]) {
        self.controller.message(self.now, topic, payload);
        self.drain();
    }

    fn drain(&mut self) {
        while let Some(job) = self.controller.next_plan_request() {
            self.budgets.push(job.budget());
            let is_over = job.budget().is_some() && self.slow_plans > 0;
            self.slow_plans -= usize::from(is_over);
            self.controller.planned(self.now, job.run_unless(&|| is_over));
        }
        while let Some(send) = self.controller.next_send() {
            self.post(send.topic, send.payload, false);
        }
        while let Some(event) = self.controller.next_event() {
            self.events.push(event);
        }
        self.write_journal();
    }

    fn write_journal(&mut self) {
        let Some(piece) = self.controller.take_journal(ComputerTime { wall_us: self.now.0, uptime: None })
        else {
            return;
        };
        if piece.begins {
            self.journal.clear();
            self.journal_ends.clear();
        }
        self.journal.extend(piece.bytes);
        self.journal_ends.push(self.journal.len());
    }

    fn post(&mut self, topic: Topic, payload: Vec<u8>, to_controller: bool) {
        if !self.linked || (self.mute && !to_controller) || self.dice.below(100) < self.loss {
            return;
        }
        let delay_ms = self.delay_ms.0 + self.dice.below(self.delay_ms.1 + 1);
        let due = self.now + Span::from_millis(delay_ms as i64);
        self.letters.push(Letter { due, topic, payload, to_controller });
    }

    /// The undelivered messages to robots, in the order in which they were sent.
    pub fn to_robots(&self) -> Vec<String> {
        let to_robots = self.letters.iter().filter(|letter| !letter.to_controller);
        to_robots.map(|letter| String::from_utf8_lossy(&letter.payload).into_owned()).collect()
    }

    pub fn step(&mut self) {
        self.now += STEP;
        let (due, later) =
            std::mem::take(&mut self.letters).into_iter().partition(|l| l.due <= self.now && !self.frozen);
        self.letters = later;
        for letter in Vec::from_iter::<Vec<Letter>>(due) {
            self.deliver(letter);
        }
        for index in 0..self.robots.len() {
            self.robots[index].step(self.now, STEP);
            for (topic, payload) in self.robots[index].take_said() {
                if !self.cut.contains(&index) {
                    self.post(topic, payload, true);
                }
            }
        }
        if !self.is_killed && self.controller.wake_at().is_some_and(|at| at <= self.now) {
            self.controller.wake(self.now);
            self.drain();
        }
        self.measure();
    }

    fn deliver(&mut self, letter: Letter) {
        if letter.to_controller && self.is_killed {
            return;
        }
        if letter.to_controller {
            self.controller.message(self.now, &letter.topic.write(), &letter.payload);
            self.drain();
            return;
        }
        for (index, robot) in self.robots.iter_mut().enumerate() {
            if self.deaf.contains(&index) || self.cut.contains(&index) {
                continue;
            }
            let personal = letter.topic == Topic::Robot(robot.id);
            if personal || letter.topic == Topic::Broadcast {
                robot.receive(self.now, &letter.payload, personal);
            }
        }
    }

    fn measure(&mut self) {
        for (index, a) in self.robots.iter().enumerate() {
            for b in &self.robots[index + 1..] {
                self.closest_m = self.closest_m.min(a.at.distance(b.at));
            }
        }
    }

    pub fn run_for(&mut self, seconds: f64) {
        let until = self.now + Span::from_secs(seconds);
        while self.now < until {
            self.step();
        }
    }

    /// Steps until an event matches `what`, and returns that event. Panics after `seconds`.
    pub fn run_until(&mut self, seconds: f64, what: impl Fn(&EventKind) -> bool) -> Event {
        let seen = self.events.len();
        let until = self.now + Span::from_secs(seconds);
        while self.now < until {
            self.step();
            if let Some(event) = self.events[seen..].iter().find(|event| what(&event.kind)) {
                return event.clone();
            }
        }
        panic!("nothing like that within {seconds} s:\n{}", self.story());
    }

    /// Steps until the run is over, and returns its outcome, the frames played and the dropouts.
    pub fn run_to_end(&mut self, seconds: f64) -> (RunOutcome, usize, usize) {
        match self.run_until(seconds, |kind| matches!(kind, EventKind::RunEnded { .. })).kind {
            EventKind::RunEnded { outcome, frames_played, dropouts } => (outcome, frames_played, dropouts),
            _ => unreachable!(),
        }
    }

    pub fn story(&self) -> String {
        let line = |event: &Event| format!("{:8.3} {}\n", event.at.as_secs(), event.kind);
        self.events.iter().map(line).collect()
    }

    /// The frames that robots have reached, in order.
    pub fn stood(&self) -> Vec<usize> {
        let frame = |kind: &EventKind| match kind {
            EventKind::FrameReached { frame, .. } => Some(*frame),
            _ => None,
        };
        self.events.iter().filter_map(|event| frame(&event.kind)).collect()
    }

    pub fn count(&self, what: impl Fn(&EventKind) -> bool) -> usize {
        self.events.iter().filter(|event| what(&event.kind)).count()
    }

    /// The number of pixels of a frame that have a robot of their colour on them.
    pub fn lit(&self, frame: &Frame) -> usize {
        let shown = |pixel: &&Pixel| {
            self.robots.iter().any(|robot| robot.at.distance(pixel.at) < 0.021 && robot.light == pixel.color)
        };
        frame.pixels.iter().filter(shown).count()
    }
}

/// A frame of robots in rows, turned and shifted by its number. Each pixel has its own colour.
pub fn frame(number: usize, count: usize, air_time_s: f64) -> Frame {
    let columns = (count as f64).sqrt().ceil() as usize;
    let turn = Vec2::unit(number as f64 * 0.7);
    let pixel = |i: usize| {
        let x = (i % columns) as f64 - (columns - 1) as f64 / 2.0;
        let y = (i / columns) as f64 - (columns - 1) as f64 / 2.0;
        let at = (turn * x + turn.left() * y) * (0.16 + 0.02 * (number % 3) as f64);
        Pixel {
            id: i as u32,
            at,
            color: Rgb::new(10 + i as u8, 100, (number * 20) as u8),
            ..Pixel::default()
        }
    };
    Frame {
        name: format!("frame {number}"),
        air_time_s,
        transition_s: None,
        easing: Default::default(),
        pixels: (0..count).map(pixel).collect(),
        ..Frame::default()
    }
}

pub fn show(frames: usize, count: usize, air_time_s: f64) -> Show {
    Show {
        name: "test".into(),
        stage: Stage::default(),
        identity: Identity::Any,
        starts: None,
        music: None,
        frames: (0..frames).map(|number| frame(number, count, air_time_s)).collect(),
        ..Show::default()
    }
}
