//! One step of all robots on the lattice: priority inheritance with backtracking (PIBT; Okumura et al. 2022), with one
//! more conflict rule. On a hexagonal lattice a robot may follow another into its node only where the two directions
//! differ by at most 60°. Then centres stay 0.86 pitches apart on the way, otherwise half a pitch.

use lightbots_base::Vec2;

use crate::cancel::Cancel;
use crate::mapf::lacam::{Constraint, Generator};
use crate::roads::lattice::{Lattice, NONE};

/// Marks a node without a robot.
const NO_ROBOT: u32 = u32::MAX;
/// Direction of a robot that stays.
const STAYS: u8 = 6;
/// Longest row of robots that one may push.
const MOST_PUSHED: usize = 500;
/// Most robots × nodes whose steps to goals are kept, two bytes each: a gigabyte.
const MOST_STEPS: usize = 1 << 29;

/// Memory of a step; kept between steps.
pub(crate) struct LatticePibt<'a> {
    cancel: Cancel<'a>,
    lattice: &'a Lattice,
    /// `[robot]`: its goal; [`NONE`]: it only makes way.
    goals: &'a [u32],
    /// `[robot][node]`: steps to its goal; empty without a goal.
    steps: Vec<Vec<u16>>,
    now: Vec<u32>,
    next: Vec<u32>,
    direction: Vec<u8>,
    holder_now: Vec<u32>,
    holder_next: Vec<u32>,
}

impl<'a> LatticePibt<'a> {
    /// A step generator for robots with these goals. `None`: robots × nodes exceed `MOST_STEPS`.
    pub fn new(lattice: &'a Lattice, goals: &'a [u32], cancel: Cancel<'a>) -> Option<Self> {
        let nodes = lattice.places.len();
        if nodes.saturating_mul(goals.len()) > MOST_STEPS {
            return None;
        }
        // The steps of a cancelled search are not used.
        let to = |&goal: &u32| {
            if goal == NONE || cancel.is_wanted() { Vec::new() } else { lattice.steps_to(goal) }
        };
        Some(Self {
            cancel,
            lattice,
            goals,
            steps: goals.iter().map(to).collect(),
            now: Vec::new(),
            next: vec![NONE; goals.len()],
            direction: vec![STAYS; goals.len()],
            holder_now: vec![NO_ROBOT; nodes],
            holder_next: vec![NO_ROBOT; nodes],
        })
    }
}

impl Generator for LatticePibt<'_> {
    fn is_spent(&self) -> bool {
        self.cancel.is_wanted()
    }

    fn around(&self, _robot: usize, node: u32) -> impl Iterator<Item = u32> {
        self.lattice.neighbours[node as usize].into_iter().filter(|&node| node != NONE)
    }

    fn far(&self, robot: usize, node: u32) -> f64 {
        let steps = self.steps[robot].get(node as usize).copied().unwrap_or(0);
        if steps == u16::MAX { f64::INFINITY } else { f64::from(steps) }
    }

    fn step(&mut self, now: &[u32], ranks: &[usize], constraints: &[Constraint]) -> Option<Vec<u32>> {
        self.now.clear();
        self.now.extend_from_slice(now);
        self.next.fill(NONE);
        for (robot, &node) in now.iter().enumerate() {
            self.holder_now[node as usize] = robot as u32;
        }
        let done = constraints.iter().all(|&(robot, node)| {
            let direction = self.direction_to(now[robot], node);
            let may = direction.is_some_and(|direction| self.may_enter(robot, node, direction));
            if may {
                self.reserve(robot, node, direction.unwrap_or(STAYS));
            }
            may
        }) && ranks.iter().all(|&robot| self.next[robot] != NONE || self.choose(robot, 0));
        let next = done.then(|| self.next.clone());
        self.holder_next.fill(NO_ROBOT);
        for &node in now {
            self.holder_now[node as usize] = NO_ROBOT;
        }
        next.filter(|next| self.is_legal(now, next))
    }
}

