//! Regions of the floor between which no robot can drive. Obstacles with too narrow a gap between them count as one
//! wall. Gaps between shapes are measured exactly; only the area of a wall is rounded to squares of a grid.

use lightbots_base::Vec2;
use lightbots_base::shape::nearest_in_rect;
use lightbots_show::Obstacle;

use crate::TransitionProblem;
use crate::cancel::Cancel;
use crate::margins::REGION_M;

/// Number of grid squares in a robot's radius.
const SQUARES_A_RADIUS: f64 = 3.0;
/// Most grid squares; floors with more of them are not divided into regions.
const MOST_SQUARES: f64 = 4e6;
/// Thickness of the wall around an obstacle, as a share of a robot's radius. It must exceed one square, and be so small
/// that no robot's centre can be within it.
const WALL_SHARE: f64 = 0.5;
/// Thickness of the wall on either side of the line across a gap that is too narrow, in squares. A thinner wall would
/// let the filling of a region leak through.
const GAP_SQUARES: f64 = 0.75;
/// Radius, in squares, within which a place in a wall takes the region of the nearest square.
const MOST_RINGS: i64 = 4;
/// Marks a square that has no region yet.
const NONE: u32 = u32::MAX;
/// Marks a square of a wall.
const WALL: u32 = u32::MAX - 1;

/// A thing that does not move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Thing {
    /// An obstacle, by its index in the problem's list.
    Obstacle(usize),
    /// A standing robot, by its index in the problem's list.
    Standing(usize),
    /// The floor's edge.
    Edge,
}

/// A gap that is too narrow to drive through.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// The two things on either side of the gap.
    pub between: (Thing, Thing),
    /// Width from rim to rim, metres; 0 or less if the two things touch or overlap.
    pub wide_m: f64,
    /// Ends of the line across the gap where it is narrowest, stage metres. For rims that are round, these ends lie
    /// inside the things.
    pub ends: (Vec2, Vec2),
}

/// The floor, divided into regions.
pub(crate) struct Regions {
    /// Half the floor's width and depth, metres.
    half: Vec2,
    /// Side of a grid square, metres.
    square_m: f64,
    columns: i64,
    rows: i64,
    /// `[square]`: the number of its region, or [`WALL`]. Squares are numbered row by row.
    part_of: Vec<u32>,
    /// Number of regions.
    pub parts: usize,
    /// Gaps that are too narrow to drive through.
    pub gaps: Vec<Gap>,
    shapes: Vec<(Thing, Shape)>,
}

/// A rectangle that is enlarged by `round_m` on all sides and thereby has round corners. A disc is a single point
/// enlarged by its radius.
#[derive(Clone, Copy, Debug)]
struct Shape {
    min: Vec2,
    max: Vec2,
    round_m: f64,
}

impl Shape {
    fn of(thing: &Obstacle) -> Self {
        match *thing {
            Obstacle::Disc { at, radius_m } => Self { min: at, max: at, round_m: radius_m },
            Obstacle::Rect { min, max } => Self { min, max, round_m: 0.0 },
        }
    }

    /// Returns the place in the shape's rectangle, without its enlargement, that is nearest to `from`.
    fn core(&self, from: Vec2) -> Vec2 {
        nearest_in_rect(from, self.min, self.max)
    }

    /// Distance of a place from the shape's rim, metres; negative inside. In the inner rectangle it is −`round_m`.
    fn off_m(&self, place: Vec2) -> f64 {
        self.core(place).distance(place) - self.round_m
    }

    /// Returns the ends of the shortest line between the rectangles of two shapes, without their enlargement.
    fn line_to(&self, other: &Self) -> (Vec2, Vec2) {
        let middle = |a_min: f64, a_max: f64, b_min: f64, b_max: f64| {
            let (low, high) = (a_min.max(b_min), a_max.min(b_max));
            // Where the two overlap along an axis, the line is in the middle of the overlap.
            if low <= high {
                ((low + high) / 2.0, (low + high) / 2.0)
            } else if a_max < b_min {
                (a_max, b_min)
            } else {
                (a_min, b_max)
            }
        };
        let (ax, bx) = middle(self.min.x, self.max.x, other.min.x, other.max.x);
        let (ay, by) = middle(self.min.y, self.max.y, other.min.y, other.max.y);
        (Vec2::new(ax, ay), Vec2::new(bx, by))
    }
}

