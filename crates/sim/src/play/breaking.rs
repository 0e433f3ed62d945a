//! What goes wrong in a rehearsal: breakdowns of robots, broker and controller, and mishaps, as the conditions say.

use lightbots_base::Span;
use lightbots_control::{
    Config, Controller, ControllerState, OnReturn, Operation, RecordedController, Refusal,
};
use lightbots_show::{Layer, LayerSpan, Setting};

use super::state::Play;
use crate::breakdowns::Fate;
use crate::broker_outages::BrokerEvent;
use crate::controller_crashes::CrashEvent;
use crate::mishap::Mishap;

/// Each new controller begins its route numbers this much higher than the controller before, so that no number is used
/// twice.
const SEQ_STEP: u32 = 1_000_000;

impl Play {
    /// Applies the breakdowns that are due.
    pub(super) fn break_robots(&mut self) {
        let Some(first_departure) = self.record.began_at() else { return };
        while let Some((robot, fate)) = self.breakdowns.next_until(self.now - first_departure) {
            match fate {
                Fate::Killed => self.robots.kill(robot),
                Fate::Stuck => self.robots.block_wheels(robot),
                Fate::Muted => {}
                Fate::Cut | Fate::Linked => self.robots.link(self.now, robot, fate == Fate::Linked),
                Fate::Blinded | Fate::Seeing => self.robots.blind(robot, fate == Fate::Blinded),
            }
            if let Some(invariants) = &mut self.invariants {
                invariants.broke_down(robot, fate);
            }
            self.record.broke_down(robot, self.robots.id(robot), fate, self.now);
        }
    }

    /// Applies the outages of the broker that are due.
    pub(super) fn break_broker(&mut self) {
        let Some(first_departure) = self.record.began_at() else { return };
        while let Some(event) = self.broker.next_until(self.now - first_departure) {
            match event {
                BrokerEvent::Freezes(over) => self.network.freeze(self.now + over),
                BrokerEvent::Dies => {
                    self.network.clear();
                    (0..self.robots.len()).for_each(|robot| self.robots.link(self.now, robot, false));
                    self.controller.disconnected(self.shown());
                }
                BrokerEvent::RobotBack(robot) => self.robots.link(self.now, robot, true),
                BrokerEvent::ControllerBack if self.crashes.is_gone() => {}
                BrokerEvent::ControllerBack => self.controller.connected(self.shown()),
            }
            self.drain_controller();
            self.record.broker(event, self.now);
        }
    }

    /// Kills the controller, or starts a new one that continues the run from the journal, where this is due.
    pub(super) fn break_controller(&mut self) {
        let Some(first_departure) = self.record.began_at() else { return };
        while let Some(event) = self.crashes.next_until(self.now - first_departure) {
            self.record.controller(event, self.now);
            self.crashes.watch(event, self.now, self.robots.world.places());
            match event {
                CrashEvent::Killed => {
                    self.crashes.disk.crash(self.now);
                    self.controllers += 1;
                    let config = Config { seq_base: self.controllers * SEQ_STEP, ..self.config.clone() };
                    self.controller = RecordedController::new(Controller::new(config));
                }
                CrashEvent::Back => self.start_controller(),
            }
        }
    }

    fn start_controller(&mut self) {
        self.controller.keep_journal();
        if let Some(run) = self.crashes.unfinished_run() {
            self.clock.go_on(self.now, &run);
            // A new controller has no run.
            let _ = self.controller.take_up(self.shown(), &run, OnReturn::GoOrAsk);
        } else if let Some(invariants) = &mut self.invariants {
            invariants.run_is_gone(self.now);
        }
        if !self.broker.is_controller_away() {
            self.controller.connected(self.shown());
        }
        self.drain_controller();
    }

