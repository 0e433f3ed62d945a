//! A smooth curve through places, on which a place is given by the length along the curve.

use lightbots_base::Vec2;

/// Largest distance between consecutive places of a curve of up to 400 m, metres.
const STEP_M: f64 = 0.004;
/// Most steps between the places of a curve. Curves longer than 400 m have longer steps.
const MOST_STEPS: usize = 100_000;

/// A curve, stored as places at equal distances along it.
#[derive(Clone, Debug)]
pub(crate) struct SmoothLine {
    places: Vec<Vec2>,
    step_m: f64,
}

impl SmoothLine {
    /// Makes a Catmull-Rom spline through `points`, stage metres. Its corners are rounded by moving averages over
    /// `rounding_m` metres of its length.
    pub(crate) fn through(points: &[Vec2], rounding_m: f64) -> Self {
        let mut fine = Vec::new();
        for index in 1..points.len() {
            let [p, q] = [points[index - 1], points[index]];
            let before = if index >= 2 { points[index - 2] } else { p + (p - q) };
            let after = points.get(index + 1).copied().unwrap_or(q + (q - p));
            let steps = ((p.distance(q) / (STEP_M / 2.0)).ceil() as usize).clamp(1, MOST_STEPS);
            fine.extend(
                (0..steps).map(|step| catmull_rom([before, p, q, after], step as f64 / steps as f64)),
            );
        }
        fine.extend(points.last());
        let even = evened(&fine);
        let half = (rounding_m / 2.0 / even.step_m).round() as usize;
        // A moving average that is taken twice leaves no step in the curvature.
        evened(&rounded(&rounded(&even.places, half), half))
    }

    /// Length of the curve, metres.
    pub(crate) fn length_m(&self) -> f64 {
        self.step_m * self.places.len().saturating_sub(1) as f64
    }

    /// Returns the place at the length `along_m` metres from the beginning. Beyond both ends, the curve continues as a
    /// straight line.
    pub(crate) fn at(&self, along_m: f64) -> Vec2 {
        let last = self.places.len() - 1;
        if last == 0 {
            return self.places[0];
        }
        let steps = along_m / self.step_m;
        let index = (steps.floor().max(0.0) as usize).min(last - 1);
        let (from, to) = (self.places[index], self.places[index + 1]);
        from + (to - from) * (steps - index as f64)
    }

    /// Returns the length along the curve, metres, at which it is nearest to `at`. Only the part between the lengths
    /// `from_m` and `to_m` is searched.
    pub(crate) fn nearest_m(&self, at: Vec2, (from_m, to_m): (f64, f64)) -> f64 {
        let last = self.places.len() - 1;
        let index = |along_m: f64| ((along_m / self.step_m).max(0.0) as usize).min(last);
        let gap = |index: &usize| (self.places[*index] - at).length_squared();
        let nearest = (index(from_m)..=index(to_m)).min_by(|a, b| gap(a).total_cmp(&gap(b)));
        nearest.unwrap_or(0) as f64 * self.step_m
    }
}

fn catmull_rom([a, b, c, d]: [Vec2; 4], t: f64) -> Vec2 {
    let (t2, t3) = (t * t, t * t * t);
    (b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2 + (b * 3.0 - a - c * 3.0 + d) * t3) * 0.5
}

/// Resamples a line through places at equal distances along it, of at most [`STEP_M`] for lines of up to 400 m.
fn evened(line: &[Vec2]) -> SmoothLine {
    let Some(&first) = line.first() else { return SmoothLine { places: vec![Vec2::ZERO], step_m: STEP_M } };
    let length_m: f64 = line.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let steps = ((length_m / STEP_M).ceil() as usize).clamp(1, MOST_STEPS);
    let step_m = (length_m / steps as f64).max(1e-9);
    let (mut places, mut at_m) = (vec![first], 0.0);
    for pair in line.windows(2) {
        let long_m = pair[0].distance(pair[1]);
        while places.len() <= steps && places.len() as f64 * step_m <= at_m + long_m {
            let share = (places.len() as f64 * step_m - at_m) / long_m.max(1e-12);
            places.push(pair[0].lerp(pair[1], share));
        }
        at_m += long_m;
    }
    if places.len() <= steps {
        places.push(line[line.len() - 1]);
    }
    SmoothLine { places, step_m }
}

/// Replaces each place by the mean of the places up to `half` steps before and after it. Near the ends of the line,
/// fewer places count, so that the two ends stay where they are.
fn rounded(places: &[Vec2], half: usize) -> Vec<Vec2> {
    let mut sums = vec![Vec2::ZERO];
    for &at in places {
        sums.push(sums[sums.len() - 1] + at);
    }
    let mean = |index: usize| {
        let reach = half.min(index).min(places.len() - 1 - index);
        (sums[index + reach + 1] - sums[index - reach]) / (2 * reach + 1) as f64
    };
    (0..places.len()).map(mean).collect()
}
