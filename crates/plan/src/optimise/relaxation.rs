//! Relaxation in space and time: whoever comes too close is bent aside a little, then speed, acceleration and turning
//! are pulled back under their limits, again and again until neither is needed.

use lightbots_base::Vec2;

use crate::Meeting;
use crate::instance::Scene;
use crate::optimise::contacts::{Contact, Other, Watch, Wish, travelled};
use crate::optimise::displacement::Travel;
use crate::optimise::neighbours::STIR_M;
use crate::optimise::stagnation::{Stage, growth};
use crate::spline::limits::Slow;
use crate::spline::retime::{blurred, moments, slowed};
use crate::spline::set::{MOST_SPANS, Weave, blend};
use crate::spline::turn_rate::Look;

/// Where fewer than one robot in so many are left in each other's way they are sent elsewhere.
const A_FEW: usize = 30;
/// How far, metres, in directions this much apart, radians.
const KICK_M: f64 = 0.06;
const KICK_TURN: f64 = 2.4;
/// How much of that control points around the moment take part in.
const KICK: [f64; 8] = [0.25, 0.6, 0.9, 1.0, 1.0, 0.9, 0.6, 0.25];
/// Sweeps between two look-outs at least, and how far somebody must have moved, metres.
const LOOK_OUT_EVERY: usize = 6;
const LOOK_OUT_MOVED_M: f64 = 0.006;
/// More time goes where contacts are, and to the spans beside them by as many passes; no span becomes longer than so many
/// times at once.
const BLUR: usize = 3;
const MOST_SLOWED: f64 = 1.5;
/// Rather than longer than this spans become more, seconds: long ones cannot be bent where two contacts are near each
/// other.
const LONGEST_SPAN_S: f64 = 0.36;
/// Bending aims beyond the wish by this, metres: otherwise it would only be neared for ever.
const BEYOND_M: f64 = 0.0002;
/// Control points that hardly move a place must not be moved far for it.
const LEAST_PULL: f64 = 0.18;
/// Bending goes this much farther than needed at once.
const OVERSHOOT: f64 = 1.15;
/// Robots slower than this all count as equally agile, m/s.
const CLUMSY_MPS: f64 = 0.1;
/// Passes over a way against fast turns, once most contacts are resolved.
const EASINGS: usize = 8;
/// Haste that is worth no further sweeps.
const GOOD_HASTE: f64 = 1.03;

/// Contacts between two questions whether to give up.
const POLLED: usize = 1024;

/// How hard to try.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// How many sweeps at most.
    pub sweeps: usize,
    /// How much longer than at first it may take.
    pub stretch: f64,
    /// Whether to give more time at once where many are in each other's way.
    pub hurry: bool,
    /// How far all shall stay apart.
    pub wish: Wish,
}

/// A weave free of contacts, or who is in whose way when fewest are where the effort did not do. Where a stage does not
/// bring much there is a little more time for the next. The weave's haste says how much slower still it must be driven.
pub(crate) fn relax(
    scene: &Scene,
    weave: Weave,
    effort: Effort,
    work: &mut usize,
) -> Result<Weave, Vec<Meeting>> {
    let mut relaxation = Relaxation::new(scene, weave, effort);
    relaxation.go_on(effort.sweeps, work);
    relaxation.outcome()
}

/// A relaxation that can be left and gone on with.
pub(crate) struct Relaxation<'a> {
    state: State<'a>,
    effort: Effort,
    /// It may not take longer, seconds.
    longest_s: f64,
    stage: Stage,
    sweep: usize,
    kicks: usize,
    is_over: bool,
    /// How many contacts were bent in the last sweep.
    bent: usize,
    /// The swiftest weave without contacts, and how long it takes, seconds.
    best: Option<(f64, Weave)>,
    fewest: usize,
    left_over: Vec<Meeting>,
}

