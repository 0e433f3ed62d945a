//! A plan that is not wanted any more, or takes too long, is given up.

use core::fmt;

/// The planner was told to give up. There is no plan, not even a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

/// Asked in every long loop of the planner. Once it says yes it goes on saying yes: a loop that ends early leaves values
/// behind that mean nothing, and the entry points of this crate ask again before they hand any of them out.
#[derive(Clone, Copy)]
pub(crate) struct Cancel<'a>(&'a dyn Fn() -> bool);

impl<'a> Cancel<'a> {
    /// Never cancelled.
    pub const NEVER: Cancel<'static> = Cancel(&|| false);

    /// Cancelled once `is_wanted` says so, which must go on saying so.
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

/// Works until it is done or `is_wanted` says yes, however briefly.
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
