//! FSEQ 2, the format of xLights and the Falcon Player: colours of all robots each few milliseconds, without places.

use std::sync::Arc;

use lightbots_plan::ShowPlan;
use lightbots_show::{Issue, Issues, Show, most_pixels};

use crate::error::ReadError;
use crate::format::{Loaded, Written};
use crate::sequence_file::{MAGIC, SequenceFile};
use crate::timed::export::{ExportedShow, SAMPLE, sampled_note, written};
use crate::timed::sequence::add_file;

/// Number of [`SAMPLE`]s from one frame of the file to the next: 2 are 40 ms, 25 frames a second.
const SAMPLES: usize = 2;
/// Largest number of bytes of colours that are written uncompressed: 1,000 robots for 3.7 minutes. A longer sequence is
/// compressed with zlib. Some readers support no compression, others only zstd (docs/exchange.md). With a larger bound,
/// files of large fleets would be many times as long.
const PLAIN_MAX: usize = 16 << 20;

/// Whether the bytes begin like a file of FSEQ.
pub fn sniff(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Always fails: a file of FSEQ alone is no show.
pub(crate) fn read(_: &[u8]) -> Result<Loaded, ReadError> {
    let what = "an FSEQ file has colours and no places: put it on a show that you have, by \
                `lightbots convert FILE.fseq OUT --onto SHOW`";
    Err(ReadError::whole("no-places", what))
}

pub(crate) fn encode(show: &Show, plan: Option<&ShowPlan>) -> Written {
    written(show, plan, |exported| Ok(file(show, exported)))
}

fn file(show: &Show, exported: &ExportedShow) -> (Vec<u8>, Issues) {
    let samples = exported.robots.first().map_or(0, |robot| robot.colours.len());
    let mut codes = Vec::new();
    for sample in (exported.first_sample.min(samples)..samples).step_by(SAMPLES) {
        for robot in &exported.robots {
            let colour = robot.colours[sample];
            codes.extend([colour.r, colour.g, colour.b]);
        }
    }
    let sequence = SequenceFile {
        step_ms: (SAMPLE.0 / 1_000) as u8 * SAMPLES as u8,
        channels: 3 * exported.robots.len(),
        codes,
        music: show.music.clone(),
    };
    let note = sampled_note(
        "the file has the colours of robots each 40 ms from the first frame on, and neither their paths nor their names",
    );
    let bytes = if sequence.codes.len() <= PLAIN_MAX { sequence.plain_bytes() } else { sequence.bytes() };
    (bytes, vec![note])
}

/// Adds the colours of an FSEQ file to a show, as a layer over all others. The file and the music begin with the air
/// time of the first frame. The file's first three channels are red, green and blue of robot 0, the next three those of
/// robot 1. A show without music gets the music that the file names. Returns a warning if the show's largest frame has
/// more pixels than the file has colours.
///
/// # Errors
/// If the bytes are no FSEQ file, or one that this program does not read.
pub fn put_onto(show: &mut Show, bytes: &[u8]) -> Result<Issues, ReadError> {
    let robots = most_pixels(show).max(1);
    let refused = |why: String| ReadError::whole("bad-fseq", format!("the file {why}"));
    let file = SequenceFile::read(bytes, 3 * robots).map_err(refused)?;
    let mut issues = Issues::new();
    if file.channels < 3 * robots {
        let what =
            format!("the file has colours for {} robots, and the show has {robots}", file.channels / 3);
        issues.push(Issue::warning("too-few-colours", what));
    }
    if show.music.is_none() {
        show.music.clone_from(&file.music);
    }
    let content: Arc<[u8]> = SequenceFile { music: None, ..file.clone() }.bytes().into();
    add_file(show, "FSEQ", content, file.step_ms, 0.0);
    Ok(issues)
}
