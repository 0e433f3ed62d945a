//! Checks that no route leads through a robot that dropped out. Contacts alone do not show this, because other robots
//! brake for the dropped-out robot as for any obstacle.

use lightbots_base::{Instant, Span, Vec2};

use crate::robot_set::RobotSet;

/// Time that a dropped-out robot must have stood still before a route through it is reported. Until then, all robots
/// are held (within 0.6 s) and planned again. A robot that receives nothing stands within 2.2 s (R43).
const AROUND_AFTER: Span = Span::from_millis(3_000);
/// A robot that is farther than this from the place where it first stood does not stand still, metres.
const STILL_M: f64 = 0.005;
/// A route leads through a robot if their distance is below this share of the contact distance. It is below 1, because
/// a robot that lost its place stands a few centimetres from where it is expected.
const THROUGH: f64 = 0.5;

/// Robots that dropped out, and routes that lead through them.
#[derive(Debug, Default)]
pub(super) struct RouteWatch {
    /// Robots that dropped out, and the place where each has stood since it last moved.
    out: Vec<Standing>,
    /// Pairs that [`Self::look`] has returned before: a robot with a route, and a robot that is out.
    known: Vec<(usize, usize)>,
}

/// A robot that dropped out and stands.
#[derive(Debug)]
struct Standing {
    robot: usize,
    since: Instant,
    at: Vec2,
}

impl RouteWatch {
    /// Notes that the dropped-out robot `robot` is at the place `at`. Returns since when it has stood there.
    fn stands(&mut self, now: Instant, robot: usize, at: Vec2) -> Instant {
        let place = match self.out.iter().position(|known| known.robot == robot) {
            Some(place) => place,
            None => {
                self.out.push(Standing { robot, since: now, at });
                self.out.len() - 1
            }
        };
        let known = &mut self.out[place];
        if known.at.distance(at) > STILL_M {
            (known.since, known.at) = (now, at);
        }
        known.since
    }

    /// Finds robots whose route is, at this moment, at the place of a robot in `out` that has stood still for
    /// [`AROUND_AFTER`]. Returns each pair once in a run: the robot with the route, and the robot that is out.
    pub fn look(&mut self, now: Instant, robots: &RobotSet, out: &[usize]) -> Vec<(usize, usize)> {
        let (places, contact_m) = (robots.world.places(), robots.world.contacts().contact_m());
        let mut through = Vec::new();
        self.out.retain(|known| out.contains(&known.robot));
        for &standing in out {
            let at = places[standing];
            if now - self.stands(now, standing, at) < AROUND_AFTER {
                continue;
            }
            for robot in (0..robots.len()).filter(|robot| !out.contains(robot)) {
                let is_through =
                    robots.route_place(robot).is_some_and(|place| place.distance(at) < contact_m * THROUGH);
                if is_through && !self.known.contains(&(robot, standing)) {
                    self.known.push((robot, standing));
                    through.push((robot, standing));
                }
            }
        }
        through
    }
}
