//! The conflict rule of the hexagonal lattice. In a step, a robot may enter the node that another robot leaves only if
//! the directions of both differ by at most 60°. Then their centres stay 0.86 pitches apart on the way, where a pitch
//! is the distance between neighbouring nodes. In other cases, only half a pitch is sure.

use crate::cancel::Cancel;
use crate::mapf::pibt::{ConflictRule, Moves, Pibt, PibtBounds};
use crate::roads::graph::{Graph, NONE, steps_to};
use crate::roads::lattice::Lattice;

/// Marks a node that no robot is on.
const NO_ROBOT: u32 = u32::MAX;
/// Direction of a robot that stays; moves have the directions 0 to 5.
const STAYS: u8 = 6;
/// Largest product of robots and nodes. The table of steps to goals takes two bytes for each product, a gigabyte in
/// all.
const MOST_STEPS: usize = 1 << 29;
/// Bounds on the work. Checks of pairs of robots are not bounded, because each node knows its robot.
const BOUNDS: PibtBounds = PibtBounds { tries: 600, pushed: 500, looks: usize::MAX };
/// Cost of a move to a node with a robot on it, in steps. It decides between nodes with equally many steps left.
const TAKEN: f64 = 0.5;
/// Cost of each metre from a node to the goal, in steps. It decides between nodes that are otherwise equal.
const METRE: f64 = 1e-3;

/// Which robot is at which node of the lattice, and the numbers of steps to their goals.
pub(crate) struct LatticeRule<'a> {
    lattice: &'a Lattice,
    /// `[robot]`: the node of its goal; [`NONE`] if the robot only makes way.
    goals: &'a [u32],
    /// `[robot][node]`: number of steps from the node to the robot's goal; empty for a robot without a goal.
    steps: Vec<Vec<u16>>,
    /// `[robot]`: direction of its decided move; meaningless while the move is undecided.
    direction: Vec<u8>,
    /// `[node]`: the robot on it before the step; [`NO_ROBOT`] if there is none.
    holder_now: Vec<u32>,
    /// `[node]`: the robot that will be on it after the step; [`NO_ROBOT`] if there is none, or none is decided yet.
    holder_next: Vec<u32>,
}

/// A step generator for robots with these goals. `None` if the table of steps would exceed `MOST_STEPS`.
pub(crate) fn lattice_pibt<'a>(
    lattice: &'a Lattice,
    goals: &'a [u32],
    cancel: Cancel<'a>,
) -> Option<Pibt<'a, LatticeRule<'a>>> {
    let nodes = lattice.places.len();
    if nodes.saturating_mul(goals.len()) > MOST_STEPS {
        return None;
    }
    // The steps of a cancelled search are not used.
    let to = |&goal: &u32| {
        if goal == NONE || cancel.is_wanted() { Vec::new() } else { steps_to(lattice, goal) }
    };
    let rule = LatticeRule {
        lattice,
        goals,
        steps: goals.iter().map(to).collect(),
        direction: vec![STAYS; goals.len()],
        holder_now: vec![NO_ROBOT; nodes],
        holder_next: vec![NO_ROBOT; nodes],
    };
    Some(Pibt::new(rule, goals.len(), BOUNDS, cancel))
}

impl LatticeRule<'_> {
    fn direction_to(&self, from: u32, to: u32) -> Option<u8> {
        if from == to {
            return Some(STAYS);
        }
        self.lattice.neighbours[from as usize].iter().position(|&node| node == to).map(|k| k as u8)
    }
}

impl ConflictRule for LatticeRule<'_> {
    fn around(&self, _robot: usize, node: u32) -> impl Iterator<Item = u32> {
        self.lattice.neighbours(node)
    }

    fn far(&self, robot: usize, node: u32) -> f64 {
        let steps = self.steps[robot].get(node as usize).copied().unwrap_or(0);
        if steps == u16::MAX { f64::INFINITY } else { f64::from(steps) }
    }

    /// The cost compares the steps left first, then whether a robot is on the node, then the straight distance to the
    /// goal.
    fn reluctance(&self, moves: &Moves, robot: usize, node: u32) -> f64 {
        let moves_away = node != moves.now[robot];
        let is_taken = moves_away && self.holder_now[node as usize] != NO_ROBOT;
        let taken = if is_taken { TAKEN } else { 0.0 };
        match self.goals[robot] {
            NONE => f64::from(u8::from(moves_away)) + taken,
            goal => self.far(robot, node) + taken + self.lattice.length_m(node, goal) * METRE,
        }
    }

    fn begin(&mut self, now: &[u32]) -> usize {
        self.holder_now.fill(NO_ROBOT);
        for (robot, &node) in now.iter().enumerate() {
            self.holder_now[node as usize] = robot as u32;
        }
        0
    }

    fn may_go(&self, moves: &Moves, robot: usize, node: u32, must_make_way: &mut Vec<usize>) -> bool {
        let here = moves.now[robot];
        let Some(direction) = self.direction_to(here, node) else { return false };
        if self.holder_next[node as usize] != NO_ROBOT {
            return false;
        }
        let behind = self.holder_next[here as usize];
        if behind != NO_ROBOT && !may_follow(self.direction[behind as usize], direction) {
            return false;
        }
        let ahead = self.holder_now[node as usize];
        if direction == STAYS || ahead == NO_ROBOT {
            return true;
        }
        if moves.is_decided(ahead as usize) {
            return may_follow(direction, self.direction[ahead as usize]);
        }
        must_make_way.push(ahead as usize);
        true
    }

    fn decide(&mut self, moves: &Moves, robot: usize, node: u32) {
        self.direction[robot] = self.direction_to(moves.now[robot], node).unwrap_or(STAYS);
        self.holder_next[node as usize] = robot as u32;
    }

    fn undo(&mut self, _robot: usize, node: u32) {
        self.holder_next[node as usize] = NO_ROBOT;
    }

    fn looks(&self, _robot: usize) -> usize {
        0
    }
}

/// Whether a robot may enter a node in direction `mine` while another robot leaves that node in direction `theirs`.
fn may_follow(mine: u8, theirs: u8) -> bool {
    if theirs >= STAYS || mine >= STAYS {
        return false;
    }
    matches!((theirs + 6 - mine) % 6, 0 | 1 | 5)
}
