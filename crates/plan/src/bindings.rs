//! Who must show which pixel of a frame: pins, names and identity. Whom nothing binds, [`crate::transition()`] sends
//! where it is nearest. Both who plans a show and who plays it go by this.

use crate::assignment::Choice;
use lightbots_base::Vec2;
use lightbots_show::{Identity, Pixel};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// Who showed each pixel id last. `R` tells robots apart.
#[derive(Clone, Debug)]
pub struct Claims<R> {
    /// The robot, and how many were told of before it.
    of: BTreeMap<u32, (R, u64)>,
    told: u64,
}

/// What binds pixels to robots, from frame to frame. A robot is its place in a list.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    /// The robots that names mean.
    pub by_name: BTreeMap<String, usize>,
    /// Whether nobody bears a name that is not in `by_name`; else it is that of any robot without one.
    pub names_known: bool,
    /// Pixel ids that were bound to robots for all frames; `None`: to one that is not here.
    pub pins: BTreeMap<u32, Option<usize>>,
    /// Who showed what, of the robots that are here.
    pub claims: Claims<usize>,
}

/// The pixels of a frame that will be shown, and who must show them.
#[derive(Clone, Debug, Default)]
pub struct BoundFrame<'a> {
    /// Those that are shown.
    pub pixels: Vec<&'a Pixel>,
    /// `[pixel]`: the robot bound to it; `None`: whoever is near.
    pub pinned: Vec<Option<usize>>,
    /// Ids of the pixels that stay dark.
    pub dark: Vec<u32>,
    /// What people may not expect, and with which pixel.
    pub issues: Vec<(u32, BindingIssue)>,
}

/// What people may not expect of a cast.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingIssue {
    /// The robot that the pixel asks for must show another pixel: it stays dark.
    BoundTwice,
    /// The robot that the pixel asks for is not here: it stays dark.
    Unknown,
    /// The robot that showed the pixel before must show another one: it gets another robot, though identity is fixed.
    Lost,
}

impl<R> Default for Claims<R> {
    fn default() -> Self {
        Self { of: BTreeMap::new(), told: 0 }
    }
}

impl<R: Copy + PartialEq> Claims<R> {
    /// A robot shows a pixel.
    pub fn show(&mut self, id: u32, robot: R) {
        self.of.insert(id, (robot, self.told));
        self.told += 1;
    }

    /// Pixel ids with their robots; who showed its pixel longest ago comes first.
    pub fn oldest_first(&self) -> Vec<(u32, R)> {
        let mut all: Vec<_> = self.of.iter().map(|(&id, &(robot, told))| (told, id, robot)).collect();
        all.sort_unstable_by_key(|&(told, ..)| told);
        all.into_iter().map(|(_, id, robot)| (id, robot)).collect()
    }

    /// Nobody showed anything.
    pub fn clear(&mut self) {
        self.of.clear();
    }

    /// A robot is gone for good.
    pub fn forget(&mut self, robot: R) {
        self.of.retain(|_, (of, _)| *of != robot);
    }
}

impl Bindings {
    /// Casts a frame for robots that stand at `places`, stage metres. A pixel is shown by the robot it asks for, or is
    /// pinned to; where identity is fixed, by who showed it last. Pixels that must stay dark, and those no robot is
    /// left for, are not shown.
    pub fn bind<'a>(
        &self,
        frame: &'a [Pixel],
        identity: Identity,
        places: &[Vec2],
        stays_dark: impl Fn(&Pixel) -> bool,
    ) -> BoundFrame<'a> {
        let mut binder = Binder {
            bindings: self,
            places,
            roles: frame
                .iter()
                .map(|pixel| Role { pixel, is_dark: stays_dark(pixel), robot: None })
                .collect(),
            taken: vec![false; places.len()],
            issues: Vec::new(),
        };
        binder.bind();
        if identity == Identity::Fixed {
            binder.name_owners();
        }
        binder.name_others(identity);
        if identity == Identity::Fixed {
            binder.keep_owners();
        }
        binder.drop_surplus();
        if identity == Identity::Fixed {
            binder.place_newcomers();
        }
        binder.done()
    }

    /// Keeps who shows what; `goal_of[robot]` is an index into the cast's pixels.
    pub fn remember(&mut self, bound: &BoundFrame<'_>, goal_of: &[Option<usize>]) {
        for (robot, goal) in goal_of.iter().enumerate() {
            let Some(pixel) = goal.and_then(|goal| bound.pixels.get(goal)) else { continue };
            self.claims.show(pixel.id, robot);
            if let (false, Some(name)) = (self.names_known, &pixel.robot) {
                self.by_name.entry(name.clone()).or_insert(robot);
            }
        }
    }
}

