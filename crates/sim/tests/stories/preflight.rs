//! A preflight of a simulated fleet. Healthy robots pass, each robot with a defect is named, and no robots touch.

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_control::{
    Config, Controller, EventKind, Operation, PreflightFinding, PreflightReport, Refusal, Trouble,
};
use lightbots_show::{Show, Stage};
use lightbots_sim::{Conditions, Fleet, FleetConfig, STEP};
use std::collections::VecDeque;
use std::sync::Arc;

/// Usual delay of every message.
const DELAY: Span = Span::from_millis(15);

/// An undelivered message: to a robot, or from a robot to the controller.
struct Letter {
    due: Instant,
    robot: Option<usize>,
    topic: String,
    payload: Vec<u8>,
}

/// A fleet, links and a controller.
struct Hall {
    fleet: Fleet,
    ids: Vec<RobotId>,
    controller: Controller,
    now: Instant,
    letters: VecDeque<Letter>,
    events: Vec<EventKind>,
    /// Delay of every message.
    delay: Span,
    /// Share of messages lost, percent.
    loss: u64,
    dice: u64,
    /// Numbers of the robots that do not receive HOLD and STOP.
    headstrong: Vec<usize>,
    /// `[robot]`: whether it has flashed white.
    blinked: Vec<bool>,
}

impl Hall {
    fn new(stage: Stage, starts: Vec<Vec2>, conditions: Conditions, seed: u64) -> Self {
        let mut fleet = Fleet::new(&FleetConfig { stage: stage.clone(), starts, seed, conditions });
        fleet.link(Instant::ZERO, true);
        let mut hall = Self {
            ids: fleet.ids(),
            blinked: vec![false; fleet.ids().len()],
            fleet,
            controller: Controller::new(Config::default()),
            now: Instant::ZERO,
            letters: VecDeque::new(),
            events: Vec::new(),
            delay: DELAY,
            loss: 0,
            dice: seed,
            headstrong: Vec::new(),
        };
        hall.controller.connected(hall.now);
        hall.controller
            .operate(hall.now, Operation::Open(Arc::new(Show { stage, ..Show::default() })))
            .unwrap();
        hall.run(5.0);
        hall
    }

    /// Checks that robot 4, which hears no HOLD and no STOP, is found in a preflight, and that all others pass.
    fn assert_headstrong_is_named(&mut self, case: &str) {
        self.headstrong = vec![4];
        let report = self.preflight();
        assert_eq!(self.findings(&report, 4), [PreflightFinding::DidNotStop], "{case}: {}", self.story());
        self.assert_others_pass(&report, &[4]);
    }

    fn is_lost(&mut self) -> bool {
        self.dice = self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.dice >> 33) % 100 < self.loss
    }

    fn post(&mut self, robot: Option<usize>, topic: String, payload: Vec<u8>) {
        if !self.is_lost() {
            self.letters.push_back(Letter { due: self.now + self.delay, robot, topic, payload });
        }
    }

    fn drain(&mut self) {
        while let Some(request) = self.controller.next_plan_request() {
            self.controller.planned(self.now, request.run());
        }
        while let Some(send) = self.controller.next_send() {
            for robot in 0..self.ids.len() {
                let topic = send.topic.write().to_string();
                let is_for_it = topic.ends_with("Broadcast") || topic.ends_with(self.ids[robot].as_str());
                let text = String::from_utf8_lossy(&send.payload);
                let is_stop = text.contains("HOLD") || text.contains("STOP");
                if is_for_it && !(is_stop && self.headstrong.contains(&robot)) {
                    self.post(Some(robot), topic, send.payload.clone());
                }
            }
        }
        while let Some(event) = self.controller.next_event() {
            self.events.push(event.kind);
        }
    }

    fn step(&mut self) {
        self.now += STEP;
        self.fleet.advance(self.now);
        while let Some(message) = self.fleet.next_message() {
            self.post(None, message.topic.write().to_string(), message.payload);
        }
        while self.letters.front().is_some_and(|letter| letter.due <= self.now) {
            let Some(Letter { robot, topic, payload, .. }) = self.letters.pop_front() else { break };
            match robot {
                Some(robot) => drop(self.fleet.receive_on(self.now, robot..robot + 1, &topic, &payload)),
                None => self.controller.message(self.now, &topic, &payload),
            }
            self.drain();
        }
        if self.controller.wake_at().is_some_and(|at| at <= self.now) {
            self.controller.wake(self.now);
            self.drain();
        }
        for (blinked, light) in self.blinked.iter_mut().zip(self.fleet.lights()) {
            *blinked |= light == lightbots_base::Rgb::new(255, 255, 255);
        }
    }

    fn run(&mut self, seconds: f64) {
        let until = self.now + Span::from_secs(seconds);
        while self.now < until {
            self.step();
        }
    }

    fn begin(&mut self) {
        self.controller.operate(self.now, Operation::Preflight).unwrap();
        self.drain();
    }

    /// Runs the preflight to its end, and checks what holds for every preflight.
    fn finish(&mut self) -> Arc<PreflightReport> {
        let begun = self.now;
        while self.controller.has_run() {
            self.step();
            assert!(self.now - begun < Span::from_millis(180_000), "no end: {}", self.story());
        }
        assert_eq!(self.fleet.contacts(), 0, "{}", self.story());
        self.controller.snapshot(self.now).preflight.expect("a report")
    }

    fn preflight(&mut self) -> Arc<PreflightReport> {
        self.begin();
        self.finish()
    }

    fn findings<'a>(&self, report: &'a PreflightReport, robot: usize) -> &'a [PreflightFinding] {
        &report.of(self.ids[robot]).unwrap_or_else(|| panic!("robot {robot} is not named")).findings
    }

    /// Asserts that all robots passed except those of `but`.
    fn assert_others_pass(&self, report: &PreflightReport, but: &[usize]) {
        for robot in (0..self.ids.len()).filter(|robot| !but.contains(robot)) {
            assert_eq!(self.findings(report, robot), [], "robot {robot}: {report:#?}\n{}", self.story());
        }
    }

    fn story(&self) -> String {
        self.events.iter().map(|event| format!("{event}\n")).collect()
    }
}

