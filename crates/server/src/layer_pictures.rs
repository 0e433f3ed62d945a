//! Pictures that layers project on the floor. They are decoded in a child process, so that the program that plays a show
//! decodes no untrusted picture. Only pictures of light sequences are read in this process.
//!
//! The parent writes the file to the stdin of `lightbots picture`. The child answers on stdout with a line of JSON,
//! [`Head`], and the codes of the small picture.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{ChildStdout, Stdio};
use std::sync::{Arc, Mutex, PoisonError};

use lightbots_lighting::attach_pictures;
use lightbots_show::{Asset, AssetHash, Issues, LayerPicture, Show};
use serde::{Deserialize, Serialize};

use crate::commands::guard;

/// Largest picture file that is given to the child process, bytes. A larger file is refused.
pub const FILE_MAX: u64 = 64 << 20;
/// Longest line of [`Head`], bytes.
const HEAD_MAX: u64 = 4096;
/// Most bytes that are read of a decoded picture. Decoded pictures have fewer.
const CODES_MAX: u64 = 4 << 20;
/// Most results that are remembered, and most pixels of their pictures together. Beyond either, the oldest results are
/// forgotten.
const KNOWN_MAX: (usize, usize) = (256, 8_000_000);

/// The line that the child writes before the codes.
#[derive(Debug, Serialize, Deserialize)]
pub struct Head {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// What is wrong with the file, and what to do; `None` if it was decoded.
    pub error: Option<String>,
}

/// A decoded picture, or what is wrong with its file and what to do.
type Decoded = Result<Arc<LayerPicture>, String>;

/// Decodes pictures, one at a time, and remembers the latest results, because a show is opened again after each change.
/// Clones share the results.
#[derive(Clone, Debug, Default)]
pub struct LayerPictures(Arc<Mutex<VecDeque<(AssetHash, Decoded)>>>);

impl LayerPictures {
    /// Decodes the pictures of a show's layers and stores them in the show. `content` returns the bytes of an asset, or
    /// `None` if they are missing. Returns a warning for each file that cannot be shown.
    pub fn attach(
        &self,
        show: &mut Show,
        content: impl Fn(AssetHash, &Asset) -> Option<Arc<[u8]>>,
    ) -> Issues {
        attach_pictures(show, |hash, asset| self.decoded(hash, || content(hash, asset)))
    }

    fn decoded(&self, hash: AssetHash, content: impl Fn() -> Option<Arc<[u8]>>) -> Decoded {
        // Entries are pushed whole, so that a panic of another thread leaves no half-made ones.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, decoded)) = known.iter().find(|(other, _)| *other == hash) {
            return decoded.clone();
        }
        let missing = "its file is not in the show: choose the picture again, or open the show's archive";
        let file = content().ok_or(missing)?;
        let decoded = if lightbots_exchange::is_sequence(&file) {
            // A sequence is read in this process, as a show file is, by our own code with bounds on memory and time.
            lightbots_exchange::sequence_picture(&file).map(Arc::new)
        } else {
            by_child(&file).map_err(|error| format!("no process reads it: {error}; try again"))?
        };
        known.push_back((hash, decoded.clone()));
        let pixels = |(_, decoded): &(AssetHash, Decoded)| decoded.as_ref().map_or(0, |one| one.pixels());
        while known.len() > KNOWN_MAX.0 || known.iter().map(pixels).sum::<usize>() > KNOWN_MAX.1 {
            known.pop_front();
        }
        decoded
    }
}

/// Decodes a file in a child process. The inner error says what is wrong with the file; the outer one, that no child
/// could do it.
fn by_child(file: &[u8]) -> io::Result<Decoded> {
    if file.len() as u64 > FILE_MAX {
        return Ok(Err(format!("the file is larger than {} MB; make it smaller", FILE_MAX >> 20)));
    }
    let mut child = guard::reading_child()
        .arg("picture")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let (input, output) = (child.stdin.take(), child.stdout.take());
    let answer = std::thread::scope(|scope| {
        scope.spawn(move || {
            // A child that ends before it has read everything says why by its exit code.
            let _ = input.map(|mut input| input.write_all(file));
        });
        output.map(answer)
    });
    let status = child.wait()?;
    if let Some(why) = guard::reading_failure(status) {
        return Ok(Err(why));
    }
    answer.unwrap_or_else(|| Err(io::ErrorKind::BrokenPipe.into()))
}

/// Reads the child's result from its output.
fn answer(output: ChildStdout) -> io::Result<Decoded> {
    let mut output = BufReader::new(output);
    let (mut line, mut codes) = (String::new(), Vec::new());
    output.by_ref().take(HEAD_MAX).read_line(&mut line)?;
    output.take(CODES_MAX).read_to_end(&mut codes)?;
    let head: Head = serde_json::from_str(&line)?;
    let Head { width, height, error } = head;
    Ok(error.map_or_else(|| Ok(Arc::new(LayerPicture { width, height, codes })), Err))
}
