//! The parts of a robot, and its state as it reports it: place, error of the place, activity and faults.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Pose, RobotId, Span, Vec2};
use lightbots_wire::RobotState;

use crate::clock::ClockFilter;
use crate::config::Config;
use crate::hot::Hot;
use crate::light::Light;
use crate::reflex::Reflex;
use crate::storage::RouteStorage;

/// While fixes are overdue, reports give the error of the place predicted for this time ahead: about the time that a
/// HOLD takes to reach all robots. With a smaller value, the other robots cannot stop before this robot is lost. With a
/// larger value, all robots wait for short outages.
const FORESIGHT: Span = Span::from_millis(500);

/// The core of a whole robot, without allocation, clock or IO. Pass in messages and call [`step`](Self::step), then
/// take the outgoing messages.
///
/// `S` is the storage of its routes: a [`RouteStorage`] inside the robot, or a reference to a storage elsewhere.
#[derive(Debug)]
pub struct Robot<S = RouteStorage> {
    pub(super) hot: Hot,
    pub(super) config: Config,
    pub(super) battery: Option<u8>,
    /// Number of unknown and invalid commands since power-on.
    pub(super) unknown: u32,
    pub(super) clock_filter: ClockFilter,
    pub(super) light: Light,
    pub(super) reflex: Reflex,
    pub(super) storage: S,
}

impl Robot {
    /// A robot that has just been switched on: it stands, its light is dark and its place is unknown.
    pub fn new(config: Config) -> Self {
        Self::with_storage(config, RouteStorage::new())
    }
}

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// [`Robot::new`] with the given storage, by value or by reference.
    pub fn with_storage(config: Config, storage: S) -> Self {
        Self {
            hot: Hot::new(&config),
            battery: None,
            unknown: 0,
            clock_filter: ClockFilter::new(),
            light: Light::default(),
            reflex: Reflex::new(&config),
            storage,
            config,
        }
    }

    /// The state that an ordinary step reads and writes. A simulator of thousands of robots may prefetch it into the
    /// cache.
    #[inline]
    pub fn hot(&self) -> &Hot {
        &self.hot
    }

    /// The configuration with which the robot was made.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The estimated pose; `None` while the robot is lost (its place is too uncertain to drive) or its heading is
    /// unknown.
    pub fn pose(&self) -> Option<Pose> {
        self.place().and_then(|_| self.hot.estimate.pose())
    }

    pub(super) fn place(&self) -> Option<Vec2> {
        (!self.is_lost(self.hot.now - self.hot.lag)).then(|| self.hot.estimate.at())
    }

    /// Direction of the neighbour that slows or blocks the robot, or did so in one of the last steps, radians
    /// counter-clockwise from the robot's front. `None` if there is none.
    pub fn braking_towards(&self) -> Option<f64> {
        if self.hot.is_wary { self.reflex.braking_towards() } else { None }
    }

    /// What the robot was doing in the latest step.
    pub fn state(&self) -> RobotState {
        self.hot.state
    }

    /// The show clock at `now` of the robot's own clock; `None` until the show clock is synchronised.
    pub fn show_time(&self, now: Instant) -> Option<Instant> {
        self.hot.clock.show_time(now)
    }

    /// The time by which routes advance: the show clock minus `Inputs::lag`. `None` until the show clock is
    /// synchronised.
    pub(super) fn route_time(&self, now: Instant) -> Option<Instant> {
        self.hot.clock.show_time(now).map(|show| show - self.hot.lag)
    }

    /// Distance of the robot from the present place of its route, metres; `None` if no route is under way.
    pub fn off_m(&self) -> Option<f64> {
        self.hot.routes.off_m()
    }

    /// Place of the route one step after the latest step, stage metres; `None` if no route is under way.
    pub fn route_place(&self) -> Option<Vec2> {
        self.hot.routes.due()
    }

    /// Expected error of the estimated place, 1 sigma, metres: that of x or of y, whichever is larger.
    pub fn place_error_m(&self) -> f64 {
        self.hot.estimate.error_m()
    }

    /// Expected error of the place for reports, 1 sigma, metres, rounded to 0.1 mm. If fixes are overdue: the error at
    /// [`FORESIGHT`] from now if the route goes on without fixes.
    pub(super) fn err_m(&self) -> f64 {
        let way_m =
            if self.is_blind() { self.hot.routes.way_ahead_m(FORESIGHT, self.storage.borrow()) } else { 0.0 };
        let err_m = self.hot.estimate.error_after_m(way_m);
        libm::round(err_m * 1e4) / 1e4
    }

    /// Whether the robot is lost: its pose is too uncertain to drive. A robot at rest on a held route is lost only if
    /// its last fix is too old or none ever came, however large its error is.
    pub(super) fn is_lost(&self, now: Instant) -> bool {
        if self.hot.routes.rests_held() {
            self.hot.estimate.lost_for_good(now)
        } else {
            self.hot.estimate.lost(now)
        }
    }

    /// [`Self::is_lost`] with the pose quality that was stored in this step.
    pub(super) fn is_lost_now(&self) -> bool {
        if self.hot.routes.rests_held() { self.hot.quality.lost_for_good } else { self.hot.quality.lost }
    }

    /// Whether position fixes are overdue, or none ever came.
    pub(super) fn is_blind(&self) -> bool {
        self.hot.estimate.is_blind(self.hot.now - self.hot.lag, self.hot.blind_after)
    }

    /// The robot's name.
    pub fn id(&self) -> RobotId {
        self.config.id
    }

    /// Number of unknown and invalid commands since power-on. Commands for which the robot lacks the ability count as
    /// unknown, and so do targets beyond 1 km.
    pub fn unknown(&self) -> u32 {
        self.unknown
    }

    pub(super) fn current_state(&self, route_time: Option<Instant>) -> RobotState {
        if self.hot.supervisor.is_faulty() {
            RobotState::Faulty
        } else if self.hot.supervisor.is_cut() && !self.hot.drive.rolls() {
            RobotState::Cut
        } else if self.is_lost_now() {
            RobotState::Lost
        } else if self.hot.routes.held(route_time) {
            RobotState::Held
        } else if self.hot.routes.under_way() || self.hot.seek.is_some() || self.hot.drive.rolls() {
            RobotState::Driving
        } else if self.hot.routes.keeps_one() {
            RobotState::Ready
        } else {
            RobotState::Idle
        }
    }

    /// Number of red flashes that show what is wrong: 3 if faulty, 2 if cut off, 1 if lost. Otherwise it is 2 if the
    /// link has been down for longer than `Config::silence`, and 0 if nothing is wrong. A robot without abilities never
    /// flashes.
    pub(super) fn trouble(&self, now: Instant) -> u8 {
        match self.hot.state {
            _ if !self.hot.shows_trouble => 0,
            RobotState::Faulty => 3,
            RobotState::Cut => 2,
            RobotState::Lost => 1,
            _ if self.hot.supervisor.is_down(now) => 2,
            _ => 0,
        }
    }
}
