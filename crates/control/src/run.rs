//! A run: robots in their seats, the leg they drive, the legs that follow, and what everybody waits for.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::event::{EventKind, Outcome};
use crate::fleet::Robot;
use crate::hopping::Hops;
use crate::leg::Kind;
use crate::leg::Leg;
use crate::operation::MissingPolicy;
use crate::recovery_bound::RecoveryBound;
use crate::starting::Start;
use crate::trial::Trial;
use crate::upload::Upload;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_show::Show;
use lightbots_wire::{Fade, RobotState};
use std::collections::VecDeque;
use std::sync::Arc;

/// A robot's part in the run.
#[derive(Clone, Debug)]
pub(crate) struct Seat {
    /// Index into the fleet.
    pub robot: usize,
    /// It dropped out and stands somewhere.
    pub out: bool,
    /// How often it dropped out.
    pub dropouts: u8,
    /// It may come back once so many frames were played.
    pub back_from: usize,
    /// Whether it has to show that it drives before it comes back.
    pub trial: Trial,
    /// The route it acknowledged last.
    pub acked: u32,
    /// How often the present route was sent.
    pub tries: u32,
    /// When it was sent first.
    pub sent: Instant,
    /// The start it confirmed last.
    pub starts: Option<Instant>,
    /// It reached the goal of the present leg.
    pub arrived: bool,
    /// It is too far off its path, since when.
    pub late: Option<Instant>,
    /// It is late because it is not sure of its place.
    pub unsure: bool,
    /// Something stands in its way, since when.
    pub blocked: Option<Instant>,
    /// When something stood in its way last while it was not late yet: then that is why it is late.
    pub hindered: Option<Instant>,
    /// How often that led to a new plan.
    pub blocks: u8,
    /// Since when it owes a sign of life because somebody near it is blocked.
    pub probed: Option<Instant>,
    /// It has been asked for a sign of life, last when.
    pub asked: Instant,
    /// When it was seen last to be on its way although the plan has ended.
    pub on_its_way: Instant,
    /// How near to its goal it was at the nearest, metres, and when it last came nearer by a step that counts.
    pub nearest: (f64, Instant),
    /// Where it may stand, if it fell silent on its way; stage metres.
    pub ghost: Vec<Vec2>,
    /// The likely ones of them.
    pub likely: Vec<Vec2>,
    /// A change of its light that it may not know yet.
    pub fade: Option<Fade>,
}

/// What kind of run it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Purpose {
    Play,
    Preview,
}

/// Where a run is.
#[derive(Clone, Debug)]
pub(crate) enum Phase {
    /// All are asked where they stand.
    Gathering(Gathering),
    /// All stand, in a picture or before the first; the next leg is planned and handed out meanwhile.
    Standing(Standing),
    /// The START of the next leg is stated.
    Starting(Start),
    /// Robots drive.
    Driving(Drive),
    /// The broker is lost since then.
    Offline(Instant),
}

/// All are asked where they stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gathering {
    /// Who drove begins to stop then, and stands …
    pub stopping: Instant,
    /// … then.
    pub since: Instant,
    /// Reports count from then on.
    pub fresh_from: Instant,
    pub ask_at: Instant,
    /// When STOP is said, if progress is held first.
    pub stop_at: Option<Instant>,
    /// Nothing was driven yet: too few robots are a reason not to begin.
    pub first: bool,
    /// The drive that was broken off: who is silent may stand anywhere along it.
    pub broken_off: Option<Drive>,
}

/// All stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Standing {
    pub since: Instant,
    /// The picture stays at least until then.
    pub until: Instant,
    /// Air time that is left while paused.
    pub paused: Option<Span>,
}

/// Where the run goes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cursor {
    pub frame: usize,
    pub round: u32,
}

