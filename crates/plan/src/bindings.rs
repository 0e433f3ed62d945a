//! Bindings of pixels to robots: pins, names and identity. Unbound pixels are assigned by distance in
//! [`crate::transition()`]. Planning of a show and of a run use the same bindings.

use crate::assignment::Choice;
use lightbots_base::Vec2;
use lightbots_show::{Identity, Pixel};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The robot that showed each pixel id last. `R` identifies a robot.
#[derive(Clone, Debug)]
pub struct Claims<R> {
    /// The robot, and the number of claims before this one.
    of: BTreeMap<u32, (R, u64)>,
    told: u64,
}

/// Bindings of pixels to robots, from frame to frame. A robot is its index in a list.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    /// Robots by name.
    pub by_name: BTreeMap<String, usize>,
    /// Whether `by_name` is complete. Otherwise another name means any robot without one.
    pub names_known: bool,
    /// Pixel ids pinned to robots for all frames; `None`: to a robot that is not here.
    pub pins: BTreeMap<u32, Option<usize>>,
    /// The robots that showed pixels, of those that are here.
    pub claims: Claims<usize>,
}

/// The pixels of a frame that are shown, and their bindings.
#[derive(Clone, Debug, Default)]
pub struct BoundFrame<'a> {
    /// Pixels that are shown.
    pub pixels: Vec<&'a Pixel>,
    /// `[pixel]`: the robot bound to it; `None`: any robot.
    pub pinned: Vec<Option<usize>>,
    /// Ids of the pixels that stay dark.
    pub dark: Vec<u32>,
    /// Unexpected results, with the pixel.
    pub issues: Vec<(u32, BindingIssue)>,
}

/// An unexpected result of a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingIssue {
    /// Two pixels ask for one robot: this one stays dark.
    BoundTwice,
    /// The pixel asks for a robot that is not here: it stays dark.
    Unknown,
    /// Identity is fixed, but the robot that showed the pixel must show another: the pixel gets another robot.
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

    /// Pixel ids with their robots, the oldest claim first.
    pub fn oldest_first(&self) -> Vec<(u32, R)> {
        let mut all: Vec<_> = self.of.iter().map(|(&id, &(robot, told))| (told, id, robot)).collect();
        all.sort_unstable_by_key(|&(told, ..)| told);
        all.into_iter().map(|(_, id, robot)| (id, robot)).collect()
    }

    /// Forgets all claims.
    pub fn clear(&mut self) {
        self.of.clear();
    }

    /// Forgets a robot.
    pub fn forget(&mut self, robot: R) {
        self.of.retain(|_, (of, _)| *of != robot);
    }
}

impl Bindings {
    /// Binds a frame for robots at `places`, stage metres. A pixel gets the robot it asks for or is pinned to; with
    /// fixed identity, the robot that showed it last. Pixels that stay dark, and those without a robot, are not shown.
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

    /// Remembers the robot of each pixel; `goal_of[robot]` is an index into the frame's pixels.
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

/// A pixel of a frame while it is bound.
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

/// A frame while it is bound.
struct Binder<'a, 'b> {
    bindings: &'b Bindings,
    places: &'b [Vec2],
    roles: Vec<Role<'a>>,
    /// `[robot]`: whether it has a pixel.
    taken: Vec<bool>,
    issues: Vec<(u32, BindingIssue)>,
}

impl<'a> Binder<'a, '_> {
    /// Gives a pixel to a robot, unless the robot has one.
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

    /// Binds pixels that ask for robots by name, then pinned pixels.
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

    /// Pixels that ask for a name without a robot.
    fn nameless(&self) -> Vec<usize> {
        let asks = |&role: &usize| self.roles[role].is_open() && self.roles[role].pixel.robot.is_some();
        (0..self.roles.len()).filter(asks).collect()
    }

    /// `[robot]`: whether it has a name.
    fn named(&self) -> Vec<bool> {
        let mut named = vec![false; self.taken.len()];
        self.bindings.by_name.values().for_each(|&robot| named[robot] = true);
        named
    }

    /// Gives a name to the robot that showed its pixel last, if that has none.
    fn name_owners(&mut self) {
        let named = self.named();
        for role in self.nameless() {
            if let Some(robot) = self.owner(role).filter(|&robot| !named[robot]) {
                self.give(role, robot);
            }
        }
    }

    /// Gives names without a robot to robots without a name: two names are two robots. Where no robot has a name yet,
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

    /// Pixels stay with the robots that showed them last. A robot that showed another of them later keeps that one.
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
        // Pixels that ask for a robot come before those that do not.
        for asks in [false, true] {
            for role in self.roles.iter_mut().rev() {
                if surplus > 0 && role.is_open() && role.pixel.robot.is_some() == asks {
                    role.is_dark = true;
                    surplus -= 1;
                }
            }
        }
    }

    /// Gives new ids to robots that have shown nothing yet, where there are enough.
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

    /// Assigns pixels to enough robots by least squared distance.
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
