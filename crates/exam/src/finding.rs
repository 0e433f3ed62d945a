//! Findings of an exam.

/// Whether a robot keeps a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleVerdict {
    /// All attempts were as the rule demands.
    Keeps,
    /// An attempt was not as the rule demands.
    Breaks,
    /// The robot lacks the optional ability that the rule is about.
    DoesNotKnow,
    /// The rule was not tried, because an earlier rule is broken or the light was not watched.
    NotTried,
    /// No message shows whether the rule is kept.
    NotFromOutside,
}

impl RuleVerdict {
    /// Code of the verdict, for programs.
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

/// Finding for one rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Number of the rule in `docs/protocol.md`: 7 is R7.
    pub rule: u8,
    /// Subject of the rule in a few words.
    pub title: &'static str,
    /// Whether the robot keeps the rule.
    pub verdict: RuleVerdict,
    /// Attempts in order; for a broken rule only the first failed one. May be empty.
    pub tried: Vec<RuleTest>,
    /// Reason of a verdict without attempts: what was missing.
    pub why: String,
}

/// One attempt to see whether a rule is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleTest {
    /// What was sent to the robot, and under which conditions.
    pub sent: String,
    /// What the rule demands.
    pub expected: String,
    /// What was received.
    pub came: String,
    /// Whether `came` is as `expected`.
    pub fits: bool,
}