/// Least width of a gap between two things through which a robot can drive, metres: its diameter and [`REGION_M`] on
/// either side. If the second thing is the floor's edge, there is no margin on that side.
pub(crate) fn enough_m(problem: &TransitionProblem, (_, other): (Thing, Thing)) -> f64 {
    let margins = if other == Thing::Edge { 1.0 } else { 2.0 };
    problem.limits.contact_m() + margins * REGION_M
}

impl Regions {
    /// Regions of a problem's floor; `None` if it has no obstacles or no area, or if it needs more than
    /// [`MOST_SQUARES`].
    pub fn new(problem: &TransitionProblem, cancel: Cancel<'_>) -> Option<Self> {
        let half = problem.half_floor;
        let square_m = problem.limits.radius_m / SQUARES_A_RADIUS;
        let count = |half: f64| (2.0 * half / square_m).ceil();
        let is_small = half.x > 0.0 && half.y > 0.0 && count(half.x) * count(half.y) <= MOST_SQUARES;
        if problem.obstacles.is_empty() || !is_small {
            return None;
        }
        let discs = problem.standing.iter().enumerate().map(|(index, &at)| {
            (Thing::Standing(index), Shape { min: at, max: at, round_m: problem.limits.radius_m })
        });
        let things = problem.obstacles.iter().enumerate();
        let things = things.map(|(index, thing)| (Thing::Obstacle(index), Shape::of(thing)));
        let (columns, rows) = (count(half.x) as i64, count(half.y) as i64);
        let mut regions = Self {
            half,
            square_m,
            columns,
            rows,
            part_of: vec![NONE; (columns * rows) as usize],
            parts: 0,
            gaps: Vec::new(),
            shapes: things.chain(discs).collect(),
        };
        regions.gaps = regions.closed(problem);
        regions.build_walls(problem.limits.radius_m * WALL_SHARE, cancel);
        regions.fill();
        Some(regions)
    }

    /// Returns the gaps that are too narrow to drive through.
    fn closed(&self, problem: &TransitionProblem) -> Vec<Gap> {
        let mut gaps = Vec::new();
        for (index, &(thing, shape)) in self.shapes.iter().enumerate() {
            let between_shapes = self.shapes[index + 1..].iter().map(|&(other, to)| {
                let line = shape.line_to(&to);
                let wide_m = line.0.distance(line.1) - shape.round_m - to.round_m;
                Gap { between: (thing, other), wide_m, ends: line }
            });
            gaps.extend(
                between_shapes
                    .chain(self.to_edges(thing, &shape))
                    .filter(|gap| gap.wide_m < enough_m(problem, gap.between)),
            );
        }
        gaps
    }

    fn to_edges(&self, thing: Thing, shape: &Shape) -> [Gap; 4] {
        let middle = (shape.min + shape.max) / 2.0;
        let Vec2 { x, y } = self.half;
        [
            (Vec2::new(shape.min.x, middle.y), Vec2::new(-x, middle.y), shape.min.x + x),
            (Vec2::new(shape.max.x, middle.y), Vec2::new(x, middle.y), x - shape.max.x),
            (Vec2::new(middle.x, shape.min.y), Vec2::new(middle.x, -y), shape.min.y + y),
            (Vec2::new(middle.x, shape.max.y), Vec2::new(middle.x, y), y - shape.max.y),
        ]
        .map(|(from, to, far_m)| Gap {
            between: (thing, Thing::Edge),
            wide_m: far_m - shape.round_m,
            ends: (from, to),
        })
    }

    fn build_walls(&mut self, thick_m: f64, cancel: Cancel<'_>) {
        for index in (0..self.shapes.len()).take_while(|_| !cancel.is_wanted()) {
            let shape = self.shapes[index].1;
            self.wall(shape.min, shape.max, shape.round_m + thick_m, |place| shape.off_m(place) < thick_m);
        }
        let thick_m = self.square_m * GAP_SQUARES;
        for Gap { ends: (from, to), .. } in self.gaps.clone().into_iter().take_while(|_| !cancel.is_wanted())
        {
            let min = Vec2::new(from.x.min(to.x), from.y.min(to.y));
            let max = Vec2::new(from.x.max(to.x), from.y.max(to.y));
            self.wall(min, max, thick_m, |place| off_line(place, from, to) < thick_m);
        }
    }

    /// Marks squares within `around_m` metres of a rectangle as wall, if `is_in` holds for the middle of the square.
    fn wall(&mut self, min: Vec2, max: Vec2, around_m: f64, is_in: impl Fn(Vec2) -> bool) {
        let around = Vec2::new(around_m, around_m);
        let ((left, low), (right, high)) = (self.square(min - around), self.square(max + around));
        for row in low.max(0)..=high.min(self.rows - 1) {
            for column in left.max(0)..=right.min(self.columns - 1) {
                if is_in(self.middle(column, row)) {
                    self.part_of[(row * self.columns + column) as usize] = WALL;
                }
            }
        }
    }

