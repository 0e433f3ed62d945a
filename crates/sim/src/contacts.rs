//! Contact resolution: discs that overlap are moved apart. A standing robot yields only as far as its wheels allow.

use lightbots_base::Vec2;

/// Distance by which a standing robot can be pushed along the direction of its wheels before it stops yielding, metres.
/// Measured in Webots R2023b on 2026-11-21.
const SLACK_M: f64 = 0.01;
/// Largest distance that a pushed standing robot moves sideways in a step, metres: 0.06 m/s, measured in Webots R2023b
/// on 2026-11-21.
const SIDEWAYS_M: f64 = 0.06 * 0.016;
/// Gap between the rims of two robots from which their contact has ended, metres. A smaller value would count one
/// contact several times.
pub(crate) const PARTED_M: f64 = 0.0005;
/// Largest number of rounds over the list of pairs in a step. Each round passes a push on to the next robot of a chain.
const ROUNDS: usize = 4;

/// How a robot resists a push.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactState {
    /// Unit vector of its front.
    pub forward: Vec2,
    /// Whether the body neither drove nor turned in the last step.
    pub stands: bool,
    /// Distance by which the robot can still be pushed along the direction of its wheels during this contact, metres.
    pub slack_m: f64,
}

impl ContactState {
    /// The state of a standing robot that is not pushed.
    pub fn new(forward: Vec2) -> Self {
        Self { forward, stands: true, slack_m: SLACK_M }
    }

    /// Returns the distance by which the robot yields in direction `push` (a unit vector) in one step, at most
    /// `wanted_m`. Reduces its slack.
    fn give_way(&mut self, push: Vec2, wanted_m: f64) -> f64 {
        let along = self.forward.dot(push);
        let along_share = along * along;
        let most_m = along_share * self.slack_m + (1.0 - along_share) * SIDEWAYS_M;
        let moved_m = wanted_m.min(most_m);
        self.slack_m = (self.slack_m - along_share * moved_m).max(0.0);
        moved_m
    }
}

/// Contacts between robots: which pairs touch, how many contacts began, and the least distance of two centres until
/// now.
#[derive(Clone, Debug)]
pub struct Contacts {
    contact_m: f64,
    /// Distance of centres below which the proximity sensors of two robots detect each other, metres.
    sight_m: f64,
    /// Pairs within sight.
    in_sight: Vec<(u32, u32)>,
    /// Pairs that touch, sorted.
    touching: Vec<(u32, u32)>,
    /// Pairs that overlapped in this step, before they were moved apart.
    now: Vec<(u32, u32)>,
    /// Pairs that began to touch in this step.
    fresh: Vec<(u32, u32)>,
    count: u64,
    closest_squared: f64,
}

impl Contacts {
    /// Contacts of discs. Two discs touch if their centres are closer than `contact_m`, and their sensors detect each
    /// other if closer than `sight_m`, both in metres.
    pub(crate) fn new(contact_m: f64, sight_m: f64) -> Self {
        let (touching, now, fresh) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            contact_m,
            sight_m,
            in_sight: Vec::new(),
            touching,
            now,
            fresh,
            count: 0,
            closest_squared: f64::MAX,
        }
    }

    /// Distance of two centres at which robots touch, metres.
    pub(crate) fn contact_m(&self) -> f64 {
        self.contact_m
    }

    /// Number of contacts until now. A pair that parted and touches again counts again.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Pairs that began to touch in the last step.
    pub fn fresh(&self) -> &[(u32, u32)] {
        &self.fresh
    }

    /// The least distance of two centres at the ends of steps, metres, before overlapping robots are moved apart. Only
    /// pairs of the neighbour list are measured. `None` if that list never held a pair.
    pub fn closest_m(&self) -> Option<f64> {
        (self.closest_squared < f64::MAX).then(|| libm::sqrt(self.closest_squared))
    }

    /// Pairs within range of each other's sensors in the last step, found before touching robots were moved apart.
    pub(crate) fn in_sight(&self) -> &[(u32, u32)] {
        &self.in_sight
    }

    /// Whether no two robots touch. After a touch, a pair still counts as touching until its gap is half a millimetre.
    pub fn none_touching(&self) -> bool {
        self.touching.is_empty() && self.fresh.is_empty()
    }

    /// Finds which of `pairs` touch after a step, counts new contacts and moves overlapping robots apart. `pairs`: the
    /// pairs of the neighbour list.
    pub(crate) fn resolve(
        &mut self,
        pairs: &[(u32, u32)],
        places: &mut [Vec2],
        contact_states: &mut [ContactState],
    ) {
        let contact_squared = self.contact_m * self.contact_m - 1e-12;
        self.now.clear();
        self.fresh.clear();
        self.in_sight.clear();
        let sight_squared = self.sight_m * self.sight_m;
        let mut closest = self.closest_squared;
        for &(a, b) in pairs {
            let distance = (places[b as usize] - places[a as usize]).length_squared();
            if distance < closest {
                closest = distance;
            }
            if distance < sight_squared {
                self.in_sight.push((a, b));
                if distance < contact_squared {
                    self.now.push((a, b));
                }
            }
        }
        self.closest_squared = closest;
        if self.now.is_empty() && self.touching.is_empty() {
            return;
        }
        self.count_new(places, contact_states);
        for _ in 0..ROUNDS {
            if !self.part(pairs, places, contact_states, contact_squared) {
                break;
            }
        }
    }

    fn count_new(&mut self, places: &[Vec2], contact_states: &mut [ContactState]) {
        let parted = (self.contact_m + PARTED_M) * (self.contact_m + PARTED_M);
        self.touching.retain(|&(a, b)| {
            let touches = (places[b as usize] - places[a as usize]).length_squared() < parted;
            if !touches {
                contact_states[a as usize].slack_m = SLACK_M;
                contact_states[b as usize].slack_m = SLACK_M;
            }
            touches
        });
        for &pair in &self.now {
            if let Err(place) = self.touching.binary_search(&pair) {
                self.touching.insert(place, pair);
                self.fresh.push(pair);
                self.count += 1;
            }
        }
    }

    /// Moves overlapping pairs apart, in one round over the list. Returns whether any pair overlapped.
    fn part(
        &self,
        pairs: &[(u32, u32)],
        places: &mut [Vec2],
        contact_states: &mut [ContactState],
        contact_squared: f64,
    ) -> bool {
        let mut overlapped = false;
        for &(a, b) in pairs {
            let (a, b) = (a as usize, b as usize);
            let gap = places[b] - places[a];
            if gap.length_squared() < contact_squared {
                overlapped = true;
                self.push_apart(a, b, gap, places, contact_states);
            }
        }
        overlapped
    }

    fn push_apart(
        &self,
        a: usize,
        b: usize,
        gap: Vec2,
        places: &mut [Vec2],
        contact_states: &mut [ContactState],
    ) {
        // Robots at the same place part along x. Any fixed direction will do.
        let (distance, normal) = match gap.normalized() {
            Some(normal) => (gap.length(), normal),
            None => (0.0, Vec2::new(1.0, 0.0)),
        };
        let overlap = self.contact_m - distance;
        let (move_a, move_b) = match (contact_states[a].stands, contact_states[b].stands) {
            (false, true) => {
                let given = contact_states[b].give_way(normal, overlap);
                (overlap - given, given)
            }
            (true, false) => {
                let given = contact_states[a].give_way(-normal, overlap);
                (given, overlap - given)
            }
            _ => (0.5 * overlap, 0.5 * overlap),
        };
        places[a] -= normal * move_a;
        places[b] += normal * move_b;
    }
}
