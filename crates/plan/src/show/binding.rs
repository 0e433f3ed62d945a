//! Which pixels are bound to which robots, from frame to frame.

use super::{ShowOptions, issues};
use crate::assignment::Choice;
use lightbots_base::Vec2;
use lightbots_show::{Identity, Issues, Pixel, Show};
use std::collections::BTreeMap;

/// What is known about robots while frames go by.
pub(super) struct Binding {
    /// The robot a name means.
    by_name: BTreeMap<String, usize>,
    /// Whether the names of all robots were given.
    names_known: bool,
    /// The robot that showed a pixel id last.
    by_id: BTreeMap<u32, usize>,
    robots: usize,
}

impl Binding {
    pub fn new(_show: &Show, robots: usize, options: &ShowOptions) -> Self {
        let names = options.robots.iter().take(robots).enumerate();
        Self {
            by_name: names.map(|(robot, name)| (name.clone(), robot)).collect(),
            names_known: !options.robots.is_empty(),
            by_id: BTreeMap::new(),
            robots,
        }
    }

    /// The robot each pixel is bound to in a frame whose robots stand at `places`.
    pub fn pins(
        &self,
        places: &[Vec2],
        pixels: &[Pixel],
        identity: Identity,
        frame: usize,
        issues: &mut Issues,
    ) -> Vec<Option<usize>> {
        let mut taken = vec![false; self.robots];
        let mut pins = vec![None; pixels.len()];
        let mut fresh = Vec::new();
        let mut pin = |index: usize, robot: usize| {
            let free = !taken[robot];
            if free {
                taken[robot] = true;
                pins[index] = Some(robot);
            }
            free
        };
        for (index, pixel) in pixels.iter().enumerate() {
            let Some(name) = &pixel.robot else { continue };
            match self.by_name.get(name) {
                Some(&robot) if pin(index, robot) => {}
                Some(_) => issues.push(issues::bound_twice(frame, pixel.id, name)),
                None if self.names_known => issues.push(issues::unknown_robot(frame, pixel.id, name)),
                None => fresh.push(index),
            }
        }
        if identity == Identity::Fixed {
            for (index, pixel) in pixels.iter().enumerate() {
                let (None, Some(&robot)) = (&pixel.robot, self.by_id.get(&pixel.id)) else { continue };
                if !pin(index, robot) {
                    issues.push(issues::bound_to_another(frame, pixel.id));
                }
            }
        }
        self.place_fresh_names(places, pixels, fresh, (&mut taken, &mut pins));
        if identity == Identity::Fixed {
            self.place_newcomers(places, pixels, &mut taken, &mut pins);
        }
        pins
    }

    /// Gives names that nobody has borne yet to robots without one: two names are two robots. Where nobody bears one
    /// yet, any robots will do.
    fn place_fresh_names(
        &self,
        places: &[Vec2],
        pixels: &[Pixel],
        fresh: Vec<usize>,
        (taken, pins): (&mut [bool], &mut [Option<usize>]),
    ) {
        let mut named = vec![false; self.robots];
        self.by_name.values().for_each(|&robot| named[robot] = true);
        if (0..self.robots).any(|robot| named[robot] && !taken[robot]) {
            let robots = (0..self.robots).filter(|&robot| !named[robot] && !taken[robot]).collect();
            place(places, pixels, robots, fresh, (taken, pins));
        }
    }

    /// Gives ids that nobody has shown yet to robots that have shown nothing yet, where there are enough of those.
    fn place_newcomers(
        &self,
        places: &[Vec2],
        pixels: &[Pixel],
        taken: &mut [bool],
        pins: &mut [Option<usize>],
    ) {
        let mut fresh = vec![true; self.robots];
        for &robot in self.by_id.values() {
            fresh[robot] = false;
        }
        let robots: Vec<usize> = (0..self.robots).filter(|&robot| fresh[robot] && !taken[robot]).collect();
        let new: Vec<usize> = (0..pixels.len()).filter(|&index| pins[index].is_none()).collect();
        if robots.len() == self.robots || new.is_empty() {
            return;
        }
        place(places, pixels, robots, new, (taken, pins));
    }

    /// Keeps who showed what; `goal_of[robot]` is an index into `pixels`.
    pub fn remember(&mut self, pixels: &[Pixel], goal_of: &[Option<usize>]) {
        for (robot, goal) in goal_of.iter().enumerate() {
            let Some(pixel) = goal.map(|goal| &pixels[goal]) else { continue };
            self.by_id.insert(pixel.id, robot);
            if let (false, Some(name)) = (self.names_known, &pixel.robot) {
                self.by_name.entry(name.clone()).or_insert(robot);
            }
        }
    }
}

/// Pins pixels to robots, both by their indices, as near as may be; nothing where there are too few robots.
fn place(
    places: &[Vec2],
    pixels: &[Pixel],
    robots: Vec<usize>,
    new: Vec<usize>,
    (taken, pins): (&mut [bool], &mut [Option<usize>]),
) {
    let from: Vec<Vec2> = robots.iter().map(|&robot| places[robot]).collect();
    let to: Vec<Vec2> = new.iter().map(|&index| pixels[index].at).collect();
    let choice = Choice::new(&from, &to, &[]);
    if let Some(start_of) = choice.and_then(|choice| choice.least_squares().solve(0.0)) {
        for (&index, &start) in new.iter().zip(&start_of) {
            pins[index] = Some(robots[start]);
            taken[robots[start]] = true;
        }
    }
}
