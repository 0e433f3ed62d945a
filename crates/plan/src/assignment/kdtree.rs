//! A static k-d tree over places. It finds places that are near, that are cheap (near, with a high weight), or that are
//! not taken yet.

use lightbots_base::Vec2;

/// Most places in a leaf; uneven division may add one.
const LEAF: usize = 6;

/// Limits of a search: the number of places to find, and the cost that they must be below, square metres.
#[derive(Clone, Copy)]
pub(super) struct Most {
    pub count: usize,
    pub below: f64,
}

/// Weights that are subtracted from squared distances, square metres.
#[derive(Clone, Copy)]
pub(super) struct Weights<'a> {
    /// `of[id]`: the weight of a place.
    pub of: &'a [f64],
    /// `greatest[node]`: the greatest weight in that node.
    pub greatest: &'a [f64],
}

/// Places in a balanced tree. Nodes are numbered as in a binary heap: node k has children 2k and 2k + 1, the root is 1.
#[derive(Clone, Debug)]
pub(super) struct KdTree {
    /// Places in tree order.
    places: Vec<Vec2>,
    /// `ids[position]`: the index of that place in the list that built the tree.
    ids: Vec<u32>,
    /// `leaf_of[id]`: the leaf of a place.
    leaf_of: Vec<u32>,
    /// `position_of[id]`: the position of a place in tree order.
    position_of: Vec<u32>,
    nodes: Vec<Node>,
    first_leaf: usize,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    min: Vec2,
    max: Vec2,
    first: u32,
    last: u32,
}

impl Node {
    /// Least squared distance from `from` to the node's box.
    fn distance_squared(&self, from: Vec2) -> f64 {
        let x = (self.min.x - from.x).max(from.x - self.max.x).max(0.0);
        let y = (self.min.y - from.y).max(from.y - self.max.y).max(0.0);
        x * x + y * y
    }
}

impl KdTree {
    pub fn new(points: &[Vec2]) -> Self {
        Self::with_leaves(points, LEAF)
    }

    /// Builds a tree with at most `leaf` places in every leaf, or one more where places do not divide evenly.
    pub fn with_leaves(points: &[Vec2], leaf: usize) -> Self {
        let mut levels = 0;
        while points.len() >> levels > leaf {
            levels += 1;
        }
        let first_leaf = 1usize << levels;
        let empty = Node { min: Vec2::ZERO, max: Vec2::ZERO, first: 0, last: 0 };
        let mut tree = Self {
            places: points.to_vec(),
            ids: (0..points.len() as u32).collect(),
            leaf_of: vec![0; points.len()],
            position_of: vec![0; points.len()],
            nodes: vec![empty; 2 * first_leaf],
            first_leaf,
        };
        tree.divide(points, 1, 0, points.len());
        for position in 0..points.len() {
            let id = tree.ids[position] as usize;
            tree.places[position] = points[id];
            tree.position_of[id] = position as u32;
        }
        tree
    }

    fn divide(&mut self, points: &[Vec2], node: usize, first: usize, last: usize) {
        let (mut min, mut max) =
            (Vec2::new(f64::INFINITY, f64::INFINITY), Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY));
        for &id in &self.ids[first..last] {
            let at = points[id as usize];
            min = Vec2::new(min.x.min(at.x), min.y.min(at.y));
            max = Vec2::new(max.x.max(at.x), max.y.max(at.y));
        }
        self.nodes[node] = Node { min, max, first: first as u32, last: last as u32 };
        if node >= self.first_leaf {
            for &id in &self.ids[first..last] {
                self.leaf_of[id as usize] = node as u32;
            }
            return;
        }
        let middle = first.midpoint(last);
        let wide = max.x - min.x >= max.y - min.y;
        let key = |id: u32| if wide { points[id as usize].x } else { points[id as usize].y };
        if last > first {
            // Ties are broken by index, so that the same places give the same tree.
            self.ids[first..last]
                .select_nth_unstable_by(middle - first, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
        }
        self.divide(points, 2 * node, first, middle);
        self.divide(points, 2 * node + 1, middle, last);
    }

    /// Returns the place with this index in the list that built the tree, metres.
    pub fn place(&self, id: u32) -> Vec2 {
        self.places[self.position_of[id as usize] as usize]
    }

