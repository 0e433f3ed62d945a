//! How long something took.

// Not every example needs all of it.
#![allow(dead_code)]

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

/// Median time of work done an odd number of times, milliseconds.
pub fn median_ms(times: usize, mut work: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..times)
        .map(|_| {
            let watch = Watch::started();
            work();
            // Short work is rarely interrupted, and the processor's own account is coarse.
            let wall_ms = watch.wall_ms();
            if wall_ms > 8.0 { watch.ms() } else { wall_ms }
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[times / 2]
}

/// What this thread has computed so far. Linux only.
fn cpu_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e6)
}
