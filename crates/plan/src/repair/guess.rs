//! The first guess: everybody drives their shortest way with common progress, through each other if need be.

use lightbots_base::{Limits, Vec2};
use lightbots_show::Easing;

use super::scene::Scene;
use super::weave::Weave;

/// Spans aim at this long, seconds: as long as the smallest bend at full speed takes.
const SPAN_S: f64 = 0.25;
/// By how much guesses bow.
const BOWS: [f64; 5] = [0.0, 0.12, 0.25, 0.5, -0.12];
/// What being too fast weighs beside being too close, and what every other oddity does.
const RUSH: f64 = 0.03;
const ODD: f64 = 0.015;
/// Badness that needs no more time, how much more time what is worse needs, and the most.
const EASY: f64 = 0.1;
const STRETCH: f64 = 10.0;
const MOST_STRETCH: f64 = 1.0;
/// How much of the way to an even spread a crowd is taken.
const LEVELLED: f64 = 0.6;
/// Share of the time in which a tight crowd becomes loose, and tight again at the end.
const LOOSENED: f64 = 0.3;
/// How far apart robots of a loose crowd are, metres.
const LOOSE_M: f64 = 0.14;
/// Moments at which a guess is looked at.
const SAMPLES: usize = 16;
/// Spans a weave may have: a path holds 128 pieces.
pub(super) const MOST_SPANS: usize = 124;

/// How far everybody is at each moment, for a longest way.
pub(super) struct Pace {
    /// From start to end, seconds.
    pub drive_s: f64,
    ramp_s: f64,
}

impl Pace {
    /// The swiftest, or gentlest, for a longest way, stretched by `stretch`.
    pub fn new(longest_m: f64, limits: &Limits, easing: Easing, stretch: f64) -> Self {
        let (speed, accel) = (limits.speed_mps, limits.accel_mps2);
        let halves = 2.0 * (longest_m / accel).sqrt();
        let least = match easing {
            Easing::Swift if longest_m > speed * speed / accel => longest_m / speed + speed / accel,
            Easing::Swift => halves,
            Easing::Gentle => halves.max(2.0 * longest_m / speed),
        };
        let drive_s = least.max(0.4) * stretch;
        let ramp_s = match easing {
            Easing::Swift => (speed / accel).min(drive_s / 2.0),
            Easing::Gentle => drive_s / 2.0,
        };
        Self { drive_s, ramp_s }
    }

    /// The share of the way done after `t` seconds.
    pub fn share(&self, t: f64) -> f64 {
        let top = 1.0 / (self.drive_s - self.ramp_s);
        let ramp = |t: f64| top * t * t / (2.0 * self.ramp_s);
        if t <= 0.0 {
            0.0
        } else if t < self.ramp_s {
            ramp(t)
        } else if t <= self.drive_s - self.ramp_s {
            top * (t - self.ramp_s / 2.0)
        } else {
            1.0 - ramp((self.drive_s - t).max(0.0))
        }
    }
}

/// How everybody gets along their course at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Manner {
    /// Straight courses bow to the right by this share of their length, to the left where it is negative, so that
    /// crowds that meet head-on pass each other.
    pub bow: f64,
    /// Whether all drive equally fast and who has a short way arrives early, instead of all arriving together.
    pub early: bool,
    /// Whether the crowd is kept from gathering in the middle: see [`level`].
    pub level: bool,
    /// Whether a tight crowd loosens on its way.
    pub spread: bool,
}

impl Manner {
    /// All that are worth a look.
    pub fn all() -> impl Iterator<Item = Self> {
        let flags = [false, true];
        let loose = flags.into_iter().flat_map(move |spread| flags.map(|level| (spread, level)));
        let timed = loose.flat_map(move |(spread, level)| flags.map(|early| (spread, level, early)));
        timed.flat_map(|(spread, level, early)| BOWS.map(|bow| Self { bow, early, level, spread }))
    }
}

/// A first guess: through each other if need be.
pub(super) struct Guess<'a> {
    scene: &'a Scene,
    courses: &'a [Vec<Vec2>],
    lengths: Vec<f64>,
    longest_m: f64,
    pub manner: Manner,
    pace: Pace,
    /// How little it promises.
    pub badness: f64,
    /// The middle of the crowd, and how much wider it becomes half way along each axis.
    middle: Vec2,
    wider: Vec2,
}

