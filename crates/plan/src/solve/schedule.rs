//! What is tried in which order, until one way is good enough or the work is used up.

use std::cell::OnceCell;

use lightbots_show::Easing;

use super::Rejected;
use crate::Meeting;
use crate::instance::Instance;
use crate::margins::EDGE_M;
use crate::motion::progress::ProgressLaw;
use crate::optimise::contacts::Clearances;
use crate::optimise::relaxation::{Effort, Relaxation, relax};
use crate::roads::lattice::Lattice;
use crate::roads::shortest::shortest_paths;
use crate::roads::visibility::{MOST_WALLS, VisibilityGraph};
use crate::solve::from_lattice::from_lattice;
use crate::solve::guess::{Guess, Manner};
use crate::solve::path_set::PathSet;
use crate::spline::set::SplineSet;

/// Distance of lattice nodes, metres: robots that follow each other around corners stay 0.83 of it apart.
const PITCH_M: f64 = 0.072;
/// The same, where the first did not do.
const LOOSE_PITCH_M: f64 = 0.078;
/// The same between walls, where neither did: nodes that gaps ask for may be as near as robots may.
const TIGHT_PITCH_M: f64 = 0.0695;
/// Robots times spans times sweeps, and what is resolved in them, for all guesses: some seconds.
const MOST_WORK: usize = 22_000_000;
/// Where this much work is left, a better way is still looked for.
const WORK_TO_SPARE: usize = 14_000_000;
/// The same for all attempts with time to spare, and over lattices.
const PATIENT_WORK: usize = 8_000_000;
const LATTICE_WORK: usize = 18_000_000;
/// So much longer than the least is good enough.
const GOOD: f64 = 1.15;
/// Spans aim at this long, seconds: as long as the smallest bend at full speed takes, and what does for large crowds.
const SPAN_S: f64 = 0.25;
const LONG_SPAN_S: f64 = 0.33;
/// What takes longer than so many times the least, and this more, is not yet good enough to stop at, seconds.
const DECENT: f64 = 4.0;
const DECENT_MORE_S: f64 = 4.0;
/// The same for ways that small crowds found with time to spare: an order learnt on a lattice may be swifter.
const SLUGGISH: f64 = 1.8;
const SLUGGISH_MORE_S: f64 = 1.5;
/// So many pairs in each other's way for each robot are too many.
const HOPELESS: usize = 3;
/// Larger crowds take the first way found.
const MOST_TO_IMPROVE: usize = 600;
/// So do crowds larger than this, if the best guess promises so little that it is given so many times as long.
const MANY: usize = 350;
const LITTLE_PROMISED: f64 = 1.16;
/// Guesses tried where none has led to a way yet, and where one has.
const MOST_TRIES: usize = 8;
const ENOUGH_TRIES: usize = 4;
/// Guesses of large crowds that are compared after so many sweeps, unless one promises enough: no more than so many
/// contacts for each robot.
const RACERS: usize = 2;
const FIRST_SWEEPS: usize = 7;
const PROMISING: usize = 6;
/// The share of its contacts that counts of the one that promised most before.
const HEAD_START: f64 = 0.9;
/// What being like a better guess weighs where there is no time for all, beside [`Guess::badness`].
const ALIKE: f64 = 0.06;
/// How many times as long as the least a way may take.
const MOST_STRETCH: f64 = 2.4;
/// How often a way is amended for single robots, and sweeps for each time.
const AMENDMENTS: usize = 4;
const AMENDING_SWEEPS: usize = 72;
/// What the first guess aims at: room for robots that follow curves with poor sensors on slippery floors.
const ROOMY: Clearances = Clearances { robots_m: 0.0675, walls_m: 0.0115, edge_m: EDGE_M, slack_m: 0.002 };
/// What further guesses aim at, and the lattice, which is not as wide.
const WIDE: Clearances = Clearances { robots_m: 0.0625, walls_m: 0.0075, edge_m: EDGE_M, slack_m: 0.002 };
const NARROW: Clearances = Clearances { robots_m: 0.0595, walls_m: 0.0065, edge_m: EDGE_M, slack_m: 0.0015 };

