//! Pictures that move as one: no contacts, and robots stay on their paths.

#[path = "../../examples/motions/shows.rs"]
mod shows;

use crate::five_frames::play;
use lightbots_show::PictureMotion;
use lightbots_sim::{Conditions, RehearsalReport};

/// Largest tracking error for up to 100 robots, metres, as in the table of numbers.
const TRACKING_M: f64 = 0.006;

fn assert_fine(report: &RehearsalReport, what: &str) {
    assert_eq!((report.contacts, report.dropouts), (0, 0), "{what}: {:?}", report.issues);
    assert!(report.ok && report.frames_played == 3, "{what}: {:?}", report.issues);
}

#[test]
fn pictures_move_without_contacts() {
    for count in [30, 100] {
        for motion in shows::motions(count) {
            let show = shows::show(&motion, count);
            let what = format!("{} of {count}", motion.name());
            let report = play(&show, "", 1, Conditions::default());
            assert_fine(&report, &what);
            let tracking_m = report.tracking_error_m.max;
            assert!(tracking_m < TRACKING_M, "{what}: {:.1} mm", tracking_m * 1e3);
        }
    }
}

#[test]
fn pictures_move_while_messages_are_lost() {
    for (seed, motion) in shows::motions(30).iter().enumerate() {
        let report = play(&shows::show(motion, 30), "loss=5%", seed as u64, Conditions::default());
        assert_fine(&report, motion.name());
    }
}

#[test]
fn a_robot_that_dies_in_a_motion_is_driven_around() {
    for (seed, motion) in shows::motions(30).iter().enumerate() {
        let show = shows::show(motion, 30);
        // The drive to the first frame takes about 8 s, its air time 1 s.
        let report = play(&show, "kill=7@11", seed as u64, Conditions::default());
        assert_eq!((report.contacts, report.dropouts), (0, 1), "{}: {:?}", motion.name(), report.issues);
        assert_eq!(report.frames_played, 3, "{}: {:?}", motion.name(), report.issues);
    }
}

#[test]
fn robots_begin_one_after_the_other() {
    let plain = shows::show(&PictureMotion::Travel { along: vec![lightbots_base::Vec2::new(0.4, 0.0)] }, 30);
    let mut show = plain.clone();
    show.frames[1].motion = Some(PictureMotion::Stagger { direction: std::f64::consts::PI, delay_s: 2.0 });
    let report = play(&show, "", 1, Conditions::default());
    assert_fine(&report, "stagger");
    show.frames[1].motion = None;
    let without = play(&show, "", 1, Conditions::default());
    assert!(report.planned_s > without.planned_s + 1.0, "{} and {} s", report.planned_s, without.planned_s);
}
