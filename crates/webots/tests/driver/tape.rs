//! Records the messages on the broker during a show, and where robots should be at every moment according to them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use lightbots_base::{Instant, PathRef, RobotId, Span, Vec2};
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent};
use lightbots_wire::{Command, Report, Route, TimeAnswer, Topic, commands};

/// Largest number of queued messages: some minutes of a show of thirty robots, which has a few hundred per second.
const QUEUE: usize = 1 << 16;
/// Longest wait of a test, reached only on failure.
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(60);

/// A client that records messages on a broker.
pub struct Tape {
    stop: Arc<AtomicBool>,
    /// Robots that have reported.
    heard: Arc<Mutex<BTreeSet<RobotId>>>,
    thread: JoinHandle<Score>,
}

impl Tape {
    /// Starts to record. Returns once the broker has accepted the connection.
    pub fn record(broker: &str) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let broker = BrokerUrl::parse(broker).expect("the test's own address");
        let (asked, (ready, listening)) = (stop.clone(), std::sync::mpsc::channel());
        let heard = Arc::<Mutex<BTreeSet<RobotId>>>::default();
        let those = heard.clone();
        let thread = std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
            runtime.expect("a runtime").block_on(async {
                let filters = vec!["T/LightBot/#".to_owned()];
                let client_id = "tape".to_owned();
                let mut link = Link::open(LinkConfig { broker, client_id, filters, queue: QUEUE });
                let mut score = Score::default();
                while !asked.load(Ordering::Acquire) {
                    let look = tokio::time::timeout(std::time::Duration::from_millis(50), link.next());
                    match look.await {
                        Ok(Some(LinkEvent::Connected)) => ready.send(()).expect("somebody waits"),
                        Ok(Some(LinkEvent::Message { topic, payload, .. })) => {
                            let who = Report::decode(&payload).map(|report| report.id);
                            those.lock().unwrap_or_else(PoisonError::into_inner).extend(who);
                            score.hear(&topic, &payload);
                        }
                        _ => {}
                    }
                }
                score
            })
        });
        listening.recv().expect("the broker lets it in");
        Self { stop, heard, thread }
    }

    /// Waits until a robot has reported.
    pub fn wait_for(&self, id: RobotId) {
        let late = std::time::Instant::now() + PATIENCE;
        while !self.heard.lock().unwrap_or_else(PoisonError::into_inner).contains(&id) {
            assert!(std::time::Instant::now() < late, "{id} does not come");
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }

    /// Ends the recording and returns its contents.
    pub fn end(self) -> Score {
        self.stop.store(true, Ordering::Release);
        self.thread.join().expect("it listened to the end")
    }
}

/// A route that a robot received.
struct Given {
    route: Route,
    /// The latest beginning that a START gave, show clock.
    starts: Option<Instant>,
}

/// Commands and reports of a show.
#[derive(Default)]
pub struct Score {
    routes: BTreeMap<RobotId, Vec<Given>>,
    /// Holds (`true`) and resumes, show clock.
    eases: Vec<(Instant, bool)>,
    /// A lower bound of the show clock at a moment of this machine, by the fastest time answer; `None` before the first
    /// answer.
    show: Option<(Instant, std::time::Instant)>,
    /// STOPs that arrived, show clock, each with its robot. `None` stands for all robots.
    stops: Vec<(Instant, Option<RobotId>)>,
    /// Reports that name a blocking obstacle, as text.
    blocked: Vec<String>,
    /// Largest distance from its route that a robot reported, metres.
    off_m: f64,
}

impl Score {
    fn hear(&mut self, topic: &str, payload: &[u8]) {
        let to = match Topic::parse(topic) {
            Some(Topic::Robot(id)) => Some(id),
            Some(Topic::Broadcast) => None,
            Some(Topic::Status) => return self.note(payload),
            _ => return,
        };
        for command in commands(payload).flatten() {
            match (to, command) {
                (Some(id), Command::Route(route)) => self.keep(id, route),
                (to, Command::Start { seq, at }) => self.start(to, seq, at),
                (to, Command::Stop) => {
                    self.stops.extend(self.show_at(std::time::Instant::now()).map(|at| (at, to)))
                }
                (_, Command::Hold { at } | Command::StopFrom { at }) => self.ease(at, true),
                (_, Command::Resume { at }) => self.ease(at, false),
                (Some(_), Command::Time(answer)) => self.compare(&answer),
                _ => {}
            }
        }
    }

    fn note(&mut self, payload: &[u8]) {
        let details = Report::decode(payload).and_then(|report| report.details);
        let off_m = details.as_ref().and_then(|details| details.off_m).unwrap_or(0.0);
        self.off_m = self.off_m.max(off_m);
        if details.is_some_and(|details| details.blocked.is_some()) {
            self.blocked.push(String::from_utf8_lossy(payload).into_owned());
        }
    }

