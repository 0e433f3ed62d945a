//! A planned show as its audience sees it: where each robot is, and in which colour, at any moment.

use crate::driven::LightMoment;
use crate::flashes::LitFrame;
use crate::planned::{PlannedDrive, drives_of, lit_frame, numbers_of};
use crate::show_light::{FrameLight, ShowLight};
use crate::times::FrameTimes;
use lightbots_base::{Rgb, Span, Vec2};
use lightbots_plan::ShowPlan;
use lightbots_show::Show;

/// A duration that is too short to be seen, seconds. It takes a moment back into the last frame at the end of the show.
const TINY_S: f64 = 1e-6;

/// A show with its drives. Its moments count from the start of the drive to the first frame. It never waits for GO.
#[derive(Clone, Debug)]
pub struct PlannedShow<'a> {
    show: &'a Show,
    light: &'a ShowLight,
    drives: Vec<PlannedDrive<'a>>,
    /// `[robot]`: the robot's number in effects.
    numbers: Vec<u32>,
    /// `[frame]`: when the frame is driven to, reached and left, in show time.
    times: Vec<FrameTimes>,
}

/// A robot of a planned show at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenRobot {
    /// Place, stage metres.
    pub place: Vec2,
    /// Colour of its light.
    pub colour: Rgb,
}

/// Computes places and colours of the robots of a planned show at given moments. Consecutive moments in one frame share
/// work.
#[derive(Clone, Debug)]
pub struct PlannedScenes<'a> {
    planned: &'a PlannedShow<'a>,
    /// The frame of the last moment: its index, its robots, and the layers that shine in it.
    begun: Option<(usize, LitFrame<'a>, FrameLight)>,
}

impl<'a> PlannedShow<'a> {
    /// Makes a planned show from a plan.
    pub fn new(show: &'a Show, plan: &'a ShowPlan, light: &'a ShowLight) -> Self {
        Self::of_drives(show, drives_of(plan), light)
    }

    /// Makes a planned show from drives, one for each frame in order. Frames without a drive are left out.
    pub fn of_drives(show: &'a Show, mut drives: Vec<PlannedDrive<'a>>, light: &'a ShowLight) -> Self {
        drives.truncate(show.frames.len());
        let mut times: Vec<FrameTimes> = Vec::new();
        for (drive, frame) in drives.iter().zip(&show.frames) {
            let end_s = times.last().map(|times| times.end_s);
            times.push(FrameTimes::after(end_s, drive.duration.as_secs(), frame.air_time_s));
        }
        let numbers = numbers_of(&drives);
        Self { show, light, drives, numbers, times }
    }

    /// Number of robots: that of the drive with the most robots.
    pub fn robots(&self) -> usize {
        self.drives.iter().map(|drive| drive.pixels.len()).max().unwrap_or(0)
    }

    /// `[robot]`: the robot's number in effects.
    pub fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// `[frame]`: when the frame is driven to, reached and left, seconds of show time.
    pub fn times(&self) -> &[FrameTimes] {
        &self.times
    }

    /// The drives, one for each frame.
    pub fn drives(&self) -> &[PlannedDrive<'a>] {
        &self.drives
    }

    /// Duration of the drive to the first frame, seconds. Show time is 0 at the end of that drive.
    pub fn first_drive_s(&self) -> f64 {
        self.times.first().map_or(0.0, |times| -times.drive_s)
    }

    /// Duration from the start of the first drive to the end of the last frame, seconds.
    pub fn duration_s(&self) -> f64 {
        self.times.last().map_or(0.0, |times| times.end_s) + self.first_drive_s()
    }

    /// Returns the frame at `at_s`, seconds from the start of the first drive, and the moment for its light. `None` if
    /// there are no frames. Moments before the start become the start. Moments from the end of the show on become the
    /// moment just before its end.
    fn moment(&self, at_s: f64) -> Option<(usize, LightMoment)> {
        let show_s = at_s - self.first_drive_s();
        let last = self.times.len().checked_sub(1)?;
        let frame = self.times.iter().position(|times| show_s < times.end_s).unwrap_or(last);
        let times = self.times[frame];
        // A layer ends with its frame. So at the very end of the show, the moment just before counts, when layers still
        // shine.
        let end_s = (times.end_s - TINY_S).max(times.drive_s);
        let show_s = if show_s.is_nan() { times.drive_s } else { show_s.clamp(times.drive_s, end_s) };
        let elapsed = Span::from_secs(show_s - times.drive_s);
        Some((frame, LightMoment { elapsed, show_s, lead_s: 0.0, clock_s: 0.0 }))
    }

    /// Returns an object that computes place and colour of each robot at given moments.
    pub fn scenes(&'a self) -> PlannedScenes<'a> {
        PlannedScenes { planned: self, begun: None }
    }
}

impl PlannedScenes<'_> {
    /// Replaces the content of `scene` by the robots at `at_s`, seconds from the start of the drive to the first frame.
    /// Robots are in the order of their starting places. Without frames, `scene` becomes empty.
    pub fn at(&mut self, at_s: f64, scene: &mut Vec<SeenRobot>) {
        scene.clear();
        let planned = self.planned;
        let Some((frame, moment)) = planned.moment(at_s) else { return };
        let (_, lit, light) = match self.begun.take() {
            Some(same) if same.0 == frame => self.begun.insert(same),
            _ => {
                let light = planned.light.in_frame(frame, |frame| planned.times.get(frame).copied());
                let lit = lit_frame(planned.show, (&planned.drives, &planned.numbers), frame);
                self.begun.insert((frame, lit, light))
            }
        };
        let pictures = planned.light.pictures();
        scene.extend(lit.robots.iter().map(|robot| SeenRobot {
            place: robot.lit(moment.elapsed).place,
            colour: robot.colour(light, pictures, moment),
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::{Frame, Pixel};

    #[test]
    fn robots_stand_in_their_colours_and_the_last_frame_stays() {
        let pixel =
            |x: f64, red: u8| Pixel { at: Vec2::new(x, 0.0), color: Rgb::new(red, 0, 0), ..Pixel::default() };
        let frame = |x, red| Frame { air_time_s: 2.0, pixels: vec![pixel(x, red)], ..Frame::default() };
        let show = Show { frames: vec![frame(0.0, 100), frame(1.0, 200)], ..Show::default() };
        let drive =
            |seconds| PlannedDrive { pixels: &[Some(0)], paths: &[], duration: Span::from_secs(seconds) };
        let (light, _) = ShowLight::new(&show);
        let planned = PlannedShow::of_drives(&show, vec![drive(4.0), drive(2.0)], &light);
        assert_eq!((planned.first_drive_s(), planned.duration_s(), planned.robots()), (4.0, 10.0, 1));
        let (mut scenes, mut scene) = (planned.scenes(), Vec::new());
        let mut red = |at_s: f64| {
            scenes.at(at_s, &mut scene);
            (scene[0].place.x, scene[0].colour.r)
        };
        // Colours change during the last second of a drive.
        assert_eq!([-1.0, 5.0, 8.0, 99.0].map(&mut red), [(0.0, 0), (0.0, 100), (1.0, 200), (1.0, 200)]);
        let none = PlannedShow::of_drives(&show, Vec::new(), &light);
        none.scenes().at(0.0, &mut scene);
        assert!(scene.is_empty() && none.duration_s() == 0.0);
    }
}
