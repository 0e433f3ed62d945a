//! Places over time, sparse enough to be small.
//!
//! A sample is left out if a straight line in time between the samples that are kept passes within a tolerance of it,
//! at first [`TOLERANCE_M`]. While a run has more than [`SAMPLES_MAX`] samples, the tolerance is doubled and further
//! samples are left out. This ends at a tolerance of a metre or more. Neither the memory nor the page of a long run
//! then grows much. The page contains the last tolerance.

use lightbots_base::Vec2;

/// Largest distance between a sample that is left out and the line that replaces it, metres. With a smaller value, pages
/// grow. With a larger one, a line on a floor of three metres is off by more than a pixel of a screen.
const TOLERANCE_M: f64 = 0.003;
/// Largest number of samples in a report: about 2.5 bytes each in the page, and 24 bytes during the run.
pub(crate) const SAMPLES_MAX: usize = 1_000_000;
/// Largest number of samples that are left out between two samples that are kept. Bounds the work for a robot that stands.
const SKIPPED_MAX: usize = 64;

/// A moment, in seconds of the show clock, and a robot's place at that moment, in stage metres.
type Sample = (f64, Vec2);

/// One robot's places over time, simplified while samples are added.
#[derive(Clone, Debug)]
pub(crate) struct PlaceTrack {
    /// Largest distance between a sample that is left out now and the line that replaces it, metres. It doubles with
    /// each [`Self::thin`].
    tolerance_m: f64,
    kept: Vec<Sample>,
    /// All samples since the last kept sample. The last of them may have to be kept.
    open: Vec<Sample>,
}

impl Default for PlaceTrack {
    fn default() -> Self {
        Self { tolerance_m: TOLERANCE_M, kept: Vec::new(), open: Vec::new() }
    }
}

impl PlaceTrack {
    /// Number of samples that are kept.
    pub fn count(&self) -> usize {
        self.kept.len()
    }

    /// Doubles the tolerance, and leaves out the kept samples that are not needed any more.
    pub fn thin(&mut self) {
        self.tolerance_m *= 2.0;
        self.kept = thinned(&self.kept, self.tolerance_m);
    }

    /// Adds a sample. A sample that is not later than the last sample is ignored.
    pub fn add(&mut self, at_s: f64, place: Vec2) {
        let Some(&last) = self.open.last().or(self.kept.last()) else {
            return self.kept.push((at_s, place));
        };
        if at_s <= last.0 {
            return;
        }
        if let Some(&anchor) = self.kept.last() {
            let fits = |&(between_s, between): &Sample| {
                along(anchor, (at_s, place), between_s).distance(between) <= self.tolerance_m
            };
            if self.open.len() >= SKIPPED_MAX || !self.open.iter().all(fits) {
                self.kept.push(last);
                self.open.clear();
            }
        }
        self.open.push((at_s, place));
    }

    /// Returns the kept samples and the very last sample.
    fn finish(mut self) -> Vec<Sample> {
        self.kept.extend(self.open.last());
        self.kept
    }
}

/// The place at `at_s`, seconds of the show clock, of a robot that moves evenly from one sample to another.
fn along(from: Sample, to: Sample, at_s: f64) -> Vec2 {
    let share = (at_s - from.0) / (to.0 - from.0).max(1e-9);
    from.1 + (to.1 - from.1) * share
}

/// Returns some of these samples. The lines between them pass within `tolerance_m` of the samples that are left out.
fn thinned(samples: &[Sample], tolerance_m: f64) -> Vec<Sample> {
    let mut kept: Vec<Sample> = samples.first().copied().into_iter().collect();
    let mut anchor = 0;
    for end in 1..samples.len() {
        let fits = |sample: &Sample| {
            along(samples[anchor], samples[end], sample.0).distance(sample.1) <= tolerance_m
        };
        if end - anchor > SKIPPED_MAX || !samples[anchor + 1..end].iter().all(fits) {
            anchor = end - 1;
            kept.push(samples[anchor]);
        }
    }
    if samples.len() > 1 {
        kept.extend(samples.last());
    }
    kept
}

/// What a replay with a slider shows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scrub {
    /// Extent of the floor along x and y, metres.
    pub floor: [f64; 2],
    /// Radius of a robot, metres.
    pub radius_m: f64,
    /// Duration of the run from the first departure on, seconds.
    pub end_s: f64,
    /// Tolerance at which samples were last left out, metres. Lines are off by less than twice this, because samples
    /// may have been left out several times, each time with twice the tolerance.
    pub tolerance_m: f64,
    /// No-go areas: `[x, y, radius]` for a disc or `[left, bottom, right, top]` for a rectangle, stage metres.
    pub areas: Vec<Vec<f64>>,
    /// The robots, in the order of the report's table.
    pub tracks: Vec<ScrubTrack>,
}

