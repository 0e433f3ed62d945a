//! The controller core and a fleet whose messages arrive at once. It records the picture on the floor in each frame.

use std::sync::Arc;

use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_control::{Config, Controller, EventKind, MissingPolicy, Operation, RunOutcome};
use lightbots_show::Show;
use lightbots_sim::{Conditions, Fleet, FleetConfig, STEP};

/// Time for robots to find the controller and its clock.
const GATHERING: Span = Span::from_millis(3_000);
/// Time from the arrival in a frame to the check of its picture. Lights have changed by then.
const LOOK: Span = Span::from_millis(400);
/// Longest duration of a scene, after which the run is cut.
const LIMIT: Span = Span::from_millis(400_000);

/// The robots on the floor when a frame is shown.
pub struct Picture {
    pub frame: usize,
    /// `[robot]`: true place in stage metres, light, and the pixel that the controller assigned.
    pub robots: Vec<(Vec2, Rgb, Option<u32>)>,
}

/// Pictures and outcome of a run.
pub struct Played {
    pub pictures: Vec<Picture>,
    /// Time from the first departure to the end of the last air time.
    pub duration: Span,
    pub outcome: Option<RunOutcome>,
    pub contacts: u64,
    pub dropouts: usize,
}

/// The controller and its fleet.
pub struct Hall {
    fleet: Fleet,
    controller: Controller,
    now: Instant,
}

impl Hall {
    pub fn new(show: &Show, starts: Vec<Vec2>, seed: u64, conditions: Conditions) -> Self {
        let config = FleetConfig { stage: show.stage.clone(), starts, seed, conditions };
        Self {
            fleet: Fleet::new(&config),
            controller: Controller::new(Config::default()),
            now: Instant::ZERO,
        }
    }

    /// The robots' names.
    pub fn ids(&self) -> Vec<RobotId> {
        self.fleet.ids()
    }

    /// Plays the show to its end.
    pub fn play(mut self, show: &Show) -> Played {
        self.controller.connected(self.now);
        self.controller
            .operate(self.now, Operation::Open(Arc::new(show.clone())))
            .expect("nothing plays yet");
        self.fleet.link(self.now, true);
        while self.now < Instant::ZERO + GATHERING {
            self.step();
            while self.controller.next_event().is_some() {}
        }
        let mut played =
            Played { pictures: Vec::new(), duration: Span::ZERO, outcome: None, contacts: 0, dropouts: 0 };
        let missing = MissingPolicy::LeaveOut;
        if let Err(refusal) = self.controller.operate(self.now, Operation::Play { from: 0, missing }) {
            played.outcome = Some(RunOutcome::Failed(refusal.to_string()));
        }
        let (mut began, mut look) = (None, None);
        while played.outcome.is_none() && self.now < Instant::ZERO + LIMIT {
            self.step();
            while let Some(event) = self.controller.next_event() {
                match event.kind {
                    EventKind::TransitionStarted { starts, .. } => _ = began.get_or_insert(starts),
                    EventKind::FrameReached { frame, .. } => look = Some((frame, event.at + LOOK)),
                    EventKind::Dropout { .. } => played.dropouts += 1,
                    EventKind::RunEnded { outcome, .. } => {
                        played.duration = began.map_or(Span::ZERO, |began| event.at - began);
                        played.outcome = Some(outcome);
                    }
                    _ => {}
                }
            }
            if let Some((frame, _)) = look.take_if(|(_, at)| self.now >= *at) {
                played.pictures.push(self.picture(frame));
            }
        }
        played.contacts = self.fleet.contacts();
        played
    }

    fn picture(&self, frame: usize) -> Picture {
        let views = self.controller.snapshot(self.now).robots;
        let pixel = |id: RobotId| views.iter().find(|view| view.id == id).and_then(|view| view.pixel);
        let there = self.fleet.poses().into_iter().zip(self.fleet.lights()).zip(self.fleet.ids());
        Picture { frame, robots: there.map(|((pose, light), id)| (pose.at, light, pixel(id))).collect() }
    }

    fn step(&mut self) {
        while let Some(at) = self.controller.wake_at().filter(|at| *at <= self.now + STEP) {
            self.now = self.now.max(at);
            self.controller.wake(self.now);
            self.talk();
            if at == self.now && self.controller.wake_at() == Some(at) {
                break;
            }
        }
        self.now = self.fleet.advance_at();
        self.fleet.advance(self.now);
        self.talk();
    }

    /// Delivers messages and plans until none is left.
    fn talk(&mut self) {
        loop {
            let mut quiet = true;
            while let Some(message) = self.fleet.next_message() {
                quiet = false;
                self.controller.message(self.now, &message.topic.write(), &message.payload);
            }
            while let Some(send) = self.controller.next_send() {
                quiet = false;
                self.fleet.receive(self.now, &send.topic.write(), &send.payload);
            }
            while let Some(job) = self.controller.next_plan_request() {
                quiet = false;
                self.controller.planned(self.now, job.run());
            }
            if quiet {
                return;
            }
        }
    }
}
