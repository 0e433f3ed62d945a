//! Cancellation of a plan that is not wanted any more, or takes too long.

use core::fmt;

/// The planner was cancelled. There is no plan, not even a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// Polled in every long loop of the planner. Once it says yes it goes on saying yes. A loop that ends early leaves
/// meaningless values; the entry points of this crate poll again before they return any.
#[derive(Clone, Copy)]
pub(crate) struct Cancel<'a>(&'a dyn Fn() -> bool);

impl<'a> Cancel<'a> {
    /// Never cancelled.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Cancelled once `is_wanted` says so; it must go on saying so.
    pub fn when(is_wanted: &'a dyn Fn() -> bool) -> Self {
        Self(is_wanted)
    }

    /// Whether to give up.
    pub fn is_wanted(self) -> bool {
        (self.0)()
    }
}

impl fmt::Debug for Cancel<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cancel")
    }
}

/// Works until it is done, or `is_wanted` has said yes once.
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
