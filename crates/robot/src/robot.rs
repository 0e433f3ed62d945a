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
use sense::LONGEST_STEP;
pub use state::Robot;

/// A robot farther than this from its route abandons it, metres: it is stuck, or was never where the route starts. Below,
/// robots that were led astray abandon routes they can still follow. Above, they drive far outside what the plan proved.
const GIVE_UP_M: f64 = 0.3;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// Receives a message at `now` of the own clock. Messages on other topics than `Broadcast` and the robot's own are
    /// ignored.
    pub fn receive(&mut self, now: Instant, topic: Topic, payload: &[u8]) {
        let personal = topic == Topic::Robot(self.config.id);
        if !personal && topic != Topic::Broadcast {
            return;
        }
        self.hot.now = self.hot.now.max(now);
        // The message does not undo a silence that no step could notice because the simulation stood.
        self.heed_link(now);
        let hot = &mut self.hot;
        if hot.supervisor.was_out(now) {
            hot.routes.note_outage();
        }
        hot.supervisor.receive(now);
        // A route whose moment has come is under way, even if no step saw it yet: the next one must not replace it.
        self.begin_due(self.route_time(now));
        self.end_light_piece();
        let mut commands = commands(payload);
        // Read where it was decoded: it has room for a route, and moving it would copy all of that.
        while let Some(command) = &commands.next() {
            match command {
                Ok(command) if self.can(command) => self.handle(now, personal, command),
                _ => self.unknown = self.unknown.saturating_add(1),
            }
        }
    }

    /// The link to the broker went up or down at `now`. Up: the robot introduces itself once it knows its place.
    pub fn link(&mut self, now: Instant, up: bool) {
        self.hot.now = self.hot.now.max(now);
        self.hot.supervisor.link(now, up);
        if up {
            self.clock_filter.hurry(&mut self.hot.clock, now);
            self.hot.outbox.arrive_new(now);
        }
    }

    /// One step, each 16 ms, at `now` of the own clock. Steps more than 0.1 s of the wheels' world apart are gaps: the
    /// wheels may have turned meanwhile, but nothing is planned over them.
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

    /// The light at `now` of the own clock, between steps. A shell whose light can change at any time asks each
    /// millisecond or so. The lights of a fleet then change together and not each at its next step.
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

    /// Shows the colour of the piece, if it has one for this moment.
    #[inline]
    fn piece_colour(&mut self, show: Option<Instant>) -> Option<Rgb> {
        let show = show?;
        let colour = self.hot.light_piece.colour(show)?;
        // The colour is computed again where it is needed: most steps would store it in vain.
        self.hot.piece_shown_at = show;
        Some(colour)
    }

    /// The light where no piece says it.
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

    /// A message or a fault may change the light: what was shown last is known to it then.
    fn end_light_piece(&mut self) {
        if !self.hot.light_piece.is_none() {
            self.hot.shown = self.hot.light_piece.colour(self.hot.piece_shown_at).unwrap_or(self.hot.shown);
            self.light.catch_up(self.hot.shown);
            self.hot.light_piece = LightPiece::NONE;
        }
    }

    /// How long the step took. Messages may have come in between.
    fn take_time(&mut self, now: Instant, world: Instant) -> Span {
        let hot = &mut self.hot;
        if hot.last_step.is_none() {
            hot.outbox.arrive_new(now);
        }
        let took = hot.last_step.map_or(Span::ZERO, |last| {
            // Lag that is made good at rest is no time in which wheels turned.
            let most = if hot.routes.under_way() { LONGEST_STEP } else { now - (last + hot.lag) };
            (world - last).min(most)
        });
        hot.last_step = Some(world);
        hot.now = now;
        took.clamp(Span::ZERO, LONGEST_STEP)
    }

    /// The kept route takes over where its moment has come.
    #[inline]
    fn begin_due(&mut self, route_time: Option<Instant>) {
        let Some(time) = route_time.filter(|_| self.hot.routes.keeps_one()) else { return };
        if self.hot.routes.begin_due(time, self.storage.borrow()) {
            self.hot.seek = None;
            self.reflex.begin_route();
        }
    }

    /// Ends what must not go on. A target survives being lost or blocked, as with an original robot. A route does not,
    /// because the others have driven on.
    fn supervise(&mut self, now: Instant) {
        self.stop_in_time(now);
        let drives = self.drives();
        let is_lost = self.is_lost_now();
        self.heed_link(now);
        let hot = &mut self.hot;
        if drives == Drives::Route {
            let gives_up = hot.routes.off_m().is_some_and(|off_m| off_m > GIVE_UP_M);
            // A robot that waits for fixes knows why its route runs away.
            if gives_up && !hot.pauses {
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

    /// Gives up what it drives where the link is silent for too long.
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
