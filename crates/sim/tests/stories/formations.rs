//! Drives from the usual starting rows to formations: some of the cases that `cargo xtask formations` rehearses.

#[path = "../../examples/formations/case.rs"]
mod case;
#[path = "../../examples/formations/shapes.rs"]
mod shapes;
#[path = "../../examples/formations/verdict.rs"]
mod verdict;

use lightbots_sim::Conditions;

use case::{CASES, COUNTS, Case, Place};
use shapes::{Shape, nearest};
use verdict::Required;

/// Number of cases that the tests take from the whole sweep.
const SPREAD: usize = 100;
/// Difference between the numbers of two successive cases. It shares no divisor with the number of cases and is near
/// its golden section. So each part of the sequence is spread evenly too.
const STRIDE: usize = 2991;

fn spread() -> impl Iterator<Item = Case> {
    (0..SPREAD).map(|nth| Case::new(nth * STRIDE % CASES))
}

/// All cases with spacings near 0.080 m, where the planned clearance exceeds 8 mm and robots once braked.
fn about_eighty_millimetres() -> impl Iterator<Item = Case> {
    (0..CASES).map(Case::new).filter(|case| (0.0794..0.0806).contains(&case.spacing_m))
}

/// Rehearses the cases and fails with a list of those that do not pass.
#[track_caller]
fn assert_pass(cases: impl Iterator<Item = Case>, conditions: &Conditions, required: Required) {
    let (mut count, mut failed) = (0, Vec::new());
    for case in cases {
        count += 1;
        let report = verdict::rehearsed(&case, conditions, 1);
        if !verdict::passes(&report, required) {
            failed.push(format!("{case}: {}", verdict::line(&report)));
        }
    }
    assert!(failed.is_empty(), "{} of {count} cases failed:\n{}", failed.len(), failed.join("\n"));
}

#[test]
fn a_hundred_formations_are_driven_to_exactly_where_nothing_is_noisy() {
    assert_pass(spread(), &Conditions::ideal(), Required::Exact);
}

#[test]
fn a_hundred_formations_are_driven_to_without_contact() {
    assert_pass(spread(), &Conditions::default(), Required::Untouched);
}

#[test]
fn formations_of_eighty_millimetres_are_driven_to_exactly_where_nothing_is_noisy() {
    assert_pass(about_eighty_millimetres(), &Conditions::ideal(), Required::Exact);
}

#[test]
fn formations_of_eighty_millimetres_are_driven_to_without_contact() {
    assert_pass(about_eighty_millimetres(), &Conditions::default(), Required::Untouched);
}

#[test]
fn the_hundred_formations_are_spread_over_all_shapes_numbers_and_places() {
    for shape in Shape::ALL {
        assert!(spread().filter(|case| case.shape == shape).count() >= SPREAD / 6, "{shape:?}");
        for count in COUNTS {
            let places = spread().filter(|case| (case.shape, case.count) == (shape, count));
            let near =
                places.map(|case| case.place == Place::Near).collect::<std::collections::BTreeSet<_>>();
            assert_eq!(near.len(), 2, "{shape:?} {count}");
        }
    }
    let mut spacings: Vec<f64> = spread().map(|case| case.spacing_m).collect();
    spacings.sort_by(f64::total_cmp);
    let gap_m = spacings.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    assert!(spacings[0] < 0.063 && spacings[SPREAD - 1] > 0.117 && gap_m < 0.003, "{gap_m}: {spacings:?}");
}

#[test]
fn formations_keep_their_spacing_and_lie_on_their_floor() {
    for index in (0..CASES).step_by(37).chain([CASES - 1]) {
        let case = Case::new(index);
        let show = case.show();
        let places: Vec<_> = show.frames[0].pixels.iter().map(|pixel| pixel.at).collect();
        assert_eq!(places.len(), case.count);
        assert!((nearest(&places) - case.spacing_m).abs() < 1e-9, "{case}: {}", nearest(&places));
        let (half_x, half_y) = (show.stage.width_m / 2.0 - 0.2, show.stage.depth_m / 2.0 - 0.2);
        assert!(places.iter().all(|at| at.x.abs() < half_x && at.y.abs() < half_y), "{case}");
    }
}