    /// Pairs each place of this tree with a different place of `other` at about the same share of the tree order.
    /// Yields the two indices. `other` must hold at least as many places.
    pub fn in_step_with(&self, other: &Self) -> impl Iterator<Item = (u32, u32)> {
        let (own, others) = (self.len(), other.len());
        self.ids.iter().enumerate().map(move |(rank, &id)| (id, other.ids[rank * others / own]))
    }

    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Returns a node and all nodes that contain it, up to the root.
    fn up_from(&self, node: usize) -> impl Iterator<Item = usize> + use<> {
        core::iter::successors(Some(node), |&node| (node > 1).then_some(node / 2))
    }

    /// Returns the greatest weight in every node, for [`Self::cheapest`]; `weights[id]` is the weight of a place.
    pub fn greatest(&self, weights: &[f64]) -> Vec<f64> {
        let mut greatest = vec![f64::NEG_INFINITY; self.nodes.len()];
        for (id, &weight) in weights.iter().enumerate() {
            let leaf = &mut greatest[self.leaf_of[id] as usize];
            *leaf = leaf.max(weight);
        }
        for node in (1..self.first_leaf).rev() {
            greatest[node] = greatest[2 * node].max(greatest[2 * node + 1]);
        }
        greatest
    }

    /// Replaces `found` with the cheapest places, as (cost, squared distance, id), sorted by cost. The cost of a place
    /// is its squared distance from `from` minus its weight. Only places with a cost below `most.below`, and for which
    /// `allowed(id)` returns `true`, are found, at most `most.count`.
    pub fn cheapest(
        &self,
        from: Vec2,
        most: Most,
        weights: Weights<'_>,
        allowed: impl Fn(u32) -> bool,
        found: &mut Vec<(f64, f64, u32)>,
    ) {
        found.clear();
        let mut limit = most.below;
        let mut stack = Stack::new(1);
        let bound = |node: usize| self.nodes[node].distance_squared(from) - weights.greatest[node];
        while let Some(node) = stack.pop() {
            let here = &self.nodes[node];
            if here.first == here.last || bound(node) >= limit {
                continue;
            }
            if node < self.first_leaf {
                let left_first = bound(2 * node) <= bound(2 * node + 1);
                stack.push(2 * node + usize::from(left_first));
                stack.push(2 * node + usize::from(!left_first));
                continue;
            }
            for position in here.first as usize..here.last as usize {
                let squared = (self.places[position] - from).length_squared();
                let id = self.ids[position];
                let cost = squared - weights.of[id as usize];
                if cost < limit && allowed(id) {
                    let rank = found.partition_point(|entry| entry.0 <= cost);
                    found.insert(rank, (cost, squared, id));
                    found.truncate(most.count);
                    if found.len() == most.count {
                        limit = found[most.count - 1].0;
                    }
                }
            }
        }
    }

    /// Replaces `found` with all places whose squared distance from `from` is at most `reach_squared`, as (squared
    /// distance, id).
    pub fn within(&self, from: Vec2, reach_squared: f64, found: &mut Vec<(f64, u32)>) {
        found.clear();
        let mut stack = Stack::new(1);
        while let Some(node) = stack.pop() {
            let here = &self.nodes[node];
            if here.first == here.last || here.distance_squared(from) > reach_squared {
                continue;
            }
            if node < self.first_leaf {
                stack.push(2 * node + 1);
                stack.push(2 * node);
                continue;
            }
            for position in here.first as usize..here.last as usize {
                let squared = (self.places[position] - from).length_squared();
                if squared <= reach_squared {
                    found.push((squared, self.ids[position]));
                }
            }
        }
    }

    /// Returns the mean place of every leaf, in tree order. In two trees with equally many places, leaves at the same
    /// position hold equally many.
    pub fn leaf_centres(&self) -> Vec<Vec2> {
        let leaves = self.nodes[self.first_leaf..].iter();
        let centre = |leaf: &Node| {
            let own = &self.places[leaf.first as usize..leaf.last as usize];
            own.iter().fold(Vec2::ZERO, |sum, &at| sum + at) / own.len().max(1) as f64
        };
        leaves.map(centre).collect()
    }
}

/// Nodes that a search must still visit. A depth-first search keeps at most one sibling for each level.
struct Stack {
    nodes: [u32; 72],
    count: usize,
}

impl Stack {
    fn new(root: u32) -> Self {
        let mut nodes = [0; 72];
        nodes[0] = root;
        Self { nodes, count: 1 }
    }

    fn push(&mut self, node: usize) {
        self.nodes[self.count] = node as u32;
        self.count += 1;
    }

