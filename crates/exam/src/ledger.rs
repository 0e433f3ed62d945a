//! Attempts and verdicts for all rules.

use crate::finding::{Finding, RuleTest, RuleVerdict};
use crate::rules::{RULES, Scope};

/// Largest number of successful attempts that are stored for a rule, to keep reports short. The first failed attempt is
/// always stored.
const ATTEMPTS_MAX: usize = 6;

#[derive(Clone, Debug, Default)]
struct Entry {
    tried: Vec<RuleTest>,
    broken: Option<RuleTest>,
    missing: Option<String>,
    excused: Option<String>,
}

/// One entry for each rule, in the order of the rules' numbers.
#[derive(Debug)]
pub(crate) struct Ledger(Vec<Entry>);

impl Ledger {
    /// Entries without attempts.
    pub fn new() -> Self {
        Self(vec![Entry::default(); RULES.len()])
    }

    /// Adds an attempt.
    pub fn note(&mut self, rule: u8, attempt: RuleTest) {
        let entry = &mut self.0[usize::from(rule) - 1];
        if !attempt.fits && entry.broken.is_none() {
            entry.broken = Some(attempt);
        } else if attempt.fits && entry.tried.len() < ATTEMPTS_MAX {
            entry.tried.push(attempt);
        }
    }

    /// Notes that the robot lacks the ability that a rule is about. `what`: a sentence for people that says so.
    pub fn mark_unsupported(&mut self, rule: u8, what: &str) {
        self.0[usize::from(rule) - 1].missing = Some(what.to_owned());
    }

    /// Notes why a rule cannot be tried. If there are several reasons, only the first is kept.
    pub fn mark_untried(&mut self, rule: u8, why: &str) {
        self.0[usize::from(rule) - 1].excused.get_or_insert_with(|| why.to_owned());
    }

    /// Whether the robot failed in an attempt of this rule.
    pub fn is_broken(&self, rule: u8) -> bool {
        self.0[usize::from(rule) - 1].broken.is_some()
    }

    /// One finding for each rule, in the order of the rules' numbers. `stopped`: why the script ended early; `None` if
    /// it did not.
    pub fn findings(&self, stopped: Option<&str>) -> Vec<Finding> {
        RULES
            .iter()
            .zip(&self.0)
            .map(|(rule, entry)| {
                let (verdict, why) = entry.verdict(rule.scope, stopped);
                let tried = entry.broken.clone().map_or_else(|| entry.tried.clone(), |attempt| vec![attempt]);
                Finding { rule: rule.number, title: rule.title, verdict, tried, why }
            })
            .collect()
    }
}

impl Entry {
    fn verdict(&self, scope: Scope, stopped: Option<&str>) -> (RuleVerdict, String) {
        let why = |text: &Option<String>| text.clone().unwrap_or_default();
        if let Scope::Hidden(reason) = scope {
            return (RuleVerdict::NotFromOutside, reason.to_owned());
        }
        if self.broken.is_some() {
            return (RuleVerdict::Breaks, String::new());
        }
        if self.missing.is_some() {
            return (RuleVerdict::DoesNotKnow, why(&self.missing));
        }
        if self.tried.is_empty() {
            let why = self.excused.as_deref().or(stopped).unwrap_or("nothing showed it");
            return (RuleVerdict::NotTried, why.to_owned());
        }
        (RuleVerdict::Keeps, String::new())
    }
}
