//! Which robot shows which pixel: pins, and the fixed identity of shows that ask for it.

use lightbots_base::{RobotId, Vec2};
use lightbots_show::{Frame, Identity, Pixel};
use std::collections::{BTreeMap, BTreeSet};

/// Bindings of pixel ids to robots that outlive a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mapping {
    /// What the operator bound.
    pub pins: BTreeMap<u32, RobotId>,
    /// Who showed a pixel in shows with fixed identity: it stays so.
    pub owners: BTreeMap<u32, RobotId>,
    /// Who shows a pixel last in the frames of this run that are planned, whatever their identity: a frame with fixed
    /// identity goes by that.
    pub shown: BTreeMap<u32, RobotId>,
}

impl Mapping {
    /// Forgets a robot.
    pub fn forget(&mut self, id: RobotId) {
        self.pins.retain(|_, robot| *robot != id);
        self.owners.retain(|_, robot| *robot != id);
        self.shown.retain(|_, robot| *robot != id);
    }
}

/// The bindings while a plan is made: robots are places in a list.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bindings {
    /// `[robot]`.
    pub names: Vec<RobotId>,
    pub mapping: Mapping,
    index_of: BTreeMap<RobotId, usize>,
}

/// The pixels of a frame that will be shown, and who must show them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cast<'a> {
    pub pixels: Vec<&'a Pixel>,
    /// `[pixel]`: the robot bound to it.
    pub pinned: Vec<Option<usize>>,
    /// Ids of the pixels that stay dark.
    pub dark: Vec<u32>,
}

impl Bindings {
    pub fn new(names: Vec<RobotId>, mapping: Mapping) -> Self {
        let index_of = names.iter().enumerate().map(|(index, &id)| (id, index)).collect();
        Self { names, mapping, index_of }
    }

