//! A lighting desk, the receiver and simulated robots in virtual time, over a network that loses messages.

use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_dmx::{DeskNews, DeskReceiver, DmxPacket, DmxSource, PatchTable};
use lightbots_light::LampSettings;
use lightbots_show::Stage;
use lightbots_sim::{Conditions, Fleet, FleetConfig, STEP};
use lightbots_wire::{Report, Topic};

const ORANGE: Rgb = Rgb::new(255, 128, 0);

/// Robots, a receiver, and a network that loses messages.
struct Floor {
    fleet: Fleet,
    receiver: DeskReceiver,
    now: Instant,
    /// Share of messages to a robot that are lost, percent.
    loss_percent: u64,
    dice: u64,
    /// Times at which broadcasts were sent, with their lengths in bytes.
    broadcasts: Vec<(Instant, usize)>,
    news: Vec<DeskNews>,
    sequence: u8,
}

impl Floor {
    fn new(robots: usize, patch: PatchTable, loss_percent: u64) -> Self {
        let place =
            |index: usize| Vec2::new(-1.4 + 0.07 * (index % 40) as f64, 1.4 - 0.07 * (index / 40) as f64);
        let starts = (0..robots).map(place).collect();
        let mut fleet = Fleet::new(&FleetConfig {
            stage: Stage::default(),
            starts,
            seed: 5,
            conditions: Conditions::default(),
        });
        fleet.link(Instant::ZERO, true);
        Self {
            fleet,
            receiver: DeskReceiver::new(patch, 1_000, LampSettings::default()),
            now: Instant::ZERO,
            loss_percent,
            dice: 1,
            broadcasts: Vec::new(),
            news: Vec::new(),
            sequence: 0,
        }
    }

    /// Robot names in the order of the robots' numbers.
    fn by_number(&self) -> Vec<RobotId> {
        let mut ids = self.fleet.ids();
        ids.sort();
        ids
    }

    /// The lights in the order of the robots' numbers.
    fn lights(&self) -> Vec<Rgb> {
        let mut lights: Vec<_> = self.fleet.ids().into_iter().zip(self.fleet.lights()).collect();
        lights.sort();
        lights.into_iter().map(|(_, light)| light).collect()
    }

    fn run(&mut self, ms: u64) {
        let until = self.now + Span::from_millis(ms as i64);
        while self.now < until {
            self.now += STEP;
            self.fleet.advance(self.now);
            while let Some(message) = self.fleet.next_message() {
                if let Some(report) = Report::decode(&message.payload) {
                    self.receiver.report(self.now, &report);
                }
            }
            if self.receiver.wake_at(self.now).is_some_and(|at| at <= self.now) {
                self.receiver.wake(self.now);
            }
            self.deliver();
        }
    }

    /// Delivers all messages. Each robot loses its own share of them.
    fn deliver(&mut self) {
        while let Some(message) = self.receiver.next_publish() {
            if message.topic == Topic::Broadcast {
                self.broadcasts.push((self.now, message.payload.len()));
            }
            let topic = message.topic.write();
            for robot in 0..self.fleet.ids().len() {
                self.dice =
                    self.dice.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                if (self.dice >> 33) % 100 >= self.loss_percent {
                    self.fleet.receive_on(self.now, robot..robot + 1, &topic, &message.payload);
                }
            }
        }
        while let Some(news) = self.receiver.next_news() {
            self.news.push(news);
        }
    }

    /// Sends one universe with these colours, as a desk does.
    fn send(&mut self, universe: u16, colours: &[Rgb]) {
        self.sequence = self.sequence.wrapping_add(1);
        let values = colours.iter().flat_map(|colour| [colour.r, colour.g, colour.b]).collect();
        let packet = DmxPacket {
            source: DmxSource::Sacn([7; 16]),
            priority: 100,
            universe,
            sequence: Some(self.sequence),
            ends: false,
            values,
        };
        self.receiver.packet(self.now, packet);
    }
}

fn colour(moment: usize, robot: usize) -> Rgb {
    Rgb::new((moment * 7) as u8, robot as u8, (moment + robot) as u8)
}

