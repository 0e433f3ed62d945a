use super::*;
use crate::proof::tests::LIMITS;
use crate::seeded::Seeded;
use lightbots_base::Piece;
use lightbots_base::braking::stopping_m;

/// A path straight on at a steady speed, m/s, from `from` for `seconds`. After its end, the robot rests there.
fn straight(from: Vec2, velocity: Vec2, seconds: f64) -> Path {
    let end = from + velocity * seconds;
    Path { start: from, pieces: vec![Piece::straight(from, end, Span::from_secs(seconds))] }
}

/// A row of robots at full speed, one behind the other with these gaps between their rims.
fn queue(gaps_m: &[f64]) -> Vec<Path> {
    let mut x = 0.0;
    let places = std::iter::once(0.0).chain(gaps_m.iter().map(|gap_m| {
        x -= LIMITS.contact_m() + gap_m;
        x
    }));
    places.map(|x| straight(Vec2::new(x, 0.0), Vec2::new(0.27, 0.0), 2.0)).collect()
}

#[test]
fn following_beyond_the_stopping_distance_is_safe_and_nearer_is_not() {
    let stopping_m = stopping_m(0.27);
    for (gap_m, is_safe) in
        [(stopping_m + 0.004, true), (stopping_m + 0.0025, false), (0.010, false), (0.2, true)]
    {
        let paths = queue(&[gap_m]);
        let found = stop_safety(&paths, &LIMITS);
        assert_eq!(found.is_safe(0, Span::from_secs(1.0)), is_safe, "{gap_m}: {:?}", found.worst());
        assert!(found.is_safe(1, Span::from_secs(1.0)), "nobody is behind the last");
        let missing_m = found.worst().map_or(0.0, |worst| worst.missing_m);
        assert!((missing_m - (stopping_m + 0.003 - gap_m).max(0.0)).abs() < 1e-4, "{gap_m}: {missing_m}");
    }
}

#[test]
fn a_robot_that_can_stop_but_is_followed_too_closely_is_unsafe_in_turn() {
    let found = stop_safety(&queue(&[0.03, 0.03, 0.008]), &LIMITS);
    let at = Span::from_millis(500);
    assert_eq!([0, 1, 2, 3].map(|robot| found.is_safe(robot, at)), [false, false, false, true]);
    let chained = found.unsafe_moments.iter().find(|one| one.at == at).unwrap();
    assert_eq!((chained.robot, chained.by, chained.missing_m), (0, 1, 0.0));
    assert_eq!(found.worst().map(|worst| (worst.robot, worst.by)), Some((2, 3)));
}

#[test]
fn side_by_side_and_apart_everything_is_safe() {
    let beside = |y: f64| straight(Vec2::new(0.0, y), Vec2::new(0.27, 0.0), 2.0);
    let found = stop_safety(&[beside(0.0), beside(0.057)], &LIMITS);
    assert_eq!((found.share(), found.moments), (1.0, 2 * 41));
    let stands = Path { start: Vec2::new(1.0, 0.0), pieces: vec![] };
    assert_eq!((stop_safety(&[stands], &LIMITS).share(), stop_safety(&[], &LIMITS).moments), (1.0, 0));
    assert_eq!(stop_safety(&[], &LIMITS).share(), 1.0);
}

#[test]
fn a_drive_of_hours_is_sampled_at_fewer_moments() {
    let hours = |x: f64| straight(Vec2::new(x, 0.0), Vec2::new(1e-4, 0.0), 2e4);
    let found = stop_safety(&[hours(0.0), hours(-0.0541)], &LIMITS);
    assert_eq!((found.pace, found.moments), (STEP * 41, 2 * 9_757));
    assert!(found.is_safe(1, Span::from_secs(1e4)), "nobody is behind it");
    let quick = |x: f64| straight(Vec2::new(x, 0.0), Vec2::new(0.27, 0.0), 1e3);
    let found = stop_safety(&[quick(0.0), quick(-0.06)], &LIMITS);
    assert!(!found.is_safe(0, Span::from_secs(500.0)));
    assert!((0.499..0.501).contains(&found.share()), "{}", found.share());
}

#[test]
fn a_crossing_just_behind_another_is_unsafe_while_it_is_too_late_to_stop() {
    // The second crosses the way of the first, 70 mm after it.
    let first = straight(Vec2::ZERO, Vec2::new(0.27, 0.0), 2.0);
    let second = straight(Vec2::new(0.27, -0.34), Vec2::new(0.0, 0.27), 2.0);
    let found = stop_safety(&[first, second], &LIMITS);
    let unsafe_s: Vec<f64> = found.unsafe_moments.iter().map(|one| one.at.as_secs()).collect();
    assert!(!unsafe_s.is_empty(), "a death at the crossing is not survived");
    assert!(unsafe_s.iter().all(|at_s| (0.8..1.3).contains(at_s)), "{unsafe_s:?}");
    assert!(found.unsafe_moments.iter().all(|one| (one.robot, one.by) == (0, 1)));
}

/// Whether the second robot touches the first after the first stopped dead, by brute force in steps of a millisecond.
fn touches(paths: &[Path], at: Span) -> bool {
    let [dead, other] = [&paths[0], &paths[1]].map(Path::as_ref);
    let place = dead.at(at).position;
    let apart_m = |seconds: f64| other.at(at + Span::from_secs(seconds)).position.distance(place);
    let need_m = (LIMITS.contact_m() + StopAssumptions::default().spare_m).min(apart_m(0.0)) - 1e-6;
    let braking_s = other.at(at + Span::from_secs(REACTION_S)).velocity.length() / (2.0 * GRIP_MPS2);
    (0..=((REACTION_S + braking_s) * 1e3) as usize).any(|ms| apart_m(ms as f64 * 1e-3) < need_m)
}

#[test]
fn random_pairs_are_judged_as_by_brute_force() {
    let mut dice = Seeded::new(7);
    let (mut agreed, mut unsafe_) = (0, 0);
    for _ in 0..400 {
        let mut path = |reach_m: f64| {
            let mut place = || Vec2::new(dice.between(-reach_m, reach_m), dice.between(-reach_m, reach_m));
            let (from, to) = (place(), place());
            straight(from, (to - from).normalized().unwrap_or(Vec2::ZERO) * 0.27, 1.0)
        };
        let paths = [path(0.15), path(0.15)];
        let found = stop_safety(&paths, &LIMITS);
        for moment in 0..=20 {
            let at = STEP * moment;
            let known = found.unsafe_moments.iter().find(|one| one.robot == 0 && one.at == at);
            // Within half a millimetre of the bound the straight lines between moments decide.
            if known.is_some_and(|one| one.missing_m < 0.0005) {
                continue;
            }
            agreed += usize::from(touches(&paths, at) == known.is_some());
            unsafe_ += usize::from(known.is_some());
            assert!(touches(&paths, at) || known.is_none(), "{paths:?} {at:?} {known:?}");
        }
    }
    assert!(unsafe_ > 100 && agreed > 8_000, "{unsafe_} unsafe, {agreed} agreed");
}
