//! The light of the robot. Its own light is a colour, fades, and stretches of light: colours over time that the
//! controller sends ahead. Live light from elsewhere is shown in place of the own light. The light also blinks so that
//! people find the robot, and flashes red for faults.

use lightbots_base::{Instant, Rgb, Span};
use lightbots_wire::Fade;

use crate::light_ahead::{LightAhead, StoredTracks};
use crate::light_piece::LightPiece;
use crate::live_light::LiveLight;

/// Number of fades that can wait for their moment. If there are as many, a further fade replaces the waiting fade with
/// the latest moment.
const WAITING: usize = 4;
/// Half a period of blinking and of red flashes: 4 Hz. With a larger value, the light blinks more slowly.
const FLASH: Span = Span::from_millis(125);
/// How long a fault must last before the light shows it. With a smaller value, the light flashes at every restart of
/// the link.
const SETTLED: Span = Span::from_millis(500);
/// Time from the beginning of a group of red flashes to the beginning of the next group. It must be longer than the
/// flashes of a group take.
const TROUBLE: Span = Span::from_millis(2000);
const RED: Rgb = Rgb::new(255, 0, 0);

/// The light of a robot: the present colour, and all that will change it.
#[derive(Debug, Default)]
pub(crate) struct Light {
    /// Colour of the own light. It goes on changing while live light, blinking or flashes are shown in its place.
    shown: Rgb,
    /// Whether a fade, a stretch, live light, blinking or flashes may change the light. Otherwise the light stays at
    /// `shown`.
    busy: bool,
    /// The colour at which the running fade began, and this fade; `None` if no fade runs.
    running: Option<(Rgb, Fade)>,
    /// Fades that have not begun, in the order of their moments.
    waiting: heapless::Vec<Fade, WAITING>,
    /// Stretches of light, which are sent ahead of their time.
    pub(crate) tracks: LightAhead,
    /// Live light from elsewhere, such as a lighting desk.
    pub(crate) live: LiveLight,
    /// Begin and end of blinking, own clock.
    blink: Option<(Instant, Instant)>,
    /// When the light begins to show the present fault, own clock, and the number of flashes. `None` without a fault.
    trouble: Option<(Instant, u8)>,
}

impl Light {
    /// Sets the own light to a colour at once, and cancels all fades and stretches of light.
    pub(crate) fn set(&mut self, colour: Rgb) {
        self.shown = colour;
        self.running = None;
        self.waiting.clear();
        self.tracks.clear();
    }

    /// Adds a fade. It begins at its moment, or at once if the moment is past. `show`: the show clock. If it is
    /// unknown, the light changes to the colour of the fade at once, as by [`set`](Self::set).
    pub(crate) fn fade(&mut self, show: Option<Instant>, fade: Fade) {
        let Some(show) = show else {
            return self.set(fade.to);
        };
        let place = self.waiting.iter().position(|other| other.at > fade.at).unwrap_or(self.waiting.len());
        if self.waiting.is_full() {
            self.waiting.pop();
        }
        self.busy = true;
        // Fits: there is room, and `place` lies within what is left.
        let _ = self.waiting.insert(place.min(self.waiting.len()), fade);
        self.advance(show);
    }

    /// Blinks white from `now` on, own clock, for the time `over`.
    pub(crate) fn blink(&mut self, now: Instant, over: Span) {
        self.blink = Some((now, now + over));
        self.busy = true;
    }

    /// Sets the fault that is present at `now`, own clock. `flashes`: the number of red flashes that stand for it; 0 if
    /// there is no fault. The light shows a fault only once it has lasted for [`SETTLED`].
    pub(crate) fn report(&mut self, now: Instant, flashes: u8) {
        if flashes == 0 && !self.busy {
            return;
        }
        if self.trouble.map_or(0, |(_, said)| said) != flashes {
            self.busy = true;
            self.trouble = (flashes > 0).then_some((now + SETTLED, flashes));
        }
    }

    /// Whether the light may change without a further command.
    pub(crate) fn is_busy(&self) -> bool {
        self.busy
    }

    /// Cancels all fades that have not begun, and all stretches of light. A running fade goes on.
    pub(crate) fn stop(&mut self) {
        self.waiting.clear();
        self.tracks.clear();
    }

    /// Handles that the show clock was reset, so that moments received before are void (R30, R58 of docs/protocol.md).
    /// Waiting fades and all stretches are cancelled. A running fade ends at once in its final colour.
    pub(crate) fn forget_moments(&mut self) {
        self.waiting.clear();
        self.tracks.forget_moments();
        if let Some((_, fade)) = self.running.take() {
            self.shown = fade.to;
        }
    }

    /// Notes that a stretch or live light arrived. Steps then compute the light again.
    pub(crate) fn wake(&mut self) {
        self.busy = true;
    }

