//! Light of a file that the colours of pixels do not express -> a layer with one colour for each robot and moment.

use std::sync::Arc;

use lightbots_base::Rgb;
use lightbots_light::PICTURE_PIXELS_MAX;
use lightbots_lighting::FrameTimes;
use lightbots_show::{Issue, Layer, LayerSpan, Setting, Show};

use super::TimedShow;
use crate::archive::asset_of;
use crate::sequence_file::SequenceFile;

/// Times between two samples, milliseconds. The first with which all samples fit into a picture of
/// [`PICTURE_PIXELS_MAX`] pixels is used.
const STEPS_MS: [u8; 6] = [20, 25, 40, 50, 100, 200];
/// Media type of sequences among the files of a show.
const MEDIA_TYPE: &str = "application/x-fseq";

/// Adds a layer with the light of a file to `show`. If the light needs more than [`PICTURE_PIXELS_MAX`] samples, adds
/// nothing and returns a warning.
pub(super) fn add(show: &mut Show, file: &TimedShow, times: &[FrameTimes]) -> Option<Issue> {
    let first_s = times.first().map_or(0.0, |times| times.air_s);
    let end_s = times.last().map_or(0.0, |times| times.end_s);
    let rows = |step_ms: u8| (end_s * 1e3 / f64::from(step_ms)).ceil() as usize + 1;
    let fits = |step_ms: &u8| rows(*step_ms).saturating_mul(file.robots.len()) <= PICTURE_PIXELS_MAX;
    let Some(step_ms) = STEPS_MS.into_iter().find(fits) else {
        let what = "lights change while robots stand or drive, and the show is too long to keep that: only the colours \
                    of its pictures are kept; split it into several";
        return Some(Issue::warning("light-left-out", what));
    };
    let rows = rows(step_ms);
    let mut codes = vec![0; rows * 3 * file.robots.len()];
    for (number, robot) in file.robots.iter().enumerate() {
        let mut light = robot.light.player();
        for row in 0..rows {
            let Rgb { r, g, b } = light.at(row as f64 * f64::from(step_ms) / 1e3);
            let at = 3 * (row * file.robots.len() + number);
            codes[at..at + 3].copy_from_slice(&[r, g, b]);
        }
    }
    let sequence = SequenceFile { step_ms, channels: 3 * file.robots.len(), codes, music: None };
    add_file(show, "Light of the file", sequence.bytes().into(), step_ms, -first_s);
    None
}

/// Adds a layer and its file, a sequence of colours, to `show`. The first sample is shown at `start_s`, seconds from
/// the start of the first frame's air time. Later ones follow every `step_ms` milliseconds.
pub(crate) fn add_file(show: &mut Show, name: &str, content: Arc<[u8]>, step_ms: u8, start_s: f64) {
    let (hash, asset) = asset_of(&format!("{name}.fseq"), MEDIA_TYPE, content);
    show.assets.insert(hash, asset);
    show.layers.push(Layer {
        name: name.into(),
        kind: "sequence".into(),
        span: LayerSpan::Show,
        settings: vec![
            ("picture".into(), Setting::Text(hash.to_string())),
            ("step_s".into(), Setting::Number(f64::from(step_ms) / 1e3)),
            ("start_s".into(), Setting::Number(start_s)),
        ],
    });
}
