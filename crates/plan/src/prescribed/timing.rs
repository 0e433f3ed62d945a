//! Timing of ways (the paths of robots in a prescribed drive): finds the least duration within the limits of all
//! robots, and makes timed paths.

use lightbots_base::{Limits, Piece, Span, Vec2};
use lightbots_show::Easing;

use super::way::{PrescribedWay, WayPart};
use crate::Path;
use crate::motion::progress::ProgressLaw;
use crate::motion::{quarter_turn, whole_millis};

/// Most corrections of the duration. Each correction multiplies the duration by the factor that [`worst`] estimates.
const MOST_TRIES: usize = 24;
/// Share of the limits that timing uses; the rest is for the rounding of durations to whole milliseconds.
const SHARE: f64 = 0.995;
/// Length below which a part of a way counts as a rest, metres.
const STILL_M: f64 = 1e-6;
/// Speed below which the turn rate of a path is not limited, m/s. It must be less than the proof's `CREEP_MPS`.
const SLOW_MPS: f64 = 0.01;

/// Timed paths of one drive. Paths from ways with parts begin with a rest in which robots turn, and last equally long.
/// Paths that the show has timed stay unchanged.
pub(super) struct TimedDrive {
    /// `paths[goal]`: the path of the robot to that goal.
    pub paths: Vec<Path>,
    /// Least duration within the limits of all ways with parts, including the first rest; 0 if none of them moves a
    /// robot.
    pub least: Span,
}

/// Times all ways: as fast as the limits allow, or in the duration `asked` if that is longer.
pub(super) fn timed(
    ways: &[PrescribedWay],
    limits: &Limits,
    easing: Easing,
    asked: Option<Span>,
) -> TimedDrive {
    let rest = quarter_turn(limits);
    let ways: Vec<MovingWay<'_>> = ways.iter().map(MovingWay::new).collect();
    let mut drive = first_guess(&ways, limits);
    for _ in 0..MOST_TRIES {
        let excess = worst(&ways, limits, easing, drive);
        if excess <= 1.0 {
            break;
        }
        drive = whole_millis(drive.as_secs() * excess.max(1.000_5));
    }
    let least = if drive > Span::ZERO { rest + drive } else { Span::ZERO };
    let whole = asked.unwrap_or(least).max(least);
    let paths = ways.iter().map(|way| path(way, limits, easing, whole - rest, whole)).collect();
    TimedDrive { paths, least }
}

/// A way, and those of its parts that are at least [`STILL_M`] long. The lengths of parts are computed only once,
/// because they are sums over many places.
struct MovingWay<'a> {
    way: &'a PrescribedWay,
    /// Parts with their lengths, metres.
    parts: Vec<(&'a WayPart, f64)>,
}

impl<'a> MovingWay<'a> {
    fn new(way: &'a PrescribedWay) -> Self {
        let parts = match way {
            PrescribedWay::Parts(parts) => &parts[..],
            PrescribedWay::Timed(_) => &[],
        };
        let lengths = parts.iter().map(|part| (part, part.shape.length_m()));
        Self { way, parts: lengths.filter(|(_, length_m)| *length_m >= STILL_M).collect() }
    }
}

