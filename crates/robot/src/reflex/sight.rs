//! What the proximity sensors saw over the last steps: how near things are, in which direction, how fast they come.

/// Sensors around the rim, 45° apart, counter-clockwise from the front.
pub(crate) const SENSORS: usize = 8;
/// Gaps wider than this are of no interest, metres.
const SIGHT_M: f32 = 0.03;
/// How many steps back it looks to see how fast a gap closes.
pub(super) const PAST: usize = 3;
/// The same for what is nearer than the plan has it, and how many steps tell whether a gap was steady.
pub(super) const LONG_PAST: usize = 6;
/// Noise of a difference of two readings, 1 sigma: metres, and share of the gap.
const NOISE_M: f32 = 0.0004;
const NOISE_SHARE: f32 = 0.07;
/// How many sigma are taken off what one, two and three steps say; more steps as many as three.
const SIGMAS: [f32; PAST] = [2.4, 1.5, 1.3];
/// A gap was steady whose newer and older readings differ by less in the mean, in sigma of a difference, …
const STEADY_SIGMAS: f32 = 1.5;
/// … if there are so many of them at least.
const STEADY_LEAST: usize = 4;
/// Noise of a reading against the mean of a steady gap: share of that against another reading.
const STEADIER: f32 = 0.8;
/// Between two sensors a disc is so much nearer than either says, at most; less where one says more than the other.
const BETWEEN_M: f32 = 0.0036;
const APART_M: f32 = 0.012;
/// Sine of the angle between the middle of two sensors and what both see, for each metre by which one sees it nearer:
/// for discs of 27 mm with their rims about 3 mm apart.
const LEAN_PER_M: f32 = 28.0;

pub(super) const NOTHING: [f32; SENSORS] = [f32::INFINITY; SENSORS];

/// How fast a gap closes in, m/s: as it seems over some steps, and at least.
#[derive(Clone, Copy)]
pub(super) struct Closing {
    pub mps: f32,
    pub sure_mps: f32,
    /// It was steady, and closes in for two steps or more: the other kept pace and does not any more.
    pub kept_pace: bool,
}

/// Readings of the last steps.
#[derive(Debug)]
pub(super) struct Sight {
    /// `[steps ago][sensor]`: gaps, metres; infinite where nothing was in sight.
    past_m: [[f32; SENSORS]; LONG_PAST + 1],
    /// Anything is in sight.
    pub sees: bool,
    dt: f32,
}

impl Sight {
    pub fn new() -> Self {
        Self { past_m: [NOTHING; LONG_PAST + 1], sees: false, dt: 0.0 }
    }

    /// Takes the readings of a step of `dt` seconds. What is not a number is nothing seen.
    #[inline]
    pub fn look(&mut self, gaps_m: Option<&[f32; SENSORS]>, dt: f64) {
        let gaps_m = gaps_m.filter(|gaps| dt > 0.0 && gaps.iter().any(|&gap| gap < SIGHT_M));
        if gaps_m.is_none() && !self.sees {
            return;
        }
        self.sees = gaps_m.is_some();
        let seen = |gap: f32| if gap < SIGHT_M { gap.max(0.0) } else { f32::INFINITY };
        match gaps_m {
            Some(gaps) => {
                self.past_m.copy_within(..LONG_PAST, 1);
                (self.past_m[0], self.dt) = (gaps.map(seen), dt as f32);
            }
            None => self.past_m = [NOTHING; LONG_PAST + 1],
        }
    }

    /// What the sensors say now, metres.
    pub fn now_m(&self) -> &[f32; SENSORS] {
        &self.past_m[0]
    }

    /// What a sensor and the two beside it say now at least, metres.
    pub fn around_m(&self, sensor: usize) -> f32 {
        let now = &self.past_m[0];
        now[sensor].min(now[(sensor + 1) % SENSORS]).min(now[(sensor + SENSORS - 1) % SENSORS])
    }

    /// Whether what a sensor abeam sees lies behind it rather than ahead: then no driving on closes in on it, and
    /// braking would only let it run into the robot.
    pub fn is_abaft(&self, sensor: usize, forwards: bool) -> bool {
        let now = &self.past_m[0];
        let (next, last) = (now[(sensor + 1) % SENSORS], now[(sensor + SENSORS - 1) % SENSORS]);
        let (ahead, behind) = if (sensor == 2) == forwards { (last, next) } else { (next, last) };
        behind < ahead
    }

