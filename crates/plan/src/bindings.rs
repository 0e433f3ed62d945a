//! Bindings of pixels to robots by pins, names and fixed identity. [`crate::transition()`] later assigns the pixels
//! that these bindings leave open, by distance. Planning of a show and of a run use the same bindings.

use crate::assignment::Choice;
use lightbots_base::Vec2;
use lightbots_show::{Identity, Pixel};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// For each pixel id, the robot that showed this pixel last. `R` is the type that identifies a robot.
#[derive(Clone, Debug)]
pub struct Claims<R> {
    /// By pixel id: the robot, and a serial number. The greater this number, the later the robot showed the pixel.
    of: BTreeMap<u32, (R, u64)>,
    /// Number of calls of [`Claims::show`]; the serial number of the next claim.
    told: u64,
}

/// What is known about which robot must show which pixel, carried from frame to frame. Robots are indices in one list
/// of robots.
#[derive(Clone, Debug, Default)]
pub struct Bindings {
    /// Names of robots; each value is the index of the robot.
    pub by_name: BTreeMap<String, usize>,
    /// Whether `by_name` has the names of all robots. If `false`, a pixel that asks for a name that `by_name` lacks may
    /// get any robot without a name.
    pub names_known: bool,
    /// By pixel id: the robot that shows this pixel in all frames; `None` if that robot is not in the list.
    pub pins: BTreeMap<u32, Option<usize>>,
    /// For each pixel id, the robot that showed it last, if that robot is in the list.
    pub claims: Claims<usize>,
}

/// The pixels of a frame that are shown, and their bindings.
#[derive(Clone, Debug, Default)]
pub struct BoundFrame<'a> {
    /// Pixels that are shown, in the order of the frame.
    pub pixels: Vec<&'a Pixel>,
    /// `[pixel]`: the robot bound to it; `None` if any robot may show it.
    pub pinned: Vec<Option<usize>>,
    /// Ids of the pixels that stay dark.
    pub dark: Vec<u32>,
    /// Problems of the binding, each with the id of its pixel. A pixel has no entry if it is dark only because
    /// `stays_dark` excludes it, or because too few robots are left.
    pub issues: Vec<(u32, BindingIssue)>,
}

/// Why a pixel stays dark or changes its robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingIssue {
    /// The pixel names, or is pinned to, a robot that already has another pixel of this frame. The pixel stays dark.
    BoundTwice,
    /// The pixel names, or is pinned to, a robot that is not in the list, or no robot without a name is left for it.
    /// The pixel stays dark.
    Unknown,
    /// Identity is fixed, but the robot that showed this pixel last has another pixel in this frame. The pixel gets
    /// another robot if enough are left, and stays dark otherwise.
    Lost,
}

impl<R> Default for Claims<R> {
    fn default() -> Self {
        Self { of: BTreeMap::new(), told: 0 }
    }
}

impl<R: Copy + PartialEq> Claims<R> {
    /// Records that a robot shows the pixel with this id.
    pub fn show(&mut self, id: u32, robot: R) {
        self.of.insert(id, (robot, self.told));
        self.told += 1;
    }

    /// Pixel ids, each with the robot that showed it last, in the order of these last showings, the oldest first.
    pub fn oldest_first(&self) -> Vec<(u32, R)> {
        let mut all: Vec<_> = self.of.iter().map(|(&id, &(robot, told))| (told, id, robot)).collect();
        all.sort_unstable_by_key(|&(told, ..)| told);
        all.into_iter().map(|(_, id, robot)| (id, robot)).collect()
    }

    /// Forgets which robots showed which pixels.
    pub fn clear(&mut self) {
        self.of.clear();
    }

    /// Forgets all pixels of a robot.
    pub fn forget(&mut self, robot: R) {
        self.of.retain(|_, (of, _)| *of != robot);
    }
}

