use super::*;
use lightbots_base::RobotId;

fn filter() -> Filter {
    Filter::new(&Config::new(RobotId::new("r").unwrap()))
}

fn fix(x: f64, heading: f64) -> Fix {
    Fix { at: Vec2::new(x, 0.0), heading: Some(heading) }
}

#[test]
fn turning_in_small_steps_keeps_facing_and_heading_together() {
    let mut one = filter();
    for _ in 0..100_000 {
        one.advance([-0.3, 0.31]);
    }
    assert!((one.facing - Vec2::unit(one.heading)).length() < 1e-6);
}

#[test]
fn one_wild_fix_is_left_alone_and_ten_are_believed() {
    let mut one = filter();
    for step in 0..50 {
        one.correct(Instant(step), &fix(0.1, 0.0));
    }
    one.correct(Instant(60), &fix(0.9, 0.0));
    assert!((one.at.x - 0.1).abs() < 1e-9);
    for step in 0..10 {
        one.correct(Instant(61 + step), &fix(0.9, 2.0));
    }
    assert!((one.at.x - 0.9).abs() < 1e-9);
    assert!((one.heading - 2.0).abs() < 1e-9);
    assert!(!one.take_senseless());
}

/// The true pose and slip of a robot, kept beside the filter.
struct Drive {
    at: Vec2,
    heading: f64,
    slip: [f64; 2],
}

impl Drive {
    fn step(&mut self, turns: [f64; 2]) {
        let way = |side: usize| turns[side] * 0.0045 * (1.0 - self.slip[side]);
        let turn = (way(1) - way(0)) / 0.0402;
        self.at += Vec2::unit(self.heading + turn / 2.0) * ((way(0) + way(1)) / 2.0);
        self.heading = wrap(self.heading + turn);
    }
}

#[test]
fn slip_is_learned_and_leads_through_a_second_without_fixes() {
    let mut one = filter();
    let mut drive = Drive { at: Vec2::ZERO, heading: 0.0, slip: [0.12, 0.06] };
    for step in 0..700u32 {
        let bend = if step / 100 % 2 == 0 { 1.05 } else { 0.95 };
        let turns = [0.96, 0.96 * bend];
        drive.step(turns);
        one.advance(turns);
        if step < 640 {
            let noise = if step % 2 == 0 { 0.002 } else { -0.002 };
            let seen =
                Fix { at: drive.at + Vec2::new(noise, noise), heading: Some(drive.heading + 5.0 * noise) };
            one.correct(Instant(u64::from(step) * 16_000), &seen);
        }
    }
    let [left, right] = one.slip();
    assert!((left - 0.12).abs() < 0.02 && (right - 0.06).abs() < 0.02, "{left} {right}");
    assert!(one.at.distance(drive.at) < 0.006, "{:?} {:?}", one.at, drive.at);
    assert!(libm::sqrt(one.variance()) < 0.02);
}

#[test]
fn a_robot_that_stood_for_a_while_does_not_know_its_wheels_any_more() {
    let mut one = filter();
    let mut drive = Drive { at: Vec2::ZERO, heading: 0.0, slip: [0.12, 0.06] };
    let mut live = |one: &mut Filter, steps: core::ops::Range<u64>, turns: [f64; 2]| {
        for step in steps {
            drive.step(turns);
            one.advance(turns);
            let noise = if step % 2 == 0 { 0.002 } else { -0.002 };
            let seen =
                Fix { at: drive.at + Vec2::new(noise, noise), heading: Some(drive.heading + 5.0 * noise) };
            one.correct(Instant(step * 16_000), &seen);
        }
    };
    live(&mut one, 0..600, [0.96, 0.96]);
    let (sure_m, slip) = (one.strays_m(0.13), one.slip());
    live(&mut one, 600..800, [0.0, 0.0]);
    assert!(one.strays_m(0.13) > 1.5 * sure_m, "{} {sure_m}", one.strays_m(0.13));
    // The mean slip of the wheels is remembered.
    let now = one.slip();
    assert!((now[0] - slip[0]).abs() < 0.02 && (now[1] - slip[1]).abs() < 0.02, "{now:?} {slip:?}");
}

#[test]
fn wild_fixes_win_neither_alone_nor_by_a_fifth_of_all() {
    let mut one = filter();
    let mut wild = 0.3;
    for step in 0..2000u64 {
        let here = if step < 1000 { 0.1 } else { 0.7 };
        wild = wrap(wild * 7.0 + 1.0);
        let at = if step % 5 == 0 { wild } else { here };
        one.correct(Instant(step * 16_000), &fix(at, 0.0));
        let settles = (1000..1020).contains(&step);
        assert!(step < 20 || settles || (one.at.x - here).abs() < 0.01, "{step}: {}", one.at.x);
    }
}
