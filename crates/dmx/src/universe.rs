//! One universe: its sources, and the colours that result from them.

use lightbots_base::{Instant, Rgb, Span};

use crate::packet::{DmxPacket, DmxSource};

/// Time without a packet after which a source of sACN counts as lost: "network data loss" in ANSI E1.31-2018, 6.7.1.
const SACN_LOSS: Span = Span::from_millis(2_500);
/// Time without a packet after which a source of Art-Net counts as lost. Sources may repeat unchanged values only every 4 s;
/// this is two repetitions and a reserve. With less than 4 s, robots would switch between the light of desk and show. With a
/// longer time, a desk that was switched off would keep its robots for longer.
const ARTNET_LOSS: Span = Span::from_millis(10_000);
/// Largest number of sources in a universe. More sources mean conflicting desks or untrusted senders. A further source
/// replaces the source of the lowest priority if its own priority is higher, and is ignored otherwise.
const SOURCES_MAX: usize = 4;
/// A packet is old if its sequence number equals the last one of its source, or is below that number by less than this.
/// Numbers count modulo 256 (ANSI E1.31-2018, 6.7.2).
const OLD_NUMBERS: i8 = 20;

/// What happened with a received packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taken {
    /// The packet has the newest values of its source, or ended the stream of its source.
    Newest,
    /// The packet was ignored, because a later packet of its source, or the same one, had come before.
    Old,
    /// The packet was ignored, because the universe has too many sources.
    Crowded,
}

#[derive(Debug)]
struct Source {
    id: DmxSource,
    priority: u8,
    sequence: Option<u8>,
    heard: Instant,
    values: Vec<u8>,
}

/// The newest values of each source of a universe.
#[derive(Debug, Default)]
pub(crate) struct Universe {
    sources: Vec<Source>,
}

impl Universe {
    /// Receives a packet of this universe, and keeps its values unless it is ignored or ends its source's stream.
    /// Removes lost sources first.
    pub fn receive(&mut self, now: Instant, packet: DmxPacket) -> Taken {
        self.expire(now);
        let place = self.sources.iter().position(|source| source.id == packet.source);
        if let Some(place) = place {
            if is_old(self.sources[place].sequence, packet.sequence) {
                return Taken::Old;
            }
            self.sources.swap_remove(place);
        }
        if packet.ends {
            return Taken::Newest;
        }
        if self.sources.len() >= SOURCES_MAX {
            let lowest = (0..self.sources.len()).min_by_key(|&place| self.sources[place].priority);
            let Some(lowest) = lowest.filter(|&place| self.sources[place].priority < packet.priority) else {
                return Taken::Crowded;
            };
            self.sources.swap_remove(lowest);
        }
        let DmxPacket { source: id, priority, sequence, values, .. } = packet;
        self.sources.push(Source { id, priority, sequence, heard: now, values });
        Taken::Newest
    }

    /// Removes the sources that are lost at `now`.
    pub fn expire(&mut self, now: Instant) {
        self.sources.retain(|source| now - source.heard < loss(source.id));
    }

    /// Whether the universe has a source that is not lost.
    pub fn is_lit(&self) -> bool {
        !self.sources.is_empty()
    }

    /// Returns the colour on three successive channels; `channel`, counted from 1, is the first. Only sources of the highest
    /// priority that send all three channels count; of several, each channel takes the highest value. `None` if there are
    /// none.
    pub fn colour(&self, channel: u16) -> Option<Rgb> {
        let highest = self.sources.iter().map(|source| source.priority).max()?;
        let from = usize::from(channel).checked_sub(1)?;
        let values = |source: &Source| source.values.get(from..from + 3).map(|rgb| [rgb[0], rgb[1], rgb[2]]);
        let counts = self.sources.iter().filter(|source| source.priority == highest).filter_map(values);
        let [r, g, b] = counts.reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1]), a[2].max(b[2])])?;
        Some(Rgb::new(r, g, b))
    }
}

fn loss(source: DmxSource) -> Span {
    match source {
        DmxSource::ArtNet(_) => ARTNET_LOSS,
        DmxSource::Sacn(_) => SACN_LOSS,
    }
}

fn is_old(last: Option<u8>, next: Option<u8>) -> bool {
    let (Some(last), Some(next)) = (last, next) else { return false };
    (1 - OLD_NUMBERS..=0).contains(&next.wrapping_sub(last).cast_signed())
}

#[cfg(test)]
mod tests {
    use core::net::Ipv4Addr;

