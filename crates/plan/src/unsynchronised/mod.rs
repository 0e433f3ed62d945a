//! Plans for robots without a common clock. These robots understand the command TARGET (a place to drive to) but no
//! routes, and their speed is unknown.
//!
//! They drive straight lines, in an order in which no two robots can meet at any speed. [`stages`] finds the order.
//! [`StraightDrive::yields`] lets drives overlap in time: a drive yields to earlier drives that it would meet. Its
//! robot may drive only as far as the progress of those earlier drives allows ([`StraightDrive::clear_share`]).

mod free_space;
mod order;
mod problem;
mod rearrange;
mod straight;

pub use free_space::FreeSpace;
pub use problem::{DriveStage, UnsynchronisedProblem};
pub use straight::{StraightDrive, Yield, expected_s};

use crate::Path;
use lightbots_base::Vec2;
use order::Order;

/// Most times that robots step aside, on average for each robot. After that, all robots without a common clock leave
/// their places, one after the other.
const ASIDES_EACH: usize = 1;

/// Finds stages that bring all robots to their goals; `None` if no order was found. `drive` plans the paths of the
/// synchronised robots among the given discs (stage metres), which stand still meanwhile. `drive` returns `None` if the
/// synchronised robots cannot drive yet.
pub fn stages(
    problem: &UnsynchronisedProblem<'_>,
    mut drive: impl FnMut(&[Vec2]) -> Option<Vec<(usize, Path)>>,
) -> Option<Vec<DriveStage>> {
    let mut order = Order::new(problem);
    let mut driven = !problem.unsynchronised.contains(&false);
    let (mut asides, mut rearranged) = (0, false);
    loop {
        if let Some(robot) = order.next() {
            order.go(robot, problem.goals[robot]);
        } else if driven && !order.waiting.contains(&true) {
            return Some(order.finish());
        } else if !driven && let Some(paths) = drive(&order.unsynchronised_and_standing()) {
            driven = true;
            order.follow(paths);
        } else {
            let detour = order.detour().filter(|_| asides < ASIDES_EACH * problem.starts.len());
            if let Some((robot, path, is_aside)) = detour {
                asides += usize::from(is_aside);
                path.into_iter().for_each(|at| order.go(robot, at));
                continue;
            }
            if !driven {
                order.clear_out(false)?;
                order.follow(drive(&order.unsynchronised_and_standing())?);
                driven = true;
            } else if std::mem::replace(&mut rearranged, true) {
                return None;
            } else {
                order.clear_out(true)?;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::free_space::CELL_M;
    use super::*;
    use lightbots_base::random::congruential;

    fn problem<'a>(
        starts: &'a [Vec2],
        goals: &'a [Vec2],
        unsynchronised: &'a [bool],
    ) -> UnsynchronisedProblem<'a> {
        let space = FreeSpace {
            half_floor: Vec2::new(1.5, 1.5),
            obstacles: &[],
            radius_m: 0.027,
            gap_m: 0.074,
            cell_m: CELL_M,
        };
        UnsynchronisedProblem { space, starts, goals, unsynchronised, standing: &[] }
    }

    /// Simulates the drives: robots have random speeds and random delays of reports, and drive only as far as these
    /// reports allow. Asserts that all robots arrive, and that no two come nearer to each other than `gap_m`.
    fn drive_anyhow(places: &mut [Vec2], drives: &[StraightDrive], gap_m: f64, seed: u64) {
        let mut dice = seed;
        let mut chance = |bound: u64| (congruential(&mut dice) >> 33) % bound;
        let (mut at, mut said) = (vec![0.0; drives.len()], vec![0.0; drives.len()]);
        let eager: Vec<u64> = drives.iter().map(|_| 4 + chance(16)).collect();
        for _ in 0..20_000 {
            for (place, drive) in drives.iter().enumerate() {
                let first = (0..place).rev().find(|&before| drives[before].robot == drive.robot);
                if at[place] >= 1.0
                    || chance(20) > eager[place]
                    || first.is_some_and(|first| said[first] < 1.0)
                {
                    continue;
                }
                let may = drive.yields.iter().fold(1.0, |share: f64, y| match said[y.to] {
                    1.0 => share,
                    passed => share.min(drive.clear_share(&drives[y.to], passed, y.gap_m)),
                });
                at[place] =
                    may.min(at[place] + chance(100) as f64 * 0.0005 / drive.length_m()).max(at[place]);
                places[drive.robot] = drive.at(at[place]);
            }
            for (said, at) in said.iter_mut().zip(&at) {
                *said = if chance(3) == 0 { *at } else { *said };
            }
            for (robot, place) in places.iter().enumerate() {
                let closest = places[..robot].iter().map(|other| other.distance(*place)).fold(1.0, f64::min);
                assert!(closest >= gap_m, "robot {robot} comes as near as {closest}");
            }
            if said.iter().all(|&said| said >= 1.0) {
                return;
            }
        }
        panic!("they wait for each other: {said:?}");
    }

    fn check(problem: &UnsynchronisedProblem<'_>, stages: &[DriveStage]) {
        for seed in 0..4 {
            let mut places = problem.starts.to_vec();
            for stage in stages {
                match stage {
                    DriveStage::Targets(drives) => drive_anyhow(&mut places, drives, 0.0599, seed),
                    DriveStage::Routes(_) => panic!("nobody follows paths"),
                }
            }
            assert!(places.iter().zip(problem.goals).all(|(at, goal)| at.distance(*goal) < 1e-9));
        }
    }

    #[test]
    fn parallel_drives_go_at_once() {
        let starts: Vec<Vec2> = (0..10).map(|i| Vec2::new(f64::from(i) * 0.1, 1.0)).collect();
        let goals: Vec<Vec2> = starts.iter().map(|at| Vec2::new(at.x, -1.0)).collect();
        let unsynchronised = [true; 10];
        let problem = problem(&starts, &goals, &unsynchronised);
        let stages = stages(&problem, |_| None).unwrap();
        assert_eq!(stages.len(), 1);
        check(&problem, &stages);
    }

    #[test]
    fn two_that_change_places_step_aside() {
        let starts = [Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)];
        let goals = [starts[1], starts[0]];
        let unsynchronised = [true; 2];
        let problem = problem(&starts, &goals, &unsynchronised);
        check(&problem, &stages(&problem, |_| None).unwrap());
    }

    #[test]
    fn a_ring_turns_by_one_place() {
        let starts: Vec<Vec2> =
            (0..12).map(|i| Vec2::unit(f64::from(i) * std::f64::consts::FRAC_PI_6) * 0.2).collect();
        let goals: Vec<Vec2> = (0..12).map(|i| starts[(i + 1) % 12]).collect();
        let unsynchronised = [true; 12];
        let problem = problem(&starts, &goals, &unsynchronised);
        check(&problem, &stages(&problem, |_| None).unwrap());
    }

    #[test]
    fn crowds_that_change_places_come_through() {
        for seed in 1..7u64 {
            let mut dice = seed;
            let mut below = |bound: usize| (congruential(&mut dice) >> 33) as usize % bound;
            let grid = |i: usize, pitch: f64| Vec2::new((i % 4) as f64 * pitch, (i / 4) as f64 * pitch);
            let starts: Vec<Vec2> = (0..12).map(|i| grid(i, 0.09)).collect();
            let mut goals: Vec<Vec2> = (0..12).map(|i| grid(i, 0.076) + Vec2::new(0.05, -0.04)).collect();
            (1..12).for_each(|i| goals.swap(i, below(i + 1)));
            let unsynchronised = [true; 12];
            let problem = problem(&starts, &goals, &unsynchronised);
            let stages = stages(&problem, |_| None).unwrap_or_else(|| panic!("no order for seed {seed}"));
            check(&problem, &stages);
        }
    }
}
