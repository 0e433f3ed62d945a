//! What was found about a rule.

/// Whether a robot keeps a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Everything that was tried went as the rule says.
    Keeps,
    /// Something went otherwise.
    Breaks,
    /// It does not have the ability the rule is about, and need not.
    DoesNotKnow,
    /// It could have been tried, but something before it failed or the light was not looked at.
    NotTried,
    /// No message shows it.
    NotFromOutside,
}

impl Verdict {
    /// The verdict in a word, for programs.
    pub fn word(self) -> &'static str {
        match self {
            Self::Keeps => "keeps",
            Self::Breaks => "breaks",
            Self::DoesNotKnow => "does-not-know",
            Self::NotTried => "not-tried",
            Self::NotFromOutside => "not-testable-from-outside",
        }
    }
}

/// What was found about one rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Its number in `docs/protocol.md`: 7 is R7.
    pub rule: u8,
    /// What the rule is about, in a few words.
    pub title: &'static str,
    /// Whether the robot keeps it.
    pub verdict: Verdict,
    /// What was tried, in order; of a broken rule the first thing that went wrong. Empty where nothing was.
    pub tried: Vec<Trial>,
    /// Why it was not tried, cannot be tried, or what the robot misses.
    pub why: String,
}

/// One thing that was tried.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trial {
    /// What was sent to the robot, and what happened around it.
    pub sent: String,
    /// What the rule asks for.
    pub expected: String,
    /// What came.
    pub came: String,
    /// Whether that fits.
    pub fits: bool,
}
