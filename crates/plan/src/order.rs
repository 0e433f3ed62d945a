//! The one total order on candidate plans of a transition. Each rule decides among the plans that the rule before left.
//!
//! 1. Fewer contacts and faults; a fault is illegal motion. A plan without contacts and faults is contact-free.
//! 2. Contact-free plans only: a duration of at most [`MOST_LONGER`] × the shortest.
//! 3. Contact-free plans only: the greater stop-safe share, in steps of 1 %. It is the share of moments at which a
//!    robot may stop dead without a contact.
//! 4. The shorter duration.
//! 5. The lower index in the list of candidates.
//!
//! Stop-safety is measured only if rule 2 leaves more than one plan, because its measurement takes time.

use lightbots_base::Span;

/// A plan may be chosen for its stop-safety if its duration is at most this many times the shortest duration. With a
/// larger value, stop-safety counts more and duration less.
const MOST_LONGER: f64 = 1.05;

/// Properties of a candidate plan that are known before its stop-safety is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlanQuality {
    /// Number of contacts and faults; 0 if the plan is contact-free.
    pub contacts: usize,
    pub duration: Span,
}

/// The chosen candidate, and why it was chosen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chosen {
    pub index: usize,
    /// Reason for the choice, one line.
    pub reason: &'static str,
    /// Stop-safe shares that were measured: `(index of the candidate, percent)`; empty if none was.
    pub stop_safe_percents: Vec<(usize, u8)>,
}

/// Chooses the best candidate by the order above; `None` if there are no candidates. `stop_safe_percent(index)` returns
/// a candidate's stop-safe share, and is called at most once for each candidate.
pub(crate) fn choose(
    candidates: &[PlanQuality],
    mut stop_safe_percent: impl FnMut(usize) -> u8,
) -> Option<Chosen> {
    let fewest = candidates.iter().map(|one| one.contacts).min()?;
    let best = |&index: &usize| candidates[index].contacts == fewest;
    let mut left: Vec<usize> = (0..candidates.len()).filter(best).collect();
    let mut stop_safe_percents = Vec::new();
    let mut reason = match (candidates.len(), fewest) {
        (1, 0) => "the only contact-free plan",
        (_, 0) => "the shortest contact-free plan",
        _ => "the fewest contacts",
    };
    if fewest == 0 {
        let shortest = left.iter().map(|&index| candidates[index].duration).min()?;
        let longest_s = shortest.as_secs() * MOST_LONGER;
        left.retain(|&index| candidates[index].duration.as_secs() <= longest_s);
        if left.len() > 1 {
            stop_safe_percents = left.iter().map(|&index| (index, stop_safe_percent(index))).collect();
            let most = stop_safe_percents.iter().map(|&(_, percent)| percent).max()?;
            left = stop_safe_percents.iter().filter(|one| one.1 == most).map(|one| one.0).collect();
            if left.len() < stop_safe_percents.len() {
                reason = "the greatest stop-safe share of plans at most 5 % longer than the shortest";
            }
        }
    }
    let index = left.into_iter().min_by_key(|&index| (candidates[index].duration, index))?;
    Some(Chosen { index, reason, stop_safe_percents })
}

/// Converts a share from 0 to 1 to whole percent, rounded down. Panics outside that range.
pub(crate) fn percent(share: f64) -> u8 {
    assert!((0.0..=1.0).contains(&share), "a share is between 0 and 1: {share}");
    (share * 100.0 + 1e-9) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chosen(candidates: &[(usize, f64, u8)]) -> Option<usize> {
        let quality =
            |&(contacts, seconds, _): &_| PlanQuality { contacts, duration: Span::from_secs(seconds) };
        let qualities: Vec<PlanQuality> = candidates.iter().map(quality).collect();
        choose(&qualities, |index| candidates[index].2).map(|chosen| chosen.index)
    }

    #[test]
    fn each_criterion_counts_only_where_those_before_it_are_equal() {
        assert_eq!(chosen(&[]), None);
        assert_eq!(chosen(&[(3, 1.0, 99), (1, 9.0, 0), (1, 8.0, 0)]), Some(2));
        assert_eq!(chosen(&[(1, 1.0, 99), (0, 9.0, 0)]), Some(1));
        assert_eq!(chosen(&[(0, 10.0, 50), (0, 10.5, 51), (0, 10.6, 99)]), Some(1));
        assert_eq!(chosen(&[(0, 10.4, 90), (0, 10.2, 90), (0, 10.2, 90)]), Some(1));
    }

    #[test]
    fn a_single_contact_free_plan_is_not_measured() {
        let one = PlanQuality { contacts: 0, duration: Span::from_secs(1.0) };
        let long = PlanQuality { duration: Span::from_secs(2.0), ..one };
        let chosen = choose(&[one, long], |_| panic!("nothing to compare with"));
        assert_eq!(chosen.unwrap().index, 0);
    }

    #[test]
    fn percents_are_rounded_down() {
        assert_eq!([0.0, 0.999, 0.29, 1.0].map(percent), [0, 99, 29, 100]);
    }
}
