//! What a rehearsal knows beyond the controller's inputs: true places, contacts and false brakes.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Span, Vec2};

use crate::track::PlaceTrack;

/// True places are sampled this often. Below, reports take longer to make; above, curves lose their shape.
const SAMPLE: Span = Span::from_millis(96);
/// Most contacts and false brakes that are kept one by one.
const EVENTS_MAX: usize = 200;
/// Most pairs that are remembered: 20,000 robots with some neighbours each.
const PAIRS_MAX: usize = 200_000;

/// The floor of a rehearsal, filled step by step.
#[derive(Clone, Debug, Default)]
pub struct FloorTruth {
    /// Names by number.
    names: Vec<RobotId>,
    numbers: BTreeMap<RobotId, usize>,
    /// Distance of two centres whose rims touch, metres.
    contact_m: f64,
    sampled: Option<Instant>,
    /// `[robot]`: its true places, seconds of the show clock.
    pub(crate) tracks: Vec<PlaceTrack>,
    /// Least distance of centres of each pair that saw each other, and when.
    pairs: BTreeMap<(u32, u32), (f64, Instant)>,
    pub(crate) contacts: u64,
    /// The first contacts.
    pub(crate) touched: Vec<(Instant, u32, u32)>,
    /// `[robot]`: brakes.
    pub(crate) brakes: Vec<u64>,
    /// Number of false brakes, and the first of them.
    pub(crate) unfounded: u64,
    pub(crate) false_brakes: Vec<(Instant, usize)>,
    /// Messages lost on the way.
    pub(crate) lost: u64,
}

impl FloorTruth {
    /// A floor with these robots, whose rims touch where their centres are `contact_m` apart.
    pub fn new(names: &[RobotId], contact_m: f64) -> Self {
        let numbers = names.iter().enumerate().map(|(number, &id)| (id, number)).collect();
        Self {
            names: names.to_vec(),
            numbers,
            contact_m,
            brakes: vec![0; names.len()],
            tracks: vec![PlaceTrack::default(); names.len()],
            ..Self::default()
        }
    }

    /// A step of the world is over: places, pairs within sight of each other.
    pub fn step(&mut self, at: Instant, places: &[Vec2], in_sight: &[(u32, u32)]) {
        for &(a, b) in in_sight {
            let far_m = places[a as usize].distance(places[b as usize]);
            if self.pairs.len() < PAIRS_MAX || self.pairs.contains_key(&(a, b)) {
                let least = self.pairs.entry((a, b)).or_insert((far_m, at));
                if far_m < least.0 {
                    *least = (far_m, at);
                }
            }
        }
        if self.sampled.is_none_or(|sampled| at - sampled >= SAMPLE) {
            self.sampled = Some(at);
            for (track, &place) in self.tracks.iter_mut().zip(places) {
                track.add(at.as_secs(), place);
            }
        }
    }

    /// Pairs that came to touch, and robots that began to brake: `(robot, whether that was false)`.
    pub fn meet(&mut self, at: Instant, touched: &[(u32, u32)], braked: &[(usize, bool)]) {
        self.contacts += touched.len() as u64;
        self.touched.extend(touched.iter().map(|&(a, b)| (at, a, b)));
        self.touched.truncate(EVENTS_MAX);
        for &(robot, is_false) in braked {
            self.brakes[robot] += 1;
            if is_false {
                self.unfounded += 1;
                self.false_brakes.push((at, robot));
            }
        }
        self.false_brakes.truncate(EVENTS_MAX);
    }

    /// How many messages were lost on the way.
    pub fn lose_messages(&mut self, lost: u64) {
        self.lost = lost;
    }

    /// The number of a robot.
    pub(crate) fn number(&self, id: RobotId) -> Option<usize> {
        self.numbers.get(&id).copied()
    }

    /// The name of a robot.
    pub(crate) fn name(&self, robot: usize) -> Option<RobotId> {
        self.names.get(robot).copied()
    }

    /// The closest pairs: gap between rims, when.
    pub(crate) fn closest(&self, count: usize) -> Vec<((u32, u32), f64, Instant)> {
        let mut pairs: Vec<_> = self
            .pairs
            .iter()
            .map(|(&pair, &(far_m, at))| (pair, (far_m - self.contact_m).max(0.0), at))
            .collect();
        pairs.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        pairs.truncate(count);
        pairs
    }
}
