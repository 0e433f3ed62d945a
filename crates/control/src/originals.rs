//! Robots that speak only TARGET and COLOR: in what order they go so that no two can meet, however fast they drive.

use crate::clear::Floor;
use crate::hop::{Hop, add_yields};
use crate::rearranging::Crowd;
use lightbots_base::Vec2;
use lightbots_plan::Path;

/// Rims of an original robot and others stay this far apart on the way, metres: its line is not quite straight, and
/// where it stops is known to some millimetres.
pub(crate) const MARGIN_M: f64 = 0.02;
/// Of so many robots that have to go round others, the one whose way is the least longer goes.
const WAYS_TRIED: usize = 12;
/// A stop on the way is as bad as so many metres, …
const STOP_M: f64 = 0.15;
/// … and standing in somebody's way as so many.
const BARS_M: f64 = 0.3;
/// Side of a cell where ways through narrow gaps are looked for, metres.
const FINE_CELL_M: f64 = 0.012;
/// How often each robot may step aside on average before it is said that there is no order.
const ASIDES_EACH: usize = 1;

/// What happens between two moments at which all stand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Stage {
    /// Straight drives, each valid where all before it are over; those that meet say who yields to whom.
    Targets(Vec<Hop>),
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
    let mut order = Order::new(journey);
    let mut driven = !journey.original.contains(&false);
    let (mut asides, mut rearranged) = (0, false);
    loop {
        if let Some(robot) = order.next() {
            order.go(robot, journey.goals[robot]);
        } else if driven && !order.waiting.contains(&true) {
            return Some(order.finish());
        } else if !driven && let Some(paths) = drive(&order.originals_and_standing()) {
            driven = true;
            order.follow(paths);
        } else {
            let detour = order.detour().filter(|_| asides < ASIDES_EACH * journey.starts.len());
            if let Some((robot, way, is_aside)) = detour {
                asides += usize::from(is_aside);
                way.into_iter().for_each(|at| order.go(robot, at));
                continue;
            }
            if !driven {
                order.clear_out(false)?;
                order.follow(drive(&order.originals_and_standing())?);
                driven = true;
            } else if std::mem::replace(&mut rearranged, true) {
                return None;
            } else {
                order.clear_out(true)?;
            }
        }
    }
}

/// An order being found.
struct Order<'a, 'b> {
    journey: &'a Journey<'b>,
    /// `[robot]`: where it stands after all hops so far.
    places: Vec<Vec2>,
    /// `[robot]`: an original that is not at its goal.
    waiting: Vec<bool>,
    /// `[robot]`, while it waits: how much stands in its straight way.
    in_way: Vec<usize>,
    /// `[robot]`: in how many straight ways of those who wait it would stand at its goal.
    bars: Vec<usize>,
    hops: Vec<Hop>,
    stages: Vec<Stage>,
}

impl<'a, 'b> Order<'a, 'b> {
    fn new(journey: &'a Journey<'b>) -> Self {
        let mut order = Self {
            journey,
            places: journey.starts.to_vec(),
            waiting: Vec::new(),
            in_way: Vec::new(),
            bars: Vec::new(),
            hops: Vec::new(),
            stages: Vec::new(),
        };
        order.look_around();
        order
    }

    /// Counts anew what stands in whose way.
    fn look_around(&mut self) {
        let robots = 0..self.places.len();
        let waits = |robot| self.journey.original[robot] && self.places[robot] != self.journey.goals[robot];
        self.waiting = robots.clone().map(waits).collect();
        self.in_way = robots.clone().map(|robot| self.count_in_way(robot)).collect();
        self.bars = robots.map(|robot| self.count_barred(robot)).collect();
    }

    fn count_in_way(&self, robot: usize) -> usize {
        let (from, to) = (self.places[robot], self.journey.goals[robot]);
        let floor = &self.journey.floor;
        let fixed = self.journey.standing.iter().filter(|&&disc| !floor.passes(from, to, disc)).count();
        let robots = (0..self.places.len()).filter(|&other| self.is_in_way(robot, other)).count();
        fixed + robots + usize::from(!floor.passes_obstacles(from, to))
    }

    fn count_barred(&self, robot: usize) -> usize {
        (0..self.places.len()).filter(|&other| self.waiting[other] && self.would_bar(robot, other)).count()
    }

    /// Whether another stands in the straight way of a robot.
    fn is_in_way(&self, robot: usize, other: usize) -> bool {
        let (floor, goal) = (&self.journey.floor, self.journey.goals[robot]);
        let at = self.places[other];
        // Beside one that is about to leave nobody needs to stand closer than on the way.
        let near = at != self.journey.goals[other] && goal.distance(at) < floor.gap_m;
        other != robot && (near || !floor.passes(self.places[robot], goal, at))
    }