impl LatticePibt<'_> {
    fn direction_to(&self, from: u32, to: u32) -> Option<u8> {
        if from == to {
            return Some(STAYS);
        }
        self.lattice.neighbours[from as usize].iter().position(|&node| node == to).map(|k| k as u8)
    }

    fn reserve(&mut self, robot: usize, node: u32, direction: u8) {
        let before = self.next[robot];
        if before != NONE && self.holder_next[before as usize] == robot as u32 {
            self.holder_next[before as usize] = NO_ROBOT;
        }
        self.next[robot] = node;
        self.direction[robot] = direction;
        self.holder_next[node as usize] = robot as u32;
    }

    /// Whether a robot may enter a node beside what is decided.
    fn may_enter(&self, robot: usize, node: u32, direction: u8) -> bool {
        if self.holder_next[node as usize] != NO_ROBOT {
            return false;
        }
        if direction == STAYS {
            return true;
        }
        let ahead = self.holder_now[node as usize];
        let follows = ahead == NO_ROBOT
            || self.next[ahead as usize] == NONE
            || may_follow(direction, self.direction[ahead as usize]);
        let behind = self.holder_next[self.now[robot] as usize];
        follows && (behind == NO_ROBOT || may_follow(self.direction[behind as usize], direction))
    }

    /// Lets a robot choose, and then the robots in its way. Returns whether it moved or stayed by its own choice.
    fn choose(&mut self, robot: usize, depth: usize) -> bool {
        let here = self.now[robot];
        let mut choices = [(0u64, NONE, STAYS); 7];
        let mut count = 0;
        let around = self.lattice.neighbours[here as usize];
        for (direction, node) in around.into_iter().enumerate().chain([(STAYS as usize, here)]) {
            if node != NONE {
                choices[count] = (self.reluctance(robot, here, node), node, direction as u8);
                count += 1;
            }
        }
        choices[..count].sort_unstable();
        for &(_, node, direction) in &choices[..count] {
            if !self.may_enter(robot, node, direction) {
                continue;
            }
            self.reserve(robot, node, direction);
            let ahead = self.holder_now[node as usize];
            let free = ahead == NO_ROBOT || ahead as usize == robot || self.next[ahead as usize] != NONE;
            if free || (depth < MOST_PUSHED && self.choose(ahead as usize, depth + 1)) {
                return true;
            }
            if ahead != NO_ROBOT && self.next[ahead as usize] == NONE {
                self.next[robot] = NONE;
                self.holder_next[node as usize] = NO_ROBOT;
            }
        }
        let holder = self.holder_next[here as usize];
        if holder == NO_ROBOT || holder == robot as u32 {
            self.reserve(robot, here, STAYS);
        } else {
            // The robot that wanted this node finds it taken and chooses again.
            self.next[robot] = here;
            self.direction[robot] = STAYS;
            self.holder_next[here as usize] = robot as u32;
        }
        false
    }

    /// Cost of a node for a robot: steps left, then whether a robot stands there, then the straight distance to its
    /// goal.
    fn reluctance(&self, robot: usize, here: u32, node: u32) -> u64 {
        let taken = u64::from(node != here && self.holder_now[node as usize] != NO_ROBOT);
        let goal = self.goals[robot];
        if goal == NONE {
            return (u64::from(node != here) << 40) + (taken << 32);
        }
        let steps = u64::from(self.steps[robot][node as usize]);
        let far: Vec2 = self.lattice.places[node as usize] - self.lattice.places[goal as usize];
        (steps << 40) + (taken << 32) + ((far.length() * 1e5) as u64).min(u64::from(u32::MAX))
    }

    /// Checks all rules once more, for all robots.
    fn is_legal(&mut self, now: &[u32], next: &[u32]) -> bool {
        for (robot, &node) in now.iter().enumerate() {
            self.holder_now[node as usize] = robot as u32;
        }
        let mut legal = true;
        for (robot, &node) in next.iter().enumerate() {
            legal &= self.holder_next[node as usize] == NO_ROBOT;
            self.holder_next[node as usize] = robot as u32;
            let ahead = self.holder_now[node as usize];
            if node != now[robot] && ahead != NO_ROBOT {
                let mine = self.direction_to(now[robot], node);
                let theirs = self.direction_to(now[ahead as usize], next[ahead as usize]);
                legal &= mine.zip(theirs).is_some_and(|(mine, theirs)| may_follow(mine, theirs));
            }
        }
        for (&before, &after) in now.iter().zip(next) {
            self.holder_now[before as usize] = NO_ROBOT;
            self.holder_next[after as usize] = NO_ROBOT;
        }
        legal
    }
}

/// Whether a robot may enter a node in direction `mine` while another leaves it in direction `theirs`.
fn may_follow(mine: u8, theirs: u8) -> bool {
    if theirs >= STAYS || mine >= STAYS {
        return false;
    }
    matches!((theirs + 6 - mine) % 6, 0 | 1 | 5)
}
