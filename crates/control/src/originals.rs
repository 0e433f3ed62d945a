//! Robots that speak only TARGET and COLOR: in what order they go so that no two can meet, however fast they drive.

use crate::clear::{Floor, segment_to_segment};
use lightbots_base::Vec2;
use lightbots_plan::Path;

/// Rims of an original robot and others stay this far apart on the way, metres: its line is not quite straight and
/// it stops anywhere within 20 mm.
pub(crate) const MARGIN_M: f64 = 0.03;

/// What happens between two moments at which all stand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Stage {
    /// These robots go straight to these places, all at once, at any speed.
    Targets(Vec<(usize, Vec2)>),
    /// The robots that follow paths drive theirs, `(robot, path)`.
    Routes(Vec<(usize, Path)>),
}

/// Everybody's start and goal.
pub(crate) struct Journey<'a> {
    pub floor: Floor<'a>,
    /// `[robot]`, stage metres.
    pub starts: &'a [Vec2],
    /// `[robot]`, stage metres; spares: where they shall stand.
    pub goals: &'a [Vec2],
    /// `[robot]`.
    pub original: &'a [bool],
    /// Discs that do not move.
    pub standing: &'a [Vec2],
}

/// Stages that bring everybody to their goals; `drive` plans the robots that follow paths, given the discs that
/// stand meanwhile, or says that they cannot go yet. `None`: no order was found.
pub(crate) fn stages(
    journey: &Journey<'_>,
    mut drive: impl FnMut(&[Vec2]) -> Option<Vec<(usize, Path)>>,
) -> Option<Vec<Stage>> {
    let count = journey.starts.len();
    let mut places = journey.starts.to_vec();
    let mut stages = Vec::new();
    let mut driven = !journey.original.contains(&false);
    let mut asides = 0;
    loop {
        let waiting: Vec<usize> = (0..count)
            .filter(|&robot| journey.original[robot] && places[robot] != journey.goals[robot])
            .collect();
        if waiting.is_empty() && driven {
            return Some(stages);
        }
        let batch = journey.batch(&waiting, &places);
        if !batch.is_empty() {
            batch.iter().for_each(|&(robot, at)| places[robot] = at);
            stages.push(Stage::Targets(batch));
            continue;
        }
        if !driven && let Some(paths) = drive(&journey.originals_and_standing(&places)) {
            paths.iter().for_each(|(robot, path)| places[*robot] = path.as_ref().end());
            stages.push(Stage::Routes(paths));
            driven = true;
            continue;
        }
        let (robot, way, is_aside) = journey.detour(&waiting, &places)?;
        asides += usize::from(is_aside);
        if asides > 3 * count {
            return None;
        }
        for at in way {
            places[robot] = at;
            stages.push(Stage::Targets(vec![(robot, at)]));
        }
    }
}

