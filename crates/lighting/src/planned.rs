//! What robots do by the plan of a whole show.

use crate::driven::DrivenLight;
use crate::flashes::LitFrame;
use lightbots_base::{Rgb, Span};
use lightbots_plan::ShowPlan;
use lightbots_show::Show;
use std::collections::BTreeMap;

/// `[frame]`: the drive to it and its robots, in the order of their starting places. Robots are dark before the first frame.
pub fn planned<'a>(show: &Show, plan: &'a ShowPlan) -> Vec<LitFrame<'a>> {
    let colours: Vec<Vec<(Rgb, bool)>> = plan
        .mapping
        .iter()
        .zip(&show.frames)
        .map(|(pixels, frame)| {
            let colours: BTreeMap<u32, Rgb> =
                frame.pixels.iter().map(|pixel| (pixel.id, pixel.color)).collect();
            let colour = |id: &u32| colours.get(id).copied().unwrap_or_default();
            pixels
                .iter()
                .map(|pixel| (pixel.as_ref().map(colour).unwrap_or_default(), pixel.is_some()))
                .collect()
        })
        .collect();
    let at = |frame: Option<usize>, robot: usize| {
        frame.and_then(|frame| colours.get(frame)?.get(robot).copied()).unwrap_or_default()
    };
    let robot = |frame: usize, robot: usize| {
        let transition = &plan.transitions[frame];
        let path = transition.paths[robot].as_ref();
        let (before, own, next) =
            (at(frame.checked_sub(1), robot), at(Some(frame), robot), at(Some(frame + 1), robot));
        DrivenLight {
            number: (robot as u32, transition.paths.len() as u32),
            frame: frame as u32,
            pixel: plan.mapping[frame][robot],
            colours: [before.0, own.0, if next.1 { next.0 } else { own.0 }],
            shines: [before.1, own.1],
            path: Some(path),
            goal: path.end(),
            drive: transition.duration,
        }
    };
    let frames = plan.transitions.len().min(plan.mapping.len()).min(show.frames.len());
    let lit = |frame: usize| LitFrame {
        air: Span::from_secs(show.frames[frame].air_time_s),
        robots: (0..plan.transitions[frame].paths.len()).map(|number| robot(frame, number)).collect(),
    };
    (0..frames).map(lit).collect()
}
