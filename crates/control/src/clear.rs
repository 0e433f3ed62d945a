//! Straight ways for robots whose speed nobody knows: clear of everything at any speed, or round it by way-points.

use lightbots_base::Vec2;
use lightbots_show::Obstacle;
use std::collections::VecDeque;

/// Side of a cell of the grid on which ways round are looked for first, metres.
pub(crate) const CELL_M: f64 = 0.04;
/// A way round begins with a straight line no longer than this, metres.
const NEAR_M: f64 = 0.16;
/// The most cells of that grid.
const CELLS_MAX: usize = 1_000_000;

/// The floor on which one robot wants to move while others stand.
pub(crate) struct Floor<'a> {
    /// Half width and depth, metres.
    pub half: Vec2,
    pub obstacles: &'a [Obstacle],
    /// A robot's radius, metres.
    pub radius_m: f64,
    /// Distance of centres that is kept where starts and goals allow it, metres.
    pub gap_m: f64,
    /// Side of a cell of the grid on which ways round are looked for, metres.
    pub cell_m: f64,
}

/// How close the segment `a`–`b` comes to `p`.
pub(crate) fn segment_to_point(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    squared_to_point(a, b, p).sqrt()
}

fn squared_to_point(a: Vec2, b: Vec2, p: Vec2) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((p - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (a + along * share - p).length_squared()
}

/// How close two segments come.
pub(crate) fn segment_to_segment(a: (Vec2, Vec2), b: (Vec2, Vec2)) -> f64 {
    let side = |s: (Vec2, Vec2), p: Vec2| (s.1 - s.0).cross(p - s.0);
    let crosses = side(a, b.0) * side(a, b.1) < 0.0 && side(b, a.0) * side(b, a.1) < 0.0;
    if crosses {
        return 0.0;
    }
    squared_to_point(a.0, a.1, b.0)
        .min(squared_to_point(a.0, a.1, b.1))
        .min(squared_to_point(b.0, b.1, a.0))
        .min(squared_to_point(b.0, b.1, a.1))
        .sqrt()
}

impl Floor<'_> {
    /// Whether the straight way `a`–`b` passes a disc at `p`: never closer than the gap or than its own ends are.
    pub fn passes(&self, a: Vec2, b: Vec2, p: Vec2) -> bool {
        let needed = self.gap_m.min(a.distance(p)).min(b.distance(p));
        segment_to_point(a, b, p) >= needed - 1e-9 && b.distance(p) >= 2.0 * self.radius_m
    }

    /// Whether the straight way `a`–`b` stays clear of the obstacles.
    pub fn passes_obstacles(&self, a: Vec2, b: Vec2) -> bool {
        self.obstacles.iter().all(|obstacle| match *obstacle {
            Obstacle::Disc { at, radius_m } => segment_to_point(a, b, at) >= radius_m + self.radius_m,
            Obstacle::Rect { min, max } => {
                let corners = [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)];
                let inside = |p: Vec2| p.x > min.x && p.x < max.x && p.y > min.y && p.y < max.y;
                let sides = (0..4).map(|side| (corners[side], corners[(side + 1) % 4]));
                !inside(a)
                    && !inside(b)
                    && sides.into_iter().all(|side| segment_to_segment((a, b), side) >= self.radius_m)
            }
        })
    }

    /// Whether the straight way is clear of discs and obstacles.
    pub fn is_clear(&self, a: Vec2, b: Vec2, discs: &[Vec2]) -> bool {
        discs.iter().all(|&disc| self.passes(a, b, disc)) && self.passes_obstacles(a, b)
    }

    /// Way-points from `from` to `to`, `to` included, round all discs and obstacles; `None`: there is no way.
    pub fn way(&self, from: Vec2, to: Vec2, discs: &[Vec2]) -> Option<Vec<Vec2>> {
        let came_from = self.search(from, discs, |place| self.is_clear(place, to, discs))?;
        let mut places = vec![to];
        places.extend(came_from);
        places.push(from);
        places.reverse();
        let mut way = Vec::new();
        let mut here = 0;
        while here + 1 < places.len() {
            let next = (here + 1..places.len())
                .rev()
                .find(|&next| self.is_clear(places[here], places[next], discs))
                .unwrap_or(here + 1);
            way.push(places[next]);
            here = next;
        }
        Some(way)
    }

    /// A place to step aside to, `room_m` from all discs and from `keep_free`, and the way there.
    pub fn aside(&self, from: Vec2, discs: &[Vec2], keep_free: &[Vec2], room_m: f64) -> Option<Vec<Vec2>> {
        let free = |place: Vec2| {
            discs.iter().chain(keep_free).all(|other| other.distance(place) >= room_m)
                && from.distance(place) >= room_m
        };
        let back = self.search(from, discs, free)?;
        self.way(from, *back.first()?, discs)
    }

    /// Breadth first over the grid from `from` to the nearest place that is `wanted`; the places on the way, last
    /// one first, without `from`.
    fn search(&self, from: Vec2, discs: &[Vec2], wanted: impl Fn(Vec2) -> bool) -> Option<Vec<Vec2>> {
        if wanted(from) {
            return Some(Vec::new());
        }
        let room = self.half - Vec2::new(self.radius_m, self.radius_m);
        let columns = (2.0 * room.x / self.cell_m).max(0.0) as usize + 1;
        let rows = (2.0 * room.y / self.cell_m).max(0.0) as usize + 1;
        if columns.saturating_mul(rows) > CELLS_MAX {
            return None;
        }
        let place = |cell: usize| {
            Vec2::new(
                (cell % columns) as f64 * self.cell_m - room.x,
                (cell / columns) as f64 * self.cell_m - room.y,
            )
        };
        let blocked = self.blocked(columns, rows, room, discs);
        let near = |cell: &usize| place(*cell).distance(from) <= NEAR_M;
        let mut parent = vec![usize::MAX; columns * rows];
        let mut queue: VecDeque<usize> = (0..columns * rows)
            .filter(near)
            .filter(|&cell| !blocked[cell] && self.is_clear(from, place(cell), discs))
            .collect();
        queue.iter().for_each(|&cell| parent[cell] = cell);
        while let Some(cell) = queue.pop_front() {
            if wanted(place(cell)) {
                return Some(trace(&parent, cell).into_iter().map(place).collect());
            }
            let (column, row) = (cell % columns, cell / columns);
            let neighbours = [
                (column > 0).then(|| cell - 1),
                (column + 1 < columns).then_some(cell + 1),
                (row > 0).then(|| cell - columns),
                (row + 1 < rows).then_some(cell + columns),
            ];
            for next in neighbours.into_iter().flatten() {
                if parent[next] == usize::MAX && !blocked[next] {
                    parent[next] = cell;
                    queue.push_back(next);
                }
            }
        }
        None
    }

    /// `[cell]`: whether a robot must not stand there.
    fn blocked(&self, columns: usize, rows: usize, room: Vec2, discs: &[Vec2]) -> Vec<bool> {
        let place = |cell: usize| {
            Vec2::new(
                (cell % columns) as f64 * self.cell_m - room.x,
                (cell / columns) as f64 * self.cell_m - room.y,
            )
        };
        let mut blocked: Vec<bool> =
            (0..columns * rows).map(|cell| !self.passes_obstacles(place(cell), place(cell))).collect();
        // So much more than the gap that steps between two free cells pass too.
        let free_m = self.gap_m.hypot(self.cell_m / 2.0);
        let reach = (free_m / self.cell_m) as i64 + 1;
        for &disc in discs {
            let column = ((disc.x + room.x) / self.cell_m) as i64;
            let row = ((disc.y + room.y) / self.cell_m) as i64;
            for y in (row - reach).max(0)..=(row + reach + 1).min(rows as i64 - 1) {
                for x in (column - reach).max(0)..=(column + reach + 1).min(columns as i64 - 1) {
                    let cell = y as usize * columns + x as usize;
                    blocked[cell] |= place(cell).distance(disc) < free_m;
                }
            }
        }
        blocked
    }
}

