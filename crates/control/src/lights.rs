//! Lights of a drive: colours change over its last part, by the show clock.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Fade, Topic};

/// The longest a colour takes to change.
const FADE_MAX: Span = Span::from_millis(1_000);
/// A change of light nobody acknowledges is said again after this long, …
const AGAIN: Span = Span::from_millis(300);
/// … so often in fleets of up to …
const TIMES: u32 = 4;
/// … so many robots; once in larger ones.
const FEW: usize = 200;

/// When colours begin to change and how long that takes.
fn change(drive: &Drive) -> (Instant, Span) {
    let over = FADE_MAX.min((drive.ends - drive.began) / 2).max(Span::ZERO);
    (drive.ends - over, over)
}

impl Run {
    /// Everybody learns when and how its light changes. Where a next route follows it goes along with that, which
    /// is acknowledged; otherwise at once and once more.
    pub fn plan_lights(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        let Some(leg) = &self.current else { return };
        let (at, over) = change(drive);
        let follows = |seat: usize| {
            self.upload.is_none() && self.queue.front().is_some_and(|next| next.path(seat).is_some())
        };
        for (seat, step) in leg.moves.iter().enumerate() {
            let (robot, out) = (self.seats[seat].robot, self.seats[seat].out);
            let known = desk.fleet.robot(robot);
            if out || !(leg.airs || leg.path(seat).is_some()) || known.is_original() {
                continue;
            }
            if known.light == step.color && self.seats[seat].fade.is_none() {
                continue;
            }
            let id = known.id;
            if known.abilities.fade {
                let fade = Fade { to: step.color, at, over };
                self.seats[seat].fade = Some(fade);
                desk.relight(robot, step.color);
                if !follows(seat) {
                    desk.outbox.say(Topic::Robot(id), &[Command::Fade(fade)]);
                    drive.fades_at = now + AGAIN;
                    drive.fades_left = if leg.moves.len() <= FEW { TIMES } else { 1 };
                }
            } else {
                drive.colors_at = at + over / 2;
            }
        }
    }

    /// Says what is due.
    pub fn tick_lights(&mut self, desk: &mut Desk, now: Instant) {
        let Phase::Driving(drive) = &mut self.phase else { return };
        if now >= drive.fades_at {
            drive.fades_left = drive.fades_left.saturating_sub(1);
            drive.fades_at = if drive.fades_left > 0 { now + AGAIN } else { Instant::FAR };
            for seat in &mut self.seats {
                if let (Some(fade), false) = (seat.fade, seat.out) {
                    let topic = Topic::Robot(desk.fleet.robot(seat.robot).id);
                    desk.outbox.say(topic, &[Command::Fade(fade)]);
                }
            }
        }
        if now >= drive.colors_at {
            drive.colors_at = Instant::FAR;
            let Some(leg) = &self.current else { return };
            for (seat, step) in leg.moves.iter().enumerate() {
                let known = &self.seats[seat];
                let fades = desk.fleet.robot(known.robot).abilities.fade;
                if !known.out && !fades && leg.path(seat).is_some() && desk.relight(known.robot, step.color) {
                    let topic = Topic::Robot(desk.fleet.robot(known.robot).id);
                    desk.outbox.say(topic, &[Command::Color(step.color)]);
                }
            }
        }
    }

    /// A robot that was switched off and on shows its pixel again.
    pub fn relight_seat(&self, desk: &mut Desk, seat: usize) {
        let Some(step) = self.current.as_ref().and_then(|leg| leg.moves.get(seat)) else { return };
        let robot = self.seats[seat].robot;
        desk.relight(robot, step.color);
        let topic = Topic::Robot(desk.fleet.robot(robot).id);
        desk.outbox.say(topic, &[Command::Color(step.color)]);
    }
}
