//! Straight drives of robots without a common clock, and how far a robot may drive while earlier drives of other robots
//! are not finished.

use lightbots_base::Vec2;
use lightbots_base::shape::{point_to_segment, segment_to_segment};
use std::collections::BTreeMap;

/// Number of bisections in the search for the clear part of a drive. With 14, the error is 1 mm on a floor of 16 m.
const HALVINGS: usize = 14;
/// Tolerance for rounding when distances are compared, metres.
const ROUNDING_M: f64 = 1e-9;

/// Assumed speed of a robot without a common clock, m/s. Only the estimate of the duration uses it.
const SPEED_MPS: f64 = 0.27;
/// Time that a drive takes in addition to driving its distance, seconds: the turn at its start, and the report at its
/// end.
const OVERHEAD_S: f64 = 0.6;
/// Assumed time from the start of a drive to the start of a drive that yields to it, seconds.
const HEADWAY_S: f64 = 0.4;

/// A straight drive of one robot from a place to another.
#[derive(Clone, Debug, PartialEq)]
pub struct StraightDrive {
    /// Index of the robot.
    pub robot: usize,
    /// Place where the drive begins, stage metres.
    pub from: Vec2,
    /// Place where the drive ends, stage metres.
    pub to: Vec2,
    /// Earlier drives of other robots that this drive would meet. Until this drive ends, its robot must stay at least
    /// [`Yield::gap_m`] from the remaining line of each of these earlier drives.
    pub yields: Vec<Yield>,
}

/// An earlier drive that a drive yields to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yield {
    /// Index of the earlier drive in the list of drives.
    pub to: usize,
    /// Distance to keep between the centre of the robot that yields and the remaining line of the earlier drive,
    /// metres.
    pub gap_m: f64,
}

impl StraightDrive {
    /// A drive that does not yield to any other drive.
    pub fn new(robot: usize, from: Vec2, to: Vec2) -> Self {
        Self { robot, from, to, yields: Vec::new() }
    }

