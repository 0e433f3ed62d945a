//! Live light: a colour from elsewhere, such as a lighting desk, that is shown instead of the robot's own light (R59 to
//! R61 of docs/protocol.md).

use lightbots_base::{Instant, Rgb, Span};
use lightbots_wire::{LiveColours, LiveRelease};

use crate::light_ahead::OLD_NUMBERS;

/// After this time without a LIVE or RELEASE message for it, the robot shows its own light again and takes any number.
/// This is the network data loss timeout of ANSI E1.31-2018, 6.7.1.
const LOSS: Span = Span::from_millis(2_500);

/// Live light of a robot.
#[derive(Debug, Default)]
pub(crate) struct LiveLight {
    /// Slot of the robot: the number by which LIVE and RELEASE messages address it. `None` until it is received.
    slot: Option<u16>,
    /// Number of the newest LIVE or RELEASE message for this robot, and until when (own clock) it counts. `None` if
    /// none came yet.
    newest: Option<(u32, Instant)>,
    /// The live colour that is shown while the newest message counts. `None` if the own light is shown.
    shown: Option<Rgb>,
}

impl LiveLight {
    /// The robot's slot; `None` if it has not received one.
    pub(crate) fn slot(&self) -> Option<u16> {
        self.slot
    }

    /// Sets the robot's slot. If the slot changes, a live colour that is shown is dropped.
    pub(crate) fn give_slot(&mut self, slot: u16) {
        if self.slot.replace(slot) != Some(slot) {
            self.shown = None;
        }
    }

    /// Handles live colours that arrive at `now`, own clock. Returns whether the robot now shows one of them. Colours
    /// for other robots and old messages are ignored.
    pub(crate) fn receive(&mut self, now: Instant, live: &LiveColours) -> bool {
        let colour = self.slot.and_then(|slot| live.of(slot)).filter(|_| !self.is_old(now, live.number));
        if colour.is_some() {
            (self.newest, self.shown) = (Some((live.number, now + LOSS)), colour);
        }
        colour.is_some()
    }

    /// Handles a RELEASE that arrives at `now`, own clock. The own light is shown again if the message covers this
    /// robot's slot and is not old.
    pub(crate) fn release(&mut self, now: Instant, release: &LiveRelease) {
        if self.slot.is_some_and(|slot| release.covers(slot)) && !self.is_old(now, release.number) {
            (self.newest, self.shown) = (Some((release.number, now + LOSS)), None);
        }
    }

    /// Returns the live colour at `now`, own clock; `None` if the own light is shown.
    pub(crate) fn colour(&mut self, now: Instant) -> Option<Rgb> {
        self.shown = self.shown.filter(|_| self.counted(now).is_some());
        self.shown
    }

    /// Whether a live colour is shown instead of the own light. A colour that has become too old counts until the next
    /// call of [`colour`](Self::colour).
    pub(crate) fn is_on(&self) -> bool {
        self.shown.is_some()
    }

    /// Whether the message with this number, which arrives at `now` (own clock), is older than the newest one that
    /// counts. Messages of the same moment have the same number and are not old.
    fn is_old(&self, now: Instant, number: u32) -> bool {
        self.counted(now).is_some_and(|newest| (1..OLD_NUMBERS).contains(&newest.wrapping_sub(number)))
    }

    /// Returns the number of the newest message. `None` if no message counts at `now`, own clock: a controller that
    /// comes back may begin with any number.
    fn counted(&self, now: Instant) -> Option<u32> {
        self.newest.filter(|(_, until)| now < *until).map(|(number, _)| number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: Rgb = Rgb::new(255, 0, 0);
    const BLUE: Rgb = Rgb::new(0, 0, 255);

    fn live(number: u32, first: u16, colours: &[Rgb]) -> LiveColours {
        LiveColours { number, first, colours: heapless::Vec::from_slice(colours).expect("they fit") }
    }

    fn ms(ms: u64) -> Instant {
        Instant(ms * 1000)
    }

    #[test]
    fn it_shows_the_colour_of_its_slot() {
        let mut light = LiveLight::default();
        assert!(!light.receive(ms(0), &live(1, 0, &[RED])), "it has no slot yet");
        light.give_slot(8);
        assert!(!light.receive(ms(0), &live(1, 9, &[RED])));
        assert!(!light.receive(ms(0), &live(1, 0, &[RED; 8])));
        assert_eq!(light.colour(ms(0)), None);
        assert!(light.receive(ms(0), &live(1, 7, &[RED, BLUE])));
        assert_eq!(light.colour(ms(0)), Some(BLUE));
        light.give_slot(8);
        assert!(light.is_on(), "the same slot changes nothing");
        light.give_slot(7);
        assert_eq!(light.colour(ms(0)), None, "that colour was for slot 8");
    }

    #[test]
    fn after_a_lost_message_it_shows_the_next_and_after_silence_its_own_light() {
        let mut light = LiveLight::default();
        light.give_slot(0);
        light.receive(ms(0), &live(1, 0, &[RED]));
        // Number 2 is lost.
        light.receive(ms(100), &live(3, 0, &[BLUE]));
        assert_eq!(light.colour(ms(2_599)), Some(BLUE));
        assert_eq!(light.colour(ms(2_600)), None);
        assert!(!light.is_on());
        assert!(light.receive(ms(9_000), &live(2, 0, &[RED])), "a controller that came back counts anew");
    }

    #[test]
    fn an_old_message_changes_nothing_and_a_release_ends_it() {
        let mut light = LiveLight::default();
        light.give_slot(3);
        light.receive(ms(0), &live(u32::MAX, 3, &[RED]));
        assert!(light.receive(ms(0), &live(u32::MAX, 3, &[BLUE])), "messages of one moment have one number");
        assert!(!light.receive(ms(0), &live(u32::MAX - 1, 3, &[RED])));
        light.release(ms(0), &LiveRelease { number: u32::MAX - 63, first: 0, count: 9 });
        light.release(ms(0), &LiveRelease { number: 1, first: 0, count: 3 });
        assert_eq!(light.colour(ms(0)), Some(BLUE));
        light.release(ms(0), &LiveRelease { number: 1, first: 0, count: 4 });
        assert_eq!(light.colour(ms(0)), None);
        assert!(!light.receive(ms(0), &live(u32::MAX, 3, &[RED])), "it is older than the release");
        assert!(light.receive(ms(0), &live(2, 3, &[RED])));
    }

    #[test]
    fn a_controller_that_comes_back_after_a_release_counts_anew() {
        let mut light = LiveLight::default();
        light.give_slot(0);
        light.receive(ms(0), &live(40, 0, &[RED]));
        light.release(ms(100), &LiveRelease { number: 41, first: 0, count: 1 });
        assert!(!light.receive(ms(2_599), &live(1, 0, &[RED])), "it may be a message that was delayed");
        assert!(light.receive(ms(2_600), &live(1, 0, &[RED])));
        assert_eq!(light.colour(ms(2_600)), Some(RED));
    }
}