impl<'a> Relaxation<'a> {
    /// One that has not begun.
    pub fn new(scene: &'a Scene<'a>, weave: Weave, effort: Effort) -> Self {
        Self {
            longest_s: weave.lasts_s() * effort.stretch,
            state: State::new(scene, weave, effort.wish),
            effort,
            stage: Stage::new(effort.hurry),
            sweep: 0,
            kicks: 0,
            is_over: false,
            bent: usize::MAX,
            best: None,
            fewest: usize::MAX,
            left_over: Vec::new(),
        }
    }

    /// Sweeps so often at most, in as much time as there is for all.
    pub fn go_on(&mut self, sweeps: usize, work: &mut usize) {
        for _ in 0..sweeps {
            let cost = self.state.weave.robots() * self.state.weave.spans;
            let Some(left) =
                work.checked_sub(cost).filter(|_| !self.is_over && !self.state.scene.cancel.is_wanted())
            else {
                break;
            };
            *work = left;
            self.is_over = !self.sweep() || self.sweep == self.effort.sweeps;
            *work = work.saturating_sub(self.bent);
        }
    }

    /// How many were in each other's way in the last sweep.
    pub fn bent(&self) -> usize {
        self.bent
    }

    /// What it has come to.
    pub fn outcome(self) -> Result<Weave, Vec<Meeting>> {
        self.best.map(|(_, weave)| weave).ok_or(self.left_over)
    }

    /// Bends all once; whether another time may help.
    fn sweep(&mut self) -> bool {
        let anew = self.state.must_look_out(self.sweep);
        self.sweep += 1;
        let bent = self.state.bend_all(anew);
        self.bent = bent;
        if self.state.scene.cancel.is_wanted() {
            return false;
        }
        if anew && (1..self.fewest).contains(&bent) {
            (self.fewest, self.left_over) = (bent, self.state.meetings());
        }
        let (haste, hasty) = if bent == 0 { self.state.haste() } else { (f64::MAX, 0) };
        let lasts_s = self.state.weave.lasts_s() * haste;
        let is_best = bent == 0 && self.best.as_ref().is_none_or(|(best_s, _)| lasts_s < *best_s);
        if is_best && self.state.bend_all(true) == 0 {
            self.best = Some((lasts_s, self.state.weave.clone()));
            if haste < GOOD_HASTE {
                return false;
            }
        }
        let robots = self.state.weave.robots();
        let few = robots / A_FEW + 1;
        if self.stage.ends_in_vain(bent + hasty, bent <= few) {
            if bent > 0 && bent <= few {
                self.kicks += 1;
                self.state.kick(self.kicks);
            }
            if self.state.scene.cancel.is_wanted() {
                return false;
            }
            self.state.give_time(growth(self.effort.hurry, bent, few, robots));
            let most_s = self.best.as_ref().map_or(self.longest_s, |(best_s, _)| *best_s);
            if self.state.weave.lasts_s() > most_s && (self.best.is_some() || bent > few) {
                return false;
            }
        }
        self.state.slow(if bent > robots { 1 } else { EASINGS });
        true
    }
}

struct State<'a> {
    scene: &'a Scene<'a>,
    weave: Weave,
    wish: Wish,
    watch: Watch,
    contacts: Vec<Contact>,
    /// The sweep in which contacts were last looked out for, since the weave's spans are what they are.
    looked_out: Option<usize>,
    travel: Travel,
    /// `[robot]`: where it may be beyond its limits; `None`: nowhere.
    dirty: Vec<Option<Look>>,
    /// `[robot]`: whether `haste` is out of date.
    stale: Vec<bool>,
    haste: Vec<f64>,
    /// A way before it changes; kept to save memory.
    before: Vec<Vec2>,
}

impl<'a> State<'a> {
    fn new(scene: &'a Scene<'a>, weave: Weave, wish: Wish) -> Self {
        let robots = weave.robots();
        Self {
            scene,
            wish,
            watch: Watch::new(),
            contacts: Vec::new(),
            looked_out: None,
            travel: Travel::new(robots, weave.spans + 3),
            weave,
            dirty: vec![Some(Look::ALL); robots],
            stale: vec![true; robots],
            haste: vec![0.0; robots],
            before: Vec::new(),
        }
    }

