//! From a plan to wheels: legs that are planned, uploaded, and driven, and changes of light beside them.
//!
//! A leg is the drive of all robots between two moments at which all stand. A participant is a robot of the run; the
//! numbers of participants count from 0.

use crate::context::Context;
use crate::event::{EventKind, Trouble};
use crate::frame_cursor::FrameCursor;
use crate::leg::Leg;
use crate::run::light_player::{self, LightPlayer};
use crate::run::lights::Lights;
use crate::run::link::LinkEstimate;
use crate::run::next::Next;
use crate::run::playback::PlayedShow;
use crate::run::roster::Roster;
use crate::run::target_progress::TargetProgress;
use crate::run::upload::Upload;
use lightbots_base::{Instant, Vec2};
use lightbots_wire::{Command, Details, Pieces, Route, Topic};
use std::collections::VecDeque;
use std::sync::Arc;

/// Largest clearance (gap to the rims of other robots) that is sent with a route, millimetres. It stands for any larger
/// clearance too (R31), because it is farther than proximity sensors see.
const ROOM_MAX_MM: f64 = 40.0;

/// The leg that is driven or was driven last, and how far TARGET-only robots are on it. TARGET-only robots understand
/// the command TARGET but no routes.
#[derive(Clone, Debug)]
pub(crate) struct DrivenLeg {
    pub leg: Leg,
    pub targets: TargetProgress,
}

/// What is planned next, and from where robots then set out.
#[derive(Clone, Debug)]
pub(crate) struct Planning {
    /// The frame that is planned next. `None` if nothing more is to be planned.
    pub next: Option<FrameCursor>,
    /// The last frame that is planned, or that the pending request plans.
    pub last: FrameCursor,
    /// `[participant]`: where its robot stands when the drive to `next` begins, stage metres. Empty if the next request
    /// takes these places from reports.
    pub from: Vec<Vec2>,
    /// Number of the plan request whose result is awaited, and when it was made. `None` if none is.
    pub pending: Option<(u64, Instant)>,
    /// Places where robots that dropped out stood, by their reports, when the last request was made; stage metres.
    pub around: Arc<[Vec2]>,
    /// Whether robots wait for the next plan, because all plans were dropped. The next plan then contains one frame
    /// only, because that is planned sooner.
    pub is_urgent: bool,
    /// Whether a robot stands too far from where the queued legs begin, so that all has to be planned again.
    pub is_outdated: bool,
    /// Whether some pixels of the last plan have no robot and stay dark.
    pub is_dark: bool,
    /// Why no frame after those in the queue could be planned, as a text for people. `None` if no plan failed.
    pub failure: Option<String>,
}

/// What plans drive around besides robots of the fleet, and whether they ignore some of these.
#[derive(Clone, Debug, Default)]
pub(crate) struct Obstacles {
    /// Places where robots met something that no robot of the fleet explains, stage metres.
    pub found: Vec<Vec2>,
    /// Whether plans ignore robots that came during the run and take no part, because no path was found past them.
    /// Reset when robots reach the next frame.
    pub ignores_strangers: bool,
}

/// Legs on their way from a plan to wheels.
#[derive(Clone, Debug)]
pub(crate) struct Pipeline {
    pub planning: Planning,
    pub obstacles: Obstacles,
    /// Legs that are planned and not begun, in driving order. Routes of the first one are uploaded.
    pub queue: VecDeque<Leg>,
    /// Earliest time at which routes of the next leg are sent.
    pub upload_from: Instant,
    /// The upload of the routes of the first leg of the queue; `None` if none was begun.
    pub upload: Option<Upload>,
    pub lights: Lights,
    pub light: LightPlayer,
    /// When routes are sent that were left for later, because too much light would be computed at once.
    /// [`Instant::FAR`] if there are none.
    pub again_at: Instant,
    /// The leg that is driven, or that has brought robots to where they stand.
    pub driven: Option<DrivenLeg>,
}

/// Why a robot does not acknowledge its route, although the route was sent as often as allowed.
enum Unacknowledged {
    /// The robot does not receive messages.
    Deaf,
    /// The link does not deliver messages: the route is sent again.
    LinkFails,
    /// The link has not delivered messages for too long.
    LinkFailed,
}

