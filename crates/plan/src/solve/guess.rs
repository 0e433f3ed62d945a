//! First guesses: all robots follow their shortest paths in one [`Manner`], and may touch. A deformation separates them
//! later. In this file, `moment` is a share of the drive's duration, 0 to 1.

use lightbots_base::Vec2;
use lightbots_show::Easing;

use crate::motion::progress::ProgressLaw;
use crate::optimise::cells::Cells;
use crate::solve::path_set::{PathSet, crowding, point_along};
use crate::spline::retime::{moments, time_scaled};
use crate::spline::set::{MOST_SPANS, SplineSet};

/// The bows of all guesses, as shares of the length of a line: positive to the right, negative to the left.
const BOWS: [f64; 5] = [0.0, 0.12, 0.25, 0.5, -0.12];
/// Share of the duration in which a dense fleet spreads at the start. It gathers in an equal share at the end.
const LOOSENED: f64 = 0.3;
/// Ratio of the top speed to the mean speed of a robot while the fleet spreads.
const GENTLE: f64 = 1.5;
/// Number of equal steps of the duration, between which congestion is measured.
const SAMPLES: usize = 16;
/// Weight of excess speed in the badness of a guess. Congestion has the weight 1.
const RUSH: f64 = 0.03;
/// Penalty on the badness of a guess for each of `early`, `level` and `spread` that its manner has.
const ODD: f64 = 0.005;
/// Largest badness of a guess that is expected to need no additional time.
const EASY: f64 = 0.1;
/// Additional time for each unit of badness above [`EASY`], as a share of the least duration.
const STRETCH: f64 = 4.0;
/// Most additional time of a guess, as a share of the least duration. Fleets of 1,000 robots mostly need more. The
/// deformation adds it at better moments than a guess can.
const MOST_STRETCH: f64 = 0.4;
/// Number of parts into which the time between two measurements of congestion is divided for retiming.
const PARTS: usize = 16;

/// How robots follow their shortest paths. By default, all robots have driven the same share of their paths at each
/// moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Manner {
    /// Sideways bow of straight lines, as a share of their length: to the right, or to the left if negative. With it,
    /// robots that meet head-on pass each other.
    pub bow: f64,
    /// Whether all robots drive equally fast, so that robots with short paths arrive early. Then fewer robots meet at a
    /// time where paths cross.
    pub early: bool,
    /// Whether robots are kept from gathering in the middle of the fleet.
    pub level: bool,
    /// Whether a dense fleet spreads after the start and gathers before the end, while robots drive along their paths.
    pub spread: bool,
    /// With `spread`: whether the fleet spreads before any robot drives along its path, and gathers only after all have
    /// arrived.
    pub staged: bool,
}

impl Manner {
    /// All manners that guesses in minimum time try.
    pub fn all() -> impl Iterator<Item = Self> {
        let flags = [false, true];
        let loose = flags.into_iter().flat_map(move |spread| flags.map(|level| (spread, level)));
        let timed = loose.flat_map(move |(spread, level)| flags.map(|early| (spread, level, early)));
        timed.flat_map(|(spread, level, early)| {
            BOWS.map(|bow| Self { bow, early, level, spread, staged: false })
        })
    }
}

/// A first guess: the shortest paths of all robots in one manner.
pub(crate) struct Guess<'a> {
    path_set: &'a PathSet<'a>,
    pub manner: Manner,
    progress: ProgressLaw,
    /// Measure by which guesses are ranked: congestion, excess speed and the penalty of its manner. Less is better.
    pub badness: f64,
    /// The badness without the penalty of the manner.
    plain_badness: f64,
    /// `[sample]`: congestion after that many of [`SAMPLES`] equal steps of the duration; 0 at the start and at the
    /// end.
    congestion: [f64; SAMPLES + 1],
}

impl<'a> Guess<'a> {
    /// The guess of a manner. Pairs of robots with centres closer than `near_m` metres count as congestion.
    pub fn new(path_set: &'a PathSet<'a>, easing: Easing, manner: Manner, near_m: f64) -> Self {
        let longer = 1.0 + 2.0 * manner.bow * manner.bow;
        let progress = ProgressLaw::new(path_set.longest_m, &path_set.instance.limits, easing, longer);
        let congestion = [0.0; SAMPLES + 1];
        let mut guess = Self { path_set, manner, progress, badness: 0.0, plain_badness: 0.0, congestion };
        (guess.plain_badness, guess.congestion) = guess.judged(near_m);
        let Manner { bow, early, level, spread, .. } = manner;
        let odd = [early, level, spread].into_iter().filter(|&is| is).count() as f64 * ODD + bow * bow;
        guess.badness = guess.plain_badness + odd;
        guess
    }