    use super::*;

    fn packet(source: u8, priority: u8, sequence: u8, values: &[u8]) -> DmxPacket {
        DmxPacket {
            source: DmxSource::Sacn([source; 16]),
            priority,
            universe: 1,
            sequence: Some(sequence),
            ends: false,
            values: values.to_vec(),
        }
    }

    fn ms(ms: u64) -> Instant {
        Instant(ms * 1000)
    }

    #[test]
    fn the_highest_priority_counts_and_among_equals_the_highest_value() {
        let mut universe = Universe::default();
        assert_eq!(universe.colour(1), None);
        universe.receive(ms(0), packet(1, 100, 0, &[10, 200, 0, 1, 2, 3]));
        universe.receive(ms(0), packet(2, 100, 0, &[90, 20, 5]));
        assert_eq!(universe.colour(1), Some(Rgb::new(90, 200, 5)));
        assert_eq!(universe.colour(4), Some(Rgb::new(1, 2, 3)), "the other source ends before");
        universe.receive(ms(0), packet(3, 101, 0, &[0, 0, 1]));
        assert_eq!(universe.colour(1), Some(Rgb::new(0, 0, 1)));
        assert_eq!(universe.colour(4), None, "the source that counts does not send these channels");
        universe.receive(ms(0), DmxPacket { ends: true, ..packet(3, 101, 1, &[]) });
        assert_eq!(universe.colour(1), Some(Rgb::new(90, 200, 5)));
        assert_eq!(universe.colour(5), None, "two of three channels");
        assert_eq!([0, 511, u16::MAX].map(|channel| universe.colour(channel)), [None; 3]);
    }

    #[test]
    fn a_silent_source_is_lost_after_two_and_a_half_seconds() {
        let mut universe = Universe::default();
        universe.receive(ms(0), packet(1, 150, 0, &[9; 3]));
        universe.receive(ms(1_000), packet(2, 100, 0, &[7; 3]));
        universe.expire(ms(2_499));
        assert_eq!(universe.colour(1), Some(Rgb::new(9, 9, 9)));
        universe.expire(ms(2_500));
        assert_eq!(universe.colour(1), Some(Rgb::new(7, 7, 7)));
        universe.expire(ms(3_500));
        assert!(!universe.is_lit());
        let source = DmxSource::ArtNet(Ipv4Addr::LOCALHOST.into());
        universe.receive(ms(0), DmxPacket { source, ..packet(0, 100, 1, &[1; 3]) });
        universe.expire(ms(9_999));
        assert!(universe.is_lit(), "Art-Net sends again every four seconds");
        universe.expire(ms(10_000));
        assert!(!universe.is_lit());
    }

    #[test]
    fn an_overtaken_packet_changes_nothing() {
        let mut universe = Universe::default();
        let mut receive = |sequence: u8| universe.receive(ms(0), packet(1, 100, sequence, &[sequence; 3]));
        assert_eq!(receive(250), Taken::Newest);
        assert_eq!([250, 249, 231].map(&mut receive), [Taken::Old; 3]);
        assert_eq!(receive(3), Taken::Newest, "it counts modulo 256");
        assert_eq!(receive(240), Taken::Old);
        assert_eq!(receive(239), Taken::Newest, "20 below: the source began again");
        assert_eq!(universe.colour(1), Some(Rgb::new(239, 239, 239)));
        let uncounted = DmxPacket {
            source: DmxSource::ArtNet(Ipv4Addr::LOCALHOST.into()),
            sequence: None,
            ..packet(0, 200, 0, &[1, 2, 3])
        };
        assert_eq!([(); 2].map(|()| universe.receive(ms(0), uncounted.clone())), [Taken::Newest; 2]);
    }

    #[test]
    fn many_sources_are_bounded_and_priority_gets_in() {
        let mut universe = Universe::default();
        for source in 0..100 {
            universe.receive(ms(0), packet(source, 100, 0, &[source; 3]));
        }
        assert_eq!(universe.sources.len(), SOURCES_MAX);
        assert_eq!(universe.receive(ms(0), packet(200, 100, 0, &[200; 3])), Taken::Crowded);
        assert_eq!(universe.receive(ms(0), packet(200, 101, 0, &[200; 3])), Taken::Newest);
        assert_eq!(universe.sources.len(), SOURCES_MAX);
        assert_eq!(universe.colour(1), Some(Rgb::new(200, 200, 200)));
    }
}
