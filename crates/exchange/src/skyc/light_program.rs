//! Light programs: operations, each with its colour and its duration in ticks of 20 ms.

use lightbots_base::varint;

use super::TICKS_PER_S;
use crate::limits::LONGEST_S;
use crate::timed::fit::FittedStretch;
use crate::timed::light::{CodeStretch, TimedLight};

/// Latest tick at which a stretch of light may end: one day. A longer program is an error.
const TICKS_MAX: u64 = (LONGEST_S * TICKS_PER_S) as u64;
/// Deepest nesting of loops. A program with more is an error.
const LOOPS_MAX: usize = 32;

/// Ends the program.
const END: u8 = 0x00;
/// Does nothing and takes no time.
const NOTHING: u8 = 0x01;
/// Keeps the colour for a number of ticks.
const SLEEP: u8 = 0x02;
/// Keeps the colour until a tick, counted from the start of the program.
const WAIT_UNTIL: u8 = 0x03;
/// The first of four operations with successive codes. They set a colour, a grey, black and white.
const SET: u8 = 0x04;
/// The first of four operations with successive codes. They fade to a colour, a grey, black and white.
const FADE: u8 = 0x08;
/// Begins a loop. A byte follows that says how often the loop is run; 0: for ever.
const LOOP: u8 = 0x0c;
/// Ends the innermost loop.
const LOOP_END: u8 = 0x0d;
/// The two operations for pyrotechnics. They are skipped with the one byte that follows each of them, and take no time.
const PYRO: [u8; 2] = [0x14, 0x15];

/// Writes the program of a light. `stretches` count in ticks: they were fitted to samples one tick apart.
pub(super) fn program(stretches: &[FittedStretch]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut begin = 0;
    let mut now = None;
    for stretch in stretches {
        let ticks = (stretch.end - begin) as u64;
        match (stretch.fades, now == Some(stretch.to)) {
            (false, true) if ticks == 0 => {}
            (false, true) => bytes.push(SLEEP),
            (false, false) => colour(&mut bytes, SET, stretch.to),
            (true, _) => colour(&mut bytes, FADE, stretch.to),
        }
        if ticks > 0 || now != Some(stretch.to) {
            varint(ticks, &mut |byte| bytes.push(byte));
        }
        (begin, now) = (stretch.end, Some(stretch.to));
    }
    bytes.push(END);
    bytes
}

/// Adds the shortest operation for a colour to `bytes`. `first` is [`SET`] or [`FADE`], the first of four operations.
fn colour(bytes: &mut Vec<u8>, first: u8, code: [u8; 3]) {
    match code {
        [0, 0, 0] => bytes.push(first + 2),
        [255, 255, 255] => bytes.push(first + 3),
        [grey, g, b] if g == grey && b == grey => bytes.extend([first + 1, grey]),
        [r, g, b] => bytes.extend([first, r, g, b]),
    }
}

/// A program that is being read.
struct Program<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Sum of the durations of the operations that were run, ticks.
    tick: u64,
    light: TimedLight,
    /// For each open loop, the outermost first: index of the first byte of its body, and how often the body is still to
    /// be repeated. `None`: for ever.
    loops: Vec<(usize, Option<u32>)>,
}

/// Runs a light program and returns its light. `room` is the number of operations and stretches that may still follow
/// in the whole file. An endless loop stops after the first repetition that ends at or after `end_s`, seconds from the
/// start of the show.
pub(super) fn read(bytes: &[u8], end_s: f64, room: &mut usize) -> Result<TimedLight, String> {
    let light = TimedLight { is_linear: true, ..TimedLight::default() };
    let mut program = Program { bytes, at: 0, tick: 0, light, loops: Vec::new() };
    let last_tick = (end_s * TICKS_PER_S) as u64;
    while program.at < bytes.len() {
        *room = room.checked_sub(1).ok_or("its light program takes too many steps; simplify its loops")?;
        if !program.step(last_tick, room)? {
            break;
        }
    }
    Ok(program.light)
}

