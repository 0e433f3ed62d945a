//! Fetching ahead: while one robot has its turn, memory brings the next.

use lightbots_robot::Processor;

/// The processor this runs on. Where it cannot be asked it waits for memory instead, and nothing else changes.
pub(crate) struct ThisProcessor;

impl Processor for ThisProcessor {
    #[inline]
    #[cfg(target_arch = "x86_64")]
    fn fetch<T>(&self, what: &T) {
        safe_arch::prefetch_t0(what);
    }

    #[inline]
    #[cfg(not(target_arch = "x86_64"))]
    fn fetch<T>(&self, _: &T) {}
}