impl Journey<'_> {
    /// Robots that can go straight to their goals at the same time, whatever their speeds.
    fn batch(&self, waiting: &[usize], places: &[Vec2]) -> Vec<(usize, Vec2)> {
        let mut going: Vec<(usize, Vec2)> = Vec::new();
        let mut moves = vec![false; places.len()];
        for &robot in waiting {
            let (from, to) = (places[robot], self.goals[robot]);
            let clear_of_standing = self.floor.passes_obstacles(from, to)
                && self.standing.iter().all(|&disc| self.floor.passes(from, to, disc))
                && (0..places.len()).all(|other| {
                    other == robot || moves[other] || self.floor.passes(from, to, places[other])
                });
            let clear_of_going = going.iter().all(|&(other, goal)| {
                let needed = self.floor.gap_m.min(from.distance(places[other])).min(to.distance(goal));
                segment_to_segment((from, to), (places[other], goal)) >= needed - 1e-9
            });
            if clear_of_standing && clear_of_going {
                moves[robot] = true;
                going.push((robot, to));
            }
        }
        going
    }

    /// Everything that stands while the others drive paths.
    fn originals_and_standing(&self, places: &[Vec2]) -> Vec<Vec2> {
        let originals = (0..places.len()).filter(|&robot| self.original[robot]).map(|robot| places[robot]);
        originals.chain(self.standing.iter().copied()).collect()
    }

    /// A way round for one robot, or out of the others' way: `(robot, way-points, whether it is only aside)`.
    fn detour(&self, waiting: &[usize], places: &[Vec2]) -> Option<(usize, Vec<Vec2>, bool)> {
        let discs_of = |robot: usize| -> Vec<Vec2> {
            let others = (0..places.len()).filter(|&other| other != robot).map(|other| places[other]);
            others.chain(self.standing.iter().copied()).collect()
        };
        let free_goal = |robot: &&usize| {
            let goal = self.goals[**robot];
            discs_of(**robot).iter().all(|disc| disc.distance(goal) >= 2.0 * self.floor.radius_m)
        };
        for &robot in waiting.iter().filter(free_goal) {
            if let Some(way) = self.floor.way(places[robot], self.goals[robot], &discs_of(robot)) {
                return Some((robot, way, false));
            }
        }
        let blocks = |robot: &&usize| {
            (0..places.len()).any(|other| {
                other != **robot && self.goals[other].distance(places[**robot]) < self.floor.gap_m
            })
        };
        let all_originals: Vec<usize> = (0..places.len()).filter(|&robot| self.original[robot]).collect();
        let first = waiting.iter().filter(blocks).chain(all_originals.iter().filter(blocks));
        for &robot in first {
            if let Some(way) = self.floor.aside(places[robot], &discs_of(robot), self.goals) {
                return Some((robot, way, true));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn journey<'a>(starts: &'a [Vec2], goals: &'a [Vec2], original: &'a [bool]) -> Journey<'a> {
        let floor = Floor { half: Vec2::new(1.5, 1.5), obstacles: &[], radius_m: 0.027, gap_m: 0.084 };
        Journey { floor, starts, goals, original, standing: &[] }
    }

    fn check(journey: &Journey<'_>, stages: &[Stage]) {
        let mut places = journey.starts.to_vec();
        for stage in stages {
            let Stage::Targets(batch) = stage else { continue };
            for &(robot, to) in batch {
                for other in (0..places.len()).filter(|&other| other != robot) {
                    let other_to = batch.iter().find(|b| b.0 == other).map_or(places[other], |b| b.1);
                    let closest = segment_to_segment((places[robot], to), (places[other], other_to));
                    assert!(closest >= 0.054, "robot {robot} meets {other}: {closest}");
                }
            }
            batch.iter().for_each(|&(robot, to)| places[robot] = to);
        }
        assert_eq!(places, journey.goals);
    }

    #[test]
    fn parallel_ways_go_at_once() {
        let starts: Vec<Vec2> = (0..10).map(|i| Vec2::new(f64::from(i) * 0.1, 1.0)).collect();
        let goals: Vec<Vec2> = starts.iter().map(|at| Vec2::new(at.x, -1.0)).collect();
        let original = [true; 10];
        let journey = journey(&starts, &goals, &original);
        let stages = stages(&journey, |_| None).unwrap();
        assert_eq!(stages.len(), 1);
        check(&journey, &stages);
    }

    #[test]
    fn two_that_change_places_step_aside() {
        let starts = [Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)];
        let goals = [starts[1], starts[0]];
        let original = [true; 2];
        let journey = journey(&starts, &goals, &original);
        check(&journey, &stages(&journey, |_| None).unwrap());
    }

    #[test]
    fn a_ring_turns_by_one_place() {
        let starts: Vec<Vec2> =
            (0..12).map(|i| Vec2::unit(f64::from(i) * std::f64::consts::FRAC_PI_6) * 0.2).collect();
        let goals: Vec<Vec2> = (0..12).map(|i| starts[(i + 1) % 12]).collect();
        let original = [true; 12];
        let journey = journey(&starts, &goals, &original);
        check(&journey, &stages(&journey, |_| None).unwrap());
    }
}
