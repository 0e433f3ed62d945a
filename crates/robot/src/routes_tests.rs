use super::in_sight::MAX_IN_SIGHT;
use super::*;
use lightbots_base::Piece;
use lightbots_wire::{Knot, Pieces};

fn route(seq: u32) -> Route {
    let piece = Piece::straight(Vec2::ZERO, Vec2::new(0.1, 0.0), Span(1_000_000));
    Route {
        seq,
        start: Vec2::ZERO,
        pieces: Pieces::from_slice(&[piece]).unwrap(),
        room_mm: None,
        neighbours: Default::default(),
    }
}

const BODY: BodyPose = BodyPose { at: Vec2::ZERO, facing: Vec2::new(1.0, 0.0) };

#[test]
fn a_start_may_be_moved_until_the_route_has_begun() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    routes.keep(&route(7), &mut storage);
    assert!(!routes.start(8, Instant(5), None));
    assert!(routes.start(7, Instant(1_000_000), Some(Instant(0))));
    assert!(!routes.start(7, Instant(1_000_000), Some(Instant(0))));
    assert!(routes.start(7, Instant(2_000_000), Some(Instant(0))));
    assert!(!routes.start(7, Instant(1_500_000), Some(Instant(0))), "overtaken by the one before");
    assert!(!routes.begin_due(Instant(1_999_999), &storage));
    assert!(routes.begin_due(Instant(2_000_000), &storage));
    assert!(!routes.start(7, Instant(3_000_000), Some(Instant(2_000_000))));
    assert_eq!(routes.starts(), Some(Instant(2_000_000)));
}

#[test]
fn a_start_long_past_is_refused() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    routes.keep(&route(7), &mut storage);
    assert!(!routes.start(7, Instant(0), Some(Instant(600_000))));
    assert_eq!(routes.starts(), None);
}

#[test]
fn a_moment_missed_without_a_clock_is_forgotten() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    routes.keep(&route(7), &mut storage);
    assert!(routes.start(7, Instant(0), None));
    assert!(!routes.begin_due(Instant(600_000), &storage));
    assert!(routes.keeps_one() && !routes.in_a_run());
}

#[test]
fn old_and_doubled_paths_change_nothing() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    routes.keep(&route(100), &mut storage);
    routes.start(100, Instant(5), Some(Instant(0)));
    routes.keep(&route(100), &mut storage);
    routes.keep(&route(99), &mut storage);
    assert_eq!((routes.named(), routes.starts()), (100, Some(Instant(5))));
    routes.keep(&route(3), &mut storage);
    assert_eq!((routes.named(), routes.starts()), (3, None));
    routes.keep(&route(4_000_000_000), &mut storage);
    assert_eq!(routes.named(), 4_000_000_000);
}

#[test]
fn the_next_route_is_kept_while_one_is_under_way_and_takes_over() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    routes.keep(&route(1), &mut storage);
    routes.start(1, Instant(0), Some(Instant(0)));
    routes.begin_due(Instant(0), &storage);
    routes.keep(&route(2), &mut storage);
    assert_eq!(routes.named(), 2);
    assert!(routes.step(Instant(500_000), BODY, Vec2::ZERO, &Limits::ELISA_3, &storage).is_some());
    assert!((routes.off_m().unwrap() - 0.05).abs() < 1e-9);
    assert_eq!(routes.finish(Instant(1_000_000), Vec2::new(0.05, 0.0)), None);
    assert_eq!(routes.finish(Instant(1_000_000), Vec2::new(0.09, 0.01)), None);
    assert_eq!(routes.finish(Instant(1_000_000), Vec2::new(0.09, 0.005)), Some(1));
    assert!(!routes.under_way() && routes.keeps_one());
}

#[test]
fn a_route_that_no_neighbour_comes_near_tells_so() {
    let tells = |room_mm, named: bool| {
        let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
        let mut one = Route { room_mm, ..route(1) };
        if named {
            one.neighbours.push(30, &[Knot { at_ms: 0, place_tenths: [700, 0], velocity_mmps: [0; 2] }]);
        }
        routes.keep(&one, &mut storage);
        routes.start(1, Instant(0), Some(Instant(0)));
        routes.begin_due(Instant(0), &storage);
        routes.tells_neighbours(0.03, &storage)
    };
    assert!(tells(Some(40), false) && tells(Some(3), true));
    assert!(!tells(Some(3), false) && !tells(Some(30), false) && !tells(None, false));
}

#[test]
fn neighbours_that_rested_beside_the_route_do_not_displace_the_near_one() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    let mut named = route(1);
    let knot = |x_tenths: i32| [Knot { at_ms: 0, place_tenths: [x_tenths, 700], velocity_mmps: [0; 2] }];
    for number in 0..30 {
        named.neighbours.push(100, &knot(-1_200 - 600 * number));
    }
    named.neighbours.push(120, &knot(200));
    routes.keep(&named, &mut storage);
    routes.start(1, Instant(0), Some(Instant(0)));
    routes.begin_due(Instant(0), &storage);
    let mut expected = InSight::new();
    routes.expect(BODY, 0.11, &storage, &mut expected);
    assert_eq!((expected.len(), expected[0].index), (1, 30));
}

#[test]
fn many_places_of_a_silent_robot_do_not_crowd_out_one_that_drives_or_the_nearest() {
    let (mut routes, mut storage) = (Routes::new(), RouteStorage::new());
    let mut named = route(1);
    let knot = |at_ms: u32, x: i32, y: i32, mmps: i16| Knot {
        at_ms,
        place_tenths: [x, y],
        velocity_mmps: [mmps, 0],
    };
    for number in 0..30 {
        named.neighbours.push(60, &[knot(0, 1_000 - 40 * number, 640, 0)]);
    }
    named.neighbours.push(140, &[knot(0, 700, 0, 100), knot(1_000, 1_700, 0, 100)]);
    routes.keep(&named, &mut storage);
    routes.start(1, Instant(0), Some(Instant(0)));
    routes.begin_due(Instant(0), &storage);
    let mut expected = InSight::new();
    routes.expect(BODY, 0.12, &storage, &mut expected);
    assert_eq!(expected.len(), MAX_IN_SIGHT);
    assert!(expected.iter().any(|one| one.index == 30), "it drives 70 mm ahead");
    assert!(
        (20..=29).all(|index| expected.iter().any(|one| one.index == index)),
        "the nearest of those that stand"
    );
}
