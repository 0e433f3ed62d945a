//! The deformation of first guesses in space and time. A first guess is a set of splines on which robots may touch.
//! Each sweep displaces robots that are too close (contacts), then projects splines onto the limits of motion. A span
//! is one piece of a spline; all spans last equally long.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::optimise::contacts::{Clearances, Contact, ContactDetector, Other, displacement_m};
use crate::optimise::displacement::Displacement;
use crate::optimise::left_over::LeftOver;
use crate::optimise::neighbours::MOVED_M;
use crate::optimise::stagnation::{Stagnation, growth};
use crate::spline::limits::LimitProjector;
use crate::spline::retime::{moments, smoothed, time_scaled};
use crate::spline::set::{MOST_SPANS, SplineSet};
use crate::spline::turn_rate::DirtySpans;

/// Contacts count as few if there are at most robots / `A_FEW` + 1. Only then are robots in contact perturbed.
const A_FEW: usize = 30;
/// Length of a perturbation, metres: about a robot's diameter.
const PERTURBATION_M: f64 = 0.06;
/// Angle between the directions of two perturbations, radians: not a fraction of a turn, so that none repeats.
const PERTURBATION_TURN: f64 = 2.4;
/// Weights of a perturbation at the eight control points around its contact.
const PERTURBATION: [f64; 8] = [0.25, 0.6, 0.9, 1.0, 1.0, 0.9, 0.6, 0.25];
/// Least number of sweeps from one regular detection of contacts to the next, unless splines are retimed between.
const DETECTION_EVERY: usize = 6;
/// Displacement of a control point since its last mark that makes a detection due, metres: half of `SKIN_M`.
const DETECTION_MOVED_M: f64 = 0.006;
/// Number of passes that smooth the congestion over time before spans are lengthened.
const SMOOTHING: usize = 3;
/// Largest factor on a span's duration in one call of `give_time`.
const MOST_TIME_SCALED: f64 = 1.5;
/// Duration of a span, seconds, above which retiming uses more spans: two contacts in one span cannot be resolved.
const LONGEST_SPAN_S: f64 = 0.36;
/// Distance by which displacements aim beyond the wanted one, metres, because they converge towards their aim.
const BEYOND_M: f64 = 0.0002;
/// Lower bound of the divisor of a displacement: control points with little influence must not move far.
const LEAST_INFLUENCE: f64 = 0.18;
/// Factor by which a displacement overshoots its aim.
const OVERSHOOT: f64 = 1.15;
/// Speed below which differences of speed hardly change which of two robots is displaced farther, m/s.
const CLUMSY_MPS: f64 = 0.1;
/// Most passes that smooth fast turns, in a sweep with at most one contact per robot. Other sweeps make one pass.
const SMOOTHING_PASSES: usize = 8;
/// Time scale below which a solution without contacts needs no further sweeps.
const GOOD_TIME_SCALE: f64 = 1.03;

/// Number of contacts between two polls of the cancellation.
const POLLED: usize = 1024;

/// Bounds on the work and the result of a deformation.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Most sweeps.
    pub sweeps: usize,
    /// Largest duration while more than a few contacts are left, as a multiple of that of the first guess.
    pub stretch: f64,
    /// Whether time is added sooner, and more of it if there are many contacts.
    pub hurry: bool,
    /// Distances that the deformation aims at.
    pub clearances: Clearances,
}

/// Deforms splines until they have no contacts. `Err` has what the detection found that found the fewest contacts. The
/// result may be too fast: its duration must be multiplied by [`SplineSet::greatest_time_scale`].
pub(crate) fn relax(
    instance: &Instance,
    splines: SplineSet,
    effort: Effort,
    work: &mut usize,
) -> Result<SplineSet, LeftOver> {
    let mut relaxation = Relaxation::new(instance, splines, effort);
    relaxation.go_on(effort.sweeps, work);
    relaxation.outcome()
}

/// A deformation that can be paused.
pub(crate) struct Relaxation<'a> {
    state: State<'a>,
    effort: Effort,
    /// Largest duration while more than a few contacts are left, seconds.
    longest_s: f64,
    stagnation: Stagnation,
    sweep: usize,
    perturbations: usize,
    is_over: bool,
    /// Number of contacts in the last sweep; `usize::MAX` before the first.
    resolved: usize,
    /// The fastest splines without contacts, and their duration, seconds.
    best: Option<(f64, SplineSet)>,
    fewest: usize,
    left_over: LeftOver,
}

