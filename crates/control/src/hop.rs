//! Straight drives of robots that know only TARGET, and how far one may go while others are on theirs.

use crate::clear::{segment_to_point, segment_to_segment};
use lightbots_base::Vec2;
use std::collections::BTreeMap;

/// Halvings of a drive when it is looked for how far it is clear: to a thousandth of a metre on the largest floors.
const HALVINGS: usize = 14;
/// Distances are kept up to rounding, metres.
const ROUNDING_M: f64 = 1e-9;

/// Speed of an original robot, m/s, and what a hop takes besides: turning, and being heard of.
const SPEED_MPS: f64 = 0.27;
const BESIDES_S: f64 = 0.6;
/// How much later one leaves that another leaves room for, seconds.
const FOLLOWS_S: f64 = 0.4;

/// A straight drive from where a robot stands to where it stands next.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hop {
    /// Who: a rider while a plan is made, a seat in a leg.
    pub robot: usize,
    /// Stage metres.
    pub from: Vec2,
    pub to: Vec2,
    /// Hops of others before it in the list that it would meet. It never enters what is left of them.
    pub yields: Vec<Yield>,
}

/// A hop that goes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Yield {
    /// Place in the list.
    pub to: usize,
    /// Distance of centres that is kept, metres.
    pub gap_m: f64,
}

impl Hop {
    pub fn new(robot: usize, from: Vec2, to: Vec2) -> Self {
        Self { robot, from, to, yields: Vec::new() }
    }

    pub fn length_m(&self) -> f64 {
        self.from.distance(self.to)
    }

    /// The place after a share of the way, 0 to 1.
    pub fn at(&self, share: f64) -> Vec2 {
        self.from + (self.to - self.from) * share
    }

    /// What share of the way lies behind a robot at `place`; may be less than 0 or more than 1.
    pub fn share_at(&self, place: Vec2) -> f64 {
        let way = self.to - self.from;
        let squared = way.length_squared();
        if squared > 0.0 { (place - self.from).dot(way) / squared } else { 1.0 }
    }

    /// How much of the hop keeps a gap to what is left of another once `passed` of that is done, wherever both are
    /// meanwhile: a share from 0 to 1.
    pub fn clear_share(&self, other: &Self, passed: f64, gap_m: f64) -> f64 {
        let left = (other.at(passed.clamp(0.0, 1.0)), other.to);
        let clear = |share: f64| segment_to_segment((self.from, self.at(share)), left) >= gap_m - ROUNDING_M;
        if clear(1.0) {
            return 1.0;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = (low + high) / 2.0;
            if clear(middle) { low = middle } else { high = middle }
        }
        low
    }
}

/// Says for hops, each valid where all before it are over, to which of them it has to yield so that they may be driven
/// at the same time. Keeps what they have of yields.
pub(crate) fn add_yields(hops: &mut [Hop], gap_m: f64) {
    let (mut next, mut next_of) = (vec![usize::MAX; hops.len()], BTreeMap::new());
    for (place, hop) in hops.iter().enumerate().rev() {
        next[place] = next_of.insert(hop.robot, place).unwrap_or(usize::MAX);
    }
    for later in 1..hops.len() {
        let hop = &hops[later];
        let mut yields = Vec::new();
        for (place, before) in hops[..later].iter().enumerate().filter(|(_, h)| h.robot != hop.robot) {
            let stays = next[place] > later;
            let stands_m = segment_to_point(hop.from, hop.to, before.to);
            let gap_m = if stays { gap_m.min(stands_m) } else { gap_m };
            if segment_to_segment((hop.from, hop.to), (before.from, before.to)) < gap_m - ROUNDING_M {
                yields.push(Yield { to: place, gap_m });
            }
        }
        hops[later].yields = yields;
    }
}

/// How long hops take if all goes well, seconds: roughly, as nobody knows how fast such robots are.
pub(crate) fn drive_s(hops: &[Hop]) -> f64 {
    let (mut begins, mut ends) = (Vec::<f64>::new(), Vec::<f64>::new());
    for (place, hop) in hops.iter().enumerate() {
        let own = (0..place).rev().find(|&before| hops[before].robot == hop.robot);
        let begin_s =
            hop.yields.iter().map(|y| begins[y.to] + FOLLOWS_S).fold(own.map_or(0.0, |b| ends[b]), f64::max);
        begins.push(begin_s);
        ends.push(begin_s + BESIDES_S + hop.length_m() / SPEED_MPS);
    }
    ends.into_iter().fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hop(robot: usize, from: (f64, f64), to: (f64, f64)) -> Hop {
        Hop::new(robot, Vec2::new(from.0, from.1), Vec2::new(to.0, to.1))
    }

    #[test]
    fn who_crosses_waits_before_the_way_of_who_goes_first() {
        let mut hops = [hop(0, (-1.0, 0.0), (1.0, 0.0)), hop(1, (0.0, -1.0), (0.0, 1.0))];
        add_yields(&mut hops, 0.084);
        let yields = hops[1].yields[0];
        assert_eq!(yields, Yield { to: 0, gap_m: 0.084 });
        let share = |passed: f64| hops[1].clear_share(&hops[0], passed, yields.gap_m);
        assert!((share(0.0) - (1.0 - 0.084) / 2.0).abs() < 1e-3, "{}", share(0.0));
        assert!(share(0.5) < 0.5 && share(0.541) < 1.0);
        assert_eq!(share(0.543), 1.0);
    }

    #[test]
    fn who_follows_keeps_its_distance() {
        let mut hops = [hop(0, (0.1, 0.0), (1.1, 0.0)), hop(1, (0.0, 0.0), (1.0, 0.0))];
        add_yields(&mut hops, 0.084);
        let share = |passed: f64| hops[1].clear_share(&hops[0], passed, 0.084);
        assert!((share(0.0) - 0.016).abs() < 1e-3);
        assert!((share(0.5) - 0.516).abs() < 1e-3);
        assert_eq!(share(1.0), 1.0);
    }

    #[test]
    fn ways_side_by_side_need_not_yield() {
        let mut hops = [hop(0, (0.0, 0.0), (0.0, 1.0)), hop(1, (0.1, 0.0), (0.1, 1.0))];
        add_yields(&mut hops, 0.084);
        assert!(hops[1].yields.is_empty());
        let near = hop(1, (0.06, 0.0), (0.06, 1.0));
        hops[1] = near;
        add_yields(&mut hops, 0.084);
        assert!(hops[1].yields.is_empty(), "they stand no farther apart at their goals: {:?}", hops[1]);
    }

    #[test]
    fn a_place_left_again_is_no_excuse() {
        let mut hops = [
            hop(0, (0.0, 0.5), (0.0, 0.02)),
            hop(0, (0.0, 0.02), (0.5, 0.5)),
            hop(1, (-0.5, 0.0), (0.5, 0.0)),
        ];
        add_yields(&mut hops, 0.084);
        assert_eq!(
            hops[2].yields.iter().map(|y| (y.to, y.gap_m)).collect::<Vec<_>>(),
            [(0, 0.084), (1, 0.084)]
        );
    }
}
