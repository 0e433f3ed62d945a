//! A driving robot falls silent: all hold, when that is safest.
//!
//! It may have died, or nobody hears it and it holds with the others, or its link broke and it drives on along its path
//! until it stops by itself. Who holds at once ahead of one that drives on is run into, who holds late may run into one
//! that died. Where its path and those of others tell, all hold at the moment that is safest whichever it is.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::event::Trouble;
use crate::holding::HOLD_WORTH;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::Route;

/// A robot that fell silent died at most this long after its last report.
pub(crate) const UNHEARD: Span = Span::from_millis(600);
/// One whose link broke after that drives on for so long at least, and so much longer at most.
pub(crate) const CUT: (Span, Span) = (Span::from_millis(1_500), Span::from_millis(1_000));
/// Everybody waits for a driving robot that was not heard for so long, link times on top.
const HUSH: Span = Span::from_millis(900);
/// Steps in which robots are followed, and in which moments to hold are tried.
const STEP: Span = Span::from_millis(50);
const TRY_STEP: Span = Span::from_millis(100);
/// More room between rims than this is as good as any, metres.
const AMPLE_M: f64 = 0.008;
/// A later moment must leave so much more room to be worth waiting for, metres.
const BETTER_M: f64 = 0.001;
/// Where so many are silent at once it is the network, and all hold as soon as they can.
const MANY: usize = 4;

/// Where somebody is by plan, from a path time on, at every step.
struct Track {
    from: Span,
    places: Vec<Vec2>,
}

impl Track {
    /// At a path time; before the first step and after the last as there.
    fn at(&self, time: Span) -> Vec2 {
        let steps = ((time - self.from).as_secs() / STEP.as_secs()).max(0.0);
        let last = self.places.len() - 1;
        let step = (steps as usize).min(last);
        self.places[step].lerp(self.places[(step + 1).min(last)], (steps - step as f64).min(1.0))
    }
}

/// Who is silent, and who may meet it.
struct Meeting<'a> {
    drive: &'a Drive,
    now: Instant,
    /// When it was heard last.
    heard: Instant,
    silent: Track,
    others: Vec<Track>,
    contact_m: f64,
}

impl Meeting<'_> {
    /// How far the silent one stays from the others at least if all hold at a moment, whatever became of it; rims,
    /// metres.
    fn room_m(&self, hold_at: Instant) -> f64 {
        let place = |since: Span| self.silent.at(self.drive.path_time(self.heard + since));
        let dead: Vec<Vec2> = (0..=UNHEARD.0 / STEP.0).map(|step| place(STEP * step)).collect();
        let steps = (self.last() - self.now).0 / STEP.0;
        let mut least_m = AMPLE_M;
        let mut places = dead.clone();
        for at in (0..=steps).map(|step| self.now + STEP * step) {
            // From the first moment on at which it may have stopped by itself, it may stand anywhere from there on.
            let since = (at - self.heard).min(CUT.0 + CUT.1);
            if since <= CUT.0 {
                places.truncate(dead.len());
            }
            places.push(place(since));
            for other in self.others.iter().map(|track| track.at(self.time_held(at, hold_at))) {
                let apart_m = places.iter().map(|place| place.distance(other)).fold(f64::MAX, f64::min);
                least_m = least_m.min(apart_m - self.contact_m);
            }
        }
        least_m
    }

    /// Path time of those who hold.
    fn time_held(&self, at: Instant, hold_at: Instant) -> Span {
        let before = self.drive.path_time(at.min(hold_at));
        let slowing = (at - hold_at).clamp(Span::ZERO, Route::EASE);
        let lost = slowing.as_secs() * slowing.as_secs() / (2.0 * Route::EASE.as_secs());
        before + slowing - Span::from_secs(lost)
    }

    /// When it stands for sure.
    fn last(&self) -> Instant {
        self.heard + CUT.0 + CUT.1
    }
}

impl Run {
    /// A driving robot was not heard for so long: whether everybody waits for it by now, or it is dropped.
    pub fn watch_silent(&mut self, desk: &mut Desk, now: Instant, seat: usize, silent: Span) -> bool {
        let Phase::Driving(drive) = self.phase else { return false };
        let silence = desk.config.silence + self.round_trip * 2;
        if silent > silence && self.all_stand(now, silent, &drive) {
            self.drop_out(desk, now, seat, Trouble::Silent);
            return true;
        }
        let held = drive.hold.is_some_and(|hold| hold.until.is_none());
        if held || silent <= HUSH + self.round_trip || self.seats[seat].late.is_some() {
            return false;
        }
        if self.had_better_hold(desk, now, seat, &drive) {
            self.mark_late(desk, now, seat, Trouble::Silent);
            return true;
        }
        false
    }