    /// Whether a robot at its goal would stand in the straight way of another.
    fn would_bar(&self, robot: usize, other: usize) -> bool {
        let goals = self.journey.goals;
        other != robot && !self.journey.floor.passes(self.places[other], goals[other], goals[robot])
    }

    /// The robot that goes next, straight to its goal: who has the longest way of those nobody stands in the way of, and
    /// who will stand in nobody's.
    fn next(&self) -> Option<usize> {
        let is_free = |&robot: &usize| self.waiting[robot] && self.in_way[robot] + self.bars[robot] == 0;
        let way_m = |robot: usize| self.places[robot].distance(self.journey.goals[robot]);
        let shorter = |a: &usize, b: &usize| way_m(*a).total_cmp(&way_m(*b)).then(b.cmp(a));
        (0..self.places.len()).filter(is_free).max_by(shorter)
    }

    /// A robot goes straight to a place.
    fn go(&mut self, robot: usize, to: Vec2) {
        let others = |order: &Self| -> Vec<usize> {
            (0..order.places.len()).filter(|&other| other != robot && order.waiting[other]).collect()
        };
        for other in others(self) {
            self.in_way[other] -= usize::from(self.is_in_way(other, robot));
        }
        if self.waiting[robot] {
            for other in (0..self.places.len()).filter(|&other| other != robot) {
                self.bars[other] -= usize::from(self.would_bar(other, robot));
            }
        }
        self.hops.push(Hop::new(robot, self.places[robot], to));
        self.places[robot] = to;
        self.waiting[robot] = to != self.journey.goals[robot];
        for other in others(self) {
            self.in_way[other] += usize::from(self.is_in_way(other, robot));
        }
        if self.waiting[robot] {
            for other in (0..self.places.len()).filter(|&other| other != robot) {
                self.bars[other] += usize::from(self.would_bar(other, robot));
            }
            self.in_way[robot] = self.count_in_way(robot);
        }
    }

    /// All originals leave, so that others come through; `return_too`: and come back to their goals.
    fn clear_out(&mut self, return_too: bool) -> Option<()> {
        let Journey { floor, goals, original, standing, .. } = self.journey;
        let (movers, others): (Vec<usize>, Vec<usize>) =
            (0..self.places.len()).partition(|&robot| original[robot]);
        let discs: Vec<Vec2> =
            others.into_iter().map(|robot| self.places[robot]).chain(standing.iter().copied()).collect();
        let keep_free: Vec<Vec2> = self.places.iter().chain(*goals).copied().collect();
        let floor = Floor { cell_m: FINE_CELL_M, ..*floor };
        let crowd = Crowd { floor: &floor, movers: &movers, standing: &discs };
        crowd.leave(&self.places, &keep_free)?.into_iter().for_each(|(robot, to)| self.go(robot, to));
        if return_too {
            crowd.come_back(&self.places, goals)?.into_iter().for_each(|(robot, to)| self.go(robot, to));
        }
        Some(())
    }

    /// The robots that follow paths do so.
    fn follow(&mut self, paths: Vec<(usize, Path)>) {
        self.end_hops();
        paths.iter().for_each(|(robot, path)| self.places[*robot] = path.as_ref().end());
        self.stages.push(Stage::Routes(paths));
        self.look_around();
    }

    fn end_hops(&mut self) {
        let mut hops = std::mem::take(&mut self.hops);
        if !hops.is_empty() {
            add_yields(&mut hops, self.journey.floor.gap_m);
            self.stages.push(Stage::Targets(hops));
        }
    }

    fn finish(mut self) -> Vec<Stage> {
        self.end_hops();
        self.stages
    }

    /// Everything that stands while the others drive paths.
    fn originals_and_standing(&self) -> Vec<Vec2> {
        let originals = (0..self.places.len()).filter(|&robot| self.journey.original[robot]);
        originals.map(|robot| self.places[robot]).chain(self.journey.standing.iter().copied()).collect()
    }

