//! Progress bars: on stderr, and only on a terminal.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar for a share of work, 0 to 1, with a word about what is being done.
pub struct Bar(ProgressBar);

/// Number of steps of a bar: its resolution.
const STEPS: u64 = 1000;

impl Bar {
    /// Returns an empty bar, which is invisible if stderr is no terminal.
    pub fn new() -> Self {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
        if let Ok(style) = ProgressStyle::with_template("{bar:40.yellow/238} {percent:>3} %  {msg}") {
            bar.set_style(style.progress_chars("━━─"));
        }
        Self(bar)
    }

    /// Moves the bar to a share of the work, 0 to 1, with a word about what is being done.
    pub fn set(&self, share: f64, doing: impl Into<String>) {
        self.0.set_message(doing.into());
        self.0.set_position((share.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
