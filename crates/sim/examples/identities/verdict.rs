//! Compares the picture on the floor with the show and with the plan.

use std::collections::BTreeMap;

use lightbots_base::Rgb;
use lightbots_control::RunOutcome;
use lightbots_plan::{ShowOptions, ShowPlan};
use lightbots_show::{Frame, Identity, Show, most_pixels};
use lightbots_sim::{Conditions, RehearsalOptions, rehearse};

use super::hall::{Hall, Picture, Played};
use super::scene::{Scene, name};

/// Largest distance of a robot from its pixel, metres.
const NEAR_M: f64 = 0.012;
/// How much longer than its plan a run may be, seconds per frame: robots arrive a moment after their paths end.
const LATE_S: f64 = 0.25;
/// Share by which a run may be shorter than its plan, because drives are planned from noisy places.
const SHORTER: f64 = 0.02;

/// All deviations of a played scene from its show and its plan.
pub fn faults(number: u64, scene: &Scene, conditions: &Conditions) -> Vec<String> {
    let mut faults = live(number, scene, conditions);
    let most = most_pixels(&scene.show);
    if scene.starts.len() >= most {
        faults.extend(rehearsed(number, scene, conditions));
    }
    faults
}

/// Compares a rehearsal with the plan of the show as it is. Names stand for any robots there.
fn rehearsed(number: u64, scene: &Scene, conditions: &Conditions) -> Vec<String> {
    let mut faults = Vec::new();
    let plan = lightbots_plan::show(&scene.show, &scene.starts, &ShowOptions::default());
    let options = RehearsalOptions { seed: number, conditions: conditions.clone(), robots: None };
    let report = rehearse(&scene.show, &options, &mut |_| {});
    if !report.ok {
        faults.push(format!("rehearsed: {:?}", report.issues.iter().map(|i| &i.message).collect::<Vec<_>>()));
    }
    if let Some(dark) = report.issues.iter().find(|issue| issue.code == "pixels-dark") {
        faults.push(format!("rehearsed: {}", dark.message));
    }
    faults.extend(durations("rehearsed", report.duration_s, &plan, &scene.show));
    faults
}

fn durations(what: &str, played_s: f64, plan: &ShowPlan, show: &Show) -> Option<String> {
    let late_s = played_s - plan.duration_s;
    let is_as_planned = (-SHORTER * plan.duration_s..LATE_S * show.frames.len() as f64).contains(&late_s);
    (!is_as_planned).then(|| format!("{what}: {played_s:.2} s, planned {:.2} s", plan.duration_s))
}

/// Compares a live run with the plan of the same show. Every name is that of a robot.
fn live(number: u64, scene: &Scene, conditions: &Conditions) -> Vec<String> {
    let hall = Hall::new(&scene.show, scene.starts.clone(), number, conditions.clone());
    let names: Vec<String> = hall.ids().iter().map(ToString::to_string).collect();
    let mut show = scene.show.clone();
    for pixel in show.frames.iter_mut().flat_map(|frame| &mut frame.pixels) {
        let robot = pixel.robot.as_ref().and_then(|asked| (0..names.len()).find(|&r| name(r) == *asked));
        pixel.robot = robot.map(|robot| names[robot].clone());
    }
    let options = ShowOptions { robots: names.clone(), ..ShowOptions::default() };
    let plan = lightbots_plan::show(&show, &scene.starts, &options);
    let played = hall.play(&show);
    // With noise, the planner may choose otherwise between paths of almost the same length.
    let is_exact = *conditions == Conditions::ideal();
    let mut faults = Vec::new();
    if played.outcome != Some(RunOutcome::Finished) || played.contacts + played.dropouts as u64 > 0 {
        let Played { outcome, contacts, dropouts, .. } = &played;
        faults.push(format!("{outcome:?}, {contacts} contacts, {dropouts} dropouts"));
    }
    faults.extend(durations("live", played.duration.as_secs(), &plan, &show));
    let mut before = BTreeMap::new();
    for (index, frame) in show.frames.iter().enumerate() {
        match played.pictures.iter().find(|picture| picture.frame == index) {
            None => faults.push(format!("frame {index} was not seen")),
            Some(picture) => {
                let planned = is_exact.then_some(&plan.mapping[index][..]);
                let pictured = pictured(frame, picture, planned);
                let kept = kept(&show, index, picture, &names, &mut before);
                let of_frame = pictured.into_iter().chain(kept);
                faults.extend(of_frame.map(|fault| format!("frame {index}: {fault}")));
            }
        }
    }
    faults
}

/// Checks that the robots' lights show the frame and, if `planned` is known, that they are the planned robots.
fn pictured(frame: &Frame, picture: &Picture, planned: Option<&[Option<u32>]>) -> Vec<String> {
    let mut faults = Vec::new();
    let shown: Vec<Option<u32>> = picture.robots.iter().map(|(_, _, pixel)| *pixel).collect();
    if let Some(planned) = planned.filter(|planned| shown != *planned) {
        faults.push(format!("shown by {shown:?}, planned {planned:?}"));
    }
    let lit = frame.pixels.len().min(picture.robots.len());
    if shown.iter().flatten().count() != lit {
        faults.push(format!("{} pixels are shown, {lit} could be", shown.iter().flatten().count()));
    }
    for (at, light, id) in &picture.robots {
        let pixel = id.and_then(|id| frame.pixels.iter().find(|pixel| pixel.id == id));
        match pixel {
            Some(pixel) if pixel.at.distance(*at) > NEAR_M => {
                faults.push(format!("pixel {} is {:.3} m away", pixel.id, pixel.at.distance(*at)));
            }
            Some(pixel) if pixel.color != *light => faults.push(format!("pixel {} is {light:?}", pixel.id)),
            None if *light != Rgb::BLACK => faults.push(format!("a spare robot is {light:?}")),
            _ => {}
        }
    }
    faults
}

/// Checks that pins hold, and that with fixed identity a pixel keeps its robot unless a pin takes that robot. `before`
/// has the robot that showed each pixel last, and in which frame.
fn kept(
    show: &Show,
    index: usize,
    picture: &Picture,
    names: &[String],
    before: &mut BTreeMap<u32, (usize, usize)>,
) -> Vec<String> {
    let frame = &show.frames[index];
    let mut faults = Vec::new();
    let by = |id: u32| picture.robots.iter().position(|(_, _, pixel)| *pixel == Some(id));
    let asked = |robot: usize| frame.pixels.iter().any(|pixel| pixel.robot.as_ref() == Some(&names[robot]));
    for pixel in &frame.pixels {
        let shows = by(pixel.id);
        if let Some(name) = &pixel.robot {
            if shows.is_none_or(|robot| names[robot] != *name) {
                faults.push(format!("pixel {} is not shown by the robot it asks for", pixel.id));
            }
            continue;
        }
        let fixed = frame.identity.unwrap_or(show.identity) == Identity::Fixed;
        let Some(&(robot, since)) = before.get(&pixel.id).filter(|_| fixed) else { continue };
        // Another free pixel of this frame was shown by the same robot later, and keeps it.
        let later = frame
            .pixels
            .iter()
            .filter(|other| other.robot.is_none())
            .any(|other| before.get(&other.id).is_some_and(|&(of, when)| of == robot && when > since));
        if shows != Some(robot) && !asked(robot) && !later {
            faults.push(format!("pixel {} lost its robot", pixel.id));
        }
    }
    for (robot, (_, _, pixel)) in picture.robots.iter().enumerate() {
        if let Some(id) = pixel {
            before.insert(*id, (robot, index));
        }
    }
    faults
}
