//! Light sequences (FSEQ) put onto a show of three robots.
#![no_main]

#[path = "../../crates/exchange/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;
use lightbots_show::{Frame, Pixel, Show};

fuzz_target!(|bytes: &[u8]| {
    let pixels = (0..3).map(|id| Pixel { id, ..Pixel::default() }).collect();
    let frame = Frame { air_time_s: 2.0, pixels, ..Frame::default() };
    checks::is_sequence_for(Show { frames: vec![frame], ..Show::default() }, bytes);
});
