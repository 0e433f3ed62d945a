//! Cancellation of planning that is no longer wanted, or takes too long.

use core::fmt;

/// The planner was cancelled. There is no plan, not even a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// A cancellation that every long loop of the planner polls. Once it returns `true`, it must keep returning `true`. A
/// loop that ends early leaves meaningless values, so the entry points of this crate poll again before they return any.
#[derive(Clone, Copy)]
pub(crate) struct Cancel<'a>(&'a dyn Fn() -> bool);

impl<'a> Cancel<'a> {
    /// Never cancelled.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Cancelled once `is_wanted` returns `true`, which it must then keep returning.
    pub fn when(is_wanted: &'a dyn Fn() -> bool) -> Self {
        Self(is_wanted)
    }

    /// Whether cancellation is wanted.
    pub fn is_wanted(self) -> bool {
        (self.0)()
    }
}

impl fmt::Debug for Cancel<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cancel")
    }
}

/// Runs `work` and returns its result; `Err` if `is_wanted` returned `true` at any poll, including one after `work`.
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