    /// Whether another guess counts as having the same trajectories: its manner differs at most in `early`, and its
    /// badness without penalty is equal.
    pub fn is_like(&self, other: &Self) -> bool {
        let timed = |guess: &Self| Manner { early: true, ..guess.manner };
        timed(self) == timed(other) && (self.plain_badness - other.plain_badness).abs() < 1e-6
    }

    /// Returns the guess as splines with spans of about `span_s` seconds, but with 6 to [`MOST_SPANS`] spans. They last
    /// `stretch` times as long as at full speed. Moments with congestion get more of the additional time.
    pub fn splines(&self, stretch: f64, span_s: f64) -> SplineSet {
        let parts = SAMPLES * PARTS;
        let congestion = (0..parts).map(|part| {
            let (sample, within) = (part / PARTS, ((part % PARTS) as f64 + 0.5) / PARTS as f64);
            self.congestion[sample] * (1.0 - within) + self.congestion[sample + 1] * within
        });
        let lasts = time_scaled(&congestion.collect::<Vec<_>>(), stretch, f64::INFINITY);
        self.splines_through(self.progress.drive_s * stretch, span_s, |spans| {
            moments(&lasts, spans).into_iter().map(|moment| moment / parts as f64).collect()
        })
    }

    /// Returns the guess as splines that last `drive_s` seconds, with spans of about `span_s` seconds, but with 6 to
    /// [`MOST_SPANS`] spans.
    pub fn splines_lasting(&self, drive_s: f64, span_s: f64) -> SplineSet {
        let evenly = |spans: usize| (0..=spans).map(|step| step as f64 / spans as f64).collect();
        self.splines_through(drive_s, span_s, evenly)
    }

    /// Returns the guess as splines whose control points are the robots' places at `moments(spans)`. These are shares
    /// of the duration, one more than there are spans.
    fn splines_through(&self, drive_s: f64, span_s: f64, moments: impl Fn(usize) -> Vec<f64>) -> SplineSet {
        let spans = ((drive_s / span_s).ceil() as usize).clamp(6, MOST_SPANS);
        let places: Vec<Vec<Vec2>> =
            moments(spans).into_iter().map(|moment| self.free_places(moment)).collect();
        SplineSet::new(self.path_set.instance, spans, drive_s / spans as f64, |robot, step| {
            places[step][robot]
        })
    }

    /// Returns the factor on the least duration that a guess of this badness is expected to need, at most 1 +
    /// [`MOST_STRETCH`].
    pub fn stretch(&self) -> f64 {
        1.0 + ((self.badness - EASY) * STRETCH).clamp(0.0, MOST_STRETCH)
    }

    /// Least duration of the drive in this manner, seconds.
    pub fn least_s(&self) -> f64 {
        if self.manner.staged {
            let out_s = GENTLE * self.path_set.farthest_loosened() / self.path_set.instance.limits.speed_mps;
            (self.progress.drive_s / (1.0 - 2.0 * LOOSENED)).max(out_s / LOOSENED)
        } else {
            self.progress.drive_s
        }
    }

    /// Returns the share of the longest path that is done at `moment`.
    fn share(&self, moment: f64) -> f64 {
        let within = (moment - LOOSENED) / (1.0 - 2.0 * LOOSENED);
        let moment = if self.manner.staged { within.clamp(0.0, 1.0) } else { moment };
        self.progress.share(moment * self.progress.drive_s)
    }

    /// Places of all robots at `moment`, stage metres.
    fn places(&self, moment: f64) -> Vec<Vec2> {
        let share = self.share(moment);
        let mut places: Vec<Vec2> =
            (0..self.path_set.paths.len()).map(|robot| self.place(robot, share)).collect();
        if self.manner.level {
            self.path_set.level(&mut places, share);
        }
        if self.manner.spread {
            let ebb = (moment.min(1.0 - moment) / LOOSENED).clamp(0.0, 1.0);
            self.path_set.loosen(&mut places, ebb * ebb * (3.0 - 2.0 * ebb));
        }
        places
    }

