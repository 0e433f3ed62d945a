//! Light sequences (FSEQ) put onto a show of three robots.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightbots_exchange::put_onto;
use lightbots_show::{Frame, Pixel, Show};

fuzz_target!(|bytes: &[u8]| {
    let pixels = (0..3).map(|id| Pixel { id, ..Pixel::default() }).collect();
    let frame = Frame { air_time_s: 2.0, pixels, ..Frame::default() };
    let mut show = Show { frames: vec![frame], ..Show::default() };
    if let Err(error) = put_onto(&mut show, bytes) {
        assert!(!error.to_string().contains('\n'), "{error}");
    }
});