fn grid(side: usize, spacing_m: f64) -> Vec<Vec2> {
    let centred = |index: usize| (index as f64 - 0.5 * (side as f64 - 1.0)) * spacing_m;
    (0..side * side).map(|index| Vec2::new(centred(index % side), centred(index / side))).collect()
}

fn hall(conditions: Conditions) -> Hall {
    Hall::new(Stage::default(), grid(3, 0.2), conditions, 5)
}

#[test]
fn a_healthy_fleet_passes_and_stands_where_it_stood() {
    let mut hall = hall(Conditions::default());
    let before: Vec<Vec2> = hall.fleet.poses().iter().map(|pose| pose.at).collect();
    let begun = hall.now;
    let report = hall.preflight();
    hall.assert_others_pass(&report, &[]);
    assert!(report.finished && report.passed() == 9);
    assert!(
        report.robots.iter().all(|robot| robot.off_m.is_some() && robot.off_rad.is_some() && !robot.limited)
    );
    for (pose, before) in hall.fleet.poses().iter().zip(&before) {
        assert!(pose.at.distance(*before) < 0.006);
    }
    assert!(hall.blinked.iter().all(|blinked| *blinked));
    let took_s = (hall.now - begun).as_secs();
    assert!((12.0..30.0).contains(&took_s), "{took_s} s");
    assert!(hall.events.contains(&EventKind::PreflightEnded { passed: 9, robots: 9 }));
}

#[test]
fn a_robot_whose_marker_is_turned_is_named() {
    for degrees in [-12.0, -7.0, 7.0, 10.0_f64] {
        let turned_markers = vec![(4, degrees.to_radians())];
        let mut hall = hall(Conditions { turned_markers, ..Conditions::default() });
        let report = hall.preflight();
        let found = hall.findings(&report, 4);
        let off = found.iter().find_map(|finding| match finding {
            PreflightFinding::DrivesAskew { off_rad } => Some(off_rad.to_degrees()),
            _ => None,
        });
        let off = off.unwrap_or_else(|| panic!("{found:?}"));
        // The estimates do not settle completely while robots stand, so the measured angle is less than the whole one.
        assert!(off > 3.0 && off < degrees.abs() + 1.0, "{off} for {degrees}");
        hall.assert_others_pass(&report, &[4]);
    }
}

#[test]
fn a_wheel_that_does_not_grip_is_named() {
    for (left_share, seed) in [(0.0, 1), (0.2, 2)] {
        let conditions = Conditions { worn: vec![(2, left_share)], ..Conditions::default() };
        let mut hall = Hall::new(Stage::default(), grid(3, 0.2), conditions, seed);
        let report = hall.preflight();
        assert!(!hall.findings(&report, 2).is_empty(), "{left_share}: {report:#?}");
        hall.assert_others_pass(&report, &[2]);
    }
}

#[test]
fn a_robot_that_ignores_stop_is_named_and_driven_no_more() {
    for seed in 1..=5 {
        let mut hall = Hall::new(Stage::default(), grid(3, 0.12), Conditions::default(), seed);
        hall.assert_headstrong_is_named(&format!("seed {seed}"));
    }
}

#[test]
fn robots_that_die_before_or_on_their_way_are_named() {
    let mut hall = hall(Conditions::default());
    hall.fleet.kill(0);
    hall.run(7.0);
    hall.begin();
    hall.run(2.2);
    hall.fleet.kill(7);
    let report = hall.finish();
    let silent = PreflightFinding::Failed(Trouble::Silent);
    assert_eq!(hall.findings(&report, 0), [silent]);
    assert!(matches!(hall.findings(&report, 7)[..], [PreflightFinding::Failed(_)]), "{report:#?}");
    hall.assert_others_pass(&report, &[0, 7]);
}