    /// Whether neither sensor beside this one sees anything: what it sees may be anywhere in its sight.
    pub fn is_alone(&self, sensor: usize) -> bool {
        let now = &self.past_m[0];
        now[(sensor + 1) % SENSORS].min(now[(sensor + SENSORS - 1) % SENSORS]) == f32::INFINITY
    }

    /// In which direction of body space it is what a sensor sees, radians, by what the one beside it sees.
    pub fn towards(&self, sensor: usize) -> f64 {
        let now = &self.past_m[0];
        let (left, right) = ((sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS);
        let (beside, side) = if now[left] < now[right] { (left, 1.0) } else { (right, -1.0) };
        let middle = core::f64::consts::FRAC_PI_8;
        let aside = if now[beside].is_finite() {
            let lean = LEAN_PER_M * (now[beside] - now[sensor]);
            middle - libm::asin(f64::from(lean.clamp(0.0, 0.38)))
        } else {
            0.0
        };
        sensor as f64 * 2.0 * middle + side * aside.max(0.0)
    }

    /// The gap at a sensor, metres, a little less where the one beside it sees nearly as near; infinite: nothing.
    pub fn gap_m(&self, sensor: usize) -> f32 {
        self.gap_before_m(sensor, 0)
    }

    /// The same in the mean over the last steps, as far as anything was in sight.
    pub fn mean_gap_m(&self, sensor: usize) -> f32 {
        let gaps_m = (0..=LONG_PAST).map(|steps| self.gap_before_m(sensor, steps));
        let (sum_m, count) = gaps_m
            .take_while(|gap_m| gap_m.is_finite())
            .fold((0.0, 0.0), |(sum_m, count), gap_m| (sum_m + gap_m, count + 1.0));
        if count > 0.0 { sum_m / count } else { f32::INFINITY }
    }

    fn gap_before_m(&self, sensor: usize, steps: usize) -> f32 {
        let then = &self.past_m[steps];
        if !then[sensor].is_finite() {
            return f32::INFINITY;
        }
        let beside = then[(sensor + 1) % SENSORS].min(then[(sensor + SENSORS - 1) % SENSORS]);
        let even = (1.0 - (beside - then[sensor]).abs() / APART_M).max(0.0);
        (then[sensor] - BETWEEN_M * even * even).max(0.0)
    }

    /// How fast the gap at a sensor shrinks, by at most so many steps; `None` where nothing was in sight twice.
    pub fn closing(&self, sensor: usize, most_steps: usize) -> Option<Closing> {
        let gap_m = self.past_m[0][sensor];
        let mut closing: Option<Closing> = None;
        for steps in 1..=most_steps.min(LONG_PAST) {
            let before_m = self.past_m[steps][sensor];
            if !before_m.is_finite() || !gap_m.is_finite() {
                break;
            }
            let noise_m = noise_m(gap_m);
            let steady_m = self.steady_m(sensor, steps);
            let (before_m, noise_m) = steady_m.map_or((before_m, noise_m), |mean| (mean, noise_m * STEADIER));
            let over_s = steps as f32 * self.dt;
            let mps = (before_m - gap_m) / over_s;
            let sure_mps = mps - SIGMAS[(steps - 1).min(PAST - 1)] * noise_m / over_s;
            let surest_mps = closing.map_or(sure_mps, |known| known.sure_mps.max(sure_mps));
            let kept_pace = steps > 1 && steady_m.is_some() || closing.is_some_and(|known| known.kept_pace);
            closing = Some(Closing { mps: mps.max(surest_mps), sure_mps: surest_mps, kept_pace });
        }
        closing
    }

    /// The mean of what a sensor saw until so many steps ago, metres, where that hardly changed: it says better than one
    /// reading how wide a gap was before it began to close.
    fn steady_m(&self, sensor: usize, steps: usize) -> Option<f32> {
        let older = self.past_m.get(steps..).filter(|older| older.len() >= STEADY_LEAST)?;
        let mean_m =
            |of: &[[f32; SENSORS]]| of.iter().map(|gaps| gaps[sensor]).sum::<f32>() / of.len() as f32;
        let (newer, oldest) = older.split_at(older.len() / 2);
        let (differ_m, mean_m) = ((mean_m(newer) - mean_m(oldest)).abs(), mean_m(older));
        (differ_m < STEADY_SIGMAS * noise_m(mean_m)).then_some(mean_m)
    }
}

/// Noise of a difference of two readings of such a gap, 1 sigma, metres.
fn noise_m(gap_m: f32) -> f32 {
    NOISE_M + NOISE_SHARE * gap_m
}