impl<'a> Guess<'a> {
    /// The guess of a manner.
    pub fn new(scene: &'a Scene, courses: &'a [Vec<Vec2>], easing: Easing, manner: Manner, near_m: f64) -> Self {
        let lengths: Vec<f64> = courses.iter().map(|course| length(course)).collect();
        let longest_m = lengths.iter().copied().fold(0.0, f64::max);
        let pace = Pace::new(longest_m, &scene.limits, easing, 1.0 + 2.0 * manner.bow * manner.bow);
        let (middle, wider) = wider(scene, courses);
        let mut guess = Self { scene, courses, lengths, longest_m, manner, pace, badness: 0.0, middle, wider };
        guess.badness = guess.judged(near_m);
        guess
    }

    /// The guess as a weave, `stretch` times as slow as at full speed.
    pub fn weave(&self, stretch: f64) -> Weave {
        let drive_s = self.pace.drive_s * stretch;
        let spans = ((drive_s / SPAN_S).ceil() as usize).clamp(6, MOST_SPANS);
        let span_s = drive_s / spans as f64;
        let places: Vec<Vec<Vec2>> = (0..=spans).map(|step| self.places(step as f64 / spans as f64)).collect();
        Weave::new(self.scene, spans, span_s, |robot, step| places[step][robot])
    }

    /// How many times as long as at full speed it shall take, so that the crowd can give way.
    pub fn stretch(&self) -> f64 {
        1.0 + ((self.badness - EASY) * STRETCH).clamp(0.0, MOST_STRETCH)
    }

    /// Where everybody is after a share of the time.
    fn places(&self, moment: f64) -> Vec<Vec2> {
        let share = self.pace.share(moment * self.pace.drive_s);
        let mut places: Vec<Vec2> = (0..self.courses.len()).map(|robot| self.place(robot, share)).collect();
        if self.manner.level {
            self.level(&mut places, share);
        }
        if self.manner.spread {
            let ebb = (moment.min(1.0 - moment) / LOOSENED).min(1.0);
            let ebb = ebb * ebb * (3.0 - 2.0 * ebb);
            for (robot, place) in places.iter_mut().enumerate() {
                let out = *place - self.middle;
                let aside = Vec2::new(out.x * (self.wider.x - 1.0), out.y * (self.wider.y - 1.0));
                *place = self.scene.on_floor(robot, *place + aside * ebb);
            }
        }
        places
    }

    fn place(&self, robot: usize, share: f64) -> Vec2 {
        let (course, length) = (&self.courses[robot], self.lengths[robot]);
        let share = match self.manner.early {
            true if length > 0.0 => (share * self.longest_m / length).min(1.0),
            _ => share,
        };
        let place = point_along(course, length * share);
        // A bow that begins and ends straight ahead: 16 s²(1 − s)² is 1 half way.
        let aside = 16.0 * (share * (1.0 - share)) * (share * (1.0 - share)) * self.manner.bow;
        match course[..] {
            [from, to] if aside != 0.0 => self.scene.on_floor(robot, place - (to - from).left() * aside),
            _ => place,
        }
    }

    /// Spreads a crowd along both axes, most of the way to being spread as its starts and ends are: by rank, from
    /// where the one of that rank starts to where the one of that rank ends.
    fn level(&self, places: &mut [Vec2], share: f64) {
        let x: (fn(Vec2) -> f64, fn(&mut Vec2) -> &mut f64) = (|place| place.x, |place| &mut place.x);
        let y: (fn(Vec2) -> f64, fn(&mut Vec2) -> &mut f64) = (|place| place.y, |place| &mut place.y);
        for (of, part) in [x, y] {
            let sorted = |ends: &mut dyn Iterator<Item = Vec2>| {
                let mut along: Vec<f64> = ends.map(of).collect();
                along.sort_unstable_by(f64::total_cmp);
                along
            };
            let starts = sorted(&mut self.courses.iter().map(|course| course[0]));
            let ends = sorted(&mut self.courses.iter().map(|course| course[course.len() - 1]));
            let mut order: Vec<usize> = (0..places.len()).collect();
            order.sort_unstable_by(|&a, &b| of(places[a]).total_cmp(&of(places[b])).then(a.cmp(&b)));
            for (rank, &robot) in order.iter().enumerate() {
                let even = starts[rank] * (1.0 - share) + ends[rank] * share;
                let at = part(&mut places[robot]);
                *at += (even - *at) * LEVELLED;
            }
        }
    }

