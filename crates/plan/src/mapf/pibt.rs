//! One step of all robots on a graph: priority inheritance with backtracking (PIBT; Okumura et al. 2022). In a step,
//! each robot stays at its node or moves to a neighbouring node. A [`ConflictRule`] for each kind of graph defines
//! which moves conflict.

use crate::cancel::Cancel;
use crate::roads::graph::NONE;

/// A low-level constraint `(robot, node)`: the robot must go to the node in this step, or stay there.
pub(crate) type Constraint = (usize, u32);

/// Defines which moves conflict, and in which order a robot tries its moves.
pub(crate) trait ConflictRule {
    /// Returns the nodes to which a robot may go from a node in one step, without the node itself.
    fn around(&self, robot: usize, node: u32) -> impl Iterator<Item = u32>;

    /// Returns the cost of a robot's path from a node to the robot's goal. Infinite if there is no path; 0 for a robot
    /// without a goal.
    fn far(&self, robot: usize, node: u32) -> f64;

    /// Returns the cost of a robot's move to a node. A robot tries its moves in ascending order of cost.
    fn reluctance(&self, moves: &Moves, robot: usize, node: u32) -> f64;

    /// Begins a step in which robot `r` starts at node `now[r]`. Returns the number of checks of pairs of robots that
    /// this took.
    fn begin(&mut self, now: &[u32]) -> usize;

    /// Checks the move of a robot to a node. Adds to `must_make_way` the undecided robots that would conflict with it
    /// if they stayed. Returns `false` if it conflicts with a decided move; the added robots then mean nothing.
    fn may_go(&self, moves: &Moves, robot: usize, node: u32, must_make_way: &mut Vec<usize>) -> bool;

    /// Records a decided move.
    fn decide(&mut self, _moves: &Moves, _robot: usize, _node: u32) {}

    /// Takes back a decided move.
    fn undo(&mut self, _robot: usize, _node: u32) {}

    /// Returns the number of pairs of robots that one call of [`Self::may_go`] for a robot checks.
    fn looks(&self, robot: usize) -> usize;
}

/// The moves of a step.
pub(crate) struct Moves {
    /// `[robot]`: its node before the step.
    pub now: Vec<u32>,
    /// `[robot]`: its node after the step; [`NONE`]: not decided yet.
    pub next: Vec<u32>,
}

impl Moves {
    pub fn is_decided(&self, robot: usize) -> bool {
        self.next[robot] != NONE
    }
}

/// Bounds on the work of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PibtBounds {
    /// Most moves that are tried for one robot and all robots that it pushes, in one step.
    pub tries: usize,
    /// Longest chain of robots in which each pushes the next.
    pub pushed: usize,
    /// Most checks of pairs of robots in the whole search.
    pub looks: usize,
}

/// Generates steps of all robots; its buffers are kept between steps.
pub(crate) struct Pibt<'a, Rule> {
    pub rule: Rule,
    bounds: PibtBounds,
    cancel: Cancel<'a>,
    moves: Moves,
    /// Robots with a decided move, in order of decision.
    decided: Vec<usize>,
    /// Stack with the robots that must make way, in one range for each move that is being decided.
    must_make_way: Vec<usize>,
    /// Stack with possible moves as (cost, node), in one range for each robot that is choosing a move.
    choices: Vec<(f64, u32)>,
    /// Number of moves that may still be tried for the current robot and those that it pushes.
    tries: usize,
}

impl<'a, Rule: ConflictRule> Pibt<'a, Rule> {
    pub fn new(rule: Rule, robots: usize, bounds: PibtBounds, cancel: Cancel<'a>) -> Self {
        Self {
            rule,
            bounds,
            cancel,
            moves: Moves { now: vec![NONE; robots], next: vec![NONE; robots] },
            decided: Vec::with_capacity(robots),
            must_make_way: Vec::new(),
            choices: Vec::new(),
            tries: 0,
        }
    }

    /// Whether the checks of pairs are used up, or the planner is cancelled.
    pub fn is_spent(&self) -> bool {
        self.bounds.looks == 0 || self.cancel.is_wanted()
    }