    fn keep(&mut self, id: RobotId, route: Route) {
        let given = self.routes.entry(id).or_default();
        if given.iter().all(|known| known.route.seq != route.seq) {
            given.push(Given { route, starts: None });
        }
    }

    fn start(&mut self, to: Option<RobotId>, seq: u32, at: Instant) {
        for (id, given) in &mut self.routes {
            let named = given.iter_mut().filter(|known| known.route.seq == seq);
            for known in named.filter(|_| to.is_none_or(|to| to == *id)) {
                known.starts = known.starts.max(Some(at));
            }
        }
    }

    fn ease(&mut self, at: Instant, hold: bool) {
        if !self.eases.contains(&(at, hold)) {
            self.eases.push((at, hold));
            self.eases.sort_unstable();
        }
    }

    /// The show clock at a moment of this machine. `None` before the first time answer.
    fn show_at(&self, moment: std::time::Instant) -> Option<Instant> {
        let (show, then) = self.show?;
        let later = moment.saturating_duration_since(then).as_secs_f64();
        Some(show + Span::from_secs(later - then.saturating_duration_since(moment).as_secs_f64()))
    }

    /// Updates the show clock. Messages take time, so the true clock is never behind an answer.
    fn compare(&mut self, answer: &TimeAnswer) {
        let now = std::time::Instant::now();
        if self.show_at(now).is_none_or(|known| answer.sent > known) {
            self.show = Some((answer.sent, now));
        }
    }

    /// Number of holds, a `STOP at` included, and number of STOPs that came after the first time answer.
    pub fn holds(&self) -> (usize, usize) {
        (self.eases.iter().filter(|(_, hold)| *hold).count(), self.stops.len())
    }

    /// Largest distance from its route that a robot reported, metres.
    pub fn off_m(&self) -> f64 {
        self.off_m
    }

    /// Reports that name a blocking obstacle, as text.
    pub fn blocked(&self) -> &[String] {
        &self.blocked
    }

    /// Largest distances of a robot, metres: from the line of its route near its due place, and from the due place
    /// itself. The due place depends on how well this machine keeps pace, and the line does not.
    pub fn furthest_off_m(&self, id: RobotId, track: &[(std::time::Instant, Vec2)]) -> (f64, f64) {
        let given: Vec<&Given> =
            self.routes.get(&id).into_iter().flatten().filter(|given| given.starts.is_some()).collect();
        let (mut timed_m, mut beside_m) = (0.0_f64, 0.0_f64);
        for (moment, at) in track {
            let Some(show) = self.show_at(*moment) else { continue };
            let begun = |given: &&&Given| given.starts.is_some_and(|starts| starts <= show);
            let Some(given) = given.iter().filter(begun).max_by_key(|given| given.starts) else { continue };
            let starts = given.starts.unwrap_or_default();
            let ended = |(stop, who): &&(Instant, Option<RobotId>)| {
                (starts..=show).contains(stop) && who.is_none_or(|who| who == id)
            };
            if self.stops.iter().any(|stop| ended(&stop)) {
                continue;
            }
            let path = PathRef::new(given.route.start, &given.route.pieces);
            let time = self.path_time(starts, show);
            timed_m = timed_m.max(path.at(time).position.distance(*at));
            beside_m = beside_m.max(beside(&path, time, *at));
        }
        (beside_m, timed_m)
    }

    /// Path time by R38 of docs/protocol.md at the moment `show` (show clock) of a route that began at `starts`. It is
    /// integrated in steps of a millisecond.
    fn path_time(&self, starts: Instant, show: Instant) -> Span {
        /// Step of the integration, microseconds.
        const STEP_US: u64 = 1_000;
        let eases: Vec<_> = self.eases.iter().filter(|(at, _)| *at >= starts && *at <= show).collect();
        if eases.is_empty() {
            return show - starts;
        }
        let slope = STEP_US as f64 / Route::EASE.0 as f64;
        let (mut time_us, mut rate) = (0.0, 1.0_f64);
        for at in (starts.0..show.0).step_by(STEP_US as usize) {
            let held = eases.iter().rev().find(|(ease, _)| ease.0 <= at).is_some_and(|(_, hold)| *hold);
            rate = (rate + if held { -slope } else { slope }).clamp(0.0, 1.0);
            time_us += rate * STEP_US as f64;
        }
        Span(time_us as i64)
    }
}

/// Distance of a place from a path within half a second of this time, metres.
fn beside(path: &PathRef<'_>, time: Span, at: Vec2) -> f64 {
    let near = (-250..=250).map(|step| time + Span(step * 2_000));
    near.map(|time| path.at(time).position.distance(at)).fold(f64::INFINITY, f64::min)
}
