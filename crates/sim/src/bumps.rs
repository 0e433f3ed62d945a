//! Contacts of robots with walls and no-go areas: how often robots touch them, and how far robots are pressed against
//! them.

use lightbots_base::Vec2;

use crate::contacts::PARTED_M;
use crate::floor::{Floor, FloorObject};

/// A robot that was pressed over the floor's edge by more than this counts in [`Bumps::over`], metres. Pixels may lie
/// at the edge, and robots that drive along it come 5 mm over it with standard noise. A larger value would overlook
/// robots that leave the floor.
pub const EDGE_SLACK_M: f64 = 0.01;

/// Numbers of contacts with walls and no-go areas. A robot that parted and touches again counts again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bumps {
    /// Touches of the floor's edge.
    pub edges: u64,
    /// Number of contacts with the edge in which the robot was pressed over it by more than [`EDGE_SLACK_M`].
    pub over: u64,
    /// Touches of no-go areas.
    pub obstacles: u64,
    /// Largest distance by which the edge has pushed a robot back during one contact, metres. It is a sum over the
    /// steps of the contact.
    pub edge_most_m: f64,
    fresh: Vec<Bump>,
}

/// A contact of a robot with a wall or a no-go area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// Index of the robot.
    pub robot: usize,
    /// What it touches.
    pub thing: FloorObject,
    /// `true`: in this contact the robot would by now have crossed the floor's edge by more than [`EDGE_SLACK_M`].
    /// `false`: the contact begins.
    pub over: bool,
}

/// What a robot is pressed against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Against {
    thing: FloorObject,
    /// Sum of the distances by which the robot was moved back in each step since the contact began, metres.
    pressed_m: f64,
}

impl Bumps {
    /// What happened in the last step: contacts that began, and contacts in which the robot came over the edge
    /// ([`Bump::over`]).
    pub fn fresh(&self) -> &[Bump] {
        &self.fresh
    }

    /// Discards the contacts of the step before.
    pub(crate) fn begin_step(&mut self) {
        self.fresh.clear();
    }

    /// Updates the contact of a robot whose centre is at `place`, and counts it if it is new. `against`: the robot's
    /// contact before this step. `out_of`: the edge or no-go area that the robot was moved out of in this step, and how
    /// far, in metres. Returns the present contact, `None` if the robot touches nothing.
    pub(crate) fn update(
        &mut self,
        robot: usize,
        against: Option<Against>,
        out_of: Option<(FloorObject, f64)>,
        floor: &Floor,
        place: Vec2,
    ) -> Option<Against> {
        let Some((thing, deep_m)) = out_of else {
            return against.filter(|against| floor.off_m(place, against.thing) < PARTED_M);
        };
        let before = against.filter(|against| against.thing == thing);
        let was_m = before.map_or(0.0, |against| against.pressed_m);
        let pressed_m = was_m + deep_m;
        if before.is_none() {
            match thing {
                FloorObject::Edge => self.edges += 1,
                FloorObject::Obstacle(_) => self.obstacles += 1,
            }
            self.fresh.push(Bump { robot, thing, over: false });
        }
        if thing == FloorObject::Edge {
            self.edge_most_m = self.edge_most_m.max(pressed_m);
            if was_m <= EDGE_SLACK_M && pressed_m > EDGE_SLACK_M {
                self.over += 1;
                self.fresh.push(Bump { robot, thing, over: true });
            }
        }
        Some(Against { thing, pressed_m })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::{Obstacle, Stage};

    /// The only no-go area.
    const AREA: FloorObject = FloorObject::Obstacle(0);

    /// Contacts of a robot that is pressed into things by these depths, metres, and then stands off them by these
    /// distances.
    fn pressed(steps: &[(Option<(FloorObject, f64)>, f64)]) -> (Bumps, Vec<Bump>) {
        let obstacles = vec![Obstacle::Disc { at: Vec2::ZERO, radius_m: 0.1 }];
        let floor = Floor::new(&Stage { obstacles, ..Stage::default() }, &[]);
        let (mut bumps, mut against, mut all) = (Bumps::default(), None, Vec::new());
        for &(out_of, off_m) in steps {
            let place = match against {
                Some(Against { thing: FloorObject::Obstacle(_), .. }) => Vec2::new(0.127 + off_m, 0.0),
                _ => Vec2::new(0.0, 1.473 - off_m),
            };
            bumps.begin_step();
            against = bumps.update(7, against, out_of, &floor, place);
            all.extend_from_slice(bumps.fresh());
        }
        (bumps, all)
    }

    #[test]
    fn one_touch_lasts_until_they_have_parted() {
        let edge = Some((FloorObject::Edge, 0.001));
        let (bumps, all) = pressed(&[(edge, 0.0), (None, 0.0004), (edge, 0.0), (None, 0.0006), (edge, 0.0)]);
        let bump = Bump { robot: 7, thing: FloorObject::Edge, over: false };
        assert_eq!((bumps.edges, bumps.over, bumps.obstacles, all), (2, 0, 0, vec![bump, bump]));
        assert!((bumps.edge_most_m - 0.002).abs() < 1e-12);
    }

    #[test]
    fn a_robot_that_presses_on_goes_over_the_edge_once() {
        let (bumps, all) = pressed(&[(Some((FloorObject::Edge, 0.004)), 0.0); 5]);
        assert_eq!((bumps.edges, bumps.over), (1, 1));
        assert_eq!(all.iter().map(|bump| bump.over).collect::<Vec<_>>(), [false, true]);
        assert!((bumps.edge_most_m - 0.02).abs() < 1e-12);
    }

    #[test]
    fn areas_are_touched_however_lightly() {
        let (bumps, all) = pressed(&[
            (Some((AREA, 1e-6)), 0.0),
            (Some((AREA, 0.1)), 0.0),
            (None, 0.001),
            (Some((AREA, 0.1)), 0.0),
        ]);
        assert_eq!((bumps.edges, bumps.over, bumps.obstacles, all.len()), (0, 0, 2, 2));
        assert!(all.iter().all(|bump| bump.thing == AREA && !bump.over) && bumps.edge_most_m == 0.0);
    }
}
