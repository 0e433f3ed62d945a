//! One robot, as the controller knows it.

use crate::charge::ChargeTrend;
use crate::event::EventKind;
use crate::log::EventQueue;
use crate::namesakes::Namesakes;
use crate::report_rate::ReportRate;
use crate::snapshot::{Age, LastContact, Reported, RobotView};
use lightbots_base::{Instant, Rgb, RobotId, Vec2};
use lightbots_wire::{Details, Report, RobotState};
use serde::{Deserialize, Serialize};

/// Two reported places closer to each other than this count as the same place, metres, because position fixes are
/// noisy.
const SAME_PLACE_M: f64 = 0.012;

/// Bounds of the estimate how far before its target a robot with the original firmware comes to rest.
struct StopsShort {
    /// Estimate before the first arrival, metres.
    first_m: f64,
    /// Largest estimate, metres: the distance from its target at which the robot counts itself as arrived.
    most_m: f64,
    /// Distance that the robot rolls on after it has reported its arrival, metres.
    rolls_on_m: f64,
    /// Share of the deviation by which each arrival corrects the estimate, 0 to 1.
    gain: f64,
}

/// With a larger `first_m` a robot comes to rest past its goal at first. With a larger `gain` the estimate follows the
/// noise of position fixes.
const STOPS_SHORT: StopsShort = StopsShort { first_m: 0.012, most_m: 0.02, rolls_on_m: 0.006, gain: 0.5 };

const _: () = assert!(STOPS_SHORT.first_m <= STOPS_SHORT.most_m && STOPS_SHORT.gain < 1.0);

/// What is known of a robot.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct KnownRobot {
    /// Its name.
    pub id: RobotId,
    /// What its last report said.
    pub reported: Reported,
    /// When it was found, and when it reported last.
    pub contact: LastContact,
    /// How the charge of its battery falls over time.
    pub charge: ChargeTrend,
    /// How often the robot sends messages, to detect a flood.
    pub rate: ReportRate,
    /// The place that it reports, and since when it has reported about the same place.
    pub standstill: Standstill,
    /// Used only if the robot has the original firmware, which understands TARGET and COLOR but no routes.
    pub original: OriginalRobot,
    /// The colour that the robot was told to show last.
    pub light: ToldLight,
    /// Whether the list of admitted robots lets it take part in runs.
    pub is_admitted: bool,
    /// Signs that two robots share this name.
    pub namesakes: Namesakes,
    /// The robot's participant number in the present run; `None` if it has none.
    pub participant: Option<u32>,
    /// What is still known from the last run that the robot took part in.
    pub last_run: LastRun,
}

/// What is known of a robot with the original firmware.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct OriginalRobot {
    /// When the robot was last asked for a report because of its silence, show clock. At first, when it was found.
    pub asked: Instant,
    /// Estimate of how far before its target the robot comes to rest, metres.
    pub short_m: f64,
}

/// The colour that a robot was told to show last.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct ToldLight {
    /// The colour.
    pub color: Rgb,
    /// Whether the robot was told to show `color`, or is dark after it was switched on. `false` for a robot that is
    /// known only from the journal of a run, until it is told a colour or restarts.
    pub is_sure: bool,
}

impl ToldLight {
    /// The light of a robot after it is switched on: dark.
    pub const OFF: Self = Self { color: Rgb::BLACK, is_sure: true };
}

/// What is still known from the last run that a robot took part in.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct LastRun {
    /// Whether the robot may still keep a route of that run, because it has not reported that it keeps none.
    pub may_keep_route: bool,
    /// When STOP was last sent to this robot alone after that run, show clock; `None` if it was not.
    pub stop_sent: Option<Instant>,
    /// Id of the pixel that the robot showed when the run ended; `None` if it showed none or had dropped out.
    pub pixel: Option<u32>,
    /// Goal of the robot when the run ended, stage metres; `None` if it had none or had dropped out.
    pub goal: Option<Vec2>,
}

/// How long a robot has reported the same place.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Standstill {
    /// When `at` was first reported, show clock. Until then, when the robot was found.
    pub since: Instant,
    /// The place that the robot reports, stage metres. Later reports less than [`SAME_PLACE_M`] away, or without a
    /// place, do not change it. `None` before the first report of a place.
    pub at: Option<Vec2>,
    /// When the robot last reported a place, show clock. At first, when it was found.
    pub placed: Instant,
}

impl KnownRobot {
    /// Returns what is known of a robot that reports for the first time, at `now`.
    pub fn new(id: RobotId, now: Instant) -> Self {
        Self {
            id,
            reported: Reported::default(),
            contact: LastContact { found: now, heard: now, age: Age::Active },
            charge: ChargeTrend::default(),
            rate: ReportRate::default(),
            standstill: Standstill { since: now, at: None, placed: now },
            original: OriginalRobot { asked: now, short_m: STOPS_SHORT.first_m },
            light: ToldLight::OFF,
            is_admitted: true,
            namesakes: Namesakes::default(),
            participant: None,
            last_run: LastRun::default(),
        }
    }

