//! A robot that speaks only the original's protocol.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::plain_mqtt::Mqtt;

/// What the robot has done until it was switched off.
#[derive(Clone, Debug, Default)]
pub struct Diary {
    pub targets: usize,
    pub colours: Vec<u32>,
    pub arrivals: usize,
}

pub struct OriginalRobot {
    stop: Arc<AtomicBool>,
    thread: JoinHandle<Diary>,
}

struct Body {
    mqtt: Mqtt,
    id: String,
    at: (f64, f64),
    target: Option<(f64, f64)>,
    diary: Diary,
}

impl OriginalRobot {
    /// Starts a robot that drives at 0.2 m/s.
    pub fn start(broker: &str, id: &str, at: (f64, f64)) -> Self {
        let topics = ["T/LightBot/Broadcast".to_owned(), format!("T/LightBot/{id}")];
        let topics: Vec<&str> = topics.iter().map(String::as_str).collect();
        let mqtt = Mqtt::open(broker, &format!("LightBot/{id}"), &topics);
        let body = Body { mqtt, id: id.to_owned(), at, target: None, diary: Diary::default() };
        let stop = Arc::new(AtomicBool::new(false));
        let wanted = stop.clone();
        Self { stop, thread: std::thread::spawn(move || body.live(&wanted)) }
    }

    /// Ends the robot. Returns what it has done.
    pub fn end(self) -> Diary {
        self.stop.store(true, Ordering::Relaxed);
        self.thread.join().unwrap()
    }
}

impl Body {
    fn live(mut self, stop: &AtomicBool) -> Diary {
        self.report("UUID");
        let mut before = Instant::now();
        while !stop.load(Ordering::Relaxed) {
            while let Some((_, payload)) = self.mqtt.next() {
                for part in payload.split('|').filter(|part| !part.trim().is_empty()) {
                    self.obey(part);
                }
            }
            let passed = before.elapsed().as_secs_f64();
            before = Instant::now();
            self.drive(0.2 * passed);
            std::thread::sleep(Duration::from_millis(16));
        }
        self.diary
    }

    fn obey(&mut self, command: &str) {
        let words: Vec<&str> = command.split(' ').collect();
        let number = |index: usize| words.get(index).and_then(|word| word.parse::<f64>().ok());
        match words[0] {
            "TARGET" => {
                self.target = number(1).zip(number(2));
                self.diary.targets += 1;
            }
            "COLOR" => self.diary.colours.extend(words.get(1).and_then(|word| word.parse::<u32>().ok())),
            "UUID" => self.report("UUID"),
            _ => {}
        }
    }

    fn drive(&mut self, step_m: f64) {
        let Some(target) = self.target else { return };
        let (dx, dy) = (target.0 - self.at.0, target.1 - self.at.1);
        let share = (step_m / dx.hypot(dy).max(1e-9)).min(1.0);
        self.at = (self.at.0 + dx * share, self.at.1 + dy * share);
        if (target.0 - self.at.0).abs() <= 0.02 && (target.1 - self.at.1).abs() <= 0.02 {
            self.target = None;
            self.diary.arrivals += 1;
            self.report("Arrival");
        }
    }

    fn report(&self, topic: &str) {
        self.mqtt
            .publish(&format!("T/LightBot/{topic}"), format!("{} {:?} {:?}", self.id, self.at.0, self.at.1));
    }
}
