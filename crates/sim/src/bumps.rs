//! Robots against what does not move: how often they touch it, and how hard they press on.

use lightbots_base::Vec2;

use crate::contacts::PARTED_M;
use crate::floor::{Floor, Thing};

/// So far over the floor's edge, metres, is a contact. Pixels may lie right at the edge, and a robot has arrived that is
/// 12.5 mm off its pixel; those that drive along the edge with standard noise come 5 mm over it.
pub const EDGE_SLACK_M: f64 = 0.01;

/// How often robots ran into things that do not move. One that parted and touches again counts again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bumps {
    /// Touches of the floor's edge.
    pub edges: u64,
    /// How many of them pressed on by more than [`EDGE_SLACK_M`].
    pub over: u64,
    /// Touches of no-go areas.
    pub obstacles: u64,
    /// How far robots would have come over the floor's edge at most, metres.
    pub edge_most_m: f64,
    fresh: Vec<Bump>,
}

/// Something that happened between a robot and what does not move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// Which robot.
    pub robot: usize,
    /// What it touches.
    pub thing: Thing,
    /// It has touched the floor's edge for a while, and would be over it by more than [`EDGE_SLACK_M`] now.
    pub over: bool,
}

/// What a robot stands against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Against {
    thing: Thing,
    /// How far it would have gone on since, metres.
    pressed_m: f64,
}

impl Bumps {
    /// What happened in the last step.
    pub fn fresh(&self) -> &[Bump] {
        &self.fresh
    }

    /// Forgets the step before.
    pub(crate) fn begin_step(&mut self) {
        self.fresh.clear();
    }

    /// Takes in that a robot at a place was moved out of a thing it had gone into so far, or of none.
    pub(crate) fn look(
        &mut self,
        robot: usize,
        against: Option<Against>,
        out_of: Option<(Thing, f64)>,
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
                Thing::Edge => self.edges += 1,
                Thing::Obstacle(_) => self.obstacles += 1,
            }
            self.fresh.push(Bump { robot, thing, over: false });
        }
        if thing == Thing::Edge {
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

    const AREA: Thing = Thing::Obstacle(0);

    /// A robot pressed so deep into things, metres, one step after the other, each time so far off them afterwards.
    fn pressed(steps: &[(Option<(Thing, f64)>, f64)]) -> (Bumps, Vec<Bump>) {
        let obstacles = vec![Obstacle::Disc { at: Vec2::ZERO, radius_m: 0.1 }];
        let floor = Floor::new(&Stage { obstacles, ..Stage::default() }, &[]);
        let (mut bumps, mut against, mut all) = (Bumps::default(), None, Vec::new());
        for &(out_of, off_m) in steps {
            let place = match against {
                Some(Against { thing: Thing::Obstacle(_), .. }) => Vec2::new(0.127 + off_m, 0.0),
                _ => Vec2::new(0.0, 1.473 - off_m),
            };
            bumps.begin_step();
            against = bumps.look(7, against, out_of, &floor, place);
            all.extend_from_slice(bumps.fresh());
        }
        (bumps, all)
    }

    #[test]
    fn one_touch_lasts_until_they_have_parted() {
        let edge = Some((Thing::Edge, 0.001));
        let (bumps, all) = pressed(&[(edge, 0.0), (None, 0.0004), (edge, 0.0), (None, 0.0006), (edge, 0.0)]);
        let bump = Bump { robot: 7, thing: Thing::Edge, over: false };
        assert_eq!((bumps.edges, bumps.over, bumps.obstacles, all), (2, 0, 0, vec![bump, bump]));
        assert!((bumps.edge_most_m - 0.002).abs() < 1e-12);
    }

    #[test]
    fn who_presses_on_goes_over_the_edge_once() {
        let (bumps, all) = pressed(&[(Some((Thing::Edge, 0.004)), 0.0); 5]);
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
