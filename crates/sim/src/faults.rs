//! Faults in the notation of the command line: `loss=5%,delay=100..300ms,kill=random`.

use core::fmt;

use lightbots_base::Span;

use crate::conditions::{Breakdown, Conditions, Outage};
use crate::options::ROBOTS_MAX;

/// Changes to the conditions of a rehearsal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    changes: Vec<Change>,
}

/// Why a text is not a valid list of faults: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultsError(String);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Change {
    Loss(f64),
    Delay(Span, Span),
    Jitter(Span),
    Double(f64),
    Reorder(f64),
    Slip(f64),
    Gps(f64),
    Heading(f64),
    Bias(f64),
    Clock(f64),
    FixDelay(Span),
    FixEvery(u32),
    FixDropout(Span),
    FixOutlier(f64),
    Originals(usize),
    Kill(Breakdown),
    Mute(Breakdown),
    Stuck(Breakdown),
    Cut(Breakdown, Span),
    Blind(Breakdown, Span),
    Freeze(Outage),
    Gone(Outage),
    Crash(Outage),
}

/// All faults, each with an example of its value, for error messages.
const KNOWN: &str = "loss=5%, delay=100..300ms, jitter or jitter=50ms, double=1%, reorder=1%, slip=10%, gps=5mm, \
                     heading=2deg, bias=5mm, clock=100ppm, fix-delay=100ms, fix-every=5, fix-dropout=1s, \
                     fix-outlier=1%, original=30, kill=random or kill=3@12s, mute=random or mute=3@12s, \
                     stuck=random or stuck=3@12s, cut=random or cut=3@12s+4s, blind=random or blind=3@12s+4s, freeze=12s+4s, gone=12s+4s, crash=12s+4s";

/// Largest number of faults in a text.
const MOST: usize = 64;

impl Faults {
    /// Reads faults `name=value` that are separated by commas; at least one. Values carry their unit: `%`, `ms` or `s`,
    /// `mm`, `cm` or `m`, `deg`, `ppm`; counts have none. `jitter` needs no value. Robots are counted from 0. A number
    /// after `@` is the time after the first departure, one after `+` the duration; both are in seconds if they have no
    /// unit. A name may occur only once, except for breakdowns and outages.
    pub fn parse(text: &str) -> Result<Self, FaultsError> {
        let parts: Vec<&str> = text.split(',').map(str::trim).filter(|part| !part.is_empty()).collect();
        if parts.is_empty() {
            return Err(FaultsError(format!("no fault is stated; there are {KNOWN}")));
        }
        if parts.len() > MOST {
            return Err(FaultsError(format!(
                "{} faults are more than the {MOST} that can be stated",
                parts.len()
            )));
        }
        let mut changes: Vec<Change> = Vec::with_capacity(parts.len());
        for part in parts {
            let new = change(part)?;
            if changes.iter().any(|known| known.excludes(new)) {
                let name = part.split('=').next().unwrap_or(part).trim();
                return Err(FaultsError(format!("the fault '{name}' is stated twice: state it once")));
            }
            changes.push(new);
        }
        Ok(Self { changes })
    }

    /// Returns the conditions with these faults added.
    pub fn added_to(&self, mut conditions: Conditions) -> Conditions {
        for &change in &self.changes {
            apply(change, &mut conditions);
        }
        conditions
    }
}

impl Change {
    /// Whether both faults set the same condition, so that the later fault would silently replace the earlier.
    fn excludes(self, other: Self) -> bool {
        let of_a_robot =
            matches!(self, Self::Kill(_) | Self::Mute(_) | Self::Stuck(_) | Self::Cut(..) | Self::Blind(..));
        let of_all = matches!(self, Self::Freeze(_) | Self::Gone(_) | Self::Crash(_));
        !(of_a_robot || of_all) && core::mem::discriminant(&self) == core::mem::discriminant(&other)
    }
}

impl fmt::Display for FaultsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for FaultsError {}

