//! The findings of an exam, for people and for programs.

use lightbots_exam::{Exam, Finding, RULES, RuleVerdict, Scope};
use lightbots_link::BrokerUrl;
use serde::Serialize;

use crate::commands::print_json;
use crate::failure::{Failure, Outcome};
use crate::say;

/// The findings as JSON.
#[derive(Serialize)]
struct Answer {
    ok: bool,
    robot: Option<String>,
    broker: String,
    rules: Vec<RuleAnswer>,
    /// Why there are no findings, such as that no robot was found or that the exam was stopped. `None` if the exam ended.
    #[serde(skip_serializing_if = "Option::is_none")]
    issue: Option<String>,
}

#[derive(Serialize)]
struct RuleAnswer {
    rule: String,
    title: &'static str,
    verdict: &'static str,
    #[serde(skip_serializing_if = "String::is_empty")]
    why: String,
    tried: Vec<Tried>,
}

#[derive(Serialize)]
struct Tried {
    sent: String,
    expected: String,
    came: String,
    fits: bool,
}

/// Prints the findings. If there are none, returns the reason as an error, and with `json` prints it, too.
pub fn tell(examined: Result<Exam, Failure>, broker: &BrokerUrl, json: bool) -> Outcome {
    let (exam, failure) = match examined {
        Ok(exam) => (Some(exam), None),
        Err(failure) => (None, Some(failure)),
    };
    let findings = exam.as_ref().map(Exam::findings).unwrap_or_default();
    let robot = exam.as_ref().and_then(Exam::robot).map(|id| id.to_string());
    let ok = failure.is_none() && findings.iter().all(is_fine);
    if json {
        let rules = findings.iter().map(rule_answer).collect();
        let issue = failure.as_ref().map(|failure| failure.line.clone());
        print_json(&Answer { ok, robot, broker: broker.to_string(), rules, issue })?;
    } else {
        findings.iter().for_each(print_finding);
        if failure.is_none() {
            say::line(&summary(&robot.unwrap_or_default(), &findings));
        }
    }
    failure.map_or(Ok(ok), Err)
}

/// Whether a finding lets the robot pass. A rule that was not tried fails, unless it is about the light.
fn is_fine(finding: &Finding) -> bool {
    let scope = RULES.iter().find(|rule| rule.number == finding.rule).map(|rule| rule.scope);
    let is_light =
        matches!(scope, Some(Scope::Light | Scope::Fade | Scope::Ahead | Scope::Live | Scope::Blink));
    match finding.verdict {
        RuleVerdict::Keeps | RuleVerdict::DoesNotKnow | RuleVerdict::NotFromOutside => true,
        RuleVerdict::NotTried => is_light,
        RuleVerdict::Breaks => false,
    }
}

fn rule_answer(finding: &Finding) -> RuleAnswer {
    let tried = finding.tried.iter().cloned();
    RuleAnswer {
        rule: format!("R{}", finding.rule),
        title: finding.title,
        verdict: finding.verdict.word(),
        why: finding.why.clone(),
        tried: tried
            .map(|trial| Tried {
                sent: trial.sent,
                expected: trial.expected,
                came: trial.came,
                fits: trial.fits,
            })
            .collect(),
    }
}

/// Prints one line for a rule, and three more for each trial of a broken rule.
fn print_finding(finding: &Finding) {
    let word = match finding.verdict {
        RuleVerdict::Keeps => "keeps",
        RuleVerdict::Breaks => "BREAKS",
        RuleVerdict::DoesNotKnow => "does not know",
        RuleVerdict::NotTried => "not tried",
        RuleVerdict::NotFromOutside => "not testable from outside",
    };
    let why = if finding.why.is_empty() { String::new() } else { format!(" ({})", finding.why) };
    say::line(&format!("{:<4} {word}: {}{why}", format!("R{}", finding.rule), finding.title));
    if finding.verdict == RuleVerdict::Breaks {
        for trial in &finding.tried {
            say::line(&format!("       sent: {}", trial.sent));
            say::line(&format!("       expected: {}", trial.expected));
            say::line(&format!("       came: {}", trial.came));
        }
    }
}

fn summary(robot: &str, findings: &[Finding]) -> String {
    let count = |verdict| findings.iter().filter(|finding| finding.verdict == verdict).count();
    format!(
        "{robot}: {} rules kept, {} broken, {} not known to it, {} not tried, {} not testable from outside",
        count(RuleVerdict::Keeps),
        count(RuleVerdict::Breaks),
        count(RuleVerdict::DoesNotKnow),
        count(RuleVerdict::NotTried),
        count(RuleVerdict::NotFromOutside)
    )
}
