//! Cancellation of planning that is no longer wanted, or takes too long.

use core::fmt;

/// The planner was cancelled: the call has no result, not even a part of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// A cancellation, polled by long loops of the planner. Once its function returns `true`, it must keep returning
/// `true`. A loop that ends early leaves meaningless values. The entry points of this crate therefore poll again before
/// they return a value.
#[derive(Clone, Copy)]
pub(crate) struct Cancel<'a>(&'a dyn Fn() -> bool);

impl<'a> Cancel<'a> {
    /// Never cancelled.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Cancelled once `is_wanted` returns `true`. From then on, `is_wanted` must keep returning `true`.
    pub fn when(is_wanted: &'a dyn Fn() -> bool) -> Self {
        Self(is_wanted)
    }

    /// Whether the planner should stop.
    pub fn is_wanted(self) -> bool {
        (self.0)()
    }
}

impl fmt::Debug for Cancel<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cancel")
    }
}

/// Runs `work` and returns its result. Returns `Err` if `is_wanted` returned `true` when `work` polled it, or after
/// `work`.
pub(crate) fn unless<T>(
    is_wanted: &dyn Fn() -> bool,
    work: impl FnOnce(Cancel<'_>) -> T,
) -> Result<T, Cancelled> {
    let has_come = core::cell::Cell::new(false);
    let latched = || {
        has_come.set(has_come.get() || is_wanted());
        has_come.get()
    };
    let done = work(Cancel::when(&latched));
    if latched() { Err(Cancelled) } else { Ok(done) }
}
