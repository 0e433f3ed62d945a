//! Compares the headings that a robot reports on a drive with the direction in which it really drove.
//!
//! A robot with a marker that is mounted askew still reaches its goals, because feedback corrects its path. While the
//! robot drives, it estimates its place from its wheels and its heading. Once the robot stands, position fixes measure
//! its place, and thus the direction of the drive.

use lightbots_base::{Vec2, difference};

/// A displacement between two reports that is less than this is noise or a turn on the spot, metres.
const STANDS_M: f64 = 0.001;
/// Least displacement that is added to the track, metres. Shorter displacements of a driving robot accumulate until
/// they reach it.
const COUNTS_M: f64 = 0.003;
/// If the headings of two reports differ by more than this, the robot turned and the displacement is not counted,
/// radians.
const TURNS_RAD: f64 = 0.2;
/// Shortest drive whose direction is computed, metres. On this length a place error of 1 mm turns the direction by two
/// degrees.
const LEAST_M: f64 = 0.03;

/// One drive of one robot, as its reports show it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct DrivenTrack {
    /// Place (stage metres) and heading (radians) of the report from which the next displacement counts; `None` before
    /// the first report.
    from: Option<(Vec2, f64)>,
    /// Sum of the displacements, each projected onto the reported heading, stage metres.
    along: Vec2,
}

impl DrivenTrack {
    /// Adds a report of the robot: its place, stage metres, and its heading in the stage, radians.
    pub fn add(&mut self, at: Vec2, heading: f64) {
        let Some((from, before)) = self.from else {
            self.from = Some((at, heading));
            return;
        };
        let (moved, turned) = (at - from, difference(heading, before));
        let moved_m = moved.length();
        if (STANDS_M..COUNTS_M).contains(&moved_m) && turned.abs() < TURNS_RAD {
            return;
        }
        self.from = Some((at, heading));
        if moved_m >= COUNTS_M && turned.abs() < TURNS_RAD {
            let forward = Vec2::unit(before + turned / 2.0);
            self.along += forward * moved.dot(forward);
        }
    }

    /// Returns the angle from the reported headings to the true direction of the drive, radians, counter-clockwise;
    /// `None` if the drive was too short. `displacement`: vector from the measured place before the drive to the one
    /// after it, stage metres.
    pub fn askew_rad(&self, displacement: Vec2) -> Option<f64> {
        let is_long = self.along.length() >= LEAST_M && displacement.length() >= LEAST_M;
        is_long.then(|| difference(displacement.angle(), self.along.angle()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the angle, degrees, that is found for a robot that drives on an arc and reports headings that are off.
    fn askew_deg(off_deg: f64, backwards: bool) -> f64 {
        let mut track = DrivenTrack::default();
        let place = |heading: f64| Vec2::new(heading.sin(), -heading.cos()) * 0.22;
        let headings: Vec<f64> = (0..=12).map(|step| 0.4 + 0.02 * f64::from(step)).collect();
        let order: Vec<f64> = if backwards { headings.into_iter().rev().collect() } else { headings };
        order.iter().for_each(|heading| track.add(place(*heading), heading + off_deg.to_radians()));
        track.askew_rad(place(order[12]) - place(order[0])).unwrap().to_degrees()
    }

    #[test]
    fn headings_that_are_off_are_found_on_bends_and_backwards() {
        for off_deg in [0.0, 3.0, -8.0, 15.0_f64] {
            for backwards in [false, true] {
                assert!((askew_deg(off_deg, backwards) + off_deg).abs() < 0.2, "{off_deg} {backwards}");
            }
        }
    }

    #[test]
    fn turns_on_the_spot_and_noise_of_a_robot_that_stands_do_not_count() {
        let mut track = DrivenTrack::default();
        for step in 0..200 {
            let noise_m = 0.0004 * f64::from(step % 3);
            track.add(Vec2::new(noise_m, -noise_m), f64::from(step) * 0.1);
        }
        assert_eq!(track.askew_rad(Vec2::new(0.1, 0.0)), None);
    }
}
