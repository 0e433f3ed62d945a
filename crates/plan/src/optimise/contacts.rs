//! Which spans come too close to what, and how deep.

use lightbots_base::Vec2;

use crate::instance::Scene;
use crate::optimise::cells::Disc;
use crate::optimise::displacement::Travel;
use crate::optimise::neighbours::{Near, Places, STRETCHES, come_near, reach};
use crate::spline::set::{Weave, basis, blend};

/// Pairs farther apart than their wish by this much are not watched until the next look-out, metres.
const SKIN_M: f64 = 0.012;
/// How often the closest moment to a wall is looked for at half the distance from the best so far.
const NEARING: usize = 3;
/// Straight stretches cut corners by less than this, metres.
const CUT_M: f64 = 0.003;

/// Two robots, or a robot and a wall, that are or may come too close within a span.
#[derive(Clone, Copy)]
pub(crate) struct Contact {
    /// Which span of the weave.
    pub span: usize,
    /// The robot.
    pub a: usize,
    /// The other robot, or the wall.
    pub b: Other,
    /// How far they shall stay apart: centres of robots, or rim and wall; metres.
    pub wish: f64,
    /// How far will do, metres.
    pub least: f64,
    /// Nobody need look again before both have moved so far in all, metres.
    pub clear_until: f64,
    /// Whether it was too close when last looked at.
    pub is_close: bool,
}

impl Contact {
    /// Of two robots that will do with their wish.
    fn of_robots(span: usize, a: usize, b: usize, wish: f64) -> Self {
        Self { span, a, b: Other::Robot(b), wish, least: wish, clear_until: 0.0, is_close: false }
    }
}

/// What a robot may touch.
#[derive(Clone, Copy)]
pub(crate) enum Other {
    /// Another robot.
    Robot(usize),
    /// A wall of the scene.
    Wall(usize),
}

/// The closest moment of a contact.
pub(crate) struct Closest {
    /// How far apart, as in [`Contact::wish`].
    pub apart: f64,
    /// Unit vector from the other to `a`.
    pub away: Vec2,
    /// Weights of the span's control points at that moment.
    pub weights: [f64; 4],
}

/// How far all shall stay apart.
#[derive(Clone, Copy)]
pub(crate) struct Wish {
    /// Centres of robots, metres.
    pub robots_m: f64,
    /// A robot's rim off walls, metres.
    pub walls_m: f64,
    /// A robot's rim off the floor's edge, at most as far as its scene says; metres.
    pub edge_m: f64,
    /// How much less will do, metres: who is left alone within it settles sooner.
    pub slack_m: f64,
}

/// Looks at spans in straight stretches.
pub(crate) struct Watch {
    bases: [[f64; 4]; STRETCHES + 1],
    middle: [f64; 4],
}

impl Watch {
    /// One that is ready.
    pub fn new() -> Self {
        Self { bases: std::array::from_fn(|i| basis(i as f64 / STRETCHES as f64)), middle: basis(0.5) }
    }

    /// All that is closer than wished or soon may be, in order of spans; `known` is what there was at the look-out
    /// before.
    pub fn look_out(
        &self,
        scene: &Scene,
        weave: &Weave,
        wish: Wish,
        travel: &Travel,
        mut known: &[Contact],
    ) -> Vec<Contact> {
        let mut found = Vec::with_capacity(known.len());
        let mut near = Near::default();
        for span in (0..weave.spans).take_while(|_| !scene.cancel.is_wanted()) {
            near.stir(weave.robots(), span, travel);
            let (of_span, later) = known.split_at(known.partition_point(|contact| contact.span <= span));
            found.extend(of_span.iter().filter_map(|contact| near.still(contact)));
            known = later;
            if near.stirred.is_empty() {
                continue;
            }
            let old = found.len();
            self.pairs(scene, weave, wish, span, &mut near, &mut found);
            if !scene.walls.is_empty() {
                self.walls(scene, weave, wish, span, &near, &mut found);
            }
            for contact in &mut found[old..] {
                contact.clear_until += travelled(travel, contact);
            }
        }
        found
    }

