use super::*;
use crate::seeded::Seeded;
use crate::transition;
use lightbots_base::{Limits, Vec2};

fn on_floor(starts: Vec<Vec2>, goals: Vec<Vec2>) -> TransitionProblem {
    let pinned = (0..goals.len()).map(Some).collect();
    TransitionProblem {
        starts,
        goals,
        pinned,
        ..TransitionProblem::on_floor(Vec2::new(2.0, 2.0), Limits::ELISA_3)
    }
}

/// Two robots that drive one behind the other, with a gap of 6 mm between their rims.
fn queue() -> TransitionProblem {
    let at = |x: f64| Vec2::new(x, 0.0);
    on_floor(vec![at(-1.0), at(-1.06)], vec![at(1.0), at(0.94)])
}

#[test]
fn a_robot_that_follows_closely_falls_back_within_the_given_time() {
    let problem = queue();
    let mut plan = transition(&problem).unwrap();
    let before = (crate::proof::stop_safe::stop_safety(&plan.paths, &problem.limits), plan.duration);
    assert!(before.0.share() < 0.7, "{}", before.0.share());
    let after = raise(&problem, &mut plan);
    assert_eq!(after.share(), 1.0);
    assert_eq!(after, crate::proof::stop_safe::stop_safety(&plan.paths, &problem.limits));
    assert!(plan.duration > before.1 && plan.duration.0 as f64 <= 1.05 * before.1.0 as f64);
    assert!(crate::proof::prove(&problem.to_prove(&plan.paths)).holds());
    for (path, goal) in plan.paths.iter().zip(&problem.goals) {
        assert_eq!((path.as_ref().duration(), path.as_ref().end()), (plan.duration, *goal));
    }
}

#[test]
fn a_duration_that_was_asked_for_is_kept() {
    let problem = TransitionProblem { duration: Some(Span::from_secs(9.0)), ..queue() };
    let mut plan = transition(&problem).unwrap();
    let before = plan.clone();
    assert!(raise(&problem, &mut plan).share() < 1.0);
    assert_eq!(plan, before);
}

#[test]
fn a_plan_that_is_safe_stays_as_it_is() {
    let at = |x: f64, y: f64| Vec2::new(x, y);
    let problem = on_floor(vec![at(0.0, 0.0), at(0.0, 0.2)], vec![at(1.0, 0.0), at(1.0, 0.2)]);
    let mut plan = transition(&problem).unwrap();
    let before = plan.clone();
    assert_eq!(raise(&problem, &mut plan).share(), 1.0);
    assert_eq!(plan, before);
}

#[test]
fn crossing_crowds_get_no_less_safe_and_stay_proven() {
    let mut dice = Seeded::new(5);
    let mut raised = 0;
    for _ in 0..30 {
        let mut places = || {
            let mut places: Vec<Vec2> = Vec::new();
            while places.len() < 16 {
                let at = Vec2::new(dice.between(-0.4, 0.4), dice.between(-0.4, 0.4));
                if places.iter().all(|other| other.distance(at) > 0.08) {
                    places.push(at);
                }
            }
            places
        };
        let problem = on_floor(places(), places());
        let mut plan = transition(&problem).unwrap();
        let before = (crate::proof::stop_safe::stop_safety(&plan.paths, &problem.limits), plan.duration);
        let after = raise(&problem, &mut plan);
        assert!(after.share() >= before.0.share());
        assert!(plan.duration.0 as f64 <= 1.05 * before.1.0 as f64);
        assert!(crate::proof::prove(&problem.to_prove(&plan.paths)).holds());
        assert_eq!(after, crate::proof::stop_safe::stop_safety(&plan.paths, &problem.limits));
        raised += usize::from(after.share() > before.0.share());
    }
    assert!(raised >= 5, "raised in {raised} of 30");
}
