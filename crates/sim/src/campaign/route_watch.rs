//! Watches that no route leads through a robot that dropped out: neighbours would brake for it as for anything that stands
//! in their way, so that contacts alone do not tell.

use lightbots_base::{Instant, Span, Vec2};

use crate::robot_set::RobotSet;

/// Routes lead around a robot from this long after it dropped out. All are held within 0.6 s and planned again, and a robot
/// that does not hear of it stops after 2 s (R43).
const AROUND_AFTER: Span = Span::from_millis(3_000);
/// A robot that moved more than this since it was seen first has not stood still, metres.
const STILL_M: f64 = 0.005;
/// Share of the contact distance within which a route leads through a robot: a robot that lost its place stands a few
/// centimetres from where it is expected.
const THROUGH: f64 = 0.5;

/// What was seen of robots that dropped out.
#[derive(Debug, Default)]
pub(super) struct RouteWatch {
    /// Robots that dropped out and where they stood first after that.
    out: Vec<Standing>,
    /// Pairs of a robot with a route and one that is out, which are known.
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
    /// A robot stands after it dropped out, or still does.
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

    /// Routes that lead through robots in `out` at this moment, each pair once: which robot, and through which.
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
