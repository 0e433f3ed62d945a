//! The planned neighbours that should be in sight of the proximity sensors now, by the route under way.

use lightbots_base::Vec2;

use super::{Routes, turned_by};
use crate::drive::BodyPose;
use crate::reflex::{Expectation, Point};
use crate::storage::RouteStorage;

/// Largest number of neighbours that are expected in sight at once. With a smaller value, the safety layer takes
/// planned neighbours in a dense picture for strangers. A larger value costs time in each step. A route can name more:
/// it may list dozens of places at which a silent robot may stand.
pub(crate) const MAX_IN_SIGHT: usize = 12;
/// The neighbours expected in sight.
pub(crate) type InSight = heapless::Vec<Expectation, MAX_IN_SIGHT>;

impl Routes {
    /// Appends to `expected` the planned neighbours with a centre within `sight_m` metres of the robot's centre, at the
    /// path time of the latest step. Appends nothing if no route is under way. If there are more than [`MAX_IN_SIGHT`],
    /// standing neighbours that are far away are left out first.
    pub(crate) fn expect(
        &self,
        body: BodyPose,
        sight_m: f64,
        storage: &RouteStorage,
        expected: &mut InSight,
    ) {
        let Some(running) = &self.running else { return };
        let neighbours = &storage.at(running.slot).neighbours;
        let back = Vec2::new(body.facing.x, -body.facing.y);
        let into_body = |vector: Vec2| {
            let turned = turned_by(vector, back);
            Point::new(turned.x as f32, turned.y as f32)
        };
        for (index, neighbour) in neighbours.list.iter().enumerate() {
            let Some(motion) = neighbours.motion(neighbour, running.time) else { continue };
            if motion.position.distance(body.at) > sight_m {
                continue;
            }
            let one = Expectation {
                index: index as u8,
                at: into_body(motion.position - body.at),
                velocity: into_body(motion.velocity * running.rate),
                acceleration: into_body(motion.acceleration * (running.rate * running.rate)),
                clearance_m: f32::from(neighbour.clearance_tenths) * 1e-4,
            };
            if let Err(one) = expected.push(one) {
                take_in(one, expected);
            }
        }
    }

    /// Whether the route under way names all neighbours that may come within `range_m` metres: it lists neighbours, or
    /// its planned clearance is larger than `range_m`. `false` if no route is under way.
    pub(crate) fn tells_neighbours(&self, range_m: f32, storage: &RouteStorage) -> bool {
        self.running.as_ref().is_some_and(|running| {
            let is_alone = running.room_mm.is_some_and(|room_mm| f32::from(room_mm) > 1e3 * range_m);
            is_alone || !storage.at(running.slot).neighbours.list.is_empty()
        })
    }
}

/// Puts the neighbour `one` into the full list `expected`, in place of the farthest standing neighbour of the list. If
/// `one` stands and is not nearer than that neighbour, or if no neighbour of the list stands, `one` is left out.
/// Standing neighbours can also be places where a silent robot may stand, and there may be dozens of these beside a
/// path.
fn take_in(one: Expectation, expected: &mut InSight) {
    let moves = |one: &Expectation| one.velocity != Point::ZERO;
    let far_m = |one: &Expectation| one.at.length();
    let standing = expected.iter_mut().filter(|other| !moves(other));
    let farthest = standing.max_by(|a, b| far_m(a).total_cmp(&far_m(b)));
    if let Some(farthest) = farthest.filter(|farthest| moves(&one) || far_m(&one) < far_m(farthest)) {
        *farthest = one;
    }
}