fn apply(change: Change, conditions: &mut Conditions) {
    let (fixes, link) = (&mut conditions.fixes, &mut conditions.link);
    match change {
        Change::Loss(share) => link.loss = share,
        Change::Delay(min, max) => (link.delay_min, link.delay_max) = (min, max),
        Change::Jitter(most) => link.jitter = most,
        Change::Double(share) => link.double = share,
        Change::Reorder(share) => link.reorder = share,
        Change::Slip(share) => conditions.slip = share,
        Change::Gps(sigma) => fixes.place_sigma_m = sigma,
        Change::Heading(sigma) => fixes.heading_sigma_rad = sigma,
        Change::Bias(most) => fixes.bias_m = most,
        Change::Clock(ppm) => conditions.clock_ppm = ppm,
        Change::FixDelay(delay) => fixes.delay = delay,
        Change::FixEvery(steps) => fixes.every = steps,
        Change::FixDropout(span) => fixes.dropout = span,
        Change::FixOutlier(share) => fixes.outliers = share,
        Change::Originals(count) => conditions.originals = count,
        Change::Kill(breakdown) => conditions.killed.push(breakdown),
        Change::Mute(breakdown) => conditions.muted.push(breakdown),
        Change::Stuck(breakdown) => conditions.stuck.push(breakdown),
        Change::Cut(breakdown, over) => conditions.cut.push((breakdown, over)),
        Change::Blind(breakdown, over) => conditions.blind.push((breakdown, over)),
        Change::Freeze(outage) => conditions.frozen.push(outage),
        Change::Gone(outage) => conditions.gone.push(outage),
        Change::Crash(outage) => conditions.crashed.push(outage),
    }
}

fn change(part: &str) -> Result<Change, FaultsError> {
    let (name, value) = part.split_once('=').map_or((part, ""), |(name, value)| (name.trim(), value.trim()));
    let read = match name {
        "loss" => share(value, 1.0).map(Change::Loss),
        "delay" => span_range(value).map(|(min, max)| Change::Delay(min, max)),
        "jitter" if value.is_empty() => Some(Change::Jitter(Span::from_millis(50))),
        "jitter" => span(value, Conditions::DELAY_MAX).map(Change::Jitter),
        "double" => share(value, 1.0).map(Change::Double),
        "reorder" => share(value, 1.0).map(Change::Reorder),
        "slip" => share(value, Conditions::SLIP_MAX).map(Change::Slip),
        "gps" => metres(value).map(Change::Gps),
        "heading" => number(value, "deg", 90.0).map(|degrees| Change::Heading(degrees.to_radians())),
        "bias" => metres(value).map(Change::Bias),
        "clock" => number(value, "ppm", 1000.0).map(Change::Clock),
        "fix-delay" => span(value, Conditions::FIX_DELAY_MAX).map(Change::FixDelay),
        "fix-every" => {
            number(value, "", 1000.0).filter(|&n| n >= 1.0).map(|steps| Change::FixEvery(steps as u32))
        }
        "fix-dropout" => span(value, Span::from_millis(60_000)).map(Change::FixDropout),
        "fix-outlier" => share(value, 1.0).map(Change::FixOutlier),
        "original" => value.parse().ok().filter(|&count| count <= ROBOTS_MAX).map(Change::Originals),
        "kill" => breakdown(value).map(Change::Kill),
        "mute" => breakdown(value).map(Change::Mute),
        "stuck" => breakdown(value).map(Change::Stuck),
        "cut" => outage(value).map(|(breakdown, over)| Change::Cut(breakdown, over)),
        "blind" => outage(value).map(|(breakdown, over)| Change::Blind(breakdown, over)),
        "freeze" => outage_of_all(value).map(Change::Freeze),
        "gone" => outage_of_all(value).map(Change::Gone),
        "crash" => outage_of_all(value).map(Change::Crash),
        _ => return Err(FaultsError(format!("there is no fault '{}'; there are {KNOWN}", shown(name)))),
    };
    read.ok_or_else(|| {
        FaultsError(format!("'{}' is no value for the fault '{name}'; examples: {KNOWN}", shown(value)))
    })
}

