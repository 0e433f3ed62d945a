//! Whether the colours of pixels express all of a file's light.

use lightbots_base::{Rgb, Span};
use lightbots_lighting::{FrameTimes, changed};
use lightbots_show::Show;

use super::TimedShow;

/// Largest difference between two colours in a channel that counts as none, sRGB codes. It must be at least 6, because
/// linear light of eight bits makes the six darkest codes black.
const CODES: u8 = 8;
/// How much earlier or later than in the show a colour may change in the file, seconds. The file samples light at its
/// own moments.
pub(super) const EARLIER_S: f64 = 0.025;
/// Time between two comparisons of the file's light with the show's, seconds.
const STEP_S: f64 = 0.02;
/// Largest number of comparisons for all robots together. If a show needs more, the time between two is longer.
const COMPARISONS_MAX: f64 = 20e6;

/// Whether the light of a robot in the file differs from the light that `show` gives it without layers. Small
/// differences do not count, and moments between two comparisons are not seen. In `show`, a robot has the colour of its
/// pixel, and changes to the next colour at the end of a drive.
pub(super) fn differs(file: &TimedShow, show: &Show, times: &[FrameTimes]) -> bool {
    let end_s = times.last().map_or(0.0, |times| times.end_s);
    let step_s = STEP_S.max(end_s * file.robots.len() as f64 / COMPARISONS_MAX);
    file.robots.iter().enumerate().any(|(number, robot)| {
        let colour = |frame: usize| show.frames[frame].pixels[number].color;
        let mut light = robot.light.player();
        let mut frame = 0;
        (0..=(end_s / step_s) as u64).any(|step| {
            let at_s = step as f64 * step_s;
            while frame + 1 < times.len() && at_s >= times[frame].end_s {
                frame += 1;
            }
            let before = frame.checked_sub(1).map_or(Rgb::BLACK, colour);
            let FrameTimes { drive_s, air_s, .. } = times[frame];
            let (drive, since) =
                (Span::from_secs(air_s - drive_s), |at_s: f64| Span::from_secs(at_s - drive_s));
            let plain = |at_s: f64| before.mixed(colour(frame), changed(drive, since(at_s)));
            let bounds = [plain(at_s - EARLIER_S), plain(at_s), plain(at_s + EARLIER_S)];
            !is_between(light.at(at_s), bounds)
        })
    })
}

/// Whether each channel of `colour` is within the range of this channel in `others`, or at most [`CODES`] outside.
fn is_between(colour: Rgb, others: [Rgb; 3]) -> bool {
    let channels: [fn(Rgb) -> u8; 3] = [|colour| colour.r, |colour| colour.g, |colour| colour.b];
    channels.into_iter().all(|channel| {
        let codes = others.map(channel);
        let low = codes.into_iter().min().unwrap_or(0).saturating_sub(CODES);
        let high = codes.into_iter().max().unwrap_or(255).saturating_add(CODES);
        (low..=high).contains(&channel(colour))
    })
}