impl Pipeline {
    /// A pipeline in which nothing is planned.
    pub fn new(playback: &PlayedShow) -> Self {
        let first = playback.next;
        let planning = Planning {
            next: Some(first),
            last: first,
            from: Vec::new(),
            pending: None,
            around: Arc::default(),
            is_urgent: false,
            is_outdated: false,
            is_dark: false,
            failure: None,
        };
        Self {
            planning,
            obstacles: Obstacles::default(),
            queue: VecDeque::new(),
            upload_from: Instant::ZERO,
            upload: None,
            lights: Lights::default(),
            light: LightPlayer::new(playback),
            again_at: Instant::FAR,
            driven: None,
        }
    }

    /// Drops all queued legs, the upload and the pending plan request. `next` is then planned from where robots stand.
    pub fn clear(&mut self, next: Option<FrameCursor>) {
        self.upload = None;
        self.light.halt();
        self.queue.clear();
        self.planning.pending = None;
        self.planning.is_outdated = false;
        self.planning.is_urgent = true;
        self.planning.next = next;
        self.planning.from.clear();
    }

    /// Takes the first leg from the queue as the one that is driven now. `None` if the queue is empty.
    pub fn drive_next(&mut self) -> Option<&Leg> {
        let leg = self.queue.pop_front()?;
        let targets = TargetProgress::new(&leg);
        Some(&self.driven.insert(DrivenLeg { leg, targets }).leg)
    }

    /// The leg that is driven, or that has brought robots to where they stand.
    pub fn leg(&self) -> Option<&Leg> {
        self.driven.as_ref().map(|driven| &driven.leg)
    }

    /// Whether all robots that have a route in the next leg have acknowledged it.
    pub fn is_uploaded(&self) -> bool {
        match (&self.upload, self.queue.front()) {
            (Some(upload), Some(leg)) => upload.number == leg.seq && upload.is_done(),
            _ => false,
        }
    }

    /// When the upload has something to do next; [`Instant::FAR`] if nothing is due.
    pub fn due(&self) -> Instant {
        self.upload.as_ref().and_then(Upload::due).unwrap_or(Instant::FAR).min(self.again_at)
    }

    /// Sends routes of the first queued leg that may be sent now. Routes without acknowledgement are sent again first,
    /// and then those that were not sent yet. Returns a dropout for a robot that does not acknowledge, and the end of
    /// the run if the link does not deliver for too long.
    pub fn pump(
        &mut self,
        context: &mut Context,
        (playback, roster): (&PlayedShow, &Roster),
        link: &LinkEstimate,
        now: Instant,
    ) -> Next {
        self.again_at = Instant::FAR;
        if now < self.upload_from {
            return Next::Stay;
        }
        let Some(leg) = self.queue.front() else {
            self.upload = None;
            return Next::Stay;
        };
        if self.upload.as_ref().is_none_or(|upload| upload.number != leg.seq) {
            self.upload = Some(Upload::new(leg.seq, now, leg.robots.len()));
        }
        let after = self.queue.get(1);
        let Self { upload: Some(upload), lights, light, .. } = self else { return Next::Stay };
        let mut left = if light.is_active() { light_player::AT_ONCE } else { usize::MAX };
        let mut send = |context: &mut Context, participant: usize| {
            let ahead = light.first_stretch(context, (playback, roster), (leg, after), (now, participant));
            send_route(context, roster, (lights, ahead), leg, participant);
        };
        let again_after = context.config.upload.resend_after.max(link.round_trip * 5 / 4);
        while left > 0
            && let Some(participant) = upload.next_overdue(now, |one| roster.is_excluded(one))
        {
            left -= 1;
            let tries = upload.tries(participant);
            // Also recorded for a robot that drops out, because the dropout may be put off until it is known whether
            // the others answer.
            upload.record_sent(now, participant, now + again_after);
            if tries >= context.config.upload.tries {
                match judge(context, roster, link, upload, (now, participant)) {
                    Unacknowledged::Deaf => return Next::drop(participant, Trouble::Deaf),
                    Unacknowledged::LinkFailed => return Next::failed("no robot acknowledges its path"),
                    Unacknowledged::LinkFails => {}
                }
            }
            context.resent += 1;
            send(context, participant);
        }
        let window = context.config.upload.window;
        let needs_none = |one: usize| roster.is_excluded(one) || leg.path(one).is_none();
        while left > 0
            && let Some(participant) = upload.next_unserved(window, needs_none)
        {
            left -= 1;
            send(context, participant);
            upload.record_sent(now, participant, now + again_after);
        }
        if left == 0 {
            self.again_at = now + light_player::AGAIN_AFTER;
        }
        Next::Stay
    }