    /// Casts a frame. Where identity is fixed a pixel stays with who showed it last; ids that nobody has shown go to
    /// robots by x, in ascending order, smallest first. Pixels for which `blocked` holds, or without a robot, stay dark.
    pub fn cast<'a>(
        &mut self,
        frame: &'a Frame,
        identity: Identity,
        places: &[Vec2],
        blocked: impl Fn(&Pixel) -> bool,
    ) -> Cast<'a> {
        if identity == Identity::Fixed {
            self.adopt(frame, places);
        }
        let mut cast = Cast::default();
        let mut taken = BTreeSet::new();
        for pixel in &frame.pixels {
            let wanted = self.wanted(pixel, identity);
            let robot = wanted.and_then(|id| self.index_of.get(&id).copied());
            let nobody =
                wanted.is_some() != robot.is_some() || robot.is_some_and(|robot| !taken.insert(robot));
            if nobody || identity == Identity::Fixed && robot.is_none() || blocked(pixel) {
                cast.dark.push(pixel.id);
                if let Some(robot) = robot
                    && !nobody
                {
                    taken.remove(&robot);
                }
                continue;
            }
            cast.pixels.push(pixel);
            cast.pinned.push(robot);
        }
        self.drop_surplus(&mut cast);
        cast
    }

    /// The robot a pixel is bound to, present or not.
    fn wanted(&self, pixel: &Pixel, identity: Identity) -> Option<RobotId> {
        let named = pixel.robot.as_deref().and_then(RobotId::new);
        let owner = || self.owner(pixel.id).filter(|_| identity == Identity::Fixed);
        named.or_else(|| self.mapping.pins.get(&pixel.id).copied()).or_else(owner)
    }

    /// Who showed a pixel before, somebody who is here if possible.
    fn owner(&self, pixel: u32) -> Option<RobotId> {
        let Mapping { shown, owners, .. } = &self.mapping;
        let here = shown.get(&pixel).filter(|robot| self.index_of.contains_key(robot));
        here.or_else(|| owners.get(&pixel)).copied()
    }

    /// Keeps who shows what; `goal_of[robot]` is an index into the cast's pixels.
    pub fn remember(&mut self, cast: &Cast<'_>, goal_of: &[Option<usize>]) {
        for (&name, goal) in self.names.iter().zip(goal_of) {
            if let Some(pixel) = goal.and_then(|goal| cast.pixels.get(goal)) {
                self.mapping.shown.insert(pixel.id, name);
            }
        }
    }

    /// Gives an owner to every pixel of the frame that has none who is here.
    fn adopt(&mut self, frame: &Frame, places: &[Vec2]) {
        let pinned = |pixel: &Pixel| pixel.robot.is_some() || self.mapping.pins.contains_key(&pixel.id);
        let owned = |id: u32| self.owner(id).is_some_and(|robot| self.index_of.contains_key(&robot));
        let needy: Vec<u32> = frame
            .pixels
            .iter()
            .filter(|pixel| !pinned(pixel) && !owned(pixel.id))
            .map(|pixel| pixel.id)
            .collect();
        if needy.is_empty() {
            return;
        }
        let busy: BTreeSet<RobotId> =
            frame.pixels.iter().filter_map(|pixel| self.wanted(pixel, Identity::Fixed)).collect();
        let Mapping { owners, shown, .. } = &self.mapping;
        let owners: BTreeSet<RobotId> = owners.values().chain(shown.values()).copied().collect();
        let mut free: Vec<usize> =
            (0..self.names.len()).filter(|&r| !busy.contains(&self.names[r])).collect();
        // Owners of pixels that this frame does not show come last.
        let owns = |robot: usize| owners.contains(&self.names[robot]);
        free.sort_by(|&a, &b| {
            let by_place = places[a].x.total_cmp(&places[b].x).then(places[a].y.total_cmp(&places[b].y));
            owns(a).cmp(&owns(b)).then(by_place).then(self.names[a].cmp(&self.names[b]))
        });
        for (pixel, robot) in needy.into_iter().zip(free) {
            self.mapping.owners.insert(pixel, self.names[robot]);
        }
    }

    /// With fewer robots than pixels, unbound pixels with the highest ids stay dark.
    fn drop_surplus(&self, cast: &mut Cast<'_>) {
        let mut surplus = cast.pixels.len().saturating_sub(self.names.len());
        let mut kept = cast.pixels.len();
        while surplus > 0 && kept > 0 {
            kept -= 1;
            if cast.pinned[kept].is_none() {
                cast.dark.push(cast.pixels[kept].id);
                cast.pixels.remove(kept);
                cast.pinned.remove(kept);
                surplus -= 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn frame(ids: &[u32]) -> Frame {
        let pixel = |&id| Pixel { id, at: Vec2::ZERO, color: Rgb::BLACK, robot: None };
        Frame {
            name: String::new(),
            air_time_s: 0.0,
            transition_s: None,
            easing: Default::default(),
            identity: None,
            pixels: ids.iter().map(pixel).collect(),
        }
    }

    fn id(name: &str) -> RobotId {
        RobotId::new(name).unwrap()
    }

    const PLACES: [Vec2; 3] = [Vec2::new(0.5, 0.0), Vec2::new(-0.5, 0.0), Vec2::new(0.0, 0.0)];

    fn bindings(mapping: Mapping) -> Bindings {
        Bindings::new(vec![id("a"), id("b"), id("c")], mapping)
    }

    #[test]
    fn fixed_identity_goes_by_x_and_stays() {
        let mut bindings = bindings(Mapping::default());
        let frame = frame(&[0, 1, 2]);
        let cast = bindings.cast(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(cast.pinned, [Some(1), Some(2), Some(0)]);
        let moved = [PLACES[1], PLACES[0], PLACES[2]];
        let again = bindings.cast(&frame, Identity::Fixed, &moved, |_| false);
        assert_eq!(again.pinned, cast.pinned);
    }

    #[test]
    fn a_fixed_frame_among_others_keeps_who_showed_its_pixels() {
        let mut bindings = bindings(Mapping::default());
        let frame = frame(&[0, 1, 2]);
        let any = bindings.cast(&frame, Identity::Any, &PLACES, |_| false);
        assert_eq!(any.pinned, [None; 3]);
        bindings.remember(&any, &[Some(2), Some(0), Some(1)]);
        let fixed = bindings.cast(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(fixed.pinned, [Some(1), Some(2), Some(0)]);
        bindings.remember(&any, &[Some(0), Some(1), Some(2)]);
        let again = bindings.cast(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(again.pinned, [Some(0), Some(1), Some(2)]);
        // Whose robot is gone gets another that shows nothing.
        let mapping = bindings.mapping.clone();
        let mut without = Bindings::new(vec![id("d"), id("b"), id("c")], mapping);
        let cast = without.cast(&frame, Identity::Fixed, &PLACES, |_| false);
        assert_eq!(cast.pinned, [Some(0), Some(1), Some(2)]);
    }

    #[test]
    fn a_pinned_pixel_whose_robot_is_away_stays_dark() {
        let mut mapping = Mapping::default();
        mapping.pins.insert(1, id("x"));
        let frame = frame(&[0, 1]);
        let cast = bindings(mapping).cast(&frame, Identity::Any, &PLACES, |_| false);
        assert_eq!((cast.pixels.len(), cast.dark), (1, vec![1]));
    }

    #[test]
    fn with_too_few_robots_the_last_unbound_pixels_stay_dark() {
        let mut mapping = Mapping::default();
        mapping.pins.insert(4, id("b"));
        let frame = frame(&[0, 1, 2, 3, 4]);
        let cast = bindings(mapping).cast(&frame, Identity::Any, &PLACES, |_| false);
        assert_eq!(cast.dark, [3, 2]);
        assert_eq!(cast.pinned, [None, None, Some(1)]);
    }
}