/// What is aimed at where nothing else led anywhere: hardly more than must be; and that still off the floor's edge.
const TIGHT: Clearances = Clearances { robots_m: 0.0575, walls_m: 0.0033, edge_m: 0.0, slack_m: 0.0002 };
const OFF_EDGE: Clearances = Clearances { edge_m: EDGE_M, ..TIGHT };
/// What is aimed at in gaps that leave robots so much room beside them, the widest first: who waits in front of a narrow
/// gap has room to keep as far from the others as elsewhere, and who follows through it only has to leave later.
const GAPS: [Clearances; 4] =
    [in_gap(0.0065, 0.0005), in_gap(0.005, 0.0005), in_gap(0.004, 0.0005), in_gap(0.0033, 0.0002)];
/// So many times as long as it takes counts a way between walls on which robots come nearer than is wished for where there
/// is room: whoever brakes there is in the way of others at once. Elsewhere there is nothing else to try.
const CLOSE: f64 = 1.25;
/// Driving together, loosening on the way, and loosening first.
const TOGETHER: Manner = Manner { bow: 0.0, early: false, level: false, spread: false, staged: false };
const LOOSE: Manner = Manner { spread: true, ..TOGETHER };
const STAGED: Manner = Manner { staged: true, ..LOOSE };
/// What is tried with time to spare: a manner, how many times as long as the least, at least how many seconds of that,
/// and what is wished for.
const PATIENT: [(Manner, f64, f64, Clearances); 6] = [
    (TOGETHER, 1.5, 1.3, NARROW),
    (LOOSE, 1.5, 1.3, NARROW),
    (STAGED, 1.0, 3.0, NARROW),
    (STAGED, 2.0, 3.0, NARROW),
    (TOGETHER, 4.0, 1.3, TIGHT),
    (STAGED, 4.0, 3.0, TIGHT),
];

/// Robots keep apart, as far as they may be off the walls.
const fn in_gap(walls_m: f64, slack_m: f64) -> Clearances {
    Clearances { robots_m: 0.065, walls_m, slack_m, ..OFF_EDGE }
}

/// Who says whether a splines may be driven.
type Judge<'a> = &'a dyn Fn(SplineSet) -> Result<SplineSet, Rejected>;

/// The swiftest of what was found and is `proven`. Where nothing was, who did not get past each other when fewest were
/// left; empty where it failed for something else.
pub(crate) fn best(instance: &Instance, easing: Easing, proven: Judge) -> Result<SplineSet, Vec<Meeting>> {
    let lattice = Lattice::new(instance, PITCH_M).ok_or_else(Vec::new)?;
    let visibility = OnceCell::new();
    let shortest_paths = shortest_paths(instance, &lattice, &visibility).ok_or_else(Vec::new)?;
    let path_set = PathSet::new(instance, &shortest_paths);
    let least_s = ProgressLaw::new(path_set.longest_m, &instance.limits, easing, 1.0).drive_s;
    let mut attempts =
        Attempts { instance, proven, least_s, work: MOST_WORK, best: Err(Vec::new()), weight: 1.0 };
    // Large crowds seldom have the room to loosen.
    let orderly = attempts.hurry();
    let guesses = guesses(&path_set, easing);
    let promises_little = guesses.first().is_some_and(|guess| guess.stretch() > LITTLE_PROMISED);
    if orderly || (instance.robots() > MANY && promises_little) {
        attempts.race(&guesses);
    }
    if !orderly && !attempts.is_decent() {
        attempts.swift(&guesses);
    }
    for from_lattice in [orderly, !orderly] {
        match from_lattice {
            true if !attempts.is_decent() || (!orderly && attempts.is_sluggish()) => attempts.from_lattice(),
            false if !attempts.is_decent() && !attempts.is_hopeless() => attempts.patient(&path_set, easing),
            _ => {}
        }
    }
    // Between walls what was found with much time to spare is mostly several times as slow.
    if attempts.has_walls() && (attempts.is_sluggish() || attempts.weight > 1.0) {
        attempts.filled(visibility.get_or_init(|| VisibilityGraph::new(instance)));
    }
    attempts.best
}

