//! Shows of every format.
#![no_main]

#[path = "../../crates/exchange/tests/checks/mod.rs"]
mod checks;

use libfuzzer_sys::fuzz_target;
use lightbots_exchange::LIGHTBOTS;

fuzz_target!(|bytes: &[u8]| {
    checks::is_show(bytes, "a.json", &LIGHTBOTS);
});
