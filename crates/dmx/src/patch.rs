//! The patch table: which channels belong to which robot.

use core::fmt;
use std::collections::{BTreeMap, BTreeSet};

use lightbots_base::RobotId;

use crate::packet::CHANNELS;

/// Largest number of robots in a universe: each has three channels.
const ROBOTS: u32 = (CHANNELS / 3) as u32;
/// Highest channel, counted from 1, at which a colour of three channels may begin.
const CHANNEL_MAX: u16 = (CHANNELS - 2) as u16;
/// Highest number of a universe in a table: the highest of sACN (ANSI E1.31-2018, 6.2.7). In Art-Net, the highest is 32767.
const UNIVERSE_MAX: u16 = 63_999;
/// Largest number of robots in a table: the size of the largest fleet.
const ROBOTS_MAX: usize = 20_000;
/// Largest number of universes in the lines of single robots. A universe takes up to 2 KB of memory for values. The
/// largest fleet fills 118 if there are no gaps between robots' channels.
const UNIVERSES_MAX: usize = 512;
/// The word with which a line begins that is for all robots without a line of their own.
const OTHERS: &str = "others";

/// Where a desk sends a robot's colour: red, green and blue on three successive channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct DmxAddress {
    /// Number of the universe.
    pub universe: u16,
    /// The channel of red, counted from 1.
    pub channel: u16,
}

/// Which channels belong to which robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatchTable {
    /// Channels of the robots that have a line. The key is the robot's name, or its number in decimal digits.
    listed: BTreeMap<RobotId, DmxAddress>,
    /// Universe of the robot with the number 0 if it has no line of its own. Robots with higher numbers follow without
    /// gaps, also in further universes. `None`: robots without a line have no channels.
    others: Option<u16>,
}

/// A line of a patch table that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatchError {
    /// Number of the line, counted from 1.
    pub line: usize,
    /// What is wrong with the line, and what to do.
    pub what: String,
}

impl fmt::Display for PatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.what)
    }
}

impl Default for PatchTable {
    /// A table without lines for single robots. The robot with the number n, from 0, has universe 1 + n/170, rounded down,
    /// and three channels from 3·(n mod 170) + 1 on.
    fn default() -> Self {
        Self { listed: BTreeMap::new(), others: Some(1) }
    }
}

impl PatchTable {
    /// Reads lines `ROBOT UNIVERSE CHANNEL` and at most one line `others UNIVERSE`. ROBOT is a robot's name, or its number
    /// counted from 0. Text after `#` is a comment.
    pub fn read(text: &str) -> Result<Self, PatchError> {
        let mut table = Self { listed: BTreeMap::new(), others: None };
        let mut universes = BTreeSet::new();
        for (index, line) in text.lines().enumerate() {
            let wrong = |what: String| PatchError { line: index + 1, what };
            let fields: Vec<&str> =
                line.split('#').next().unwrap_or_default().split_ascii_whitespace().collect();
            match fields.as_slice() {
                [] => continue,
                [word, universe] if *word == OTHERS => {
                    let universe = read_universe(universe).map_err(wrong)?;
                    if table.others.replace(universe).is_some() {
                        return Err(wrong(format!("'{OTHERS}' stands twice: remove one")));
                    }
                }
                [robot, universe, channel] => {
                    let (robot, address) = read_row(robot, universe, channel).map_err(wrong)?;
                    universes.insert(address.universe);
                    if table.listed.insert(robot, address).is_some() {
                        return Err(wrong(format!("robot {robot} stands twice: remove one")));
                    }
                }
                _ => {
                    let form = format!("write ROBOT UNIVERSE CHANNEL, or {OTHERS} UNIVERSE");
                    return Err(wrong(format!("{} words: {form}", fields.len())));
                }
            }
            if table.listed.len() > ROBOTS_MAX {
                return Err(wrong(format!("more than {ROBOTS_MAX} robots: use '{OTHERS} UNIVERSE'")));
            }
            if universes.len() > UNIVERSES_MAX {
                return Err(wrong(format!("more than {UNIVERSES_MAX} universes: put more robots on each")));
            }
        }
        Ok(table)
    }

    /// Returns the channels of a robot; `None`: it has none. `number` is the robot's index among all robots in the order of
    /// their names, from 0. A line for the robot's name counts before a line for its number.
    pub fn address(&self, robot: RobotId, number: u32) -> Option<DmxAddress> {
        let by_number = || RobotId::new(&number.to_string()).and_then(|number| self.listed.get(&number));
        self.listed.get(&robot).or_else(by_number).copied().or_else(|| self.following(number))
    }

