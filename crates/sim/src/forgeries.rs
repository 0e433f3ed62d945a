//! Robots whose messages are changed after their firmware wrote them: they report a false place, or flood the network.

use std::borrow::Cow;

use lightbots_base::Vec2;
use lightbots_wire::{Report, Topic};

/// Number of copies of its last report that a flooding robot sends in each step: 2,500 a second.
const FLOOD: usize = 40;

/// Which robots send forged messages, and how.
#[derive(Clone, Debug, Default)]
pub(crate) struct Forgeries {
    /// Robots that report a false place, each with the error added to it, metres.
    lies: Vec<(usize, Vec2)>,
    /// Robots that flood the network, each with its last report; empty before its first report.
    floods: Vec<(usize, Vec<u8>)>,
}

impl Forgeries {
    /// Makes a robot report places with the error `off` (metres, stage axes). Zero makes it report true places again.
    pub fn lie(&mut self, robot: usize, off: Vec2) {
        self.lies.retain(|(liar, _)| *liar != robot);
        if off != Vec2::ZERO {
            self.lies.push((robot, off));
        }
    }

    /// Makes a robot begin or cease to flood the network.
    pub fn flood(&mut self, robot: usize, floods: bool) {
        self.floods.retain(|(flooding, _)| *flooding != robot);
        if floods {
            self.floods.push((robot, Vec::new()));
        }
    }

    /// Returns the text that a robot sends in place of `text`, which its firmware wrote. The text is the same unless
    /// the robot lies and the text is a report with a place. If the robot floods the network, the returned text is
    /// stored as its last report. Texts on the topic TIME are never changed or stored.
    pub fn forge<'a>(&mut self, robot: usize, topic: Topic, text: &'a [u8]) -> Cow<'a, [u8]> {
        if self.lies.is_empty() && self.floods.is_empty() || topic == Topic::Time {
            return Cow::Borrowed(text);
        }
        let lie = self.lies.iter().find(|(liar, _)| *liar == robot);
        let sent = lie.and_then(|(_, off)| moved(text, *off)).map_or(Cow::Borrowed(text), Cow::Owned);
        if let Some((_, last)) = self.floods.iter_mut().find(|(flooding, _)| *flooding == robot) {
            *last = sent.to_vec();
        }
        sent
    }

    /// The additional messages of this step: the index of a flooding robot, and the text.
    pub fn floods(&self) -> impl Iterator<Item = (usize, &[u8])> {
        let reported = self.floods.iter().filter(|(_, last)| !last.is_empty());
        reported.flat_map(|(robot, last)| std::iter::repeat_n((*robot, &last[..]), FLOOD))
    }
}

/// Returns the report with `off` added to its place, metres. `None` if the text is no report with a place.
fn moved(text: &[u8], off: Vec2) -> Option<Vec<u8>> {
    let mut report = Report::decode(text)?;
    report.at = Some(report.at? + off);
    let mut out = String::new();
    report.encode(&mut out).ok()?;
    Some(out.into_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lie_changes_the_place_and_ends() {
        let mut forgeries = Forgeries::default();
        let honest = b"r1 0.5 1 state=idle";
        forgeries.lie(3, Vec2::new(0.25, -1.0));
        let lie = forgeries.forge(3, Topic::Status, honest).into_owned();
        let report = Report::decode(&lie).unwrap();
        assert_eq!((report.at, report.details.is_some()), (Some(Vec2::new(0.75, 0.0)), true));
        assert_eq!(*forgeries.forge(2, Topic::Status, honest), *honest);
        forgeries.lie(3, Vec2::ZERO);
        assert_eq!(*forgeries.forge(3, Topic::Status, honest), *honest);
    }

    #[test]
    fn a_flood_repeats_the_last_report() {
        let mut forgeries = Forgeries::default();
        forgeries.flood(1, true);
        assert_eq!(forgeries.floods().count(), 0);
        forgeries.forge(1, Topic::Status, b"r1 0 0");
        assert!(
            forgeries.floods().all(|flood| flood == (1, b"r1 0 0")) && forgeries.floods().count() == FLOOD
        );
        forgeries.flood(1, false);
        assert_eq!(forgeries.floods().count(), 0);
    }
}
