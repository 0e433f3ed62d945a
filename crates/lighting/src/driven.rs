//! A robot's light from the beginning of a drive on.

use crate::show_light::FrameLight;
use lightbots_base::{PathRef, Rgb, Span, TICK, Vec2};
use lightbots_light::{FloorPicture, LightContext, Linear, LitRobot};

/// Longest time that a robot's colour takes to change from one pixel's to the next one's. Longer fades look like a fault of
/// the light.
pub const FADE_MAX: Span = Span::from_millis(1_000);

/// How long a robot's colour takes to change to that of its next pixel: half of the drive, but at most 1 s. The change ends
/// with the drive.
pub fn fade_of(drive: Span) -> Span {
    FADE_MAX.min(Span(drive.0 / 2)).max(Span::ZERO)
}

/// Progress of the change of a robot's colour at the end of a drive: 0 before it, 1 after it. `drive` is the duration of
/// the drive, `elapsed` the time since the drive began.
pub fn changed(drive: Span, elapsed: Span) -> f64 {
    let over = fade_of(drive);
    let since = elapsed - (drive - over);
    match since {
        since if since >= over => 1.0,
        since if since <= Span::ZERO => 0.0,
        since => since.as_secs() / over.as_secs(),
    }
}

/// What one robot does from the start of the drive to a frame until the end of the frame's air time.
#[derive(Clone, Copy, Debug)]
pub struct DrivenLight<'a> {
    /// Number of the robot in effects, counted from 0, and number of all robots.
    pub number: (u32, u32),
    /// The frame, counted from 0.
    pub frame: u32,
    /// Id of the pixel that the robot shows in the frame; `None`: the robot has no pixel there.
    pub pixel: Option<u32>,
    /// The robot's colours without layers in the previous frame, in the frame, and in the next frame. Without a next
    /// frame, the third colour is that of the frame.
    pub colours: [Rgb; 3],
    /// Whether layers shine on the robot in the previous frame, and in the frame. They shine only on robots with a pixel.
    pub shines: [bool; 2],
    /// Path of the drive; `None`: the robot stands at `goal`.
    pub path: Option<PathRef<'a>>,
    /// Where the robot stands in the frame, stage metres.
    pub goal: Vec2,
    /// Duration of the drive.
    pub drive: Span,
}

/// A moment of a drive or of the frame after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightMoment {
    /// Time since the drive began, without the times in which robots were held.
    pub elapsed: Span,
    /// Show time, seconds.
    pub show_s: f64,
    /// How long show time has stood still until now, in total, seconds.
    pub lead_s: f64,
    /// The show clock, seconds. The effects of live light use this time.
    pub clock_s: f64,
}

impl DrivenLight<'_> {
    /// The robot's place, speed and colours, from which layers compute its light, `elapsed` after the drive began.
    pub fn lit(&self, elapsed: Span) -> LitRobot {
        let (place, speed_mps) = match self.path.filter(|_| elapsed < self.drive) {
            Some(path) => {
                let motion = path.at(elapsed);
                (motion.position, motion.velocity.length())
            }
            None => (self.goal, 0.0),
        };
        let [before, own, next] = self.colours;
        LitRobot {
            index: self.number.0,
            count: self.number.1,
            place,
            speed_mps,
            frame: self.frame,
            pixel: self.pixel,
            // The pixel's colour changes evenly at the end of the drive, as a `FADE` does.
            colour: Linear::from_rgb(before.mixed(own, self.changed(elapsed))),
            next_colour: Linear::from_rgb(next),
        }
    }

    fn changed(&self, elapsed: Span) -> f64 {
        changed(self.drive, elapsed)
    }

    /// The colour of the robot at a moment, with the frame's layers and live light.
    pub fn colour(&self, light: &FrameLight, pictures: &[FloorPicture], moment: LightMoment) -> Rgb {
        self.light(light, pictures, moment, usize::MAX).to_rgb()
    }

    /// The light of the robot at a moment, without the layer that has the index `left_out` in `light`. With `usize::MAX`,
    /// no layer is left out.
    pub(crate) fn light(
        &self,
        light: &FrameLight,
        pictures: &[FloorPicture],
        moment: LightMoment,
        left_out: usize,
    ) -> Linear {
        let context = LightContext { pictures, lead_s: moment.lead_s };
        let robot = self.lit(moment.elapsed);
        let share = match self.shines {
            [true, true] => 1.0,
            [false, false] => return robot.colour,
            [false, true] => self.changed(moment.elapsed),
            [true, false] => 1.0 - self.changed(moment.elapsed),
        };
        let lit = light.layers.colour_without(left_out, moment.show_s, &robot, &context);
        let live = light.live.colour(moment.clock_s, &LitRobot { colour: lit, ..robot }, &context);
        robot.colour.lerp(live, share)
    }

    /// The colours of the robot at `ticks` + 1 moments that are a [`TICK`] apart. `moment` returns the moment that is a
    /// given time after the first moment.
    pub fn samples(
        &self,
        light: &FrameLight,
        pictures: &[FloorPicture],
        ticks: u32,
        moment: impl Fn(Span) -> LightMoment,
    ) -> Vec<Rgb> {
        let at = |tick: u32| self.colour(light, pictures, moment(TICK * i64::from(tick)));
        (0..=ticks).map(at).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Piece;

    #[test]
    fn a_robot_drives_then_stands_and_its_colour_changes_at_the_end_of_the_drive() {
        let (start, goal) = (Vec2::ZERO, Vec2::new(2.0, 0.0));
        let pieces = [Piece::straight(start, goal, Span::from_secs(4.0))];
        let driven = DrivenLight {
            number: (3, 9),
            frame: 1,
            pixel: Some(7),
            colours: [Rgb::BLACK, Rgb::new(200, 0, 0), Rgb::new(0, 9, 0)],
            shines: [true; 2],
            path: Some(PathRef::new(start, &pieces)),
            goal,
            drive: Span::from_secs(4.0),
        };
        let colour = |ms: i64| driven.lit(Span::from_millis(ms)).colour.to_rgb().r;
        assert_eq!([0, 3_000, 3_500, 4_000, 9_000].map(colour), [0, 0, 100, 200, 200]);
        let under_way = driven.lit(Span::from_secs(1.0));
        assert_eq!((under_way.place, under_way.speed_mps), (Vec2::new(0.5, 0.0), 0.5));
        let there = driven.lit(Span::from_secs(5.0));
        assert_eq!((there.place, there.speed_mps), (goal, 0.0));
    }
}
