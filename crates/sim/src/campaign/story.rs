//! The faults of a seed, and their descriptions in plain words.

use core::fmt;

use lightbots_base::{Span, Vec2};

use super::Scene;
use crate::conditions::{Breakdown, Conditions, LinkConditions, Outage};
use crate::dice::{Dice, Purpose};
use crate::mishap::Mishap;

/// Largest number of faults that [`fault`] draws for a story.
const FAULTS: u64 = 5;
/// Earliest and latest time of a fault, seconds after the first departure.
const HAPPEN_S: (f64, f64) = (0.0, 20.0);
/// Shortest and longest duration of a short outage, seconds. Most of these end before the controller asks the operator
/// whether the run goes on.
const SHORT_S: (f64, f64) = (0.1, 6.0);
/// Shortest and longest duration of a long outage, seconds.
const LONG_S: (f64, f64) = (6.0, 40.0);
/// Share of the outages that are short, among those that may be short or long.
const SHORT: f64 = 0.8;
/// Time within which clients find a broker that is back.
const FOUND_AGAIN: Span = Span::from_millis(2_000);
/// From this seed on, stories have further faults. The stories of smaller seeds stay as they were, so that those which
/// once failed can be played again.
const FURTHER_FROM: u64 = 1_000;
/// From this seed on, a story may have a person on the floor.
const PEOPLE_FROM: u64 = 2_000;
/// Share of the stories from [`PEOPLE_FROM`] on that have a person on the floor.
const PEOPLE: f64 = 0.5;
/// From this seed on, a fault of the controller's clocks is drawn for each story. Outages of the broker may then
/// overlap, unless the broker is gone in both.
const CLOCKS_FROM: u64 = 3_000;
/// Largest change of the time of day, forwards or back, seconds. The first value is for the share [`SHORT`] of the
/// changes, the second for the others.
const SET_S: (f64, f64) = (6.0, 7_200.0);
/// Smallest and largest error of a falsely reported place, metres.
const LIE_M: (f64, f64) = (0.05, 0.5);
/// Shortest and longest time until a slow disk has written a piece of the journal, seconds.
const DISK_S: (f64, f64) = (0.05, 3.0);
/// Share of the stories whose messages may be late, lost, doubled or overtaken.
const BAD_LINK: f64 = 0.6;

/// One fault.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Dead(usize),
    Stuck(usize),
    Cut(usize, Span),
    Blind(usize, Span),
    Rebooted(usize, Span),
    Moved(usize, Vec2),
    Freeze(Span),
    Gone(Span),
    Crash(Span),
    /// A crash during which the time of day is set.
    CrashAndSet(Span, Span),
    Sleep(Span),
    Pause(Span),
    Lies(usize, Vec2, Span),
    Floods(usize, Span),
    Named(usize, usize),
    DiskFull(Span),
    DiskSlow(Span, Span),
    Person(Vec2, Span),
    Stop,
}

impl Fault {
    /// How long the fault lasts; zero if it is permanent or happens at one moment.
    fn over(self) -> Span {
        match self {
            Self::Cut(_, over) | Self::Blind(_, over) | Self::Rebooted(_, over) => over,
            Self::Freeze(over) | Self::Gone(over) | Self::Crash(over) | Self::Pause(over) => over,
            Self::CrashAndSet(over, _) | Self::Sleep(over) => over,
            Self::Lies(_, _, over) | Self::Floods(_, over) => over,
            Self::DiskFull(over) | Self::DiskSlow(over, _) | Self::Person(_, over) => over,
            Self::Dead(_) | Self::Stuck(_) | Self::Moved(..) | Self::Named(..) | Self::Stop => Span::ZERO,
        }
    }

    /// The robot that it happens to; `None` for a fault of the broker, controller, disk or operator, or a person on the
    /// floor.
    fn robot(self) -> Option<usize> {
        match self {
            Self::Dead(robot) | Self::Stuck(robot) | Self::Moved(robot, _) => Some(robot),
            Self::Cut(robot, _) | Self::Blind(robot, _) | Self::Rebooted(robot, _) => Some(robot),
            Self::Lies(robot, ..) | Self::Floods(robot, _) | Self::Named(robot, _) => Some(robot),
            _ => None,
        }
    }

