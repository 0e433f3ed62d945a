//! Routes for the exam, and how well reports of a robot match them.

use lightbots_base::{Instant, PathRef, Piece, Span, Vec2};
use lightbots_wire::{Command, Pieces, Route, encode};

use crate::received::Received;

/// Duration of the rest at the beginning of a route. An Elisa-3 at 4.5 rad/s turns by 180° within it
/// (docs/simulator.md).
pub(super) const REST: Span = Span::from_millis(700);
/// Acceleration of the routes: half the limit of the Elisa-3 (docs/simulator.md), so that other robots can follow as
/// well.
const RAMP_MPS2: f64 = 0.5;
/// Time between the samples of a path with which reports are compared: 2 mm at the cruising speed of the routes.
const SAMPLE: Span = Span::from_millis(10);

/// A route with its start moment and, if it is held, the hold.
pub(super) struct TimedRoute {
    pub route: Route,
    /// Start moment, on the show clock.
    pub starts: Instant,
    /// Moments of `HOLD` and `RESUME`, on the show clock; `None`: no hold.
    pub hold: Option<(Instant, Instant)>,
}

/// How well reports match a timed route.
pub(super) struct Fit {
    /// Largest distance of a reported place from the path, metres.
    pub beside_m: f64,
    /// Median delay along the path, seconds; negative: early. `None`: no report from where the path is fast.
    pub late_s: Option<f64>,
    /// Number of reports with a place while the route was under way.
    pub reports: usize,
}

/// A straight route that begins with a rest. It accelerates at its beginning and brakes at its end.
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

/// A route on a curve to the left of the straight line from `start` to `end`. It begins with a rest; then the curve
/// takes the time `over`.
pub(super) fn curve(seq: u32, start: Vec2, end: Vec2, over: Span) -> Route {
    let way = end - start;
    let aside = way.left() * 0.33;
    let top = start.lerp(end, 0.5) + aside;
    let half = Span(over.0 / 2);
    // Faster than the mean, so that the curve stays away from the straight line.
    let top_velocity = way * (1.2 / half.as_secs());
    let pieces = [
        Piece::rest(start, REST),
        Piece::hermite(start, Vec2::ZERO, top, top_velocity, half),
        Piece::hermite(top, top_velocity, end, Vec2::ZERO, half),
    ];
    route(seq, start, &pieces)
}

/// A route that rests at the place `at` for the time `over`.
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

/// The command `|PATH ...|` of a route.
pub(super) fn text(route: &Route) -> String {
    let mut text = String::new();
    // Writing into a string cannot fail.
    let _ = encode(&Command::Route(route.clone()), &mut text);
    text
}

impl TimedRoute {
    /// A route that begins at `starts`, without holds.
    pub fn new(route: Route, starts: Instant) -> Self {
        Self { route, starts, hold: None }
    }

    pub fn path(&self) -> PathRef<'_> {
        PathRef::new(self.route.start, &self.route.pieces)
    }

    /// Moment at which the route is over, on the show clock.
    pub fn over(&self) -> Instant {
        let held = self.hold.map_or(Span::ZERO, |(hold, resume)| resume - hold);
        self.starts + self.path().duration() + held
    }

    /// Path time, seconds, at the moment `show` of the show clock (R35, R38).
    fn path_time_s(&self, show: Instant) -> f64 {
        let free = (show - self.starts).as_secs();
        let Some((hold, resume)) = self.hold else { return free };
        let ease = Route::EASE.as_secs();
        // Integrals of a rate that falls from 1 to 0 within the ease, and of a rate that rises from 0 to 1.
        let falling =
            |since: f64| if since < ease { since - since * since / (2.0 * ease) } else { ease / 2.0 };
        let rising =
            |since: f64| if since < ease { since * since / (2.0 * ease) } else { since - ease / 2.0 };
        let until = (hold - self.starts).as_secs();
        let held = (show - hold).as_secs().max(0.0);
        let resumed = (show - resume).as_secs().max(0.0);
        free.min(until) + falling(held) + rising(resumed)
    }

    /// Compares reports with the route. `shift`: show clock minus exam's clock. `delay`: age of a report when it
    /// arrives.
    pub fn fit(&self, received: &[Received], shift: Span, delay: Span) -> Fit {
        let mut fit = Fit { beside_m: 0.0, late_s: None, reports: 0 };
        let mut late = Vec::new();
        let samples = self.samples();
        for received in received {
            let show = received.at + shift + Span(-delay.0);
            let (Some(at), true) = (received.place(), (self.starts..=self.over()).contains(&show)) else {
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

    /// Samples of the path: path time in seconds, place, and whether the speed there is above 90 % of the path's
    /// highest speed.
    fn samples(&self) -> Vec<(f64, Vec2, bool)> {
        let path = self.path();
        let count = path.duration().0 / SAMPLE.0;
        let motions: Vec<_> = (0..=count).map(|step| (SAMPLE * step, path.at(SAMPLE * step))).collect();
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
        let timed_route = TimedRoute { route, starts: Instant(1_000_000), hold };
        for (show, path_time_s) in
            [(2_000_000, 1.0), (2_150_000, 1.1125), (2_300_000, 1.15), (4_000_000, 1.15), (5_000_000, 2.0)]
        {
            assert!((timed_route.path_time_s(Instant(show)) - path_time_s).abs() < 1e-9, "{show}");
        }
    }

    #[test]
    fn a_robot_that_is_late_by_a_tenth_of_a_second_is_measured() {
        let timed_route = TimedRoute::new(straight(1, Vec2::ZERO, Vec2::new(0.3, 0.0), 0.2), Instant(0));
        let received: Vec<Received> = (0..20)
            .filter_map(|tenth| {
                let at = Instant(tenth * 100_000);
                let then = Instant((tenth * 100_000).saturating_sub(100_000));
                let place = timed_route.path().at(then - Instant(0)).position;
                let text = format!("r1 {:?} {:?} state=driving", place.x, place.y);
                Received::new(at, "T/LightBot/Status", text.as_bytes())
            })
            .collect();
        let fit = timed_route.fit(&received, Span::ZERO, Span::ZERO);
        assert!((fit.late_s.unwrap() - 0.1).abs() < 0.011, "{:?}", fit.late_s);
        assert!(fit.beside_m < 0.002 && fit.reports == 20);
    }
}