/// What was found so far, and how much may still be spent.
struct Attempts<'a> {
    instance: &'a Instance<'a>,
    proven: Judge<'a>,
    /// How long the longest way takes at full speed, seconds.
    least_s: f64,
    work: usize,
    best: Result<SplineSet, Vec<Meeting>>,
    /// How many seconds each that the best takes counts.
    weight: f64,
}

impl Attempts<'_> {
    /// In about the least time.
    fn swift(&mut self, guesses: &[Guess]) {
        for (tried, (guess, clearances)) in plain_first(guesses).into_iter().enumerate() {
            let stretch = if tried >= ENOUGH_TRIES { guess.stretch() } else { 1.0 };
            let effort =
                Effort { sweeps: 300, stretch: (MOST_STRETCH / stretch).max(1.8), hurry: false, clearances };
            self.relax(guess.splines(stretch, SPAN_S), effort);
            let enough = tried + 1 >= ENOUGH_TRIES || self.work < WORK_TO_SPARE;
            let good_s = if enough { self.decent_s() } else { self.least_s * GOOD };
            if self.lasts() < good_s {
                break;
            }
        }
    }

    /// The same for large crowds: of some guesses that is gone on with first which is least in its own way after a
    /// few sweeps.
    fn race(&mut self, guesses: &[Guess]) {
        let tried = unlike(guesses);
        // Who is kept from gathering in the middle and early besides has mostly won.
        let is_favourite = tried.first().is_some_and(|first| first.manner.level && first.manner.early);
        let mut tried = tried.into_iter().take(MOST_TRIES).map(|guess| {
            let stretch = guess.stretch();
            let stretches = (MOST_STRETCH / stretch).max(1.8);
            let effort = Effort { sweeps: 300, stretch: stretches, hurry: true, clearances: WIDE };
            (guess.splines(stretch, LONG_SPAN_S), effort)
        });
        let mut racers = Vec::new();
        for (splines, effort) in tried.by_ref().take(RACERS) {
            let mut racer = Relaxation::new(self.instance, splines, effort);
            racer.go_on(FIRST_SWEEPS, &mut self.work);
            let resolved = racer.resolved();
            let head_start = if racers.is_empty() { HEAD_START } else { 1.0 };
            racers.push((resolved as f64 * head_start, racer, effort));
            let is_enough = is_favourite || resolved < self.instance.robots() * PROMISING;
            if is_enough || self.instance.cancel.is_wanted() {
                break;
            }
        }
        racers.sort_by(|(one, ..), (other, ..)| one.total_cmp(other));
        let racers = racers.into_iter().map(|(_, racer, effort)| (racer, effort));
        let late = tried.map(|(splines, effort)| (Relaxation::new(self.instance, splines, effort), effort));
        for (racer, effort) in racers.chain(late) {
            self.finish(racer, effort);
            // Laying out a guess takes long where robots are many, also where there is no work left to relax it.
            if self.is_decent() || self.instance.cancel.is_wanted() {
                break;
            }
        }
    }

    /// With time to spare, in which a crowd may loosen before anybody goes anywhere.
    fn patient(&mut self, path_set: &PathSet, easing: Easing) {
        self.work = self.work.min(PATIENT_WORK);
        for (manner, times, least_s, clearances) in PATIENT {
            let guess = Guess::new(path_set, easing, manner, WIDE.robots_m);
            let lasts_s = guess.least_s().max(least_s) * times;
            let effort = Effort { sweeps: 300, stretch: 1.8, hurry: self.hurry(), clearances };
            self.relax(guess.splines_lasting(lasts_s, SPAN_S), effort);
            if self.is_decent() {
                break;
            }
        }
    }

    /// In an order learnt on a lattice.
    fn from_lattice(&mut self) {
        self.work = LATTICE_WORK;
        let before_s = self.lasts();
        for pitch_m in [PITCH_M, LOOSE_PITCH_M] {
            let effort = Effort { sweeps: 300, stretch: 2.5, hurry: true, clearances: NARROW };
            let splines = Lattice::new(self.instance, pitch_m)
                .and_then(|lattice| from_lattice(self.instance, &lattice));
            if let Some(splines) = splines {
                self.relax(splines, effort);
            }
            if self.lasts() < before_s || self.is_decent() {
                break;
            }
        }
    }

    /// In an order learnt on a lattice that fits between the walls. Who hardly fits where it shall be as far off them as it
    /// can is slow there: the next that is aimed at may be swifter.
    fn filled(&mut self, visibility: &VisibilityGraph) {
        let (before_s, mut is_found) = (self.lasts(), false);
        self.work = self.work.max(LATTICE_WORK / 2);
        for clearances in GAPS {
            self.relax_filled(visibility, PITCH_M, clearances);
            if is_found && !self.is_sluggish() {
                return;
            }
            is_found |= self.lasts() < before_s;
        }
        if !self.is_sluggish() {
            return;
        }
        self.work = self.work.max(LATTICE_WORK / 2);
        for (pitch_m, clearances) in [(PITCH_M, OFF_EDGE), (LOOSE_PITCH_M, OFF_EDGE), (TIGHT_PITCH_M, TIGHT)]
        {
            self.relax_filled(visibility, pitch_m, clearances);
            if self.is_decent() {
                return;
            }
        }
    }

    /// The same over one lattice.
    fn relax_filled(&mut self, visibility: &VisibilityGraph, pitch_m: f64, clearances: Clearances) {
        let lattice = visibility.lattice(self.instance, pitch_m);
        if let Some(splines) = lattice.and_then(|lattice| from_lattice(self.instance, &lattice)) {
            self.relax(splines, Effort { sweeps: 600, stretch: 4.0, hurry: true, clearances });
        }
    }

    /// Whether there are walls, and so few that gaps between them can be looked for.
    fn has_walls(&self) -> bool {
        (1..=MOST_WALLS).contains(&self.instance.walls.len())
    }

    /// Whether the crowd is so large that the first way found does.
    fn hurry(&self) -> bool {
        self.instance.robots() > MOST_TO_IMPROVE
    }

    /// Relaxes a first guess and keeps the better of what comes of it and what there was.
    fn relax(&mut self, splines: SplineSet, effort: Effort) {
        self.finish(Relaxation::new(self.instance, splines, effort), effort);
    }

    /// The same with a relaxation that may have begun.
    fn finish(&mut self, mut relaxation: Relaxation, effort: Effort) {
        relaxation.go_on(effort.sweeps, &mut self.work);
        let found = relaxation
            .outcome()
            .and_then(|splines| amended(self.instance, splines, effort, &mut self.work, self.proven));
        let is_close = self.has_walls() && effort.clearances.robots_m < WIDE.robots_m;
        let weight = if is_close { CLOSE } else { 1.0 };
        let best_s = self.lasts();
        match (&mut self.best, found) {
            (Ok(_), Ok(found)) if lasts(self.instance, &found) * weight >= best_s => {}
            (best, Ok(found)) => (*best, self.weight) = (Ok(found), weight),
            (Err(least), Err(left)) if least.is_empty() || (1..least.len()).contains(&left.len()) => {
                *least = left
            }
            (_, Err(_)) => {}
        }
    }

    /// How long the best takes, seconds, more where robots come close; infinite where there is none.
    fn lasts(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |splines| lasts(self.instance, splines) * self.weight)
    }

    /// What takes longer than this is worth more search, seconds.
    fn decent_s(&self) -> f64 {
        self.least_s * DECENT + DECENT_MORE_S
    }

    fn is_decent(&self) -> bool {
        self.lasts() < self.decent_s()
    }

    /// Whether an order learnt on a lattice may be swifter.
    fn is_sluggish(&self) -> bool {
        self.lasts() > self.least_s * SLUGGISH + SLUGGISH_MORE_S
    }

    /// Whether so many are in each other's way that time alone does not help.
    fn is_hopeless(&self) -> bool {
        self.best.as_ref().is_err_and(|left| left.len() > self.instance.robots() * HOPELESS)
    }
}

