//! Prefetching: while one robot takes its step, the memory of the next robot is loaded into the cache.
//!
//! Prefetching changes how long a step takes and never its result. On processors other than x86-64 it does nothing.
// A prefetch takes a raw address, so its intrinsic is unsafe. Nothing else here is.
#![allow(unsafe_code)]

/// Size of a cache line of x86-64, bytes.
#[cfg(target_arch = "x86_64")]
const LINE_BYTES: usize = 64;

/// Begins to load a value into the cache, line by line. If the value begins within a line, its last bytes may not be
/// loaded.
#[inline]
#[cfg(target_arch = "x86_64")]
pub(crate) fn prefetch<T>(value: &T) {
    use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};

    let begin = core::ptr::from_ref(value).cast::<i8>();
    for offset in (0..size_of::<T>()).step_by(LINE_BYTES) {
        // SAFETY: a prefetch accesses no memory that the program can observe; the address lies within `value` besides.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(begin.wrapping_add(offset)) };
    }
}

/// Does nothing on other processors.
#[inline]
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn prefetch<T>(_: &T) {}
