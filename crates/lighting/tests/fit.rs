//! Fits of eleven effects on 1,000 robots. Shown colours stay within the tolerance, and the records are few.

mod effects;

use effects::{Rate, measured};
use lightbots_base::{Rgb, Span};
use lightbots_lighting::{Tolerance, fit};
use lightbots_wire::MAX_LIGHT_RECORDS;

#[test]
fn two_units_of_lightness_take_few_records_and_are_kept() {
    let rates = measured(Tolerance::SIDE_BY_SIDE, MAX_LIGHT_RECORDS, |name, (_, units)| {
        assert!(units <= 2.0 + 1e-9, "{name}: {units} units of L*");
    });
    let mean = |value: fn(&Rate) -> f64| rates.iter().map(value).sum::<f64>() / rates.len() as f64;
    let (records, bytes) = (mean(|rate| rate.records), mean(|rate| rate.bytes));
    let row = |name: &str, records: f64, bytes: f64| {
        format!("{name:24}{records:8.2}{bytes:8.1}{:8.1}\n", bytes * 4.0 / 3.0)
    };
    let rows = rates.iter().map(|rate| row(rate.effect, rate.records, rate.bytes));
    let table: String = rows.chain([row("mean", records, bytes)]).collect();
    insta::assert_snapshot!(format!(
        "{:24}{:>8}{:>8}{:>8}\n{table}",
        "each second", "records", "bytes", "base64"
    ));
    // These bounds come from reference measurements with the same tolerance, without repeats.
    assert!(records <= 3.2 && bytes <= 13.0, "{records} records and {bytes} bytes in the mean");
    assert!(rates.iter().all(|rate| rate.records <= 10.0 && rate.bytes <= 40.0), "{rates:?}");
}

#[test]
fn one_step_of_each_channel_is_kept() {
    let rates = measured(Tolerance::OneStep, usize::MAX, |name, (codes, _)| assert_eq!(codes, 0, "{name}"));
    // These bounds come from reference measurements with the same tolerance, without repeats.
    assert!(rates.iter().all(|rate| rate.records <= 16.0 && rate.bytes <= 64.0), "{rates:?}");
}

#[test]
fn too_many_records_widen_the_tolerance_and_never_the_number() {
    let noise =
        |tick: u64| Rgb::from_number((tick.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as u32 & 0xff_ffff);
    let samples: Vec<Rgb> = (0..1_001).filter_map(noise).collect();
    let fit = fit(&samples, Tolerance::OneStep, 50);
    assert!(fit.records.len() <= 50);
    assert_eq!(fit.track().duration(), Span::from_secs(10.0));
}
