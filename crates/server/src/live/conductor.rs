//! The conductor: the task that owns the controller core. It passes clock times and broker messages to the core, and
//! the outputs of the core to the broker and to listeners.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use lightbots_control::{
    Config, Controller, ControllerState, Operation, PlanRequest, PlanResult, RecordedController, Refusal,
};
use lightbots_dmx::LivePublish;
use lightbots_lighting::LampSettings;
use lightbots_link::{Link, LinkEvent};
use lightbots_wire::Topic;
use tokio::sync::{broadcast, mpsc};

use super::clock::{Clock, seq_base};
use super::controller_link;
use super::cue_topic;
use super::orders::ConductorOrder;
use super::pace::Pace;
use super::recorder::{Recorder, RecordingTarget};
use super::rivals::{self, Rivals};
use crate::say;
use crate::stop::Stop;

pub use super::handle::Handle;
pub use super::link_state::{LinkPhase, LinkState};
pub use super::orders::News;

/// Most orders that wait for the conductor. The sender of a further order waits until there is room.
const ORDERS: usize = 256;
/// Number of news items by which a slow listener may lag before it misses the oldest. Room for one event of each robot of a
/// large fleet.
const EVENTS: usize = 16_384;
/// Most link events that are handled before the controller's messages are sent and other inputs get a turn.
const BATCH: usize = 512;

impl Handle {
    /// Starts a conductor with this show clock, for robots with these lamps. Once `stop` is wanted, the conductor stops the
    /// robots of a run and ends. The caller must wait for the returned task before the program ends.
    pub fn start(
        recording: RecordingTarget,
        (clock, lamp): (Clock, LampSettings),
        stop: Stop,
    ) -> (Self, tokio::task::JoinHandle<()>) {
        let (orders, inbox) = mpsc::channel(ORDERS);
        let (news, _) = broadcast::channel(EVENTS);
        let config = Config { seq_base: seq_base(), lamp, ..Config::default() };
        let (done_sender, done) = mpsc::channel(4);
        let pace = Arc::new(Pace::default());
        let mut controller = RecordedController::new(Controller::new(config));
        let recorder = Recorder::new(recording, &mut controller, clock.now());
        let reports = recorder.reports();
        let conductor = Conductor {
            recorder,
            controller,
            clock: clock.clone(),
            pace: pace.clone(),
            planning: None,
            next_job: None,
            link: None,
            nodes: Vec::new(),
            state: LinkState::default(),
            rivals: Rivals::new(String::new()),
            inbox,
            overheard: None,
            news: news.clone(),
            done,
            done_sender,
        };
        let task = tokio::spawn(conductor.run(stop));
        (Self::new(orders, news, clock, pace, reports), task)
    }
}

struct Conductor {
    controller: RecordedController,
    recorder: Recorder,
    clock: Clock,
    pace: Arc<Pace>,
    /// Set to true to cancel the plan that is being made. `None` while no plan is being made.
    planning: Option<Arc<AtomicBool>>,
    /// The newest plan request. It waits until the plan that is being made is done or cancelled. Older waiting requests are
    /// dropped.
    next_job: Option<PlanRequest>,
    link: Option<Link>,
    /// Addresses of the broker, in the order in which the link numbers them.
    nodes: Vec<String>,
    state: LinkState,
    rivals: Rivals,
    inbox: mpsc::Receiver<ConductorOrder>,
    overheard: Option<mpsc::Sender<Vec<u8>>>,
    news: broadcast::Sender<News>,
    done: mpsc::Receiver<Option<PlanResult>>,
    done_sender: mpsc::Sender<Option<PlanResult>>,
}

/// What a conductor waits for.
enum Input {
    Link(LinkEvent),
    Order(ConductorOrder),
    Planned(Option<PlanResult>),
    Alarm,
}

impl Conductor {
    async fn run(mut self, stop: Stop) {
        loop {
            let input = tokio::select! {
                () = stop.wait() => break,
                input = self.input() => input,
            };
            self.turn(input).await;
        }
        self.end().await;
    }

    /// Waits for the next input. Cancel-safe.
    async fn input(&mut self) -> Input {
        let speaks = self.state.is_connected().then(|| self.rivals.speak_at());
        let wakes = [self.controller.wake_at(), speaks].into_iter().flatten().min();
        let alarm = wakes.map(|at| self.clock.deadline(at));
        tokio::select! {
            Some(event) = next_of(&mut self.link) => Input::Link(event),
            Some(order) = self.inbox.recv() => Input::Order(order),
            Some(done) = self.done.recv() => Input::Planned(done),
            () = sleep_until(alarm) => Input::Alarm,
        }
    }

