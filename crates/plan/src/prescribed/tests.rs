use super::*;
use crate::proof::prove;
use crate::{ShowOptions, ShowPlan, TransitionProblem};
use lightbots_base::Span;
use lightbots_show::{Frame, Pixel, Trajectory, TrajectoryPiece};
use std::f64::consts::{FRAC_PI_2, PI};

fn frame(places: impl IntoIterator<Item = Vec2>) -> Frame {
    let pixel = |(id, at): (u32, Vec2)| Pixel { id, at, ..Pixel::default() };
    Frame { air_time_s: 1.0, pixels: (0..).zip(places).map(pixel).collect(), ..Frame::default() }
}

/// `side` × `side` places, `pitch_m` apart, about the middle.
fn grid(side: usize, pitch_m: f64) -> Vec<Vec2> {
    let middle = (side as f64 - 1.0) / 2.0;
    let at = |nth: usize| Vec2::new((nth % side) as f64 - middle, (nth / side) as f64 - middle) * pitch_m;
    (0..side * side).map(at).collect()
}

/// A show of a picture and the picture after a motion.
fn show(places: Vec<Vec2>, motion: PictureMotion) -> Show {
    let first = frame(places);
    let second = Frame { motion: Some(motion.clone()), ..frame(moved(&motion, &first).into_values()) };
    Show { frames: vec![first, second], ..Show::default() }
}

/// The plan for robots that stand on the first picture.
fn plan(show: &Show) -> ShowPlan {
    let starts: Vec<Vec2> = show.frames[0].pixels.iter().map(|pixel| pixel.at).collect();
    crate::show(show, &starts, &ShowOptions::default())
}

fn problem(show: &Show) -> TransitionProblem {
    let starts = show.frames[0].pixels.iter().map(|pixel| pixel.at).collect();
    let pixels: Vec<&Pixel> = show.frames[1].pixels.iter().collect();
    let pinned = vec![None; pixels.len()];
    TransitionProblem::of_frame(show, 1, starts, &BoundFrame { pixels, pinned, ..BoundFrame::default() })
}

/// Asserts that the second transition is the prescribed one, and proves it once more.
fn assert_prescribed(show: &Show, what: &str) -> ShowPlan {
    let plan = plan(show);
    assert!(plan.ok() && plan.issues.is_empty(), "{what}: {:?}", plan.issues);
    assert_eq!(plan.explanations[1].reason, "the show prescribes it", "{what}");
    let proof = prove(&problem(show).to_prove(&plan.transitions[1].paths));
    assert!(proof.holds(), "{what}: {proof:?}");
    plan
}

fn motions() -> Vec<PictureMotion> {
    vec![
        PictureMotion::Travel { along: vec![Vec2::new(0.4, 0.1)] },
        PictureMotion::Travel { along: vec![Vec2::new(0.2, 0.3), Vec2::new(0.5, 0.1), Vec2::new(0.3, -0.2)] },
        PictureMotion::Turn { center: Vec2::ZERO, turn: FRAC_PI_2, size: 1.0 },
        PictureMotion::Turn { center: Vec2::new(0.3, 0.0), turn: -2.0, size: 1.2 },
        PictureMotion::Breathe { center: Vec2::ZERO, size: 1.4, times: 3 },
        PictureMotion::Breathe { center: Vec2::new(0.1, 0.1), size: 0.9, times: 1 },
        PictureMotion::Wave { radius_m: 0.03, direction: 0.4, length_m: 1.0, times: 2 },
    ]
}

#[test]
fn every_motion_is_proven_and_begins_and_ends_at_rest_on_its_pixels() {
    for (places, motion) in
        [3, 6, 10].into_iter().flat_map(|side| motions().into_iter().map(move |m| (grid(side, 0.1), m)))
    {
        let what = format!("{} {motion:?}", places.len());
        let show = show(places, motion);
        let plan = assert_prescribed(&show, &what);
        for (path, shown) in plan.transitions[1].paths.iter().zip(&plan.mapping[1]) {
            let pixel = show.frames[1].pixels.iter().find(|pixel| Some(pixel.id) == *shown).unwrap();
            assert_eq!(path.as_ref().end(), pixel.at, "{what}");
            assert_eq!(path.as_ref().duration(), plan.transitions[1].duration, "{what}");
        }
    }
}

#[test]
fn robots_keep_their_distances_in_a_picture_that_travels_and_turns() {
    for motion in [
        PictureMotion::Travel { along: vec![Vec2::new(0.2, 0.3), Vec2::new(0.5, 0.1)] },
        PictureMotion::Turn { center: Vec2::new(0.2, 0.1), turn: 3.0, size: 1.0 },
    ] {
        let plan = assert_prescribed(&show(grid(5, 0.09), motion.clone()), motion.name());
        let transition = &plan.transitions[1];
        let at = |robot: usize, share: i64| {
            transition.paths[robot].as_ref().at(Span(transition.duration.0 * share / 50)).position
        };
        for (a, b) in [(0, 1), (0, 24), (7, 18)] {
            let before_m = at(a, 0).distance(at(b, 0));
            let worst = (0..=50).map(|share| (at(a, share).distance(at(b, share)) - before_m).abs());
            let worst = worst.fold(0.0, f64::max);
            assert!(worst < 5e-4, "{}: {:.2} mm", motion.name(), worst * 1e3);
        }
    }
}

