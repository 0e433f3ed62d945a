//! Measures durations.

// Each example uses only a part of this module.
#![allow(dead_code)]

use std::time::Instant;

/// A stop-watch for processor time, which other programs on the machine hardly falsify.
pub struct Watch {
    began: Instant,
    began_cpu_ms: Option<f64>,
}

impl Watch {
    /// A stop-watch that starts now.
    pub fn started() -> Self {
        Self { began: Instant::now(), began_cpu_ms: cpu_ms() }
    }

    /// Real time since the start, milliseconds.
    pub fn wall_ms(&self) -> f64 {
        self.began.elapsed().as_secs_f64() * 1e3
    }

    /// Processor time of this thread since the start, milliseconds. Real time if the system does not report it.
    pub fn ms(&self) -> f64 {
        cpu_ms().zip(self.began_cpu_ms).map_or_else(|| self.wall_ms(), |(after, before)| after - before)
    }
}

/// Median duration of `work`, which is called `times` times (odd), milliseconds: processor time if a call takes more
/// than 8 ms, else real time.
pub fn median_ms(times: usize, mut work: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..times)
        .map(|_| {
            let watch = Watch::started();
            work();
            // Short work is rarely interrupted, and the system's account of processor time is coarse.
            let wall_ms = watch.wall_ms();
            if wall_ms > 8.0 { watch.ms() } else { wall_ms }
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[times / 2]
}

/// Processor time of this thread until now, milliseconds. `None` except on Linux.
fn cpu_ms() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e6)
}