    async fn turn(&mut self, input: Input) {
        match input {
            Input::Link(event) => self.take(event),
            Input::Order(order) => self.obey(order).await,
            Input::Planned(done) => {
                self.planning = None;
                if let Some(done) = done {
                    self.controller.planned(self.clock.now(), done);
                }
            }
            Input::Alarm => self.controller.wake(self.clock.now()),
        }
        self.drain();
    }

    /// Handles `first` and further events of the link that wait already, at most `BATCH` in total.
    fn take(&mut self, first: LinkEvent) {
        self.hear(first);
        for _ in 1..BATCH {
            let Some(event) = self.link.as_mut().and_then(Link::try_next) else { break };
            self.hear(event);
        }
    }

    fn hear(&mut self, event: LinkEvent) {
        let now = self.clock.now();
        match event {
            LinkEvent::Connected => {
                self.rivals.connected();
                self.controller.connected(now);
                self.tell_link(LinkPhase::Connected, None);
            }
            LinkEvent::Disconnected { reason } => {
                if self.state.is_connected() {
                    self.controller.disconnected(now);
                }
                self.tell_link(LinkPhase::Retrying, Some(reason));
            }
            LinkEvent::Message { topic, payload, retained } if topic == cue_topic::CUE => {
                if !retained && cue_topic::is_go(&payload) {
                    self.go(now);
                }
            }
            LinkEvent::Message { topic, payload, .. }
                if [rivals::NAMES, rivals::COMMANDS].contains(&&*topic) =>
            {
                if let Some(line) = self.rivals.hear(now, &topic, &payload) {
                    tracing::warn!("{line}");
                    let _ = self.news.send(News::Warning(line));
                }
            }
            LinkEvent::Message { topic, payload, .. } => {
                self.pace.reports.hear(1);
                self.controller.message(now, &topic, &payload);
                if let Some(reports) = &self.overheard {
                    // A copy that finds no room is dropped: the robot reports again.
                    let _ = reports.try_send(payload);
                }
            }
        }
    }

    /// Makes the controller carry out an operation. If each run has its own log and the operation begins a run, first
    /// begins the log of the run.
    fn operate(&mut self, now: lightbots_base::Instant, operation: Operation) -> Result<(), Refusal> {
        self.recorder.before(&mut self.controller, now, &operation);
        self.controller.operate(now, operation)
    }

    /// Carries out a GO that came by MQTT. A refusal becomes a warning.
    fn go(&mut self, now: lightbots_base::Instant) {
        if let Err(refusal) = self.operate(now, Operation::Go) {
            let _ = self.news.send(News::Warning(format!("GO by MQTT was refused: {refusal}")));
        }
    }

    async fn obey(&mut self, order: ConductorOrder) {
        match order {
            ConductorOrder::Operate(operation, answer) => {
                let outcome = self.operate(self.clock.now(), operation);
                // The task that waits for the answer may have ended.
                let _ = answer.send(outcome);
            }
            ConductorOrder::Look(answer) => {
                let _ = answer.send(self.controller.snapshot(self.clock.now()));
            }
            ConductorOrder::TakeUp(run, on_return) => {
                let now = self.clock.now();
                if let Err(refusal) = self.recorder.take_up(&mut self.controller, now, (&run, on_return)) {
                    tracing::error!("the run that was cut off cannot go on: {refusal}");
                }
            }
            ConductorOrder::Publish(messages) => {
                for LivePublish { topic, payload } in messages {
                    self.publish(topic, payload);
                }
            }
            ConductorOrder::Overhear(reports) => self.overheard = Some(reports),
            ConductorOrder::Connect(broker) => {
                self.leave().await;
                self.state.address = broker.to_string();
                self.pace.controls(Some(broker.to_string()));
                self.nodes = broker.addresses.iter().map(ToString::to_string).collect();
                let mut config = controller_link(broker);
                self.rivals = Rivals::new(config.client_id.clone());
                config.filters.extend([rivals::NAMES, rivals::COMMANDS, cue_topic::CUE].map(str::to_owned));
                self.link = Some(Link::open(config));
                self.tell_link(LinkPhase::Connecting, None);
            }
            ConductorOrder::Disconnect => {
                self.leave().await;
                self.state.address.clear();
                self.pace.controls(None);
                self.tell_link(LinkPhase::Off, None);
            }
        }
    }