    /// A way round for one robot, or out of the others' way: `(robot, way-points, whether it is only aside)`.
    fn detour(&self) -> Option<(usize, Vec<Vec2>, bool)> {
        let Journey { floor, goals, original, standing, .. } = self.journey;
        let discs_of = |robot: usize| -> Vec<Vec2> {
            let others = (0..self.places.len()).filter(|&other| other != robot);
            others.map(|other| self.places[other]).chain(standing.iter().copied()).collect()
        };
        let has_room = |robot: usize| {
            let near = |other: usize| {
                let stays = self.places[other] == goals[other];
                let needed_m = if stays { 2.0 * floor.radius_m } else { floor.gap_m };
                other != robot && self.places[other].distance(goals[robot]) < needed_m
            };
            !(0..self.places.len()).any(near)
        };
        let waiting = || (0..self.places.len()).filter(|&robot| self.waiting[robot]);
        let mut best: Option<(f64, usize, Vec<Vec2>)> = None;
        for (tried, robot) in waiting().filter(|&robot| has_room(robot)).enumerate() {
            if best.is_some() && tried >= WAYS_TRIED {
                break;
            }
            let Some(way) = floor.way(self.places[robot], goals[robot], &discs_of(robot)) else { continue };
            let longer_m = length_m(self.places[robot], &way) - self.places[robot].distance(goals[robot]);
            let cost_m = longer_m + STOP_M * (way.len() - 1) as f64 + BARS_M * self.bars[robot] as f64;
            if best.as_ref().is_none_or(|(least_m, ..)| cost_m < *least_m) {
                best = Some((cost_m, robot, way));
            }
        }
        if let Some((_, robot, way)) = best {
            return Some((robot, way, false));
        }
        let blocks = |robot: &usize| {
            let (robot, at) = (*robot, self.places[*robot]);
            (0..self.places.len()).any(|other| other != robot && goals[other].distance(at) < floor.gap_m)
        };
        let all_originals = (0..self.places.len()).filter(|&robot| original[robot]);
        let first = waiting().filter(blocks).chain(all_originals.filter(blocks));
        for robot in first {
            if let Some(way) = floor.aside(self.places[robot], &discs_of(robot), goals, floor.gap_m) {
                return Some((robot, way, true));
            }
        }
        None
    }
}

fn length_m(from: Vec2, way: &[Vec2]) -> f64 {
    let froms = std::iter::once(&from).chain(way);
    froms.zip(way).map(|(a, b)| a.distance(*b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clear::CELL_M;

    fn journey<'a>(starts: &'a [Vec2], goals: &'a [Vec2], original: &'a [bool]) -> Journey<'a> {
        let floor = Floor {
            half: Vec2::new(1.5, 1.5),
            obstacles: &[],
            radius_m: 0.027,
            gap_m: 0.074,
            cell_m: CELL_M,
        };
        Journey { floor, starts, goals, original, standing: &[] }
    }

    /// Drives hops at speeds that chance decides, with reports as late as it likes, each robot as far as it may go by
    /// them. Everybody arrives and nobody comes nearer to anybody than `gap_m`.
    fn drive_anyhow(places: &mut [Vec2], hops: &[Hop], gap_m: f64, seed: u64) {
        let mut dice = seed;
        let mut chance = |bound: u64| {
            dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (dice >> 33) % bound
        };
        let (mut at, mut said) = (vec![0.0; hops.len()], vec![0.0; hops.len()]);
        let eager: Vec<u64> = hops.iter().map(|_| 4 + chance(16)).collect();
        for _ in 0..20_000 {
            for (place, hop) in hops.iter().enumerate() {
                let first = (0..place).rev().find(|&before| hops[before].robot == hop.robot);
                if at[place] >= 1.0
                    || chance(20) > eager[place]
                    || first.is_some_and(|first| said[first] < 1.0)
                {
                    continue;
                }
                let may = hop.yields.iter().fold(1.0, |share: f64, y| match said[y.to] {
                    1.0 => share,
                    passed => share.min(hop.clear_share(&hops[y.to], passed, y.gap_m)),
                });
                at[place] = may.min(at[place] + chance(100) as f64 * 0.0005 / hop.length_m()).max(at[place]);
                places[hop.robot] = hop.at(at[place]);
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

    fn check(journey: &Journey<'_>, stages: &[Stage]) {
        for seed in 0..4 {
            let mut places = journey.starts.to_vec();
            for stage in stages {
                match stage {
                    Stage::Targets(hops) => drive_anyhow(&mut places, hops, 0.0599, seed),
                    Stage::Routes(_) => panic!("nobody follows paths"),
                }
            }
            assert!(places.iter().zip(journey.goals).all(|(at, goal)| at.distance(*goal) < 1e-9));
        }
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

    #[test]
    fn crowds_that_change_places_come_through() {
        for seed in 1..7u64 {
            let mut dice = seed;
            let mut below = |bound: usize| {
                dice = dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (dice >> 33) as usize % bound
            };
            let grid = |i: usize, pitch: f64| Vec2::new((i % 4) as f64 * pitch, (i / 4) as f64 * pitch);
            let starts: Vec<Vec2> = (0..12).map(|i| grid(i, 0.09)).collect();
            let mut goals: Vec<Vec2> = (0..12).map(|i| grid(i, 0.076) + Vec2::new(0.05, -0.04)).collect();
            (1..12).for_each(|i| goals.swap(i, below(i + 1)));
            let original = [true; 12];
            let journey = journey(&starts, &goals, &original);
            let stages = stages(&journey, |_| None).unwrap_or_else(|| panic!("no order for seed {seed}"));
            check(&journey, &stages);
        }
    }
}