/// The splines once the proof holds: single robots that cannot drive as they should get a smoother way, and whoever is in
/// that gives way. Fails as [`best`] does where that does not help.
fn amended(
    instance: &Instance,
    splines: SplineSet,
    effort: Effort,
    work: &mut usize,
    proven: Judge,
) -> Result<SplineSet, Vec<Meeting>> {
    let effort = Effort { sweeps: AMENDING_SWEEPS, stretch: 1.2, ..effort };
    let mut splines = splines;
    for _ in 0..AMENDMENTS {
        let Rejected { splines: mut rejection, faulty_spans } = match proven(splines) {
            Ok(splines) => return Ok(splines),
            Err(rejected) => rejected,
        };
        if faulty_spans.is_empty() {
            return Err(Vec::new());
        }
        faulty_spans.into_iter().for_each(|(robot, span)| rejection.smooth(robot, span));
        splines = relax(instance, rejection, effort, work)?;
    }
    proven(splines).map_err(|_| Vec::new())
}

/// What to try, one after the other. Small crowds may find room for comfort, and most of them do so along plain lines.
fn plain_first<'a, 'b>(guesses: &'b [Guess<'a>]) -> Vec<(&'b Guess<'a>, Clearances)> {
    let wide = guesses.iter().map(|guess| (guess, WIDE));
    let plain = guesses.iter().filter(|guess| guess.manner == Manner::default());
    let mut roomy: Vec<_> = guesses.iter().take(1).chain(plain).map(|guess| (guess, ROOMY)).collect();
    roomy.dedup_by_key(|(guess, _)| guess.manner);
    roomy.into_iter().chain(wide).take(MOST_TRIES).collect()
}

