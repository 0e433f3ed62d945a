use super::*;
use crate::seeded::Seeded;
use lightbots_base::{Limits, Vec2};
use lightbots_show::Easing;

fn problem(starts: Vec<Vec2>, goals: Vec<Vec2>, half: f64) -> TransitionProblem {
    TransitionProblem { starts, goals, ..TransitionProblem::on_floor(Vec2::new(half, half), Limits::ELISA_3) }
}

/// Places at least `apart` from each other, drawn until there are enough; `None` where the floor is too full.
fn scatter(seeded: &mut Seeded, count: usize, apart: f64, half: f64) -> Option<Vec<Vec2>> {
    let mut places: Vec<Vec2> = Vec::new();
    for _ in 0..count * 200 {
        let room = half - 0.03;
        let place = Vec2::new(seeded.between(-room, room), seeded.between(-room, room));
        if places.iter().all(|other| other.distance(place) >= apart) {
            places.push(place);
        }
        if places.len() == count {
            return Some(places);
        }
    }
    None
}

#[test]
fn random_pairs_of_frames_are_solved_and_proven() {
    let mut seeded = Seeded::new(5);
    for _ in 0..120 {
        let count = 2 + seeded.below(59);
        let apart = seeded.between(0.06, 0.2);
        let (Some(starts), Some(goals)) =
            (scatter(&mut seeded, count, apart, 1.5), scatter(&mut seeded, count, apart, 1.5))
        else {
            continue;
        };
        let problem = problem(starts, goals, 1.5);
        let plan =
            transition(&problem).unwrap_or_else(|infeasible| panic!("{count} at {apart}: {infeasible:?}"));
        let least = plan.lower_bound_s + 0.62;
        assert!(plan.duration.as_secs() <= least * 1.2, "{count} at {apart}: {:?} {least}", plan.duration);
        assert!(plan.closest.unwrap().distance_m >= 0.057 - 1e-6);
        for (path, goal) in plan.paths.iter().zip(&plan.goal_of) {
            assert_eq!(path.as_ref().end(), problem.goals[goal.unwrap()]);
            assert_eq!(path.as_ref().duration(), plan.duration);
        }
    }
}

#[test]
fn a_roomy_floor_is_crossed_at_its_lower_bound() {
    let mut seeded = Seeded::new(9);
    for _ in 0..20 {
        let starts = scatter(&mut seeded, 30, 0.15, 1.5).unwrap();
        let goals = scatter(&mut seeded, 30, 0.15, 1.5).unwrap();
        let plan = transition(&problem(starts, goals, 1.5)).unwrap();
        assert!(plan.duration.as_secs() <= (plan.lower_bound_s + 0.62) * 1.031);
    }
}

#[test]
fn pins_are_kept_and_counted_in_the_lower_bound() {
    let starts = vec![Vec2::new(-1.0, 0.0), Vec2::new(0.0, 0.3), Vec2::new(1.0, 0.0)];
    let goals = vec![Vec2::new(0.9, 0.0), Vec2::new(-0.9, 0.2), Vec2::new(0.1, 0.6)];
    let mut problem = problem(starts, goals, 1.5);
    problem.pinned = vec![Some(0)];
    let plan = transition(&problem).unwrap();
    assert_eq!(plan.goal_of[0], Some(0));
    assert!((plan.lower_bound_s - 1.9 / 0.27).abs() < 1e-9);
    problem.pinned = vec![Some(0), Some(0)];
    assert!(transition(&problem).unwrap_err().message.contains("bound"));
}

#[test]
fn a_spare_robot_stays_or_steps_aside() {
    let starts = vec![Vec2::new(-1.0, 0.0), Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0)];
    let stays = transition(&problem(starts.clone(), vec![Vec2::new(-0.8, 0.5)], 1.5)).unwrap();
    assert_eq!(stays.goal_of, [Some(0), None, None]);
    assert_eq!(stays.paths[2].as_ref().end(), starts[2]);
    // The pixel lies on the spare robot and is pinned to another.
    let mut aside = problem(starts, vec![Vec2::new(0.01, 0.0)], 1.5);
    aside.pinned = vec![Some(0)];
    let plan = transition(&aside).unwrap();
    assert_eq!(plan.goal_of, [Some(0), None, None]);
    assert!(plan.paths[1].as_ref().end().distance(Vec2::new(0.01, 0.0)) >= 0.057);
}

