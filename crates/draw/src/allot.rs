//! Decides how many robots each part gets.

use crate::geometry::hexagonal_count;
use crate::ground::Ground;
use crate::layout::Style;

/// The claim of one part of a drawing to robots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// Weight of the part. Robots are allotted in proportion to it, as far as `least` allows.
    pub demand: f64,
    /// Number of robots that the part gets in any case.
    pub least: usize,
}

/// Returns for each part the number of robots that it takes, which may be fractional. All parts have the same spacing,
/// which is chosen so that the sum is about `count`.
pub(crate) fn demands(grounds: &[&Ground], style: Style, count: usize) -> Vec<f64> {
    let at = |spacing: f64| grounds.iter().map(|ground| demand(ground, style, spacing)).collect::<Vec<f64>>();
    let size = grounds.iter().map(|ground| ground.size).fold(0.0, f64::max);
    let (mut low, mut high) = (1e-6 * size, 10.0 * size);
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if at(middle).iter().sum::<f64>() > count as f64 { low = middle } else { high = middle }
    }
    at(high)
}

/// Number of robots that a part takes at a spacing between robots, in the units of `ground`; may be fractional.
fn demand(ground: &Ground, style: Style, spacing: f64) -> f64 {
    let filling = |area: f64| hexagonal_count(area, spacing);
    let (lines, edge) = (ground.lines.length(), ground.outline.length());
    match style {
        _ if ground.samples.is_empty() => lines / spacing,
        Style::Lines if lines > 0.0 => lines / spacing,
        Style::Outline if edge > 0.0 => edge / spacing,
        Style::Both if edge > 0.0 => edge / spacing + filling(ground.mass - edge * spacing / 2.0),
        _ => filling(ground.mass),
    }
}

/// Allots `count` robots to parts, in proportion to their demands, and returns the number of robots for each part. One
/// robot after the other goes to the part with the greatest demand per robot. A part without robots comes before parts
/// with robots, if it has a demand. If no part has a demand, each part gets only its `least`.
pub(crate) fn allot(shares: &[Share], count: usize) -> Vec<usize> {
    let mut counts: Vec<usize> = shares.iter().map(|share| share.least).collect();
    let given: usize = counts.iter().sum();
    for _ in given..count {
        // Divisor 0.3, between the rules of Adams (0) and Webster (0.5): neither small nor large parts get too few
        // robots.
        let value = |index: &usize| shares[*index].demand / (counts[*index] as f64 + 0.3);
        let order = |a: &usize, b: &usize| {
            (counts[*a] == 0).cmp(&(counts[*b] == 0)).then(value(a).total_cmp(&value(b))).then(b.cmp(a))
        };
        let wanting = (0..shares.len()).filter(|index| shares[*index].demand > 0.0);
        let Some(index) = wanting.max_by(order) else { break };
        counts[index] += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_are_shared_in_proportion_and_all_are_given() {
        let share = |demand| Share { demand, least: 0 };
        assert_eq!(allot(&[share(2.0), share(1.0)], 30), [20, 10]);
        assert_eq!(allot(&[share(1.0), share(0.001)], 2), [1, 1]);
        assert_eq!(allot(&[share(0.0), share(1.0)], 3), [0, 3]);
        assert_eq!(allot(&[Share { demand: 1.0, least: 4 }, share(1.0)], 6), [4, 2]);
        assert_eq!(allot(&[], 3), Vec::<usize>::new());
    }
}
