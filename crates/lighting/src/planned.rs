//! What robots do by the plan of a whole show.

use crate::driven::DrivenLight;
use crate::flashes::LitFrame;
use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::{Path, ShowPlan};
use lightbots_show::{Pixel, Show};
use std::collections::BTreeMap;

/// The drive to a frame, as it was planned.
#[derive(Clone, Copy, Debug)]
pub struct PlannedDrive<'a> {
    /// `[robot]`: id of the pixel that the robot shows after the drive; `None`: it has no pixel.
    pub pixels: &'a [Option<u32>],
    /// `[robot]`: the robot's path. Empty: no drive was planned, and each robot stands on its pixel.
    pub paths: &'a [Path],
    /// Duration of each path.
    pub duration: Span,
}

/// Returns the number of each robot for effects. It is the rank, from 0, of the id of the robot's pixel among all
/// pixels in the frame to which robots drive first. Plans and runs of a show thus agree. Robots without a pixel come
/// after the others, in their order. `pixels` has the id of each robot's pixel in that frame.
pub fn numbers(pixels: impl IntoIterator<Item = Option<u32>>) -> Vec<u32> {
    let mut robots: Vec<(Option<u32>, usize)> =
        pixels.into_iter().enumerate().map(|(robot, pixel)| (pixel, robot)).collect();
    robots.sort_unstable_by_key(|&(pixel, robot)| (pixel.is_none(), pixel, robot));
    let mut numbers = vec![0; robots.len()];
    for (number, (_, robot)) in (0..).zip(robots) {
        numbers[robot] = number;
    }
    numbers
}

/// Returns the planned drive to each frame, in order.
pub(crate) fn drives_of(plan: &ShowPlan) -> Vec<PlannedDrive<'_>> {
    let drives = plan.mapping.iter().zip(&plan.transitions);
    drives.map(|(pixels, way)| PlannedDrive { pixels, paths: &way.paths, duration: way.duration }).collect()
}

/// Returns each planned frame with the drive to it and the light of its robots, which are in the order of their starting
/// places. At the start of the first drive, robots are dark.
pub fn planned<'a>(show: &Show, plan: &'a ShowPlan) -> Vec<LitFrame<'a>> {
    let drives = drives_of(plan);
    let frames = drives.len().min(show.frames.len());
    let numbers = numbers_of(&drives);
    (0..frames).map(|frame| lit_frame(show, (&drives, &numbers), frame)).collect()
}

/// The [`numbers`] of robots by their pixels after the first of `drives`. Empty without drives.
pub fn numbers_of(drives: &[PlannedDrive<'_>]) -> Vec<u32> {
    numbers(drives.first().into_iter().flat_map(|drive| drive.pixels).copied())
}

/// Returns the frame with the index `frame`, the drive to it and the light of its robots. `numbers` has the number of each
/// robot in effects, from [`numbers_of`].
///
/// # Panics
/// If `drives` or `show` has no such frame.
pub fn lit_frame<'a>(
    show: &Show,
    (drives, numbers): (&[PlannedDrive<'a>], &[u32]),
    frame: usize,
) -> LitFrame<'a> {
    let pixels = |of: Option<usize>| -> BTreeMap<u32, &Pixel> {
        let found = of.and_then(|frame| show.frames.get(frame));
        found.into_iter().flat_map(|frame| &frame.pixels).map(|pixel| (pixel.id, pixel)).collect()
    };
    let frames = [frame.checked_sub(1), Some(frame), Some(frame + 1)];
    let shown = frames.map(pixels);
    let of = |which: usize, robot: usize| -> Option<&Pixel> {
        let id = (*frames[which].and_then(|frame| drives.get(frame))?.pixels.get(robot)?)?;
        shown[which].get(&id).copied()
    };
    let colour = |pixel: Option<&Pixel>| pixel.map_or(Rgb::BLACK, |pixel| pixel.color);
    let drive = &drives[frame];
    let robot = |robot: usize| {
        let [before, own, next] = [0, 1, 2].map(|which| of(which, robot));
        let path = drive.paths.get(robot).map(Path::as_ref);
        DrivenLight {
            number: (numbers.get(robot).map_or(robot as u32, |number| *number), drive.pixels.len() as u32),
            frame: frame as u32,
            pixel: drive.pixels[robot],
            colours: [colour(before), colour(own), colour(next.or(own))],
            shines: [before.is_some(), own.is_some()],
            path,
            goal: path.map_or_else(|| own.map_or(Vec2::ZERO, |pixel| pixel.at), |path| path.end()),
            drive: drive.duration,
        }
    };
    LitFrame {
        air: Span::from_secs(show.frames[frame].air_time_s),
        robots: (0..drive.pixels.len()).map(robot).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_are_numbered_by_their_first_pixels() {
        assert_eq!(numbers([Some(7), None, Some(2), None, Some(4)]), [2, 3, 0, 4, 1]);
        assert_eq!(numbers([]), []);
    }
}
