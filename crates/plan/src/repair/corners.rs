//! Ways past the corners of walls, for gaps that a lattice does not fit through: the shortest way leads from corner to
//! corner along lines that are free (a visibility graph; Lozano-Pérez and Wesley 1979).

use lightbots_base::Vec2;
use lightbots_show::Obstacle;

use super::scene::Scene;

/// Ways keep this off walls, metres: hardly more than must be proven.
const MARGIN_M: f64 = 0.00305;
/// Scenes with more walls are not looked at: their corners see each other in too many pairs.
const MOST_WALLS: usize = 24;
/// Corners of the line that leads around a disc.
const DISC_CORNERS: u32 = 8;

/// Places beside the walls' corners, and who sees whom.
pub(super) struct Corners {
    places: Vec<Vec2>,
    /// `[place]`: places that can be driven to straight.
    sees: Vec<Vec<usize>>,
}

impl Corners {
    /// Those of a scene; none where there are too many.
    pub fn new(scene: &Scene) -> Self {
        let off_m = scene.limits.radius_m + MARGIN_M;
        let walls = if scene.walls.len() > MOST_WALLS { &[][..] } else { &scene.walls[..] };
        let mut places: Vec<Vec2> = walls.iter().flat_map(|wall| around(wall, off_m)).collect();
        places.retain(|&place| scene.is_free(place, MARGIN_M - 1e-5));
        let sees = |&from: &Vec2| seen(scene, &places, from);
        let sees = places.iter().map(sees).collect();
        Self { places, sees }
    }

    /// Corners of the shortest way from one place to another; `None` where there is none.
    pub fn way(&self, scene: &Scene, start: Vec2, end: Vec2) -> Option<Vec<Vec2>> {
        let from_end = seen(scene, &self.places, end);
        let mut far_m = vec![f64::INFINITY; self.places.len()];
        let mut before = vec![None; self.places.len()];
        for at in seen(scene, &self.places, start) {
            far_m[at] = start.distance(self.places[at]);
        }
        let mut is_settled = vec![false; self.places.len()];
        // Dijkstra; so few places that the nearest is found by looking at all.
        while let Some(at) = (0..self.places.len())
            .filter(|&at| !is_settled[at] && far_m[at] < f64::INFINITY)
            .min_by(|&a, &b| far_m[a].total_cmp(&far_m[b]))
        {
            is_settled[at] = true;
            for &next in &self.sees[at] {
                let far = far_m[at] + self.places[at].distance(self.places[next]);
                if far < far_m[next] {
                    (far_m[next], before[next]) = (far, Some(at));
                }
            }
        }
        let whole = |at: usize| far_m[at] + self.places[at].distance(end);
        let mut last = from_end.into_iter().min_by(|&a, &b| whole(a).total_cmp(&whole(b)));
        if last.is_none_or(|at| far_m[at] == f64::INFINITY) {
            return None;
        }
        let mut way = vec![end];
        while let Some(at) = last {
            way.push(self.places[at]);
            last = before[at];
        }
        way.push(start);
        way.reverse();
        Some(way)
    }
}

fn seen(scene: &Scene, places: &[Vec2], from: Vec2) -> Vec<usize> {
    (0..places.len()).filter(|&at| scene.is_way_free(from, places[at], MARGIN_M - 1e-5)).collect()
}

/// Corners of a line that keeps `off_m` off a wall.
fn around(wall: &Obstacle, off_m: f64) -> Vec<Vec2> {
    match *wall {
        Obstacle::Disc { at, radius_m } => {
            let angle = core::f64::consts::TAU / f64::from(DISC_CORNERS);
            let reach = (radius_m + off_m) / (angle / 2.0).cos();
            (0..DISC_CORNERS).map(|corner| at + Vec2::unit(angle * f64::from(corner)) * reach).collect()
        }
        Obstacle::Rect { min, max } => {
            let (xs, ys) = ([min.x - off_m, max.x + off_m], [min.y - off_m, max.y + off_m]);
            xs.into_iter().flat_map(|x| ys.map(|y| Vec2::new(x, y))).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use lightbots_base::Limits;

    fn scene(gap_m: f64) -> Scene {
        let wall = |min: (f64, f64), max: (f64, f64)| Obstacle::Rect {
            min: Vec2::new(min.0, min.1),
            max: Vec2::new(max.0, max.1),
        };
        let problem = TransitionProblem {
            obstacles: vec![wall((-0.2, 0.1 + gap_m), (0.2, 0.5)), wall((-0.2, -0.5), (0.2, 0.1))],
            ..TransitionProblem::on_floor(Vec2::new(0.5, 0.5), Limits::ELISA_3)
        };
        Scene::new(&problem, &[]).unwrap()
    }

    #[test]
    fn a_gap_that_just_lets_a_robot_through_is_found() {
        let (start, end) = (Vec2::new(-0.4, -0.4), Vec2::new(0.4, -0.4));
        let just = scene(0.0602);
        let way = Corners::new(&just).way(&just, start, end).unwrap();
        assert_eq!((way[0], way[way.len() - 1]), (start, end));
        assert!(way.windows(2).all(|leg| just.is_way_free(leg[0], leg[1], 0.003)), "{way:?}");
        let closed = scene(0.0598);
        assert_eq!(Corners::new(&closed).way(&closed, start, end), None);
    }
}
