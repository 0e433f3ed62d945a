//! Robots that keep all rules of the protocol that they implement.

use lightbots_base::Instant;
use lightbots_exam::{Ending, Exam, Options, RuleVerdict};

use crate::bench::Bench;
use crate::flaws::{Original, Right};

#[test]
fn our_robot_keeps_every_rule_that_shows() {
    let outcome = Bench::new(1, Right, Options::default()).run();
    outcome.assert_broken(&[]);
    assert_eq!(outcome.ending, Some(Ending::Done));
    assert_eq!(outcome.with(RuleVerdict::NotTried), []);
    assert_eq!(outcome.with(RuleVerdict::DoesNotKnow), []);
    assert_eq!(
        outcome.with(RuleVerdict::NotFromOutside),
        [1, 2, 11, 14, 26, 44, 46, 47, 49, 50, 51, 52, 54, 63]
    );
    assert!(outcome.took.as_secs() < 240.0, "{} s", outcome.took.as_secs());
}

#[test]
fn an_original_robot_is_told_what_it_misses() {
    let outcome = Bench::new(1, Original, Options::default()).run();
    outcome.assert_broken(&[]);
    assert_eq!(outcome.with(RuleVerdict::Keeps), [3, 4, 5, 6, 7, 8, 9, 13, 15, 16, 17, 18, 20, 21, 48]);
    assert_eq!(outcome.with(RuleVerdict::NotTried), []);
    assert!(outcome.with(RuleVerdict::DoesNotKnow).starts_with(&[10, 12, 19, 22, 23, 24, 25]));
}

#[test]
fn one_of_several_is_examined_by_its_name() {
    let several = Bench::new(3, Right, Options::default());
    let ids = several.ids();
    assert!(matches!(several.run().ending, Some(Ending::Several(names)) if names.len() == 3));
    let named = Bench::new(3, Right, Options { robot: Some(ids[0]), ..Options::default() }).run();
    named.assert_broken(&[]);
    assert_eq!(named.robot, Some(ids[0]));
}

#[test]
fn no_robot_and_an_unknown_name_are_reported() {
    assert_eq!(Bench::new(0, Right, Options::default()).run().ending, Some(Ending::NoRobot));
    let robot = lightbots_base::RobotId::new("another-robot");
    let outcome = Bench::new(1, Right, Options { robot, ..Options::default() }).run();
    assert_eq!(outcome.ending, Some(Ending::NoRobot));
}

#[test]
fn an_exam_that_is_given_up_before_a_robot_is_chosen_stops_no_robot() {
    let mut exam = Exam::new(Options::default());
    exam.connected(Instant::ZERO);
    while exam.next_publish().is_some() {}
    exam.give_up();
    assert_eq!(exam.next_publish(), None, "other robots on the broker may play a show");
}