    /// Returns [`Self::places`]. On a floor with walls, a robot that would be in a wall or off the floor is put on its
    /// shortest path instead.
    fn free_places(&self, moment: f64) -> Vec<Vec2> {
        let mut places = self.places(moment);
        if !self.path_set.instance.walls.is_empty() {
            let share = self.share(moment);
            for (robot, place) in places.iter_mut().enumerate() {
                if !self.path_set.instance.is_free(*place, 0.0) {
                    let (path, length) = (&self.path_set.paths[robot], self.path_set.lengths[robot]);
                    *place = point_along(path, length * self.share_of(robot, share));
                }
            }
        }
        places
    }

    /// Returns the share of the robot's own path that is done when the share `share` of the longest path is done.
    fn share_of(&self, robot: usize, share: f64) -> f64 {
        let length = self.path_set.lengths[robot];
        if self.manner.early && length > 0.0 {
            (share * self.path_set.longest_m / length).min(1.0)
        } else {
            share
        }
    }

    /// Returns a robot's place when the share `share` of the longest path is done, with the bow of its manner, stage
    /// metres.
    fn place(&self, robot: usize, share: f64) -> Vec2 {
        let (path, length) = (&self.path_set.paths[robot], self.path_set.lengths[robot]);
        let share = self.share_of(robot, share);
        let place = point_along(path, length * share);
        // The bow begins and ends in the direction of the line: 16 s²(1 − s)² is 1 half way.
        let aside = 16.0 * (share * (1.0 - share)) * (share * (1.0 - share)) * self.manner.bow;
        match path[..] {
            [from, to] if aside != 0.0 => {
                let instance = self.path_set.instance;
                instance.on_floor(robot, place - (to - from).left() * aside, instance.off_edge_m)
            }
            _ => place,
        }
    }

    /// Returns the badness without the penalty of the manner, and the congestion at each measured moment.
    fn judged(&self, near_m: f64) -> (f64, [f64; SAMPLES + 1]) {
        let robots = self.path_set.paths.len().max(1) as f64;
        let step_m = self.path_set.instance.limits.speed_mps * self.progress.drive_s / SAMPLES as f64;
        let mut rush = vec![0.0_f64; self.path_set.paths.len()];
        let (mut congestion, mut before, mut cells) =
            ([0.0; SAMPLES + 1], self.places(0.0), Cells::default());
        for (sample, congestion) in congestion.iter_mut().enumerate().skip(1) {
            let places = self.places(sample as f64 / SAMPLES as f64);
            for (robot, most) in rush.iter_mut().enumerate() {
                *most = most.max(places[robot].distance(before[robot]) / step_m - 1.0);
            }
            *congestion = if sample < SAMPLES { crowding(&mut cells, &places, near_m) } else { 0.0 };
            before = places;
        }
        let close = congestion.iter().sum::<f64>() / (SAMPLES as f64 * robots);
        (close + rush.iter().sum::<f64>() / robots * RUSH, congestion)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::instance::Instance;
    use lightbots_base::Limits;

    #[test]
    fn an_early_guess_is_like_the_plain_one_unless_a_drive_is_shorter() {
        for (last_m, is_alike) in [(0.4, true), (0.2, false)] {
            let starts: Vec<Vec2> = (0..4).map(|i| Vec2::new(-0.2, f64::from(i) * 0.1)).collect();
            let mut paths: Vec<Vec<Vec2>> =
                starts.iter().map(|&at| vec![at, at + Vec2::new(0.4, 0.0)]).collect();
            paths[3][1].x = last_m - 0.2;
            let floor = TransitionProblem::on_floor(Vec2::new(0.6, 0.6), Limits::ELISA_3);
            let instance = Instance::new(&TransitionProblem { starts, ..floor }, &[None; 4]).unwrap();
            let path_set = PathSet::new(&instance, &paths);
            let guess = |manner| Guess::new(&path_set, Easing::Swift, manner, 0.12);
            let (plain, early) =
                (guess(Manner::default()), guess(Manner { early: true, ..Manner::default() }));
            assert_eq!(plain.is_like(&early), is_alike);
            assert!(!plain.is_like(&guess(Manner { bow: 0.25, ..Manner::default() })));
        }
    }
}
