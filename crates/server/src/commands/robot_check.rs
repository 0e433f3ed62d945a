//! `robot-check`: examines whether a robot on a broker keeps the protocol.

mod verdicts;

use std::io::{BufRead, IsTerminal};
use std::time::Duration;

use lightbots_exam::{Ending, Exam, ExamEvent, Options, Question};
use lightbots_link::{BrokerUrl, Link, LinkEvent};
use tokio::sync::oneshot;

use crate::cli::RobotCheckArguments;
use crate::failure::{Failure, Outcome};
use crate::live::clock::Clock;
use crate::live::controller_link;
use crate::say;
use crate::stop::Stop;

/// Without a terminal for questions: time to read the notice and press Ctrl-C before the robot drives.
const COUNTDOWN: Duration = Duration::from_secs(5);

pub async fn run(arguments: RobotCheckArguments, stop: Stop) -> Outcome {
    stop.take_over();
    let broker = arguments.login.broker(&arguments.broker)?;
    let mut link = Link::open(controller_link(broker.clone()));
    let examined = tokio::select! {
        connected = connect(&mut link, &broker, arguments.patience) => match connected {
            Ok(()) => Examination::new(&arguments, link).run(&stop).await,
            Err(failure) => Err(failure),
        },
        () = stop.wait() => Err(Failure::problem("stopped")),
    };
    verdicts::tell(examined, &broker, arguments.json)
}

/// Waits until the link is connected to the broker. Error after `patience_s` seconds.
async fn connect(link: &mut Link, broker: &BrokerUrl, patience_s: u32) -> Result<(), Failure> {
    let mut reason = None;
    let patience = tokio::time::sleep(Duration::from_secs(patience_s.into()));
    tokio::pin!(patience);
    loop {
        tokio::select! {
            event = link.next() => match event {
                Some(LinkEvent::Connected) => return Ok(()),
                Some(LinkEvent::Disconnected { reason: why }) => reason = Some(why),
                Some(LinkEvent::Message { .. }) => {}
                None => return Err(Failure::problem("the connection was closed")),
            },
            () = &mut patience => {
                let no_answer = || format!("no broker answers at {broker} within {patience_s} s: check the address");
                return Err(Failure::problem(reason.unwrap_or_else(no_answer)));
            }
        }
    }
}

/// One exam on a real broker.
struct Examination {
    exam: Exam,
    link: Link,
    clock: Clock,
    yes: bool,
    /// Receives the answer of the person at the terminal; `None` if no answer is awaited.
    answer: Option<oneshot::Receiver<String>>,
    /// Whether the awaited answer is about the robot's light. Otherwise it confirms that the robot may drive.
    is_look: bool,
    /// End of the countdown to the drive, if there is no terminal to ask at. `None`: no countdown is running.
    go_at: Option<tokio::time::Instant>,
}

impl Examination {
    fn new(arguments: &RobotCheckArguments, link: Link) -> Self {
        let options = Options { robot: arguments.robot, floor: arguments.floor, looks: arguments.look };
        Self {
            exam: Exam::new(options),
            link,
            clock: Clock::start(),
            yes: arguments.yes,
            answer: None,
            is_look: false,
            go_at: None,
        }
    }

    /// Runs the whole exam with the robot and returns the exam.
    async fn run(mut self, stop: &Stop) -> Result<Exam, Failure> {
        self.exam.connected(self.clock.now());
        let ended = loop {
            self.drain();
            if self.exam.ending().is_some() {
                break Ok(());
            }
            let alarm = self.exam.wake_at().map(|at| self.clock.deadline(at));
            tokio::select! {
                () = stop.wait() => break Err(self.stopped()),
                event = self.link.next() => match event {
                    Some(LinkEvent::Message { topic, payload, .. }) => {
                        self.exam.message(self.clock.now(), &topic, &payload);
                    }
                    Some(LinkEvent::Connected) => {}
                    Some(LinkEvent::Disconnected { reason }) => break Err(Failure::problem(reason)),
                    None => break Err(Failure::problem("the connection was closed")),
                },
                answer = answer(&mut self.answer) => self.take(answer),
                () = sleep_until(self.go_at) => self.go(),
                () = sleep_until(alarm) => self.exam.wake(self.clock.now()),
            }
        };
        if ended.is_err() {
            self.exam.give_up();
        }
        self.drain();
        self.link.close().await;
        ended.and_then(|()| named(self.exam))
    }

