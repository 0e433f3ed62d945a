//! Bindings of pixels to robots by pins, names and identity. [`crate::transition()`] assigns unbound pixels by
//! distance. Planning of a show and of a run use the same bindings.

use crate::assignment::Choice;
use lightbots_base::Vec2;
use lightbots_show::{Identity, Pixel};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// For each pixel id, the robot that showed it last. `R` identifies a robot.
#[derive(Clone, Debug)]
pub struct Claims<R> {
    /// By pixel id: the robot, and the number of claims made before this one.
    of: BTreeMap<u32, (R, u64)>,
    told: u64,
}

/// Bindings of pixels to robots, carried from frame to frame. A robot is given by its index in a list.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    /// Robots by name.
    pub by_name: BTreeMap<String, usize>,
    /// Whether `by_name` is complete. If it is not, a name missing from it may be given to any robot that has no name
    /// yet.
    pub names_known: bool,
    /// Pixel ids pinned to robots for all frames; `None` if the robot is not here.
    pub pins: BTreeMap<u32, Option<usize>>,
    /// For each pixel id, the robot that showed it last, if that robot is here.
    pub claims: Claims<usize>,
}

/// The pixels of a frame that are shown, and their bindings.
#[derive(Clone, Debug, Default)]
pub struct BoundFrame<'a> {
    /// Pixels that are shown.
    pub pixels: Vec<&'a Pixel>,
    /// `[pixel]`: the robot bound to it; `None` if any robot may show it.
    pub pinned: Vec<Option<usize>>,
    /// Ids of the pixels that stay dark.
    pub dark: Vec<u32>,
    /// Unexpected results, each with the id of its pixel.
    pub issues: Vec<(u32, BindingIssue)>,
}

/// An unexpected result of a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingIssue {
    /// Two pixels ask for the same robot. The pixel of this issue stays dark.
    BoundTwice,
    /// The pixel asks for a robot that is not here, and stays dark.
    Unknown,
    /// Identity is fixed, but the robot that showed this pixel last must show another pixel. The pixel gets another
    /// robot.
    Lost,
}

impl<R> Default for Claims<R> {
    fn default() -> Self {
        Self { of: BTreeMap::new(), told: 0 }
    }
}

impl<R: Copy + PartialEq> Claims<R> {
    /// Records that a robot shows a pixel.
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
    /// Binds a frame's pixels for robots at `places`, stage metres. A pixel gets the robot that it names or is pinned
    /// to; with fixed identity, also the robot that showed it last. Pixels for which `stays_dark` holds, and those for
    /// which no robot is left, are not shown.
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

    /// Records which robot shows each pixel of `bound`; `goal_of[robot]` is an index into its pixels.
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
    /// `[robot]`: whether a pixel is bound to it.
    taken: Vec<bool>,
    issues: Vec<(u32, BindingIssue)>,
}

impl<'a> Binder<'a, '_> {
    /// Binds a pixel to a robot. Returns `false`, and changes nothing, if the robot has a pixel already or does not
    /// exist.
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

    /// Returns the robot that showed a pixel last, if that robot is here.
    fn owner(&self, role: usize) -> Option<usize> {
        self.bindings.claims.of.get(&self.roles[role].pixel.id).map(|&(robot, _)| robot)
    }

    /// Indices of the open pixels that ask for a name to which no robot belongs yet.
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

    /// Binds pixels that ask for an unknown name to the robots that showed them last, if those robots have no name.
    fn name_owners(&mut self) {
        let named = self.named();
        for role in self.nameless() {
            if let Some(robot) = self.owner(role).filter(|&robot| !named[robot]) {
                self.give(role, robot);
            }
        }
    }

    /// Binds pixels with unknown names to robots without a name, so that two names are always two robots. Robots that
    /// keep a pixel by fixed identity are used only if the others do not suffice. Pixels for which no robot is left
    /// stay dark. If no free robot has a name, nothing is bound: the assignment may choose any.
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

    /// Binds pixels to the robots that showed them last. A robot that has shown several of them keeps the latest.
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

    /// With fewer robots than pixels, leaves unbound pixels dark: those at the end of the frame first.
    fn drop_surplus(&mut self) {
        let open = self.roles.iter().filter(|role| role.is_open()).count();
        let free = self.taken.iter().filter(|&&taken| !taken).count();
        let mut surplus = open.saturating_sub(free);
        // Pixels that ask for a robot by name are kept longer than those that do not.
        for asks in [false, true] {
            for role in self.roles.iter_mut().rev() {
                if surplus > 0 && role.is_open() && role.pixel.robot.is_some() == asks {
                    role.is_dark = true;
                    surplus -= 1;
                }
            }
        }
    }

    /// Binds pixels with new ids to robots that have shown no pixel yet, if there are enough of these.
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

    /// Binds pixels to robots by least squared distance; binds nothing if there are fewer robots than pixels.
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
