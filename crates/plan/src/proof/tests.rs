use super::*;
use crate::seeded::Seeded;
use lightbots_base::{Limits, Piece, Vec2};
use lightbots_show::Obstacle;

pub(super) const LIMITS: Limits = Limits::ELISA_3;
/// Rest before a drive, in which a robot turns, microseconds: 0.35 s, enough for a quarter turn at 4.5 rad/s.
pub(super) const REST: Span = Span(350_000);

pub(super) fn input<'a>(
    paths: &'a [Path],
    standing: &'a [Vec2],
    obstacles: &'a [Obstacle],
) -> ProofInput<'a> {
    ProofInput {
        paths,
        standing,
        obstacles,
        half_floor: Vec2::new(1.5, 1.5),
        limits: &LIMITS,
        gap_m: 0.057,
        obstacle_gap_m: 0.003,
    }
}

/// A rest, then one smooth cubic from rest to rest.
pub(super) fn smooth(from: Vec2, to: Vec2, seconds: f64) -> Path {
    let drive = Piece { duration: Span::from_secs(seconds), c1: from, c2: to, end: to };
    Path { start: from, pieces: vec![Piece::rest(from, REST), drive] }
}

pub(super) fn kinds(path: Path) -> Vec<FaultKind> {
    prove(&input(&[path], &[], &[])).faults.iter().map(|fault| fault.kind).collect()
}

#[test]
fn two_that_swap_places_meet_in_the_middle() {
    let (a, b) = (Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0));
    let proof = prove(&input(&[smooth(a, b, 6.0), smooth(b, a, 6.0)], &[], &[]));
    let [conflict] = proof.conflicts[..] else { panic!("{proof:?}") };
    assert!(conflict.distance_m < 1e-6 && conflict.pair == (0, 1));
    assert!((conflict.at.as_secs() - 3.35).abs() < 1e-3, "{:?}", conflict.at);
    assert!(conflict.place.length() < 1e-6);
    assert_eq!(proof.closest, Some(conflict));
    assert!(proof.faults.is_empty());
}

#[test]
fn passing_by_is_measured_exactly() {
    let paths = [
        smooth(Vec2::new(-0.5, 0.03), Vec2::new(0.5, 0.03), 6.0),
        smooth(Vec2::new(0.5, -0.03), Vec2::new(-0.5, -0.03), 6.0),
    ];
    let proof = prove(&input(&paths, &[Vec2::new(0.0, 0.5)], &[]));
    assert!(proof.holds());
    assert!((proof.closest.unwrap().distance_m - 0.06).abs() < 1e-6);
}

#[test]
fn robots_that_begin_too_close_must_only_not_come_closer() {
    let from = [Vec2::ZERO, Vec2::new(0.05, 0.0)];
    let apart = [smooth(from[0], Vec2::new(-0.3, 0.0), 3.0), smooth(from[1], Vec2::new(0.35, 0.0), 3.0)];
    assert!(prove(&input(&apart, &[], &[])).holds());
    let across = [smooth(from[0], Vec2::new(0.3, 0.0), 3.0), smooth(from[1], Vec2::new(-0.25, 0.0), 3.0)];
    assert_eq!(prove(&input(&across, &[], &[])).conflicts.len(), 1);
}

#[test]
fn the_swept_grid_finds_what_all_pairs_find() {
    let mut seeded = Seeded::new(11);
    for _ in 0..60 {
        let count = 2 + seeded.below(30);
        let mut place = || Vec2::new(seeded.between(-1.4, 1.4), seeded.between(-1.4, 1.4));
        let paths: Vec<Path> = (0..count)
            .map(|_| {
                let (from, to, a, b) = (place(), place(), place(), place());
                let bent = Piece { duration: Span::from_secs(9.0), c1: a, c2: b, end: to };
                Path { start: from, pieces: vec![Piece::rest(from, REST), bent] }
            })
            .collect();
        let proof = prove(&input(&paths, &[], &[]));
        let (mut least, mut pairs) = (f64::INFINITY, Vec::new());
        for i in 0..count {
            for j in i + 1..count {
                let only = [paths[i].clone(), paths[j].clone()];
                let pair = prove(&input(&only, &[], &[]));
                least = least.min(pair.closest.unwrap().distance_m);
                pairs.extend(pair.conflicts.iter().map(|_| (i, j)));
            }
        }
        assert!((proof.closest.unwrap().distance_m - least).abs() < 1e-6);
        assert_eq!(proof.conflicts.iter().map(|found| found.pair).collect::<Vec<_>>(), pairs);
    }
}