    fn stopped(&self) -> Failure {
        Failure::problem(match self.exam.robot() {
            Some(_) => "stopped before the end; the robot was told to stand",
            None => "stopped before a robot was found",
        })
    }

    /// Sends the exam's messages and prints its notices.
    fn drain(&mut self) {
        let sender = self.link.sender();
        while let Some(send) = self.exam.next_publish() {
            sender.send(&send.topic, send.payload);
        }
        while let Some(event) = self.exam.next_event() {
            match event {
                ExamEvent::Doing(what) => say::note(&format!("... {what}")),
                ExamEvent::Ready { robot, at: Some(at), towards: Some(towards) } => {
                    say::note(&format!(
                        "{robot} stands at ({:.2}, {:.2}) and will drive towards ({:.2}, {:.2}) and back, for up to two \
                         minutes. Leave 0.5 m around it free; no other controller may speak meanwhile.",
                        at.x, at.y, towards.x, towards.y
                    ));
                    self.ask_to_go();
                }
                ExamEvent::Ready { .. } => self.go(),
                ExamEvent::Look(question) => self.ask_to_look(&question),
            }
        }
    }

    fn ask_to_go(&mut self) {
        if self.yes {
            self.go();
        } else if std::io::stdin().is_terminal() {
            say::note("Press Enter to begin, Ctrl-C to stop.");
            (self.answer, self.is_look) = (Some(read_line()), false);
        } else {
            say::note(&format!("It begins in {} s; Ctrl-C stops it.", COUNTDOWN.as_secs()));
            self.go_at = Some(tokio::time::Instant::now() + COUNTDOWN);
        }
    }

    fn ask_to_look(&mut self, question: &Question) {
        say::note(&format!("{} [y/n]", question.text));
        (self.answer, self.is_look) = (Some(read_line()), true);
    }

    fn take(&mut self, line: Option<String>) {
        self.answer = None;
        if !self.is_look {
            return self.go();
        }
        let yes = line.and_then(|line| match line.trim().to_lowercase().chars().next() {
            Some('y' | 'j') => Some(true),
            Some('n') => Some(false),
            _ => None,
        });
        self.exam.answer(self.clock.now(), yes);
    }

    fn go(&mut self) {
        self.go_at = None;
        self.exam.go(self.clock.now());
    }
}

/// Returns the finished exam if exactly one robot was examined, else an error.
fn named(exam: Exam) -> Result<Exam, Failure> {
    match exam.ending() {
        Some(Ending::Several(names)) => {
            let list: Vec<&str> = names.iter().take(10).map(|id| id.as_str()).collect();
            let more = if names.len() > list.len() { " …" } else { "" };
            Err(Failure::input(format!(
                "{} robots are on this broker: say which with --robot ID: {}{more}",
                names.len(),
                list.join(", ")
            )))
        }
        Some(Ending::NoRobot) => Err(Failure::problem(
            "no such robot speaks on this broker: is it switched on, and subscribed to T/LightBot/Broadcast?",
        )),
        _ => Ok(exam),
    }
}

/// Reads a line from the terminal on a separate thread, so that the exam continues meanwhile.
fn read_line() -> oneshot::Receiver<String> {
    let (sender, line) = oneshot::channel();
    std::thread::spawn(move || {
        let mut line = String::new();
        if std::io::stdin().lock().read_line(&mut line).is_ok_and(|bytes| bytes > 0) {
            // The receiver may be gone.
            let _ = sender.send(line);
        }
    });
    line
}

/// Waits for the answer; `None` if the input has ended. Waits for ever if no answer is awaited.
async fn answer(awaited: &mut Option<oneshot::Receiver<String>>) -> Option<String> {
    match awaited {
        Some(line) => line.await.ok(),
        None => std::future::pending().await,
    }
}

async fn sleep_until(moment: Option<tokio::time::Instant>) {
    match moment {
        Some(moment) => tokio::time::sleep_until(moment).await,
        None => std::future::pending().await,
    }
}
