//! Detects where robots come too close to each other or to walls within a span, and by how much.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::optimise::cells::Disc;
use crate::optimise::displacement::Displacement;
use crate::optimise::neighbours::{MOVED_M, MovedNeighbours, Places, STRETCHES, come_near, reach};
use crate::spline::set::SplineSet;
use crate::spline::weights::{basis, blend};

/// Distance in addition to the wanted one beyond which pairs are ignored until the next detection, metres.
const SKIN_M: f64 = 0.012;
/// Number of bisections in the search for the closest moment to a wall.
const NEARING: usize = 3;
/// Largest distance of a span from its straight stretches, metres.
const CUT_M: f64 = 0.003;

/// Two robots, or a robot and a wall, that may come too close within a span.
#[derive(Clone, Copy)]
pub(crate) struct Contact {
    /// Span of the splines.
    pub span: usize,
    /// The robot.
    pub a: usize,
    /// The other robot, or the wall.
    pub b: Other,
    /// Distance to reach, metres: between centres of robots, or between rim and wall.
    pub wanted: f64,
    /// Distance that is sufficient, metres.
    pub least: f64,
    /// Sum of both displacements up to which the pair is surely clear, metres.
    pub clear_until: f64,
    /// Whether the pair was too close at the last check.
    pub is_close: bool,
}

impl Contact {
    /// A contact of two robots.
    fn of_robots(span: usize, a: usize, b: usize, wanted: f64) -> Self {
        Self { span, a, b: Other::Robot(b), wanted, least: wanted, clear_until: 0.0, is_close: false }
    }

    /// Returns the contact for the next detection; `None` if one of its robots has moved farther than [`MOVED_M`].
    fn still(&self, near: &MovedNeighbours) -> Option<Self> {
        let moved_m = match self.b {
            Other::Robot(b) => near.moved_m(self.a).max(near.moved_m(b)),
            Other::Wall(_) => near.moved_m(self.a),
        };
        let clear_until = if moved_m > 0.0 { 0.0 } else { self.clear_until };
        (moved_m <= MOVED_M).then_some(Self { clear_until, ..*self })
    }
}

/// The robot or wall that a robot is in contact with.
#[derive(Clone, Copy)]
pub(crate) enum Other {
    /// Another robot.
    Robot(usize),
    /// A wall of the instance.
    Wall(usize),
}

/// The closest moment of a contact.
pub(crate) struct Approach {
    /// Distance as in [`Contact::wanted`].
    pub apart: f64,
    /// Unit vector from the other to `a`.
    pub away: Vec2,
    /// Weights of the span's control points at that moment.
    pub weights: [f64; 4],
}

/// Distances to reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clearances {
    /// Between centres of robots, metres.
    pub robots_m: f64,
    /// Between a robot's rim and a wall, metres.
    pub walls_m: f64,
    /// Between a robot's rim and the floor's edge, metres; at most [`Instance::off_edge_m`].
    pub edge_m: f64,
    /// Amount by which a distance may fall short, metres: with more, the optimisation ends sooner.
    pub slack_m: f64,
}

/// Detects contacts. It approximates each span by straight stretches.
pub(crate) struct ContactDetector {
    bases: [[f64; 4]; STRETCHES + 1],
    middle: [f64; 4],
}

impl ContactDetector {
    /// A detector with its tables of weights.
    pub fn new() -> Self {
        Self { bases: std::array::from_fn(|i| basis(i as f64 / STRETCHES as f64)), middle: basis(0.5) }
    }

    /// All contacts in order of spans: pairs that are too close or soon may be. `known` is the result of the last
    /// detection.
    pub fn detect(
        &self,
        instance: &Instance,
        splines: &SplineSet,
        clearances: Clearances,
        displacement: &Displacement,
        mut known: &[Contact],
    ) -> Vec<Contact> {
        let mut found = Vec::with_capacity(known.len());
        let mut near = MovedNeighbours::default();
        for span in (0..splines.spans).take_while(|_| !instance.cancel.is_wanted()) {
            near.find_moved(splines.robots(), span, displacement);
            let (of_span, later) = known.split_at(known.partition_point(|contact| contact.span <= span));
            found.extend(of_span.iter().filter_map(|contact| contact.still(&near)));
            known = later;
            if near.moved.is_empty() {
                continue;
            }
            let old = found.len();
            self.pairs(instance, splines, clearances, span, &mut near, &mut found);
            if !instance.walls.is_empty() {
                self.walls(instance, splines, clearances, span, &near, &mut found);
            }
            for contact in &mut found[old..] {
                contact.clear_until += displacement_m(displacement, contact);
            }
        }
        found
    }

    fn pairs(
        &self,
        instance: &Instance,
        splines: &SplineSet,
        clearances: Clearances,
        span: usize,
        near: &mut MovedNeighbours,
        found: &mut Vec<Contact>,
    ) {
        let mut places = std::mem::take(&mut near.places);
        places.clear();
        places.extend((0..splines.robots()).map(|robot| self.places(splines.span(robot, span))));
        near.discs.clear();
        near.discs.extend(places.iter().enumerate().map(|(robot, places)| Disc {
            at: places[STRETCHES / 2],
            radius: reach(places),
            owner: robot as u32,
        }));
        let reach_m = clearances.robots_m + SKIN_M + CUT_M;
        near.pairs(clearances.robots_m + SKIN_M, |a, b| {
            if !come_near(&std::array::from_fn(|i| places[a][i] - places[b][i]), reach_m) {
                return;
            }
            let mut contact = Contact::of_robots(span, a, b, clearances.robots_m);
            let apart = self.closest(instance, splines, &contact).apart;
            contact.wanted = clearances.robots_m.min(instance.ends_apart(a, b));
            if apart < contact.wanted + SKIN_M {
                contact.least = instance.least_gap(a, b).max(contact.wanted - clearances.slack_m);
                contact.clear_until = apart - contact.least;
                found.push(contact);
            }
        });
        near.places = places;
    }