    /// Takes in a report, which acknowledges the route and the stretch of light that it names. Returns whether routes
    /// that were not sent yet can be sent now.
    pub fn acknowledge(
        &mut self,
        link: &mut LinkEstimate,
        now: Instant,
        participant: usize,
        details: &Details,
    ) -> bool {
        self.light.acknowledge(now, participant, details.light);
        let route = details.route;
        let Some(upload) = self.upload.as_mut().filter(|upload| upload.number == route) else { return false };
        if !upload.acknowledge(now, participant) {
            return false;
        }
        self.lights.settle(participant);
        if upload.is_done() {
            link.measure(upload.slowest());
        }
        upload.has_unserved()
    }

    /// Makes the route of a participant due at once, because its robot lost the route after acknowledging it. Does
    /// nothing if the robot has not acknowledged.
    pub fn upload_again(&mut self, now: Instant, participant: usize) {
        if let Some(upload) = &mut self.upload {
            upload.reopen(now, participant);
        }
    }
}

/// Decides what it means that a robot does not acknowledge. If no robot does, though this one reports, messages may not
/// be delivered; the same holds if the broker came back only recently. The robot is then kept, for as long as a run may
/// wait for its broker.
fn judge(
    context: &mut Context,
    roster: &Roster,
    link: &LinkEstimate,
    upload: &mut Upload,
    (now, participant): (Instant, usize),
) -> Unacknowledged {
    let restores = now - upload.began < link.patience(upload.began);
    let reports = roster.robot(context, participant).contact.heard > upload.began;
    if !reports || !(upload.is_unanswered() || restores) {
        return Unacknowledged::Deaf;
    }
    if upload.is_unanswered() && !std::mem::replace(&mut upload.is_announced, true) {
        context.log.record(now, EventKind::Undelivered);
    }
    upload.restart_clock(now, participant);
    if now - upload.began > context.config.waits.outage {
        return Unacknowledged::LinkFailed;
    }
    Unacknowledged::LinkFails
}

/// Sends a participant its route of a leg, if it has one. The first stretch of light (colours over time) goes along
/// with the route. Without one, a change of light that the robot may not have received goes along.
fn send_route(
    context: &mut Context,
    roster: &Roster,
    (lights, ahead): (&Lights, Option<Command>),
    leg: &Leg,
    participant: usize,
) {
    let Some(path) = leg.path(participant) else { return };
    let Ok(pieces) = Pieces::from_slice(&path.pieces) else { return };
    let robot = roster.robot(context, participant);
    let (topic, abilities) = (Topic::Robot(robot.id), robot.reported.abilities);
    let step = &leg.robots[participant];
    // The cast rounds down, and makes negative values 0.
    let room_mm = abilities.room.then(|| (step.room_m * 1e3).min(ROOM_MAX_MM) as u16);
    let neighbours = step.neighbours.as_deref().filter(|_| abilities.neighbours).cloned().unwrap_or_default();
    let route = Command::Route(Route { seq: leg.seq, start: path.start, pieces, room_mm, neighbours });
    match (lights.pending(participant), ahead) {
        (_, Some(stretch)) => context.outbox.send(topic, &[route, stretch]),
        (Some(fade), None) => context.outbox.send(topic, &[route, Command::Fade(fade)]),
        (None, None) => context.outbox.send(topic, &[route]),
    }
}
