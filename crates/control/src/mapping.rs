//! Which robot shows which pixel, as far as this is kept from plan to plan and from run to run.

use lightbots_base::{RobotId, Vec2};
use lightbots_plan::{Bindings, BoundFrame, Claims};
use lightbots_show::{Frame, Identity, Pixel};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Bindings of pixel ids to robots, which outlive a plan.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Mapping {
    /// Pixels that the operator bound to robots.
    pub pins: BTreeMap<u32, RobotId>,
    /// Which robot last showed a pixel in frames with fixed identity. In later frames with fixed identity that robot
    /// shows the pixel again, if it takes part.
    #[serde(with = "claims")]
    pub owners: Claims<RobotId>,
    /// Which robot was last to show a pixel in the planned frames of this run, whether with fixed identity or not. A
    /// frame with fixed identity keeps these robots on their pixels.
    #[serde(with = "claims")]
    pub shown: Claims<RobotId>,
}

/// Serialises claims as pairs of pixel and robot, the oldest claim first.
mod claims {
    use lightbots_base::RobotId;
    use lightbots_plan::Claims;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(claims: &Claims<RobotId>, serializer: S) -> Result<S::Ok, S::Error> {
        claims.oldest_first().serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Claims<RobotId>, D::Error> {
        let mut claims = Claims::default();
        for (pixel, robot) in Vec::<(u32, RobotId)>::deserialize(deserializer)? {
            claims.show(pixel, robot);
        }
        Ok(claims)
    }
}

impl Mapping {
    /// Forgets which robots showed pixels, because pixels of another show are others. Pins stay.
    pub fn forget_show(&mut self) {
        self.owners.clear();
        self.shown.clear();
    }

    /// Removes all bindings of a robot.
    pub fn forget(&mut self, id: RobotId) {
        self.pins.retain(|_, robot| *robot != id);
        self.owners.forget(id);
        self.shown.forget(id);
    }
}

/// The mapping while a plan is made. Here robots are indices into a list of names.
#[derive(Clone, Debug, Default)]
pub(crate) struct Roles {
    /// Names of the robots, by index.
    names: Vec<RobotId>,
    pub mapping: Mapping,
    bindings: Bindings,
}

impl Roles {
    pub fn new(names: Vec<RobotId>, mapping: Mapping) -> Self {
        let index_of: BTreeMap<RobotId, usize> =
            names.iter().enumerate().map(|(index, &id)| (id, index)).collect();
        let mut claims = Claims::default();
        for (pixel, robot) in [mapping.owners.oldest_first(), mapping.shown.oldest_first()].concat() {
            if let Some(&robot) = index_of.get(&robot) {
                claims.show(pixel, robot);
            }
        }
        let bindings = Bindings {
            by_name: index_of.iter().map(|(id, &robot)| (id.to_string(), robot)).collect(),
            names_known: true,
            pins: mapping.pins.iter().map(|(&pixel, id)| (pixel, index_of.get(id).copied())).collect(),
            claims,
        };
        Self { names, mapping, bindings }
    }

