//! The state of a rehearsal under way.

use std::collections::VecDeque;
use std::sync::Arc;

use lightbots_base::{Instant, RobotId, StateHash, Vec2};
use lightbots_control::{Config, Controller, RecordedController};
use lightbots_show::Show;

use crate::breakdowns::Breakdowns;
use crate::broker_outages::BrokerOutages;
use crate::campaign::Invariants;
use crate::controller_clock::ControllerClock;
use crate::controller_crashes::ControllerCrashes;
use crate::forgeries::Forgeries;
use crate::light_watch::LightWatch;
use crate::mishap::Mishap;
use crate::network::Network;
use crate::operator::Operator;
use crate::options::RehearsalOptions;
use crate::record::RehearsalRecord;
use crate::robot_set::RobotSet;
use crate::timetable::Timetable;

/// A show being rehearsed.
pub(crate) struct Play {
    pub(super) show: Arc<Show>,
    pub(super) seed: u64,
    pub(super) planned_s: f64,
    pub(super) controller: RecordedController,
    /// Configuration of each controller.
    pub(super) config: Config,
    pub(super) robots: RobotSet,
    pub(super) network: Network,
    pub(super) breakdowns: Breakdowns,
    pub(super) broker: BrokerOutages,
    pub(super) crashes: ControllerCrashes,
    /// The clocks of the controller's computer.
    pub(super) clock: ControllerClock,
    pub(super) forgeries: Forgeries,
    /// Robots that were restarted with the name of another robot: that name, and the robot's index.
    pub(super) namesakes: Vec<(RobotId, usize)>,
    /// Number of controllers that were killed before the present one.
    pub(super) controllers: u32,
    pub(super) operator: Operator,
    pub(super) mishaps: Timetable<Mishap>,
    /// Indices of the frames that the operator still has to jump to, in this order.
    pub(super) visits: VecDeque<usize>,
    /// Number of the round of a loop in which the operator gives GO, counted from 1.
    pub(super) loop_rounds: u32,
    /// Invariants that are checked after each step; `None` except in a campaign.
    pub invariants: Option<Box<Invariants>>,
    pub(super) record: RehearsalRecord,
    pub(super) lights: LightWatch,
    pub(super) hash: StateHash,
    /// First name and index of each robot, sorted by name. Restarts under another name are in `namesakes`.
    pub(super) by_id: Vec<(RobotId, usize)>,
    pub(super) now: Instant,
    pub(super) began: bool,
}

impl Play {
    /// A rehearsal with a new controller, and with robots that were just switched on at `starts`. `names[robot]`: its
    /// name, if one is given. `planned_s`: planned duration of the show, seconds.
    pub fn new(
        show: Arc<Show>,
        starts: &[Vec2],
        names: &[Option<RobotId>],
        options: &RehearsalOptions,
        planned_s: f64,
    ) -> Self {
        let RehearsalOptions { seed, conditions, .. } = options;
        let config = Config { light_tolerance: conditions.light_tolerance, ..Config::default() };
        let robots = RobotSet::new(&show.stage, starts, names, conditions, *seed, false);
        let mut by_id: Vec<_> = (0..robots.len()).map(|robot| (robots.id(robot), robot)).collect();
        by_id.sort_unstable();
        Self {
            seed: *seed,
            planned_s,
            controller: RecordedController::new(Controller::new(config.clone())),
            config,
            network: Network::new(&conditions.link, starts.len(), *seed),
            forgeries: Forgeries::default(),
            namesakes: Vec::new(),
            breakdowns: Breakdowns::new(conditions, starts.len(), planned_s, *seed),
            broker: BrokerOutages::new(conditions, starts.len(), *seed),
            crashes: ControllerCrashes::new(&conditions.crashed),
            // Both kinds of computers have to be tested.
            clock: ControllerClock::new(seed.is_multiple_of(2)),
            controllers: 0,
            operator: Operator::new(conditions.go_after),
            mishaps: Timetable::new(conditions.mishaps.clone()),
            visits: conditions.visits.iter().copied().collect(),
            loop_rounds: conditions.loop_rounds,
            invariants: None,
            record: RehearsalRecord::new(starts.len()),
            lights: LightWatch::new(conditions.light_tolerance),
            hash: StateHash::new(),
            robots,
            by_id,
            show,
            now: Instant::ZERO,
            began: false,
        }
    }

    /// Present time on the controller's show clock.
    pub(super) fn shown(&self) -> Instant {
        self.clock.shows(self.now)
    }

    /// Whether there is no controller, or its computer sleeps.
    pub(super) fn is_controller_away(&self) -> bool {
        self.crashes.is_gone() || self.clock.is_asleep(self.now)
    }
}
