//! A show at reduced speed, for a first run.

use crate::{PictureMotion, Show};

/// Lowest speed of drives, percent of the usual speed. At a lower speed, a drive of a metre would take longer than most air
/// times.
pub const SPEED_MIN_PERCENT: u32 = 20;

/// Returns the show with drives at `percent` of the usual speed; less than [`SPEED_MIN_PERCENT`] counts as that. Limits
/// of speed and turning rate are multiplied by `percent`/100, the limit of acceleration by its square. Wanted durations
/// of transitions, delays of staggered starts, and trajectories to a frame take 100/`percent` times as long. Air times
/// and the times of the timeline do not change. At 100 percent or more, the show is unchanged.
pub fn slowed(show: &Show, percent: u32) -> Show {
    let mut slow = show.clone();
    if percent >= 100 {
        return slow;
    }
    let share = f64::from(percent.max(SPEED_MIN_PERCENT)) / 100.0;
    let limits = &mut slow.stage.limits;
    limits.speed_mps *= share;
    limits.turn_radps *= share;
    limits.accel_mps2 *= share * share;
    for frame in &mut slow.frames {
        frame.transition_s = frame.transition_s.map(|seconds| seconds / share);
        if let Some(PictureMotion::Stagger { delay_s, .. }) = &mut frame.motion {
            *delay_s /= share;
        }
    }
    for trajectory in slow.trajectories.iter_mut().filter(|trajectory| trajectory.frame.is_some()) {
        trajectory.at_s /= share;
        trajectory.pieces.iter_mut().for_each(|piece| piece.end_s /= share);
    }
    slow
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, validate};

    #[test]
    fn drives_take_longer_and_air_times_stay() {
        let frame = Frame { air_time_s: 3.0, transition_s: Some(4.0), ..Frame::default() };
        let show = Show { frames: vec![frame], ..Show::default() };
        let slow = slowed(&show, 50);
        assert_eq!((slow.frames[0].air_time_s, slow.frames[0].transition_s), (3.0, Some(8.0)));
        let (fast, limits) = (show.stage.limits, slow.stage.limits);
        assert_eq!(limits.speed_mps, fast.speed_mps / 2.0);
        assert_eq!(limits.accel_mps2, fast.accel_mps2 / 4.0);
        assert_eq!(limits.wheel_radps, fast.wheel_radps);
        assert_eq!(slowed(&show, 100), show);
    }

    #[test]
    fn a_show_is_as_valid_at_the_least_speed() {
        let show = Show::default();
        assert_eq!(validate(&slowed(&show, SPEED_MIN_PERCENT)).len(), validate(&show).len());
    }
}
