//! Straight lines and paths for one robot while all other robots stand still. They are collision-free at any speed,
//! because nothing else moves.

use lightbots_base::shape::{point_to_segment, segment_to_segment};
use lightbots_base::{Limits, Vec2};
use lightbots_show::Obstacle;
use std::collections::VecDeque;

/// Clearance of a robot without a common clock from others, metres. Its line is not quite straight, and the place where
/// it stops is known to some millimetres only.
const MARGIN_M: f64 = 0.02;
/// Side of a grid cell in the usual search for a path, metres.
pub(super) const CELL_M: f64 = 0.04;
/// Longest straight line from the start of a path to the first grid cell, metres.
const NEAR_M: f64 = 0.16;
/// Most cells of the grid; on floors with more cells, no path is searched.
const CELLS_MAX: usize = 1_000_000;

/// The floor on which one robot moves while all other robots stand still.
#[derive(Clone, Copy, Debug)]
pub struct FreeSpace<'a> {
    /// Half the floor's width and depth, metres.
    pub half_floor: Vec2,
    /// No-go areas, stage metres.
    pub obstacles: &'a [Obstacle],
    /// Radius of a robot, metres.
    pub radius_m: f64,
    /// Distance that centres of robots and discs keep, metres. If a line starts or ends closer to a disc, it only has
    /// to keep that smaller distance.
    pub gap_m: f64,
    /// Side of a cell of the search grid, metres.
    pub cell_m: f64,
}

impl<'a> FreeSpace<'a> {
    /// The floor of robots without a common clock, with the usual gap and grid.
    pub fn new(half_floor: Vec2, obstacles: &'a [Obstacle], limits: &Limits) -> Self {
        let gap_m = limits.contact_m() + MARGIN_M;
        Self { half_floor, obstacles, radius_m: limits.radius_m, gap_m, cell_m: CELL_M }
    }

    /// Whether the line `a`–`b` keeps the gap to a disc at `p`. If `a` or `b` is closer to `p` than the gap, the line
    /// only has to keep that smaller distance. The end `b` must be at least two radii of a robot from `p` in any case.
    pub fn clears_disc(&self, a: Vec2, b: Vec2, p: Vec2) -> bool {
        let needed = self.gap_m.min(a.distance(p)).min(b.distance(p));
        point_to_segment(p, a, b) >= needed - 1e-9 && b.distance(p) >= 2.0 * self.radius_m
    }