impl<'a> Relaxation<'a> {
    /// A deformation that has not begun.
    pub fn new(instance: &'a Instance<'a>, splines: SplineSet, effort: Effort) -> Self {
        Self {
            longest_s: splines.lasts_s() * effort.stretch,
            state: State::new(instance, splines, effort.clearances),
            effort,
            stagnation: Stagnation::new(effort.hurry),
            sweep: 0,
            perturbations: 0,
            is_over: false,
            resolved: usize::MAX,
            best: None,
            fewest: usize::MAX,
            left_over: LeftOver::default(),
        }
    }

    /// Makes at most `sweeps` sweeps, and subtracts their work from `work` while it suffices for a sweep.
    pub fn go_on(&mut self, sweeps: usize, work: &mut usize) {
        for _ in 0..sweeps {
            let cost = self.state.splines.robots() * self.state.splines.spans;
            let Some(left) =
                work.checked_sub(cost).filter(|_| !self.is_over && !self.state.instance.cancel.is_wanted())
            else {
                break;
            };
            *work = left;
            self.is_over = !self.sweep() || self.sweep == self.effort.sweeps;
            *work = work.saturating_sub(self.resolved);
        }
    }

    /// Returns the number of contacts in the last sweep; `usize::MAX` before the first.
    pub fn resolved(&self) -> usize {
        self.resolved
    }

    /// Returns the fastest splines without contacts. `Err` has what the detection found that found the fewest contacts.
    pub fn outcome(self) -> Result<SplineSet, LeftOver> {
        self.best.map(|(_, splines)| splines).ok_or(self.left_over)
    }

    /// Makes one sweep. Returns whether another sweep may help.
    fn sweep(&mut self) -> bool {
        let anew = self.state.is_detection_due(self.sweep);
        self.sweep += 1;
        let resolved = self.state.resolve_all(anew);
        self.resolved = resolved;
        if self.state.instance.cancel.is_wanted() {
            return false;
        }
        if anew && (1..self.fewest).contains(&resolved) {
            (self.fewest, self.left_over) = (resolved, self.state.left_over());
        }
        let (time_scale, too_fast) = if resolved == 0 { self.state.time_scale() } else { (f64::MAX, 0) };
        let lasts_s = self.state.splines.lasts_s() * time_scale;
        let is_best = resolved == 0 && self.best.as_ref().is_none_or(|(best_s, _)| lasts_s < *best_s);
        if is_best && self.state.resolve_all(true) == 0 {
            self.best = Some((lasts_s, self.state.splines.clone()));
            if time_scale < GOOD_TIME_SCALE {
                return false;
            }
        }
        let robots = self.state.splines.robots();
        let few = robots / A_FEW + 1;
        if self.stagnation.is_stagnant(resolved + too_fast, resolved <= few) {
            if resolved > 0 && resolved <= few {
                self.perturbations += 1;
                self.state.perturb(self.perturbations);
            }
            if self.state.instance.cancel.is_wanted() {
                return false;
            }
            self.state.give_time(growth(self.effort.hurry, resolved, few, robots));
            let most_s = self.best.as_ref().map_or(self.longest_s, |(best_s, _)| *best_s);
            if self.state.splines.lasts_s() > most_s && (self.best.is_some() || resolved > few) {
                return false;
            }
        }
        self.state.project_limits(if resolved > robots { 1 } else { SMOOTHING_PASSES });
        true
    }
}

struct State<'a> {
    instance: &'a Instance<'a>,
    splines: SplineSet,
    clearances: Clearances,
    detector: ContactDetector,
    contacts: Vec<Contact>,
    /// Index of the sweep with the last regular detection; `None` if there was none since the last retiming.
    detected_at: Option<usize>,
    displacement: Displacement,
    /// `[robot]`: spans to project onto the turn rate limit; `None` if its spline needs no projection.
    dirty: Vec<Option<DirtySpans>>,
    /// `[robot]`: whether `time_scale` is out of date.
    stale: Vec<bool>,
    time_scale: Vec<f64>,
    /// Buffer for a spline before it changes.
    before: Vec<Vec2>,
}