    /// Passes on the outputs of the controller: messages, events, plan requests, log and journal. While connected,
    /// publishes the controller's name when it is due, and renews the link if the broker no longer passes messages on.
    fn drain(&mut self) {
        if let Some(link) = &self.link {
            let (sender, now) = (link.sender(), self.clock.now());
            if self.state.is_connected()
                && let Some(name) = self.rivals.name_due(now)
            {
                sender.send(rivals::NAMES, name.as_bytes().to_vec());
                if self.rivals.is_mute(self.controller.robots()) {
                    link.renew();
                }
            }
        }
        while let Some(send) = self.controller.next_send() {
            self.publish(send.topic, send.payload);
        }
        self.pace.knows(self.controller.robots());
        while let Some(event) = self.controller.next_event() {
            tracing::info!("{}", event.kind);
            self.recorder.note(&event);
            // An event without a listener is dropped.
            let _ = self.news.send(News::Event(event));
        }
        self.plan();
        for line in self.recorder.keep(&mut self.controller) {
            tracing::warn!("{line}");
            let _ = self.news.send(News::Warning(line));
        }
    }

    /// Publishes a message. Without a link to a broker, the message is dropped.
    fn publish(&mut self, topic: Topic, payload: Vec<u8>) {
        let Some(link) = &self.link else { return };
        if topic == Topic::Broadcast {
            self.rivals.said(self.clock.now(), &payload);
        }
        let sent = link.sender().send(&topic.write(), payload);
        self.pace.commands.say(u64::from(sent && topic != Topic::Broadcast));
    }

    /// Takes the controller's plan requests and keeps only the newest. A new request cancels the plan that is being
    /// made. If no plan is being made, starts the newest one on a blocking thread.
    fn plan(&mut self) {
        while let Some(job) = self.controller.next_plan_request() {
            self.next_job = Some(job);
            // The plan under way is not wanted any more, and robots may wait for the new one.
            if let Some(old) = &self.planning {
                old.store(true, Ordering::Relaxed);
            }
        }
        let Some(job) = self.next_job.take_if(|_| self.planning.is_none()) else { return };
        let unwanted = Arc::new(AtomicBool::new(false));
        self.planning = Some(unwanted.clone());
        let answer = self.done_sender.clone();
        let (began, budget) = (Instant::now(), job.budget());
        let is_over = move || {
            unwanted.load(Ordering::Relaxed)
                || budget.is_some_and(|most| began.elapsed().as_micros() as i64 > most.0)
        };
        tokio::spawn(async move {
            // A plan that panicked must not keep later ones from being made.
            let done = tokio::task::spawn_blocking(move || job.run_unless(&is_over)).await.ok();
            // A conductor that has ended needs no plan.
            let _ = answer.send(done).await;
        });
    }

    fn tell_link(&mut self, phase: LinkPhase, reason: Option<String>) {
        let place = self
            .link
            .as_ref()
            .filter(|_| phase == LinkPhase::Connected)
            .map(|link| link.sender().address_index());
        let node = place.and_then(|place| self.nodes.get(place).cloned());
        self.state = LinkState { address: std::mem::take(&mut self.state.address), phase, node, reason };
        let _ = self.news.send(News::Link(self.state.clone()));
    }

    async fn leave(&mut self) {
        let Some(link) = self.link.take() else { return };
        if self.state.is_connected() {
            self.controller.disconnected(self.clock.now());
            self.state.phase = LinkPhase::Off;
        }
        link.close().await;
    }

    /// Stops the robots of a run, if one is under way, leaves the broker and closes the log. Waits until the robots
    /// have reported that they stand, or until the controller gives up waiting for them.
    async fn end(mut self) {
        let state = self.controller.state();
        if !matches!(state, ControllerState::Idle | ControllerState::Ready) {
            let now = self.clock.now();
            if let Err(refusal) = self.controller.operate(now, Operation::StopAll) {
                tracing::warn!("the robots could not be stopped: {refusal}");
            }
            if self.controller.state() == ControllerState::Aborting {
                say::note("Stopping the robots (Ctrl-C again leaves at once)");
            }
            self.drain();
        }
        // No further orders are accepted.
        self.inbox.close();
        while self.controller.state() == ControllerState::Aborting {
            match self.input().await {
                Input::Order(_) => {}
                input => self.turn(input).await,
            }
        }
        self.leave().await;
        let Self { recorder, mut controller, .. } = self;
        // On a blocking thread, because the disk may be slow.
        let _ = tokio::task::spawn_blocking(move || recorder.finish(&mut controller)).await;
    }
}

async fn next_of(link: &mut Option<Link>) -> Option<LinkEvent> {
    match link {
        Some(link) => link.next().await,
        None => std::future::pending().await,
    }
}

async fn sleep_until(alarm: Option<tokio::time::Instant>) {
    match alarm {
        Some(alarm) => tokio::time::sleep_until(alarm).await,
        None => std::future::pending().await,
    }
}

/// Returns the operation by which the controller opens a show.
pub fn open(show: lightbots_show::Show) -> Operation {
    Operation::Open(Arc::new(show))
}

/// Time between two polls of a waiting task.
pub const LOOK: Duration = Duration::from_millis(50);
