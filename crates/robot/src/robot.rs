//! The robot: messages in, steps in, wheels, light and reports out.

mod knows;
mod obey;
mod tell;

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Rgb, Span, Vec2};
use lightbots_wire::{RobotState, Topic, commands};

use crate::clock::Clock;
use crate::config::{Config, Inputs, Outputs};
use crate::drive::{Body, Drive, Setpoint};
use crate::estimate::Estimate;
use crate::light::Light;
use crate::outbox::Outbox;
use crate::reflex::{Reflex, Wish};
use crate::routes::{InSight, Routes};
use crate::seek::Seek;
use crate::shelf::Shelf;
use crate::stall::Stall;
use crate::supervise::{Drives, Supervisor};

/// A message to send. The longest report has 291 bytes.
pub type Message = heapless::String<320>;

/// A step is taken for no longer than this; longer pauses are gaps.
const LONGEST_STEP: Span = Span::from_millis(100);
const LONGEST_STEP_S: f64 = LONGEST_STEP.as_secs();
/// This far off its route, metres, the robot gives the route up: it is stuck, or was never where the route starts.
const GIVE_UP_M: f64 = 0.3;
/// Neighbours this much beyond the range of the sensors may be in sight all the same, metres: both are off their places.
const OFF_PLAN_M: f64 = 0.025;

/// A robot without fixes does not say that it is there if its place is less sure than this, metres.
const SURE_M: f64 = 0.003;
/// While fixes stay away it drives no farther than its place is as sure as this, metres: less than makes it lost.
const PAUSE_M: f64 = 0.016;
/// Without a compass it learns its heading by creeping straight on, m/s.
const CREEP_MPS: f64 = 0.08;

/// The whole of a robot's mind: no allocation, no clock, no IO. Feed it messages and steps, drain what it says. `S` is
/// where its routes and its trail lie: in itself unless it was given another place.
///
/// It lies in memory as it is declared, and its larger parts as well: what every step looks at lies together in a few
/// stretches, between them what few steps do, and [`fetch`](Self::fetch) names the former in order.
#[derive(Debug)]
#[repr(C)]
pub struct Robot<S = Shelf> {
    shelf: S,
    /// Begins with what each step looks at.
    clock: Clock,
    /// Ends with what each step looks at.
    config: Config,
    now: Instant,
    /// When the latest step was, in the time of the world that the wheels are in.
    last_step: Option<Instant>,
    /// How far that world lags behind the own clock, as of the latest step.
    lag: Span,
    state: RobotState,
    shown: Rgb,
    battery: Option<u8>,
    /// It stands until fixes come again.
    pauses: bool,
    /// Its reflex sees something or does something about it. Else nobody need ask it.
    wary: bool,
    /// What the latest step knew of its place.
    doubts: Doubts,
    unknown: u32,
    drive: Drive,
    stall: Stall,
    supervisor: Supervisor,
    seek: Option<Seek>,
    outbox: Outbox,
    /// Begins with what each step looks at.
    light: Light,
    reflex: Reflex,
    estimate: Estimate,
    routes: Routes,
}

/// Whether a robot knows too little to drive, as of one step.
#[derive(Clone, Copy, Debug)]
struct Doubts {
    lost: bool,
    /// Even if it need not know its place well.
    for_good: bool,
    /// Fixes that should have come stay away.
    blind: bool,
}

impl Robot {
    /// A robot that has just been switched on: it stands, shows nothing and knows nothing.
    pub fn new(config: Config) -> Self {
        Self::with_shelf(config, Shelf::new())
    }
}

impl<S: BorrowMut<Shelf>> Robot<S> {
    /// The same with its routes and its trail on this shelf, which may lie elsewhere.
    pub fn with_shelf(config: Config, shelf: S) -> Self {
        let phase = Span::from_millis(i64::from(config.seed % 1999));
        Self {
            now: Instant::ZERO,
            estimate: Estimate::new(&config),
            clock: Clock::new(Instant::ZERO + phase / 10),
            drive: Drive::default(),
            light: Light::default(),
            shown: Rgb::BLACK,
            seek: None,
            reflex: Reflex::new(&config),
            stall: Stall::default(),
            supervisor: Supervisor::new(config.silence),
            outbox: Outbox::new(phase),
            state: RobotState::Lost,
            battery: None,
            unknown: 0,
            pauses: false,
            wary: false,
            last_step: None,
            lag: Span::ZERO,
            routes: Routes::new(),
            shelf,
            doubts: Doubts { lost: true, for_good: true, blind: true },
            config,
        }
    }

