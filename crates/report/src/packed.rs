//! The numbers of a replay, packed for the page: half an hour with a thousand robots has a million samples.

use std::io::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use lightbots_base::varint;
use serde::Serialize;

use crate::track::{Scrub, ScrubTrack};

/// What the page's script reads before it unpacks the numbers.
#[derive(Serialize)]
struct Facts<'a> {
    floor: [f64; 2],
    radius_m: f64,
    end_s: f64,
    tolerance_m: f64,
    areas: &'a [Vec<f64>],
    /// For each robot: how many planned places, driven places and changes of light it has, and when it was lost. That
    /// time is in 1/100 s after the first departure; `None`: not lost.
    tracks: Vec<(usize, usize, usize, Option<i64>)>,
}

/// The facts of a replay as JSON.
pub(crate) fn facts(scrub: &Scrub) -> String {
    let track = |track: &ScrubTrack| {
        (track.planned.len() / 3, track.driven.len() / 3, track.light.len() / 2, track.lost)
    };
    let tracks = scrub.tracks.iter().map(track).collect();
    let Scrub { floor, radius_m, end_s, tolerance_m, ref areas, .. } = *scrub;
    serde_json::to_string(&Facts { floor, radius_m, end_s, tolerance_m, areas, tracks }).unwrap_or_default()
}

/// The numbers of all tracks, compressed with zlib (RFC 1950), in Base64. Numbers of one kind compress best together, so
/// they are in columns. The planned times of all robots come first, then their planned x, and so on. Each number is
/// written in zigzag coding, with the sign in the lowest bit. It becomes a variable-length integer with 7 bits per byte,
/// lowest bits first.
pub(crate) fn numbers(scrub: &Scrub) -> String {
    let mut bytes = Vec::new();
    let mut column = |list: &dyn Fn(&ScrubTrack) -> Vec<i64>| {
        scrub.tracks.iter().flat_map(list).for_each(|number| push(&mut bytes, number));
    };
    for at in 0..3 {
        column(&|track| track.planned.iter().skip(at).step_by(3).map(|&number| number.into()).collect());
    }
    for at in 0..3 {
        column(&|track| track.driven.iter().skip(at).step_by(3).map(|&number| number.into()).collect());
    }
    for at in 0..2 {
        column(&|track| track.light.iter().skip(at).step_by(2).copied().collect());
    }
    // Level 1: level 6 makes the page of half an hour a tenth smaller and takes three times as long.
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    // Writing to memory does not fail.
    let _ = encoder.write_all(&bytes);
    STANDARD.encode(encoder.finish().unwrap_or_default())
}

fn push(bytes: &mut Vec<u8>, number: i64) {
    varint(((number << 1) ^ (number >> 63)) as u64, &mut |byte| bytes.push(byte));
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use flate2::read::ZlibDecoder;

    use super::*;

    #[test]
    fn numbers_stand_by_columns() {
        let track = |first: i32| ScrubTrack {
            planned: vec![first, 2, -3, 400, 5, -60_000],
            driven: vec![7, 8, 9],
            light: vec![10, 0xff_ff_ff],
            lost: Some(11),
        };
        let scrub = Scrub { tracks: vec![track(1), track(-1)], ..Scrub::default() };
        assert!(facts(&scrub).ends_with(r#""tracks":[[2,1,1,11],[2,1,1,11]]}"#), "{}", facts(&scrub));

        let packed = STANDARD.decode(numbers(&scrub)).unwrap();
        let mut bytes = Vec::new();
        ZlibDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();
        let mut read = Vec::new();
        let mut bytes = bytes.iter();
        while bytes.len() > 0 {
            let (mut number, mut shift) = (0u64, 0);
            for &byte in bytes.by_ref() {
                number |= u64::from(byte & 0x7f) << shift;
                shift += 7;
                if byte < 0x80 {
                    break;
                }
            }
            read.push((number >> 1) as i64 ^ -((number & 1) as i64));
        }
        let planned = [1, 400, -1, 400, 2, 5, 2, 5, -3, -60_000, -3, -60_000];
        let driven = [7, 7, 8, 8, 9, 9];
        let light = [10, 10, 0xff_ff_ff, 0xff_ff_ff];
        assert_eq!(read, [&planned[..], &driven, &light].concat());
    }
}
