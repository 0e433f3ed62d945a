//! Plays a show of five minutes with three moving layers over the embedded broker, and measures messages, bytes, wrong
//! lights and processor time.
//!
//! `cargo xtask bench light-show` runs it with `--json`; other arguments are numbers of robots. Broker (`lightbots
//! broker`) and controller (`lightbots play`) are separate processes. The robots are simulated in this process, each on
//! its own connection. Their lights are sampled and later compared with the colours of the controller, which a replay
//! of its recording gives.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod common;

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant as Moment};

use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_control::{Config, replay_observed};
use lightbots_exchange::LIGHTBOTS;
use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent, Sender, robot_client_id};
use lightbots_show::{Frame, Layer, LayerSpan, Pixel, Setting, Show, Stage};
use lightbots_sim::{Conditions, Fleet, FleetConfig, LightCounts, LightWatch};
use lightbots_wire::{TimeQuestion, Topic, commands};
use serde_json::{Value, json};
use tokio::sync::mpsc;

use common::{Outcome, embedded, program};

/// Numbers of robots if the command line has none.
const SIZES: [usize; 1] = [1_000];
/// Number of frames of the show. Each is shown for `AIR_S`; with the drives that makes five minutes.
const FRAMES: usize = 26;
/// Air time of each frame, seconds.
const AIR_S: f64 = 10.0;
/// Distance between neighbours in the grid, metres.
const SPACING_M: f64 = 0.1;
/// Time between two samples of all lights.
const SAMPLE: Duration = Duration::from_millis(160);
/// Time between two requests for the show clock.
const ASK: Duration = Duration::from_millis(500);
/// Most messages that are handled before the robots' next step.
const BATCH: usize = 4_096;
/// Clock ticks per second in `/proc/PID/stat`, on every Linux system.
const TICKS: f64 = 100.0;

/// Number and bytes of the messages in one direction.
#[derive(Clone, Copy, Default)]
struct Flow {
    messages: u64,
    bytes: u64,
}

impl Flow {
    fn count(&mut self, bytes: usize) {
        self.messages += 1;
        self.bytes += bytes as u64;
    }
}

/// Counts and samples while the show plays.
#[derive(Default)]
struct Seen {
    /// Messages to robots. `stretches` are those with a stretch of light among them, and `reports` are messages of
    /// robots.
    commands: Flow,
    stretches: Flow,
    reports: Flow,
    /// `[second]`: number of stretches, counted from the first one.
    in_second: Vec<u64>,
    /// Samples: this process's clock, microseconds, and `[robot]`: its light.
    samples: Vec<(u64, Vec<Rgb>)>,
    /// From the fastest answer about the show clock: its round trip, and the show clock minus this process's clock,
    /// microseconds.
    offset: Option<(u64, i64)>,
    /// Steps that the simulation left out because the machine was too slow.
    left_out: u64,
}

/// The simulated robots and their connections.
struct Robots {
    began: Moment,
    fleet: Fleet,
    ids: Vec<RobotId>,
    senders: Vec<Sender>,
    heard: mpsc::Receiver<(usize, LinkEvent)>,
}

#[tokio::main]
async fn main() -> Outcome {
    // Every connection needs a file descriptor.
    let _ = rlimit::increase_nofile_limit(65_536);
    let asked: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    for robots in if asked.is_empty() { SIZES.to_vec() } else { asked } {
        println!("{}", measure(robots).await?);
    }
    Ok(())
}