    /// Lets the whole take so many times as long, and what of it is in the way of others.
    fn give_time(&mut self, factor: f64) {
        let mut thick = vec![0.0; self.weave.spans];
        for contact in self.contacts.iter().filter(|contact| contact.is_close) {
            thick[contact.span] += 1.0;
        }
        if thick.iter().any(|&contacts| contacts > 0.0) {
            self.slow_down(&slowed(&blurred(thick, BLUR), factor, MOST_SLOWED));
        } else {
            self.weave.span_s *= factor;
        }
        self.dirty.fill(Some(Look::ALL));
        self.stale.fill(true);
    }

    /// Lets each span take so many times as long.
    fn slow_down(&mut self, times: &[f64]) {
        let (spans, lasts_s) = (times.len(), self.weave.span_s * times.iter().sum::<f64>());
        let wanted = (lasts_s / LONGEST_SPAN_S).ceil() as usize;
        let more = if self.weave.span_s < LONGEST_SPAN_S { spans } else { wanted.min(MOST_SPANS).max(spans) };
        self.weave.retime(&moments(times, more));
        self.weave.span_s = lasts_s / more as f64;
        self.travel = Travel::new(self.weave.robots(), more + 3);
        self.contacts.clear();
        self.looked_out = None;
    }

    /// Sends one of each two that do not come past each other elsewhere, in turn and in another direction every time.
    fn kick(&mut self, number: usize) {
        let aside = Vec2::unit(number as f64 * KICK_TURN) * KICK_M;
        let mut kicked = vec![false; self.weave.robots()];
        let contacts = std::mem::take(&mut self.contacts);
        for contact in &contacts {
            let robot = match contact.b {
                Other::Robot(b) if number.is_multiple_of(2) => b,
                _ => contact.a,
            };
            let is_close = self.watch.closest(self.scene, &self.weave, contact).apart < contact.least;
            if !is_close || std::mem::replace(&mut kicked[robot], true) {
                continue;
            }
            let last = self.weave.spans;
            self.remember(robot);
            let way = self.weave.way_mut(robot);
            for (offset, share) in KICK.iter().enumerate() {
                let point = (contact.span + offset).saturating_sub(2);
                if (2..=last).contains(&point) {
                    way[point] += aside * *share;
                }
            }
            self.weave.tie_ends(robot);
            self.travel.follow(robot, &self.before, self.weave.way(robot));
            (self.dirty[robot], self.stale[robot]) = (Some(Look::ALL), true);
        }
        self.contacts = contacts;
    }

    fn remember(&mut self, robot: usize) {
        self.before.clear();
        self.before.extend_from_slice(self.weave.way(robot));
    }

    /// Pulls every robot that changed towards its limits.
    fn slow(&mut self, easings: usize) {
        let off_edge_m = self.scene.off_edge_m.min(self.wish.edge_m);
        let limits = Slow::new(self.scene, &self.weave, off_edge_m, easings);
        for robot in 0..self.dirty.len() {
            if self.scene.cancel.is_wanted() {
                break;
            }
            if let Some(look) = self.dirty[robot] {
                self.remember(robot);
                self.stale[robot] = true;
                self.dirty[robot] = limits.pull(&mut self.weave, robot, look);
                self.travel.follow(robot, &self.before, self.weave.way(robot));
            }
        }
    }

    /// The greatest haste, and how many have too much.
    fn haste(&mut self) -> (f64, usize) {
        for robot in 0..self.haste.len() {
            if std::mem::take(&mut self.stale[robot]) {
                self.haste[robot] = self.weave.haste(robot, &self.scene.limits);
            }
        }
        let greatest = self.haste.iter().copied().fold(0.0, f64::max);
        (greatest, self.haste.iter().filter(|&&haste| haste > GOOD_HASTE).count())
    }