    /// Returns the colour to show at `now` of the own clock, which is `show` of the show clock. `stored`: the colours
    /// of the stretches.
    pub(crate) fn step(&mut self, now: Instant, show: Option<Instant>, stored: &StoredTracks) -> Rgb {
        if !self.busy {
            return self.shown;
        }
        if let Some(show) = show.filter(|_| self.running.is_some() || !self.waiting.is_empty()) {
            self.advance(show);
        }
        if let Some(show) = show.filter(|_| self.tracks.is_any()) {
            if !self.waiting.is_empty() && self.tracks.begins(show) {
                self.waiting.clear();
            }
            if let Some(colour) = self.tracks.step(show, self.shown, stored) {
                (self.shown, self.running) = (colour, None);
            }
        }
        self.blink.take_if(|(_, until)| now >= *until);
        let changes = self.running.is_some() || !self.waiting.is_empty() || self.tracks.is_any();
        let steady = self.live.colour(now).unwrap_or(self.shown);
        self.busy = changes || self.live.is_on() || self.blink.is_some() || self.trouble.is_some();
        let (beat, colour) = match (self.blink, self.trouble) {
            (Some((from, _)), _) => ((now - from).0 / FLASH.0, Rgb::new(255, 255, 255)),
            (None, Some((from, flashes))) if now >= from => {
                let beat = (now - from).0 % TROUBLE.0 / FLASH.0;
                if beat >= 2 * i64::from(flashes) {
                    return steady;
                }
                (beat, RED)
            }
            _ => return steady,
        };
        if beat % 2 == 0 { colour } else { Rgb::BLACK }
    }

    /// Returns the line of colours from the moment `show` on, show clock. `step` must have computed the colour of that
    /// moment before. [`LightPiece::NONE`] if no stretch plays, or if anything else may change the light.
    pub(crate) fn piece(&self, show: Option<Instant>, stored: &StoredTracks) -> LightPiece {
        let is_alone = self.running.is_none()
            && self.waiting.is_empty()
            && !self.live.is_on()
            && self.blink.is_none()
            && self.trouble.is_none();
        show.filter(|_| is_alone).map_or(LightPiece::NONE, |show| self.tracks.piece(show, stored))
    }

    /// Sets the own light to the colour that a piece showed last.
    pub(crate) fn catch_up(&mut self, shown: Rgb) {
        self.shown = shown;
    }

    fn advance(&mut self, show: Instant) {
        while self.waiting.first().is_some_and(|fade| fade.at <= show) {
            let fade = self.waiting.remove(0);
            self.run_until(fade.at);
            self.tracks.end();
            self.running = Some((self.shown, fade));
        }
        self.run_until(show);
    }