async fn measure(count: usize) -> Outcome<Value> {
    let broker = embedded()?;
    let folder = std::env::temp_dir().join(format!("lightbots-light-show-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let show = show(count);
    let (file, log) = (folder.join("show.lightbots.json"), folder.join("run.log"));
    std::fs::write(&file, LIGHTBOTS.write(&show, None).bytes)?;
    let mut robots = Robots::start(&broker.url, &show)?;
    let mut play = play(&broker.url, &file, &log, count)?;
    let mut seen = Seen::default();
    let own_before_s = processor_s(std::process::id());
    let controller_s = robots.run(&mut play, &broker.url, &mut seen).await?;
    let robots_s = processor_s(std::process::id()) - own_before_s;
    let broker_s = processor_s(broker.process());
    let said = std::io::read_to_string(play.stdout.take().ok_or("the controller says nothing")?)?;
    let report: Value = serde_json::from_str(&said)?;
    eprintln!("{}", report["issues"]);
    let lights = compare(&std::fs::read(&log)?, &robots.ids, &seen)?;
    std::fs::remove_dir_all(&folder)?;
    let show_s = report["duration_s"].as_f64().unwrap_or_default();
    let each = |number: u64| number as f64 / show_s.max(1.0) / count as f64;
    let peak = seen.in_second.iter().copied().max().unwrap_or(0) as f64 / count as f64;
    Ok(json!({
        "robots": count,
        "show_s": show_s,
        "frames": report["frames_played"],
        "lights_compared": lights.compared,
        "wrong": lights.wrong,
        "stretches_a_robot_and_s": each(seen.stretches.messages),
        "most_in_a_second": peak,
        "stretch_bytes_a_robot_and_s": each(seen.stretches.bytes),
        "commands_a_robot_and_s": each(seen.commands.messages),
        "command_bytes": each(seen.commands.bytes),
        "reports_a_robot_and_s": each(seen.reports.messages),
        "report_bytes": each(seen.reports.bytes),
        "controller_cpu_s": controller_s,
        "broker_cpu_s": broker_s,
        "robots_cpu_s": robots_s,
        "steps_left_out": seen.left_out,
    }))
}

/// A show of two alternating crowds, one a turned copy of the other, so that all robots drive.
fn show(count: usize) -> Show {
    let across = (count as f64).sqrt().ceil() as usize;
    let side_m = across as f64 * SPACING_M * 1.5 + 1.0;
    let frame = |number: usize| {
        let turn = Vec2::unit(0.7 * (number % 2) as f64);
        let pixel = |id: usize| {
            let middle = (across - 1) as f64 / 2.0;
            let [u, v] = [(id % across) as f64 - middle, (id / across) as f64 - middle];
            let at = (turn * u + turn.left() * v) * SPACING_M;
            Pixel { id: id as u32, at, color: Rgb::new(255, 80, 0), ..Pixel::default() }
        };
        let pixels = (0..count).map(pixel).collect();
        Frame { name: format!("Frame {number}"), air_time_s: AIR_S, pixels, ..Frame::default() }
    };
    let frames: Vec<Frame> = (0..FRAMES).map(frame).collect();
    let starts = frames[1].pixels.iter().map(|pixel| pixel.at).collect();
    let stage = Stage { width_m: side_m, depth_m: side_m, ..Stage::default() };
    Show { name: "Light".into(), stage, starts: Some(starts), frames, layers: layers(), ..Show::default() }
}

/// Three layers: a rainbow, and over it a chase and a twinkle.
fn layers() -> Vec<Layer> {
    let layer = |kind: &str, settings: Vec<(&str, Setting)>| {
        let settings = settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        Layer { name: kind.into(), kind: kind.into(), span: LayerSpan::Show, settings }
    };
    let added = || {
        let rising = ["#000000", "#ffffff"].map(|text| Setting::Text(text.into())).to_vec();
        vec![("palette", Setting::List(rising)), ("blend", Setting::Text("add".into()))]
    };
    vec![
        layer("rainbow", vec![("speed_hz", Setting::Number(0.2))]),
        layer("chase", added()),
        layer("twinkle", added()),
    ]
}

/// Starts the controller, which plays the show once all robots are ready.
fn play(broker: &BrokerUrl, show: &Path, log: &Path, robots: usize) -> Outcome<Child> {
    let mut command = Command::new(program()?);
    command.arg("play").arg(show).args(["--json", "--broker", &broker.to_string()]);
    command.args(["--wait", &robots.to_string(), "--patience", "120", "--record"]).arg(log);
    Ok(command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?)
}

impl Robots {
    fn start(broker: &BrokerUrl, show: &Show) -> Outcome<Self> {
        let starts = show.starts.clone().unwrap_or_default();
        let config =
            FleetConfig { stage: show.stage.clone(), starts, seed: 7, conditions: Conditions::default() };
        let fleet = Fleet::new(&config);
        let ids = fleet.ids();
        let (news, heard) = mpsc::channel(65_536);
        let mut senders = Vec::new();
        for (index, id) in ids.iter().enumerate() {
            let filters = vec![Topic::Broadcast.write().to_string(), Topic::Robot(*id).write().to_string()];
            let client_id = robot_client_id(id);
            let mut link =
                Link::open(LinkConfig { broker: broker.clone(), client_id, filters, queue: 1_024 });
            senders.push(link.sender());
            let news = news.clone();
            tokio::spawn(async move {
                while let Some(event) = link.next().await {
                    if news.send((index, event)).await.is_err() {
                        return;
                    }
                }
            });
        }
        Ok(Self { began: Moment::now(), fleet, ids, senders, heard })
    }

    fn now_us(&self) -> u64 {
        self.began.elapsed().as_micros() as u64
    }

    /// Runs the robots until the controller ends. Returns the controller's processor time, seconds.
    async fn run(&mut self, play: &mut Child, broker: &BrokerUrl, seen: &mut Seen) -> Outcome<f64> {
        let asker = RobotId::new("clock").ok_or("a name")?;
        let filters = vec![Topic::Robot(asker).write().to_string()];
        let client_id = robot_client_id(&asker);
        let mut clock = Link::open(LinkConfig { broker: broker.clone(), client_id, filters, queue: 64 });
        let (mut sample_at, mut ask_at) = (Moment::now(), Moment::now());
        let (mut batch, mut controller_s) = (Vec::new(), 0.0);
        while play.try_wait()?.is_none() {
            let step = Duration::from_micros(self.fleet.advance_at().0);
            tokio::select! {
                _ = self.heard.recv_many(&mut batch, BATCH) => {
                    for (robot, event) in batch.drain(..) {
                        self.receive(robot, event, seen);
                    }
                }
                event = clock.next() => self.learn_clock(event, seen),
                () = tokio::time::sleep_until((self.began + step).into()) => {}
            }
            self.fleet.advance(Instant(self.now_us()));
            self.send(seen);
            let now = Moment::now();
            if now >= sample_at {
                seen.samples.push((self.now_us(), self.fleet.lights()));
                sample_at = now + SAMPLE;
            }
            if now >= ask_at {
                let mut text = String::new();
                TimeQuestion { id: asker, asked: Instant(self.now_us()) }.encode(&mut text)?;
                clock.sender().send(&Topic::Time.write(), text.into_bytes());
                ask_at = now + ASK;
                controller_s = f64::max(controller_s, processor_s(play.id()));
            }
        }
        seen.left_out = self.fleet.steps_left_out();
        Ok(controller_s)
    }

    fn receive(&mut self, robot: usize, event: LinkEvent, seen: &mut Seen) {
        let now = self.now_us();
        match event {
            LinkEvent::Connected => self.fleet.link_of(Instant(now), robot, true),
            LinkEvent::Disconnected { .. } => self.fleet.link_of(Instant(now), robot, false),
            LinkEvent::Message { topic, payload, .. } => {
                if !matches!(Topic::parse(&topic), Some(Topic::Broadcast)) || robot == 0 {
                    seen.commands.count(topic.len() + payload.len());
                }
                if payload.windows(6).any(|six| six == b"|LIGHT") {
                    seen.stretches.count(topic.len() + payload.len());
                    let second = (now / 1_000_000) as usize;
                    if seen.in_second.len() <= second {
                        seen.in_second.resize(second + 1, 0);
                    }
                    seen.in_second[second] += 1;
                }
                self.fleet.receive_on(Instant(now), robot..robot + 1, &topic, &payload);
            }
        }
    }

    fn send(&mut self, seen: &mut Seen) {
        while let Some(message) = self.fleet.next_message() {
            let topic = message.topic.write();
            seen.reports.count(topic.len() + message.payload.len());
            self.senders[message.robot].send(&topic, message.payload);
        }
    }

    /// Takes an answer about the show clock into account. It holds for the middle of the round trip.
    fn learn_clock(&self, event: Option<LinkEvent>, seen: &mut Seen) {
        let Some(LinkEvent::Message { payload, .. }) = event else { return };
        let now = self.now_us();
        for command in commands(&payload).flatten() {
            let lightbots_wire::Command::Time(answer) = command else { continue };
            let took = now.saturating_sub(answer.asked.0);
            let offset = answer.received.0 as i64 - (answer.asked.0 + took / 2) as i64;
            if seen.offset.is_none_or(|(least, _)| took < least) {
                seen.offset = Some((took, offset));
            }
        }
    }
}

/// Compares the samples with the layers, as the controller played them in the recording.
fn compare(log: &[u8], ids: &[RobotId], seen: &Seen) -> Outcome<LightCounts> {
    let (took, offset) = seen.offset.ok_or("the controller did not say the show clock")?;
    eprintln!("show clock known to {:.2} ms", took as f64 / 2e3);
    let mut by_id: Vec<(RobotId, usize)> = ids.iter().copied().zip(0..).collect();
    by_id.sort_unstable();
    let mut watch = LightWatch::new(Config::default().light_tolerance);
    let mut samples = seen.samples.iter().peekable();
    replay_observed(log, &mut |_| {}, &mut |now, controller, _| {
        while let Some((at, lights)) = samples.next_if(|(at, _)| at.saturating_add_signed(offset) <= now.0) {
            let moment = Instant(at.saturating_add_signed(offset));
            if now - moment < Span::from_millis(20) {
                watch.compare(controller, moment, |id| {
                    let place = by_id.binary_search_by_key(&id, |entry| entry.0).ok()?;
                    lights.get(by_id[place].1).copied()
                });
            }
        }
    })
    .map_err(|error| error.to_string())?;
    Ok(watch.counts())
}

/// Processor time that a process has used, seconds. 0 if it has ended.
fn processor_s(process: u32) -> f64 {
    let line = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // The name in brackets may contain spaces. User and system time are fields 14 and 15.
    let fields = line.rsplit_once(')').map_or("", |(_, rest)| rest).split_whitespace();
    let ticks: Vec<f64> = fields.skip(11).take(2).filter_map(|field| field.parse().ok()).collect();
    ticks.iter().sum::<f64>() / TICKS
}