impl Program<'_> {
    /// Runs one operation. Returns `false` at the end of the program, and for an endless loop at or after `last_tick`.
    fn step(&mut self, last_tick: u64, room: &mut usize) -> Result<bool, String> {
        let operation = self.byte()?;
        match operation {
            END => return Ok(false),
            NOTHING => {}
            SLEEP => {
                let ticks = self.varint()?;
                self.shine(self.light.last(), ticks, false, room)?;
            }
            WAIT_UNTIL => {
                let ticks = self.varint()?.saturating_sub(self.tick);
                self.shine(self.light.last(), ticks, false, room)?;
            }
            SET..LOOP => {
                let code = self.colour(operation % 4)?;
                let ticks = self.varint()?;
                self.shine(code, ticks, operation >= FADE, room)?;
            }
            LOOP => {
                let times = self.byte()?;
                if self.loops.len() >= LOOPS_MAX {
                    return Err(format!("its light program nests more than {LOOPS_MAX} loops; simplify it"));
                }
                self.loops.push((self.at, (times > 0).then(|| u32::from(times) - 1)));
            }
            LOOP_END => {
                let Some((begin, left)) = self.loops.last_mut() else {
                    return Err("its light program ends a loop that never began; export it again".into());
                };
                match left {
                    Some(0) => drop(self.loops.pop()),
                    None if self.tick >= last_tick => return Ok(false),
                    left => {
                        *left = left.map(|left| left - 1);
                        self.at = *begin;
                    }
                }
            }
            _ if PYRO.contains(&operation) => drop(self.byte()?),
            other => {
                return Err(format!(
                    "its light program has the operation 0x{other:02x}, which is not known; export it without"
                ));
            }
        }
        Ok(true)
    }

    /// Adds a stretch of light of `ticks` ticks with the codes `to`.
    fn shine(&mut self, to: [u8; 3], ticks: u64, fades: bool, room: &mut usize) -> Result<(), String> {
        self.tick = self.tick.saturating_add(ticks).min(TICKS_MAX + 1);
        self.light.push(CodeStretch { end_s: self.tick as f64 / TICKS_PER_S, to, fades }, room)
    }

    fn byte(&mut self) -> Result<u8, String> {
        let byte = self.bytes.get(self.at).copied().ok_or("its light program is cut off; export it again")?;
        self.at += 1;
        Ok(byte)
    }

    fn varint(&mut self) -> Result<u64, String> {
        let mut value = 0;
        for shift in (0..35).step_by(7) {
            let byte = self.byte()?;
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err("its light program has a duration of more than five bytes; export it again".into())
    }

    /// Reads the colour of an operation. `kind` is 0 for a colour of three bytes, 1 for a grey of one byte, 2 for black
    /// and 3 for white.
    fn colour(&mut self, kind: u8) -> Result<[u8; 3], String> {
        Ok(match kind {
            0 => [self.byte()?, self.byte()?, self.byte()?],
            1 => [self.byte()?; 3],
            2 => [0; 3],
            _ => [255; 3],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hold(end: usize, to: [u8; 3]) -> FittedStretch {
        FittedStretch { end, to, fades: false }
    }

    fn fade(end: usize, to: [u8; 3]) -> FittedStretch {
        FittedStretch { fades: true, ..hold(end, to) }
    }

    #[test]
    fn programs_have_the_bytes_of_the_format() {
        let red_to_blue = [hold(100, [255, 0, 0]), fade(250, [0, 0, 255]), hold(500, [0, 0, 255])];
        let bytes = [4, 255, 0, 0, 100, 8, 0, 0, 255, 0x96, 1, 2, 0xfa, 1, 0];
        assert_eq!(program(&red_to_blue), bytes);
        assert_eq!(program(&[hold(50, [255; 3]), fade(150, [0; 3])]), [7, 50, 0x0a, 100, 0]);
        assert_eq!(program(&[hold(0, [9; 3]), fade(1, [8; 3])]), [5, 9, 0, 9, 8, 1, 0]);
    }

    fn light(bytes: &[u8]) -> Result<TimedLight, String> {
        read(bytes, 10.0, &mut 1_000)
    }

    #[test]
    fn programs_are_read_back() {
        let stretches = [hold(0, [9, 0, 0]), fade(150, [7; 3]), hold(300, [7; 3]), hold(301, [0; 3])];
        let read = light(&program(&stretches)).unwrap();
        let ends: Vec<f64> = read.stretches.iter().map(|stretch| stretch.end_s).collect();
        assert_eq!(ends, [0.0, 3.0, 6.0, 6.02]);
        assert!(read.is_linear && read.stretches[1].fades && read.stretches[1].to == [7; 3]);
    }

    #[test]
    fn loops_waits_and_pyrotechnics_are_played() {
        // Twice: white 1 tick, black 2 ticks. Then grey until tick 20, and an ignition.
        let twice = light(&[0x0c, 2, 7, 1, 6, 2, 0x0d, 5, 9, 0, 3, 20, 0x14, 3, 1, 0]).unwrap();
        let ends: Vec<u64> =
            twice.stretches.iter().map(|stretch| (stretch.end_s * 50.0).round() as u64).collect();
        assert_eq!(ends, [1, 3, 4, 6, 20]);
        let for_ever = light(&[0x0c, 0, 7, 25, 6, 25, 0x0d, 0]).unwrap();
        assert_eq!(for_ever.end_s(), 10.0);
    }

    #[test]
    fn hostile_programs_end_with_words() {
        for (bytes, part) in [
            (vec![4, 1], "cut off"),
            (vec![2], "cut off"),
            (vec![2, 255, 255, 255, 255, 255, 255, 0], "more than five bytes"),
            (vec![0x0d], "never began"),
            (vec![0x40], "0x40"),
            (vec![0x0c, 0, 1, 0x0d], "too many steps"),
            ([0x0c, 255].repeat(40), "more than 32 loops"),
            ([[0x0c, 255].repeat(30), vec![2, 1], [0x0d].repeat(30)].concat(), "too many steps"),
            (vec![2, 255, 255, 255, 255, 15], "a day"),
        ] {
            let error = light(&bytes).unwrap_err();
            assert!(error.contains(part), "{bytes:?}: {error}");
        }
    }
}