impl<'a> State<'a> {
    fn new(instance: &'a Instance<'a>, splines: SplineSet, clearances: Clearances) -> Self {
        let robots = splines.robots();
        Self {
            instance,
            clearances,
            detector: ContactDetector::new(),
            contacts: Vec::new(),
            detected_at: None,
            displacement: Displacement::new(robots, splines.spans + 3),
            splines,
            dirty: vec![Some(DirtySpans::ALL); robots],
            stale: vec![true; robots],
            time_scale: vec![0.0; robots],
            before: Vec::new(),
        }
    }

    /// Multiplies the duration by `factor`, or by less if [`MOST_TIME_SCALED`] limits the spans with most contacts.
    /// Additional time goes to and beside spans with contacts, if any.
    fn give_time(&mut self, factor: f64) {
        let mut congestion = vec![0.0; self.splines.spans];
        for contact in self.contacts.iter().filter(|contact| contact.is_close) {
            congestion[contact.span] += 1.0;
        }
        if congestion.iter().any(|&contacts| contacts > 0.0) {
            self.scale_spans(&time_scaled(&smoothed(congestion, SMOOTHING), factor, MOST_TIME_SCALED));
        } else {
            self.splines.span_s *= factor;
        }
        self.dirty.fill(Some(DirtySpans::ALL));
        self.stale.fill(true);
    }

    /// Multiplies the duration of span k by `times[k]`, and divides the duration into equal spans again.
    fn scale_spans(&mut self, times: &[f64]) {
        let (spans, lasts_s) = (times.len(), self.splines.span_s * times.iter().sum::<f64>());
        let wanted = (lasts_s / LONGEST_SPAN_S).ceil() as usize;
        let more =
            if self.splines.span_s < LONGEST_SPAN_S { spans } else { wanted.min(MOST_SPANS).max(spans) };
        self.splines.retime(&moments(times, more));
        self.splines.span_s = lasts_s / more as f64;
        self.displacement = Displacement::new(self.splines.robots(), more + 3);
        self.contacts.clear();
        self.detected_at = None;
    }

    /// Displaces one robot of each pair in contact, each robot at most once. From one `number` to the next, the
    /// direction changes, and pairs of robots alternate between their two robots.
    fn perturb(&mut self, number: usize) {
        let aside = Vec2::unit(number as f64 * PERTURBATION_TURN) * PERTURBATION_M;
        let mut perturbed = vec![false; self.splines.robots()];
        let contacts = std::mem::take(&mut self.contacts);
        for contact in &contacts {
            let robot = match contact.b {
                Other::Robot(b) if number.is_multiple_of(2) => b,
                _ => contact.a,
            };
            let is_close = self.detector.closest(self.instance, &self.splines, contact).apart < contact.least;
            if !is_close || std::mem::replace(&mut perturbed[robot], true) {
                continue;
            }
            let last = self.splines.spans;
            self.remember(robot);
            let way = self.splines.spline_mut(robot);
            for (offset, share) in PERTURBATION.iter().enumerate() {
                let point = (contact.span + offset).saturating_sub(2);
                if (2..=last).contains(&point) {
                    way[point] += aside * *share;
                }
            }
            self.splines.tie_ends(robot);
            self.displacement.follow(robot, &self.before, self.splines.spline(robot));
            (self.dirty[robot], self.stale[robot]) = (Some(DirtySpans::ALL), true);
        }
        self.contacts = contacts;
    }

    fn remember(&mut self, robot: usize) {
        self.before.clear();
        self.before.extend_from_slice(self.splines.spline(robot));
    }

    /// Projects the spline of every changed robot onto the limits of its motion.
    fn project_limits(&mut self, easings: usize) {
        let off_edge_m = self.instance.off_edge_m.min(self.clearances.edge_m);
        let limits = LimitProjector::new(self.instance, &self.splines, off_edge_m, easings);
        for robot in 0..self.dirty.len() {
            if self.instance.cancel.is_wanted() {
                break;
            }
            if let Some(dirty) = self.dirty[robot] {
                self.remember(robot);
                self.stale[robot] = true;
                self.dirty[robot] = limits.project(&mut self.splines, robot, dirty);
                self.displacement.follow(robot, &self.before, self.splines.spline(robot));
            }
        }
    }

    /// The greatest time scale of all robots, and the number of robots above [`GOOD_TIME_SCALE`].
    fn time_scale(&mut self) -> (f64, usize) {
        for robot in 0..self.time_scale.len() {
            if std::mem::take(&mut self.stale[robot]) {
                self.time_scale[robot] = self.splines.time_scale(robot, &self.instance.limits);
            }
        }
        let greatest = self.time_scale.iter().copied().fold(0.0, f64::max);
        (greatest, self.time_scale.iter().filter(|&&time_scale| time_scale > GOOD_TIME_SCALE).count())
    }

