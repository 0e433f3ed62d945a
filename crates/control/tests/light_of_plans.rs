//! The light that the editor computes from a plan equals the light of that plan's run.

mod fleet;

use fleet::{World, show};
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_lighting::{FrameTimes, LightMoment, LitFrame, ShowLight, planned};
use lightbots_plan::ShowOptions;
use lightbots_show::{FramePhase, Layer, LayerSpan, Setting, Show};

/// Number of robots, and of pixels in each frame.
const ROBOTS: usize = 9;
/// Largest difference in time between the two lights, milliseconds.
const IN_TIME_MS: i64 = 25;

/// A show with six moving layers: in drives, in pictures and over the whole show. Some use the robot's number.
fn lit() -> Show {
    let mut show = show(4, ROBOTS, 3.0);
    for (number, frame) in show.frames.iter_mut().enumerate() {
        frame.id = Some(number.to_string());
    }
    let frames = |phase| LayerSpan::Frames { first: "0".into(), last: "3".into(), phase };
    let layer = |kind: &str, span: LayerSpan, settings: Vec<(&str, Setting)>| {
        let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Layer { name: String::new(), kind: kind.into(), span, settings }
    };
    let added = || ("blend", Setting::Text("add".into()));
    show.layers = vec![
        layer("rainbow", LayerSpan::Show, vec![("speed_hz", Setting::Number(0.2))]),
        layer("chase", frames(FramePhase::Transition), vec![added()]),
        layer("plasma", frames(FramePhase::Picture), vec![added()]),
        layer("twinkle", LayerSpan::Show, vec![("speed_hz", Setting::Number(0.5)), added()]),
        layer("ripple", LayerSpan::Seconds { from_s: 1.0, to_s: 9.0 }, vec![added()]),
        layer("by-speed", frames(FramePhase::Whole), vec![("blend", Setting::Text("average".into()))]),
    ];
    show
}

/// A planned show, from which colours are computed as in the editor.
struct Planned<'a> {
    light: ShowLight,
    frames: Vec<LitFrame<'a>>,
    times: Vec<FrameTimes>,
}

impl Planned<'_> {
    /// The colour of a robot `elapsed` after the drive to a frame began.
    fn colour(&self, robot: usize, frame: usize, elapsed: Span) -> Rgb {
        let times = self.times[frame];
        let elapsed = elapsed.clamp(Span::ZERO, Span::from_secs(times.end_s - times.drive_s - 1e-6));
        let show_s = times.drive_s + elapsed.as_secs();
        let moment = LightMoment { elapsed, show_s, lead_s: 0.0, clock_s: 0.0 };
        let shines = self.light.in_frame(frame, |frame| self.times.get(frame).copied());
        self.frames[frame].robots[robot].colour(&shines, self.light.pictures(), moment)
    }
}

fn difference(one: Rgb, other: Rgb) -> u8 {
    one.r.abs_diff(other.r).max(one.g.abs_diff(other.g)).max(one.b.abs_diff(other.b))
}

#[test]
fn the_light_of_a_plan_is_that_of_its_run() {
    let show = lit();
    let mut world = World::ready(ROBOTS, 0, show.clone());
    let starts: Vec<Vec2> = world.robots.iter().map(|robot| robot.at).collect();
    let ids: Vec<RobotId> = world.robots.iter().map(|robot| robot.id).collect();
    let plan = lightbots_plan::show(&show, &starts, &ShowOptions::default());
    let mut times: Vec<FrameTimes> = Vec::new();
    for (way, frame) in plan.transitions.iter().zip(&show.frames) {
        let end_s = times.last().map(|times| times.end_s);
        times.push(FrameTimes::after(end_s, way.duration.as_secs(), frame.air_time_s));
    }
    let editor = Planned { light: ShowLight::new(&show).0, frames: planned(&show, &plan), times };
    world.play();
    let mut drives: Vec<(Instant, usize)> = Vec::new();
    let mut compared = 0;
    while compared == 0 || world.controller.has_run() {
        world.step();
        if let Some(paths) = world.controller.paths()
            && drives.last().is_none_or(|&(began, _)| began != paths.began)
        {
            drives.push((paths.began, paths.frame));
        }
        let now = world.now;
        let Some(&(began, frame)) = drives.iter().rev().find(|(began, _)| *began <= now) else { continue };
        for (id, colour) in world.controller.layered_lights(now) {
            let robot = ids.iter().position(|known| *known == id).unwrap();
            let at = |ms: i64| editor.colour(robot, frame, now - began + Span::from_millis(ms));
            let off = (-IN_TIME_MS..=IN_TIME_MS).step_by(5).map(|ms| difference(at(ms), colour)).min();
            let after_s = (now - began).as_secs();
            let wanted = at(0);
            assert!(
                off <= Some(2),
                "robot {robot}, frame {frame}, {after_s} s after its drive began: {colour}, not {wanted}"
            );
            compared += 1;
        }
    }
    assert!(compared > 5_000, "{compared} colours");
}
