//! Whether splines that turn too fast are found and mended.

use super::*;

fn eased(mut spline: Vec<Vec2>) -> (f64, f64) {
    let turn_rate = TurnRate::new(0.25, &Limits::ELISA_3);
    let before = turn_rate.time_scale(&spline);
    (0..300).any(|_| turn_rate.smooth_turns(&mut spline, false, DirtySpans::ALL).is_over());
    (before, turn_rate.time_scale(&spline))
}

#[test]
fn a_sharp_corner_becomes_one_that_can_be_driven() {
    let corner = [0.0, 0.04, 0.08, 0.11, 0.125, 0.135];
    let mut spline: Vec<Vec2> = corner.iter().map(|&x| Vec2::new(x, 0.0)).collect();
    spline.extend(corner.iter().rev().map(|&x| Vec2::new(0.135, 0.145 - x)));
    let (before, after) = eased(spline);
    assert!(before > 1.2 && after <= 1.0, "{before} {after}");
}

#[test]
fn what_nearly_is_a_reversal_becomes_one() {
    let there = [0.0, 0.03, 0.06, 0.08].map(|x| Vec2::new(x, 0.0));
    let back = [0.081, 0.06, 0.03, 0.0].map(|x| Vec2::new(x, 0.006));
    let (before, after) = eased([there, back].concat());
    assert!(before > 1.2 && after <= 1.0, "{before} {after}");
}

#[test]
fn there_and_back_on_a_line_is_no_turn() {
    let turn_rate = TurnRate::new(0.25, &Limits::ELISA_3);
    let spline: Vec<Vec2> = [0.0, 0.02, 0.05, 0.05, 0.02, 0.0].iter().map(|&x| Vec2::new(x, x)).collect();
    assert!(turn_rate.time_scale(&spline) < 1e-9);
}

#[test]
fn what_surely_stays_within_a_turn_does_and_most_that_does_surely_does() {
    let (turn_rate, mut seeded) = (TurnRate::new(0.3, &Limits::ELISA_3), crate::seeded::Seeded::new(5));
    let (mut within, mut surely) = (0, 0);
    for _ in 0..4000 {
        let mut at = Vec2::ZERO;
        let step = Vec2::new(0.05, 0.0);
        let four: [Vec2; 4] = std::array::from_fn(|_| {
            at += step + Vec2::new(seeded.between(-0.05, 0.05), seeded.between(-0.05, 0.05));
            at
        });
        let turn = turn_rate.turn * seeded.between(1.0, 3.0);
        let does = turn_rate.fastest(&four).map_or(0.0, |(turn, _)| turn) <= turn;
        within += usize::from(does);
        if turn_rate.stays_within(&four, turn) {
            assert!(does, "{four:?} turns more than {turn}");
            surely += 1;
        }
    }
    assert!(within < 3800 && surely * 10 > within * 9, "{surely} of {within}");
}