    /// Whether the two faults must not overlap in time. `may_overlap`: outages of the broker may overlap, unless the
    /// broker is gone in both.
    fn excludes(self, other: Self, may_overlap: bool) -> bool {
        let is_of_broker = |fault| matches!(fault, Self::Freeze(_) | Self::Gone(_));
        let is_gone = |fault| matches!(fault, Self::Gone(_));
        let is_crash = |fault| matches!(fault, Self::Crash(_) | Self::CrashAndSet(..) | Self::Sleep(_));
        let is_person = |fault| matches!(fault, Self::Person(..));
        is_of_broker(self) && is_of_broker(other) && !may_overlap
            || is_gone(self) && is_gone(other)
            || is_crash(self) && is_crash(other)
            || is_person(self) && is_person(other)
    }
}

/// Removes faults that cannot happen: all but the first fault of a robot, and faults that an earlier fault excludes. An
/// excluded fault begins during the earlier fault, or within [`FOUND_AGAIN`] after it. `faults` are in order of time.
/// `may_overlap`: see [`Fault::excludes`].
fn without_overlaps(faults: Vec<(Span, Fault)>, may_overlap: bool) -> Vec<(Span, Fault)> {
    let mut kept: Vec<(Span, Fault)> = Vec::new();
    for (at, fault) in faults {
        let is_of_same_robot = |other: Fault| fault.robot().is_some() && fault.robot() == other.robot();
        let overlaps = |&(began, other): &(Span, Fault)| {
            is_of_same_robot(other)
                || fault.excludes(other, may_overlap) && began + other.over() + FOUND_AGAIN > at
        };
        if !kept.iter().any(overlaps) {
            kept.push((at, fault));
        }
    }
    kept
}

/// What happens in a run: faults, and properties of links, wheels and robots.
#[derive(Clone, Debug, PartialEq)]
pub struct Story {
    /// Faults, by their times after the first departure.
    faults: Vec<(Span, Fault)>,
    link: LinkConditions,
    slip: f64,
    originals: usize,
}

impl Story {
    /// The story of a seed.
    pub fn new(seed: u64, scene: &Scene) -> Self {
        let mut dice = Dice::new(seed, Purpose::Campaign);
        let link = link(&mut dice);
        let slip = if dice.chance(0.25) { dice.between(0.03, 0.15) } else { 0.03 };
        let originals = if dice.chance(0.1) { 1 + dice.below(3) as usize } else { 0 };
        let count = 1 + dice.below(FAULTS);
        let mut faults: Vec<_> = (0..count).map(|_| fault(&mut dice, scene)).collect();
        if seed >= FURTHER_FROM {
            faults.extend((0..1 + dice.below(2)).map(|_| further_fault(&mut dice, scene)));
        }
        if seed >= PEOPLE_FROM && dice.chance(PEOPLE) {
            faults.push(person(&mut dice, scene));
        }
        if seed >= CLOCKS_FROM {
            faults.push(clock_fault(&mut dice));
        }
        faults.sort_by_key(|&(at, _)| at);
        let faults = without_overlaps(faults, seed >= CLOCKS_FROM);
        Self { faults, link, slip, originals }
    }

    /// Sum of the durations of all faults.
    pub fn lasts(&self) -> Span {
        self.faults.iter().fold(Span::ZERO, |sum, (_, fault)| sum + fault.over())
    }

    /// Number of robots that understand the command TARGET but no routes.
    pub fn originals(&self) -> usize {
        self.originals
    }

    /// Whether messages are lost at random.
    pub fn loses_messages(&self) -> bool {
        self.link.loss > 0.0
    }

    /// Number of faults.
    pub fn count(&self) -> usize {
        self.faults.len()
    }

    /// The conditions of the rehearsal that plays this story.
    pub fn conditions(&self) -> Conditions {
        let (link, slip, originals) = (self.link.clone(), self.slip, self.originals);
        let mut conditions = Conditions { link, slip, originals, ..Conditions::default() };
        for &(at, fault) in &self.faults {
            add(&mut conditions, at, fault);
        }
        conditions
    }
}

fn link(dice: &mut Dice) -> LinkConditions {
    let usual = LinkConditions::default();
    if !dice.chance(BAD_LINK) {
        return usual;
    }
    let mut share = |chance, most| if dice.chance(chance) { dice.between(0.0, most) } else { 0.0 };
    let (loss, double, reorder) = (share(0.6, 0.2), share(0.3, 0.1), share(0.3, 0.1));
    let late_ms = share(0.4, 250.0) as i64;
    let jitter_ms = share(0.3, 150.0) as i64;
    LinkConditions {
        delay_max: usual.delay_max + Span::from_millis(late_ms),
        jitter: Span::from_millis(jitter_ms),
        loss,
        double,
        reorder,
        ..usual
    }
}