/// The first 40 characters of a text, with `?` in place of control characters.
fn shown(text: &str) -> String {
    text.chars().take(40).map(|c| if c.is_control() { '?' } else { c }).collect()
}

/// Reads a number that is followed by `unit`. `None` if the text is something else, or the number is not from 0 to
/// `most`.
fn number(text: &str, unit: &str, most: f64) -> Option<f64> {
    let value: f64 = text.strip_suffix(unit)?.trim().parse().ok()?;
    (0.0..=most).contains(&value).then_some(value)
}

fn share(text: &str, most: f64) -> Option<f64> {
    number(text, "%", 100.0 * most).map(|percent| percent / 100.0)
}

fn metres(text: &str) -> Option<f64> {
    let scaled = |unit, scale: f64| number(text, unit, 10.0 / scale).map(|value| value * scale);
    scaled("mm", 0.001).or_else(|| scaled("cm", 0.01)).or_else(|| scaled("m", 1.0))
}

fn span(text: &str, most: Span) -> Option<Span> {
    let millis = number(text, "ms", 1e9).or_else(|| number(text, "s", 1e6).map(|seconds| seconds * 1e3))?;
    Some(Span::from_secs(millis * 1e-3)).filter(|&span| span <= most)
}

/// Reads the least and the largest delay: `100..300ms`, `100ms..0.3s`, or one time for both.
fn span_range(text: &str) -> Option<(Span, Span)> {
    let Some((low, high)) = text.split_once("..") else {
        return span(text, Conditions::DELAY_MAX).map(|both| (both, both));
    };
    let unit = if high.ends_with("ms") { "ms" } else { "s" };
    let max = span(high.trim(), Conditions::DELAY_MAX)?;
    let min = span(low.trim(), Conditions::DELAY_MAX)
        .or_else(|| span(&format!("{}{unit}", low.trim()), Conditions::DELAY_MAX))?;
    (min <= max).then_some((min, max))
}

/// Reads `random`, `3`, `random@12s` or `3@12s`: a robot's index, and the time after the first departure. A time
/// without unit is in seconds.
fn breakdown(text: &str) -> Option<Breakdown> {
    let (who, when) = text.split_once('@').map_or((text, None), |(who, when)| (who, Some(when)));
    let robot = match who.trim() {
        "random" => None,
        number => Some(number.parse().ok()?),
    };
    let most = Span::from_millis(86_400_000);
    let at = match when.map(str::trim) {
        None => None,
        Some(when) => Some(span(when, most).or_else(|| span(&format!("{when}s"), most))?),
    };
    Some(Breakdown { robot, at })
}

/// Reads a breakdown that ends, for example `3@12s+4s`: robot, time and duration. Without `+`, it lasts five seconds.
fn outage(text: &str) -> Option<(Breakdown, Span)> {
    let (begins, over) = begin_and_length(text)?;
    Some((breakdown(begins)?, over))
}

/// Reads an outage of the broker or the controller, for example `12s+4s`: time after the first departure, and duration.
/// Without `+`, it lasts five seconds.
fn outage_of_all(text: &str) -> Option<Outage> {
    let (begins, over) = begin_and_length(text)?;
    let (begins, most) = (begins.trim(), Span::from_millis(86_400_000));
    let at = span(begins, most).or_else(|| span(&format!("{begins}s"), most))?;
    Some(Outage { at, over })
}

