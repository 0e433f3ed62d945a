//! A log that is played again while it grows.

use super::replaying::{HEAD_BYTES, LogError, Replay, ReplayObserver, ReplayReport, check_head};
use crate::block::Blocks;

/// Plays a log again as its bytes come, a second or so behind the controller that writes it.
#[derive(Debug, Default)]
pub struct GrowingReplay {
    /// Bytes that came and are no whole block yet.
    pending: Vec<u8>,
    /// Number of bytes before them.
    read: usize,
    replay: Option<Replay>,
}

impl GrowingReplay {
    /// Takes in the next bytes of the log, and plays all blocks that are whole.
    pub fn feed(&mut self, bytes: &[u8], observe: &mut ReplayObserver<'_>) -> Result<(), LogError> {
        self.pending.extend_from_slice(bytes);
        if self.read == 0 {
            if self.pending.len() < HEAD_BYTES {
                return Ok(());
            }
            check_head(&self.pending)?;
        }
        let from = if self.read == 0 { HEAD_BYTES } else { 0 };
        let mut blocks = Blocks::new(&self.pending, from);
        for block in blocks.by_ref() {
            match &mut self.replay {
                Some(replay) if replay.is_over() => break,
                Some(replay) => replay.block(block, observe)?,
                None => self.replay = Some(Replay::new(block).ok_or(LogError::NoHeader)?),
            }
        }
        let whole = blocks.at();
        self.read += whole;
        self.pending.drain(..whole);
        Ok(())
    }

    /// The log is over: what came of it.
    pub fn finish(self) -> Result<ReplayReport, LogError> {
        Ok(self.replay.ok_or(LogError::NoHeader)?.report(self.read))
    }
}
