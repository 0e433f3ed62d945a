//! Compares the lights of robots with the colours of the show's layers.

use lightbots_base::{Instant, Rgb, RobotId, Span};
use lightbots_control::Controller;
use lightbots_lighting::Tolerance;
use serde::Serialize;

/// Largest time by which a light may be late or early, as the design demands.
const IN_TIME: Span = Span::from_millis(25);
/// Moments at which the colours of the layers are sampled, before (negative) and after now, in quarters of [`IN_TIME`].
const MOMENTS: [i64; 7] = [-4, -3, -1, 0, 1, 3, 4];
/// Steps of 16 ms from one comparison to the next. More frequent comparisons would slow rehearsals down.
pub(crate) const EVERY: u64 = 10;

/// Results of comparing robots' lights with the colours of layers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct LightCounts {
    /// Number of comparisons: one about every sixth of a second for each robot that the layers light at all sampled
    /// times.
    pub compared: u64,
    /// Number of comparisons in which a channel of the light was too far outside the range of that channel in the
    /// layers' colours. The colours are sampled from 25 ms before the comparison to 25 ms after it.
    pub wrong: u64,
}

/// Compares lights with layers while a show plays.
#[derive(Clone, Copy, Debug)]
pub struct LightWatch {
    counts: LightCounts,
    /// Largest allowed difference of a colour channel, in steps of the range 0 to 255.
    codes: u8,
}

impl LightWatch {
    /// Makes a comparison for lights whose records follow the layers within `tolerance`. A unit of L* counts as 3.5
    /// steps of a channel, and one more step is allowed for rounding.
    pub fn new(tolerance: Tolerance) -> Self {
        let codes = match tolerance {
            Tolerance::OneStep => 1,
            Tolerance::Lightness(units) => (3.5 * units).ceil() as u8,
        };
        Self { counts: LightCounts::default(), codes: codes.saturating_add(1) }
    }

    /// The comparisons until now.
    pub fn counts(&self) -> LightCounts {
        self.counts
    }

    /// Compares the lights of all robots at `now`, a time on the show clock. `shown` returns the light that a robot
    /// shows; `None`: the robot is left out.
    pub fn compare(&mut self, controller: &Controller, now: Instant, shown: impl Fn(RobotId) -> Option<Rgb>) {
        let moment = |part: i64| Instant(now.0.saturating_add_signed(IN_TIME.0 * part / 4));
        let wanted = MOMENTS.map(|part| controller.layered_lights(moment(part)));
        for (index, &(robot, _)) in wanted[0].iter().enumerate() {
            let colours = wanted.iter().map(|lights| lights.get(index).filter(|light| light.0 == robot));
            let Some(colours) = colours.map(|light| light.map(|light| light.1)).collect::<Option<Vec<_>>>()
            else {
                continue;
            };
            let Some(shown) = shown(robot) else { continue };
            self.counts.compared += 1;
            self.counts.wrong += u64::from(!is_among(shown, &colours, self.codes));
        }
    }
}

/// Whether each channel of `shown` is between its least and its greatest value in `colours`, or at most `codes`
/// outside.
fn is_among(shown: Rgb, colours: &[Rgb], codes: u8) -> bool {
    let channels: [fn(&Rgb) -> u8; 3] = [|colour| colour.r, |colour| colour.g, |colour| colour.b];
    channels.iter().all(|channel| {
        let low = colours.iter().map(channel).min().unwrap_or(0);
        let high = colours.iter().map(channel).max().unwrap_or(u8::MAX);
        (low.saturating_sub(codes)..=high.saturating_add(codes)).contains(&channel(&shown))
    })
}
