//! A fleet in real time, with a controller of a few lines.

use lightbots_base::{Instant, Piece, Rgb, Span, Vec2};
use lightbots_show::Stage;
use lightbots_sim::{Conditions, Fleet, FleetConfig, FleetMessage, STEP};
use lightbots_wire::{Command, Report, Route, TimeAnswer, TimeQuestion, Topic, encode};

/// A fleet whose messages arrive at once, and everything that it sent.
struct Hall {
    fleet: Fleet,
    now: Instant,
    said: Vec<(Topic, Report)>,
}

impl Hall {
    fn new(starts: Vec<Vec2>, conditions: Conditions) -> Self {
        let mut fleet = Fleet::new(&FleetConfig { stage: Stage::default(), starts, seed: 3, conditions });
        fleet.link(Instant::ZERO, true);
        Self { fleet, now: Instant::ZERO, said: Vec::new() }
    }

    fn run(&mut self, steps: usize) {
        for _ in 0..steps {
            self.now += STEP;
            assert_eq!(self.fleet.advance(self.now), 1);
            while let Some(message) = self.fleet.next_message() {
                self.hear(&message);
            }
        }
    }

    fn hear(&mut self, message: &FleetMessage) {
        if message.topic != Topic::Time {
            let report = Report::decode(&message.payload).expect("robots say what can be read");
            return self.said.push((message.topic, report));
        }
        let question = TimeQuestion::decode(&message.payload).expect("a question");
        let answer = TimeAnswer { asked: question.asked, received: self.now, sent: self.now };
        self.tell(Topic::Robot(question.id), &Command::Time(answer));
    }

    fn tell(&mut self, topic: Topic, command: &Command) {
        let mut text = String::new();
        encode(command, &mut text).unwrap();
        assert!(self.fleet.receive(self.now, &topic.write(), text.as_bytes()));
    }
}

/// A route of 1.5 m along x from `start`, and its duration with the time to turn towards it.
fn ride(seq: u32, start: Vec2) -> (Route, Span) {
    let mid = |x: f64| start + Vec2::new(x, 0.0);
    let cruise = Vec2::new(0.25, 0.0);
    let (ramp, way) = (Span::from_millis(500), Span::from_millis(5500));
    let pieces = [
        Piece::rest(start, Span::from_millis(600)),
        Piece::hermite(start, Vec2::ZERO, mid(0.0625), cruise, ramp),
        Piece::straight(mid(0.0625), mid(1.4375), way),
        Piece::hermite(mid(1.4375), cruise, mid(1.5), Vec2::ZERO, ramp),
    ];
    let total = pieces.iter().fold(Span::ZERO, |sum, piece| sum + piece.duration);
    (
        Route {
            seq,
            start,
            pieces: pieces.into_iter().collect(),
            room_mm: None,
            neighbours: Default::default(),
        },
        total,
    )
}

#[test]
fn robots_on_a_path_are_where_it_says_when_it_says() {
    let starts: Vec<Vec2> = (0..5).map(|row| Vec2::new(-0.75, -0.4 + 0.2 * f64::from(row))).collect();
    let mut hall = Hall::new(starts.clone(), Conditions::default());
    hall.run(100);
    let ids = hall.fleet.ids();
    let routes: Vec<(Route, Span)> = starts.iter().map(|&start| ride(7, start)).collect();
    for (id, (route, _)) in ids.iter().zip(&routes) {
        hall.tell(Topic::Robot(*id), &Command::Route(route.clone()));
    }
    let at = hall.now + Span::from_millis(200);
    hall.tell(Topic::Broadcast, &Command::Start { seq: 7, at });
    let mut worst: f64 = 0.0;
    while hall.now < at + routes[0].1 {
        hall.run(1);
        for (pose, (route, _)) in hall.fleet.poses().iter().zip(&routes) {
            let path = lightbots_base::PathRef::new(route.start, &route.pieces);
            worst = worst.max(pose.at.distance(path.at_instant(at, hall.now).position));
        }
    }
    assert!(worst < 0.012, "{worst} m off the path");
    hall.run(60);
    let arrived = hall.said.iter().filter(|(topic, _)| *topic == Topic::Arrival).count();
    assert_eq!(arrived, 5);
    for (pose, (route, _)) in hall.fleet.poses().iter().zip(&routes) {
        assert!(pose.at.distance(route.pieces[3].end) < 0.006);
    }
    assert_eq!(hall.fleet.contacts(), 0);
}

#[test]
fn names_follow_from_the_seed_and_the_place_in_the_list_alone() {
    let names = |robots: u32, seed, conditions| {
        let starts = (0..robots).map(|nth| Vec2::new(0.1 * f64::from(nth), 0.0)).collect();
        Fleet::new(&FleetConfig { stage: Stage::default(), starts, seed, conditions }).ids()
    };
    let few = names(3, 7, Conditions::default());
    assert_eq!(few, names(9, 7, Conditions::ideal())[..3]);
    assert!(names(9, 8, Conditions::default()).iter().all(|name| !few.contains(name)));
}

#[test]
fn an_original_controller_is_understood() {
    let mut hall = Hall::new(vec![Vec2::ZERO, Vec2::new(0.5, 0.0)], Conditions::default());
    hall.run(20);
    assert_eq!(hall.said.iter().filter(|(topic, _)| *topic == Topic::Uuid).count(), 2);
    let topic = Topic::Robot(hall.fleet.ids()[0]);
    let goal = Vec2::new(-0.5, -0.8);
    assert!(hall.fleet.receive(hall.now, &topic.write(), b"|TARGET -0,500000 -0,800000||COLOR 16753920|"));
    hall.run(600);
    let off = hall.fleet.poses()[0].at - goal;
    assert!(off.x.abs() <= 0.02 && off.y.abs() <= 0.02, "{off:?}");
    assert_eq!(hall.fleet.lights()[0], Rgb::new(255, 165, 0));
    assert_eq!(hall.fleet.poses()[1].at, Vec2::new(0.5, 0.0));
    let arrivals = hall.said.iter().filter(|(topic, _)| *topic == Topic::Arrival).count();
    assert_eq!(arrivals, 1);
}

#[test]
fn a_late_call_is_caught_up_on_within_bounds() {
    let mut hall = Hall::new(vec![Vec2::ZERO], Conditions::default());
    assert_eq!(hall.fleet.advance(Instant(160_000)), 10);
    assert_eq!(hall.fleet.advance(Instant(160_000)), 0);
    assert_eq!(hall.fleet.advance(Instant(10_160_000)), 32);
    assert_eq!(hall.fleet.steps_left_out(), 625 - 32);
    assert_eq!(hall.fleet.advance_at(), Instant(10_176_000));
}

#[test]
fn messages_for_no_robot_are_not_received() {
    let mut hall = Hall::new(vec![Vec2::ZERO], Conditions::default());
    for topic in ["T/LightBot/Status", "T/LightBot/no-such-robot", "", "T/LightBot/+"] {
        assert!(!hall.fleet.receive(Instant::ZERO, topic, b"|STOP|"), "{topic}");
    }
    assert!(hall.fleet.receive(Instant::ZERO, "T/LightBot/Broadcast", &[0xff; 4096]));
}

#[test]
fn robots_of_a_fleet_say_in_every_report_that_they_are_simulated() {
    let starts = vec![Vec2::new(-0.1, 0.0), Vec2::new(0.1, 0.0)];
    let mut hall = Hall::new(starts, Conditions::default());
    hall.run(200);
    assert!(hall.said.len() > 2);
    assert!(hall.said.iter().all(|(_, report)| report.details.as_ref().is_some_and(|it| it.simulated)));
}
