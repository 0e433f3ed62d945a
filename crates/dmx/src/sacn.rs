//! sACN: data packets of ANSI E1.31-2018.
//!
//! All fields have fixed offsets (table 4-1). They are read here, because the parser of the crate `sacn` 0.11.1 panics
//! on lengths that do not fit. Tests use the writer of that crate.

use crate::packet::{CHANNELS, DmxPacket, DmxSource};

/// First bytes of a packet: size of the preamble, size of the postamble, and the identifier of ACN packets.
const ROOT: [u8; 16] = *b"\x00\x10\x00\x00ASC-E1.17\x00\x00\x00";
/// Fields that have a fixed value in data packets with values of channels: byte offset and bytes.
const FIXED: [(usize, &[u8]); 6] = [
    (18, &[0, 0, 0, 4]),  // root layer: VECTOR_ROOT_E131_DATA
    (40, &[0, 0, 0, 2]),  // framing layer: VECTOR_E131_DATA_PACKET
    (117, &[2]),          // DMP layer: VECTOR_DMP_SET_PROPERTY
    (118, &[0xa1]),       // address type and data type
    (119, &[0, 0, 0, 1]), // first property address, address increment
    (125, &[0]),          // start code of DMX512-A: values of channels
];
/// Byte offsets of the three fields of flags and length. The upper four bits of a field are the flags, which must be 7.
const FLAGS: [usize; 3] = [16, 38, 115];
/// Byte offset of the component identifier (CID) of the source.
const CID: usize = 22;
/// Byte offset of the priority.
const PRIORITY: usize = 108;
/// Highest priority (6.2.3).
const PRIORITY_MAX: u8 = 200;
/// Byte offset of the sequence number.
const SEQUENCE: usize = 111;
/// Byte offset of the options.
const OPTIONS: usize = 112;
/// Bit of the options: the values are for a preview and not for lamps (6.2.6).
const PREVIEW: u8 = 0x80;
/// Bit of the options: the source ends its stream (6.2.6).
const TERMINATED: u8 = 0x40;
/// Byte offset of the universe.
const UNIVERSE: usize = 113;
/// Highest number of a universe (6.2.7).
const UNIVERSE_MAX: u16 = 63_999;
/// Byte offset of the number of values, which includes the start code.
const COUNT: usize = 123;
/// Byte offset of the value of channel 1.
const VALUES: usize = 126;

/// Decodes the payload of a UDP packet. `None` if it is no valid data packet, or its values are for a preview. Also `None`
/// for a start code other than that of values of channels.
pub fn decode_sacn(bytes: &[u8]) -> Option<DmxPacket> {
    let header: &[u8; VALUES] = bytes.first_chunk()?;
    let has_flags = FLAGS.iter().all(|&at| header[at] >> 4 == 7);
    let is_data = FIXED.iter().all(|&(at, value)| header[at..].starts_with(value));
    if !header.starts_with(&ROOT) || !has_flags || !is_data || header[OPTIONS] & PREVIEW != 0 {
        return None;
    }
    let whole = |at: usize| u16::from_be_bytes([header[at], header[at + 1]]);
    let channels = usize::from(whole(COUNT)).checked_sub(1).filter(|&count| count <= CHANNELS)?;
    let mut source = [0; 16];
    source.copy_from_slice(&header[CID..CID + 16]);
    let packet = DmxPacket {
        source: DmxSource::Sacn(source),
        priority: header[PRIORITY],
        universe: whole(UNIVERSE),
        sequence: Some(header[SEQUENCE]),
        ends: header[OPTIONS] & TERMINATED != 0,
        values: bytes.get(VALUES..VALUES + channels)?.to_vec(),
    };
    let is_valid = packet.priority <= PRIORITY_MAX && (1..=UNIVERSE_MAX).contains(&packet.universe);
    is_valid.then_some(packet)
}

#[cfg(test)]
mod tests {
    use sacn::packet::{
        AcnRootLayerProtocol, DataPacketDmpLayer, DataPacketFramingLayer, E131RootLayer, E131RootLayerData,
    };

    use super::*;

    fn framing(values: Vec<u8>) -> DataPacketFramingLayer<'static> {
        DataPacketFramingLayer {
            source_name: "desk".into(),
            priority: 120,
            synchronization_address: 0,
            sequence_number: 9,
            preview_data: false,
            stream_terminated: false,
            force_synchronization: false,
            universe: 258,
            data: DataPacketDmpLayer { property_values: values.into() },
        }
    }

    fn written(framing: DataPacketFramingLayer<'_>) -> Vec<u8> {
        let data = E131RootLayerData::DataPacket(framing);
        AcnRootLayerProtocol { pdu: E131RootLayer { cid: uuid::Uuid::from_u128(7), data } }
            .pack_alloc()
            .unwrap()
    }

    /// A start code and values.
    fn values(channels: usize) -> Vec<u8> {
        (0..=channels).map(|channel| channel as u8).collect()
    }

    #[test]
    fn another_programs_packets_are_read() {
        for channels in [0, 1, 24, 510, 512] {
            let read = decode_sacn(&written(framing(values(channels)))).unwrap();
            let mut cid = [0; 16];
            cid[15] = 7;
            assert_eq!(read.source, DmxSource::Sacn(cid));
            assert_eq!((read.priority, read.universe, read.sequence, read.ends), (120, 258, Some(9), false));
            assert_eq!(read.values, values(channels)[1..]);
        }
        let last = DataPacketFramingLayer { stream_terminated: true, ..framing(values(3)) };
        assert!(decode_sacn(&written(last)).unwrap().ends);
    }

    #[test]
    fn what_is_not_for_lamps_is_left_out() {
        let preview = DataPacketFramingLayer { preview_data: true, ..framing(values(3)) };
        assert_eq!(decode_sacn(&written(preview)), None);
        let mut other_start_code = values(3);
        other_start_code[0] = 0xdd;
        assert_eq!(decode_sacn(&written(framing(other_start_code))), None);
        let urgent = DataPacketFramingLayer { priority: 201, ..framing(values(3)) };
        assert_eq!(decode_sacn(&written(urgent)), None);
        let mut nowhere = written(framing(values(3)));
        nowhere[UNIVERSE..UNIVERSE + 2].copy_from_slice(&[0, 0]);
        assert_eq!(decode_sacn(&nowhere), None);
    }

    #[test]
    fn every_cut_is_refused_and_no_changed_byte_reads_beyond_the_end() {
        let good = written(framing(values(3)));
        for cut in 0..good.len() {
            assert_eq!(decode_sacn(&good[..cut]), None, "cut at {cut}");
        }
        for at in 0..good.len() {
            for byte in 0..=u8::MAX {
                let mut bytes = good.clone();
                bytes[at] = byte;
                let read = decode_sacn(&bytes);
                assert!(read.is_none_or(|read| read.values.len() <= 3), "{byte} at {at}");
            }
        }
    }
}