    /// Returns `[robot]`: its node after one step from the nodes `now`. Robots earlier in `ranks` choose first. `None`
    /// if the step cannot keep all `constraints`.
    pub fn step(&mut self, now: &[u32], ranks: &[usize], constraints: &[Constraint]) -> Option<Vec<u32>> {
        self.moves.now.copy_from_slice(now);
        let looks = self.rule.begin(now);
        self.bounds.looks = self.bounds.looks.saturating_sub(looks);
        let all = self.decide_all(now, ranks, constraints);
        let next = all.map(|()| self.moves.next.clone());
        self.undo(0);
        next
    }

    /// Returns how many checks of pairs are left.
    pub fn looks_left(&self) -> usize {
        self.bounds.looks
    }

    fn decide(&mut self, robot: usize, node: u32) {
        self.moves.next[robot] = node;
        self.rule.decide(&self.moves, robot, node);
        self.decided.push(robot);
    }

    /// Takes back all decided moves but the first `kept` ones.
    fn undo(&mut self, kept: usize) {
        while self.decided.len() > kept {
            let Some(robot) = self.decided.pop() else { return };
            self.rule.undo(robot, self.moves.next[robot]);
            self.moves.next[robot] = NONE;
        }
    }

    /// Decides the move of a robot to a node, and moves of all robots that must make way for it. If one of these cannot
    /// make way, decides nothing and returns `false`.
    fn go(&mut self, robot: usize, node: u32, depth: usize) -> bool {
        self.bounds.looks = self.bounds.looks.saturating_sub(self.rule.looks(robot));
        let first = self.must_make_way.len();
        let may_go = self.rule.may_go(&self.moves, robot, node, &mut self.must_make_way);
        let pushes = self.must_make_way.len() > first;
        let is_spent = self.tries == 0 || self.bounds.looks == 0 || (depth >= self.bounds.pushed && pushes);
        let done = may_go && !is_spent && {
            self.tries -= 1;
            let kept = self.decided.len();
            self.decide(robot, node);
            let last = self.must_make_way.len();
            let all = (first..last).all(|place| {
                let other = self.must_make_way[place];
                self.moves.is_decided(other) || self.choose(other, depth + 1)
            });
            if !all {
                self.undo(kept);
            }
            all
        };
        self.must_make_way.truncate(first);
        done
    }

    /// Decides the cheapest possible move of a robot, together with moves of the robots that must make way for it.
    /// Returns `false` if no move is possible.
    fn choose(&mut self, robot: usize, depth: usize) -> bool {
        let (here, first) = (self.moves.now[robot], self.choices.len());
        let (rule, moves) = (&self.rule, &self.moves);
        let cost = |node: u32| (rule.reluctance(moves, robot, node), node);
        self.choices.extend(rule.around(robot, here).chain([here]).map(cost));
        self.choices[first..].sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let last = self.choices.len();
        let done = (first..last).any(|place| self.go(robot, self.choices[place].1, depth));
        self.choices.truncate(first);
        done
    }

    /// Decides the moves of all robots in a step; `None` if the constraints cannot be kept.
    fn decide_all(&mut self, now: &[u32], ranks: &[usize], constraints: &[Constraint]) -> Option<()> {
        // Constraints come first, and then the robots in their way. With a constraint for each robot, every legal step
        // can be generated.
        let mut must_make_way = Vec::new();
        for &(robot, node) in constraints {
            let may_go = self.rule.may_go(&self.moves, robot, node, &mut must_make_way);
            may_go.then(|| self.decide(robot, node))?;
        }
        for robot in must_make_way {
            self.tries = self.bounds.tries;
            if !self.moves.is_decided(robot) && !self.choose(robot, 0) {
                return None;
            }
        }
        for &robot in ranks {
            self.tries = self.bounds.tries;
            if !self.moves.is_decided(robot) && !self.choose(robot, 0) {
                // The robot stays. This is safe: a decided move conflicts with no robot that stays, or that robot would
                // have had to make way.
                self.decide(robot, now[robot]);
            }
        }
        Some(())
    }
}
