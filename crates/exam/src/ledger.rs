//! What was found about each rule so far.

use crate::finding::{Finding, Trial, Verdict};
use crate::rules::{RULES, Scope};

/// Trials of a rule that are kept; a broken rule's first failure always is.
const TRIALS: usize = 6;

#[derive(Clone, Debug, Default)]
struct Entry {
    tried: Vec<Trial>,
    broken: Option<Trial>,
    missing: Option<String>,
    excused: Option<String>,
}

/// One entry a rule.
#[derive(Debug)]
pub(crate) struct Ledger(Vec<Entry>);

impl Ledger {
    /// Nothing is known.
    pub fn new() -> Self {
        Self(vec![Entry::default(); RULES.len()])
    }

    /// Notes something that was tried.
    pub fn note(&mut self, rule: u8, trial: Trial) {
        let entry = &mut self.0[usize::from(rule) - 1];
        if !trial.fits && entry.broken.is_none() {
            entry.broken = Some(trial);
        } else if trial.fits && entry.tried.len() < TRIALS {
            entry.tried.push(trial);
        }
    }

    /// The robot lacks what a rule is about.
    pub fn lacks(&mut self, rule: u8, what: &str) {
        self.0[usize::from(rule) - 1].missing = Some(what.to_owned());
    }

    /// A rule could not be tried.
    pub fn excuse(&mut self, rule: u8, why: &str) {
        self.0[usize::from(rule) - 1].excused.get_or_insert_with(|| why.to_owned());
    }

    /// Whether a rule was found broken.
    pub fn is_broken(&self, rule: u8) -> bool {
        self.0[usize::from(rule) - 1].broken.is_some()
    }

    /// One finding a rule, in order. `stopped`: why the script ended early.
    pub fn findings(&self, stopped: Option<&str>) -> Vec<Finding> {
        RULES
            .iter()
            .zip(&self.0)
            .map(|(rule, entry)| {
                let (verdict, why) = entry.verdict(rule.scope, stopped);
                let tried = entry.broken.clone().map_or_else(|| entry.tried.clone(), |trial| vec![trial]);
                Finding { rule: rule.number, title: rule.title, verdict, tried, why }
            })
            .collect()
    }
}

impl Entry {
    fn verdict(&self, scope: Scope, stopped: Option<&str>) -> (Verdict, String) {
        let why = |text: &Option<String>| text.clone().unwrap_or_default();
        if let Scope::Hidden(reason) = scope {
            return (Verdict::NotFromOutside, reason.to_owned());
        }
        if self.broken.is_some() {
            return (Verdict::Breaks, String::new());
        }
        if self.missing.is_some() {
            return (Verdict::DoesNotKnow, why(&self.missing));
        }
        if self.tried.is_empty() {
            let why = self.excused.as_deref().or(stopped).unwrap_or("nothing showed it");
            return (Verdict::NotTried, why.to_owned());
        }
        (Verdict::Keeps, String::new())
    }
}