    /// Length of the drive, metres.
    pub fn length_m(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// Place after a share of the drive, 0 to 1, stage metres.
    pub fn at(&self, share: f64) -> Vec2 {
        self.from + (self.to - self.from) * share
    }

    /// Share of the drive that is done when the robot is at `place`; may be less than 0 or more than 1. It is 1 for a
    /// drive of length 0.
    pub fn share_at(&self, place: Vec2) -> f64 {
        let line = self.to - self.from;
        let squared = line.length_squared();
        if squared > 0.0 { (place - self.from).dot(line) / squared } else { 1.0 }
    }

    /// Distance of a place from the drive's line, metres.
    pub fn distance_m(&self, place: Vec2) -> f64 {
        point_to_segment(place, self.from, self.to)
    }

    /// Share of this drive, 0 to 1, up to which its line stays at least `gap_m` metres from the remaining line of
    /// `other`. It is 0 if the line is closer from its beginning. The share `passed` of `other` is done. The result
    /// holds at any speed of both robots.
    pub fn clear_share(&self, other: &Self, passed: f64, gap_m: f64) -> f64 {
        let left = (other.at(passed.clamp(0.0, 1.0)), other.to);
        let clear = |share: f64| segment_to_segment((self.from, self.at(share)), left) >= gap_m - ROUNDING_M;
        if clear(1.0) {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if clear(middle) { low = middle } else { high = middle }
        }
        low
    }
}

/// Sets the yields of drives. The drives must be collision-free if they are driven one after the other; with these
/// yields, they are also collision-free if they overlap in time.
pub(super) fn add_yields(drives: &mut [StraightDrive], gap_m: f64) {
    let (mut next, mut next_of) = (vec![usize::MAX; drives.len()], BTreeMap::new());
    for (place, drive) in drives.iter().enumerate().rev() {
        next[place] = next_of.insert(drive.robot, place).unwrap_or(usize::MAX);
    }
    for later in 1..drives.len() {
        let drive = &drives[later];
        let mut yields = Vec::new();
        for (place, before) in drives[..later].iter().enumerate().filter(|(_, h)| h.robot != drive.robot) {
            let stays = next[place] > later;
            let stands_m = point_to_segment(before.to, drive.from, drive.to);
            let gap_m = if stays { gap_m.min(stands_m) } else { gap_m };
            if segment_to_segment((drive.from, drive.to), (before.from, before.to)) < gap_m - ROUNDING_M {
                yields.push(Yield { to: place, gap_m });
            }
        }
        drives[later].yields = yields;
    }
}

/// Estimates the time until the last of `drives` ends, if nothing delays them, seconds. The estimate is rough, because
/// the speed of these robots is unknown.
pub fn expected_s(drives: &[StraightDrive]) -> f64 {
    let (mut begins, mut ends) = (Vec::<f64>::new(), Vec::<f64>::new());
    for (place, drive) in drives.iter().enumerate() {
        let own = (0..place).rev().find(|&before| drives[before].robot == drive.robot);
        let begin_s = drive
            .yields
            .iter()
            .map(|y| begins[y.to] + HEADWAY_S)
            .fold(own.map_or(0.0, |b| ends[b]), f64::max);
        begins.push(begin_s);
        ends.push(begin_s + OVERHEAD_S + drive.length_m() / SPEED_MPS);
    }
    ends.into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive(robot: usize, from: (f64, f64), to: (f64, f64)) -> StraightDrive {
        StraightDrive::new(robot, Vec2::new(from.0, from.1), Vec2::new(to.0, to.1))
    }

    #[test]
    fn a_crossing_drive_waits_before_the_earlier_one() {
        let mut drives = [drive(0, (-1.0, 0.0), (1.0, 0.0)), drive(1, (0.0, -1.0), (0.0, 1.0))];
        add_yields(&mut drives, 0.084);
        let yields = drives[1].yields[0];
        assert_eq!(yields, Yield { to: 0, gap_m: 0.084 });
        let share = |passed: f64| drives[1].clear_share(&drives[0], passed, yields.gap_m);
        assert!((share(0.0) - (1.0 - 0.084) / 2.0).abs() < 1e-3, "{}", share(0.0));
        assert!(share(0.5) < 0.5 && share(0.541) < 1.0);
        assert_eq!(share(0.543), 1.0);
    }

    #[test]
    fn a_following_robot_keeps_its_distance() {
        let mut drives = [drive(0, (0.1, 0.0), (1.1, 0.0)), drive(1, (0.0, 0.0), (1.0, 0.0))];
        add_yields(&mut drives, 0.084);
        let share = |passed: f64| drives[1].clear_share(&drives[0], passed, 0.084);
        assert!((share(0.0) - 0.016).abs() < 1e-3);
        assert!((share(0.5) - 0.516).abs() < 1e-3);
        assert_eq!(share(1.0), 1.0);
    }

    #[test]
    fn parallel_drives_need_not_yield() {
        let mut drives = [drive(0, (0.0, 0.0), (0.0, 1.0)), drive(1, (0.1, 0.0), (0.1, 1.0))];
        add_yields(&mut drives, 0.084);
        assert!(drives[1].yields.is_empty());
        let near = drive(1, (0.06, 0.0), (0.06, 1.0));
        drives[1] = near;
        add_yields(&mut drives, 0.084);
        assert!(drives[1].yields.is_empty(), "they stand no farther apart at their goals: {:?}", drives[1]);
    }

    #[test]
    fn a_place_left_again_is_no_excuse() {
        let mut drives = [
            drive(0, (0.0, 0.5), (0.0, 0.02)),
            drive(0, (0.0, 0.02), (0.5, 0.5)),
            drive(1, (-0.5, 0.0), (0.5, 0.0)),
        ];
        add_yields(&mut drives, 0.084);
        assert_eq!(
            drives[2].yields.iter().map(|y| (y.to, y.gap_m)).collect::<Vec<_>>(),
            [(0, 0.084), (1, 0.084)]
        );
    }
}