    /// Binds the pixels of a frame to robots. `places[robot]`: where the robot stands, stage metres. Pixels for which
    /// `blocked` returns `true` stay dark.
    pub fn bind<'a>(
        &self,
        frame: &'a Frame,
        identity: Identity,
        places: &[Vec2],
        blocked: impl Fn(&Pixel) -> bool,
    ) -> BoundFrame<'a> {
        self.bindings.bind(&frame.pixels, identity, places, blocked)
    }

    /// Notes which robot shows which pixel. `goal_of[robot]`: index into `bound.pixels`; `None` if the robot shows
    /// none.
    pub fn remember(&mut self, bound: &BoundFrame<'_>, identity: Identity, goal_of: &[Option<usize>]) {
        self.bindings.remember(bound, goal_of);
        for (&name, goal) in self.names.iter().zip(goal_of) {
            let Some(pixel) = goal.and_then(|goal| bound.pixels.get(goal)) else { continue };
            self.mapping.shown.show(pixel.id, name);
            if identity == Identity::Fixed {
                self.mapping.owners.show(pixel.id, name);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn frame(ids: &[u32]) -> Frame {
        let pixel = |&id| Pixel { id, at: Vec2::ZERO, color: Rgb::BLACK, ..Pixel::default() };
        Frame {
            name: String::new(),
            air_time_s: 0.0,
            transition_s: None,
            easing: Default::default(),
            pixels: ids.iter().map(pixel).collect(),
            ..Frame::default()
        }
    }

    fn id(name: &str) -> RobotId {
        RobotId::new(name).unwrap()
    }

    const PLACES: [Vec2; 3] = [Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0), Vec2::new(0.0, 0.0)];

    fn roles(mapping: Mapping) -> Roles {
        Roles::new(vec![id("a"), id("b"), id("c")], mapping)
    }

    #[test]
    fn with_fixed_identity_a_pixel_keeps_its_robot_in_later_runs_too() {
        let mut roles = roles(Mapping::default());
        let frame = frame(&[0, 1, 2]);
        let bound = roles.bind(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(bound.pinned, [None; 3], "the nearest robot shows it");
        roles.remember(&bound, Identity::Fixed, &[Some(2), Some(0), Some(1)]);
        let mut mapping = roles.mapping.clone();
        mapping.shown.clear();
        let again = self::roles(mapping).bind(&frame, Identity::Fixed, &PLACES, |_| false).pinned;
        assert_eq!(again, [Some(1), Some(2), Some(0)]);
        roles.mapping.forget(id("c"));
        let without = Roles::new(vec![id("b"), id("a")], roles.mapping);
        let bound = without.bind(&frame, Identity::Fixed, &PLACES[..2], |_| false);
        assert_eq!((bound.pinned, bound.dark), (vec![Some(0), Some(1)], vec![1]));
    }

    #[test]
    fn a_fixed_frame_among_others_keeps_the_robots_of_its_pixels() {
        let mut roles = roles(Mapping::default());
        let frame = frame(&[0, 1, 2]);
        let any = roles.bind(&frame, Identity::Any, &PLACES, |_| false);
        assert_eq!(any.pinned, [None; 3]);
        roles.remember(&any, Identity::Any, &[Some(2), Some(0), Some(1)]);
        let fixed = roles.bind(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(fixed.pinned, [Some(1), Some(2), Some(0)]);
        roles.remember(&any, Identity::Any, &[Some(0), Some(1), Some(2)]);
        let again = roles.bind(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(again.pinned, [Some(0), Some(1), Some(2)]);
        // A pixel that lost its robot gets one that is left.
        let without = Roles::new(vec![id("d"), id("b"), id("c")], roles.mapping);
        let bound = without.bind(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(bound.pinned, [None, Some(1), Some(2)]);
        assert_eq!(bound.dark, []);
    }

    #[test]
    fn a_pinned_pixel_whose_robot_is_away_stays_dark() {
        let mut mapping = Mapping::default();
        mapping.pins.insert(1, id("x"));
        let frame = frame(&[0, 1]);
        for identity in [Identity::Any, Identity::Fixed] {
            let roles = roles(mapping.clone());
            let bound = roles.bind(&frame, identity, &PLACES, |_| false);
            assert_eq!((bound.pixels.len(), bound.dark), (1, vec![1]));
        }
    }

    #[test]
    fn with_too_few_robots_the_last_unbound_pixels_stay_dark() {
        let mut mapping = Mapping::default();
        mapping.pins.insert(4, id("b"));
        let frame = frame(&[0, 1, 2, 3, 4]);
        for identity in [Identity::Any, Identity::Fixed] {
            let roles = roles(mapping.clone());
            let bound = roles.bind(&frame, identity, &PLACES, |_| false);
            assert_eq!(bound.dark, [2, 3]);
            assert_eq!(bound.pinned, [None, None, Some(1)]);
        }
    }
}