#[test]
fn lamps_get_corrected_colours_and_people_see_those_that_are_meant() {
    let mut floor = Floor::new(3, PatchTable::default(), 0);
    let lamp = LampSettings { gain: [1.0, 0.5, 0.25], ..LampSettings::default() };
    floor.receiver = DeskReceiver::new(PatchTable::default(), 1_000, lamp);
    floor.run(2_000);
    let meant = [Rgb::new(255, 255, 255), Rgb::new(0, 200, 0), Rgb::new(90, 0, 255)];
    for _ in 0..5 {
        floor.send(1, &meant);
        floor.run(100);
    }
    assert_eq!(floor.lights(), meant.map(|colour| lamp.sent(colour)));
    assert!(floor.lights()[0] == Rgb::new(255, 188, 137));
    let mut seen: Vec<(RobotId, Rgb)> = floor.receiver.lights().collect();
    seen.sort();
    assert_eq!(seen.into_iter().map(|(_, colour)| colour).collect::<Vec<_>>(), meant);
}

#[test]
fn every_robot_shows_its_channels_with_five_percent_of_messages_lost() {
    let robots = 200;
    let mut floor = Floor::new(robots, PatchTable::default(), 5);
    floor.run(6_000);
    let mut wrong = Vec::new();
    for moment in 0..100 {
        // The colours stay for 0.3 s: time for three messages with them, and for one or two with the colours before.
        for _ in 0..13 {
            floor.send(1, &(0..170).map(|robot| colour(moment, robot)).collect::<Vec<_>>());
            floor.send(2, &(170..robots).map(|robot| colour(moment, robot)).collect::<Vec<_>>());
            floor.run(23);
        }
        let lights = floor.lights();
        wrong.push((0..robots).filter(|&robot| lights[robot] != colour(moment, robot)).count());
    }
    // Three messages carry each colour. With 5 % lost, one robot in 8,000 receives none of them: two or three in
    // 20,000.
    let sum: usize = wrong.iter().sum();
    assert!(sum <= 8, "{sum} of 20000 lights are wrong: {wrong:?}");
    assert_eq!(floor.news, [DeskNews::Began { robots }]);
    let gaps = floor.broadcasts.windows(2).map(|pair| (pair[1].0 - pair[0].0).0 / 1000);
    let least = gaps.min().unwrap();
    assert!((60..=100).contains(&least), "200 robots are sent something each {least} ms");
    assert!(floor.broadcasts.iter().all(|sent| sent.1 < 900), "{:?}", floor.broadcasts.iter().max());
}

#[test]
fn a_desk_that_falls_silent_gives_the_light_back() {
    let mut floor = Floor::new(4, PatchTable::default(), 0);
    floor.run(3_000);
    let show = "|COLOR 255|";
    let blue = Rgb::new(0, 0, 255);
    floor.fleet.receive(floor.now, "T/LightBot/Broadcast", show.as_bytes());
    floor.send(1, &[ORANGE; 3]);
    floor.run(200);
    assert_eq!(floor.lights(), [ORANGE, ORANGE, ORANGE, blue], "the fourth is not among the channels sent");
    floor.run(2_200);
    assert_eq!(floor.lights()[0], ORANGE);
    let sent = floor.broadcasts.len();
    assert!((5..=9).contains(&sent), "{sent} messages in 2.4 s: colours that stay are sent each 0.5 s");
    floor.run(300);
    assert_eq!(floor.lights(), [blue; 4]);
    assert_eq!(floor.news, [DeskNews::Began { robots: 3 }, DeskNews::Ended]);
    let sent = floor.broadcasts.len();
    floor.run(5_000);
    assert!(floor.broadcasts.len() <= sent + 3, "nothing more is sent");
    assert_eq!(floor.receiver.wake_at(floor.now), None);
}

