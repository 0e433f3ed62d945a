//! Findings of an exam.

/// Result for one rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum RuleVerdict {
    /// There was an attempt, and in all attempts the robot did what the rule demands.
    Keeps,
    /// In an attempt the robot did not do what the rule demands.
    Breaks,
    /// The robot does not have the optional ability that the rule is about.
    DoesNotKnow,
    /// The rule was not tried, for example because an earlier rule is broken or the light was not watched.
    NotTried,
    /// The rule cannot be tested by messages.
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
    /// The first successful attempts in order, at most six; for a broken rule only the first failed attempt. May be
    /// empty.
    pub tried: Vec<RuleTest>,
    /// Why the rule was not tried or cannot be tested, or which ability the robot lacks. Empty if the robot keeps or
    /// breaks the rule.
    pub why: String,
}

/// One attempt to find out whether the robot keeps a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleTest {
    /// What was sent to the robot, and under which conditions.
    pub sent: String,
    /// What the rule demands.
    pub expected: String,
    /// What the robot did, for people.
    pub came: String,
    /// Whether `came` fulfils `expected`.
    pub fits: bool,
}
