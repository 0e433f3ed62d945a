//! Issues (errors and warnings for the user) that planning finds in the frames of a show.

use crate::margins::MARGIN_M;
use crate::transition::touching;
use crate::{BindingIssue, Bindings, BoundFrame, Infeasible, Transition};
use lightbots_base::Vec2;
use lightbots_show::{Issue, Issues, Pixel, Show, frame_label, robots_asked_for};

/// Adds errors of frame `index` that no plan can solve. These are too few robots, or pixels that are too close to each
/// other, to the floor's edge or to no-go areas. `dark`: ids of pixels without a robot.
pub(super) fn of_frame(show: &Show, index: usize, robots: usize, dark: &[u32], issues: &mut Issues) {
    let frame = &show.frames[index];
    let name = name_of(show, index);
    let limits = &show.stage.limits;
    if frame.pixels.len() > robots {
        let message = format!("{name} has {} pixels, but there are {robots} robots", frame.pixels.len());
        issues
            .push(Issue::error("too-few-robots", message).in_frame(index).with_pixels(dark.iter().copied()));
    }
    let places: Vec<Vec2> = frame.pixels.iter().map(|pixel| pixel.at).collect();
    if let Some((a, b, distance)) = touching(&places, limits.contact_m()) {
        let (a, b) = (frame.pixels[a].id, frame.pixels[b].id);
        let message = format!(
            "{name}: pixels {a} and {b} are {:.0} mm apart and would touch; {:.0} mm do",
            distance * 1e3,
            (limits.contact_m() + MARGIN_M) * 1e3
        );
        issues.push(Issue::error("too-close", message).in_frame(index).with_pixels([a, b]));
    }
    let half = Vec2::new(show.stage.width_m, show.stage.depth_m) / 2.0;
    let radius = limits.radius_m;
    let list = |code: &str, what: &str, wrong: Vec<u32>, issues: &mut Issues| {
        if !wrong.is_empty() {
            let message = format!("{name}: {what} (pixels {})", few(&wrong));
            issues.push(Issue::error(code, message).in_frame(index).with_pixels(wrong));
        }
    };
    let off = |at: Vec2| !(at.x.abs() <= half.x - radius + 1e-6 && at.y.abs() <= half.y - radius + 1e-6);
    let ids = |wrong: &dyn Fn(Vec2) -> bool| -> Vec<u32> {
        frame.pixels.iter().filter(|pixel| wrong(pixel.at)).map(|pixel| pixel.id).collect()
    };
    let what = format!("robots need {:.0} mm to the floor's edge", radius * 1e3);
    list("off-floor", &what, ids(&off), issues);
    let blocked = |at: Vec2| show.stage.obstacles.iter().any(|thing| thing.gap_m(at) < radius);
    list("in-obstacle", &format!("robots need {:.0} mm to no-go areas", radius * 1e3), ids(&blocked), issues);
}

/// Returns the error for a frame to which no legal drive was found.
pub(super) fn no_plan(show: &Show, index: usize, pixels: &[&Pixel], infeasible: &Infeasible) -> Issue {
    let ids: Vec<u32> =
        infeasible.goals.iter().filter_map(|&goal| pixels.get(goal)).map(|pixel| pixel.id).collect();
    let whose = match ids.len() {
        0 => String::new(),
        1 => format!(", pixel {}", ids[0]),
        _ => format!(", pixels {}", few(&ids)),
    };
    let message = format!("no plan to {}{whose}: {}", name_of(show, index), infeasible.message);
    Issue::error("no-plan", message).in_frame(index).with_pixels(ids)
}

/// Returns the warning for a drive that is not the drive that the show prescribes.
pub(super) fn not_as_prescribed(show: &Show, index: usize, why: &str) -> Issue {
    let message = format!("the drive to {} is an ordinary one: {why}", name_of(show, index));
    Issue::warning("not-as-prescribed", message).in_frame(index)
}