    /// Whether all stand who drive, or as good as: told to stop now they would not stop together with one that does not
    /// hear it.
    fn all_stand(&self, now: Instant, silent: Span, drive: &Drive) -> bool {
        let bound = CUT.0 + CUT.1 + Route::EASE + self.hold_lead() * 2;
        silent > bound
            || match drive.hold.filter(|hold| hold.until.is_none()) {
                Some(hold) => now >= hold.at + Route::EASE,
                None => now >= drive.ends,
            }
    }

    /// Whether no later moment to hold is safer than the next.
    fn had_better_hold(&self, desk: &Desk, now: Instant, seat: usize, drive: &Drive) -> bool {
        let Some(meeting) = self.meeting(desk, now, seat, drive) else { return true };
        let soonest = now + self.hold_lead();
        let room_m = meeting.room_m(soonest);
        let tries = (meeting.last() - soonest).0 / TRY_STEP.0;
        let later =
            (1..=tries).map(|step| soonest + TRY_STEP * step).filter(|at| *at + HOLD_WORTH < drive.ends);
        room_m >= AMPLE_M || later.map(|at| meeting.room_m(at)).fold(0.0, f64::max) < room_m + BETTER_M
    }

    /// Who may meet a silent robot before it stands for sure; `None`: nobody knows where it goes.
    fn meeting<'a>(&self, desk: &Desk, now: Instant, seat: usize, drive: &'a Drive) -> Option<Meeting<'a>> {
        let leg = self.current.as_ref()?;
        let heard = desk.fleet.robot(self.seats[seat].robot).heard.max(drive.began);
        let hush = HUSH + self.round_trip;
        let is_silent = |other: &usize| now - desk.fleet.robot(self.seats[*other].robot).heard > hush;
        let awaited = |other: &usize| self.is_awaited(*other) && !self.seats[*other].arrived;
        if (0..leg.moves.len()).filter(awaited).filter(is_silent).count() > MANY {
            return None;
        }
        let limits = &self.show.stage.limits;
        let last = heard + CUT.0 + CUT.1;
        let track = |path: &lightbots_plan::Path, since: Instant| {
            let from = drive.path_time(since).max(Span::ZERO);
            let steps = (drive.path_time(last) - from).max(Span::ZERO).0 / STEP.0 + 1;
            let places = (0..=steps).map(|step| path.as_ref().at(from + STEP * step).position).collect();
            Track { from, places }
        };
        let silent = track(leg.path(seat)?, heard);
        let far_m = limits.contact_m() + AMPLE_M;
        let reach_m = far_m + 2.0 * limits.speed_mps * (last - heard).as_secs();
        let here = silent.places[0];
        let others = (0..leg.moves.len()).filter(|&other| other != seat).filter_map(|other| {
            let Some(path) = leg.path(other) else {
                return Some(Track { from: Span::ZERO, places: vec![leg.moves[other].goal] });
            };
            let near = path.as_ref().at(drive.path_time(now)).position.distance(here) < reach_m;
            near.then(|| track(path, now))
        });
        let others = others.filter(|other| is_near(other, &silent, far_m)).collect();
        Some(Meeting { drive, now, heard, silent, others, contact_m: limits.contact_m() })
    }
}

/// Whether two tracks come anywhere nearer to each other than this, metres, by the rectangles around them.
fn is_near(one: &Track, other: &Track, far_m: f64) -> bool {
    let around = |track: &Track| {
        let (mut low, mut high) = (track.places[0], track.places[0]);
        for place in &track.places {
            low = Vec2::new(low.x.min(place.x), low.y.min(place.y));
            high = Vec2::new(high.x.max(place.x), high.y.max(place.y));
        }
        (low, high)
    };
    let ((low, high), (other_low, other_high)) = (around(one), around(other));
    low.x < other_high.x + far_m
        && other_low.x < high.x + far_m
        && low.y < other_high.y + far_m
        && other_low.y < high.y + far_m
}