fn fault(dice: &mut Dice, scene: &Scene) -> (Span, Fault) {
    let at = Span::from_secs(dice.between(HAPPEN_S.0, HAPPEN_S.1));
    let robot = dice.below(scene.robots as u64) as usize;
    let (from_s, to_s) = if dice.chance(SHORT) { SHORT_S } else { LONG_S };
    let over = Span::from_secs(dice.between(from_s, to_s));
    let half = Vec2::new(scene.show.stage.width_m, scene.show.stage.depth_m) * 0.5;
    let place = Vec2::new(dice.between(-half.x, half.x), dice.between(-half.y, half.y));
    let fault = match dice.below(12) {
        0 => Fault::Dead(robot),
        1 => Fault::Stuck(robot),
        2 => Fault::Cut(robot, over),
        3 => Fault::Blind(robot, over),
        4 => Fault::Rebooted(robot, over),
        5 => Fault::Moved(robot, place),
        6 => Fault::Freeze(over),
        7 => Fault::Gone(over),
        8 | 9 => Fault::Crash(over),
        10 => Fault::Pause(over),
        _ => Fault::Stop,
    };
    (at, fault)
}

/// Draws a time and one of the further faults that stories from seed [`FURTHER_FROM`] on have.
fn further_fault(dice: &mut Dice, scene: &Scene) -> (Span, Fault) {
    let at = Span::from_secs(dice.between(HAPPEN_S.0, HAPPEN_S.1));
    let robot = dice.below(scene.robots as u64) as usize;
    let over = Span::from_secs(dice.between(SHORT_S.0, SHORT_S.1));
    let fault = match dice.below(5) {
        0 => {
            let direction = Vec2::unit(dice.between(0.0, core::f64::consts::TAU));
            Fault::Lies(robot, direction * dice.between(LIE_M.0, LIE_M.1), over)
        }
        1 => Fault::Floods(robot, over),
        2 => Fault::Named(robot, (robot + 1) % scene.robots),
        3 => Fault::DiskFull(over),
        _ => Fault::DiskSlow(over, Span::from_secs(dice.between(DISK_S.0, DISK_S.1))),
    };
    (at, fault)
}

/// Draws a time and a fault of the controller's clocks: its computer sleeps, or its time of day is set during a crash.
fn clock_fault(dice: &mut Dice) -> (Span, Fault) {
    let at = Span::from_secs(dice.between(HAPPEN_S.0, HAPPEN_S.1));
    let (from_s, to_s) = if dice.chance(SHORT) { SHORT_S } else { LONG_S };
    let over = Span::from_secs(dice.between(from_s, to_s));
    if dice.chance(0.5) {
        return (at, Fault::Sleep(over));
    }
    let most_s = if dice.chance(SHORT) { SET_S.0 } else { SET_S.1 };
    (at, Fault::CrashAndSet(over, Span::from_secs(dice.between(-most_s, most_s))))
}

fn person(dice: &mut Dice, scene: &Scene) -> (Span, Fault) {
    let at = Span::from_secs(dice.between(HAPPEN_S.0, HAPPEN_S.1));
    let half = Vec2::new(scene.show.stage.width_m, scene.show.stage.depth_m) * 0.5;
    let place = Vec2::new(dice.between(-half.x, half.x), dice.between(-half.y, half.y));
    (at, Fault::Person(place, Span::from_secs(dice.between(1.0, LONG_S.1))))
}