    /// How bad the guess is: how much of others is in everybody's way, by pairs closer than `near_m`, and how much too
    /// fast everybody is at their fastest.
    fn judged(&self, near_m: f64) -> f64 {
        let robots = self.courses.len().max(1) as f64;
        let step_m = self.scene.limits.speed_mps * self.pace.drive_s / SAMPLES as f64;
        let mut rush = vec![0.0_f64; self.courses.len()];
        let mut crowd = 0.0;
        let mut before = self.places(0.0);
        for sample in 1..=SAMPLES {
            let places = self.places(sample as f64 / SAMPLES as f64);
            for (robot, most) in rush.iter_mut().enumerate() {
                *most = most.max(places[robot].distance(before[robot]) / step_m - 1.0);
            }
            if sample < SAMPLES { crowd += crowding(&places, near_m); }
            before = places;
        }
        let bow = self.manner.bow * self.manner.bow;
        let Manner { early, level, spread, .. } = self.manner;
        let odd = [early, level, spread].into_iter().filter(|&is| is).count() as f64 * ODD;
        crowd / (SAMPLES as f64 * robots) + rush.iter().sum::<f64>() / robots * RUSH + bow + odd
    }
}

/// Pairs closer than `near_m`, each by how close.
fn crowding(places: &[Vec2], near_m: f64) -> f64 {
    let mut sorted = places.to_vec();
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let mut sum = 0.0;
    for (rank, a) in sorted.iter().enumerate() {
        for b in sorted[rank + 1..].iter().take_while(|b| b.x - a.x < near_m) {
            let square = (*a - *b).length_squared();
            if square < near_m * near_m {
                sum += 1.0 - square.sqrt() / near_m;
            }
        }
    }
    sum
}

/// The middle of all ends, and how much wider along each axis a crowd can become on its floor until it is loose.
fn wider(scene: &Scene, courses: &[Vec<Vec2>]) -> (Vec2, Vec2) {
    let ends = || courses.iter().flat_map(|course| [course[0], course[course.len() - 1]]);
    let least = ends().fold(Vec2::new(f64::MAX, f64::MAX), |a, b| Vec2::new(a.x.min(b.x), a.y.min(b.y)));
    let most = ends().fold(Vec2::new(f64::MIN, f64::MIN), |a, b| Vec2::new(a.x.max(b.x), a.y.max(b.y)));
    let (middle, reach) = (least.lerp(most, 0.5), (most - least) * 0.5);
    let apart = (4.0 * (reach.x + LOOSE_M / 2.0) * (reach.y + LOOSE_M / 2.0) / courses.len().max(1) as f64).sqrt();
    let along = |reach: f64, room: f64| (LOOSE_M / apart).min(room / reach.max(1e-3)).max(1.0);
    let room = |inner: f64, middle: f64| inner - middle.abs();
    (middle, Vec2::new(along(reach.x, room(scene.inner.x, middle.x)), along(reach.y, room(scene.inner.y, middle.y))))
}

/// The length of a line through corners, metres.
pub(super) fn length(course: &[Vec2]) -> f64 {
    course.windows(2).map(|leg| leg[0].distance(leg[1])).sum()
}

/// The place `way_m` along a line through corners; a course has at least one.
pub(super) fn point_along(course: &[Vec2], mut way_m: f64) -> Vec2 {
    for leg in course.windows(2) {
        let length = leg[0].distance(leg[1]);
        if way_m < length {
            return leg[0].lerp(leg[1], way_m / length);
        }
        way_m -= length;
    }
    course.last().copied().unwrap_or(Vec2::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pace_keeps_the_limits_it_is_made_for() {
        for (longest, easing) in [(2.0, Easing::Swift), (0.05, Easing::Swift), (2.0, Easing::Gentle)] {
            let pace = Pace::new(longest, &Limits::ELISA_3, easing, 1.0);
            let at = |i: i32| longest * pace.share(pace.drive_s * f64::from(i) / 1000.0);
            let step = pace.drive_s / 1000.0;
            for i in 1..1000 {
                assert!((at(i + 1) - at(i)) / step <= 0.27 * 1.0001);
                assert!((at(i + 1) - 2.0 * at(i) + at(i - 1)).abs() / (step * step) <= 1.001);
            }
            assert!(at(0) == 0.0 && (at(1000) - longest).abs() < 1e-12);
        }
    }
}