#[test]
fn a_turn_is_driven_at_its_limit_and_refused_above() {
    let mut show = show(grid(10, 0.1), PictureMotion::Turn { center: Vec2::ZERO, turn: PI, size: 1.0 });
    let least = plan(&show).transitions[1].least;
    // The corners are 0.636 m from the middle: half a circle takes 7.4 s at full speed.
    assert!((7.4..8.6).contains(&least.as_secs()), "{} s", least.as_secs());
    show.frames[1].transition_s = Some(least.as_secs());
    assert_eq!(assert_prescribed(&show, "at the limit").transitions[1].duration, least);
    show.frames[1].transition_s = Some(least.as_secs() - 0.1);
    let refused = plan(&show);
    let message = &refused.issues.iter().find(|issue| issue.is_error()).unwrap().message;
    assert!(!refused.ok() && message.contains("the turn takes at least"), "{message}");
    show.frames[1].transition_s = Some(20.0);
    assert_eq!(assert_prescribed(&show, "slower").transitions[1].duration, Span::from_secs(20.0));
}

#[test]
fn a_motion_that_leads_robots_together_names_the_place() {
    let refused =
        plan(&show(grid(5, 0.1), PictureMotion::Breathe { center: Vec2::ZERO, size: 0.6, times: 1 }));
    let message = &refused.issues.iter().find(|issue| issue.is_error()).unwrap().message;
    assert!(message.contains("in the breath, two robots would come within"), "{message}");
    let off =
        plan(&show(grid(5, 0.1), PictureMotion::Travel { along: vec![Vec2::new(0.0, 1.6), Vec2::ZERO] }));
    let message = &off.issues.iter().find(|issue| issue.is_error()).unwrap().message;
    assert!(message.contains("leave the floor"), "{message}");
}

#[test]
fn robots_follow_the_leader_around_corners() {
    let line: Vec<Vec2> = (0..12).map(|nth| Vec2::new(-0.1 * f64::from(nth), 0.0)).collect();
    let along = vec![Vec2::ZERO, Vec2::new(0.3, 0.0), Vec2::new(0.4, 0.3), Vec2::new(0.0, 0.6)];
    let show = show(line, PictureMotion::Follow { along });
    let plan = assert_prescribed(&show, "follow");
    let ends: Vec<Vec2> = show.frames[1].pixels.iter().map(|pixel| pixel.at).collect();
    assert!(ends[0].distance(Vec2::new(0.0, 0.6)) < 0.002, "the leader ends at the end of the curve");
    assert!(ends.windows(2).all(|pair| (0.08..0.102).contains(&pair[0].distance(pair[1]))), "{ends:?}");
    assert!(plan.transitions[1].closest.unwrap().distance_m > 0.08);
}

#[test]
fn robots_elsewhere_get_an_ordinary_drive_and_a_warning() {
    let mut show = show(grid(4, 0.1), PictureMotion::Turn { center: Vec2::ZERO, turn: 1.0, size: 1.0 });
    show.frames[1].pixels[3].at += Vec2::new(0.02, 0.0);
    let elsewhere = plan(&show);
    assert!(elsewhere.ok(), "{:?}", elsewhere.issues);
    assert_eq!(
        elsewhere.issues.iter().map(|issue| &issue.code[..]).collect::<Vec<_>>(),
        ["not-as-prescribed"]
    );
    // A first frame has no picture before it.
    let first = Show { frames: vec![show.frames[1].clone()], ..show };
    assert!(plan(&first).ok());
}

#[test]
fn robots_drive_through_a_picture_in_between() {
    let [first, second] = [grid(4, 0.1), grid(4, 0.12)];
    let ring = (0..16).map(|nth| Vec2::unit(f64::from(nth) * PI / 8.0) * 0.5).collect::<Vec<_>>();
    let motion = PictureMotion::Morph { through: vec![ring.clone()] };
    let goals = Frame { motion: Some(motion), ..frame(second) };
    let show = Show { frames: vec![frame(first), goals], ..Show::default() };
    let plan = assert_prescribed(&show, "morph");
    let paths = &plan.transitions[1].paths;
    for at in ring {
        let nearest = (0..=400).flat_map(|step| {
            let moment = Span(plan.transitions[1].duration.0 * step / 400);
            paths.iter().map(move |path| path.as_ref().at(moment).position.distance(at))
        });
        assert!(nearest.fold(f64::INFINITY, f64::min) < 0.005, "no robot came to {at:?}");
    }
}

#[test]
fn trajectories_of_the_show_are_driven_as_they_are() {
    let mut show = show(
        vec![Vec2::ZERO, Vec2::new(0.3, 0.0)],
        PictureMotion::Travel { along: vec![Vec2::new(0.0, 0.4)] },
    );
    show.frames[1].motion = None;
    show.frames[1].id = Some("up".into());
    // Speed rises and falls without a step: a cubic from rest to rest.
    let rise = |x: f64| Trajectory {
        frame: Some("up".into()),
        pixel: u32::from(x > 0.1),
        at_s: 0.5,
        start: Vec2::new(x, 0.0),
        pieces: vec![TrajectoryPiece {
            end_s: 3.0,
            controls: Some([Vec2::new(x, 0.0), Vec2::new(x, 0.4)]),
            end: Vec2::new(x, 0.4),
        }],
    };
    show.trajectories = vec![rise(0.0), rise(0.3)];
    let driven = assert_prescribed(&show, "trajectories");
    assert_eq!(driven.transitions[1].duration, Span::from_secs(3.5));
    show.trajectories[1].pieces[0].end_s = 1.0;
    let refused = plan(&show);
    let message = &refused.issues.iter().find(|issue| issue.is_error()).unwrap().message;
    assert!(message.contains("faster than it can") && message.contains("give it more time"), "{message}");
}