    fn square(&self, place: Vec2) -> (i64, i64) {
        let number = |at: f64, half: f64| ((at + half) / self.square_m).floor().clamp(-1e9, 1e9) as i64;
        (number(place.x, self.half.x), number(place.y, self.half.y))
    }

    fn middle(&self, column: i64, row: i64) -> Vec2 {
        Vec2::new(column as f64 + 0.5, row as f64 + 0.5) * self.square_m - self.half
    }

    fn fill(&mut self) {
        let mut open = Vec::new();
        for first in 0..self.part_of.len() {
            if self.part_of[first] != NONE {
                continue;
            }
            let part = self.parts as u32;
            self.parts += 1;
            self.part_of[first] = part;
            open.push(first as i64);
            while let Some(square) = open.pop() {
                let column = square % self.columns;
                let beside = [
                    (column > 0).then_some(square - 1),
                    (column + 1 < self.columns).then_some(square + 1),
                    Some(square - self.columns),
                    Some(square + self.columns),
                ];
                for next in beside.into_iter().flatten() {
                    if let Some(found) = self.part_of.get_mut(next as usize).filter(|found| **found == NONE) {
                        *found = part;
                        open.push(next);
                    }
                }
            }
        }
    }

    /// Returns the region of a place, or the nearest region within [`MOST_RINGS`] squares; `None` if there is none.
    pub fn part(&self, place: Vec2) -> Option<u32> {
        let (column, row) = self.square(place);
        (0..=MOST_RINGS).find_map(|ring| {
            let rows = (row - ring).max(0)..=(row + ring).min(self.rows - 1);
            let near = rows.flat_map(|y| {
                ((column - ring).max(0)..=(column + ring).min(self.columns - 1)).map(move |x| (x, y))
            });
            let parts = near.filter_map(|(x, y)| {
                let part = self.part_of[(y * self.columns + x) as usize];
                (part < WALL).then(|| (self.middle(x, y).distance(place), part))
            });
            parts.min_by(|a, b| a.0.total_cmp(&b.0)).map(|found| found.1)
        })
    }

    /// Whether a gap lies between region `part` and another region. The regions `off_m` metres to either side of the
    /// middle of the gap are compared.
    fn leads_out(&self, gap: &Gap, part: u32, off_m: f64) -> bool {
        let (from, to) = gap.ends;
        let Some(along) = (to - from).normalized() else { return false };
        let side = |sign: f64| self.part(from.lerp(to, 0.5) + along.left() * (sign * off_m));
        match (side(1.0), side(-1.0)) {
            (Some(a), Some(b)) => a != b && (a == part || b == part),
            _ => false,
        }
    }

    /// Returns the widest of the gaps between region `part` and other regions that are wider than 0, but too narrow;
    /// `None` if there is none.
    pub fn way_out(&self, part: u32) -> Option<Gap> {
        let off_m = self.square_m * (MOST_RINGS as f64 - 1.0);
        let out = self.gaps.iter().filter(|gap| gap.wide_m > 0.0 && self.leads_out(gap, part, off_m));
        out.copied().max_by(|a, b| a.wide_m.total_cmp(&b.wide_m))
    }

    /// Returns the obstacles and standing robots next to region `part`: a rectangle slightly larger than the thing
    /// contains a square of the region.
    pub fn around(&self, part: u32) -> Vec<Thing> {
        let is_of = |&(_, shape): &&(Thing, Shape)| {
            let reach = shape.round_m + self.square_m * (SQUARES_A_RADIUS * WALL_SHARE + 2.0);
            let around = Vec2::new(reach, reach);
            let ((left, low), (right, high)) =
                (self.square(shape.min - around), self.square(shape.max + around));
            (low.max(0)..=high.min(self.rows - 1)).any(|row| {
                (left.max(0)..=right.min(self.columns - 1))
                    .any(|column| self.part_of[(row * self.columns + column) as usize] == part)
            })
        };
        self.shapes.iter().filter(is_of).map(|&(thing, _)| thing).collect()
    }
}

/// Distance of a place from the straight line between `from` and `to`, metres.
fn off_line(place: Vec2, from: Vec2, to: Vec2) -> f64 {
    let along = to - from;
    let share = (place - from).dot(along) / along.length_squared().max(1e-12);
    from.lerp(to, share.clamp(0.0, 1.0)).distance(place)
}
