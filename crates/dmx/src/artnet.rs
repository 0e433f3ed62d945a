//! Art-Net 4: `ArtDmx` packets.

use core::net::IpAddr;

use artnet_protocol::ArtCommand;

use crate::packet::{CHANNELS, DmxPacket, DmxSource};

/// Priority of sources of Art-Net. Their packets have no priority, so they get the usual one of sACN (ANSI E1.31-2018,
/// table 4-1).
const PRIORITY: u8 = 100;

/// Decodes the payload of a UDP packet that came from `from`. `None` if it is no valid Art-Net packet with values of
/// channels.
pub fn decode_artnet(from: IpAddr, bytes: &[u8]) -> Option<DmxPacket> {
    let ArtCommand::Output(output) = ArtCommand::from_buffer(bytes).ok()? else { return None };
    let sent = output.data.as_ref();
    // The library keeps all bytes after the header, also those beyond the length that the packet states.
    let count = usize::from(*output.length);
    let values = sent.get(..count).filter(|values| (1..=CHANNELS).contains(&values.len()))?;
    Some(DmxPacket {
        source: DmxSource::ArtNet(from),
        priority: PRIORITY,
        universe: output.port_address.into(),
        sequence: Some(output.sequence).filter(|&sequence| sequence != 0),
        ends: false,
        values: values.to_vec(),
    })
}

#[cfg(test)]
mod tests {
    use core::net::Ipv4Addr;

    use artnet_protocol::Output;

    use super::*;

    const FROM: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);

    fn packet(sequence: u8, values: Vec<u8>) -> Vec<u8> {
        let output = Output { sequence, data: values.into(), ..Output::default() };
        ArtCommand::Output(output).write_to_buffer().unwrap()
    }

    #[test]
    fn values_of_a_universe_are_read() {
        let values: Vec<u8> = (0..510).map(|channel| channel as u8).collect();
        let read = decode_artnet(FROM, &packet(7, values.clone())).unwrap();
        assert_eq!((read.universe, read.priority, read.sequence), (1, 100, Some(7)));
        assert_eq!((read.source, read.ends), (DmxSource::ArtNet(FROM), false));
        assert_eq!(read.values, values);
        assert_eq!(decode_artnet(FROM, &packet(0, vec![1, 2])).unwrap().sequence, None);
    }

    #[test]
    fn the_length_in_the_packet_counts() {
        let mut bytes = packet(1, vec![1, 2, 3, 4]);
        bytes.extend([9; 40]);
        assert_eq!(decode_artnet(FROM, &bytes).unwrap().values, [1, 2, 3, 4]);
        let place = bytes.len() - 40 - 4 - 2;
        bytes[place..place + 2].copy_from_slice(&[0, 45]);
        assert_eq!(decode_artnet(FROM, &bytes), None, "it says more than came");
        bytes[place..place + 2].copy_from_slice(&[0, 0]);
        assert_eq!(decode_artnet(FROM, &bytes), None);
        bytes[place..place + 2].copy_from_slice(&[2, 1]);
        bytes.resize(1000, 0);
        assert_eq!(decode_artnet(FROM, &bytes), None, "513 channels");
    }

    #[test]
    fn other_packets_carry_no_values() {
        let poll = ArtCommand::Poll(Default::default()).write_to_buffer().unwrap();
        assert_eq!(decode_artnet(FROM, &poll), None);
        assert_eq!(decode_artnet(FROM, b""), None);
        assert_eq!(decode_artnet(FROM, b"Art-Net\0"), None);
    }

    #[test]
    fn no_cut_and_no_changed_byte_reads_beyond_the_end() {
        let good = packet(1, vec![1, 2, 3, 4]);
        for cut in 0..good.len() {
            assert_eq!(decode_artnet(FROM, &good[..cut]), None, "cut at {cut}");
        }
        for at in 0..good.len() {
            for byte in 0..=u8::MAX {
                let mut bytes = good.clone();
                bytes[at] = byte;
                let read = decode_artnet(FROM, &bytes);
                assert!(read.is_none_or(|read| read.values.len() <= 4), "{byte} at {at}");
            }
        }
    }
}
