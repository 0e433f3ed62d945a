//! A leg in a journal. It holds enough to know where a robot may stand that does not report any more.

use crate::leg::{Leg, LegKind, RobotLeg, Task};
use lightbots_base::{Piece, Rgb, Span, Vec2};
use lightbots_plan::Path;
use lightbots_plan::unsynchronised::StraightDrive;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Longest duration of a piece or of a leg: a day. Longer values from a damaged file could overflow sums of times.
const PIECE_MAX: Span = Span::from_millis(86_400_000);

/// A leg as a journal holds it. Clearances, neighbours, the order of straight drives and the places around are left
/// out, because a robot's whereabouts do not depend on them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LegEntry {
    pub frame: u32,
    pub round: u32,
    pub pass: u32,
    /// Number of the routes of this leg.
    pub seq: u32,
    /// Whether robots drive routes; otherwise they drive by TARGET.
    pub is_routes: bool,
    pub reaches_frame: bool,
    pub duration: Span,
    /// What each robot does, by participant number.
    pub robots: Vec<RobotEntry>,
    /// Straight drives of TARGET-only robots: participant number, start and end; places in stage metres.
    pub drives: Vec<(u32, Vec2, Vec2)>,
}

/// One robot's part in a leg.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct RobotEntry {
    pub goal: Vec2,
    pub settles: bool,
    pub pixel: Option<u32>,
    pub color: Rgb,
    pub path: Option<PathEntry>,
}

/// A path in the stage. Its coordinates are in single precision, whose error is about a micrometre on a floor of some
/// metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PathEntry {
    start: [f32; 2],
    pieces: Vec<PieceEntry>,
}

/// A cubic Bézier piece of a path: its duration, and the points c1, c2 and end as x and y, stage metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct PieceEntry {
    duration: Span,
    points: [[f32; 2]; 3],
}

impl LegEntry {
    /// Returns what a journal holds of a leg.
    pub fn of(leg: &Leg) -> Self {
        let robot = |participant: usize, step: &RobotLeg| RobotEntry {
            goal: step.goal,
            settles: step.settles,
            pixel: step.pixel,
            color: step.color,
            path: leg.path(participant).map(PathEntry::of),
        };
        Self {
            frame: leg.frame as u32,
            round: leg.round,
            pass: leg.pass,
            seq: leg.seq,
            is_routes: leg.kind == LegKind::Routes,
            reaches_frame: leg.reaches_frame,
            duration: leg.duration,
            robots: leg.robots.iter().enumerate().map(|(one, step)| robot(one, step)).collect(),
            drives: leg.drives.iter().map(|drive| (drive.robot as u32, drive.from, drive.to)).collect(),
        }
    }

    /// Restores the leg of a run with this number of participants. `None` if the values are not plausible, so that no
    /// controller can have written them.
    pub fn to_leg(&self, participants: usize) -> Option<Leg> {
        if self.robots.len() > participants || self.duration < Span::ZERO || self.duration > PIECE_MAX {
            return None;
        }
        let drives: Vec<StraightDrive> = self
            .drives
            .iter()
            .map(|&(robot, from, to)| StraightDrive::new(robot as usize, from, to))
            .collect();
        let is_fit = |drive: &StraightDrive| {
            drive.robot < self.robots.len() && is_finite(drive.from) && is_finite(drive.to)
        };
        let drives_here = |participant: usize| drives.iter().any(|drive| drive.robot == participant);
        let robots: Option<Vec<RobotLeg>> =
            self.robots.iter().enumerate().map(|(one, entry)| entry.to_robot_leg(drives_here(one))).collect();
        let robots = robots.filter(|_| drives.iter().all(is_fit))?;
        Some(Leg {
            frame: self.frame as usize,
            round: self.round,
            pass: self.pass,
            seq: self.seq,
            kind: if self.is_routes { LegKind::Routes } else { LegKind::Targets },
            drivers: robots.iter().filter(|step| !matches!(step.task, Task::Stay)).count(),
            robots,
            drives,
            duration: self.duration,
            reaches_frame: self.reaches_frame,
            room_m: 0.0,
            around: Arc::default(),
        })
    }
}

impl RobotEntry {
    fn to_robot_leg(&self, drives: bool) -> Option<RobotLeg> {
        let task = match &self.path {
            Some(path) => Task::Path(path.to_path()?),
            None if drives => Task::Drives,
            None => Task::Stay,
        };
        let Self { goal, settles, pixel, color, .. } = *self;
        is_finite(goal).then_some(RobotLeg { task, settles, pixel, color, ..RobotLeg::stay(goal) })
    }
}

impl PathEntry {
    fn of(path: &Path) -> Self {
        let piece = |piece: &Piece| PieceEntry {
            duration: piece.duration,
            points: [piece.c1, piece.c2, piece.end].map(short),
        };
        Self { start: short(path.start), pieces: path.pieces.iter().map(piece).collect() }
    }

    fn to_path(&self) -> Option<Path> {
        let piece = |entry: &PieceEntry| {
            let [c1, c2, end] = entry.points.map(long);
            let is_fit = entry.duration > Span::ZERO && entry.duration <= PIECE_MAX;
            let is_fit = is_fit && [c1, c2, end].into_iter().all(is_finite);
            is_fit.then_some(Piece { duration: entry.duration, c1, c2, end })
        };
        let pieces: Option<Vec<Piece>> = self.pieces.iter().map(piece).collect();
        let (start, pieces) = (long(self.start), pieces?);
        (is_finite(start) && !pieces.is_empty()).then_some(Path { start, pieces })
    }
}

fn short(at: Vec2) -> [f32; 2] {
    [at.x as f32, at.y as f32]
}

fn long([x, y]: [f32; 2]) -> Vec2 {
    Vec2::new(x.into(), y.into())
}

fn is_finite(at: Vec2) -> bool {
    at.x.is_finite() && at.y.is_finite()
}
