//! Everything that can come over the wire.
#![no_main]

#[path = "../../crates/wire/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    checks::read(bytes);
});