#[test]
fn robots_that_lose_the_controller_show_their_own_light_by_themselves() {
    let mut floor = Floor::new(3, PatchTable::default(), 0);
    floor.run(3_000);
    floor.send(1, &[ORANGE; 3]);
    floor.run(100);
    assert_eq!(floor.lights(), [ORANGE; 3]);
    floor.loss_percent = 100;
    floor.send(1, &[Rgb::new(1, 2, 3); 3]);
    floor.run(2_300);
    assert_eq!(floor.lights(), [ORANGE; 3]);
    floor.run(300);
    assert_eq!(floor.lights(), [Rgb::BLACK; 3]);
    floor.loss_percent = 0;
    floor.send(1, &[ORANGE; 3]);
    floor.run(200);
    assert_eq!(floor.lights(), [ORANGE; 3]);
}

#[test]
fn robots_of_the_patch_table_alone_are_lit_and_a_late_robot_joins() {
    let mut floor = Floor::new(5, PatchTable::default(), 0);
    let ids = floor.by_number();
    let patch = format!("{} 9 4\n4 9 1 # the last one\n", ids[1]);
    floor.receiver = DeskReceiver::new(PatchTable::read(&patch).unwrap(), 1, LampSettings::default());
    for robot in 0..5 {
        // All but the first robot of the fleet are switched off for now.
        floor.fleet.link_of(floor.now, robot, robot == 0);
    }
    floor.run(500);
    floor.send(1, &[ORANGE]);
    assert_eq!(floor.receiver.counts().unpatched, 1);
    for robot in 1..5 {
        floor.fleet.link_of(floor.now, robot, true);
    }
    for _ in 0..40 {
        floor.send(9, &[Rgb::new(4, 5, 6), ORANGE]);
        floor.run(50);
    }
    let black = Rgb::BLACK;
    assert_eq!(floor.lights(), [black, ORANGE, black, black, Rgb::new(4, 5, 6)]);
    assert_eq!(floor.receiver.universes().collect::<Vec<_>>(), [9]);
}

#[test]
fn all_universes_without_robots_are_named_in_one_message() {
    let mut floor = Floor::new(2, PatchTable::default(), 0);
    floor.run(3_000);
    for _ in 0..30 {
        [1, 4, 2].into_iter().for_each(|universe| floor.send(universe, &[ORANGE; 2]));
        floor.run(100);
    }
    let unpatched = DeskNews::Unpatched { universes: vec![2, 4], has_more: false };
    assert_eq!(floor.news, [DeskNews::Began { robots: 2 }, unpatched]);
}

#[test]
fn strangers_fill_no_queue() {
    let mut floor = Floor::new(2, PatchTable::default(), 0);
    floor.run(3_000);
    for source in 0..5_000u32 {
        let mut id = [0; 16];
        id[..4].copy_from_slice(&source.to_be_bytes());
        let packet = DmxPacket {
            source: DmxSource::Sacn(id),
            priority: 50,
            universe: source as u16,
            sequence: None,
            ends: false,
            values: vec![9; 512],
        };
        floor.receiver.packet(floor.now, packet.clone());
        floor.receiver.packet(floor.now, DmxPacket { universe: 1, ..packet });
    }
    floor.send(1, &[ORANGE, ORANGE]);
    floor.run(200);
    assert_eq!(floor.lights(), [ORANGE; 2], "priority counts");
    let counts = floor.receiver.counts();
    assert_eq!((counts.unpatched, counts.newest, counts.crowded), (4_999, 6, 4_996));
    floor.run(1_000);
    let named: Vec<usize> = floor
        .news
        .iter()
        .map(|news| match news {
            DeskNews::Unpatched { universes, has_more: true } => universes.len(),
            _ => 0,
        })
        .collect();
    assert!(named.iter().sum::<usize>() == 16 && named.len() <= 2, "{:?}", floor.news);
    for name in 0..25_000 {
        let report = format!("r{name} 0 0 can=live");
        floor.receiver.report(floor.now, &Report::decode(report.as_bytes()).unwrap());
    }
    floor.receiver.wake(floor.now + Span::from_millis(500));
    let told = std::iter::from_fn(|| floor.receiver.next_publish()).count();
    assert!(told <= 60, "{told} messages at once");
}