    /// Lets the operator act: repeat operations, give GO, resume a paused show, and press Go on. The operator gives GO
    /// to a frame that is ready for it, and in the last round of a loop. While the controller's computer sleeps,
    /// nothing happens.
    pub(super) fn press(&mut self) {
        if self.clock.is_asleep(self.now) {
            return;
        }
        self.operate_again();
        let is_last_round = self.controller.loop_round().is_some_and(|round| round >= self.loop_rounds);
        let is_cue_due = self.operator.gives_go(self.now, self.controller.is_at_cue(self.shown()));
        if (is_last_round || is_cue_due) && self.controller.operate(self.shown(), Operation::Go).is_ok() {
            self.drain_controller();
        }
        let is_paused = self.controller.state() == ControllerState::Paused;
        if self.operator.resumes(self.now, is_paused)
            && self.controller.operate(self.shown(), Operation::Resume).is_ok()
        {
            self.drain_controller();
        }
        self.operator.sees(self.now, self.controller.may_go_on());
        if self.operator.presses(self.now) && self.controller.operate(self.shown(), Operation::GoOn).is_ok() {
            self.record.pressed(self.now);
            self.drain_controller();
        }
    }

    /// Lets the controller's computer sleep, with the broker on it: messages wait.
    fn sleep(&mut self, over: Span) {
        self.clock.sleep(self.now + over);
        self.network.freeze(self.now + over);
    }

    /// Restarts a robot with the name of another one.
    fn name(&mut self, robot: usize, other: usize) {
        let id = self.robots.id(other);
        self.namesakes.push((id, robot));
        self.robots.restart_as(self.now, robot, id);
    }

    /// Applies the mishaps that are due.
    pub(super) fn befall(&mut self) {
        let Some(first_departure) = self.record.began_at() else { return };
        while let Some(mishap) = self.mishaps.next_until(self.now - first_departure) {
            match mishap {
                Mishap::Stop => self.operator.does(self.now, Operation::StopAll),
                Mishap::Pause => self.operator.does(self.now, Operation::Pause),
                Mishap::Resume => self.operator.does(self.now, Operation::Resume),
                Mishap::GoTo(frame) => self.operator.does(self.now, Operation::GoTo(frame)),
                Mishap::Skip => self.operator.does(self.now, Operation::Skip),
                Mishap::Rainbow(on) => self.operator.does(self.now, rainbow(on)),
                Mishap::Off(robot) => self.robots.kill(robot),
                Mishap::On(robot) => self.robots.restart(self.now, robot),
                Mishap::Moved(robot, to) => self.robots.put_down(robot, to),
                Mishap::Lies(robot, off) => self.forgeries.lie(robot, off),
                Mishap::Floods(robot, floods) => self.forgeries.flood(robot, floods),
                Mishap::Named(robot, other) => self.name(robot, other),
                Mishap::Person(to) => self.robots.put_foot(&self.show.stage, to),
                Mishap::DiskFull(over) => self.crashes.disk.fill(self.now + over),
                Mishap::DiskSlow(over, takes) => self.crashes.disk.slow(self.now + over, takes),
                Mishap::ClockSet(by) => self.clock.set(by),
                Mishap::Sleeps(over) => self.sleep(over),
            }
            if let Some(invariants) = &mut self.invariants {
                invariants.befell(mishap, self.now);
            }
        }
    }

    /// Carries out the operations that the operator wants. Without a controller or a broker, the operator tries again
    /// later.
    fn operate_again(&mut self) {
        while let Some(operation) = self.operator.next_at(self.now) {
            let refusal = match self.is_controller_away() {
                true => Some(Refusal::NotConnected),
                false => self.controller.operate(self.shown(), operation.clone()).err(),
            };
            self.drain_controller();
            if refusal == Some(Refusal::NotConnected) {
                return self.operator.does_later(self.now, operation);
            }
        }
    }
}

/// The operation that puts a rainbow over the show, or takes it off.
fn rainbow(on: bool) -> Operation {
    let layer = Layer {
        name: String::new(),
        kind: "rainbow".into(),
        span: LayerSpan::Show,
        settings: vec![("speed_hz".into(), Setting::Number(0.4))],
    };
    Operation::LiveLight { name: "rainbow".into(), layer: on.then_some(layer) }
}
