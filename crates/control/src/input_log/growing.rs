//! Replays a log, whole or while it grows.

use super::replaying::{HEAD_BYTES, LogError, Replay, ReplayObserver, ReplayReport, check_head};
use crate::block::Blocks;

/// Number of bytes that are replayed between two calls of `progress`.
const PIECE: usize = 1 << 18;

/// Replays a whole log and compares the outputs with the recorded digests. `progress` is called repeatedly with the
/// share of bytes that were replayed, 0 to 1.
pub fn replay(log: &[u8], progress: &mut dyn FnMut(f64)) -> Result<ReplayReport, LogError> {
    replay_observed(log, progress, &mut |_, _, _| {})
}

/// Like [`replay`], with an observer that is called for each step.
pub fn replay_observed(
    log: &[u8],
    progress: &mut dyn FnMut(f64),
    observe: &mut ReplayObserver<'_>,
) -> Result<ReplayReport, LogError> {
    check_head(log)?;
    let mut replay = GrowingReplay::default();
    let mut read = 0;
    for piece in log.chunks(PIECE) {
        replay.feed(piece, observe)?;
        read += piece.len();
        progress(read as f64 / log.len() as f64);
        if replay.is_over() {
            break;
        }
    }
    replay.finish()
}

/// Replays a log while it is being written. A block holds about a second of inputs, so the replay is about a second
/// behind the recorded controller.
#[derive(Debug, Default)]
pub struct GrowingReplay {
    /// Bytes that were fed and are not replayed yet, because they are no whole block.
    pending: Vec<u8>,
    /// Number of bytes of the log that come before `pending`.
    read: usize,
    replay: Option<Replay>,
}

impl GrowingReplay {
    /// Whether the replay is over: the log has ended, or an output differed. Further bytes are then ignored.
    pub fn is_over(&self) -> bool {
        self.replay.as_ref().is_some_and(Replay::is_over)
    }

    /// Appends the next bytes of the log, and replays all blocks that are whole now.
    pub fn feed(&mut self, bytes: &[u8], observe: &mut ReplayObserver<'_>) -> Result<(), LogError> {
        if self.is_over() {
            return Ok(());
        }
        self.pending.extend_from_slice(bytes);
        let mut from = 0;
        if self.read == 0 {
            if self.pending.len() < HEAD_BYTES {
                return Ok(());
            }
            check_head(&self.pending)?;
            from = HEAD_BYTES;
        }
        let mut blocks = Blocks::new(&self.pending, from);
        while self.replay.as_ref().is_none_or(|replay| !replay.is_over())
            && let Some(block) = blocks.next()
        {
            match &mut self.replay {
                Some(replay) => replay.block(block, observe)?,
                None => self.replay = Some(Replay::new(block).ok_or(LogError::NoHeader)?),
            }
        }
        let whole = blocks.at();
        self.read += whole;
        self.pending.drain(..whole);
        Ok(())
    }

    /// Ends the replay and returns its report; an error if the header was not whole.
    pub fn finish(self) -> Result<ReplayReport, LogError> {
        Ok(self.replay.ok_or(LogError::NoHeader)?.report(self.read))
    }
}
