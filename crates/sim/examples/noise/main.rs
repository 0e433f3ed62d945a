//! Measures how far robots are from their estimates and routes, for several sensor and wheel errors:
//! `cargo run --release -p lightbots-sim --example noise [--json]`.
//!
//! Prints a row for each kind of trouble, over three seeds of a show of the repository. One row for each kind of narrow
//! place follows, under standard conditions. Distances are in millimetres.
#![allow(clippy::print_stdout)]

mod places;

use lightbots_show::Show;
use lightbots_sim::{Conditions, Faults, RehearsalOptions, RehearsalReport, Spread, rehearse};

/// Thirty robots in pictures of words: close side by side, with long drives between.
const SHOW: &[u8] = include_bytes!("../../../../shows/hello.json");
/// Number of seeds with which each trouble is rehearsed.
const SEEDS: u64 = 3;
/// Widths of gaps that eight robots drive through, millimetres. The planner needs at least 60.2.
const GAPS_MM: [f64; 4] = [60.5, 61.0, 65.0, 70.0];
/// Faults that are added to the standard conditions or replace some of them. The first row has none.
const TROUBLES: [&str; 20] = [
    "",
    "gps=0mm",
    "gps=1mm",
    "gps=5mm",
    "gps=10mm",
    "heading=0deg",
    "heading=2deg",
    "heading=5deg",
    "slip=0%",
    "slip=10%",
    "fix-delay=50ms",
    "fix-delay=100ms",
    "fix-every=5",
    "fix-dropout=0.5s",
    "fix-dropout=1s",
    "fix-outlier=1%",
    "fix-outlier=20%",
    "slip=10%,gps=5mm,heading=2deg",
    "slip=10%,gps=5mm,heading=2deg,fix-delay=100ms",
    "slip=10%,gps=5mm,heading=2deg,fix-delay=100ms,fix-dropout=1s",
];

fn main() {
    let show = lightbots_exchange::read(SHOW, None).expect("the show is part of the repository").show;
    for trouble in TROUBLES {
        let stated = (!trouble.is_empty()).then(|| Faults::parse(trouble).expect("all troubles are faults"));
        let faults = stated.unwrap_or_default();
        let name = if trouble.is_empty() { "none: standard conditions" } else { trouble };
        print(name, &show, &faults.added_to(Conditions::default()));
    }
    print("place: along the edge, 3 mm off it", &places::along_edge(0.003), &Conditions::default());
    print("place: a bay, from stop to stop", &places::bay(), &Conditions::default());
    for wide_mm in GAPS_MM {
        let name = format!("place: a gap of {wide_mm} mm");
        print(&name, &places::gap(wide_mm * 1e-3), &Conditions::default());
    }
}

fn print(name: &str, show: &Show, conditions: &Conditions) {
    let rehearsed = |seed| {
        rehearse(show, &RehearsalOptions { seed, conditions: conditions.clone(), robots: None }, &mut |_| {})
    };
    println!("{}", row(name, &(1..=SEEDS).map(rehearsed).collect::<Vec<_>>()));
}

/// A row with the worst value of all seeds in each column. The keys of the JSON are the names of the columns.
fn row(trouble: &str, reports: &[RehearsalReport]) -> String {
    let worst = |value: &dyn Fn(&RehearsalReport) -> f64| reports.iter().map(value).fold(0.0, f64::max);
    let three = |name: &str, of: &dyn Fn(&RehearsalReport) -> Spread| {
        let [median, p99, max] = [
            worst(&|report| of(report).median * 1e3),
            worst(&|report| of(report).p99 * 1e3),
            worst(&|report| of(report).max * 1e3),
        ];
        format!("\"{name}_median\":{median:.2},\"{name}_p99\":{p99:.2},\"{name}_max\":{max:.2}")
    };
    let fine = reports.iter().filter(|report| report.ok).count();
    let contacts: u64 = reports.iter().map(|report| report.contacts).sum();
    format!(
        "{{\"trouble\":\"{trouble}\",{},{},\"at_pixel_max\":{:.2},\"show_s\":{:.1},\"contacts\":{contacts},\"fine\":\"{fine} of {}\"}}",
        three("estimate", &|report| report.estimate_error_m),
        three("tracking", &|report| report.tracking_error_m),
        worst(&|report| report.position_error_m.max * 1e3),
        worst(&|report| report.duration_s),
        reports.len()
    )
}