/// One robot's places and lights.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScrubTrack {
    /// Planned places of the robot. Three numbers per sample: time in 1/100 s after the first departure, x and y in
    /// millimetres, each minus that of the previous sample. The first sample has the numbers themselves.
    pub planned: Vec<i32>,
    /// Places that the robot reported, or its true places in a rehearsal, as numbers like those of `planned`.
    pub driven: Vec<i32>,
    /// Changes of the robot's light. Two numbers per change: time in 1/100 s minus that of the previous change, and the
    /// new colour (R·65536 + G·256 + B). The time of the first change counts from the first departure.
    pub light: Vec<i64>,
    /// When the robot was lost, 1/100 s after the first departure. `None` if it was not lost, or came back.
    pub lost: Option<i64>,
}

/// Planned and driven samples of one robot: [`ScrubTrack::planned`] and [`ScrubTrack::driven`].
pub(crate) type Encoded = (Vec<i32>, Vec<i32>);

/// Encodes planned and driven samples of each robot for [`ScrubTrack`]. Also returns the largest tolerance that was used,
/// metres. `began_s` is the first departure, seconds of the show clock.
pub(crate) fn encoded(tracks: Vec<(PlaceTrack, PlaceTrack)>, began_s: f64) -> (Vec<Encoded>, f64) {
    let reached = tracks.iter().flat_map(|(planned, driven)| [planned.tolerance_m, driven.tolerance_m]);
    let mut tolerance_m = reached.fold(TOLERANCE_M, f64::max);
    let mut tracks: Vec<_> =
        tracks.into_iter().map(|(planned, driven)| (planned.finish(), driven.finish())).collect();
    while tracks.iter().map(|(planned, driven)| planned.len() + driven.len()).sum::<usize>() > SAMPLES_MAX
        && tolerance_m < 1.0
    {
        tolerance_m *= 2.0;
        for (planned, driven) in &mut tracks {
            (*planned, *driven) = (thinned(planned, tolerance_m), thinned(driven, tolerance_m));
        }
    }
    let encoded =
        tracks.iter().map(|(planned, driven)| (differences(planned, began_s), differences(driven, began_s)));
    (encoded.collect(), tolerance_m)
}

fn differences(samples: &[Sample], began_s: f64) -> Vec<i32> {
    let mut last = [0i32; 3];
    let mut out = Vec::with_capacity(samples.len() * 3);
    for (at_s, place) in samples {
        // Saturating conversions: places of hostile reports are at most a million metres away.
        let now =
            [(at_s - began_s) * 100.0, place.x * 1e3, place.y * 1e3].map(|number| number.round() as i32);
        out.extend(now.iter().zip(last).map(|(now, last)| now.wrapping_sub(last)));
        last = now;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drive along a quarter of a circle of a metre, at 10 Hz, with a stop of 3 s in the middle.
    fn curve() -> Vec<Sample> {
        let moved_s = |at_s: f64| if at_s < 2.0 { at_s } else { (at_s - 3.0).max(2.0) };
        let at = |step: u32| {
            let at_s = f64::from(step) * 0.1;
            (at_s, Vec2::unit(moved_s(at_s) * std::f64::consts::FRAC_PI_8))
        };
        (0..=70).map(at).collect()
    }

    fn off_m(kept: &[Sample], samples: &[Sample]) -> f64 {
        let off = |sample: &Sample| {
            let next = kept.iter().position(|kept| kept.0 >= sample.0).unwrap().max(1);
            along(kept[next - 1], kept[next], sample.0).distance(sample.1)
        };
        samples.iter().map(off).fold(0.0, f64::max)
    }

    #[test]
    fn lines_pass_within_the_tolerance_of_every_sample() {
        let samples = curve();
        let mut track = PlaceTrack::default();
        samples.iter().for_each(|&(at_s, place)| track.add(at_s, place));
        let kept = track.finish();
        assert!(off_m(&kept, &samples) <= TOLERANCE_M && kept.len() < 25, "{}", kept.len());
        assert_eq!((kept.first(), kept.last()), (samples.first(), samples.last()));
        let coarse = thinned(&kept, 0.05);
        assert!(off_m(&coarse, &kept) <= 0.05 && coarse.len() < kept.len() / 2);
    }

    #[test]
    fn samples_become_differences() {
        let mut track = PlaceTrack::default();
        track.add(5.0, Vec2::new(0.5, -0.25));
        track.add(5.0, Vec2::new(9.0, 9.0));
        track.add(6.0, Vec2::new(0.75, -0.25));
        let (encoded, tolerance_m) = encoded(vec![(PlaceTrack::default(), track)], 5.0);
        assert_eq!(encoded, [(vec![], vec![0, 500, -250, 100, 250, 0])]);
        assert_eq!(tolerance_m, TOLERANCE_M);
    }

    #[test]
    fn a_track_that_is_thinned_while_it_grows_stays_near_its_samples() {
        let samples = curve();
        let mut track = PlaceTrack::default();
        for (number, &(at_s, place)) in samples.iter().enumerate() {
            track.add(at_s, place);
            if number == 30 || number == 50 {
                track.thin();
            }
        }
        let kept = track.finish();
        // Tolerances of 3, 6 and 12 mm, one after the other.
        assert!(off_m(&kept, &samples) <= 0.021, "{}", off_m(&kept, &samples));
        assert!(kept.len() < 16, "{}", kept.len());
        assert_eq!((kept.first(), kept.last()), (samples.first(), samples.last()));
    }
}
