//! Results of the script's parts.

/// Why the script cannot continue, as text for people.
pub(crate) struct Halt(pub String);

/// Result of a part of the script that may end early.
pub(crate) type Step<T = ()> = Result<T, Halt>;