/// Returns the warning for a drive that takes longer than the frame asks for.
pub(super) fn takes_longer(show: &Show, index: usize, asked_s: f64, takes_s: f64) -> Issue {
    let name = name_of(show, index);
    let message = format!(
        "the drive to {name} takes {takes_s:.2} s instead of the {asked_s:.2} s asked for: robots cannot be quicker; set at least {takes_s:.2} s"
    );
    Issue::warning("takes-longer", message).in_frame(index)
}

/// Largest deviation of a frame's begin from its absolute time that gets no warning, seconds.
const IN_TIME_S: f64 = 0.05;

/// Adds a warning for each frame that does not begin at its absolute time (`Frame::at_s`), with a remedy.
pub(super) fn of_nails(show: &Show, transitions: &[Transition], issues: &mut Issues) {
    let mut begins_s = 0.0;
    for (index, (frame, transition)) in show.frames.iter().zip(transitions).enumerate() {
        let drive_s = transition.duration.as_secs();
        // The timeline begins with the air time of the first frame.
        begins_s += if index == 0 { 0.0 } else { drive_s };
        if let Some(at_s) = frame.at_s.filter(|at_s| (at_s - begins_s).abs() > IN_TIME_S) {
            let name = name_of(show, index);
            let by_s = (at_s - begins_s).abs();
            let remedy = if index == 0 {
                "the timeline begins with the first frame: nail it to 0 s, or to no moment".into()
            } else if at_s < begins_s {
                format!("make the frames before it {by_s:.2} s shorter, or nail it to {begins_s:.2} s")
            } else {
                format!("let the frame before it stand {by_s:.2} s longer, or nail it to {begins_s:.2} s")
            };
            let message = format!("{name} is nailed to {at_s:.2} s and begins at {begins_s:.2} s; {remedy}");
            issues.push(Issue::warning("not-in-time", message).in_frame(index));
        }
        begins_s += frame.air_time_s.max(0.0);
    }
}

/// Adds an error if pixels ask for more names than there are robots, and it is not known which robot has which name.
pub(super) fn of_names(show: &Show, robots: usize, bindings: &Bindings, issues: &mut Issues) {
    let names = robots_asked_for(show);
    if !bindings.names_known && names > robots {
        let message = format!("pixels ask for {names} robots by name, but there are {robots} robots");
        issues.push(Issue::error("too-few-robots", message));
    }
}

/// Adds an issue for each problem of the bindings of pixels to robots in a frame.
pub(super) fn of_bound_frame(show: &Show, frame: usize, bound: &BoundFrame<'_>, issues: &mut Issues) {
    for &(id, issue) in &bound.issues {
        let pixel = show.frames[frame].pixels.iter().find(|pixel| pixel.id == id);
        let name = pixel.and_then(|pixel| pixel.robot.as_deref()).unwrap_or_default();
        let frame_name = name_of(show, frame);
        let issue = match issue {
            BindingIssue::BoundTwice => {
                let what = format!("robot {name} is asked for twice, pixel {id} stays dark");
                Issue::error("robot-bound-twice", format!("{frame_name}: {what}"))
            }
            BindingIssue::Unknown => {
                let what = format!("pixel {id} asks for robot {name}, which is not here; it stays dark");
                Issue::warning("unknown-robot", format!("{frame_name}: {what}"))
            }
            BindingIssue::Lost => {
                let then = if bound.dark.contains(&id) { "stays dark" } else { "gets another robot" };
                let what = format!(
                    "the robot that showed pixel {id} before must show another pixel, though identity is fixed; \
                     pixel {id} {then}"
                );
                Issue::warning("robot-bound-to-another", format!("{frame_name}: {what}"))
            }
        };
        issues.push(issue.in_frame(frame).with_pixels([id]));
    }
}

fn name_of(show: &Show, index: usize) -> String {
    frame_label(index, &show.frames[index].name)
}

/// Lists the first eight ids as text, and counts the others.
fn few(ids: &[u32]) -> String {
    let mut text: Vec<String> = ids.iter().take(8).map(u32::to_string).collect();
    if ids.len() > 8 {
        text.push(format!("and {} more", ids.len() - 8));
    }
    text.join(", ")
}