    /// Whether a robot that drives along the line `a`–`b` touches no obstacle.
    pub fn clears_obstacles(&self, a: Vec2, b: Vec2) -> bool {
        self.obstacles.iter().all(|obstacle| match *obstacle {
            Obstacle::Disc { at, radius_m } => point_to_segment(at, a, b) >= radius_m + self.radius_m,
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

    /// Whether the line `a`–`b` keeps clear of all `discs`, as [`Self::clears_disc`], and of the obstacles. The floor's
    /// edge is not checked.
    pub fn is_clear(&self, a: Vec2, b: Vec2, discs: &[Vec2]) -> bool {
        discs.iter().all(|&disc| self.clears_disc(a, b, disc)) && self.clears_obstacles(a, b)
    }

    /// Returns waypoints of a path from `from` to `to` around all discs and obstacles, without `from`. `None` if the
    /// search over the grid finds no path.
    pub fn path(&self, from: Vec2, to: Vec2, discs: &[Vec2]) -> Option<Vec<Vec2>> {
        let came_from = self.search(from, discs, |place| self.is_clear(place, to, discs))?;
        let mut places = vec![to];
        places.extend(came_from);
        places.push(from);
        places.reverse();
        let mut path = Vec::new();
        let mut here = 0;
        while here + 1 < places.len() {
            let next = (here + 1..places.len())
                .rev()
                .find(|&next| self.is_clear(places[here], places[next], discs))
                .unwrap_or(here + 1);
            path.push(places[next]);
            here = next;
        }
        Some(path)
    }

    /// Returns waypoints of a path from `from` to a free place nearby, without `from`. A free place is at least
    /// `room_m` metres from all `discs`, from all places of `keep_free`, and from `from`. `None` if the search over the
    /// grid finds no path.
    pub fn path_aside(
        &self,
        from: Vec2,
        discs: &[Vec2],
        keep_free: &[Vec2],
        room_m: f64,
    ) -> Option<Vec<Vec2>> {
        let free = |place: Vec2| {
            discs.iter().chain(keep_free).all(|other| other.distance(place) >= room_m)
                && from.distance(place) >= room_m
        };
        let back = self.search(from, discs, free)?;
        self.path(from, *back.first()?, discs)
    }

    /// Searches the grid breadth first from `from` for a cell, few steps away, at the place of which `wanted` holds.
    /// Returns the places of the path to that cell in reverse order, without `from`; empty if `wanted` holds at `from`.
    /// `None` if there is none, or the floor has more cells than [`CELLS_MAX`].
    fn search(&self, from: Vec2, discs: &[Vec2], wanted: impl Fn(Vec2) -> bool) -> Option<Vec<Vec2>> {
        if wanted(from) {
            return Some(Vec::new());
        }
        let room = self.half_floor - Vec2::new(self.radius_m, self.radius_m);
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

    /// Returns `[cell]`: whether a robot must not stand there, because of an obstacle or one of `discs`.
    fn blocked(&self, columns: usize, rows: usize, room: Vec2, discs: &[Vec2]) -> Vec<bool> {
        let place = |cell: usize| {
            Vec2::new(
                (cell % columns) as f64 * self.cell_m - room.x,
                (cell / columns) as f64 * self.cell_m - room.y,
            )
        };
        let mut blocked: Vec<bool> =
            (0..columns * rows).map(|cell| !self.clears_obstacles(place(cell), place(cell))).collect();
        // The hypotenuse of the gap and half a cell: steps between two free cells then keep the gap too.
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

    const FLOOR: FreeSpace<'static> = FreeSpace {
        half_floor: Vec2::new(1.5, 1.5),
        obstacles: &[],
        radius_m: 0.027,
        gap_m: 0.084,
        cell_m: CELL_M,
    };

    #[test]
    fn a_path_leads_round_a_wall_of_discs() {
        let wall: Vec<Vec2> = (0..20).map(|i| Vec2::new(0.0, f64::from(i) * 0.1 - 1.0)).collect();
        let (from, to) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
        assert!(!FLOOR.is_clear(from, to, &wall));
        let path = FLOOR.path(from, to, &wall).unwrap();
        let mut here = from;
        for &next in &path {
            assert!(FLOOR.is_clear(here, next, &wall), "{here:?} {next:?}");
            here = next;
        }
        assert_eq!(here, to);
        assert!(path.len() < 8, "{path:?}");
    }

    #[test]
    fn where_all_is_closed_there_is_no_path() {
        let ring: Vec<Vec2> = (0..24).map(|i| Vec2::unit(f64::from(i) * 0.2618) * 0.3).collect();
        assert!(FLOOR.path(Vec2::ZERO, Vec2::new(1.0, 0.0), &ring).is_none());
    }

    #[test]
    fn obstacles_are_gone_round() {
        let obstacles = [Obstacle::Rect { min: Vec2::new(-0.1, -1.0), max: Vec2::new(0.1, 1.0) }];
        let floor = FreeSpace { obstacles: &obstacles, ..FLOOR };
        assert!(!floor.clears_obstacles(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)));
        assert!(floor.path(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), &[]).is_some());
    }

    #[test]
    fn a_place_aside_keeps_goals_free() {
        let discs = [Vec2::new(0.1, 0.0)];
        let goals = [Vec2::new(-0.1, 0.0)];
        let path = FLOOR.path_aside(Vec2::ZERO, &discs, &goals, FLOOR.gap_m).unwrap();
        let place = *path.last().unwrap();
        assert!(place.distance(discs[0]) >= 0.084 && place.distance(goals[0]) >= 0.084);
    }
}
