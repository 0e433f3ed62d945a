//! A small simulated robot. Unless a test gives it an error, it is exactly where it should be.

use lightbots_base::{Instant, PathRef, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{
    Abilities, Blocked, Command, Details, LightStretch, Report, RobotState, Route, TimeQuestion, Topic,
    commands,
};

/// A message that a robot sends: its topic and payload.
pub type Said = (Topic, Vec<u8>);

/// If a robot drove farther than this in its last step of 10 ms when STOP comes, that counts as a dead stop, metres. It
/// is a speed of 0.03 m/s.
const DEAD_STOP_M: f64 = 0.0003;
/// Speed towards a TARGET, m/s.
const SPEED_MPS: f64 = 0.25;

pub struct Robot {
    pub id: RobotId,
    pub at: Vec2,
    heading: f64,
    pub light: Rgb,
    pub original: bool,
    /// Whether the robot neither sends nor does anything.
    pub dead: bool,
    /// Whether the robot stands still whatever it is sent, and reports that.
    pub stuck: bool,
    /// How far its estimate of the show clock is ahead.
    pub ahead: Span,
    /// Progress along its route as a share of the show clock's.
    pub pace: f64,
    /// Bound of its clock error that it reports, microseconds.
    pub clock_us: u32,
    /// Whether it reports no clock, because the show clock was set anew and it has too few answers.
    pub clockless: bool,
    /// Whether it is unsure of its place.
    pub unsure: bool,
    /// Whether it has lost its place: it reports `lost` and no place.
    pub lost: bool,
    /// The obstacle that it reports in its path, if any.
    pub blocked: Option<Blocked>,
    pub target: Option<Vec2>,
    pub kept: Option<(Route, Option<Instant>)>,
    pub running: Option<(Route, Instant)>,
    pub held: Span,
    pub hold_since: Option<Instant>,
    resumed_at: Option<Instant>,
    stops_at: Option<Instant>,
    finished: u32,
    synchronised: bool,
    pub fade: Option<(Instant, Rgb)>,
    state: RobotState,
    status_at: Instant,
    heard: Instant,
    said: Vec<Said>,
    pub stops: u32,
    /// How often it stopped dead: STOP came while it drove along its route.
    pub dead_stops: u32,
    /// How far it drove along its route in the latest step, metres.
    moved_m: f64,
    pub starts_heard: u32,
    /// All stretches of light that it received.
    pub stretches: Vec<LightStretch>,
}

impl Robot {
    pub fn new(number: usize, at: Vec2, original: bool) -> Self {
        Self {
            id: RobotId::new(&format!("robot-{number}")).unwrap(),
            at,
            heading: 0.0,
            light: Rgb::BLACK,
            original,
            dead: false,
            stuck: false,
            ahead: Span::ZERO,
            pace: 1.0,
            clock_us: 500,
            clockless: false,
            unsure: false,
            lost: false,
            blocked: None,
            target: None,
            kept: None,
            running: None,
            held: Span::ZERO,
            hold_since: None,
            resumed_at: None,
            stops_at: None,
            finished: 0,
            synchronised: false,
            fade: None,
            state: RobotState::Idle,
            status_at: Instant::ZERO,
            heard: Instant::ZERO,
            said: Vec::new(),
            stops: 0,
            dead_stops: 0,
            moved_m: 0.0,
            starts_heard: 0,
            stretches: Vec::new(),
        }
    }

    /// Resets the robot, as if it were switched off and on at its place.
    pub fn restart(&mut self) {
        let number: usize = self.id.as_str()[6..].parse().unwrap();
        *self = Self::new(number, self.at, self.original);
        self.say_report(Topic::Uuid, 0);
    }

    pub fn introduce(&mut self) {
        self.say_report(Topic::Uuid, self.named());
    }

    pub fn take_said(&mut self) -> Vec<Said> {
        let said = std::mem::take(&mut self.said);
        if self.dead { Vec::new() } else { said }
    }

    fn named(&self) -> u32 {
        let running = self.running.as_ref().map(|(route, _)| route.seq);
        self.kept.as_ref().map(|(route, _)| route.seq).or(running).unwrap_or(self.finished)
    }

    fn state(&self) -> RobotState {
        match () {
            _ if self.lost => RobotState::Lost,
            _ if self.running.is_some() && self.hold_since.is_some() => RobotState::Held,
            _ if self.running.is_some() || self.target.is_some() => RobotState::Driving,
            _ if self.kept.is_some() => RobotState::Ready,
            _ => RobotState::Idle,
        }
    }

    fn say_report(&mut self, topic: Topic, route: u32) {
        let starts = match &self.kept {
            Some((_, starts)) => *starts,
            None => self.running.as_ref().map(|(_, began)| *began),
        };
        let details = Details {
            heading: Some(self.heading),
            battery: Some(90),
            state: self.state(),
            route,
            starts,
            light: self.stretches.last().map_or(0, |stretch| stretch.number),
            err_m: self.unsure.then_some(0.02),
            off_m: self.running.as_ref().map(|_| if self.stuck { 0.2 } else { 0.001 }),
            clock_us: (self.synchronised && !self.clockless).then_some(self.clock_us),
            abilities: Abilities::ALL,
            blocked: self.blocked,
            ..Details::default()
        };
        let report = Report {
            id: self.id,
            at: (!self.lost).then_some(self.at),
            details: (!self.original).then_some(details),
        };
        let mut text = String::new();
        report.encode(&mut text).unwrap();
        self.said.push((topic, text.into_bytes()));
    }

    pub fn receive(&mut self, now: Instant, payload: &[u8], personal: bool) {
        if self.dead {
            return;
        }
        self.heard = now;
        for command in commands(payload).flatten() {
            let known = matches!(command, Command::Target(_) | Command::Color(_) | Command::Uuid);
            if known || !self.original {
                self.obey(command, personal);
            }
        }
    }

    fn obey(&mut self, command: Command, personal: bool) {
        match command {
            Command::Target(at) => {
                self.stop();
                self.target = Some(at);
            }
            Command::Color(color) => self.light = color,
            Command::Light(stretch) => {
                self.stretches.push(stretch);
                self.say_report(Topic::Status, self.named());
            }
            Command::Uuid => self.introduce(),
            Command::Route(route) => {
                if self.named().wrapping_sub(route.seq) >= 64 || self.named() == 0 {
                    self.kept = Some((route, None));
                }
                self.say_report(Topic::Status, self.named());
            }
            Command::Start { seq, at } => {
                self.starts_heard += 1;
                let mine =
                    self.kept.as_mut().filter(|(route, starts)| route.seq == seq && *starts != Some(at));
                let news = mine.is_some();
                if let Some((_, starts)) = mine {
                    *starts = Some(at);
                }
                if news || personal {
                    self.say_report(Topic::Status, self.named());
                }
            }
            Command::Hold { at } => self.hold_from(at),
            Command::Resume { at } => {
                if let Some(since) = self.hold_since.take() {
                    self.held += at - since;
                    self.resumed_at = Some(at);
                }
            }
            Command::StopFrom { at } if self.running.is_some() => {
                self.hold_from(at);
                self.stops_at = Some(at + Route::EASE);
            }
            Command::Stop | Command::StopFrom { .. } => self.halt(),
            Command::Time(_) => self.synchronised = true,
            Command::Fade(fade) => self.fade = Some((fade.at + fade.over, fade.to)),
            Command::Status => self.say_report(Topic::Status, self.named()),
            Command::Blink(_) | Command::Slot(_) | Command::Live(_) | Command::Release(_) => {}
        }
    }

    /// Holds from the earliest moment that it was told.
    fn hold_from(&mut self, at: Instant) {
        self.hold_since = Some(self.hold_since.map_or(at, |since| since.min(at)));
    }

    fn halt(&mut self) {
        self.stops += 1;
        self.dead_stops += u32::from(self.running.is_some() && self.moved_m > DEAD_STOP_M);
        self.stop();
        self.say_report(Topic::Status, 0);
    }

    fn stop(&mut self) {
        self.stops_at = None;
        (self.kept, self.running, self.target, self.finished) = (None, None, None, 0);
    }

    pub fn step(&mut self, now: Instant, dt: Span) {
        if self.dead {
            return;
        }
        if !self.original && !self.synchronised && now.0 % 250_000 < 10_000 {
            let mut text = String::new();
            TimeQuestion { id: self.id, asked: now }.encode(&mut text).unwrap();
            self.said.push((Topic::Time, text.into_bytes()));
        }
        let show = now + self.ahead;
        if let Some((route, Some(at))) = self.kept.take_if(|(_, starts)| starts.is_some_and(|at| at <= show))
        {
            self.running = Some((route, at));
            // A hold for later counts for this route as well (R39).
            let hold_since = self.hold_since.filter(|&since| since >= at);
            (self.held, self.hold_since, self.resumed_at) = (Span::ZERO, hold_since, None);
        }
        if self.stops_at.is_some_and(|at| at <= show) {
            self.halt();
        }
        self.turn();
        self.drive(now, show, dt);
        if let Some((_, color)) = self.fade.take_if(|(at, _)| *at <= now) {
            self.light = color;
        }
        let state = self.state();
        let pace = Span::from_millis(if self.running.is_some() { 500 } else { 2_000 });
        if !self.original && (state != self.state || now >= self.status_at) {
            self.status_at = now + pace;
            self.state = state;
            self.say_report(Topic::Status, self.named());
        }
    }

    /// Turns the robot at once towards the end of its route while it waits for the route to begin.
    fn turn(&mut self) {
        let waits = self.running.is_none() && !self.stuck;
        if let Some(((route, _), true)) = self.kept.as_ref().map(|kept| (kept, waits)) {
            let way = PathRef::new(route.start, &route.pieces).end() - route.start;
            self.heading = way.normalized().map_or(self.heading, Vec2::angle);
        }
    }

    /// Path time by R38: in a hold its rate falls linearly to zero, and afterwards rises linearly.
    fn path_time(&self, show: Instant, began: Instant) -> Span {
        let eased = |elapsed: Span| {
            let eased = elapsed.clamp(Span::ZERO, Route::EASE).as_secs();
            Span::from_secs(eased * eased / (2.0 * Route::EASE.as_secs()))
        };
        let free = |show: Instant| show - began - self.held;
        match (self.hold_since, self.resumed_at) {
            (Some(since), _) if show > since => {
                let slowing = (show - since).min(Route::EASE);
                free(since) + slowing - eased(slowing)
            }
            (None, Some(at)) => {
                let picking_up = (show - at).clamp(Span::ZERO, Route::EASE);
                free(show.max(at)) + Route::EASE / 2 - picking_up + eased(picking_up)
            }
            _ => free(show),
        }
    }

    fn drive(&mut self, now: Instant, show: Instant, dt: Span) {
        if let Some((route, began)) = self.running.clone() {
            if now - self.heard > Span::from_millis(2_000) {
                self.stop();
                return;
            }
            let path = PathRef::new(route.start, &route.pieces);
            let time = Span::from_secs(self.path_time(show, began).as_secs() * self.pace);
            if !self.stuck {
                let at = path.at(time).position;
                (self.moved_m, self.at) = (at.distance(self.at), at);
            }
            if time >= path.duration() && !self.stuck {
                self.running = None;
                self.finished = route.seq;
                self.say_report(Topic::Arrival, route.seq);
            }
        } else if let Some(target) = self.target.filter(|_| !self.stuck) {
            let way = target - self.at;
            let step = SPEED_MPS * dt.as_secs();
            self.at = if way.length() <= step { target } else { self.at + way * (step / way.length()) };
            if self.at == target {
                self.target = None;
                self.say_report(Topic::Arrival, 0);
            }
        }
    }
}