    /// Whether the robot counts as one with the original firmware: it has not reported that it supports routes. The
    /// original firmware understands TARGET and COLOR but no routes.
    pub fn is_original(&self) -> bool {
        !self.reported.abilities.route
    }

    /// Whether the robot is known to show `color`, so that no command is needed.
    pub fn shows(&self, color: Rgb) -> bool {
        self.light.is_sure && self.light.color == color
    }

    /// Whether the robot is neither stale nor gone, and its last report names neither a fault nor a lost position.
    pub fn is_fit(&self) -> bool {
        self.contact.age == Age::Active
            && !matches!(self.reported.state, Some(RobotState::Faulty | RobotState::Lost))
    }

    /// Whether the robot is neither stale nor gone: it reported lately.
    pub fn is_heard(&self) -> bool {
        self.contact.age == Age::Active
    }

    /// Returns the view of the robot for screens, without what the present run knows of the robot.
    pub fn view(&self) -> RobotView {
        RobotView {
            id: self.id,
            reported: self.reported.clone(),
            contact: self.contact,
            planned: None,
            goal: self.last_run.goal,
            pixel: self.last_run.pixel,
            light: self.light.color,
            battery_left: self.charge.left(self.contact.heard),
            takes_part: false,
            is_admitted: self.is_admitted,
        }
    }

    /// Whether the robot could take part in a run that begins now.
    pub fn can_take_part(&self) -> bool {
        self.is_fit() && self.reported.at.is_some() && self.is_admitted && !self.namesakes.are_there()
    }

    /// Whether the robot's last report says that it drives. `false` if it is held, or reports no state.
    pub fn may_move(&self) -> bool {
        matches!(self.reported.state, Some(RobotState::Driving))
    }

    /// Corrects the estimate of how far before its target the robot comes to rest. The robot was sent from `from` to
    /// `target` and reported its arrival at `at`; all are stage metres. Does nothing if `from` equals `target`.
    pub fn learn_short(&mut self, from: Vec2, target: Vec2, at: Vec2) {
        let Some(towards) = (target - from).normalized() else { return };
        let StopsShort { most_m, rolls_on_m, gain, .. } = STOPS_SHORT;
        let short_m = ((target - at).dot(towards) - rolls_on_m).clamp(0.0, most_m);
        self.original.short_m += (short_m - self.original.short_m) * gain;
    }

    /// Records an event that two robots share this name.
    pub fn report_namesakes(&self, now: Instant, log: &mut EventQueue) {
        log.record(now, EventKind::NameShared { robot: self.id, places: self.namesakes.places() });
    }

    /// Stores what a report says, and when it came. `place`: the reported position if it is plausible, stage metres;
    /// otherwise `None`. Returns whether the report shows that the robot was restarted.
    pub fn receive(&mut self, now: Instant, report: &Report, place: Option<Vec2>) -> bool {
        self.contact.heard = now;
        let same = |(at, place): (Vec2, Vec2)| at.distance(place) < SAME_PLACE_M;
        if place.is_some() {
            self.standstill.placed = now;
            if !place.zip(self.standstill.at).is_some_and(same) {
                (self.standstill.since, self.standstill.at) = (now, place);
            }
        }
        if place.is_some() || report.details.is_some() {
            self.reported.at = place;
        }
        // The original firmware does not report this, so its robot counts as real, even if a simulated one had this
        // name before.
        self.reported.simulated = report.details.as_ref().is_some_and(|details| details.simulated);
        let restarted = report.details.as_ref().is_some_and(|details| self.take_over(details));
        if let Some(percent) = self.reported.battery {
            self.charge.report(now, percent);
        }
        if restarted {
            self.light = ToldLight::OFF;
        }
        restarted
    }

    /// Stores the details of a report. Returns whether they show that the robot was restarted: it has lost its
    /// synchronised clock and its routes.
    fn take_over(&mut self, details: &Details) -> bool {
        let known = &mut self.reported;
        let restarted = known.clock_us.is_some() && details.clock_us.is_none() && details.route == 0;
        known.heading = details.heading;
        known.battery = details.battery;
        known.state = Some(details.state);
        known.off_m = details.off_m;
        known.blocked = details.blocked;
        known.clock_us = details.clock_us;
        known.route = details.route;
        known.abilities = details.abilities;
        if known.firmware != details.firmware {
            known.firmware = details.firmware.clone();
        }
        restarted
    }
}