fn begin_and_length(text: &str) -> Option<(&str, Span)> {
    let (begins, over) = text.split_once('+').map_or((text, "5s"), |(begins, over)| (begins, over.trim()));
    let most = Span::from_millis(3_600_000);
    Some((begins, span(over, most).or_else(|| span(&format!("{over}s"), most))?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn added(text: &str) -> Conditions {
        Faults::parse(text).unwrap().added_to(Conditions::default())
    }

    #[test]
    fn every_fault_reaches_its_condition() {
        let all = added(
            "loss=5%,delay=100..300ms,jitter,double=1%,reorder=2%,slip=10%,gps=5mm,heading=2deg,bias=1cm,clock=100ppm,\
             fix-delay=100ms,fix-every=5,fix-dropout=1s,fix-outlier=3%,original=4,kill=random,mute=3@12s,stuck=1@2s,freeze=3+500ms,gone=4s+2,\
             crash=5s",
        );
        let mut expected = Conditions::default();
        (expected.slip, expected.clock_ppm) = (0.1, 100.0);
        expected.link = crate::LinkConditions {
            delay_min: Span::from_millis(100),
            delay_max: Span::from_millis(300),
            jitter: Span::from_millis(50),
            loss: 0.05,
            double: 0.01,
            reorder: 0.02,
        };
        expected.fixes = crate::FixConditions {
            place_sigma_m: 0.005,
            heading_sigma_rad: 2f64.to_radians(),
            bias_m: 0.01,
            every: 5,
            delay: Span::from_millis(100),
            dropout: Span::from_millis(1000),
            outliers: 0.03,
        };
        expected.originals = 4;
        expected.killed = vec![Breakdown { robot: None, at: None }];
        expected.muted = vec![Breakdown { robot: Some(3), at: Some(Span::from_millis(12_000)) }];
        expected.stuck = vec![Breakdown { robot: Some(1), at: Some(Span::from_millis(2_000)) }];
        let outage = |at, over| Outage { at: Span::from_millis(at), over: Span::from_millis(over) };
        expected.frozen = vec![outage(3_000, 500)];
        expected.gone = vec![outage(4_000, 2_000)];
        expected.crashed = vec![outage(5_000, 5_000)];
        assert_eq!(all, expected);
    }

    #[test]
    fn spaces_units_and_nothing_are_understood() {
        assert_eq!(added(" loss = 5 % , "), added("loss=5%"));
        assert_eq!(added("delay=0.1s..300ms"), added("delay=100..300ms"));
        assert_eq!(added("delay=100ms").link.delay_max, Span::from_millis(100));
        assert_eq!(added("kill=2@1.5"), added("kill=2@1500ms"));
        assert_eq!(Faults::default().added_to(Conditions::default()), Conditions::default());
    }

    #[test]
    fn a_fault_is_stated_once_but_several_robots_may_break_down() {
        for (text, name) in [("loss=5%,slip=5%,loss=1%", "loss"), ("jitter,jitter=20ms", "jitter")] {
            let message = Faults::parse(text).expect_err(text).to_string();
            assert_eq!(message, format!("the fault '{name}' is stated twice: state it once"));
        }
        assert_eq!(
            added("kill=1,kill=2,stuck=random,stuck=random,blind=1@1s+1s,blind=2@1s+1s").killed.len(),
            2
        );
    }

    #[test]
    fn what_makes_no_sense_is_said_in_one_line() {
        let long = "x".repeat(5000);
        let many = "loss=1%,".repeat(65);
        for text in [
            "",
            " , ",
            "los=5%",
            "loss",
            "loss=5",
            "loss=-1%",
            "loss=101%",
            "loss=NaN%",
            "slip=60%",
            "delay=300..100ms",
            "delay=1h",
            "delay=9s",
            "gps=5",
            "gps=20m",
            "kill=",
            "kill=x@1",
            "mute=1@-1",
            "freeze=random",
            "gone=-1+2",
            "fix-every=0",
            "original=1.5",
            "original=20001",
            "heading=2",
            "jitter=inf ms",
            "=",
            "a\nb",
            &long,
            &many,
        ] {
            let message = Faults::parse(text).expect_err(text).to_string();
            assert!(!message.contains('\n') && message.len() < 600, "{message}");
        }
    }
}
