//! Drives that a show prescribes: pictures that move as one, and paths of its own.
//!
//! In reading order: [`shape`] is the way of a robot without times; [`formation`] makes shapes of a [`PictureMotion`] and a
//! picture; [`timing`] finds the least legal duration and makes timed paths; [`given`] takes the trajectories of a show as
//! they are; [`drive`] gives each robot its way and asks the proof. A prescribed drive applies where robots stand on the
//! picture before. From anywhere else the ordinary planner leads to the frame.

mod drive;
mod formation;
mod given;
mod morph;
mod shape;
mod smooth_line;
#[cfg(test)]
mod tests;
mod timing;

pub(crate) use drive::{attempt, staggered};
pub use formation::moved;

use crate::{BoundFrame, Path};
use lightbots_base::Vec2;
use lightbots_show::{Frame, PictureMotion, Show};
use shape::Shape;
use std::collections::BTreeMap;

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

/// The way of one robot.
#[derive(Clone, Debug)]
pub(crate) enum PrescribedWay {
    /// Parts in order, timed by the planner. They share one drive.
    Parts(Vec<WayPart>),
    /// A timed path of the show.
    Timed(Path),
}

/// A part of a way with a rest at both ends.
#[derive(Clone, Debug)]
pub(crate) struct WayPart {
    /// Begin and end, shares of the duration of the whole drive.
    pub during: (f64, f64),
    pub shape: Shape,
}

/// Starts one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stagger {
    /// Unit vector in which starts run.
    pub direction: Vec2,
    /// From the first start to the last, seconds.
    pub delay_s: f64,
}

impl PrescribedWay {
    /// Where the way begins.
    pub(crate) fn start(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.first().map(|part| part.shape.at(0.0)),
            Self::Timed(path) => Some(path.start),
        }
    }

    /// Where the way ends.
    pub(crate) fn end(&self) -> Option<Vec2> {
        match self {
            Self::Parts(parts) => parts.last().map(|part| part.shape.at(1.0)),
            Self::Timed(path) => Some(path.as_ref().end()),
        }
    }
}

impl Prescribed {
    /// What the show prescribes for the drive to frame `index`, for the pixels of `bound`. `None`: nothing.
    pub fn of_frame(show: &Show, index: usize, bound: &BoundFrame<'_>) -> Option<Self> {
        let frame = show.frames.get(index)?;
        if let Some(motion) = &frame.motion {
            let before = index.checked_sub(1).and_then(|before| show.frames.get(before))?;
            return Self::of_motion(motion, &picture(before), &picture(frame), bound);
        }
        given::trajectories(show, index, bound)
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

/// Places of a frame's pixels by their ids, stage metres.
pub type PlacesById = BTreeMap<u32, Vec2>;

fn picture(frame: &Frame) -> PlacesById {
    frame.pixels.iter().map(|pixel| (pixel.id, pixel.at)).collect()
}
