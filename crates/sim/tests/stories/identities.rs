//! Random shows with pixels that any robot may show, that keep their robot, or that request a robot by name. The lights
//! on the floor show the frame, and the run is the plan that was checked.

#[path = "../../examples/identities/hall.rs"]
mod hall;
#[path = "../../examples/identities/scene.rs"]
mod scene;
#[path = "../../examples/identities/verdict.rs"]
mod verdict;

use lightbots_sim::Conditions;

#[test]
fn the_picture_is_the_frame_and_shown_by_the_robots_of_the_plan() {
    let mut numbers = [0; 3];
    for number in 0..120 {
        let scene = scene::scene(number);
        let pixels = scene.show.frames[0].pixels.len();
        numbers[(scene.starts.len() + 1).saturating_sub(pixels).min(2)] += 1;
        let faults = verdict::faults(number, &scene, &Conditions::ideal());
        assert!(faults.is_empty(), "{number}: {faults:#?}");
    }
    assert!(
        numbers.iter().all(|&scenes| scenes > 20),
        "with fewer robots than pixels, as many, more: {numbers:?}"
    );
}

#[test]
fn the_picture_is_the_frame_with_noise_and_slip() {
    for number in 200..260 {
        let faults = verdict::faults(number, &scene::scene(number), &Conditions::default());
        assert!(faults.is_empty(), "{number}: {faults:#?}");
    }
}
