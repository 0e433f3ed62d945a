//! Detects where robots come too close to each other or to walls within a span (a piece of their splines), and how
//! close.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::optimise::cells::Disc;
use crate::optimise::displacement::Displacement;
use crate::optimise::neighbours::{MOVED_M, MovedNeighbours, Places, STRETCHES, come_near, reach};
use crate::spline::set::SplineSet;
use crate::spline::weights::{basis, blend};

/// Pairs farther apart than the wanted distance plus this are ignored until the next detection, metres.
const SKIN_M: f64 = 0.012;
/// Number of bisections in the search for the moment at which a span is closest to a wall.
const NEARING: usize = 3;
/// Largest distance of a place on a span from the straight stretches that approximate the span, metres.
const CUT_M: f64 = 0.003;

/// A pair of two robots, or of a robot and a wall, that may come too close within a span.
#[derive(Clone, Copy)]
pub(crate) struct Contact {
    /// Index of the span of the splines.
    pub span: usize,
    /// Index of the robot.
    pub a: usize,
    /// The other robot, or the wall.
    pub b: Other,
    /// Distance that a displacement aims at, metres: between centres of two robots, or between a robot's rim and a
    /// wall.
    pub wanted: f64,
    /// Distance from which the pair needs no displacement, metres; at most `wanted`.
    pub least: f64,
    /// The pair counts as clear, and is not checked, while [`displacement_m`] of its robots is less than this, metres.
    pub clear_until: f64,
    /// Whether the pair was too close at the last check.
    pub is_close: bool,
}

impl Contact {
    /// A contact of two robots.
    fn of_robots(span: usize, a: usize, b: usize, wanted: f64) -> Self {
        Self { span, a, b: Other::Robot(b), wanted, least: wanted, clear_until: 0.0, is_close: false }
    }

    /// Returns the contact for the next detection. `None` if one of its robots has moved farther than [`MOVED_M`],
    /// because new contacts of that robot are then searched.
    fn still(&self, near: &MovedNeighbours) -> Option<Self> {
        let moved_m = match self.b {
            Other::Robot(b) => near.moved_m(self.a).max(near.moved_m(b)),
            Other::Wall(_) => near.moved_m(self.a),
        };
        let clear_until = if moved_m > 0.0 { 0.0 } else { self.clear_until };
        (moved_m <= MOVED_M).then_some(Self { clear_until, ..*self })
    }
}

/// The robot or wall that the robot `a` of a contact may come too close to.
#[derive(Clone, Copy)]
pub(crate) enum Other {
    /// Another robot, by its index.
    Robot(usize),
    /// A wall of the instance, by its index.
    Wall(usize),
}

/// The moment within its span at which a contact's robot is closest to the other robot or wall.
pub(crate) struct Approach {
    /// Distance as in [`Contact::wanted`].
    pub apart: f64,
    /// Unit vector from the other robot or wall towards robot `a`. Not of length 1 if the pair is far apart.
    pub away: Vec2,
    /// Weights of the span's control points at that moment.
    pub weights: [f64; 4],
}

/// Distances that a deformation aims at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clearances {
    /// Distance between the centres of two robots, metres.
    pub robots_m: f64,
    /// Distance between a robot's rim and a wall, metres.
    pub walls_m: f64,
    /// Distance between a robot's rim and the floor's edge, metres. Where [`Instance::off_edge_m`] is less, that
    /// applies.
    pub edge_m: f64,
    /// Length by which these distances may fall short, metres: with more, the deformation ends sooner.
    pub slack_m: f64,
}

/// Detects contacts. It approximates each span by [`STRETCHES`] straight stretches.
pub(crate) struct ContactDetector {
    bases: [[f64; 4]; STRETCHES + 1],
    middle: [f64; 4],
}

impl ContactDetector {
    /// A detector with its tables of weights.
    pub fn new() -> Self {
        Self { bases: std::array::from_fn(|i| basis(i as f64 / STRETCHES as f64)), middle: basis(0.5) }
    }

    /// Returns all contacts in order of spans: pairs that are too close or may soon be. `known` is the result of the
    /// last detection; contacts of robots that have hardly moved since then are taken from `known`.
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

    /// Returns the ends of the straight stretches of a span, stage metres. `four`: its control points.
    fn places(&self, four: &[Vec2]) -> Places {
        std::array::from_fn(|i| blend(four, &self.bases[i]))
    }

    /// Finds the moment within its span at which a contact's pair is closest.
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

    /// Finds the moment at which a span is closest to a wall. First takes the best of the sampled moments. Then,
    /// [`NEARING`] times, takes the best of that moment and two beside it, each time at half the distance.
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

    /// Finds the moment at which a moving point is closest to the origin; `apart` are the control points of its span.
    /// If the point stays farther than `near` metres from the origin, only the distance of the result is meaningful.
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
        // If the centres meet, the two robots pass each other on the right.
        let aside = || (apart[0] - apart[3]).left().normalized().unwrap_or(Vec2::new(1.0, 0.0));
        let away = if length > 1e-6 { nearest / length } else { aside() };
        Approach { apart: length, away, weights }
    }
}

/// Sum of the displacements of a contact's robots on its span, metres, since the deformation began or last retimed the
/// splines.
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
