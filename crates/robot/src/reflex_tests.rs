use super::*;

const DT: f64 = 0.016;
const SPEED_MPS: f64 = 0.27;
const LIMITS: Limits = Limits::ELISA_3;

/// A robot that drives along x and one beside its way, both with discs of 27 mm.
struct Pair {
    reflex: Reflex,
    x: f64,
    /// What the wheels do in the step to come, and what they were told for the one after it.
    speed_mps: f64,
    told_mps: f64,
    other: (f64, f64),
    other_mps: f64,
    room_mm: Option<u16>,
}

impl Pair {
    /// The other's centre is so far ahead and aside, metres.
    fn new(ahead_m: f64, aside_m: f64, other_mps: f64) -> Self {
        Self {
            reflex: Reflex::new(),
            x: 0.0,
            speed_mps: SPEED_MPS,
            told_mps: SPEED_MPS,
            other: (ahead_m, aside_m),
            other_mps,
            room_mm: None,
        }
    }

    fn gap_m(&self) -> f64 {
        libm::hypot(self.other.0 - self.x, self.other.1) - LIMITS.contact_m()
    }

    /// What the sensors on the rim say.
    fn readings(&self) -> [f32; SENSORS] {
        core::array::from_fn(|sensor| {
            let angle = sensor as f64 * core::f64::consts::FRAC_PI_4;
            let (dx, dy) = (libm::cos(angle), libm::sin(angle));
            let (x, y) = (self.other.0 - self.x - 0.027 * dx, self.other.1 - 0.027 * dy);
            let far = libm::hypot(x, y);
            if x * dx + y * dy > 0.64 * far { (far - 0.027) as f32 } else { f32::INFINITY }
        })
    }

    fn step(&mut self) {
        self.x += self.speed_mps * DT;
        self.other.0 += self.other_mps * DT;
        self.reflex.look(Some(&self.readings()), self.speed_mps * DT, DT);
        let wish = Wish { speed_mps: SPEED_MPS, told_mps: self.told_mps, room_mm: self.room_mm };
        let most_mps = self.reflex.limit(wish, &LIMITS).unwrap_or(SPEED_MPS);
        // Tyres take two steps for the whole of it.
        self.speed_mps = self.told_mps.max(self.speed_mps - 0.188);
        self.told_mps = most_mps.min(self.told_mps + 0.02).min(SPEED_MPS);
    }

    /// The least gap over a second.
    fn least_gap_m(&mut self) -> f64 {
        let mut least = self.gap_m();
        for _ in 0..62 {
            self.step();
            least = least.min(self.gap_m());
        }
        least
    }
}

#[test]
fn it_stops_before_what_stands_ahead() {
    for aside_mm in [0, 4, 8, 12] {
        for start_mm in 0..5 {
            let mut pair = Pair::new(0.15 + f64::from(start_mm) * 0.001, f64::from(aside_mm) * 1e-3, 0.0);
            let least_m = pair.least_gap_m();
            assert!(least_m > 0.0005, "{aside_mm} mm aside: {:.1} mm", least_m * 1e3);
            assert!(pair.reflex.block().is_some() && pair.told_mps == 0.0, "{aside_mm} mm aside");
        }
    }
}

#[test]
fn with_room_by_plan_it_stops_wherever_it_would_hit_something() {
    for aside_mm in [0, 8, 15, 22, 30, 38, 44, 48] {
        for start_mm in 0..5 {
            let mut pair = Pair::new(0.15 + f64::from(start_mm) * 0.001, f64::from(aside_mm) * 1e-3, 0.0);
            pair.room_mm = Some(8);
            let least_m = pair.least_gap_m();
            assert!(least_m > 0.0005, "{aside_mm} mm aside: {:.1} mm", least_m * 1e3);
        }
    }
}

#[test]
fn one_that_dies_fifteen_millimetres_ahead_is_not_touched() {
    for step in 0..8 {
        let mut pair = Pair::new(0.054 + 0.015, 0.004, SPEED_MPS);
        (0..8 + step).for_each(|_| pair.step());
        assert!(pair.reflex.block().is_none() && pair.told_mps == SPEED_MPS);
        pair.other_mps = 0.08;
        pair.step();
        pair.other_mps = 0.0;
        assert!(pair.least_gap_m() > 0.0005, "{:.1} mm", pair.gap_m() * 1e3);
    }
}

#[test]
fn a_neighbour_on_its_own_way_is_no_hindrance() {
    // Ahead, aside, speed; and how much of its own speed it keeps at least as it passes.
    let ways = [(0.058, 0.0, SPEED_MPS, 1.0), (0.04, 0.045, SPEED_MPS, 1.0), (0.2, 0.06, 0.0, 0.6)];
    for (ahead_m, aside_m, mps, keeps) in ways {
        let mut pair = Pair::new(ahead_m, aside_m, mps);
        let mut slowest = SPEED_MPS;
        for _ in 0..120 {
            pair.step();
            slowest = slowest.min(pair.told_mps);
        }
        assert!(slowest >= keeps * SPEED_MPS, "{ahead_m} {aside_m}: {slowest}");
        assert!(pair.reflex.block().is_none());
    }
}

