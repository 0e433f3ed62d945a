//! What each command changes.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Vec2};
use lightbots_wire::Command;

use super::Robot;
use crate::seek::Seek;
use crate::shelf::Shelf;

/// Places further out than this in a coordinate make no sense, metres.
const FAR_M: f64 = 1000.0;

impl<S: BorrowMut<Shelf>> Robot<S> {
    /// Whether it was built to understand a command.
    pub(super) fn can(&self, command: &Command) -> bool {
        let abilities = self.config.abilities;
        match command {
            Command::Target(_) | Command::Color(_) | Command::Uuid => true,
            Command::Fade(_) => abilities.fade,
            Command::Blink(_) => abilities.blink,
            _ => abilities.route,
        }
    }

    /// Does what a command says; `personal`: it came on the robot's own topic.
    pub(super) fn obey(&mut self, now: Instant, personal: bool, command: &Command) {
        match *command {
            Command::Target(goal) => self.take_target(goal),
            Command::Color(colour) => self.light.set(colour),
            Command::Uuid => self.outbox.introduce(),
            Command::Route(ref route) => {
                self.routes.keep(route, self.shelf.borrow_mut());
                self.outbox.report_status();
            }
            Command::Start { seq, at } => {
                if self.routes.start(seq, at, self.route_time(now)) || personal {
                    self.outbox.report_status();
                }
            }
            Command::Hold { at } => self.routes.note(at, true),
            Command::Resume { at } => self.routes.note(at, false),
            Command::Stop => {
                self.stop();
                self.light.forget_waiting();
            }
            Command::Time(answer) => {
                self.clock.answer(now, &answer);
                if self.clock.take_reset() {
                    self.routes.forget_moments();
                }
            }
            Command::Fade(fade) => self.light.fade(self.clock.show_time(now), fade),
            Command::Blink(blink) => self.light.blink(now, blink.over),
            Command::Status => self.outbox.report_status(),
        }
    }

    /// A target replaces whatever it does. One that is nowhere makes no sense: it stands.
    fn take_target(&mut self, goal: Vec2) {
        self.routes.clear();
        let makes_sense = goal.x.abs() <= FAR_M && goal.y.abs() <= FAR_M;
        self.seek = makes_sense.then(|| Seek::new(goal));
        if !makes_sense {
            self.unknown = self.unknown.saturating_add(1);
            self.drive.halt();
        }
    }

    fn stop(&mut self) {
        self.routes.clear();
        self.seek = None;
        self.drive.halt();
        self.outbox.report_status();
    }
}