    /// Whether others than those watched may be too close by now.
    fn must_look_out(&mut self, sweep: usize) -> bool {
        let is_due = self
            .looked_out
            .is_none_or(|last| sweep >= last + LOOK_OUT_EVERY && self.travel.since_mark() > LOOK_OUT_MOVED_M);
        if is_due {
            self.looked_out = Some(sweep);
        }
        is_due
    }

    /// Bends whoever is too close, after a new look-out if `anew`, and says how many contacts that were.
    fn bend_all(&mut self, anew: bool) -> usize {
        if anew {
            self.contacts =
                self.watch.look_out(self.scene, &self.weave, self.wish, &self.travel, &self.contacts);
            self.travel.mark(STIR_M);
        }
        let mut contacts = std::mem::take(&mut self.contacts);
        let mut bent = 0;
        for (number, contact) in contacts.iter_mut().enumerate() {
            if number % POLLED == 0 && self.scene.cancel.is_wanted() {
                break;
            }
            contact.is_close = contact.clear_until <= travelled(&self.travel, contact) && self.bend(contact);
            bent += usize::from(contact.is_close);
        }
        self.contacts = contacts;
        bent
    }

    /// Who was too close, each two once, and where they meet.
    fn meetings(&self) -> Vec<Meeting> {
        let close = self.contacts.iter().filter(|contact| contact.is_close).enumerate();
        let close = close.take_while(|(number, _)| number % POLLED != 0 || !self.scene.cancel.is_wanted());
        let of_robots = close.filter_map(|(_, contact)| {
            let Other::Robot(b) = contact.b else { return None };
            let weights = self.watch.closest(self.scene, &self.weave, contact).weights;
            let place = |robot: usize| blend(self.weave.span(robot, contact.span), &weights);
            Some(Meeting { pair: (contact.a, b), place: place(contact.a).lerp(place(b), 0.5) })
        });
        let mut meetings: Vec<Meeting> = of_robots.collect();
        meetings.sort_by_key(|meeting| meeting.pair);
        meetings.dedup_by_key(|meeting| meeting.pair);
        meetings
    }

    /// Bends two robots apart, or one off a wall, if they are too close; else notes for how long they are clear.
    fn bend(&mut self, contact: &mut Contact) -> bool {
        let closest = self.watch.closest(self.scene, &self.weave, contact);
        if closest.apart >= contact.least {
            contact.clear_until = travelled(&self.travel, contact) + closest.apart - contact.least;
            return false;
        }
        contact.clear_until = 0.0;
        let lack = (contact.wish + BEYOND_M - closest.apart) * OVERSHOOT;
        let square = |pull: &[f64; 4]| pull.iter().map(|share| share * share).sum::<f64>();
        let mine = self.weave.pull(contact.a, contact.span, &closest.weights);
        let mut share = 1.0;
        let mut whole = square(&mine);
        if let Other::Robot(b) = contact.b {
            let theirs = self.weave.pull(b, contact.span, &closest.weights);
            let (agile_a, agile_b) = (self.agility(contact.a, contact.span), self.agility(b, contact.span));
            share = agile_a / (agile_a + agile_b);
            whole = whole * share + square(&theirs) * (1.0 - share);
            let force = closest.away * (-lack * (1.0 - share) / whole.max(LEAST_PULL));
            self.move_span(b, contact.span, &theirs, force);
        }
        let force = closest.away * (lack * share / whole.max(LEAST_PULL));
        self.move_span(contact.a, contact.span, &mine, force);
        true
    }

    fn move_span(&mut self, robot: usize, span: usize, pull: &[f64; 4], force: Vec2) {
        self.weave.bend(robot, span, pull, force);
        self.travel.bend(robot, span, pull, force);
        self.stale[robot] = true;
        self.dirty[robot].get_or_insert(Look::NOTHING).add(span);
    }

    /// How easily a robot bends aside: the quicker it is, the less it must turn for that.
    fn agility(&self, robot: usize, span: usize) -> f64 {
        let four = self.weave.span(robot, span);
        let (step, clumsy) = (four[2] - four[1], CLUMSY_MPS * self.weave.span_s);
        step.length_squared() + clumsy * clumsy
    }
}