fn add(conditions: &mut Conditions, at: Span, fault: Fault) {
    let of = |robot| Breakdown { robot: Some(robot), at: Some(at) };
    match fault {
        Fault::Dead(robot) => conditions.killed.push(of(robot)),
        Fault::Stuck(robot) => conditions.stuck.push(of(robot)),
        Fault::Cut(robot, over) => conditions.cut.push((of(robot), over)),
        Fault::Blind(robot, over) => conditions.blind.push((of(robot), over)),
        Fault::Rebooted(robot, over) => {
            conditions.mishaps.extend([(at, Mishap::Off(robot)), (at + over, Mishap::On(robot))]);
        }
        Fault::Moved(robot, to) => conditions.mishaps.push((at, Mishap::Moved(robot, to))),
        Fault::Freeze(over) => conditions.frozen.push(Outage { at, over }),
        Fault::Gone(over) => conditions.gone.push(Outage { at, over }),
        Fault::Crash(over) => conditions.crashed.push(Outage { at, over }),
        Fault::CrashAndSet(over, by) => {
            conditions.crashed.push(Outage { at, over });
            conditions.mishaps.push((at, Mishap::ClockSet(by)));
        }
        Fault::Sleep(over) => conditions.mishaps.push((at, Mishap::Sleeps(over))),
        Fault::Pause(over) => conditions.mishaps.extend([(at, Mishap::Pause), (at + over, Mishap::Resume)]),
        Fault::Stop => conditions.mishaps.push((at, Mishap::Stop)),
        Fault::Lies(robot, off, over) => {
            let honest = Mishap::Lies(robot, Vec2::ZERO);
            conditions.mishaps.extend([(at, Mishap::Lies(robot, off)), (at + over, honest)]);
        }
        Fault::Floods(robot, over) => {
            let ends = Mishap::Floods(robot, false);
            conditions.mishaps.extend([(at, Mishap::Floods(robot, true)), (at + over, ends)]);
        }
        Fault::Named(robot, other) => conditions.mishaps.push((at, Mishap::Named(robot, other))),
        Fault::Person(place, over) => {
            let comes = Mishap::Person(Some(place));
            conditions.mishaps.extend([(at, comes), (at + over, Mishap::Person(None))]);
        }
        Fault::DiskFull(over) => conditions.mishaps.push((at, Mishap::DiskFull(over))),
        Fault::DiskSlow(over, takes) => conditions.mishaps.push((at, Mishap::DiskSlow(over, takes))),
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Dead(robot) => write!(f, "robot {robot} loses its power for good"),
            Self::Stuck(robot) => write!(f, "robot {robot}'s wheels block for good"),
            Self::Cut(robot, over) => write!(f, "robot {robot} has no link for {:.2} s", over.as_secs()),
            Self::Blind(robot, over) => write!(f, "robot {robot} gets no fixes for {:.2} s", over.as_secs()),
            Self::Rebooted(robot, over) => {
                write!(f, "robot {robot} is off for {:.2} s and starts again", over.as_secs())
            }
            Self::Moved(robot, to) => {
                write!(f, "robot {robot} is lifted and put down near ({:.2}, {:.2}) m", to.x, to.y)
            }
            Self::Freeze(over) => write!(f, "the broker passes nothing on for {:.2} s", over.as_secs()),
            Self::Gone(over) => write!(f, "the broker is gone for {:.2} s", over.as_secs()),
            Self::Crash(over) => {
                write!(f, "the controller is killed, and started again after {:.2} s", over.as_secs())
            }
            Self::CrashAndSet(over, by) => {
                let (over_s, by_s) = (over.as_secs(), by.as_secs());
                write!(
                    f,
                    "the controller is killed, the time of day is set by {by_s:+.2} s, and it is started again after \
                     {over_s:.2} s"
                )
            }
            Self::Sleep(over) => {
                write!(f, "the controller's computer sleeps for {:.2} s, with the broker", over.as_secs())
            }
            Self::Pause(over) => write!(f, "the operator pauses the show for {:.2} s", over.as_secs()),
            Self::Stop => write!(f, "the operator stops all robots"),
            Self::Lies(robot, off, over) => {
                let over_s = over.as_secs();
                write!(
                    f,
                    "robot {robot} reports places that are off by {:.2} m for {over_s:.2} s",
                    off.length()
                )
            }
            Self::Floods(robot, over) => {
                write!(f, "robot {robot} sends 2,500 reports a second for {:.2} s", over.as_secs())
            }
            Self::Named(robot, other) => {
                write!(f, "robot {robot} starts again with the name of robot {other}")
            }
            Self::Person(at, over) => {
                write!(f, "a person stands near ({:.2}, {:.2}) m for {:.2} s", at.x, at.y, over.as_secs())
            }
            Self::DiskFull(over) => write!(f, "the journal's disk is full for {:.2} s", over.as_secs()),
            Self::DiskSlow(over, takes) => {
                let (over_s, takes_s) = (over.as_secs(), takes.as_secs());
                write!(f, "for {over_s:.2} s the disk takes {takes_s:.2} s to write a piece of the journal")
            }
        }
    }
}

impl fmt::Display for Story {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let link = &self.link;
        writeln!(
            f,
            "  always     messages take {} to {} ms, {} ms more with jitter; {:.1} % lost, {:.1} % doubled, {:.1} % overtaken",
            link.delay_min.0 / 1000,
            link.delay_max.0 / 1000,
            link.jitter.0 / 1000,
            100.0 * link.loss,
            100.0 * link.double,
            100.0 * link.reorder
        )?;
        writeln!(
            f,
            "  always     wheels slip by {:.1} %; {} robots know TARGET only",
            100.0 * self.slip,
            self.originals
        )?;
        for (at, fault) in &self.faults {
            writeln!(f, "  {:6.3} s   {fault}", at.as_secs())?;
        }
        Ok(())
    }
}