/// The guesses in another order: where one fails, those that differ from it only in how far they bow mostly fail too.
/// Of those that are the same, as who is early is where all ways are equally long, there is one.
fn unlike<'a, 'b>(guesses: &'b [Guess<'a>]) -> Vec<&'b Guess<'a>> {
    let straight = |at: usize| Manner { bow: 0.0, ..guesses[at].manner };
    let is_alike = |at: usize| (0..at).any(|before| straight(before) == straight(at));
    let weigh = |at: usize| guesses[at].badness + if is_alike(at) { ALIKE } else { 0.0 };
    let is_same = |at: usize| (0..at).any(|before| guesses[before].is_like(&guesses[at]));
    let all = (0..guesses.len()).filter(|&at| !is_same(at));
    let mut order: Vec<(f64, usize)> = all.map(|at| (weigh(at), at)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    order.into_iter().map(|(_, at)| &guesses[at]).collect()
}

/// First guesses, the most promising first.
fn guesses<'a>(path_set: &'a PathSet<'a>, easing: Easing) -> Vec<Guess<'a>> {
    let mut guesses: Vec<Guess> = Manner::all()
        .take_while(|_| !path_set.instance.cancel.is_wanted())
        .map(|manner| Guess::new(path_set, easing, manner, ROOMY.robots_m))
        .collect();
    guesses.sort_by(|a, b| a.badness.total_cmp(&b.badness));
    guesses
}

/// How long a splines must take, seconds.
fn lasts(instance: &Instance, splines: &SplineSet) -> f64 {
    splines.least_span_s(&instance.limits) * splines.spans as f64
}