/// Two robots that drive 1.5 m together, 81 mm apart at starts and ends. On straight lines they come within 64 mm.
fn pair_that_turns(apart_at_start: Vec2, apart_at_end: Vec2) -> TransitionProblem {
    let ends = [Vec2::new(-0.75, 0.0), Vec2::new(0.75, 0.0)];
    let starts = vec![ends[0], ends[0] + apart_at_start];
    let mut pair = problem(starts, vec![ends[1], ends[1] + apart_at_end], 1.5);
    pair.pinned = vec![Some(0), Some(1)];
    pair
}

#[test]
fn a_robot_behind_another_gets_room_to_stop_and_one_beside_it_does_not() {
    let in_line = pair_that_turns(Vec2::new(0.064, 0.05), Vec2::new(0.064, -0.05));
    let least = transition(&in_line).unwrap().least;
    for seconds in [None, Some(6.4), Some(15.0)] {
        let duration = seconds.map(Span::from_secs);
        let plan = transition(&TransitionProblem { duration, ..in_line.clone() }).unwrap();
        assert_eq!(plan.least, least, "whatever was asked for");
        assert!(plan.closest.unwrap().distance_m >= 0.074, "{:?}", plan.closest);
        assert!(plan.least.as_secs() <= (plan.lower_bound_s + 0.62) * 1.025, "{:?}", plan.least);
    }
    let beside = pair_that_turns(Vec2::new(0.05, 0.064), Vec2::new(-0.05, 0.064));
    assert!(transition(&beside).unwrap().closest.unwrap().distance_m < 0.0645);
}

#[test]
fn a_set_duration_is_met_and_the_least_is_known() {
    let mut slow = problem(vec![Vec2::ZERO], vec![Vec2::new(0.54, 0.0)], 1.5);
    slow.duration = Some(Span::from_millis(7_500));
    slow.easing = Easing::Gentle;
    let plan = transition(&slow).unwrap();
    assert_eq!(plan.duration.0, 7_500_000);
    assert_eq!(plan.least.0, 3_350_000);
}

#[test]
fn a_repaired_way_knows_its_least_time_whatever_was_asked_for() {
    let (a, b) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
    for easing in [Easing::Swift, Easing::Gentle] {
        let mut crossing = problem(vec![a, b], vec![b, a], 1.5);
        (crossing.pinned, crossing.easing) = (vec![Some(0), Some(1)], easing);
        let quickest = transition(&crossing).unwrap();
        assert_eq!(quickest.least, quickest.duration);
        assert!(quickest.closest.unwrap().distance_m < 0.5);
        crossing.duration = Some(Span::from_millis(20_000));
        let slow = transition(&crossing).unwrap();
        assert_eq!(slow.least, quickest.least);
        assert!((slow.duration.as_secs() - 20.0).abs() < 1e-3);
        crossing.duration = Some(quickest.least);
        assert_eq!(transition(&crossing).unwrap().duration, quickest.least);
    }
}

#[test]
fn a_bent_way_knows_its_least_time_whatever_was_asked_for() {
    // On straight lines they come within 56.6 mm of each other, at full speed.
    let starts = vec![Vec2::new(-0.5, 0.0), Vec2::new(0.08, -0.5)];
    let goals = vec![Vec2::new(0.5, 0.0), Vec2::new(0.08, 0.5)];
    for easing in [Easing::Swift, Easing::Gentle] {
        let mut crossing = problem(starts.clone(), goals.clone(), 1.5);
        (crossing.pinned, crossing.easing) = (vec![Some(0), Some(1)], easing);
        let quickest = transition(&crossing).unwrap();
        assert_eq!(quickest.least, quickest.duration);
        assert!(quickest.closest.unwrap().distance_m >= 0.057);
        crossing.duration = Some(Span::from_millis(20_000));
        let slow = transition(&crossing).unwrap();
        assert_eq!(slow.least, quickest.least, "{easing:?}");
        assert_eq!(slow.duration.0, 20_000_000);
        assert!(slow.closest.unwrap().distance_m >= 0.057);
        let rests = slow.paths.iter().all(|path| path.pieces[0].duration.0 < 400_000);
        assert!(rests, "they turn for as long as they need and then drive all the time");
        crossing.duration = Some(quickest.least);
        assert_eq!(transition(&crossing).unwrap().duration, quickest.least);
    }
}