/// Returns a lower bound on the duration of the drive, without its first rest.
fn first_guess(ways: &[MovingWay<'_>], limits: &Limits) -> Span {
    let speed = limits.speed_mps.max(1e-3);
    let seconds = ways.iter().flat_map(|way| &way.parts).map(|(part, length_m)| {
        let (from, to) = part.during;
        length_m / speed / (to - from).max(1e-6)
    });
    whole_millis(seconds.fold(0.0, f64::max))
}

/// Estimates the factor by which the duration `drive` must be multiplied so that all limits hold; at most 1 if they
/// hold.
fn worst(ways: &[MovingWay<'_>], limits: &Limits, easing: Easing, drive: Span) -> f64 {
    let one = |way: &MovingWay<'_>| {
        let path = path(way, limits, easing, drive, quarter_turn(limits) + drive);
        let pieces = path.as_ref().timed().map(|(from, _, piece)| excess(from, piece, limits));
        pieces.fold(0.0, f64::max)
    };
    ways.iter().map(one).fold(0.0, f64::max) / SHARE
}

/// Returns the factor by which a piece would have to last longer to keep all limits, sampled at nine moments. It is at
/// most 1 if the piece keeps them. `from`: place where the piece begins.
fn excess(from: Vec2, piece: &Piece, limits: &Limits) -> f64 {
    if piece.is_rest(from) {
        return 0.0;
    }
    let wheel_mps = limits.wheel_radps * limits.wheel_radius_m;
    let at = |step: i64| {
        let motion = piece.at(from, Span(piece.duration.0 * step / 8));
        let speed = motion.velocity.length();
        let turn = motion.velocity.cross(motion.acceleration).abs() / (speed * speed).max(1e-9);
        let turn = if speed < SLOW_MPS { 0.0 } else { turn };
        let accel = (motion.acceleration.length() / limits.accel_mps2).sqrt();
        let wheel = (speed + turn * limits.track_m / 2.0) / wheel_mps;
        (speed / limits.speed_mps).max(accel).max(turn / limits.turn_radps).max(wheel)
    };
    (0..=8).map(at).fold(0.0, f64::max)
}

/// Makes the timed path of a way that lasts `whole`: a rest in which the robot turns, then a drive that lasts `drive`.
/// A way that is timed already is returned unchanged.
fn path(moving: &MovingWay<'_>, limits: &Limits, easing: Easing, drive: Span, whole: Span) -> Path {
    if let PrescribedWay::Timed(path) = moving.way {
        return path.clone();
    }
    let start = moving.way.start().unwrap_or(Vec2::ZERO);
    let mut path = Path { start, pieces: Vec::new() };
    let mut now = Span::ZERO;
    let before = whole - drive;
    let moment = |share: f64| before + Span::from_millis((drive.as_secs() * 1e3 * share).round() as i64);
    for (part, _) in &moving.parts {
        let (from, to) = (moment(part.during.0), moment(part.during.1));
        if to <= from {
            continue;
        }
        if from > now {
            path.pieces.push(Piece::rest(path.as_ref().end(), from - now));
        }
        add_part(&mut path, part, to - from, limits, easing);
        now = to;
    }
    if whole > now {
        path.pieces.push(Piece::rest(path.as_ref().end(), whole - now));
    }
    path
}

/// Adds to `path` the pieces of a part that lasts `lasts`, from rest to rest.
fn add_part(path: &mut Path, part: &WayPart, lasts: Span, limits: &Limits, easing: Easing) {
    let law = ProgressLaw::lasting(lasts.as_secs(), limits, easing);
    let moments = moments(&law, part.shape.pieces());
    let knot = |seconds: f64| {
        let share = law.share(seconds);
        (part.shape.at(share), part.shape.slope(share) * law.rate(seconds))
    };
    let mut before = Span::ZERO;
    let (mut at, mut velocity) = (path.as_ref().end(), Vec2::ZERO);
    for (index, &moment) in moments.iter().enumerate() {
        let is_last = index + 1 == moments.len();
        let moment = if is_last { lasts } else { moment };
        let (to, speed) = if is_last { (part.shape.at(1.0), Vec2::ZERO) } else { knot(moment.as_secs()) };
        path.pieces.push(Piece::hermite(at, velocity, to, speed, moment - before));
        (before, at, velocity) = (moment, to, speed);
    }
}

/// Returns the moments at which pieces of a part end, counted from the beginning of the part. These are the ends of
/// both ramps of speed, and further moments within and between the ramps, as many as the shape needs. They are
/// increasing whole milliseconds.
fn moments(law: &ProgressLaw, pieces: usize) -> Vec<Span> {
    let (ramp_s, drive_s) = (law.ramp_s(), law.drive_s);
    let ramp_pieces = ((pieces as f64 * law.share(ramp_s)).ceil() as usize).max(1);
    let cruise_pieces = pieces.saturating_sub(2 * ramp_pieces).max(1);
    let mut ends = Vec::new();
    let mut stretch = |from_s: f64, to_s: f64, count: usize| {
        ends.extend((1..=count).map(|nth| from_s + (to_s - from_s) * nth as f64 / count as f64));
    };
    stretch(0.0, ramp_s, ramp_pieces);
    if drive_s - 2.0 * ramp_s > 1e-3 {
        stretch(ramp_s, drive_s - ramp_s, cruise_pieces);
    }
    stretch(drive_s - ramp_s, drive_s, ramp_pieces);
    let mut moments: Vec<Span> =
        ends.into_iter().map(|seconds| Span::from_millis((seconds * 1e3).round() as i64)).collect();
    moments.dedup();
    moments.retain(|moment| *moment > Span::ZERO);
    moments
}