    /// Whether pairs outside `contacts` may be too close, because robots have moved. If so, sets `detected_at`.
    fn is_detection_due(&mut self, sweep: usize) -> bool {
        let is_due = self.detected_at.is_none_or(|last| {
            sweep >= last + DETECTION_EVERY && self.displacement.since_mark() > DETECTION_MOVED_M
        });
        if is_due {
            self.detected_at = Some(sweep);
        }
        is_due
    }

    /// Displaces all pairs that are too close, after a new detection if `anew`. Returns their number over all spans.
    fn resolve_all(&mut self, anew: bool) -> usize {
        if anew {
            self.contacts = self.detector.detect(
                self.instance,
                &self.splines,
                self.clearances,
                &self.displacement,
                &self.contacts,
            );
            self.displacement.mark(MOVED_M);
        }
        let mut contacts = std::mem::take(&mut self.contacts);
        let mut resolved = 0;
        for (number, contact) in contacts.iter_mut().enumerate() {
            if number % POLLED == 0 && self.instance.cancel.is_wanted() {
                break;
            }
            contact.is_close =
                contact.clear_until <= displacement_m(&self.displacement, contact) && self.resolve(contact);
            resolved += usize::from(contact.is_close);
        }
        self.contacts = contacts;
        resolved
    }

    /// Returns the pairs that were too close at the last check.
    fn left_over(&self) -> LeftOver {
        let close = self.contacts.iter().filter(|contact| contact.is_close).enumerate();
        let close = close.take_while(|(number, _)| number % POLLED != 0 || !self.instance.cancel.is_wanted());
        LeftOver::of(close.map(|(_, contact)| contact), |contact, b| {
            let weights = self.detector.closest(self.instance, &self.splines, contact).weights;
            let place = |robot: usize| self.splines.place(robot, contact.span, &weights);
            place(contact.a).lerp(place(b), 0.5)
        })
    }

    /// Displaces two robots, or one robot away from a wall, if they are too close, and returns whether they were.
    /// Otherwise records the displacement up to which the pair counts as clear.
    fn resolve(&mut self, contact: &mut Contact) -> bool {
        let closest = self.detector.closest(self.instance, &self.splines, contact);
        if closest.apart >= contact.least {
            contact.clear_until = displacement_m(&self.displacement, contact) + closest.apart - contact.least;
            return false;
        }
        contact.clear_until = 0.0;
        let lack = (contact.wanted + BEYOND_M - closest.apart) * OVERSHOOT;
        let square = |influence: &[f64; 4]| influence.iter().map(|share| share * share).sum::<f64>();
        let mine = self.splines.influence(contact.a, contact.span, &closest.weights);
        let mut share = 1.0;
        let mut whole = square(&mine);
        if let Other::Robot(b) = contact.b {
            let theirs = self.splines.influence(b, contact.span, &closest.weights);
            let (agile_a, agile_b) = (self.agility(contact.a, contact.span), self.agility(b, contact.span));
            share = agile_a / (agile_a + agile_b);
            whole = whole * share + square(&theirs) * (1.0 - share);
            let force = closest.away * (-lack * (1.0 - share) / whole.max(LEAST_INFLUENCE));
            self.move_span(b, contact.span, &theirs, force);
        }
        let force = closest.away * (lack * share / whole.max(LEAST_INFLUENCE));
        self.move_span(contact.a, contact.span, &mine, force);
        true
    }

    fn move_span(&mut self, robot: usize, span: usize, influence: &[f64; 4], force: Vec2) {
        self.splines.displace(robot, span, influence, force);
        self.displacement.displace(robot, span, influence, force);
        self.stale[robot] = true;
        self.dirty[robot].get_or_insert(DirtySpans::NOTHING).add(span);
    }

    /// Weight of a robot's share in a displacement: a fast robot needs less turn to be displaced, so it moves farther.
    fn agility(&self, robot: usize, span: usize) -> f64 {
        let four = self.splines.span(robot, span);
        let (step, clumsy) = (four[2] - four[1], CLUMSY_MPS * self.splines.span_s);
        step.length_squared() + clumsy * clumsy
    }
}
