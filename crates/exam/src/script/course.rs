//! Routes to try a robot with, and how well it keeps to them.

use lightbots_base::{Instant, PathRef, Piece, Span, Vec2};
use lightbots_wire::{Command, Pieces, Route, encode};

use crate::heard::Heard;

/// Rest before a route moves: a quarter turn and more.
pub(super) const REST: Span = Span::from_millis(700);
const RAMP_MPS2: f64 = 0.5;
/// Where on a path a robot is, is looked for at so many places a second.
const FINE: Span = Span::from_millis(10);

/// A route with its number and its moment.
pub(super) struct Course {
    pub route: Route,
    pub starts: Instant,
    /// Hold and resume, show clock.
    pub hold: Option<(Instant, Instant)>,
}

/// How a robot kept to a course.
pub(super) struct Fit {
    /// The furthest it was beside its path, metres.
    pub beside_m: f64,
    /// How much later than the path it was in the middle, seconds; `None`: nothing to go by.
    pub late_s: Option<f64>,
    /// How many reports there were.
    pub reports: usize,
}

/// Straight with ramps, after a rest.
pub(super) fn straight(seq: u32, start: Vec2, end: Vec2, speed_mps: f64) -> Route {
    let way = end - start;
    let direction = way.normalized().unwrap_or_default();
    let ramp_s = speed_mps / RAMP_MPS2;
    let ramp_way = direction * (0.5 * speed_mps * ramp_s);
    let cruise_s = (way.length() / speed_mps - ramp_s).max(0.1);
    let (from, to, velocity) = (start + ramp_way, end - ramp_way, direction * speed_mps);
    let pieces = [
        Piece::rest(start, REST),
        Piece::hermite(start, Vec2::ZERO, from, velocity, Span::from_secs(ramp_s)),
        Piece::straight(from, to, Span::from_secs(cruise_s)),
        Piece::hermite(to, velocity, end, Vec2::ZERO, Span::from_secs(ramp_s)),
    ];
    route(seq, start, &pieces)
}

/// A bow to the left of the straight way, slow at both ends.
pub(super) fn bow(seq: u32, start: Vec2, end: Vec2, over: Span) -> Route {
    let way = end - start;
    let aside = way.left() * 0.33;
    let top = start.lerp(end, 0.5) + aside;
    let half = Span(over.0 / 2);
    // Faster than the mean, so that the bow bulges and no straight line is near to it.
    let top_velocity = way * (1.2 / half.as_secs());
    let pieces = [
        Piece::rest(start, REST),
        Piece::hermite(start, Vec2::ZERO, top, top_velocity, half),
        Piece::hermite(top, top_velocity, end, Vec2::ZERO, half),
    ];
    route(seq, start, &pieces)
}

/// Standing for a while.
pub(super) fn rest(seq: u32, at: Vec2, over: Span) -> Route {
    route(seq, at, &[Piece::rest(at, over)])
}

fn route(seq: u32, start: Vec2, pieces: &[Piece]) -> Route {
    Route {
        seq,
        start,
        pieces: Pieces::from_slice(pieces).unwrap_or_default(),
        room_mm: None,
        neighbours: Default::default(),
    }
}

/// `|PATH …|`.
pub(super) fn text(route: &Route) -> String {
    let mut text = String::new();
    // A string takes everything.
    let _ = encode(&Command::Route(route.clone()), &mut text);
    text
}

impl Course {
    /// A course without holds.
    pub fn new(route: Route, starts: Instant) -> Self {
        Self { route, starts, hold: None }
    }

