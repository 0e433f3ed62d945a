//! Charts as SVG. Colours are classes of the page's style sheet.

use std::fmt::Write as _;

use crate::figures::ThreeFigures;
use crate::model::FrameFigures;

/// Width of a chart, units of the SVG. The page scales a chart to its box.
const WIDTH: f64 = 460.0;
/// Height of the highest bar of the histogram, units of the SVG.
const HEIGHT: f64 = 130.0;
/// Number of bars that the histogram aims at. The width of a bar is rounded up to 1, 2 or 5 times a power of ten, so
/// there are mostly fewer.
const BINS: usize = 14;
/// Height of a row in the chart of arrivals, which has one row per frame, units of the SVG.
const ROW: f64 = 24.0;
/// Width of the column of frames' names in the chart of arrivals, units of the SVG.
const NAMES: f64 = 110.0;
/// Largest number of rows in the chart of arrivals. Further frames are left out.
const ROWS_MAX: usize = 40;
/// Largest number of evenly chosen robots that get a dot in a row of arrivals. The latest robots get dots in addition.
const DOTS_MAX: usize = 100;
/// Number of the latest robots of a frame that always get a dot.
const LATEST: usize = 10;

/// Draws a histogram of position errors with their median and 99th percentile. Errors are in metres, the chart shows
/// millimetres.
pub(crate) fn histogram(errors_m: &[f64], figures: &ThreeFigures) -> String {
    let mut svg = String::new();
    let most = (figures.max * 1e3).max(1.0);
    let width = nice(most / BINS as f64);
    let mut bins = [0usize; BINS + 2];
    for error_m in errors_m {
        let bin = (error_m * 1e3 / width) as usize;
        bins[bin.min(BINS + 1)] += 1;
    }
    let used = bins.iter().rposition(|count| *count > 0).unwrap_or(0) + 1;
    let (highest, step) = (bins.iter().copied().max().unwrap_or(1).max(1), WIDTH / used.max(4) as f64);
    let x_of = |mm: f64| mm / width * step;
    let _ = write!(
        svg,
        "<svg viewBox=\"-4 0 {} {}\" role=\"img\" aria-label=\"Position errors at arrival: median {:.1} mm, 99 % within {:.1} mm, \
         largest {:.1} mm\">",
        WIDTH + 8.0,
        HEIGHT + 42.0,
        figures.median * 1e3,
        figures.p99 * 1e3,
        figures.max * 1e3
    );
    for (index, count) in bins.iter().enumerate().take(used).filter(|(_, count)| **count > 0) {
        let height = (HEIGHT * *count as f64 / highest as f64).max(1.5);
        let class = if (index as f64) * width >= figures.p99 * 1e3 { "bar care" } else { "bar" };
        let _ = write!(
            svg,
            "<rect class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{height:.1}\" rx=\"2\"><title>{:.1} to {:.1} mm: \
             {count}</title></rect>",
            index as f64 * step + 1.5,
            18.0 + HEIGHT - height,
            step - 3.0,
            index as f64 * width,
            (index + 1) as f64 * width,
        );
    }
    let base = 18.0 + HEIGHT;
    let _ = write!(svg, "<path class=\"axis\" d=\"M0 {base}H{WIDTH}\"/>");
    for (mm, text, class, y) in [
        (figures.median * 1e3, "median", "rule", 10.0),
        (figures.p99 * 1e3, "99 % within", "rule dash", 24.0),
    ] {
        let x = x_of(mm).min(WIDTH);
        let (anchor, beside) = if x > WIDTH * 0.6 { ("end", -5.0) } else { ("start", 5.0) };
        let _ = write!(
            svg,
            "<path class=\"{class}\" d=\"M{x:.1} {:.1}V{base}\"/><text class=\"strong\" x=\"{:.1}\" y=\"{y}\" \
             text-anchor=\"{anchor}\">{text} {mm:.1} mm</text>",
            y - 8.0,
            x + beside
        );
    }
    for mark in (0..=used).step_by(used.div_ceil(5)) {
        let (x, mm) = (mark as f64 * step, mark as f64 * width);
        let unit = if mark == 0 { " mm" } else { "" };
        let anchor = if mark == 0 { "start" } else { "middle" };
        let _ = write!(
            svg,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"{anchor}\">{}{unit}</text>",
            base + 18.0,
            short(mm)
        );
    }
    svg.push_str("</svg>");
    svg
}

