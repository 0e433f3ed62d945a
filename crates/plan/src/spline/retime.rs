//! Retiming: the speed along paths changes so that moments with congestion get more time.

/// Returns `[part]`: the factor on the duration of each part of a drive that is divided into equal parts. The
/// additional time of a part is proportional to `congestion[part]`; without any congestion, all parts get the same. The
/// mean factor is `times`, or less if `most`, the largest allowed factor, limits some parts.
pub(crate) fn time_scaled(congestion: &[f64], times: f64, most: f64) -> Vec<f64> {
    let mean = congestion.iter().sum::<f64>() / congestion.len().max(1) as f64;
    let share = |congestion: f64| if mean > 0.0 { congestion / mean } else { 1.0 };
    congestion.iter().map(|&congestion| (1.0 + (times - 1.0) * share(congestion)).min(most)).collect()
}

/// Returns `[step]` for 0 to `steps`: the moment of the old drive at the end of each of `steps` equal steps of the new
/// drive. Moments are counted in parts of the old drive. Part `k` lasts `lasts[k]` in the new drive.
pub(crate) fn moments(lasts: &[f64], steps: usize) -> Vec<f64> {
    let whole: f64 = lasts.iter().sum();
    let (mut part, mut passed) = (0, 0.0);
    let inner = (1..steps).map(|step| {
        let now = whole * step as f64 / steps as f64;
        while part + 1 < lasts.len() && passed + lasts[part] < now {
            passed += lasts[part];
            part += 1;
        }
        part as f64 + ((now - passed) / lasts[part]).clamp(0.0, 1.0)
    });
    let inner: Vec<f64> = inner.collect();
    [0.0].into_iter().chain(inner).chain([lasts.len() as f64]).collect()
}

/// Smooths congestion over time: each pass replaces every part by half of it and a quarter of each neighbour. The first
/// and the last part count as their own missing neighbours.
pub(crate) fn smoothed(mut congestion: Vec<f64>, passes: usize) -> Vec<f64> {
    let last = congestion.len().saturating_sub(1);
    for _ in 0..passes {
        let beside = |at: usize| (congestion[at.saturating_sub(1)] + congestion[(at + 1).min(last)]) * 0.25;
        congestion = (0..congestion.len()).map(|at| congestion[at] * 0.5 + beside(at)).collect();
    }
    congestion
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_goes_where_robots_are_in_each_others_way() {
        let lasts = time_scaled(&[0.0, 3.0, 1.0, 0.0], 1.5, 10.0);
        assert_eq!(lasts, [1.0, 2.5, 1.5, 1.0]);
        let moments = moments(&lasts, 6);
        assert_eq!(moments, [0.0, 1.0, 1.4, 1.8, 2.0 + 1.0 / 3.0, 3.0, 4.0]);
    }

    #[test]
    fn without_congestion_all_parts_take_longer_alike() {
        assert_eq!(time_scaled(&[0.0; 4], 1.25, 10.0), [1.25; 4]);
        assert_eq!(time_scaled(&[0.0, 8.0], 1.5, 1.6), [1.0, 1.6]);
        assert_eq!(moments(&[1.25; 4], 2), [0.0, 2.0, 4.0]);
    }

    #[test]
    fn blurring_loses_nothing() {
        let smoothed = smoothed(vec![4.0, 0.0, 0.0, 8.0], 3);
        assert!((smoothed.iter().sum::<f64>() - 12.0).abs() < 1e-12);
        assert!(smoothed.iter().all(|&congestion| congestion > 0.0) && smoothed[3] > smoothed[2]);
    }
}
