//! How long something took.

use std::time::Instant;

/// A stop-watch that a busy machine does not falsify.
pub struct Watch {
    began: Instant,
    began_cpu_ms: Option<f64>,
}

impl Watch {
    /// One that runs from now on.
    pub fn started() -> Self {
        Self { began: Instant::now(), began_cpu_ms: cpu_ms() }
    }

    /// Milliseconds by the clock on the wall.
    pub fn wall_ms(&self) -> f64 {
        self.began.elapsed().as_secs_f64() * 1e3
    }

    /// Milliseconds that this thread has computed; those by the clock where the system does not tell.
    pub fn ms(&self) -> f64 {
        cpu_ms().zip(self.began_cpu_ms).map_or_else(|| self.wall_ms(), |(after, before)| after - before)
    }
}

/// What this thread has computed so far. Linux only.
fn cpu_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e6)
}