/// A pixel of a frame that is being cast.
struct Role<'a> {
    pixel: &'a Pixel,
    is_dark: bool,
    robot: Option<usize>,
}

impl Role<'_> {
    fn is_open(&self) -> bool {
        !self.is_dark && self.robot.is_none()
    }
}

/// A frame that is being cast.
struct Binder<'a, 'b> {
    bindings: &'b Bindings,
    places: &'b [Vec2],
    roles: Vec<Role<'a>>,
    /// `[robot]`.
    taken: Vec<bool>,
    issues: Vec<(u32, BindingIssue)>,
}

impl<'a> Binder<'a, '_> {
    /// Gives a pixel to a robot unless that has one.
    fn give(&mut self, role: usize, robot: usize) -> bool {
        let free = self.taken.get(robot) == Some(&false);
        if free {
            self.taken[robot] = true;
            self.roles[role].robot = Some(robot);
        }
        free
    }

    fn leave_dark(&mut self, role: usize, why: BindingIssue) {
        self.roles[role].is_dark = true;
        self.issues.push((self.roles[role].pixel.id, why));
    }

    /// Pixels that ask for robots by name, then those that were pinned to one.
    fn bind(&mut self) {
        for is_name in [true, false] {
            for role in 0..self.roles.len() {
                let Role { pixel, is_dark, .. } = self.roles[role];
                if is_dark || pixel.robot.is_some() != is_name {
                    continue;
                }
                let wanted = match &pixel.robot {
                    Some(name) => match self.bindings.by_name.get(name) {
                        Some(&robot) => Some(robot),
                        None if self.bindings.names_known => None,
                        None => continue,
                    },
                    None => match self.bindings.pins.get(&pixel.id) {
                        Some(&robot) => robot,
                        None => continue,
                    },
                };
                match wanted {
                    Some(robot) if self.give(role, robot) => {}
                    Some(_) => self.leave_dark(role, BindingIssue::BoundTwice),
                    None => self.leave_dark(role, BindingIssue::Unknown),
                }
            }
        }
    }

    /// The robot that showed a pixel last, if it is here.
    fn owner(&self, role: usize) -> Option<usize> {
        self.bindings.claims.of.get(&self.roles[role].pixel.id).map(|&(robot, _)| robot)
    }

    /// Pixels that ask for a name nobody bears yet.
    fn nameless(&self) -> Vec<usize> {
        let asks = |&role: &usize| self.roles[role].is_open() && self.roles[role].pixel.robot.is_some();
        (0..self.roles.len()).filter(asks).collect()
    }

    /// `[robot]`: whether it bears a name.
    fn named(&self) -> Vec<bool> {
        let mut named = vec![false; self.taken.len()];
        self.bindings.by_name.values().for_each(|&robot| named[robot] = true);
        named
    }

    /// Who showed a pixel last bears the name it asks for, if it has none.
    fn name_owners(&mut self) {
        let named = self.named();
        for role in self.nameless() {
            if let Some(robot) = self.owner(role).filter(|&robot| !named[robot]) {
                self.give(role, robot);
            }
        }
    }

    /// Gives names that nobody bears yet to robots without one: two names are two robots. Where nobody bears one yet,
    /// any robots will do. Robots that keep their pixel come last.
    fn name_others(&mut self, identity: Identity) {
        let nameless = self.nameless();
        if nameless.is_empty() {
            return;
        }
        let named = self.named();
        let mut keeps = vec![false; self.taken.len()];
        if identity == Identity::Fixed {
            let keeping =
                |&role: &usize| self.roles[role].is_open() && self.roles[role].pixel.robot.is_none();
            let keeping = (0..self.roles.len()).filter(keeping);
            keeping.filter_map(|role| self.owner(role)).for_each(|robot| keeps[robot] = true);
        }
        let free = |robot: &usize| !self.taken[*robot];
        let others: Vec<usize> = (0..self.taken.len()).filter(free).filter(|&robot| !keeps[robot]).collect();
        let fit: Vec<usize> = others.iter().copied().filter(|&robot| !named[robot]).collect();
        if fit.len() == others.len() && nameless.len() <= fit.len() {
            return;
        }
        if nameless.len() <= fit.len() {
            return self.place(fit, nameless);
        }
        let fit: Vec<usize> = (0..self.taken.len()).filter(free).filter(|&robot| !named[robot]).collect();
        for &role in nameless.iter().skip(fit.len()) {
            self.leave_dark(role, BindingIssue::Unknown);
        }
        self.place(fit, self.nameless());
    }

    /// Pixels stay with who showed them last. Where that robot showed another of them later, it keeps that.
    fn keep_owners(&mut self) {
        let told = |role: usize| {
            let pixel = self.roles[role].pixel;
            self.bindings.claims.of.get(&pixel.id).filter(|_| pixel.robot.is_none()).map(|&(_, told)| told)
        };
        let mut owned: Vec<(u64, usize)> = (0..self.roles.len())
            .filter(|&role| self.roles[role].is_open())
            .filter_map(|role| Some((told(role)?, role)))
            .collect();
        owned.sort_unstable_by_key(|&(told, _)| Reverse(told));
        for (_, role) in owned {
            if let Some(robot) = self.owner(role)
                && !self.give(role, robot)
            {
                self.issues.push((self.roles[role].pixel.id, BindingIssue::Lost));
            }
        }
    }

    /// With fewer robots than pixels, those with the highest ids that nothing binds stay dark.
    fn drop_surplus(&mut self) {
        let open = self.roles.iter().filter(|role| role.is_open()).count();
        let free = self.taken.iter().filter(|&&taken| !taken).count();
        let mut surplus = open.saturating_sub(free);
        // Who asks for a robot goes before those that do not.
        for asks in [false, true] {
            for role in self.roles.iter_mut().rev() {
                if surplus > 0 && role.is_open() && role.pixel.robot.is_some() == asks {
                    role.is_dark = true;
                    surplus -= 1;
                }
            }
        }
    }

    /// Gives ids that have nobody to robots that have shown nothing yet, where there are enough of those.
    fn place_newcomers(&mut self) {
        let mut fresh = vec![true; self.taken.len()];
        self.bindings.claims.of.values().for_each(|&(robot, _)| fresh[robot] = false);
        let free: Vec<usize> = (0..self.taken.len()).filter(|&robot| !self.taken[robot]).collect();
        let fresh: Vec<usize> = free.iter().copied().filter(|&robot| fresh[robot]).collect();
        let open: Vec<usize> = (0..self.roles.len()).filter(|&role| self.roles[role].is_open()).collect();
        if fresh.len() < free.len() && open.len() <= fresh.len() {
            self.place(fresh, open);
        }
    }

    /// Gives pixels to robots, of which there are enough, as near as may be.
    fn place(&mut self, robots: Vec<usize>, roles: Vec<usize>) {
        let from: Vec<Vec2> = robots.iter().map(|&robot| self.places[robot]).collect();
        let to: Vec<Vec2> = roles.iter().map(|&role| self.roles[role].pixel.at).collect();
        let choice = Choice::new(&from, &to, &[]);
        if let Some(start_of) = choice.and_then(|choice| choice.least_squares().solve(0.0)) {
            for (&role, &start) in roles.iter().zip(&start_of) {
                self.give(role, robots[start]);
            }
        }
    }

    fn done(self) -> BoundFrame<'a> {
        let mut bound = BoundFrame { issues: self.issues, ..BoundFrame::default() };
        for role in self.roles {
            if role.is_dark {
                bound.dark.push(role.pixel.id);
            } else {
                bound.pixels.push(role.pixel);
                bound.pinned.push(role.robot);
            }
        }
        bound
    }
}

#[cfg(test)]
#[path = "bindings_tests.rs"]
mod tests;
