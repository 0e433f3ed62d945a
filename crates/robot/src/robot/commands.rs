//! Handling of commands: what each of them changes.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Command, Route};

use super::state::Robot;
use crate::seek::Seek;
use crate::storage::RouteStorage;

/// A `STOP at` command stops the robot at once if it would bring the robot to rest only this long after it was
/// received, or later. With a smaller value, that happens on slow links too. With a larger value, a wrong moment lets
/// robots drive on for longer.
const LATEST_STOP: Span = Span::from_millis(2000);
/// Largest valid absolute coordinate of a target, metres. It only has to exclude numbers that no floor reaches. With a
/// larger value, a robot drives off after a target that was garbled.
const FAR_M: f64 = 1000.0;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// Whether the robot has the ability that a command needs.
    pub(super) fn can(&self, command: &Command) -> bool {
        let abilities = self.config.abilities;
        match command {
            Command::Target(_) | Command::Color(_) | Command::Uuid => true,
            Command::Fade(_) => abilities.fade,
            Command::Blink(_) => abilities.blink,
            Command::Light(_) => abilities.light,
            Command::Slot(_) | Command::Live(_) | Command::Release(_) => abilities.live,
            _ => abilities.route,
        }
    }

    /// Handles a command that arrived at `now`, own clock. `personal`: whether it came on the robot's own topic.
    pub(super) fn handle(&mut self, now: Instant, personal: bool, command: &Command) {
        match *command {
            Command::Target(goal) => self.take_target(goal),
            Command::Color(colour) => {
                self.light.set(colour);
                self.hot.light_changes = true;
            }
            Command::Uuid => self.hot.outbox.introduce(),
            Command::Route(ref route) => {
                self.hot.routes.keep(route, self.storage.borrow_mut());
                self.hot.outbox.report_status();
            }
            Command::Start { seq, at } => {
                self.light.tracks.start(seq, at);
                if self.hot.routes.start(seq, at, self.route_time(now)) || personal {
                    self.hot.outbox.report_status();
                }
            }
            Command::Hold { at } => self.note(at, true),
            Command::Resume { at } => {
                if self.hot.stops_at.is_none() {
                    self.note(at, false);
                }
            }
            Command::Stop => self.stop(),
            Command::StopFrom { at } => self.stop_from(now, at),
            Command::Time(answer) => {
                self.clock_filter.answer(&mut self.hot.clock, now, &answer);
                if self.clock_filter.take_reset() {
                    self.hot.routes.forget_moments();
                    self.light.forget_moments();
                    self.hot.light_changes = true;
                }
            }
            Command::Fade(fade) => {
                self.light.fade(self.hot.clock.show_time(now), fade);
                self.hot.light_changes = true;
            }
            Command::Light(ref stretch) => {
                self.light.tracks.keep(stretch, &mut self.storage.borrow_mut().tracks);
                self.light.wake();
                self.hot.light_changes = true;
                self.hot.outbox.report_status();
            }
            Command::Slot(slot) => {
                self.light.live.give_slot(slot);
                self.hot.outbox.report_status();
            }
            Command::Live(ref live) => {
                if self.light.live.receive(now, live) {
                    self.light.wake();
                    self.hot.light_changes = true;
                }
            }
            Command::Release(ref release) => self.light.live.release(now, release),
            Command::Blink(blink) => {
                self.light.blink(now, blink.over);
                self.hot.light_changes = true;
            }
            Command::Status => self.hot.outbox.report_status(),
        }
    }

    fn note(&mut self, at: Instant, hold: bool) {
        self.hot.routes.note(at, hold);
        self.light.tracks.note(at, hold);
    }

    /// Discards all routes and drives to a target, stage metres. A target with a coordinate beyond [`FAR_M`], or that
    /// is NaN, is invalid: it counts as an unknown command, and the robot stops.
    fn take_target(&mut self, goal: Vec2) {
        self.hot.stops_at = None;
        self.hot.routes.clear();
        let makes_sense = goal.x.abs() <= FAR_M && goal.y.abs() <= FAR_M;
        self.hot.seek = makes_sense.then(|| Seek::new(goal));
        if !makes_sense {
            self.unknown = self.unknown.saturating_add(1);
            self.hot.drive.halt();
        }
    }

    /// Slows the route under way to rest from `at` (show clock) on, and stops once it rests. Stops at once if no route
    /// is under way or the show clock is unknown. Also stops at once if the moment of rest is past, or [`LATEST_STOP`]
    /// or more ahead.
    fn stop_from(&mut self, now: Instant, at: Instant) {
        let ends_in = self.hot.clock.show_time(now).map(|show| at + Route::EASE - show);
        match ends_in {
            Some(ends_in) if (Span::ZERO..LATEST_STOP).contains(&ends_in) && self.hot.routes.under_way() => {
                self.hot.routes.rest(at);
                self.light.tracks.note(at, true);
                self.hot.stops_at = Some(now + ends_in);
            }
            _ => self.stop(),
        }
    }

    /// Stops the robot if the moment of a `STOP at` command has come.
    pub(super) fn stop_in_time(&mut self, now: Instant) {
        if self.hot.stops_at.is_some_and(|at| now >= at) {
            self.stop();
        }
    }

    fn stop(&mut self) {
        self.hot.stops_at = None;
        self.light.stop();
        self.hot.routes.clear();
        self.hot.seek = None;
        self.hot.drive.halt();
        self.hot.outbox.report_status();
    }
}