/// Draws a row for each frame, in which a dot per robot shows how long after the first arrival the robot arrived. `names`
/// are the names of the frames, escaped for HTML.
pub(crate) fn arrivals(frames: &[FrameFigures], names: &[String]) -> String {
    let rows = frames.len().min(ROWS_MAX);
    let most_s = frames.iter().take(rows).map(|frame| frame.arrival_spread_s).fold(0.05, f64::max);
    let tick_s = nice(most_s / 4.0);
    let (plot, height) = (WIDTH - NAMES - 12.0, rows as f64 * ROW);
    let x_of = |at_s: f64| NAMES + at_s / most_s * plot;
    let mut svg = String::new();
    let _ = write!(
        svg,
        "<svg viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"Arrivals after the first robot, by frame; the latest {most_s:.2} s \
         after\">",
        height + 26.0
    );
    for (row, (frame, name)) in frames.iter().zip(names).take(rows).enumerate() {
        let y = row as f64 * ROW + ROW / 2.0;
        let _ = write!(
            svg,
            "<text x=\"0\" y=\"{:.1}\">{name}</text><path class=\"lane\" d=\"M{NAMES} {y}H{}\"/>",
            y + 4.0,
            WIDTH - 8.0
        );
        for (index, at_s) in dots(&frame.arrivals_s) {
            // Dots are spread over the row by their order, so that dots of the same moment are all seen.
            let y = y + ((index * 7) % 11) as f64 - 5.0;
            let class = if *at_s > 0.3 { " class=\"late\"" } else { "" };
            let _ = write!(svg, "<circle{class} cx=\"{:.1}\" cy=\"{y:.0}\" r=\"2.4\"/>", x_of(*at_s));
        }
    }
    let mut at_s = 0.0;
    while at_s <= most_s {
        let unit = if at_s == 0.0 { " s" } else { "" };
        let _ = write!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}{unit}</text>",
            x_of(at_s),
            height + 18.0,
            short(at_s)
        );
        at_s += tick_s;
    }
    svg.push_str("</svg>");
    svg
}

/// The arrivals of a row that get a dot, with their indices in `arrivals_s`, which is ascending.
fn dots(arrivals_s: &[f64]) -> impl Iterator<Item = (usize, &f64)> {
    let every = arrivals_s.len().div_ceil(DOTS_MAX).max(1);
    let latest = arrivals_s.len().saturating_sub(LATEST);
    arrivals_s.iter().enumerate().filter(move |(index, _)| index % every == 0 || *index >= latest)
}

/// The smallest number of the form 1, 2 or 5 times a power of ten that is at least `least`. It may be less by 0.1 %, so
/// that rounding errors do not matter. A `least` below 10⁻⁶ counts as that.
fn nice(least: f64) -> f64 {
    let power = 10f64.powf(least.max(1e-6).log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|times| times * power)
        .into_iter()
        .find(|nice| *nice >= least * 0.999)
        .unwrap_or(power)
}

/// A number as text with at most two decimals, without zeros at the end.
fn short(number: f64) -> String {
    let text = format!("{number:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_are_round_numbers() {
        assert_eq!([0.07, 0.1, 0.3, 13.0].map(nice), [0.1, 0.1, 0.5, 20.0]);
        assert_eq!([0.0, 0.25, 3.0, 20.0].map(short), ["0", "0.25", "3", "20"]);
    }

    #[test]
    fn a_large_fleet_shows_a_share_and_the_latest() {
        let arrivals_s: Vec<f64> = (0..1000).map(|robot| f64::from(robot) * 1e-3).collect();
        let shown: Vec<usize> = dots(&arrivals_s).map(|(index, _)| index).collect();
        assert_eq!((shown.len(), shown[1], shown.last()), (109, 10, Some(&999)));
    }

    #[test]
    fn every_error_is_in_a_bar() {
        let errors_m: Vec<f64> = (0..50).map(|error| f64::from(error) * 2e-4).collect();
        let svg = histogram(&errors_m, &ThreeFigures::of(&errors_m, 5));
        let counts = svg
            .split(" mm: ")
            .skip(1)
            .filter_map(|rest| rest.split('<').next()?.trim().parse::<usize>().ok());
        assert_eq!(counts.sum::<usize>(), 50, "{svg}");
        assert!(!histogram(&[], &ThreeFigures::default()).contains("NaN"));
    }
}
