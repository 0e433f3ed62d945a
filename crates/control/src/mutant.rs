//! Mutants for mutation testing: mistakes made on purpose, to see whether the fault campaign (`cargo xtask simulate`)
//! finds them. Without the feature `mutants` no mistake is made.

/// A mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Mutant {
    /// HOLD is not sent to robots on routes when all are to wait on a drive.
    SkipHold = 1,
    /// The acknowledgement of the seventh participant is overlooked.
    DropAcknowledgement,
    /// A replay adds a microsecond to the show clock at each wake-up.
    ReplayOffByOne,
    /// Plans do not drive around robots that dropped out.
    ForgetDeadRobot,
    /// A run that is taken up from a journal skips the next frame.
    WrongFrameAfterRestart,
    /// When all robots are stopped outside of a run, STOP is sent once instead of several times.
    StopOnce,
    /// Silent robots drop out even if many fall silent at once, although then the link is lost.
    LinkLossIsDeath,
    /// The controller waits for ever for robots that do not become ready after a stop of all robots.
    WaitForEver,
    /// Plans do not drive around robots that do not know their place.
    ForgetLostRobot,
    /// About a fifth of the journal's entries are written without their changes.
    LoseJournalEntries,
}

impl Mutant {
    /// All mistakes, each with its name.
    pub const ALL: [(&'static str, Self); 10] = [
        ("skip-hold", Self::SkipHold),
        ("drop-acknowledgement", Self::DropAcknowledgement),
        ("replay-off-by-one", Self::ReplayOffByOne),
        ("forget-dead-robot", Self::ForgetDeadRobot),
        ("wrong-frame-after-restart", Self::WrongFrameAfterRestart),
        ("stop-once", Self::StopOnce),
        ("link-loss-is-death", Self::LinkLossIsDeath),
        ("wait-for-ever", Self::WaitForEver),
        ("forget-lost-robot", Self::ForgetLostRobot),
        ("lose-journal-entries", Self::LoseJournalEntries),
    ];

    /// Makes only this mistake from now on, in the whole process; `None`: no mistake.
    #[cfg(feature = "mutants")]
    pub fn plant(mutant: Option<Self>) {
        PLANTED.store(mutant.map_or(0, |mutant| mutant as u8), core::sync::atomic::Ordering::Relaxed);
    }

    /// Whether this mistake is being made.
    #[cfg(feature = "mutants")]
    pub(crate) fn is_planted(self) -> bool {
        PLANTED.load(core::sync::atomic::Ordering::Relaxed) == self as u8
    }

    /// Always `false`: without the feature `mutants` no mistake is made.
    #[cfg(not(feature = "mutants"))]
    pub(crate) const fn is_planted(self) -> bool {
        false
    }
}

#[cfg(feature = "mutants")]
static PLANTED: core::sync::atomic::AtomicU8 = core::sync::atomic::AtomicU8::new(0);
