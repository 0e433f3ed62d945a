//! Scores for the agreement between found beats and true ones.

/// Largest distance of a found beat from the true one, seconds.
const SAME_S: f64 = 0.05;

/// F score: the harmonic mean of precision and recall, with beats matched one to one.
pub fn agreement(found: &[f64], truth: &[f64]) -> f64 {
    let (mut i, mut j, mut hits) = (0, 0, 0);
    while let (Some(a), Some(b)) = (found.get(i), truth.get(j)) {
        if (a - b).abs() <= SAME_S {
            (i, j, hits) = (i + 1, j + 1, hits + 1);
        } else if a < b {
            i += 1;
        } else {
            j += 1;
        }
    }
    2.0 * f64::from(hits) / (found.len() + truth.len()) as f64
}

/// The best F score after one of the editor's buttons: none, ×2, ÷2, the other ÷2, half a beat later.
pub fn with_buttons(found: &[f64], truth: &[f64]) -> f64 {
    let between: Vec<f64> = found.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
    let mut doubled: Vec<f64> = found.iter().chain(&between).copied().collect();
    doubled.sort_by(f64::total_cmp);
    let halved = |first: usize| found.iter().copied().skip(first).step_by(2).collect::<Vec<f64>>();
    let changed = [found.to_vec(), doubled, halved(0), halved(1), between];
    changed.iter().map(|beats| agreement(beats, truth)).fold(0.0, f64::max)
}

/// Median difference between matched beats, found minus true, seconds.
pub fn offset_s(found: &[f64], truth: &[f64]) -> f64 {
    let nearest = |beat: &f64| truth.iter().map(|t| beat - t).min_by(|a, b| a.abs().total_cmp(&b.abs()));
    let mut errors: Vec<f64> =
        found.iter().filter_map(nearest).filter(|error| error.abs() <= SAME_S).collect();
    errors.sort_by(f64::total_cmp);
    errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN)
}
