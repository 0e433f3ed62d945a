//! Whether ways that turn too fast are found and mended.

use super::*;

fn eased(mut way: Vec<Vec2>) -> (f64, f64) {
    let turning = Turning::new(0.25, &Limits::ELISA_3);
    let before = turning.haste(&way);
    (0..300).any(|_| turning.ease(&mut way, false, Look::ALL).is_over());
    (before, turning.haste(&way))
}

#[test]
fn a_sharp_corner_becomes_one_that_can_be_driven() {
    let corner = [0.0, 0.04, 0.08, 0.11, 0.125, 0.135];
    let mut way: Vec<Vec2> = corner.iter().map(|&x| Vec2::new(x, 0.0)).collect();
    way.extend(corner.iter().rev().map(|&x| Vec2::new(0.135, 0.145 - x)));
    let (before, after) = eased(way);
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
    let turning = Turning::new(0.25, &Limits::ELISA_3);
    let way: Vec<Vec2> = [0.0, 0.02, 0.05, 0.05, 0.02, 0.0].iter().map(|&x| Vec2::new(x, x)).collect();
    assert!(turning.haste(&way) < 1e-9);
}

#[test]
fn what_surely_stays_within_a_turn_does_and_most_that_does_surely_does() {
    let (turning, mut seeded) = (Turning::new(0.3, &Limits::ELISA_3), crate::seeded::Seeded::new(5));
    let (mut within, mut surely) = (0, 0);
    for _ in 0..4000 {
        let mut at = Vec2::ZERO;
        let step = Vec2::new(0.05, 0.0);
        let four: [Vec2; 4] = std::array::from_fn(|_| {
            at += step + Vec2::new(seeded.between(-0.05, 0.05), seeded.between(-0.05, 0.05));
            at
        });
        let turn = turning.turn * seeded.between(1.0, 3.0);
        let does = turning.fastest(&four).map_or(0.0, |(turn, _)| turn) <= turn;
        within += usize::from(does);
        if turning.stays_within(&four, turn) {
            assert!(does, "{four:?} turns more than {turn}");
            surely += 1;
        }
    }
    assert!(within < 3800 && surely * 10 > within * 9, "{surely} of {within}");
}