    fn pop(&mut self) -> Option<usize> {
        self.count = self.count.checked_sub(1)?;
        Some(self.nodes[self.count] as usize)
    }

    /// Pushes both children, so that the one nearer to `from` is popped first.
    fn push_both(&mut self, tree: &KdTree, node: usize, from: Vec2) {
        let (left, right) = (2 * node, 2 * node + 1);
        let left_first = tree.nodes[left].distance_squared(from) <= tree.nodes[right].distance_squared(from);
        self.push(if left_first { right } else { left });
        self.push(if left_first { left } else { right });
    }
}

/// The places of a tree that have not been taken yet.
pub(super) struct Remaining {
    here: Vec<bool>,
    counts: Vec<u32>,
}

impl Remaining {
    /// Begins with the places for which `here(id)` returns `true`.
    pub fn new(tree: &KdTree, here: impl Fn(usize) -> bool) -> Self {
        let mut remaining = Self { here: Vec::new(), counts: Vec::new() };
        remaining.reset(tree, here);
        remaining
    }

    /// Starts again: contains the places for which `here(id)` returns `true`.
    pub fn reset(&mut self, tree: &KdTree, here: impl Fn(usize) -> bool) {
        self.here.clear();
        self.here.resize(tree.len(), false);
        self.counts.clear();
        self.counts.resize(tree.nodes.len(), 0);
        for id in (0..tree.len()).filter(|&id| here(id)) {
            self.here[tree.position_of[id] as usize] = true;
            self.counts[tree.leaf_of[id] as usize] += 1;
        }
        for node in (1..tree.first_leaf).rev() {
            self.counts[node] = self.counts[2 * node] + self.counts[2 * node + 1];
        }
    }

    /// Puts a place back, which must have been taken.
    pub fn put(&mut self, tree: &KdTree, id: usize) {
        self.here[tree.position_of[id] as usize] = true;
        let leaf = tree.leaf_of[id] as usize;
        tree.up_from(leaf).for_each(|node| self.counts[node] += 1);
    }

    /// Takes one place whose squared distance from `from` is at most `reach_squared`; `None` if there is none.
    pub fn take(&mut self, tree: &KdTree, from: Vec2, reach_squared: f64) -> Option<u32> {
        let mut taken = None;
        self.pull(tree, from, reach_squared, 1, |id| taken = Some(id));
        taken
    }

    /// Takes all places whose squared distance from `from` is at most `reach_squared`, in the order in which
    /// [`Self::take`] would.
    pub fn drain(&mut self, tree: &KdTree, from: Vec2, reach_squared: f64, taken: &mut Vec<u32>) {
        self.pull(tree, from, reach_squared, u32::MAX, |id| taken.push(id));
    }

    /// Takes up to `most` places whose squared distance from `from` is at most `reach_squared`, and calls `take` with
    /// each index.
    fn pull(
        &mut self,
        tree: &KdTree,
        from: Vec2,
        reach_squared: f64,
        mut most: u32,
        mut take: impl FnMut(u32),
    ) {
        let mut stack = Stack::new(1);
        while let Some(node) = stack.pop() {
            let here = &tree.nodes[node];
            if self.counts[node] == 0 || here.distance_squared(from) > reach_squared {
                continue;
            }
            if node < tree.first_leaf {
                stack.push_both(tree, node, from);
                continue;
            }
            let before = most;
            for position in here.first as usize..here.last as usize {
                let near = || (tree.places[position] - from).length_squared() <= reach_squared;
                if most > 0 && self.here[position] && near() {
                    self.here[position] = false;
                    most -= 1;
                    take(tree.ids[position]);
                }
            }
            if most < before {
                tree.up_from(node).for_each(|node| self.counts[node] -= before - most);
            }
            if most == 0 {
                return;
            }
        }
    }

    /// Returns the squared distance from `from` to the nearest remaining place, or `bound` if none is nearer.
    pub fn nearest_squared(&self, tree: &KdTree, from: Vec2, bound: f64) -> f64 {
        let mut least = bound;
        let mut stack = Stack::new(1);
        while let Some(node) = stack.pop() {
            let here = &tree.nodes[node];
            if self.counts[node] == 0 || here.distance_squared(from) >= least {
                continue;
            }
            if node < tree.first_leaf {
                stack.push_both(tree, node, from);
                continue;
            }
            for position in here.first as usize..here.last as usize {
                if self.here[position] {
                    least = least.min((tree.places[position] - from).length_squared());
                }
            }
        }
        least
    }
}
