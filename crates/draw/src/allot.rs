//! How many robots each group gets.

use crate::ground::Ground;
use crate::layout::Style;
use crate::settings::PlaceSettings;

/// What a group needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Share {
    /// Robots are shared in proportion to it.
    pub demand: f64,
    /// Robots that it has in any case.
    pub least: usize,
}

impl Share {
    /// The demand of a group: its area where it is filled, its length where it is a line.
    pub fn new(ground: &Ground, settings: &PlaceSettings, kept: usize) -> Self {
        let demand = match settings.style {
            Style::Lines if !ground.lines.lines.is_empty() => ground.lines.length(),
            Style::Outline if !ground.outline.lines.is_empty() => ground.outline.length(),
            _ if ground.samples.is_empty() => ground.lines.length(),
            _ => ground.mass,
        };
        Self { demand, least: kept }
    }
}

/// Shares `count` robots in proportion to the demands, one by one to the group with the greatest demand for each robot that
/// it has. Each group with a demand gets its first robot before others get a second one, the greatest demand first.
pub(crate) fn allot(shares: &[Share], count: usize) -> Vec<usize> {
    let mut counts: Vec<usize> = shares.iter().map(|share| share.least).collect();
    let given: usize = counts.iter().sum();
    for _ in given..count {
        // Between the rules of Adams (+ 0) and Webster (+ 0.5): neither small nor large groups are starved.
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