    /// Takes a message that came in at `now` of its own clock, on `Broadcast` or its own topic; others are not for it.
    pub fn receive(&mut self, now: Instant, topic: Topic, payload: &[u8]) {
        let personal = topic == Topic::Robot(self.config.id);
        if !personal && topic != Topic::Broadcast {
            return;
        }
        self.now = self.now.max(now);
        // The message does not undo a silence that no step could notice because the simulation stood.
        if self.supervisor.check_link(now, self.drives()) {
            self.seek = None;
            self.routes.abandon();
            self.drive.halt();
        }
        self.supervisor.hear(now);
        // A route whose moment has come is under way, even if no step saw it yet: the next one must not replace it.
        if self.route_time(now).is_some_and(|show| self.routes.begin_due(show, self.shelf.borrow())) {
            self.seek = None;
            self.reflex.begin_route();
        }
        let mut commands = commands(payload);
        // Looked at where it was decoded: it has room for a route, and moving it would copy all of that.
        while let Some(command) = &commands.next() {
            match command {
                Ok(command) if self.can(command) => self.obey(now, personal, command),
                _ => self.unknown = self.unknown.saturating_add(1),
            }
        }
    }

    /// The link to the broker went up or down at `now`. Up: it introduces itself as soon as it knows where it is.
    pub fn link(&mut self, now: Instant, up: bool) {
        self.now = self.now.max(now);
        self.supervisor.link(now, up);
        if up {
            self.clock.hurry(now);
            self.outbox.arrive_new(now);
        }
    }

    /// One step, each 16 ms, at `now` of its own clock. Steps further apart than 0.1 s of the wheels' world are gaps: the
    /// wheels may have turned meanwhile, but nothing is planned over them.
    pub fn step(&mut self, now: Instant, inputs: &Inputs) -> Outputs {
        let world = now - inputs.lag;
        let took = self.take_time(now, world);
        self.lag = inputs.lag;
        self.sense(world, inputs, took.as_secs());
        self.doubts = Doubts {
            lost: self.estimate.lost(world),
            for_good: self.estimate.lost_for_good(world),
            blind: self.is_blind(),
        };
        let show = self.route_time(now);
        if show.is_some_and(|show| self.routes.begin_due(show, self.shelf.borrow())) {
            self.seek = None;
            self.reflex.begin_route();
        }
        self.supervise(now);
        let wheels_radps = self.act(now, show, took);
        self.wary = self.wary && self.reflex.is_wary();
        self.stall.tell(wheels_radps);
        self.state = self.what_it_does(show);
        self.light.say(now, self.trouble(now));
        self.shown = self.light.step(now, self.clock.show_time(now));
        self.speak(now);
        Outputs { wheels_radps, light: self.shown }
    }

    /// The light at `now` of its own clock, between steps: a shell whose light can change at any time asks for it each
    /// millisecond or so, that lights of a fleet change together and not each at its next step.
    pub fn light(&mut self, now: Instant) -> Rgb {
        self.shown = self.light.step(now, self.clock.show_time(now));
        self.shown
    }

    /// How long the step took; messages may have come in between.
    fn take_time(&mut self, now: Instant, world: Instant) -> Span {
        if self.last_step.is_none() {
            self.outbox.arrive_new(now);
        }
        let took = self.last_step.map_or(Span::ZERO, |last| {
            // Lag that is made good at rest is no time in which wheels turned.
            let most = if self.routes.under_way() { LONGEST_STEP } else { now - (last + self.lag) };
            (world - last).min(most)
        });
        self.last_step = Some(world);
        self.now = now;
        took.clamp(Span::ZERO, LONGEST_STEP)
    }

    fn sense(&mut self, world: Instant, inputs: &Inputs, dt: f64) {
        let most = self.config.limits.wheel_radps * LONGEST_STEP_S * 2.0;
        if inputs.wheel_turns_rad.iter().all(|turn| turn.abs() <= most) {
            self.estimate.advance(world, inputs.wheel_turns_rad, &mut self.shelf.borrow_mut().trail);
            let [left, right] = inputs.wheel_turns_rad;
            let way_m = 0.5 * (left + right) * self.config.limits.wheel_radius_m;
            let turn_rad = (right - left) * self.config.limits.wheel_radius_m / self.config.limits.track_m;
            let gaps_m = inputs.proximity_m.as_ref().filter(|gaps| self.reflex.notices(gaps));
            if self.wary || gaps_m.is_some() {
                let mut expected = InSight::new();
                let body = Body { at: self.estimate.at(), facing: self.estimate.facing() };
                let range_m = f64::from(self.config.proximity.range_m);
                let sight_m = self.config.limits.contact_m() + range_m + OFF_PLAN_M;
                self.routes.expect(body, sight_m, self.shelf.borrow(), &mut expected);
                self.reflex.look(gaps_m, (way_m, turn_rad), dt, &expected, self.estimate.error_m());
                self.wary = true;
            }
            if self.stall.look(inputs.wheel_turns_rad, dt) {
                self.supervisor.fault(self.now);
            }
        } else {
            self.supervisor.fault(self.now);
        }
        if let Some(fix) = &inputs.fix {
            self.estimate.correct(world, fix, &self.shelf.borrow().trail);
            if self.estimate.take_senseless() {
                self.supervisor.fault(self.now);
            }
        }
        if let Some(percent) = inputs.battery {
            self.battery = Some(percent.min(100));
        }
    }

