//! Drawings: drawn, or refused in one line.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Err(error) = lightbots_draw::svg::draw(bytes) {
        assert!(!error.message.contains('\n') && error.message.len() < 400, "{}", error.message);
    }
});
