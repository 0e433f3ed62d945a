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

/// Places nearer to each other than this are the same for a robot whose fixes are noisy, metres.
const SAME_PLACE_M: f64 = 0.012;

/// How far before its target a robot with the original firmware comes to rest.
struct StopsShort {
    /// Until it is measured, metres.
    first_m: f64,
    /// At most, metres: its tolerance.
    most_m: f64,
    /// How far it rolls on after it reported that it arrived, metres.
    rolls_on_m: f64,
    /// Share by which each arrival corrects the estimate.
    gain: f64,
}

/// A larger first estimate sends a robot past its goal; a larger gain follows the noise of its fixes.
const STOPS_SHORT: StopsShort = StopsShort { first_m: 0.012, most_m: 0.02, rolls_on_m: 0.006, gain: 0.5 };

const _: () = assert!(STOPS_SHORT.first_m <= STOPS_SHORT.most_m && STOPS_SHORT.gain < 1.0);

/// What is known of a robot.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct KnownRobot {
    /// Its name.
    pub id: RobotId,
    /// What its last report said.
    pub reported: Reported,
    /// When it reported.
    pub contact: LastContact,
    /// How its charge falls.
    pub charge: ChargeTrend,
    /// How often it sends messages.
    pub rate: ReportRate,
    /// Since when it reports the same place.
    pub standstill: Standstill,
    /// What is known if it knows TARGET only.
    pub original: OriginalRobot,
    /// The light it was told to show.
    pub light: ToldLight,
    /// Whether it may take part in runs.
    pub is_admitted: bool,
    /// Whether another robot has the same name.
    pub namesakes: Namesakes,
    /// Its number in the run.
    pub participant: Option<u32>,
    /// What is left of the last run.
    pub last_run: LastRun,
}

/// What is known of a robot with the original firmware.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct OriginalRobot {
    /// When it was asked for a report.
    pub asked: Instant,
    /// How far before its target it comes to rest, metres.
    pub short_m: f64,
}

/// The light that a robot was told to show.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct ToldLight {
    /// Its colour.
    pub color: Rgb,
    /// Whether the robot surely shows it.
    pub is_sure: bool,
}

impl ToldLight {
    /// The light of a robot that was switched on.
    pub const OFF: Self = Self { color: Rgb::BLACK, is_sure: true };
}

/// What is left of the last run that a robot took part in.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct LastRun {
    /// The run is over, and the robot has not said since that it keeps no route.
    pub may_keep_route: bool,
    /// The pixel it showed when the run ended.
    pub pixel: Option<u32>,
    /// Where it stood then, stage metres.
    pub goal: Option<Vec2>,
}

/// How long a robot has reported the same place.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub(crate) struct Standstill {
    /// Since then.
    pub since: Instant,
    /// Where that began, stage metres. A report without a place does not change it.
    pub at: Option<Vec2>,
    /// When it reported a place last.
    pub placed: Instant,
}

impl KnownRobot {
    /// A robot that is found now.
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

    /// Whether it knows TARGET and COLOR only: the original firmware.
    pub fn is_original(&self) -> bool {
        !self.reported.abilities.route
    }

    /// Whether it surely shows a light.
    pub fn shows(&self, color: Rgb) -> bool {
        self.light.is_sure && self.light.color == color
    }

    /// Whether it reported lately, and neither a fault nor that it is lost.
    pub fn is_fit(&self) -> bool {
        self.contact.age == Age::Active
            && !matches!(self.reported.state, Some(RobotState::Faulty | RobotState::Lost))
    }

    /// Whether it reported lately.
    pub fn is_heard(&self) -> bool {
        self.contact.age == Age::Active
    }

    /// What a screen shows of it outside a run.
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

    /// Whether it could take part in a run now.
    pub fn can_take_part(&self) -> bool {
        self.is_fit() && self.reported.at.is_some() && self.is_admitted && !self.namesakes.are_there()
    }

    /// Whether its last report says that its wheels may turn.
    pub fn may_move(&self) -> bool {
        matches!(self.reported.state, Some(RobotState::Driving))
    }

    /// A robot that knows TARGET only arrived at `at`, sent from `from` to `target`: it may be sent a little farther next
    /// time.
    pub fn learn_short(&mut self, from: Vec2, target: Vec2, at: Vec2) {
        let Some(towards) = (target - from).normalized() else { return };
        let StopsShort { most_m, rolls_on_m, gain, .. } = STOPS_SHORT;
        let short_m = ((target - at).dot(towards) - rolls_on_m).clamp(0.0, most_m);
        self.original.short_m += (short_m - self.original.short_m) * gain;
    }

    /// Two robots share its name.
    pub fn report_namesakes(&self, now: Instant, log: &mut EventQueue) {
        log.record(now, EventKind::NameShared { robot: self.id, places: self.namesakes.places() });
    }

    /// A report with this place came; whether it says that the robot was restarted.
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
        // The original firmware does not say: such a robot is real, even where a simulated one had its name.
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

    /// Takes over details; whether they say that the robot was restarted.
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
