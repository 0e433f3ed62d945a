//! The robot: messages and steps in; wheel rates, light and reports out.

mod act;
mod commands;
mod reports;
mod sense;
mod state;

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Rgb, Span};
use lightbots_wire::{Topic, commands};

use crate::config::{Inputs, Outputs};
use crate::light_piece::LightPiece;
use crate::storage::RouteStorage;
use crate::supervise::Drives;
pub use reports::Message;
use sense::{AWAY_M, LONGEST_STEP};
pub use state::Robot;

/// A robot farther than this from the present place of its route abandons the route, metres. The robot is stuck, was
/// held up by an obstacle for long, or was never where the route starts. With a smaller value, robots abandon routes
/// that they can still follow. With a larger value, robots drive far away from the paths for which the plan was proved.
const GIVE_UP_M: f64 = 0.3;
/// A robot that the safety layer slowed has caught up once it is within this distance of the present place of its
/// route, metres. With a smaller value, the error of following a route counts as being behind.
const CAUGHT_UP_M: f64 = 0.02;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// Handles a message that arrives at `now`, own clock. Messages are ignored unless their topic is `Broadcast` or
    /// the robot's own topic.
    pub fn receive(&mut self, now: Instant, topic: Topic, payload: &[u8]) {
        let personal = topic == Topic::Robot(self.config.id);
        if !personal && topic != Topic::Broadcast {
            return;
        }
        self.hot.now = self.hot.now.max(now);
        // The link is checked first. A silence may have become too long while the simulation stood still and no step
        // ran.
        self.heed_link(now);
        let hot = &mut self.hot;
        if hot.supervisor.was_out(now) {
            hot.routes.note_outage();
        }
        hot.supervisor.receive(now);
        // A kept route whose start time has come begins here, even if no step has run since. The next route must not
        // replace it.
        self.begin_due(self.route_time(now));
        self.end_light_piece();
        let mut commands = commands(payload);
        // The command is read in place, because it has room for a whole route, and a move would copy all of that.
        while let Some(command) = &commands.next() {
            match command {
                Ok(command) if self.can(command) => self.handle(now, personal, command),
                _ => self.unknown = self.unknown.saturating_add(1),
            }
        }
    }

    /// Notes that the link to the broker went up or down at `now`, own clock. After the link went up, the robot
    /// introduces itself once it knows its place, at the latest after 0.5 s.
    pub fn link(&mut self, now: Instant, up: bool) {
        self.hot.now = self.hot.now.max(now);
        self.hot.supervisor.link(now, up);
        if up {
            self.clock_filter.hurry(&mut self.hot.clock, now);
            self.hot.outbox.arrive_new(now);
        }
    }

    /// Runs one step at `now`, own clock, and returns the wheel rates and the colour. The shell calls it every 16 ms.
    /// The length of the step is measured in the time of the wheels' world (see [`Inputs::lag`]), and counts as at most
    /// 0.1 s.
    pub fn step(&mut self, now: Instant, inputs: &Inputs) -> Outputs {
        let world = now - inputs.lag;
        let took = self.take_time(now, world);
        self.hot.lag = inputs.lag;
        self.sense(world, inputs, took.as_secs());
        self.hot.quality = self.hot.estimate.quality(world, self.hot.blind_after);
        let show = self.hot.clock.show_time(now);
        let route_time = show.map(|show| show - inputs.lag);
        self.begin_due(route_time);
        self.supervise(now);
        let wheels_radps = self.act(now, route_time, took);
        self.hot.is_wary = self.hot.is_wary && self.reflex.is_wary();
        self.hot.stall.command(wheels_radps);
        self.hot.state = self.current_state(route_time);
        let light = self.step_light(now, show);
        self.notice(now);
        Outputs { wheels_radps, light }
    }

    /// Returns the colour of the light at `now`, own clock, between steps. A shell that can change its light at any
    /// time calls this about every millisecond. The lights of a fleet then change within about a millisecond of each
    /// other, instead of each at its robot's next step.
    pub fn light(&mut self, now: Instant) -> Rgb {
        let show = self.hot.clock.show_time(now);
        if !self.hot.light_changes {
            return self.hot.shown;
        }
        self.piece_colour(show).unwrap_or_else(|| self.change_light(now, show))
    }

    #[inline]
    fn step_light(&mut self, now: Instant, show: Option<Instant>) -> Rgb {
        let flashes = self.trouble(now);
        if flashes > 0 {
            self.end_light_piece();
            self.hot.light_changes = true;
        }
        if !self.hot.light_changes {
            return self.hot.shown;
        }
        if let Some(colour) = self.piece_colour(show) {
            return colour;
        }
        self.light.report(now, flashes);
        self.change_light(now, show)
    }

    /// Returns the colour of the light piece at `show` of the show clock, and stores that moment. `None` if the piece
    /// does not cover the moment, or the show clock is unknown.
    #[inline]
    fn piece_colour(&mut self, show: Option<Instant>) -> Option<Rgb> {
        let show = show?;
        let colour = self.hot.light_piece.colour(show)?;
        // Only the moment is stored. `end_light_piece` computes the colour again, which most steps do not need.
        self.hot.piece_shown_at = show;
        Some(colour)
    }

    /// Computes the colour at a moment that the light piece does not cover, and replaces the piece. The new piece may
    /// be [`LightPiece::NONE`].
    #[inline(never)]
    fn change_light(&mut self, now: Instant, show: Option<Instant>) -> Rgb {
        if let Some(show) = show.filter(|_| !self.hot.light_piece.is_none())
            && let Some(piece) = self.light.tracks.next_piece(show, &self.storage.borrow().tracks)
            && let Some(colour) = piece.colour(show)
        {
            (self.hot.light_piece, self.hot.piece_shown_at) = (piece, show);
            return colour;
        }
        self.end_light_piece();
        let tracks = &self.storage.borrow().tracks;
        self.hot.shown = self.light.step(now, show, tracks);
        self.hot.light_changes = self.light.is_busy();
        self.hot.light_piece = self.light.piece(show, tracks);
        self.hot.piece_shown_at = show.unwrap_or(Instant::ZERO);
        self.hot.shown
    }

    /// Ends the light piece, if there is one, and passes the colour that it showed last to `Light`. Needed before a
    /// message or a fault changes the light.
    fn end_light_piece(&mut self) {
        if !self.hot.light_piece.is_none() {
            self.hot.shown = self.hot.light_piece.colour(self.hot.piece_shown_at).unwrap_or(self.hot.shown);
            self.light.catch_up(self.hot.shown);
            self.hot.light_piece = LightPiece::NONE;
        }
    }

    /// Returns the length of this step in the time of the wheels' world, limited to 0 to [`LONGEST_STEP`]; zero in the
    /// first step. Without a route under way, it is at most the time that passed on the own clock. Also stores the
    /// moment of this step. The first step begins the wait for the robot's introduction.
    fn take_time(&mut self, now: Instant, world: Instant) -> Span {
        let hot = &mut self.hot;
        if hot.last_step.is_none() {
            hot.outbox.arrive_new(now);
        }
        let took = hot.last_step.map_or(Span::ZERO, |last| {
            // Without a route, a lag that shrinks is no time in which wheels turned.
            let most = if hot.routes.under_way() { LONGEST_STEP } else { now - (last + hot.lag) };
            (world - last).min(most)
        });
        hot.last_step = Some(world);
        hot.now = now;
        took.clamp(Span::ZERO, LONGEST_STEP)
    }

    /// Begins the kept route if its start time has come, and ends the drive to a target. If the robot stands more than
    /// [`AWAY_M`] from the route's start, the route is abandoned at once. Beyond [`GIVE_UP_M`], `supervise` abandons
    /// it.
    #[inline]
    fn begin_due(&mut self, route_time: Option<Instant>) {
        let Some(time) = route_time.filter(|_| self.hot.routes.keeps_one()) else { return };
        if self.hot.routes.begin_due(time, self.storage.borrow()) {
            self.hot.seek = None;
            self.reflex.begin_route();
            let off_m = self.hot.routes.due().zip(self.place()).map(|(begin, at)| begin.distance(at));
            if off_m.is_some_and(|off_m| off_m > AWAY_M && off_m <= GIVE_UP_M) {
                self.hot.routes.abandon();
            }
        }
    }

    /// Ends drives that must not go on, because of a `STOP at`, an outage of the link, or an unfit robot. A robot that
    /// is lost, faulty or farther than [`GIVE_UP_M`] from its route abandons the route, because the other robots drive
    /// on. It keeps a target, as an original robot does. A distance beyond [`GIVE_UP_M`] is also a fault, unless the
    /// robot waits for fixes or for a neighbour. During a silence of the controller, also asks for the time.
    fn supervise(&mut self, now: Instant) {
        self.stop_in_time(now);
        let drives = self.drives();
        let is_lost = self.is_lost_now();
        let off_m = self.hot.routes.off_m().unwrap_or(0.0);
        let is_behind = off_m > CAUGHT_UP_M;
        self.hot.is_held_up = is_behind && (self.hot.is_held_up || self.braking_towards().is_some());
        self.heed_link(now);
        let hot = &mut self.hot;
        if drives == Drives::Route {
            let gives_up = off_m > GIVE_UP_M;
            // A robot that pauses until fixes come, or stands for an obstacle, falls behind its route: that is no
            // fault.
            if gives_up && !hot.pauses && !hot.is_held_up {
                hot.supervisor.fault(now);
            }
            if gives_up || hot.supervisor.faulty(now) || is_lost {
                hot.routes.abandon();
            }
        }
        if hot.supervisor.take_question(now, drives) {
            hot.outbox.ask_time();
        }
    }

    /// Abandons the target and the route if the link has been down for too long, or silent on a route for too long.
    fn heed_link(&mut self, now: Instant) {
        let drives = self.drives();
        let hot = &mut self.hot;
        if hot.supervisor.check_link(now, drives) {
            hot.seek = None;
            hot.routes.note_outage();
            hot.routes.abandon();
        }
    }

    fn drives(&self) -> Drives {
        let hot = &self.hot;
        if hot.routes.under_way() {
            Drives::Route
        } else if hot.routes.in_a_run() {
            Drives::Soon
        } else if hot.seek.is_some() {
            Drives::Target
        } else {
            Drives::Not
        }
    }
}