#[test]
fn what_cannot_be_shown_is_said() {
    let starts = vec![Vec2::ZERO, Vec2::new(0.5, 0.0)];
    let close =
        transition(&problem(starts.clone(), vec![Vec2::ZERO, Vec2::new(0.05, 0.0)], 1.5)).unwrap_err();
    assert_eq!(close.goals, [0, 1]);
    assert!(close.message.contains("50 mm") && close.message.contains("57 mm"), "{}", close.message);
    let off = transition(&problem(starts.clone(), vec![Vec2::new(1.49, 0.0)], 1.5)).unwrap_err();
    assert_eq!(off.goals, [0]);
    let many = transition(&problem(starts, vec![Vec2::ZERO; 3], 1.5)).unwrap_err();
    assert!(many.message.contains("3 pixels"));
}

#[test]
fn no_robots_and_no_distance_are_fine() {
    let plan = transition(&problem(Vec::new(), Vec::new(), 1.5)).unwrap();
    assert!(plan.paths.is_empty() && plan.closest.is_none());
    let starts = vec![Vec2::ZERO, Vec2::new(0.5, 0.0)];
    let plan = transition(&problem(starts.clone(), starts, 1.5)).unwrap();
    assert_eq!(plan.duration.0, 0);
}

#[test]
fn robots_that_must_cross_are_led_around_each_other() {
    let mut seeded = Seeded::new(31);
    for _ in 0..6 {
        let count = 4 + seeded.below(20);
        let starts = scatter(&mut seeded, count, 0.12, 1.5).unwrap();
        let goals = scatter(&mut seeded, count, 0.12, 1.5).unwrap();
        let mut fixed = problem(starts, goals, 1.5);
        fixed.pinned = (0..count).map(Some).collect();
        let plan = transition(&fixed).unwrap_or_else(|infeasible| panic!("{count}: {infeasible:?}"));
        assert!(plan.closest.unwrap().distance_m >= 0.057 - 1e-6);
        assert!(plan.duration.as_secs() <= (plan.lower_bound_s + 0.62) * 1.2);
    }
}

/// A square grid that fills its floor, with fixed identity.
fn shuffled(side: usize, apart: f64) -> TransitionProblem {
    let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * apart;
    let starts: Vec<Vec2> = (0..side * side).map(|i| Vec2::new(at(i % side), at(i / side))).collect();
    let (mut goals, mut seeded) = (starts.clone(), Seeded::new(7));
    (1..goals.len()).rev().for_each(|last| goals.swap(last, seeded.below(last + 1)));
    let mut fixed = problem(starts, goals, side as f64 * apart / 2.0);
    fixed.pinned = (0..side * side).map(Some).collect();
    fixed
}

#[test]
fn robots_in_each_others_way_are_named_with_a_distance_that_suffices() {
    let infeasible = transition(&shuffled(6, 0.058)).unwrap_err();
    let message = &infeasible.message;
    assert!((2..=8).contains(&message.matches("to (").count()), "{message}");
    assert!(message.contains(" near (") && message.contains("pixels 122 mm apart"), "{message}");
    assert!(infeasible.goals.len() >= 2 && infeasible.goals.len() == infeasible.starts.len());
    for side in [6, 9] {
        transition(&shuffled(side, 0.122)).unwrap_or_else(|infeasible| panic!("{side}: {infeasible:?}"));
    }
}

#[test]
fn two_robots_that_cannot_pass_in_a_corridor_are_named_alone() {
    let places: Vec<Vec2> = (0..6).map(|i| Vec2::new(f64::from(i) * 0.2 - 0.5, 0.0)).collect();
    let mut goals = places.clone();
    goals.swap(2, 3);
    let mut corridor = problem(places, goals, 0.03);
    corridor.half_floor.x = 0.6;
    corridor.pinned = (0..6).map(Some).collect();
    let infeasible = transition(&corridor).unwrap_err();
    assert_eq!(infeasible.goals, [2, 3], "{}", infeasible.message);
    let expected = "to (0.10, 0.00) and to (-0.10, 0.00) near (0.00, 0.00) m; leave more room";
    assert!(infeasible.message.contains(expected), "{}", infeasible.message);
}
