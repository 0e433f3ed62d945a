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
    ample: bool,
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
            ample: false,
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

    /// Both move on; how fast it may drive by readings that are so much too large, metres.
    fn may_drive(&mut self, off_m: f32) -> Option<f64> {
        self.x += self.speed_mps * DT;
        self.other.0 += self.other_mps * DT;
        let readings = self.readings().map(|gap_m| gap_m + off_m);
        self.reflex.look(Some(&readings), (self.speed_mps * DT, 0.0), DT);
        let wish = Wish { speed_mps: SPEED_MPS, told_mps: self.told_mps, ample: self.ample };
        self.reflex.limit(wish, &LIMITS)
    }

    fn step(&mut self) {
        let most_mps = self.may_drive(0.0).unwrap_or(SPEED_MPS);
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
            pair.ample = true;
            let least_m = pair.least_gap_m();
            assert!(least_m > 0.0005, "{aside_mm} mm aside: {:.1} mm", least_m * 1e3);
        }
    }
}

#[test]
fn with_room_by_plan_it_does_not_start_towards_what_is_nearer_ahead_than_that() {
    for gap_mm in [1.8, 2.4, 3.0, 4.0, 5.0] {
        for degrees in [0.0f64, 13.0] {
            let far_m = LIMITS.contact_m() + gap_mm * 1e-3;
            let (aside, ahead) = libm::sincos(degrees.to_radians());
            let mut pair = Pair::new(far_m * ahead, far_m * aside, 0.0);
            (pair.ample, pair.speed_mps, pair.told_mps) = (true, 0.0, 0.0);
            (0..4).for_each(|_| _ = pair.may_drive(0.0));
            pair.reflex.forget();
            let mut least_m = f64::INFINITY;
            for _ in 0..62 {
                let most_mps = pair.may_drive(0.0).unwrap_or(SPEED_MPS);
                // What was lost by braking comes back within two steps.
                pair.speed_mps = pair.told_mps;
                pair.told_mps = most_mps.min(pair.told_mps + 0.18);
                least_m = least_m.min(pair.gap_m());
            }
            assert!(least_m > 0.0002, "{gap_mm} mm, {degrees}°: {:.2} mm", least_m * 1e3);
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
        pair.ample = true;
        let sense = if forwards { 1.0 } else { -1.0 };
        for _ in 0..12 {
            pair.step();
            pair.other.1 -= 0.06 * DT;
            let mut readings = pair.readings();
            if !forwards {
                readings.rotate_right(SENSORS / 2);
            }
            reflex.look(Some(&readings), (sense * SPEED_MPS * DT, 0.0), DT);
            let speed_mps = sense * SPEED_MPS;
            let limit = reflex.limit(Wish { speed_mps, told_mps: speed_mps, ample: true }, &LIMITS);
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
            reflex.look(Some(&readings), (0.004, 0.0), DT);
            let most = reflex.limit(Wish { speed_mps: 0.27, told_mps: 0.27, ample: true }, &LIMITS);
            assert!(most.is_none_or(|mps| mps >= 0.0));
        }
    }
    reflex.look(None, (0.0, 0.0), 0.0);
}

#[test]
fn what_passes_to_the_next_sensor_still_holds_it() {
    // It stood, took it for gone as its place passed to the sensor beside, and crept on until it touched.
    for aside_mm in [48, 50, 52] {
        let mut pair = Pair::new(0.1, f64::from(aside_mm) * 1e-3, 0.0);
        pair.ample = true;
        (0..100).for_each(|_| pair.step());
        assert!(pair.gap_m() > 0.0005, "{aside_mm} mm aside: {:.1} mm", pair.gap_m() * 1e3);
        assert!(pair.reflex.block().is_some());
    }
}

#[test]
fn it_backs_away_from_what_blocks_it_until_there_is_room_and_no_farther() {
    let mut pair = Pair::new(0.12, 0.0, 0.0);
    pair.least_gap_m();
    let (mut backed_m, came_m) = (0.0, pair.gap_m());
    for _ in 0..60 {
        let back_mps = pair.reflex.back_away();
        assert!((-0.031..=0.0).contains(&back_mps));
        backed_m -= back_mps * DT;
        pair.x += back_mps * DT;
        pair.reflex.look(Some(&pair.readings()), (back_mps * DT, 0.0), DT);
    }
    assert!(came_m < 0.004 && backed_m > 0.0 && backed_m < 0.0085, "{came_m} {backed_m}");
    assert!((0.0035..0.006).contains(&pair.gap_m()), "{}", pair.gap_m());
    // Nobody is backed into.
    let mut pair = Pair::new(0.12, 0.0, 0.0);
    pair.least_gap_m();
    let mut readings = pair.readings();
    readings[4] = 0.01;
    pair.reflex.look(Some(&readings), (0.0, 0.0), DT);
    assert_eq!(pair.reflex.back_away(), 0.0);
}

#[test]
fn what_stands_between_two_sensors_has_not_gone() {
    // Both say it is farther away than it is: read so, it had gone, and the robot drove into it.
    let mut pair = Pair::new(0.12, 0.022, 0.0);
    pair.ample = true;
    pair.least_gap_m();
    assert!(pair.reflex.block().is_some());
    pair.x -= 0.003;
    pair.speed_mps = 0.0;
    for _ in 0..40 {
        pair.reflex.look(Some(&pair.readings()), (0.0, 0.0), DT);
        pair.reflex.limit(Wish { speed_mps: SPEED_MPS, told_mps: 0.0, ample: true }, &LIMITS);
    }
    assert!(pair.reflex.block().is_some(), "{:.1} mm", pair.gap_m() * 1e3);
}

#[test]
fn what_comes_from_between_two_sensors_into_sight_of_one_holds_it_on() {
    // Two that say 6.5 mm mean 3 mm, one that says 4.3 mm means that: read so, the gap had widened, and it drove on.
    let mut reflex = Reflex::new();
    let seen_mm = [
        (17.3, 40.0),
        (15.2, 40.0),
        (9.8, 40.0),
        (10.2, 40.0),
        (10.3, 15.0),
        (7.9, 10.3),
        (6.5, 6.6),
        (5.7, 3.7),
    ];
    let mut told_mps = SPEED_MPS;
    let mut look = |one_mm: f32, two_mm: f32, way_m: f64, told_mps: f64| {
        let mut readings = NOTHING;
        (readings[1], readings[2]) = (one_mm * 1e-3, two_mm * 1e-3);
        reflex.look(Some(&readings), (way_m, -0.005), DT);
        let limit = reflex.limit(Wish { speed_mps: SPEED_MPS, told_mps, ample: true }, &LIMITS);
        (limit, reflex.block().is_some())
    };
    for (one_mm, two_mm) in seen_mm {
        told_mps = look(one_mm, two_mm, 0.0041, told_mps).0.unwrap_or(SPEED_MPS);
    }
    assert!(told_mps < 0.1, "{told_mps}");
    let stands = [(7.8, 4.6), (7.8, 4.3), (40.0, 4.3), (40.0, 3.8), (40.0, 4.4)];
    let blocked = stands.map(|(one_mm, two_mm)| look(one_mm, two_mm, 0.0, 0.0));
    assert!(blocked[4].1, "{blocked:?}");
}

/// Drives close behind a neighbour as fast as itself, which two readings put so much nearer, metres, than it is; in how
/// many steps it was held back since.
fn steps_held_by_false_readings(nearer_m: [f32; 2]) -> usize {
    let mut pair = Pair::new(0.0635, 0.0, SPEED_MPS);
    let step = |pair: &mut Pair, off_m: f32| {
        let most_mps = pair.may_drive(-off_m);
        pair.speed_mps = pair.told_mps;
        pair.told_mps = most_mps.unwrap_or(SPEED_MPS).min(SPEED_MPS);
        usize::from(most_mps.is_some())
    };
    for _ in 0..8 {
        assert_eq!(step(&mut pair, 0.0), 0);
    }
    nearer_m.into_iter().chain([0.0; 12]).map(|off_m| step(&mut pair, off_m)).sum()
}

#[test]
fn a_false_reading_holds_it_back_no_longer_than_until_the_next() {
    assert_eq!(steps_held_by_false_readings([0.0; 2]), 0);
    assert_eq!(steps_held_by_false_readings([0.0045, 0.003]), 1);
}

#[test]
fn a_reading_too_far_does_not_set_it_free_from_what_stands() {
    let mut pair = Pair::new(0.15, 0.0, 0.0);
    while pair.reflex.held.is_none() {
        pair.step();
    }
    assert!(pair.may_drive(0.004).is_some_and(|mps| mps < 0.1));
    (pair.speed_mps, pair.told_mps) = (pair.told_mps, 0.0);
    assert!(pair.least_gap_m() > 0.0005);
}