    /// Returns the channels that a robot with this number has by the line `others`; `None`: none.
    fn following(&self, number: u32) -> Option<DmxAddress> {
        let universe = u32::from(self.others?) + number / ROBOTS;
        let universe = u16::try_from(universe).ok().filter(|&universe| universe <= UNIVERSE_MAX)?;
        Some(DmxAddress { universe, channel: (3 * (number % ROBOTS) + 1) as u16 })
    }
}

fn read_row(robot: &str, universe: &str, channel: &str) -> Result<(RobotId, DmxAddress), String> {
    let robot = RobotId::new(robot).ok_or_else(|| format!("'{robot}' is no name of a robot"))?;
    let channel = channel.parse().ok().filter(|channel| (1..=CHANNEL_MAX).contains(channel)).ok_or_else(|| {
        format!("channel {channel}: choose 1 to {CHANNEL_MAX}, because a colour has three channels of {CHANNELS}")
    })?;
    Ok((robot, DmxAddress { universe: read_universe(universe)?, channel }))
}

fn read_universe(universe: &str) -> Result<u16, String> {
    let number = universe.parse().ok().filter(|&number| number <= UNIVERSE_MAX);
    number.ok_or_else(|| format!("universe {universe}: choose 0 to {UNIVERSE_MAX}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn address(table: &PatchTable, robot: &str, number: u32) -> Option<(u16, u16)> {
        let found = table.address(RobotId::new(robot).unwrap(), number);
        found.map(|found| (found.universe, found.channel))
    }

    #[test]
    fn without_a_file_robots_follow_each_other() {
        let table = PatchTable::default();
        let at = |number| address(&table, "any", number);
        assert_eq!([0, 1, 169].map(at), [Some((1, 1)), Some((1, 4)), Some((1, 508))]);
        assert_eq!([170, 999].map(at), [Some((2, 1)), Some((6, 448))]);
        assert_eq!([63_999 * 170 - 1, 63_999 * 170].map(at), [Some((63_999, 508)), None]);
    }

    #[test]
    fn a_file_lists_robots_by_name_or_number() {
        let text = "# left of the stage\r\nabfe6805 7 510 # the tall one\n\n  12 7 1\nothers 9\n";
        let table = PatchTable::read(text).unwrap();
        assert_eq!(address(&table, "abfe6805", 12), Some((7, 510)), "a name counts before a number");
        assert_eq!(address(&table, "12", 171), Some((7, 1)), "digits may be a name");
        assert_eq!(address(&table, "any", 12), Some((7, 1)));
        assert_eq!(address(&table, "any", 171), Some((10, 4)));
        let listed_only = PatchTable::read("12 7 1").unwrap();
        assert_eq!(address(&listed_only, "any", 13), None);
        assert_eq!(PatchTable::read("").unwrap().address(RobotId::new("any").unwrap(), 0), None);
    }

    #[test]
    fn a_wrong_line_says_where_and_what_to_do() {
        for (text, line, what) in [
            ("r1 1 1\nr2 1 511", 2, "channel 511: choose 1 to 510"),
            ("r1 1 0", 1, "channel 0"),
            ("r1 64000 1", 1, "universe 64000: choose 0 to 63999"),
            ("r1 -1 1", 1, "universe -1"),
            ("r1 1", 1, "2 words: write ROBOT UNIVERSE CHANNEL, or others UNIVERSE"),
            ("r1 1 1 1", 1, "4 words"),
            ("a/b 1 1", 1, "'a/b' is no name"),
            ("r1 1 1\n\nr1 2 1", 3, "robot r1 stands twice"),
            ("others 1\nothers 2", 2, "'others' stands twice"),
        ] {
            let error = PatchTable::read(text).unwrap_err();
            assert!(error.line == line && error.what.contains(what), "{text}: {error}");
        }
    }

    #[test]
    fn a_table_is_bounded() {
        let universes: String = (0..=UNIVERSES_MAX).map(|one| format!("r{one} {one} 1\n")).collect();
        let error = PatchTable::read(&universes).unwrap_err();
        assert_eq!(error.line, UNIVERSES_MAX + 1);
        let robots: String = (0..=ROBOTS_MAX).map(|one| format!("r{one} 1 1\n")).collect();
        assert!(PatchTable::read(&robots).unwrap_err().what.contains("more than 20000 robots"));
    }
}