#[test]
fn a_robot_without_room_is_named_and_stands() {
    let ring = (0..6).map(|sixth| Vec2::unit(f64::from(sixth) * std::f64::consts::FRAC_PI_3) * 0.06);
    let starts: Vec<Vec2> = std::iter::once(Vec2::ZERO).chain(ring).collect();
    let mut hall = Hall::new(Stage::default(), starts, Conditions::default(), 3);
    let report = hall.preflight();
    assert_eq!(hall.findings(&report, 0), [PreflightFinding::NoRoom]);
    hall.assert_others_pass(&report, &[0]);
    assert!(hall.fleet.poses()[0].at.distance(Vec2::ZERO) < 0.003);
}

#[test]
fn fleets_of_any_density_are_tested_without_a_contact() {
    let (mut tested, mut named) = (0, Vec::new());
    for spacing_mm in [58, 62, 70, 80, 92, 100, 120, 150, 200] {
        for (seed, loss) in [(1, 0), (2, 5)] {
            let starts = grid(4, f64::from(spacing_mm) / 1000.0);
            let mut hall = Hall::new(Stage::default(), starts, Conditions::default(), seed);
            hall.loss = loss;
            let report = hall.preflight();
            assert!(report.finished, "{spacing_mm} mm: {}", hall.story());
            for robot in &report.robots {
                tested += 1;
                let is_named = |finding: &&PreflightFinding| **finding != PreflightFinding::NoRoom;
                named.extend(
                    robot.findings.iter().filter(is_named).map(|found| (spacing_mm, loss, found.to_string())),
                );
            }
            let has_no_room =
                |robot: usize| hall.findings(&report, robot).contains(&PreflightFinding::NoRoom);
            let crowded = (0..16).filter(|&robot| has_no_room(robot)).count();
            assert!(crowded <= if spacing_mm < 92 { 4 } else { 0 }, "{spacing_mm} mm: {crowded}");
        }
    }
    assert!(named.is_empty(), "{} of {tested} healthy robots are named: {named:?}", named.len());
}

#[test]
fn original_robots_are_tested_as_far_as_they_can() {
    let conditions = Conditions { originals: 2, ..Conditions::default() };
    let mut hall = Hall::new(Stage::default(), grid(2, 0.3), conditions, 5);
    let report = hall.preflight();
    for robot in 0..4 {
        let tested = report.of(hall.ids[robot]).unwrap();
        assert_eq!((tested.limited, tested.off_rad.is_none()), (robot >= 2, robot >= 2), "{report:#?}");
        assert!(tested.off_m.is_some(), "{report:#?}");
        assert!(!tested.findings.contains(&PreflightFinding::Unfinished), "{report:#?}");
    }
}

#[test]
fn stop_ends_a_preflight_and_it_is_refused_in_a_run() {
    let mut hall = hall(Conditions::default());
    hall.begin();
    let again = hall.controller.operate(hall.now, Operation::Preflight);
    assert!(matches!(again, Err(Refusal::Busy(_))), "{again:?}");
    hall.run(2.0);
    let before: Vec<Vec2> = hall.fleet.poses().iter().map(|pose| pose.at).collect();
    hall.controller.operate(hall.now, Operation::StopAll).unwrap();
    hall.drain();
    let report = hall.finish();
    assert!(!report.finished);
    assert!((0..9).all(|robot| hall.findings(&report, robot) == [PreflightFinding::Unfinished]));
    for (pose, before) in hall.fleet.poses().iter().zip(&before) {
        assert!(pose.at.distance(*before) < 0.01);
    }
}

#[test]
fn on_slow_links_robots_are_stopped_at_the_same_place_and_those_that_drive_on_are_named() {
    for ms in [100, 200] {
        let mut hall = hall(Conditions::default());
        hall.delay = Span::from_millis(ms);
        hall.run(5.0);
        hall.assert_headstrong_is_named(&format!("{ms} ms"));
    }
}

#[test]
fn robots_that_could_not_receive_a_stop_in_time_are_untested_and_not_faulty() {
    for ms in [1_000, 1_400] {
        let mut hall = hall(Conditions::default());
        hall.delay = Span::from_millis(ms);
        hall.run(20.0);
        let report = hall.preflight();
        for robot in 0..9 {
            let found = hall.findings(&report, robot);
            assert!(found.contains(&PreflightFinding::StopNotTested), "{ms} ms, {robot}: {report:#?}");
            assert!(!found.contains(&PreflightFinding::DidNotStop), "{ms} ms, {robot}: {report:#?}");
        }
    }
}