    fn run_until(&mut self, show: Instant) {
        let Some((from, fade)) = self.running else {
            return;
        };
        let share = (show - fade.at).as_secs() / fade.over.as_secs().max(1e-9);
        self.shown = from.mixed(fade.to, share);
        if share >= 1.0 || fade.over <= Span::ZERO {
            self.shown = fade.to;
            self.running = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use lightbots_base::LightRecord;
    use lightbots_wire::{LightAnchor, LightStretch, LiveColours};

    use super::*;
    use crate::light_ahead::StoredTrack;

    const WHITE: Rgb = Rgb::new(255, 255, 255);
    const NO_TRACKS: StoredTracks = [StoredTrack::EMPTY, StoredTrack::EMPTY, StoredTrack::EMPTY];

    fn fade(to: Rgb, at: u64, over: i64) -> Fade {
        Fade { to, at: Instant(at), over: Span(over) }
    }

    #[test]
    fn a_fade_begins_and_ends_by_the_show_clock() {
        let mut light = Light::default();
        light.fade(Some(Instant(0)), fade(WHITE, 1000, 1000));
        let mut at = |show| light.step(Instant(9), Some(Instant(show)), &NO_TRACKS);
        assert_eq!(at(999), Rgb::BLACK);
        assert_eq!(at(1500), Rgb::new(128, 128, 128));
        assert_eq!(at(2000), WHITE);
        assert_eq!(at(5000), WHITE);
    }

    #[test]
    fn a_later_fade_takes_over_where_the_light_is_and_a_colour_ends_all() {
        let mut light = Light::default();
        light.fade(Some(Instant(0)), fade(Rgb::BLACK, 1500, 1000));
        light.fade(Some(Instant(0)), fade(WHITE, 1000, 1000));
        assert_eq!(light.step(Instant(0), Some(Instant(1500)), &NO_TRACKS), Rgb::new(128, 128, 128));
        assert_eq!(light.step(Instant(0), Some(Instant(2000)), &NO_TRACKS), Rgb::new(64, 64, 64));
        light.set(Rgb::new(1, 2, 3));
        assert_eq!(light.step(Instant(0), Some(Instant(9000)), &NO_TRACKS), Rgb::new(1, 2, 3));
    }

    #[test]
    fn after_a_reset_of_the_show_clock_no_fade_is_left() {
        let mut light = Light::default();
        light.fade(Some(Instant(1000)), fade(WHITE, 1000, 1000));
        light.fade(Some(Instant(1000)), fade(RED, 3000, 0));
        light.forget_moments();
        assert_eq!(light.step(Instant(0), Some(Instant(0)), &NO_TRACKS), WHITE);
        assert_eq!(light.step(Instant(5000), Some(Instant(5000)), &NO_TRACKS), WHITE);
    }

    #[test]
    fn a_stretch_that_begins_ends_fades_and_a_fade_that_comes_later_ends_it() {
        let mut storage = NO_TRACKS;
        let mut light = Light::default();
        light.fade(Some(Instant(0)), fade(WHITE, 3_000_000, 0));
        let records = heapless::Vec::from_slice(&[LightRecord::Step { ticks: 900, to: RED }]);
        let anchor = LightAnchor::Moment(Instant(1_000_000));
        let stretch = LightStretch {
            number: 1,
            anchor,
            skip: Span::ZERO,
            over: Span::ZERO,
            start: Rgb::new(0, 0, 9),
            records: records.expect("one record fits"),
        };
        light.tracks.keep(&stretch, &mut storage);
        light.wake();
        let at = |light: &mut Light, now, storage| light.step(Instant(now), Some(Instant(now)), storage);
        assert_eq!(at(&mut light, 2_000_000, &storage), Rgb::new(0, 0, 9));
        assert_eq!(at(&mut light, 4_000_000, &storage), Rgb::new(0, 0, 9), "the fade was deleted");
        light.fade(Some(Instant(4_000_000)), fade(WHITE, 5_000_000, 0));
        assert_eq!(at(&mut light, 6_000_000, &storage), WHITE);
        assert_eq!(at(&mut light, 20_000_000, &storage), WHITE, "the stretch is over");
    }

    #[test]
    fn the_latest_of_too_many_fades_gives_way() {
        let mut light = Light::default();
        for n in 1..=6u8 {
            light.fade(Some(Instant(0)), fade(Rgb::new(n, 0, 0), u64::from(n) * 100, 0));
        }
        assert_eq!(light.waiting.len(), WAITING);
        assert_eq!(light.step(Instant(0), Some(Instant(350)), &NO_TRACKS), Rgb::new(3, 0, 0));
        assert_eq!(light.step(Instant(0), Some(Instant(5000)), &NO_TRACKS), Rgb::new(6, 0, 0));
    }

    #[test]
    fn without_a_clock_a_fade_is_a_switch() {
        let mut light = Light::default();
        light.fade(None, fade(WHITE, 1000, 1000));
        assert_eq!(light.step(Instant(0), None, &NO_TRACKS), WHITE);
    }

    #[test]
    fn trouble_shows_in_red_flashes_and_goes_with_its_reason() {
        let mut light = Light::default();
        light.set(Rgb::new(9, 9, 9));
        light.report(Instant(0), 2);
        let mut at = |millis: u64| light.step(Instant(millis * 1000), None, &NO_TRACKS);
        let seen = [400, 500, 625, 750, 875, 1000, 2400, 2500, 2750, 3000].map(&mut at);
        let (own, dark) = (Rgb::new(9, 9, 9), Rgb::BLACK);
        assert_eq!(seen, [own, RED, dark, RED, dark, own, own, RED, RED, own]);
        light.blink(Instant(4_500_000), Span(250_000));
        assert_eq!(
            light.step(Instant(4_500_000), None, &NO_TRACKS),
            WHITE,
            "a robot that is looked for is found"
        );
        light.report(Instant(6_400_000), 2);
        assert_eq!(light.step(Instant(6_500_000), None, &NO_TRACKS), RED);
        light.report(Instant(6_510_000), 0);
        assert_eq!(light.step(Instant(6_520_000), None, &NO_TRACKS), own);
    }

    #[test]
    fn the_own_light_goes_on_beneath_light_from_elsewhere_and_trouble_shows_over_it() {
        let mut light = Light::default();
        light.live.give_slot(0);
        let colours = heapless::Vec::from_slice(&[RED]).expect("one colour fits");
        light.live.receive(Instant(0), &LiveColours { number: 1, first: 0, colours });
        light.wake();
        light.fade(Some(Instant(0)), fade(WHITE, 1000, 1000));
        let at = |light: &mut Light, now| light.step(Instant(now), Some(Instant(now)), &NO_TRACKS);
        assert_eq!([0, 1500].map(|now| at(&mut light, now)), [RED, RED]);
        light.blink(Instant(2000), Span(250_000));
        assert_eq!([2000, 252_000].map(|now| at(&mut light, now)), [WHITE, RED]);
        assert_eq!(at(&mut light, 2_500_000), WHITE, "the fade ended meanwhile");
        assert!(!light.is_busy());
    }

    #[test]
    fn blinking_ends_and_leaves_the_colour() {
        let mut light = Light::default();
        light.set(Rgb::new(9, 9, 9));
        light.blink(Instant(0), Span(250_000));
        assert_eq!(light.step(Instant(0), None, &NO_TRACKS), WHITE);
        assert_eq!(light.step(Instant(130_000), None, &NO_TRACKS), Rgb::BLACK);
        assert_eq!(light.step(Instant(250_000), None, &NO_TRACKS), Rgb::new(9, 9, 9));
    }
}
