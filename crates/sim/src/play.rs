//! The loop of a rehearsal: messages and wake-ups in order of time, and a step of the world every 16 ms.

mod breaking;
mod downlink;
mod state;
mod uplink;

use lightbots_base::{Instant, RobotId, Span};
use lightbots_control::{MissingPolicy, Operation, RobotView};
use lightbots_show::Issue;
use lightbots_wire::Topic;

use crate::light_watch;
use crate::network::Way;
use crate::options::{Progress, time_limit};
use crate::report::RehearsalReport;
use crate::world::STEP;
pub(crate) use state::Play;
use uplink::send;

/// Time since switching on that robots have to find the controller and set their clocks. Then the show begins without
/// the missing robots.
const GATHERING: Span = Span::from_millis(8_000);
/// Steps between two reports of robots' places ([`Progress::Stepped`]): about a tenth of a second.
const PLACES_EVERY: u64 = 6;
/// Steps between two additions of the world's state to the hash: about a second.
const HASH_EVERY: u64 = 64;
/// Largest number of messages and wake-ups handled between two steps of the world. Only a controller that wakes itself
/// without end reaches it; the bound ends the loop.
const ROUNDS_PER_STEP: usize = 1_000_000;

impl Play {
    /// Plays the show until it ends, or to the time limit, and returns the report. `log`: notes to write into the log
    /// of the controller's inputs; `None`: no log.
    pub fn run(
        mut self,
        log: Option<Vec<(String, String)>>,
        progress: &mut dyn FnMut(Progress<'_>),
    ) -> RehearsalReport {
        self.play(log, progress);
        self.report()
    }

    /// Plays as [`Self::run`] does, but makes no report.
    pub fn play(&mut self, log: Option<Vec<(String, String)>>, progress: &mut dyn FnMut(Progress<'_>)) {
        self.switch_on(log);
        let mut step = 0u64;
        while !self.is_over() {
            self.step();
            self.plan(progress);
            self.report_departure(progress);
            Progress::log(&self.controller.take_log(), progress);
            step += 1;
            if self.began && step.is_multiple_of(PLACES_EVERY) {
                let places = self.robots.world.places();
                progress(Progress::Stepped { at: self.now, names: &self.by_id, places });
            }
            if step.is_multiple_of(light_watch::EVERY) {
                self.compare_lights();
            }
            if step.is_multiple_of(HASH_EVERY) {
                self.robots.world.imprint(&mut self.hash);
                if self.record.began_at().is_some() {
                    self.robots.compare_clocks(self.now);
                }
                progress(self.progress());
            }
        }
        Progress::log(&self.controller.end_log(), progress);
    }

    /// Connects the controller to its broker, opens the show, and brings the robots' links up.
    fn switch_on(&mut self, log: Option<Vec<(String, String)>>) {
        if let Some(notes) = log {
            // A new controller is at rest.
            self.controller.begin_log(self.shown(), notes);
        }
        if self.crashes.are_there() {
            self.controller.keep_journal();
        }
        self.controller.connected(self.shown());
        // Opening is refused only during a run.
        let _ = self.controller.operate(self.shown(), Operation::Open(self.show.clone()));
        for robot in 0..self.robots.len() {
            self.robots.link(self.now, robot, true);
        }
        self.drain_controller();
    }

    fn compare_lights(&mut self) {
        let shown = self.shown();
        let Self { robots, by_id, lights, controller, .. } = self;
        lights.compare(controller, shown, |id| {
            let place = by_id.binary_search_by_key(&id, |entry| entry.0).ok()?;
            Some(robots.light(by_id[place].1))
        });
    }

    /// Whether the rehearsal is over: the show has ended or its time is up. In a campaign, whether all checks are done.
    fn is_over(&self) -> bool {
        match &self.invariants {
            None => self.record.is_over() || self.now >= time_limit(self.planned_s),
            Some(invariants) => invariants.are_over(self.now),
        }
    }

    /// Advances virtual time by one step of 16 ms: handles messages and wake-ups, applies what is due, moves the
    /// robots.
    fn step(&mut self) {
        let next = self.now + STEP;
        self.pass_time(next);
        self.now = next;
        self.break_robots();
        self.break_broker();
        self.break_controller();
        self.press();
        self.befall();
        let Self { robots, network, record, breakdowns, broker, forgeries, .. } = self;
        robots.step(next, &mut |robot, topic, text| {
            send(network, record, (breakdowns, broker, forgeries), next, (robot, topic, text))
        });
        for (robot, text) in self.forgeries.floods() {
            self.network.send(next, Way::ToController(robot), Topic::Status, text.into());
        }
        self.record.contacts(next, &self.robots.world);
        self.crashes.observe(next, self.robots.world.places());
        if let Some(invariants) = &mut self.invariants {
            invariants.check(next, &self.robots);
        }
        if !self.began {
            self.begin();
        }
    }

    /// Handles the messages and the controller's wake-ups that are due until `until`, in order of time.
    fn pass_time(&mut self, until: Instant) {
        for _ in 0..ROUNDS_PER_STEP {
            let wake = self.controller.wake_at().map(|at| self.clock.when(at).max(self.now));
            let wake = wake.filter(|_| !self.is_controller_away());
            let message = self.network.next_at();
            let wakes_first = wake.is_some_and(|wake| message.is_none_or(|message| wake < message));
            if wakes_first {
                let at = wake.unwrap_or(until);
                if at > until {
                    return;
                }
                self.now = at;
                self.controller.wake(self.shown());
                self.drain_controller();
            } else {
                let Some((at, message)) = self.network.next_until(until) else { return };
                self.now = at.max(self.now);
                if let Some(robot) = self.network.next_receiver() {
                    self.robots.prefetch_receiver(robot);
                }
                match message.way {
                    Way::ToRobot(robot) if self.breakdowns.is_deaf(robot) || self.broker.is_cut(robot) => {}
                    Way::ToRobot(robot) => self.hand_over(robot, message.topic, &message.payload),
                    Way::ToController(_) if self.crashes.is_gone() => {}
                    Way::ToController(robot) => {
                        self.hash.word(at.0 ^ (robot as u64) << 48);
                        self.hash.bytes(&message.payload);
                        self.controller.message(self.shown(), &message.topic.write(), &message.payload);
                        self.drain_controller();
                    }
                }
            }
        }
    }

    /// Delivers a message to a robot, and sends the answers of the robot.
    fn hand_over(&mut self, robot: usize, topic: Topic, payload: &[u8]) {
        if let Some(invariants) = &mut self.invariants {
            invariants.received(robot, self.now);
        }
        self.robots.receive(self.now, robot, topic, payload);
        let Self { robots, network, record, breakdowns, broker, forgeries, now, .. } = self;
        robots.drain_messages(robot, &mut |robot, topic, text| {
            send(network, record, (breakdowns, broker, forgeries), *now, (robot, topic, text));
        });
    }

    /// Begins the show once all robots are present and know the show clock, or after [`GATHERING`]. It looks every
    /// eighth step.
    fn begin(&mut self) {
        if !(self.now.0 / STEP.0 as u64).is_multiple_of(8) {
            return;
        }
        let robots = self.controller.snapshot(self.shown()).robots;
        // An original robot reports neither its state nor its clock.
        let is_ready = |robot: &&RobotView| {
            let reported = &robot.reported;
            reported.at.is_some() && (reported.clock_us.is_some() || reported.state.is_none())
        };
        let ready = robots.iter().filter(is_ready).count();
        let late = self.now > Instant::ZERO + GATHERING;
        if ready < self.robots.len() && !late {
            return;
        }
        self.began = true;
        let missing = if late { MissingPolicy::LeaveOut } else { MissingPolicy::Refuse };
        if let Err(refusal) = self.controller.operate(self.shown(), Operation::Play { from: 0, missing }) {
            self.record.refused(&refusal.to_string());
        }
        self.drain_controller();
    }

    /// Makes the plans that the controller requests. Planning takes no virtual time, because its duration depends on
    /// the machine.
    fn plan(&mut self, progress: &mut dyn FnMut(Progress<'_>)) {
        while let Some(job) = self.controller.next_plan_request() {
            progress(Progress::Planning);
            self.controller.planned(self.shown(), job.run());
            self.drain_controller();
            progress(self.progress());
        }
    }

    /// Reports the paths of a drive that has just begun.
    fn report_departure(&mut self, progress: &mut dyn FnMut(Progress<'_>)) {
        if !self.record.take_departure() {
            return;
        }
        let (Some(view), Some(first)) = (self.controller.paths(), self.record.began_at()) else { return };
        let number = |id: RobotId| self.by_id.binary_search_by_key(&id, |entry| entry.0);
        let number_of = |id| number(id).ok().map(|place| self.by_id[place].1);
        let paths: Vec<_> =
            view.paths.iter().filter_map(|&(id, path)| Some((number_of(id)?, path))).collect();
        let begins_s = (self.clock.when(view.began) - first).as_secs();
        progress(Progress::Departing { frame: view.frame, begins_s, paths: &paths });
    }

    fn progress(&self) -> Progress<'static> {
        let frames = self.record.frames_played();
        Progress::Playing { at_s: self.now.as_secs(), planned_s: self.planned_s, frames }
    }

    /// Makes the report of what was played.
    pub fn report(mut self) -> RehearsalReport {
        self.robots.world.imprint(&mut self.hash);
        self.hash.word(self.now.0);
        let mut report = self.record.report(self.now, &self.breakdowns, &self.robots);
        report.lights = self.lights.counts();
        report.stop_after_crash_s = self.crashes.longest_stop().map(Span::as_secs);
        (report.planned_s, report.frames) = (self.planned_s, self.show.frames.len());
        report.messages = self.network.counts();
        report.seed = self.seed;
        report.state_hash = format!("{:016x}", self.hash.finish());
        report.ok &= report.contacts == 0 && report.frames_played == report.frames;
        if !report.ok {
            let message = format!("Rehearse with seed {} to see the same run again.", self.seed);
            report.issues.push(Issue::warning("seed", message));
        }
        report
    }
}

#[cfg(test)]
#[path = "picture_tests.rs"]
mod picture_tests;
#[cfg(test)]
#[path = "play_tests.rs"]
mod tests;
