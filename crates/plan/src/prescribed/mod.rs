//! Drives that a show prescribes: pictures that move as one, and paths of its own.
//!
//! In reading order: [`shape`] is the way of a robot without times; [`way`] joins such shapes, or is a timed path;
//! [`formation`] makes ways of a [`PictureMotion`] and a picture; [`timing`] finds the least legal duration and makes timed
//! paths; [`given`] takes the trajectories of a show as they are; [`drive`] gives each robot its way and asks the proof.
//! A prescribed drive applies where robots stand on the picture before. From anywhere else the ordinary planner leads to
//! the frame.

mod drive;
mod formation;
mod given;
mod morph;
mod picture;
mod shape;
mod smooth_line;
#[cfg(test)]
mod tests;
mod timing;
mod way;

pub(crate) use drive::{attempt, staggered};
pub use formation::moved;
pub use picture::PlacesById;

use crate::BoundFrame;
use lightbots_base::Vec2;
use lightbots_show::{PictureMotion, Show};
use picture::picture;
use way::PrescribedWay;

/// The drive that a show prescribes from the picture before a frame to the frame.
#[derive(Clone, Debug)]
pub struct Prescribed {
    /// What people call it: "turn".
    pub(crate) name: &'static str,
    /// `ways[goal]`: how the robot of that goal gets there.
    pub(crate) ways: Vec<PrescribedWay>,
    /// A delay of starts, of an ordinary drive; there are no ways then.
    pub(crate) stagger: Option<Stagger>,
}

/// Starts one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stagger {
    /// Unit vector in which starts run.
    pub direction: Vec2,
    /// From the first start to the last, seconds.
    pub delay_s: f64,
}

impl Prescribed {
    /// What the show prescribes for the drive to frame `index`, for the pixels of `bound`. `None`: nothing.
    pub fn of_frame(show: &Show, index: usize, bound: &BoundFrame<'_>) -> Option<Self> {
        let frame = show.frames.get(index)?;
        if let Some(motion) = &frame.motion {
            let before = index.checked_sub(1).and_then(|before| show.frames.get(before))?;
            return Self::of_motion(motion, &picture(before), &picture(frame), bound);
        }
        let ways = given::ways(show, index, bound)?;
        Some(Self { name: "trajectories", ways, stagger: None })
    }

    fn of_motion(
        motion: &PictureMotion,
        before: &PlacesById,
        after: &PlacesById,
        bound: &BoundFrame<'_>,
    ) -> Option<Self> {
        let name = noun(motion);
        if let PictureMotion::Stagger { direction, delay_s } = *motion {
            let stagger = Some(Stagger { direction: Vec2::unit(direction), delay_s });
            return Some(Self { name, ways: Vec::new(), stagger });
        }
        let ways = match motion {
            PictureMotion::Morph { through } => morph::ways(through, before, after)?,
            _ => formation::ways(motion, before),
        };
        let ways = bound.pixels.iter().map(|pixel| ways.get(&pixel.id).cloned());
        Some(Self { name, ways: ways.collect::<Option<_>>()?, stagger: None })
    }
}

/// What people call a motion in a sentence.
fn noun(motion: &PictureMotion) -> &'static str {
    match motion {
        PictureMotion::Travel { .. } => "travel",
        PictureMotion::Turn { .. } => "turn",
        PictureMotion::Breathe { .. } => "breath",
        PictureMotion::Follow { .. } => "line of robots",
        PictureMotion::Wave { .. } => "wave",
        PictureMotion::Stagger { .. } => "start one after the other",
        PictureMotion::Morph { .. } => "drive through pictures",
    }
}
