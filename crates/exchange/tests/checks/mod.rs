//! Properties of every file that is read, for mutations here and for the fuzzers in `fuzz`.
#![allow(dead_code)] // Each uses a part of it.

use lightbots_exchange::{Format, put_onto, read};
use lightbots_show::{Show, back_rows, validate};

/// Whether a file is a show. A show is validated, written in `format` and read again. A refusal must be one line.
pub fn is_show(bytes: &[u8], name: &str, format: &Format) -> bool {
    match read(bytes, Some(name)) {
        Ok(loaded) => {
            let lines = validate(&loaded.show);
            assert!(lines.iter().chain(&loaded.issues).all(|issue| !issue.message.contains('\n')));
            back_rows(&loaded.show.stage, 5);
            let again = read(&format.write(&loaded.show, None).bytes, None).expect("what we write we read");
            assert_eq!(again.show.frames.len(), loaded.show.frames.len());
            true
        }
        Err(error) => {
            let line = error.to_string();
            assert!(!line.contains('\n') && line.len() < 400, "{line}");
            false
        }
    }
}

/// Whether a file is a light sequence that fits the show. A refusal must be one line.
pub fn is_sequence_for(mut show: Show, bytes: &[u8]) -> bool {
    let put = put_onto(&mut show, bytes);
    put.inspect_err(|error| assert!(!error.to_string().contains('\n'), "{error}")).is_ok()
}
