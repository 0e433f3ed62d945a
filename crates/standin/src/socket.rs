//! Messages on the socket between the process of a robot and the simulated floor. Numbers are little-endian.
//!
//! A process first sends its robot's name (one byte for the length, then the bytes), and then a [`StepCommand`] for
//! every step. When the floor has the commands of all connected processes, it answers each with a [`StepReply`]. The
//! environment variable [`ADDRESS`] holds the path of the socket.

use std::io::{self, Read, Write};

use crate::motor::Motor;
use crate::proximity::RAYS;

/// Name of the environment variable that holds the path of the socket.
pub const ADDRESS: &str = "LIGHTBOTS_STANDIN";

/// What a robot commands for the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepCommand {
    /// Motors, left and right.
    pub motors: [Motor; 2],
    /// Colour of the light, R·65536 + G·256 + B.
    pub colour: u32,
}

/// The state of the robot that the floor sends after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReply {
    /// Whether the simulation ends.
    pub ends: bool,
    /// Simulated time, seconds.
    pub time_s: f64,
    /// Readings of the wheels' sensors since the beginning, left and right, radians.
    pub wheels_rad: [f64; 2],
    /// Place in the world (x, y), metres.
    pub at: [f64; 2],
    /// Heading, radians counter-clockwise from world x.
    pub heading: f64,
    /// Distances that the proximity sensors measure, clockwise from the front, metres; infinite: nothing in range.
    pub near_m: [f64; RAYS],
}

/// Length of a [`StepCommand`] in bytes: four `f64` and one `u32`.
const COMMAND_BYTES: usize = 36;
/// Length of a [`StepReply`] in bytes: one byte, then six `f64` and one for each proximity sensor.
const REPLY_BYTES: usize = 1 + 8 * (6 + RAYS);

impl StepCommand {
    /// Writes the message.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut bytes = [0; COMMAND_BYTES];
        let [left, right] = self.motors;
        let numbers = [left.target_rad, left.radps, right.target_rad, right.radps];
        for (place, number) in bytes.chunks_exact_mut(8).zip(numbers) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes[32..].copy_from_slice(&self.colour.to_le_bytes());
        out.write_all(&bytes)
    }

    /// Reads a message.
    pub fn read(from: &mut impl Read) -> io::Result<Self> {
        let mut bytes = [0; COMMAND_BYTES];
        from.read_exact(&mut bytes)?;
        let colour = u32::from_le_bytes([bytes[32], bytes[33], bytes[34], bytes[35]]);
        let motor = |at| Motor { target_rad: number(&bytes, at), radps: number(&bytes, at + 8) };
        Ok(Self { motors: [motor(0), motor(16)], colour })
    }
}

impl StepReply {
    /// Writes the message.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut bytes = [0; REPLY_BYTES];
        bytes[0] = u8::from(self.ends);
        let pose =
            [self.time_s, self.wheels_rad[0], self.wheels_rad[1], self.at[0], self.at[1], self.heading];
        for (place, value) in bytes[1..].chunks_exact_mut(8).zip(pose.into_iter().chain(self.near_m)) {
            place.copy_from_slice(&value.to_le_bytes());
        }
        out.write_all(&bytes)
    }

    /// Reads a message.
    pub fn read(from: &mut impl Read) -> io::Result<Self> {
        let mut bytes = [0; REPLY_BYTES];
        from.read_exact(&mut bytes)?;
        Ok(Self {
            ends: bytes[0] != 0,
            time_s: number(&bytes, 1),
            wheels_rad: [number(&bytes, 9), number(&bytes, 17)],
            at: [number(&bytes, 25), number(&bytes, 33)],
            heading: number(&bytes, 41),
            near_m: std::array::from_fn(|sensor| number(&bytes, 49 + 8 * sensor)),
        })
    }
}

/// Writes the name with which a connection begins: its length and its bytes. Only the first 255 bytes of the name are
/// written.
pub fn write_name(name: &str, out: &mut impl Write) -> io::Result<()> {
    let bytes = &name.as_bytes()[..name.len().min(255)];
    out.write_all(&[bytes.len() as u8])?;
    out.write_all(bytes)
}

/// Reads the name with which a connection begins. Bytes that are not UTF-8 are replaced.
pub fn read_name(from: &mut impl Read) -> io::Result<String> {
    let mut length = [0];
    from.read_exact(&mut length)?;
    let mut bytes = vec![0; usize::from(length[0])];
    from.read_exact(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn number(bytes: &[u8], at: usize) -> f64 {
    let mut eight = [0; 8];
    eight.copy_from_slice(&bytes[at..at + 8]);
    f64::from_le_bytes(eight)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_survive_the_socket() {
        let motors =
            [Motor { target_rad: 7.0, radps: 1.5 }, Motor { target_rad: f64::INFINITY, radps: -2.5 }];
        let command = StepCommand { motors, colour: 0xff_a500 };
        let near_m = [0.01, 0.02, 0.03, f64::INFINITY, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1];
        let (wheels_rad, at) = ([1.0, 2.0], [-0.5, 1.3]);
        let reply = StepReply { ends: true, time_s: 0.016, wheels_rad, at, heading: 1.57, near_m };
        let mut bytes = Vec::new();
        command.write(&mut bytes).unwrap();
        reply.write(&mut bytes).unwrap();
        write_name("LightBot 7", &mut bytes).unwrap();
        let mut from = bytes.as_slice();
        assert_eq!(StepCommand::read(&mut from).unwrap(), command);
        assert_eq!(StepReply::read(&mut from).unwrap(), reply);
        assert_eq!(read_name(&mut from).unwrap(), "LightBot 7");
    }
}