    /// Gives up what must not go on. A target survives being lost or blocked, as with an original robot; a route does
    /// not, because the others have driven on.
    fn supervise(&mut self, now: Instant) {
        let drives = self.drives();
        if self.supervisor.check_link(now, drives) {
            self.seek = None;
            self.routes.abandon();
        }
        if drives == Drives::Route {
            let gives_up = self.routes.off_m().is_some_and(|off| off > GIVE_UP_M);
            // Who waits for fixes knows why its route runs away.
            if gives_up && !self.pauses {
                self.supervisor.fault(now);
            }
            if gives_up || self.supervisor.faulty(now) || self.is_lost_now() {
                self.routes.abandon();
            }
        }
        if self.supervisor.take_question(now, drives) {
            self.outbox.ask_time();
        }
    }

    fn drives(&self) -> Drives {
        if self.routes.under_way() {
            Drives::Route
        } else if self.routes.in_a_run() {
            Drives::Soon
        } else if self.seek.is_some() {
            Drives::Target
        } else {
            Drives::Not
        }
    }

    fn act(&mut self, now: Instant, show: Option<Instant>, took: Span) -> [f64; 2] {
        if self.supervisor.faulty(now) || self.supervisor.is_cut() {
            return self.drive.halt();
        }
        let wants = if self.is_lost_now() { None } else { self.want(show, took) };
        let wants = if self.pauses() { Setpoint::default() } else { wants.unwrap_or_default() };
        let most_mps = if !self.wary {
            None
        } else if self.routes.under_way() {
            let [speed_mps, told_mps] = [wants.speed_mps, self.drive.speed_mps()].map(|mps| mps as f32);
            let wish = Wish { speed_mps, told_mps, dt: took.as_secs() as f32 };
            let named = self.routes.names_neighbours(self.shelf.borrow());
            self.reflex.limit(wish, self.routes.room_mm().filter(|_| !named))
        } else {
            self.reflex.forget();
            None
        };
        self.drive.gently = self.wary && self.reflex.sees_strays();
        let (slip, limits, dt) = (self.estimate.slip(), &self.config.limits, took.as_secs());
        let blocked_mps = if self.wary { self.reflex.blocked_mps() } else { None };
        let wheels = match most_mps {
            // Held, it may turn on the spot for what comes.
            _ if blocked_mps.is_some() && !self.routes.rests_held() => match blocked_mps.unwrap_or(0.0) {
                0.0 => self.drive.halt(),
                speed_mps => {
                    let back = Setpoint { speed_mps, turn_radps: 0.0 };
                    self.drive.step(back, slip, dt, limits)
                }
            },
            Some(most_mps) => self.drive.step_within(wants, most_mps, slip, dt, limits),
            None => self.drive.step(wants, slip, dt, limits),
        };
        self.arrive(show);
        wheels
    }

    /// Whether it had better stand until fixes come again, because it would be lost if it drove on.
    fn pauses(&mut self) -> bool {
        self.pauses = self.doubts.blind
            && (self.pauses
                || self.estimate.error_at_worst_m(self.drive.braking_m(&self.config.limits)) > PAUSE_M);
        self.pauses
    }

    /// What it wants to do: the route under way, else the target, else turn towards what comes.
    fn want(&mut self, show: Option<Instant>, took: Span) -> Option<Setpoint> {
        if !self.routes.under_way() && self.seek.is_none() && !self.routes.keeps_one() {
            return None;
        }
        if !self.estimate.aligned() {
            let drives = self.routes.under_way() || self.seek.is_some();
            return drives.then_some(Setpoint { speed_mps: CREEP_MPS, turn_radps: 0.0 });
        }
        let limits = &self.config.limits;
        let body = Body { at: self.estimate.at(), facing: self.estimate.facing() };
        let soon = self.drive.foresee(body, took.as_secs());
        if let Some(show) = show.filter(|_| self.routes.under_way()) {
            let away = if self.wary { self.reflex.give_way(self.routes.room_mm()) } else { Vec2::ZERO };
            let aside = soon.facing * away.x + soon.facing.left() * away.y;
            return self.routes.step(show + took, soon, aside, limits, self.shelf.borrow());
        }
        match self.seek.as_mut() {
            Some(seek) => Some(seek.step(soon, limits)),
            None => self.routes.prepare(soon),
        }
    }

    /// Says once that it is there, when it stands there.
    fn arrive(&mut self, show: Option<Instant>) {
        if !self.drive.stands() || self.is_lost_now() {
            return;
        }
        if self.doubts.blind && self.estimate.error_m() > SURE_M {
            return;
        }
        let at = self.estimate.at();
        if let Some(route) = show.and_then(|show| self.routes.finish(show, at)) {
            self.outbox.arrived(route);
        }
        if self.seek.take_if(|seek| seek.reached(at)).is_some() {
            self.outbox.arrived(0);
        }
    }

    fn speak(&mut self, now: Instant) {
        if self.config.abilities.route && self.supervisor.is_up() && self.clock.take_question(now) {
            self.outbox.ask_time();
        }
        let knows_place = self.state != RobotState::Lost && !self.is_lost_now();
        let err_m = (self.routes.under_way() && self.doubts.blind).then(|| self.err_m());
        self.outbox.notice(now, self.state, self.routes.off_m(), err_m, knows_place);
        self.outbox.notice_block(self.blocked().map(|blocked| blocked.towards));
    }
}