    pub fn path(&self) -> PathRef<'_> {
        PathRef::new(self.route.start, &self.route.pieces)
    }

    /// When it is over, show clock.
    pub fn over(&self) -> Instant {
        let held = self.hold.map_or(Span::ZERO, |(hold, resume)| resume - hold);
        self.starts + self.path().duration() + held
    }

    /// Path time at a moment of the show clock: R35 and R38.
    fn path_time_s(&self, show: Instant) -> f64 {
        let free = (show - self.starts).as_secs();
        let Some((hold, resume)) = self.hold else { return free };
        let ease = Route::EASE.as_secs();
        // Way of a rate that falls from 1 to 0 within the ease, and of one that rises.
        let falling =
            |since: f64| if since < ease { since - since * since / (2.0 * ease) } else { ease / 2.0 };
        let rising =
            |since: f64| if since < ease { since * since / (2.0 * ease) } else { since - ease / 2.0 };
        let until = (hold - self.starts).as_secs();
        let held = (show - hold).as_secs().max(0.0);
        let resumed = (show - resume).as_secs().max(0.0);
        free.min(until) + falling(held) + rising(resumed)
    }

    /// How the reports fit. `shift` is the show clock less the exam's; `delay` is how old a report is when it comes.
    pub fn fit(&self, heard: &[Heard], shift: Span, delay: Span) -> Fit {
        let mut fit = Fit { beside_m: 0.0, late_s: None, reports: 0 };
        let mut late = Vec::new();
        let samples = self.samples();
        for heard in heard {
            let show = heard.at + shift + Span(-delay.0);
            let (Some(at), true) = (heard.place(), (self.starts..=self.over()).contains(&show)) else {
                continue;
            };
            let Some(nearest) = samples.iter().min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)))
            else {
                continue;
            };
            fit.reports += 1;
            fit.beside_m = fit.beside_m.max(nearest.1.distance(at));
            if nearest.2 {
                late.push(self.path_time_s(show) - nearest.0);
            }
        }
        late.sort_by(f64::total_cmp);
        fit.late_s = late.get(late.len() / 2).copied();
        fit
    }

    /// Path time in seconds, place, and whether it is fast there: all along the path.
    fn samples(&self) -> Vec<(f64, Vec2, bool)> {
        let path = self.path();
        let count = path.duration().0 / FINE.0;
        let motions: Vec<_> = (0..=count).map(|step| (FINE * step, path.at(FINE * step))).collect();
        let top = motions.iter().map(|(_, motion)| motion.velocity.length()).fold(0.0, f64::max);
        motions
            .into_iter()
            .map(|(time, motion)| (time.as_secs(), motion.position, motion.velocity.length() > 0.9 * top))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_time_is_that_of_the_documents_worked_hold() {
        let route = straight(1, Vec2::ZERO, Vec2::new(0.3, 0.0), 0.2);
        let hold = Some((Instant(2_000_000), Instant(4_000_000)));
        let course = Course { route, starts: Instant(1_000_000), hold };
        for (show, path_time_s) in
            [(2_000_000, 1.0), (2_150_000, 1.1125), (2_300_000, 1.15), (4_000_000, 1.15), (5_000_000, 2.0)]
        {
            assert!((course.path_time_s(Instant(show)) - path_time_s).abs() < 1e-9, "{show}");
        }
    }

    #[test]
    fn a_robot_that_is_late_by_a_tenth_of_a_second_is_measured() {
        let course = Course::new(straight(1, Vec2::ZERO, Vec2::new(0.3, 0.0), 0.2), Instant(0));
        let heard: Vec<Heard> = (0..20)
            .filter_map(|tenth| {
                let at = Instant(tenth * 100_000);
                let then = Instant((tenth * 100_000).saturating_sub(100_000));
                let place = course.path().at(then - Instant(0)).position;
                let text = format!("r1 {:?} {:?} state=driving", place.x, place.y);
                Heard::new(at, "T/LightBot/Status", text.as_bytes())
            })
            .collect();
        let fit = course.fit(&heard, Span::ZERO, Span::ZERO);
        assert!((fit.late_s.unwrap() - 0.1).abs() < 0.011, "{:?}", fit.late_s);
        assert!(fit.beside_m < 0.002 && fit.reports == 20);
    }
}
