//! Places of all robots in a binary message, because JSON of 10,000 robots 20 times a second would be too slow.
//!
//! The message is the number of robots as `u32`, then each list of [`Robots`] in turn, with one entry per robot. Numbers
//! are little-endian. NaN stands for unknown values.

use ts_rs::TS;

/// Places, lights and statuses: every list has one entry per robot, in the order of the fleet table.
#[derive(Clone, Debug, Default, PartialEq, TS)]
pub struct Robots {
    /// Measured x, stage metres, rounded to 0.1 mm; NaN: unknown.
    #[ts(type = "Float32Array")]
    pub x: Vec<f32>,
    /// Measured y, stage metres, rounded to 0.1 mm; NaN: unknown.
    #[ts(type = "Float32Array")]
    pub y: Vec<f32>,
    /// Planned x now, stage metres; NaN: the robot drives no path now. A planned place is never drawn as a measured
    /// one.
    #[ts(type = "Float32Array")]
    pub planned_x: Vec<f32>,
    /// Planned y now, stage metres; NaN: the robot drives no path now.
    #[ts(type = "Float32Array")]
    pub planned_y: Vec<f32>,
    /// x of the place where the robot is to stand after its present or last drive, stage metres; NaN: there was no
    /// drive.
    #[ts(type = "Float32Array")]
    pub goal_x: Vec<f32>,
    /// y of the place where the robot is to stand after its present or last drive, stage metres; NaN: there was no
    /// drive.
    #[ts(type = "Float32Array")]
    pub goal_y: Vec<f32>,
    /// Colour that the light should have: R·65536 + G·256 + B.
    #[ts(type = "Uint32Array")]
    pub colour: Vec<u32>,
    /// Index of the robot's `RobotStatus`, from 0.
    #[ts(type = "Uint8Array")]
    pub status: Vec<u8>,
}

/// A list of [`Robots`].
enum Column<'a> {
    Metres(&'a [f32]),
    Colours(&'a [u32]),
    Bytes(&'a [u8]),
}

impl Robots {
    /// The lists in the order of the message, with their names. Lists of four-byte numbers come first, so that they are
    /// aligned and a screen reads them without copying.
    fn columns(&self) -> [(&'static str, Column<'_>); 8] {
        [
            ("x", Column::Metres(&self.x)),
            ("y", Column::Metres(&self.y)),
            ("planned_x", Column::Metres(&self.planned_x)),
            ("planned_y", Column::Metres(&self.planned_y)),
            ("goal_x", Column::Metres(&self.goal_x)),
            ("goal_y", Column::Metres(&self.goal_y)),
            ("colour", Column::Colours(&self.colour)),
            ("status", Column::Bytes(&self.status)),
        ]
    }

    /// The bytes of the message.
    ///
    /// # Panics
    /// If the lists differ in length.
    pub fn to_bytes(&self) -> Vec<u8> {
        let count = self.x.len();
        let size = self.columns().iter().map(|(_, column)| column.width()).sum::<usize>();
        let mut bytes = Vec::with_capacity(4 + count * size);
        bytes.extend((count as u32).to_le_bytes());
        for (name, column) in self.columns() {
            let length = column.append(&mut bytes);
            assert_eq!(length, count, "the list '{name}' is not as long as the others");
        }
        bytes
    }

    /// Reads a message. `None` if the bytes are not exactly one message.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let (count, mut rest) = bytes.split_first_chunk()?;
        let count = u32::from_le_bytes(*count) as usize;
        let words = |rest: &mut &[u8]| -> Option<Vec<[u8; 4]>> {
            let (column, after) = rest.split_at_checked(count.checked_mul(4)?)?;
            *rest = after;
            Some(column.as_chunks().0.to_vec())
        };
        let mut metres = || Some(words(&mut rest)?.into_iter().map(f32::from_le_bytes).collect::<Vec<f32>>());
        let (x, y) = (metres()?, metres()?);
        let (planned_x, planned_y) = (metres()?, metres()?);
        let (goal_x, goal_y) = (metres()?, metres()?);
        let colour = words(&mut rest)?.into_iter().map(u32::from_le_bytes).collect();
        let status = rest.to_vec();
        let is_whole = status.len() == count;
        is_whole.then_some(Self { x, y, planned_x, planned_y, goal_x, goal_y, colour, status })
    }

    /// The lists in TypeScript: name and kind of array, in the order of the message.
    pub(crate) fn typescript_columns() -> String {
        let columns = Self::default();
        let columns = columns.columns().map(|(name, column)| format!("[\"{name}\", {}]", column.array()));
        format!("[\n  {},\n]", columns.join(",\n  "))
    }
}

impl Column<'_> {
    /// Bytes per entry.
    const fn width(&self) -> usize {
        match self {
            Self::Metres(_) | Self::Colours(_) => 4,
            Self::Bytes(_) => 1,
        }
    }

    /// Appends the list to the message. Returns the number of entries.
    fn append(&self, bytes: &mut Vec<u8>) -> usize {
        match self {
            Self::Metres(list) => {
                bytes.extend(list.iter().flat_map(|number| number.to_le_bytes()));
                list.len()
            }
            Self::Colours(list) => {
                bytes.extend(list.iter().flat_map(|number| number.to_le_bytes()));
                list.len()
            }
            Self::Bytes(list) => {
                bytes.extend(*list);
                list.len()
            }
        }
    }

    const fn array(&self) -> &'static str {
        match self {
            Self::Metres(_) => "Float32Array",
            Self::Colours(_) => "Uint32Array",
            Self::Bytes(_) => "Uint8Array",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Robots {
        Robots {
            x: vec![0.5, f32::NAN],
            y: vec![-1.25, f32::NAN],
            planned_x: vec![0.75, 0.0],
            planned_y: vec![1.0, 2.0],
            goal_x: vec![3.0, 4.0],
            goal_y: vec![5.0, 6.0],
            colour: vec![0x00ff_8000, 1],
            status: vec![2, 6],
        }
    }

    #[test]
    fn the_message_is_a_count_and_eight_lists() {
        let bytes = two().to_bytes();
        assert_eq!(bytes.len(), 4 + 2 * 29);
        assert_eq!(bytes[..8], [2, 0, 0, 0, 0, 0, 0, 0x3f]);
        assert_eq!(bytes[4 + 2 * 24..], [0x00, 0x80, 0xff, 0x00, 1, 0, 0, 0, 2, 6]);
    }

    #[test]
    fn what_was_written_is_read() {
        let read = Robots::from_bytes(&two().to_bytes()).unwrap();
        assert!(read.x[1].is_nan());
        assert_eq!(read.to_bytes(), two().to_bytes());
        assert_eq!(Robots::from_bytes(&Robots::default().to_bytes()), Some(Robots::default()));
    }

    #[test]
    fn a_message_that_is_cut_or_goes_on_is_none() {
        let mut bytes = two().to_bytes();
        for length in 0..bytes.len() {
            assert_eq!(Robots::from_bytes(&bytes[..length]), None, "{length}");
        }
        bytes.push(0);
        assert_eq!(Robots::from_bytes(&bytes), None);
        assert_eq!(Robots::from_bytes(&[255; 40]), None);
    }
}
