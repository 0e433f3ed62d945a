//! Shows of every format: read, or refused in one line; what was read is judged, and written and read again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightbots_exchange::{LIGHTBOTS, read};
use lightbots_show::{front_rows, validate};

fuzz_target!(|bytes: &[u8]| {
    match read(bytes, Some("a.json")) {
        Ok(loaded) => {
            let found = validate(&loaded.show);
            assert!(found.iter().chain(&loaded.issues).all(|issue| !issue.message.contains('\n')));
            front_rows(&loaded.show.stage, 5);
            let written = LIGHTBOTS.write(&loaded.show, None).bytes;
            let again = read(&written, None).expect("what we write we read");
            assert_eq!(again.show.frames.len(), loaded.show.frames.len());
        }
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains('\n') && line.len() < 400, "{line}");
        }
    }
});