    fn walls(
        &self,
        instance: &Instance,
        splines: &SplineSet,
        clearances: Clearances,
        span: usize,
        near: &MovedNeighbours,
        found: &mut Vec<Contact>,
    ) {
        for &robot in &near.moved {
            let Disc { at, radius, .. } = near.discs[robot];
            for wall in 0..instance.walls.len() {
                if instance.off_wall(wall, at).0 - radius >= clearances.walls_m + SKIN_M + CUT_M {
                    continue;
                }
                let wanted_m = clearances.walls_m;
                let (a, b) = (robot, Other::Wall(wall));
                let mut contact = Contact {
                    span,
                    a,
                    b,
                    wanted: wanted_m,
                    least: wanted_m,
                    clear_until: 0.0,
                    is_close: false,
                };
                let apart = self.closest(instance, splines, &contact).apart;
                if apart < clearances.walls_m + SKIN_M {
                    contact.wanted = instance.wall_gap(robot, wall, clearances.walls_m);
                    contact.least = contact.wanted - clearances.slack_m.min(contact.wanted.max(0.0) / 2.0);
                    contact.clear_until = apart - contact.least;
                    found.push(contact);
                }
            }
        }
    }

    /// Ends of the straight stretches of a span.
    fn places(&self, four: &[Vec2]) -> Places {
        std::array::from_fn(|i| blend(four, &self.bases[i]))
    }

    /// The closest moment of a contact within its span.
    pub fn closest(&self, instance: &Instance, splines: &SplineSet, contact: &Contact) -> Approach {
        let four = splines.span(contact.a, contact.span);
        match contact.b {
            Other::Robot(b) => {
                let other = splines.span(b, contact.span);
                self.closest_to_origin(
                    &std::array::from_fn(|i| four[i] - other[i]),
                    contact.wanted + SKIN_M + CUT_M,
                )
            }
            Other::Wall(wall) => self.closest_to_wall(instance, wall, four),
        }
    }

    /// Finds the closest moment to a wall: first the best of the sampled moments. Then, [`NEARING`] times, the best of
    /// that moment and two beside it, at half the distance of before.
    fn closest_to_wall(&self, instance: &Instance, wall: usize, four: &[Vec2]) -> Approach {
        let at = |u: f64| {
            let weights = basis(u);
            let (apart, away) = instance.off_wall(wall, blend(four, &weights));
            (u, Approach { apart, away, weights })
        };
        let nearer = |best: (f64, Approach), next: (f64, Approach)| {
            if next.1.apart < best.1.apart { next } else { best }
        };
        let mut reach = 1.0 / STRETCHES as f64;
        let mut best = (1..=STRETCHES).map(|i| at(i as f64 * reach)).fold(at(0.0), nearer);
        for _ in 0..NEARING {
            reach /= 2.0;
            let around = [best.0 - reach, best.0 + reach];
            best = around.into_iter().map(|u| at(u.clamp(0.0, 1.0))).fold(best, nearer);
        }
        best.1
    }

    fn closest_to_origin(&self, apart: &[Vec2; 4], near: f64) -> Approach {
        let mut before = blend(apart, &self.bases[0]);
        let mut best = (before.length_squared(), 0.0, before);
        for stretch in 0..STRETCHES {
            let after = blend(apart, &self.bases[stretch + 1]);
            let way = after - before;
            let (toward, whole) = (-before.dot(way), way.length_squared());
            // Most stretches are nearest at an end, which takes no division.
            let (share, nearest) = if toward <= 0.0 {
                (0.0, before)
            } else if toward < whole {
                (toward / whole, before + way * (toward / whole))
            } else {
                (1.0, after)
            };
            if nearest.length_squared() < best.0 {
                best = (nearest.length_squared(), (stretch as f64 + share) / STRETCHES as f64, nearest);
            }
            before = after;
        }
        let (squared, u, nearest) = best;
        if squared > near * near {
            return Approach { apart: squared.sqrt(), away: nearest, weights: self.middle };
        }
        let weights = basis(u);
        let nearest = blend(apart, &weights);
        let length = nearest.length();
        // Robots that meet head-on pass each other on the right.
        let aside = || (apart[0] - apart[3]).left().normalized().unwrap_or(Vec2::new(1.0, 0.0));
        let away = if length > 1e-6 { nearest / length } else { aside() };
        Approach { apart: length, away, weights }
    }
}

/// Sum of the displacements of a contact's robots, metres.
pub(crate) fn displacement_m(displacement: &Displacement, contact: &Contact) -> f64 {
    let other = match contact.b {
        Other::Robot(b) => displacement.of(b, contact.span),
        Other::Wall(_) => 0.0,
    };
    displacement.of(contact.a, contact.span) + other
}

#[cfg(test)]
#[path = "contacts_tests.rs"]
mod tests;