impl Bindings {
    /// Binds a frame's pixels to robots, which stand at `places[robot]`, stage metres. A pixel is bound to the robot
    /// that it names, or else to the robot that it is pinned to. Pixels without a bound robot stay open: any robot may
    /// show them.
    ///
    /// With fixed identity, other pixels are bound to the robots that showed them last, if these are free. If robots
    /// that no pixel was last shown by suffice for the remaining pixels, these pixels are bound to them. Pixels with an
    /// unknown name are bound to robots without a name, if they could otherwise get a robot with a name.
    ///
    /// A pixel stays dark if `stays_dark` returns `true`, or no robot is left. It also stays dark if the robot that it
    /// names or is pinned to is missing or taken.
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

    /// Records which robot shows each pixel of `bound`: `goal_of[robot]` is an index into `bound.pixels`, `None` if the
    /// robot shows none. If not all names are known, a name that is not in `by_name` becomes the name of the robot that
    /// shows its pixel.
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

/// A pixel of a frame while [`Binder`] looks for its robot.
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

/// The state of [`Bindings::bind`]: all pixels of a frame, and the robots that they have got.
struct Binder<'a, 'b> {
    bindings: &'b Bindings,
    places: &'b [Vec2],
    roles: Vec<Role<'a>>,
    /// `[robot]`: whether a pixel is bound to it.
    taken: Vec<bool>,
    issues: Vec<(u32, BindingIssue)>,
}

impl<'a> Binder<'a, '_> {
    /// Binds the pixel with index `role` to a robot. Returns `false`, and changes nothing, if the robot has a pixel
    /// already or does not exist.
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

    /// Binds pixels that ask for robots by name, then pinned pixels. A pixel stays dark if its robot is missing or
    /// taken. A pixel with an unknown name stays open if names are not completely known.
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

    /// Returns the robot that showed the pixel with index `role` last; `None` if no robot did, or that robot is not in
    /// the list.
    fn owner(&self, role: usize) -> Option<usize> {
        self.bindings.claims.of.get(&self.roles[role].pixel.id).map(|&(robot, _)| robot)
    }

    /// Indices of the open pixels that ask for a name that no robot has yet.
    fn nameless(&self) -> Vec<usize> {
        let asks = |&role: &usize| self.roles[role].is_open() && self.roles[role].pixel.robot.is_some();
        (0..self.roles.len()).filter(asks).collect()
    }

    /// `[robot]`: whether `by_name` has a name for it.
    fn named(&self) -> Vec<bool> {
        let mut named = vec![false; self.taken.len()];
        self.bindings.by_name.values().for_each(|&robot| named[robot] = true);
        named
    }

    /// Binds pixels that ask for a name that no robot has yet to the robots that showed them last, if those robots have
    /// no name.
    fn name_owners(&mut self) {
        let named = self.named();
        for role in self.nameless() {
            if let Some(robot) = self.owner(role).filter(|&robot| !named[robot]) {
                self.give(role, robot);
            }
        }
    }

    /// Binds pixels that ask for names that no robot has yet to robots without a name, so that no robot gets two names.
    /// With fixed identity, robots that showed another open pixel last are taken only if the remaining robots do not
    /// suffice. Pixels for which no robot is left stay dark. Nothing is bound if the remaining robots suffice and have
    /// no names: the assignment may then choose among them.
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

    /// Binds open pixels that name no robot to the robots that showed them last. A robot that showed several of these
    /// pixels keeps the one that it showed last. A pixel stays open if its robot is taken, and is reported as
    /// [`BindingIssue::Lost`].
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

    /// If there are more open pixels than free robots, leaves the surplus pixels dark, without an issue. Pixels that
    /// name no robot are the first to stay dark, from the end of the frame.
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

    /// Binds all open pixels to new robots, if enough new robots are free. A robot is new if no pixel was last shown by
    /// it. Nothing is bound if all free robots are new: the assignment may then choose among them.
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

    /// Binds the pixels with indices `roles` to robots, so that the sum of squared distances is least. Binds nothing if
    /// there are fewer robots than pixels.
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
