//! Drives that a show prescribes: motions of a picture as a whole, and trajectories that the show contains.
//!
//! In reading order: [`shape`] is the curve of a robot without times. A [`way`] is the whole path of a robot: shapes in
//! sequence, or a timed path. [`formation`] makes ways from a [`PictureMotion`] and a picture, [`morph`] makes ways
//! through several pictures. [`timing`] finds the least legal duration and makes timed paths. [`given`] takes the
//! trajectories of a show unchanged. [`drive`] gives each robot its way and checks the drive with the proof.
//!
//! Except for staggered starts, a prescribed drive applies only if robots stand where its ways begin. From other
//! places, the ordinary planner plans the drive.

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

/// The drive that a show prescribes from the picture of the previous frame to a frame.
#[derive(Clone, Debug)]
pub struct Prescribed {
    /// Name of the drive in messages, for example "turn".
    pub(crate) name: &'static str,
    /// `ways[goal]`: the whole path of the robot to that goal. Empty if `stagger` is set.
    pub(crate) ways: Vec<PrescribedWay>,
    /// How the starts of an ordinary drive are delayed; `None` for all other prescribed drives.
    pub(crate) stagger: Option<Stagger>,
}

/// Parameters of an ordinary drive in which robots start one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stagger {
    /// Unit vector in stage space: the farther a robot stands in this direction, the later it starts.
    pub direction: Vec2,
    /// Prescribed time from the first start to the last, seconds. The planner shortens it if the proof rejects the
    /// drive.
    pub delay_s: f64,
}

impl Prescribed {
    /// Returns the drive to frame `index` that the show prescribes for the pixels of `bound`. `None` if the show
    /// prescribes none, or not for all of these pixels.
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

/// Returns the name of a motion for messages.
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
