//! The robots that take part in a run (its participants), and what is kept of each from drive to drive.

use crate::context::Context;
use crate::robot::KnownRobot;
use crate::run::membership::{Membership, Probation};
use crate::run::misplacements::Misplacements;
use lightbots_base::{Instant, Vec2};
use serde::{Deserialize, Serialize};

/// Where a robot that dropped out may stand, stage metres. Both lists are empty if it stands at the place that it
/// reported last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Whereabouts {
    /// The possible places.
    pub possible: Vec<Vec2>,
    /// The likely ones of them.
    pub likely: Vec<Vec2>,
}

/// How often a robot that dropped out made new plans necessary, because it reported places where no plan expected it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bystander {
    /// How often all was planned again because a path led through the robot.
    pub replans: u8,
    /// Earliest time at which paths are compared with the next report of the robot.
    pub look_at: Instant,
}

/// A robot's part in a run. It is kept from drive to drive, also after the robot dropped out.
#[derive(Clone, Debug)]
pub(crate) struct Participant {
    /// Index into the fleet.
    pub robot: usize,
    /// Whether the robot takes part now.
    pub membership: Membership,
    /// Whether the robot has to pass a test of its wheels, a turn on the spot, before it takes part again.
    pub probation: Probation,
    /// Where the robot may stand, if it dropped out and its last report does not tell its place.
    pub last_seen: Whereabouts,
    /// How often an obstacle in the robot's path led to a new plan.
    pub replans: u8,
    /// How often all was planned again because the robot did not stand where the plan had it.
    pub misplaced: Misplacements,
    /// New plans that the robot has made necessary since it dropped out.
    pub bystander: Bystander,
}

/// The robots that take part or took part in a run. Their numbers count from 0 in the order in which they joined.
#[derive(Clone, Debug, Default)]
pub(crate) struct Roster {
    /// All robots that take part or took part. They are never removed, so that their numbers stay valid.
    pub participants: Vec<Participant>,
    /// Robots (indices into the fleet) that join the run when all robots stand next, if they are ready then. Some have
    /// to wait for a later frame.
    pub candidates: Vec<usize>,
    /// When the run began.
    pub begun: Instant,
    /// How often a participant joined, dropped out, came back, or was found again by its report. After each of these
    /// changes the journal records the participants that are new or whose membership changed.
    pub changes: u64,
}

impl Participant {
    /// A robot of the fleet, by its index, that takes part from now on.
    pub fn new(robot: usize) -> Self {
        Self {
            robot,
            membership: Membership::default(),
            probation: Probation::None,
            last_seen: Whereabouts::default(),
            replans: 0,
            misplaced: Misplacements::default(),
            bystander: Bystander::default(),
        }
    }

    /// Whether the robot dropped out.
    pub fn is_excluded(&self) -> bool {
        self.membership.excluded
    }

    /// Whether the robot dropped out and its place is only inferred, because its last report does not tell it.
    pub fn is_unplaced(&self) -> bool {
        self.is_excluded() && !self.last_seen.possible.is_empty()
    }
}

impl Roster {
    /// Creates the roster of all robots of the fleet that can take part, and notes each one's participant number in the
    /// fleet.
    pub fn of_fleet(context: &mut Context, now: Instant) -> Self {
        let mut participants = Vec::new();
        for index in 0..context.fleet.robots().len() {
            let robot = context.fleet.robot_mut(index);
            robot.participant = robot.can_take_part().then_some(participants.len() as u32);
            if robot.participant.is_some() {
                participants.push(Participant::new(index));
            }
        }
        Self { participants, candidates: Vec::new(), begun: now, changes: 0 }
    }

    /// Number of participants, including those that dropped out.
    pub fn len(&self) -> usize {
        self.participants.len()
    }

    /// Participants that did not drop out, with their numbers.
    pub fn active(&self) -> impl Iterator<Item = (usize, &Participant)> {
        self.participants.iter().enumerate().filter(|(_, known)| !known.is_excluded())
    }

    /// Whether a participant dropped out.
    pub fn is_excluded(&self, participant: usize) -> bool {
        self.participants[participant].is_excluded()
    }

    /// The robot of a participant.
    pub fn robot<'a>(&self, context: &'a Context, participant: usize) -> &'a KnownRobot {
        context.fleet.robot(self.participants[participant].robot)
    }

    /// Whether any TARGET-only robot (it understands the command TARGET but no routes) takes part.
    pub fn has_target_robots(&self, context: &Context) -> bool {
        self.active().any(|(_, known)| context.fleet.robot(known.robot).is_original())
    }

    /// Whether a robot takes no part and was found after the run began.
    pub fn is_stranger(&self, robot: &KnownRobot) -> bool {
        robot.participant.is_none() && robot.contact.found > self.begun
    }

    /// Clears the possible places of a participant, once its robot reports where it stands, does not drive and does not
    /// share its name.
    pub fn locate(&mut self, robot: &KnownRobot) {
        let Some(participant) = robot.participant else { return };
        let known = &mut self.participants[participant as usize];
        let says_where = robot.reported.at.is_some() && !robot.may_move() && !robot.namesakes.are_there();
        if says_where && !known.last_seen.possible.is_empty() {
            known.last_seen = Whereabouts::default();
            self.changes += 1;
        }
    }

    /// Lets a robot (index into the fleet) take part, for the first time or again.
    pub fn admit(&mut self, context: &mut Context, robot: usize) {
        self.changes += 1;
        match context.fleet.robot(robot).participant {
            Some(participant) => {
                let known = &mut self.participants[participant as usize];
                known.membership.excluded = false;
                known.last_seen = Whereabouts::default();
                known.bystander = Bystander::default();
                known.misplaced = Misplacements::default();
            }
            None => {
                context.fleet.robot_mut(robot).participant = Some(self.participants.len() as u32);
                self.participants.push(Participant::new(robot));
            }
        }
    }
}
