//! Assigns a different lattice node to each place by an auction (Bertsekas 1988) over the nodes near the place.

use lightbots_base::Vec2;

use crate::cancel::Cancel;
use crate::instance::Instance;
use crate::roads::lattice::Lattice;

/// Attempts in order: the search radius around a place, in pitches (distances between neighbouring nodes), and the most
/// nodes that are considered within it. A wider attempt follows if the one before failed, because places are too dense.
const REACHES: [(f64, usize); 3] = [(1.7, 8), (3.5, 40), (9.0, 250)];
/// Least increment of a bid, square metres. The sum of costs exceeds the least possible sum by at most this for each
/// place.
const LEAST_BID: f64 = 2e-5;
/// Average number of bids for each place above which an auction fails. The next attempt follows.
const MOST_BIDS: usize = 400;

/// Returns a different node for each place, with a small sum of squared distances. `None` if there are not enough nodes
/// near the places, the auctions need too many bids, or the search is cancelled.
pub(crate) fn assign_nodes(instance: &Instance, lattice: &Lattice, places: &[Vec2]) -> Option<Vec<u32>> {
    REACHES.iter().find_map(|&(reach, most)| {
        let choices: Option<Vec<Vec<(u32, f64)>>> = places
            .iter()
            .map(|&place| {
                if instance.cancel.is_wanted() {
                    return None;
                }
                let near = lattice.around(place, reach * lattice.pitch_m, most);
                let free = near.into_iter().filter(|&node| {
                    instance.walls.is_empty()
                        || instance.is_way_free(place, lattice.places[node as usize], 0.0)
                });
                let cost = |node: u32| lattice.places[node as usize].distance(place);
                let choice: Vec<_> = free.map(|node| (node, cost(node) * cost(node))).collect();
                (!choice.is_empty()).then_some(choice)
            })
            .collect();
        auction(lattice.places.len(), &choices?, instance.cancel)
    })
}

/// Returns `[bidder]`: its object. `choices[bidder]` are the objects that it may get, and their costs, square metres.
/// The sum of costs exceeds the least by at most [`LEAST_BID`] for each bidder. `None` if the auction needs more than
/// [`MOST_BIDS`] for each bidder, or is cancelled.
fn auction(objects: usize, choices: &[Vec<(u32, f64)>], cancel: Cancel<'_>) -> Option<Vec<u32>> {
    let mut prices = vec![0.0_f64; objects];
    let mut owner = vec![usize::MAX; objects];
    let mut owns = vec![u32::MAX; choices.len()];
    let mut waiting: Vec<usize> = (0..choices.len()).rev().collect();
    let mut bids = MOST_BIDS * choices.len();
    while let Some(bidder) = waiting.pop() {
        bids = bids.checked_sub(1).filter(|_| !cancel.is_wanted())?;
        let (mut best, mut second) = ((f64::MAX, u32::MAX), f64::MAX);
        for &(object, cost) in &choices[bidder] {
            let total = cost + prices[object as usize];
            if total < best.0 {
                second = best.0;
                best = (total, object);
            } else {
                second = second.min(total);
            }
        }
        let object = best.1 as usize;
        prices[object] += (second - best.0).min(1.0) + LEAST_BID;
        if owner[object] != usize::MAX {
            waiting.push(owner[object]);
        }
        owner[object] = bidder;
        owns[bidder] = best.1;
    }
    Some(owns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_auction_finds_the_cheapest_sum() {
        let choices = vec![vec![(0, 0.1), (1, 0.2)], vec![(0, 0.1), (1, 0.5)], vec![(1, 0.9), (2, 1.0)]];
        assert_eq!(auction(3, &choices, Cancel::NEVER), Some(vec![1, 0, 2]));
    }

    #[test]
    fn too_few_objects_are_noticed() {
        assert_eq!(auction(1, &[vec![(0, 0.1)], vec![(0, 0.1)]], Cancel::NEVER), None);
    }
}
