//! Samples of a light -> holds, fades and steps.

/// Largest difference between a fade and the samples that it replaces, linear-light codes (0 to 255) of a channel.
const TOLERANCE: f64 = 1.0;
/// As [`TOLERANCE`], for samples below [`DARK`]. The first code of linear light is 13 codes of sRGB: with a whole code
/// of difference, a light that should be out would glow.
const TOLERANCE_DARK: f64 = 0.5;
/// Linear-light codes below this value are dark: [`TOLERANCE_DARK`] applies to them.
const DARK: u8 = 8;
/// Longest fade, and longest step of the fit, in samples. Bounds the time that a fit takes; a longer fade is split.
const LONGEST: usize = 3_000;

/// A hold or a fade, as in a light program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FittedStretch {
    /// Index of the sample at which the stretch ends, counted from 0.
    pub end: usize,
    /// Codes of red, green and blue at the end of the stretch.
    pub to: [u8; 3],
    /// Whether codes change linearly to `to` from those at the end of the previous stretch. Otherwise the codes are `to`
    /// during the whole stretch. A hold without duration sets the codes from which a fade starts.
    pub fades: bool,
}

/// Fits holds and fades to the samples of a light; without samples the list is empty. At each sample, the result
/// differs by at most [`TOLERANCE`], at a dark sample by at most [`TOLERANCE_DARK`]. Each fade is as long as these
/// bounds and [`LONGEST`] allow. A sudden change happens at a sample.
pub(crate) fn fitted(samples: &[[u8; 3]]) -> Vec<FittedStretch> {
    let mut stretches: Vec<FittedStretch> = Vec::new();
    let hold = |stretches: &mut Vec<FittedStretch>, end: usize, to: [u8; 3]| match stretches.last_mut() {
        Some(last) if !last.fades && last.to == to => last.end = end,
        _ => stretches.push(FittedStretch { end, to, fades: false }),
    };
    let mut begin = 0;
    while begin + 1 < samples.len() {
        let end = farthest(samples, begin);
        let (from, to) = (samples[begin], samples[end]);
        let step = (0..3).map(|channel| from[channel].abs_diff(to[channel])).max().unwrap_or(0);
        if end == begin + 1 && f64::from(step) > TOLERANCE {
            hold(&mut stretches, end, from);
            hold(&mut stretches, end, to);
        } else if step == 0 {
            hold(&mut stretches, end, from);
        } else {
            if stretches.is_empty() {
                hold(&mut stretches, 0, from);
            }
            stretches.push(FittedStretch { end, to, fades: true });
        }
        begin = end;
    }
    if let (true, [only]) = (stretches.is_empty(), samples) {
        hold(&mut stretches, 0, *only);
    }
    stretches
}

/// Index of the last sample to which a straight line from sample `begin` stays within the tolerance of every sample in
/// between. At least `begin + 1`, at most `begin + LONGEST`.
fn farthest(samples: &[[u8; 3]], begin: usize) -> usize {
    let mut best = begin + 1;
    let mut slopes = [(f64::NEG_INFINITY, f64::INFINITY); 3];
    let last = (begin + LONGEST).min(samples.len() - 1);
    for end in begin + 1..=last {
        let along = (end - begin) as f64;
        let mut fits = true;
        let mut is_open = true;
        for channel in 0..3 {
            let change = f64::from(samples[end][channel]) - f64::from(samples[begin][channel]);
            let (low, high) = &mut slopes[channel];
            fits &= (*low..=*high).contains(&(change / along));
            let tolerance = if samples[end][channel] < DARK { TOLERANCE_DARK } else { TOLERANCE };
            *low = low.max((change - tolerance) / along);
            *high = high.min((change + tolerance) / along);
            is_open &= *low <= *high;
        }
        if fits {
            best = end;
        }
        if !is_open {
            break;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples the stretches again.
    fn played(stretches: &[FittedStretch], count: usize) -> Vec<[f64; 3]> {
        let mut samples = Vec::new();
        for at in 0..count {
            let number = stretches.iter().position(|stretch| at < stretch.end);
            let code = number.map_or_else(
                || stretches[stretches.len() - 1].to.map(f64::from),
                |number| {
                    let stretch = stretches[number];
                    let begin = if number == 0 { 0 } else { stretches[number - 1].end };
                    let from = if stretch.fades { stretches[number - 1].to } else { stretch.to };
                    let share = (at - begin) as f64 / (stretch.end - begin) as f64;
                    std::array::from_fn(|channel| {
                        f64::from(from[channel]) * (1.0 - share) + f64::from(stretch.to[channel]) * share
                    })
                },
            );
            samples.push(code);
        }
        samples
    }

    #[test]
    fn holds_fades_and_steps_come_back_within_a_code() {
        let fade = (0..=100).map(|at| [(at as f64 * 2.5) as u8, 100 - at as u8, 7]);
        let curve = (0..200).map(|at| [((at as f64 / 200.0).powi(3) * 255.0) as u8, 0, 255]);
        let samples: Vec<[u8; 3]> =
            [[9, 9, 9]; 40].into_iter().chain(fade).chain([[200, 0, 0]; 30]).chain(curve).collect();
        let stretches = fitted(&samples);
        for (sample, played) in samples.iter().zip(played(&stretches, samples.len())) {
            let off = (0..3).map(|channel| (f64::from(sample[channel]) - played[channel]).abs());
            assert!(off.fold(0.0, f64::max) <= 1.0 + 1e-9, "{sample:?} {played:?}");
        }
        assert!(stretches.len() < 25, "{}", stretches.len());
        assert_eq!(stretches[0], FittedStretch { end: 40, to: [9; 3], fades: false });
    }

    #[test]
    fn few_samples_are_no_matter() {
        assert_eq!(fitted(&[]), []);
        assert_eq!(fitted(&[[1; 3]]), [FittedStretch { end: 0, to: [1; 3], fades: false }]);
        assert_eq!(fitted(&[[1; 3], [2; 3]]).len(), 2);
    }
}