#[test]
fn a_legal_drive_has_no_fault() {
    assert_eq!(kinds(smooth(Vec2::ZERO, Vec2::new(0.5, 0.2), 3.5)), []);
    assert_eq!(kinds(Path { start: Vec2::ZERO, pieces: vec![Piece::rest(Vec2::ZERO, REST)] }), []);
}

#[test]
fn what_a_robot_cannot_do_is_named() {
    let far = Vec2::new(1.0, 0.0);
    assert_eq!(kinds(smooth(Vec2::ZERO, far, 5.0)), [FaultKind::Speed]);
    assert!(kinds(smooth(Vec2::ZERO, Vec2::new(0.02, 0.0), 0.2)).contains(&FaultKind::Acceleration));
    let straight = Path {
        start: Vec2::ZERO,
        pieces: vec![Piece::rest(Vec2::ZERO, REST), Piece::straight(Vec2::ZERO, far, Span(9_000_000))],
    };
    assert_eq!(kinds(straight), [FaultKind::Jump]);
    let mut hasty = smooth(Vec2::ZERO, far, 9.0);
    hasty.pieces.remove(0);
    assert_eq!(kinds(hasty), [FaultKind::Turn]);
    assert_eq!(kinds(smooth(Vec2::ZERO, Vec2::new(1.48, 0.0), 9.0)), []);
    let out = Piece { duration: Span(20_000_000), c1: Vec2::ZERO, c2: Vec2::new(4.0, 0.0), end: Vec2::ZERO };
    let out = Path { start: Vec2::ZERO, pieces: vec![Piece::rest(Vec2::ZERO, REST), out] };
    assert!(kinds(out).contains(&FaultKind::Floor));
    let broken = Path { start: Vec2::new(f64::NAN, 0.0), pieces: Vec::new() };
    assert_eq!(kinds(broken), [FaultKind::Malformed]);
}

#[test]
fn a_corner_takes_the_time_to_turn() {
    let (a, b, c) = (Vec2::ZERO, Vec2::new(0.3, 0.0), Vec2::new(0.3, 0.3));
    let corner = |rest_ms: i64| {
        let drive = |from: Vec2, to: Vec2| Piece { duration: Span(2_000_000), c1: from, c2: to, end: to };
        let mut pieces = vec![Piece::rest(a, REST), drive(a, b), drive(b, c)];
        if rest_ms > 0 {
            pieces.insert(2, Piece::rest(b, Span::from_millis(rest_ms)));
        }
        kinds(Path { start: a, pieces })
    };
    assert_eq!(corner(350), []);
    assert_eq!(corner(100), [FaultKind::Turn]);
    assert_eq!(corner(0), [FaultKind::Turn]);
    // Straight back needs no turn at all.
    let back = Piece { duration: Span(2_000_000), c1: b, c2: a, end: a };
    let forth = Piece { duration: Span(2_000_000), c1: a, c2: b, end: b };
    assert_eq!(kinds(Path { start: a, pieces: vec![Piece::rest(a, REST), forth, back] }), []);
}

#[test]
fn obstacles_are_kept_clear_of() {
    let path = [smooth(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), 12.0)];
    let judged = |thing: Obstacle| prove(&input(&path, &[], &[thing])).holds();
    // The radius of 27 mm and 3 mm between the rims.
    assert!(judged(Obstacle::Disc { at: Vec2::new(0.0, 0.231), radius_m: 0.2 }));
    assert!(!judged(Obstacle::Disc { at: Vec2::new(0.0, 0.229), radius_m: 0.2 }));
    assert!(judged(Obstacle::Rect { min: Vec2::new(-0.2, 0.0301), max: Vec2::new(0.3, 0.5) }));
    assert!(!judged(Obstacle::Rect { min: Vec2::new(-0.2, 0.0299), max: Vec2::new(0.3, 0.5) }));
}

#[test]
fn a_standing_disc_in_the_way_is_a_conflict() {
    let path = [smooth(Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0), 12.0)];
    let proof = prove(&input(&path, &[Vec2::new(0.5, 1.0), Vec2::new(0.2, 0.05)], &[]));
    assert_eq!(proof.conflicts[0].pair, (0, 2));
    assert!((proof.closest.unwrap().distance_m - 0.05).abs() < 1e-6);
}