/// Everything about one run.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    pub show: Arc<Show>,
    pub purpose: Purpose,
    pub begun: Instant,
    pub missing: MissingPolicy,
    pub looping: bool,
    pub seats: Vec<Seat>,
    pub phase: Phase,
    /// There was no way with robots that came during the run and take no part: they are not driven around until the
    /// next picture stands.
    pub disregards_strangers: bool,
    /// The picture that stood when all were asked anew: its air time runs on.
    pub stood: Option<Standing>,
    /// When the broker came back last.
    pub online: Option<Instant>,
    /// The leg that is driven or has brought everybody where they stand.
    pub current: Option<Leg>,
    /// How far the hops of the present leg are.
    pub hops: Hops,
    /// The first and the last arrival at a place in the next frame.
    pub arrivals: Option<(Instant, Instant)>,
    /// The legs that follow; the first is handed out.
    pub queue: VecDeque<Leg>,
    pub upload: Option<Upload>,
    /// The frame that is reached next.
    pub next: Cursor,
    /// The frame that is planned next.
    pub plan_next: Option<Cursor>,
    /// `[seat]`: where everybody stands when it is driven to.
    pub plan_from: Vec<Vec2>,
    /// The job that is out, and since when.
    pub drafting: Option<(u64, Instant)>,
    /// The last frame that is planned or being planned.
    pub plan_tail: Cursor,
    /// Plan only one frame for now: robots wait.
    pub hurry: bool,
    /// Why there is no plan beyond the queue.
    pub failed: Option<String>,
    pub pause: bool,
    /// Pause again at the next picture.
    pub step: bool,
    /// Robots stand too far from where the next leg begins.
    pub stray: bool,
    /// Pixels of the last plan stayed dark.
    pub dark: bool,
    /// Where robots met something that nobody knew of; stage metres.
    pub found: Vec<Vec2>,
    /// Robots (indices into the fleet) that want to take part from the next frame on.
    pub joiners: Vec<usize>,
    /// Where the watch over the seats goes on.
    pub watched: usize,
    /// The longest a robot took to acknowledge lately, links both ways included.
    pub round_trip: Span,
    /// Added to the lead of a START, as answers were lost lately.
    pub lossy: Span,
    /// What recovery may still cost.
    pub bound: RecoveryBound,
    pub frames_played: usize,
    pub dropouts: usize,
    /// How it ended, once it has.
    pub over: Option<Outcome>,
}

impl Seat {
    pub fn new(robot: usize) -> Self {
        Self {
            robot,
            out: false,
            dropouts: 0,
            back_from: 0,
            trial: Trial::None,
            acked: 0,
            tries: 0,
            sent: Instant::ZERO,
            starts: None,
            arrived: false,
            late: None,
            unsure: false,
            blocked: None,
            hindered: None,
            blocks: 0,
            probed: None,
            asked: Instant::ZERO,
            on_its_way: Instant::ZERO,
            nearest: (f64::INFINITY, Instant::ZERO),
            ghost: Vec::new(),
            likely: Vec::new(),
            fade: None,
        }
    }

    /// It is somewhere else by now, or taken to be.
    pub fn forget_ghost(&mut self) {
        (self.ghost, self.likely) = (Vec::new(), Vec::new());
    }
}

impl Run {
    /// Everybody who can takes a seat; then it is asked where they stand, unless that is known.
    pub fn begin(
        desk: &mut Desk,
        now: Instant,
        show: Arc<Show>,
        purpose: Purpose,
        frame: usize,
        missing: MissingPolicy,
        looping: bool,
    ) -> Self {
        let next = Cursor { frame, round: 0 };
        desk.mapping.shown.clear();
        let seats = take_seats(desk);
        desk.log.tell(now, EventKind::RunBegun { from: frame, robots: seats.len() });
        let mut run = Self {
            show,
            purpose,
            begun: now,
            missing,
            looping,
            seats,
            phase: Phase::Gathering(Gathering {
                stopping: now,
                since: now,
                fresh_from: Instant::ZERO,
                ask_at: now,
                stop_at: None,
                first: true,
                broken_off: None,
            }),
            disregards_strangers: false,
            stood: None,
            online: None,
            current: None,
            hops: Hops::default(),
            arrivals: None,
            queue: VecDeque::new(),
            upload: None,
            next,
            plan_next: Some(next),
            plan_from: Vec::new(),
            drafting: None,
            plan_tail: next,
            hurry: false,
            failed: None,
            pause: false,
            step: false,
            stray: false,
            dark: false,
            found: Vec::new(),
            joiners: Vec::new(),
            watched: 0,
            round_trip: Span::ZERO,
            lossy: Span::ZERO,
            bound: RecoveryBound::default(),
            frames_played: 0,
            dropouts: 0,
            over: None,
        };
        // Originals do not say whether they drive: their places count once they stay the same.
        let may_drive = |robot: &Robot| robot.is_original() || robot.state != Some(RobotState::Idle);
        if run.seats.iter().any(|seat| may_drive(desk.fleet.robot(seat.robot))) {
            run.gather(desk, now);
        }
        run
    }

