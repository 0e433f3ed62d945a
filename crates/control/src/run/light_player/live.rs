//! Live light: layers that the operator puts over a running show and takes off again.

use super::{BLEND, LightPlayer};
use crate::context::Context;
use crate::leg::Leg;
use crate::run::light_leg::PlannedStretch;
use crate::run::roster::Roster;
use lightbots_base::{Instant, Span};
use lightbots_lighting::LiveLayers;

/// Largest number of layers of live light at once.
pub(crate) const LIVE_MAX: usize = 8;
/// Largest number of characters in the name of a layer of live light.
pub(crate) const NAME_MAX: usize = 64;
/// Least time between two changes of live light that are sent to robots. Quick taps on the operator's pads then do not
/// fill the link.
const CHANGE_EVERY: Span = Span::from_millis(100);

impl LightPlayer {
    /// The layers of live light that are on.
    pub fn live(&self) -> &LiveLayers {
        &self.live
    }

    /// Replaces the live light over the show. Robots that understand stretches of light follow within about 0.3 s.
    /// `leg` is the leg that robots drive or drove last; `None` before the first one.
    pub fn set_live(
        &mut self,
        context: &mut Context,
        (roster, leg): (&Roster, Option<&Leg>),
        now: Instant,
        live: LiveLayers,
    ) {
        self.live = live;
        for light in self.current.iter_mut().chain(&mut self.next) {
            light.layers.live = self.live.layers().clone();
        }
        if !std::mem::replace(&mut self.was_live, true)
            && self.show.is_empty()
            && let Some(leg) = leg
        {
            self.colours_at = now;
            self.set_lights(context, roster, leg);
        }
        // If an earlier change has yet to be sent, one message sends both.
        self.renew_at = self.renew_at.min(now.max(self.renewed_at + CHANGE_EVERY));
    }

    /// Ends live light with the show: robots blend to the light of their frame. Does nothing without live light.
    pub fn end_live(&mut self, context: &mut Context, roster: &Roster, now: Instant, leg: &Leg) {
        if self.live.is_empty() {
            return;
        }
        self.live = LiveLayers::default();
        let Some(current) = &mut self.current else { return };
        current.layers.live = self.live.layers().clone();
        let Some(elapsed) = current.elapsed(now) else { return };
        let number = context.number_route();
        let stretch = PlannedStretch { number, from: elapsed, ticks: 1, over: BLEND, free_at: None };
        for (participant, known) in roster.active() {
            if roster.robot(context, participant).reported.abilities.light
                && let Some(robot) = current.driven(leg, None, participant)
            {
                let command = current.command(&context.config, &self.show, &robot, &stretch, now);
                context.send(known.robot, &[command]);
            }
        }
    }
}