#[test]
fn who_comes_near_from_abaft_the_beam_does_not_make_it_brake() {
    // It braked, and the other, that drove no faster, ran into it.
    for forwards in [true, false] {
        let mut pair = Pair::new(-0.026, 0.062, SPEED_MPS);
        let mut reflex = Reflex::new();
        pair.room_mm = Some(8);
        let sense = if forwards { 1.0 } else { -1.0 };
        for _ in 0..12 {
            pair.step();
            pair.other.1 -= 0.06 * DT;
            let mut readings = pair.readings();
            if !forwards {
                readings.rotate_right(SENSORS / 2);
            }
            reflex.look(Some(&readings), sense * SPEED_MPS * DT, DT);
            let speed_mps = sense * SPEED_MPS;
            let limit = reflex.limit(Wish { speed_mps, told_mps: speed_mps, room_mm: Some(8) }, &LIMITS);
            assert!(limit.is_none(), "{limit:?} at {:.1} mm", pair.gap_m() * 1e3);
        }
        assert!(pair.told_mps == SPEED_MPS && pair.gap_m() < 0.004, "{}", pair.gap_m());
    }
}

#[test]
fn it_is_free_again_when_what_blocked_it_has_gone() {
    let mut pair = Pair::new(0.12, 0.0, 0.0);
    pair.least_gap_m();
    let block = pair.reflex.block().unwrap();
    assert!(block.sensor == 0 && block.towards.abs() < 0.3 && block.gap_m < 0.006);
    pair.other.0 += 0.1;
    (0..20).for_each(|_| pair.step());
    assert!(pair.reflex.block().is_none() && pair.told_mps > 0.1);
}

#[test]
fn readings_without_sense_are_nothing_seen() {
    let mut reflex = Reflex::new();
    for readings in
        [[f32::NAN; SENSORS], [f32::NEG_INFINITY; SENSORS], [f32::INFINITY; SENSORS], [-1.0; SENSORS]]
    {
        for _ in 0..10 {
            reflex.look(Some(&readings), 0.004, DT);
            let most = reflex.limit(Wish { speed_mps: 0.27, told_mps: 0.27, room_mm: Some(8) }, &LIMITS);
            assert!(most.is_none_or(|mps| mps >= 0.0));
        }
    }
    reflex.look(None, 0.0, 0.0);
}

/// Lets a reflex see one thing ahead, by readings in millimetres, at 0.25 m/s; what it allows after the last of them.
fn after(readings_mm: &[f32], room_mm: u16) -> Option<f64> {
    let mut reflex = Reflex::new();
    let wish = Wish { speed_mps: 0.25, told_mps: 0.25, room_mm: Some(room_mm) };
    let mut most = None;
    for reading_mm in readings_mm {
        let mut readings = [f32::INFINITY; SENSORS];
        readings[0] = reading_mm * 1e-3;
        reflex.look(Some(&readings), 0.25 * DT, DT);
        most = reflex.limit(wish, &LIMITS);
    }
    most
}

#[test]
fn one_that_kept_pace_and_does_not_any_more_is_known_by_what_was_seen_before() {
    // In the two steps after the other died a noisy reading made it look as if it only slowed down, and a step was lost;
    // or, in the third, as if it came towards the robot: then braking would have been of no use.
    let calm = [14.0, 15.0, 15.1, 14.4, 13.2];
    assert_eq!(after(&calm, 8), None);
    assert!(after(&[&calm[..], &[12.2, 9.3]].concat(), 8).unwrap() < 0.125);
    let calm = [16.5, 18.5, 15.6, 18.0];
    assert!(after(&[&calm[..], &[14.0, 9.2, 4.8]].concat(), 8).unwrap() < 0.125);
    // Noise alone is nothing.
    assert_eq!(after(&[14.0, 15.0, 13.1, 15.4, 13.2, 15.2, 13.0, 14.9, 12.9], 8), None);
}

#[test]
fn what_is_nearer_than_the_plan_has_anybody_is_minded_though_it_hardly_closes_in() {
    // At 60 degrees one that died closed in at a third of the robot's speed, by noisy readings, and was touched.
    let oblique = |room_mm| {
        let mut reflex = Reflex::new();
        let wish = Wish { speed_mps: 0.17, told_mps: 0.16, room_mm: Some(room_mm) };
        let mut most = None;
        for reading_mm in [12.1, 8.7, 9.0, 8.2, 7.0, 6.6, 4.9f32] {
            let mut readings = [f32::INFINITY; SENSORS];
            readings[1] = reading_mm * 1e-3;
            reflex.look(Some(&readings), 0.165 * DT, DT);
            most = reflex.limit(wish, &LIMITS);
        }
        most
    };
    assert_eq!(oblique(0), None);
    assert!(oblique(17).is_some_and(|most_mps| most_mps < 0.085), "{:?}", oblique(17));
}

#[test]
fn blocked_too_near_it_rolls_back_where_there_is_room() {
    let blocked = |gap_m: f32, behind_m: f32| {
        let mut pair = Pair::new(0.12, 0.0, 0.0);
        pair.least_gap_m();
        assert!(pair.reflex.block().is_some());
        let mut readings = [f32::INFINITY; SENSORS];
        (readings[0], readings[4]) = (gap_m, behind_m);
        pair.reflex.look(Some(&readings), 0.0, DT);
        pair.reflex
    };
    assert_eq!(blocked(0.001, f32::INFINITY).back_mps(), Some(-BACK_MPS));
    assert_eq!(blocked(0.001, 0.005).back_mps(), None);
    assert_eq!(blocked(0.005, f32::INFINITY).back_mps(), None);
    let mut reflex = blocked(0.001, f32::INFINITY);
    let steps = (0..100).filter(|_| reflex.back_mps().is_some()).count();
    assert_eq!(steps, usize::from(STEPS_BACK));
    assert_eq!(Reflex::new().back_mps(), None);
}