    /// The run is over: robots keep what they show.
    pub fn leave(&mut self, desk: &mut Desk) {
        for (seat, known) in self.seats.iter().enumerate() {
            let robot = desk.fleet.robot_mut(known.robot);
            robot.seat = None;
            let step = self.current.as_ref().and_then(|leg| leg.moves.get(seat)).filter(|_| !known.out);
            robot.pixel = step.and_then(|step| step.pixel);
            robot.goal = step.map(|step| step.goal);
        }
    }

    /// Time passes.
    pub fn tick(&mut self, desk: &mut Desk, now: Instant) {
        self.bound.pause(now, self.pause);
        match self.phase {
            Phase::Gathering(_) => self.tick_gathering(desk, now),
            Phase::Standing(_) => self.tick_standing(desk, now),
            Phase::Starting(_) => {
                self.pump_upload(desk, now);
                self.tick_start(desk, now);
            }
            Phase::Driving(_) => self.tick_drive(desk, now),
            Phase::Offline(since) if now - since > desk.config.offline_bound => {
                self.over = Some(Outcome::Failed("the broker did not come back".into()));
            }
            Phase::Offline(_) => {}
        }
    }

    /// When time has to pass next.
    pub fn due(&self, desk: &Desk, now: Instant) -> Instant {
        let upload = self.upload.as_ref().and_then(Upload::due).unwrap_or(Instant::FAR);
        match &self.phase {
            Phase::Gathering(_) => now + Span::from_millis(50),
            Phase::Standing(standing) => self.standing_due(desk, now, standing.until),
            Phase::Starting(start) => start.due().min(upload),
            Phase::Driving(drive) => drive.due().min(upload),
            Phase::Offline(_) => now + Span::from_millis(1_000),
        }
    }

    /// The leg whose paths are driven or about to be, and when they begin.
    pub fn driven_paths(&self) -> Option<(&Leg, Instant)> {
        let (leg, began) = match &self.phase {
            Phase::Starting(start) => (self.queue.front(), start.at),
            Phase::Driving(drive) => (self.current.as_ref(), drive.began),
            _ => return None,
        };
        leg.filter(|leg| leg.kind == Kind::Routes).map(|leg| (leg, began))
    }

    /// Where a seat's robot said it is; its goal where it never said.
    pub fn place(&self, desk: &Desk, seat: usize) -> Vec2 {
        let goal =
            || self.current.as_ref().and_then(|leg| leg.moves.get(seat)).map_or(Vec2::ZERO, |m| m.goal);
        desk.fleet.robot(self.seats[seat].robot).at.unwrap_or_else(goal)
    }

    /// Whether a seat has to arrive for the present leg to end.
    pub fn is_awaited(&self, seat: usize) -> bool {
        !self.seats[seat].out && self.current.as_ref().is_some_and(|leg| leg.moves(seat))
    }

    /// The frame after one, if there is any.
    pub fn after(&self, cursor: Cursor) -> Option<Cursor> {
        match self.purpose {
            Purpose::Preview => None,
            Purpose::Play if cursor.frame + 1 < self.show.frames.len() => {
                Some(Cursor { frame: cursor.frame + 1, ..cursor })
            }
            Purpose::Play => self.looping.then(|| Cursor { frame: 0, round: cursor.round + 1 }),
        }
    }
}

/// Seats for all who can take part.
fn take_seats(desk: &mut Desk) -> Vec<Seat> {
    let mut seats = Vec::new();
    for index in 0..desk.fleet.robots().len() {
        let robot = desk.fleet.robot_mut(index);
        robot.seat = robot.can_take_part().then_some(seats.len() as u32);
        if robot.seat.is_some() {
            seats.push(Seat::new(index));
        }
    }
    seats
}
