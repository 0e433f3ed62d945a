//! `picture`: the child process that decodes a picture for layers of light (`crate::layer_pictures`).

use std::io::{Read, Write, stdin, stdout};

use lightbots_make::layer_picture;

use super::guard;
use crate::failure::{Failure, Outcome};
use crate::layer_pictures::{FILE_MAX, Head};

pub fn run() -> Outcome {
    if let Some(outcome) = guard::child_outcome(true) {
        return outcome;
    }
    let watch = guard::ReadingTime::start();
    let mut file = Vec::new();
    let unread = |error: std::io::Error| Failure::input(format!("the picture cannot be read: {error}"));
    stdin().take(FILE_MAX).read_to_end(&mut file).map_err(unread)?;
    let (head, codes) = match layer_picture(&file) {
        Ok(made) => (Head { width: made.width, height: made.height, error: None }, made.codes),
        Err(error) => (Head { width: 0, height: 0, error: Some(error.message) }, Vec::new()),
    };
    let head = serde_json::to_string(&head).map_err(|error| Failure::problem(error.to_string()))?;
    let mut out = stdout().lock();
    let written = writeln!(out, "{head}").and_then(|()| out.write_all(&codes)).and_then(|()| out.flush());
    watch.decoded();
    written.map(|()| true).map_err(|error| Failure::problem(error.to_string()))
}