    fn pairs(
        &self,
        scene: &Scene,
        weave: &Weave,
        wish: Wish,
        span: usize,
        near: &mut Near,
        found: &mut Vec<Contact>,
    ) {
        let mut places = std::mem::take(&mut near.places);
        places.clear();
        places.extend((0..weave.robots()).map(|robot| self.places(weave.span(robot, span))));
        near.discs.clear();
        near.discs.extend(places.iter().enumerate().map(|(robot, places)| Disc {
            at: places[STRETCHES / 2],
            radius: reach(places),
            owner: robot as u32,
        }));
        let reach_m = wish.robots_m + SKIN_M + CUT_M;
        near.pairs(wish.robots_m + SKIN_M, |a, b| {
            if !come_near(&std::array::from_fn(|i| places[a][i] - places[b][i]), reach_m) {
                return;
            }
            let mut contact = Contact::of_robots(span, a, b, wish.robots_m);
            let apart = self.closest(scene, weave, &contact).apart;
            contact.wish = wish.robots_m.min(scene.ends_apart(a, b));
            if apart < contact.wish + SKIN_M {
                contact.least = scene.least_gap(a, b).max(contact.wish - wish.slack_m);
                contact.clear_until = apart - contact.least;
                found.push(contact);
            }
        });
        near.places = places;
    }

    fn walls(
        &self,
        scene: &Scene,
        weave: &Weave,
        wish: Wish,
        span: usize,
        near: &Near,
        found: &mut Vec<Contact>,
    ) {
        for &robot in &near.stirred {
            let Disc { at, radius, .. } = near.discs[robot];
            for wall in 0..scene.walls.len() {
                if scene.off_wall(wall, at).0 - radius >= wish.walls_m + SKIN_M + CUT_M {
                    continue;
                }
                let wish_m = wish.walls_m;
                let (a, b) = (robot, Other::Wall(wall));
                let mut contact =
                    Contact { span, a, b, wish: wish_m, least: wish_m, clear_until: 0.0, is_close: false };
                let apart = self.closest(scene, weave, &contact).apart;
                if apart < wish.walls_m + SKIN_M {
                    contact.wish = scene.wall_gap(robot, wall, wish.walls_m);
                    contact.least = contact.wish - wish.slack_m.min(contact.wish.max(0.0) / 2.0);
                    contact.clear_until = apart - contact.least;
                    found.push(contact);
                }
            }
        }
    }

    /// The ends of a span's straight stretches.
    fn places(&self, four: &[Vec2]) -> Places {
        std::array::from_fn(|i| blend(four, &self.bases[i]))
    }

    /// The closest moment of a contact within its span.
    pub fn closest(&self, scene: &Scene, weave: &Weave, contact: &Contact) -> Closest {
        let four = weave.span(contact.a, contact.span);
        match contact.b {
            Other::Robot(b) => {
                let other = weave.span(b, contact.span);
                self.closest_to_origin(
                    &std::array::from_fn(|i| four[i] - other[i]),
                    contact.wish + SKIN_M + CUT_M,
                )
            }
            Other::Wall(wall) => self.closest_to_wall(scene, wall, four),
        }
    }

    /// The best of the moments that are looked at, then of those half as far from it, and so on.
    fn closest_to_wall(&self, scene: &Scene, wall: usize, four: &[Vec2]) -> Closest {
        let at = |u: f64| {
            let weights = basis(u);
            let (apart, away) = scene.off_wall(wall, blend(four, &weights));
            (u, Closest { apart, away, weights })
        };
        let nearer = |best: (f64, Closest), next: (f64, Closest)| {
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

    fn closest_to_origin(&self, apart: &[Vec2; 4], near: f64) -> Closest {
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
            return Closest { apart: squared.sqrt(), away: nearest, weights: self.middle };
        }
        let weights = basis(u);
        let nearest = blend(apart, &weights);
        let length = nearest.length();
        // Those who meet head-on pass each other on the right.
        let aside = || (apart[0] - apart[3]).left().normalized().unwrap_or(Vec2::new(1.0, 0.0));
        let away = if length > 1e-6 { nearest / length } else { aside() };
        Closest { apart: length, away, weights }
    }
}

/// How far those in a contact have moved in all, metres.
pub(crate) fn travelled(travel: &Travel, contact: &Contact) -> f64 {
    let other = match contact.b {
        Other::Robot(b) => travel.of(b, contact.span),
        Other::Wall(_) => 0.0,
    };
    travel.of(contact.a, contact.span) + other
}

#[cfg(test)]
#[path = "contacts_tests.rs"]
mod tests;
