//! A planned show as VVIZ. Readers add up steps, so places are rounded and not steps.

use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Issues, Show};

use crate::format::Written;
use crate::json::text::{lines, quoted};
use crate::limits::MAX_BYTES;
use crate::timed::export::{self, ExportedRobot, ExportedShow, SAMPLE, sampled_note, written};

/// Units per metre to which places are rounded: hundredths of a millimetre.
const UNITS_PER_M: f64 = 1e5;
/// Number of decimals of a place in metres, as [`UNITS_PER_M`] implies.
const PLACE_DECIMALS: usize = 5;
/// Number of frames of colour in a second: one every [`SAMPLE`].
const COLOUR_RATE: i64 = 1_000_000 / SAMPLE.0;

pub(crate) fn encode(show: &Show, plan: Option<&ShowPlan>) -> Written {
    written(show, plan, |exported| document(show, exported))
}

fn document(show: &Show, exported: &ExportedShow) -> Result<(Vec<u8>, Issues), Issue> {
    let performances = exported.robots.iter().enumerate().map(|(number, robot)| performance(number, robot));
    let text = format!(
        "{{\"version\":\"1.0\",\"performanceName\":{},\"coordinateFrame\":\"ogl\",\"defaultPositionRate\":10.0,\
         \"defaultColorRate\":{COLOUR_RATE}.0,\"timeOffsetSecs\":0.0,\"performances\":{}}}\n",
        quoted(&show.name),
        lines(performances, "")
    );
    if text.len() > MAX_BYTES {
        let mib = MAX_BYTES >> 20;
        let what = format!("the show has more than {mib} MiB as VVIZ; export a part of it");
        return Err(Issue::error("too-big", what));
    }
    let note =
        sampled_note("curves become lines within half a millimetre, and each colour is held for 20 ms");
    Ok((text.into_bytes(), vec![note]))
}

fn performance(number: usize, robot: &ExportedRobot) -> String {
    let start = units(robot.path.start);
    let mut before = (Span::ZERO, start);
    let mut steps = Vec::new();
    for (at, place) in export::lines(&robot.path) {
        let place = units(place);
        let (dx, dz) = (place[0] - before.1[0], place[1] - before.1[1]);
        let (dx, dz) = (decimal(dx, PLACE_DECIMALS), decimal(dz, PLACE_DECIMALS));
        steps.push(format!("{{\"dx\":{dx},\"dy\":0,\"dz\":{dz},\"dt\":{}}}", decimal((at - before.0).0, 6)));
        before = (at, place);
    }
    let (home_x, home_z) = (decimal(start[0], PLACE_DECIMALS), decimal(start[1], PLACE_DECIMALS));
    format!(
        "{{\"id\":{number},\"agentDescription\":{{\"homeX\":{home_x},\"homeY\":0,\"homeZ\":{home_z},\"homeH\":0,\
         \"agentTraversal\":[{}]}},\"payloadDescription\":[{{\"id\":0,\"type\":\"Light\",\"payloadActions\":[{}]}}]}}",
        steps.join(","),
        actions(&robot.colours)
    )
}

/// The JSON of a light's colours. Each colour has the number of frames for which it is held.
fn actions(colours: &[Rgb]) -> String {
    // The last sample is the end of the show, after which nothing is held.
    let shown = &colours[..colours.len().saturating_sub(1).max(1).min(colours.len())];
    let action = |run: &[Rgb]| {
        let Rgb { r, g, b } = run[0];
        format!("{{\"r\":{r},\"g\":{g},\"b\":{b},\"frames\":{}}}", run.len())
    };
    let actions: Vec<String> = shown.chunk_by(|a, b| a == b).map(action).collect();
    actions.join(",")
}

/// Rounds a place to whole units, of which a metre has [`UNITS_PER_M`].
fn units(at: Vec2) -> [i64; 2] {
    [at.x, at.y].map(|metres| (metres * UNITS_PER_M).round() as i64)
}

/// Writes `value` · 10^-`decimals` exactly, without trailing zeros.
fn decimal(value: i64, decimals: usize) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let digits = format!("{:0width$}", value.unsigned_abs(), width = decimals + 1);
    let (whole, rest) = digits.split_at(digits.len() - decimals);
    let rest = rest.trim_end_matches('0');
    if rest.is_empty() { format!("{sign}{whole}") } else { format!("{sign}{whole}.{rest}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        let texts = [0, 5, -5, 100_000, 123_456, -1_200_000].map(|value| decimal(value, PLACE_DECIMALS));
        assert_eq!(texts, ["0", "0.00005", "-0.00005", "1", "1.23456", "-12"]);
    }

    #[test]
    fn colours_are_held_for_frames() {
        let colour = |code: u8| Rgb::new(code, 0, 0);
        let text = actions(&[colour(1), colour(1), colour(2), colour(2)]);
        assert_eq!(text, "{\"r\":1,\"g\":0,\"b\":0,\"frames\":2},{\"r\":2,\"g\":0,\"b\":0,\"frames\":1}");
        assert!(actions(&[colour(1)]).contains("\"frames\":1"));
    }
}