fn trace(parent: &[usize], mut cell: usize) -> Vec<usize> {
    let mut cells = vec![cell];
    while parent[cell] != cell {
        cell = parent[cell];
        cells.push(cell);
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Floor<'static> =
        Floor { half: Vec2::new(1.5, 1.5), obstacles: &[], radius_m: 0.027, gap_m: 0.084, cell_m: CELL_M };

    #[test]
    fn a_way_leads_round_a_wall_of_discs() {
        let wall: Vec<Vec2> = (0..20).map(|i| Vec2::new(0.0, f64::from(i) * 0.1 - 1.0)).collect();
        let (from, to) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
        assert!(!FLOOR.is_clear(from, to, &wall));
        let way = FLOOR.way(from, to, &wall).unwrap();
        let mut here = from;
        for &next in &way {
            assert!(FLOOR.is_clear(here, next, &wall), "{here:?} {next:?}");
            here = next;
        }
        assert_eq!(here, to);
        assert!(way.len() < 8, "{way:?}");
    }

    #[test]
    fn without_a_way_there_is_none() {
        let ring: Vec<Vec2> = (0..24).map(|i| Vec2::unit(f64::from(i) * 0.2618) * 0.3).collect();
        assert!(FLOOR.way(Vec2::ZERO, Vec2::new(1.0, 0.0), &ring).is_none());
    }

    #[test]
    fn obstacles_are_gone_round() {
        let obstacles = [Obstacle::Rect { min: Vec2::new(-0.1, -1.0), max: Vec2::new(0.1, 1.0) }];
        let floor = Floor { obstacles: &obstacles, ..FLOOR };
        assert!(!floor.passes_obstacles(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)));
        assert!(floor.way(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), &[]).is_some());
    }

    #[test]
    fn a_place_aside_keeps_goals_free() {
        let discs = [Vec2::new(0.1, 0.0)];
        let goals = [Vec2::new(-0.1, 0.0)];
        let way = FLOOR.aside(Vec2::ZERO, &discs, &goals, FLOOR.gap_m).unwrap();
        let place = *way.last().unwrap();
        assert!(place.distance(discs[0]) >= 0.084 && place.distance(goals[0]) >= 0.084);
    }
}
