//! The embedded broker as a child process: started, watched, and started again when it dies.
//!
//! The parent writes one line of JSON, [`ChildSettings`], to the child's stdin and keeps the stdin open. When the
//! parent ends, however it ends, the child's stdin ends, and the child ends with it. The child writes a
//! [`ChildMessage`] per line to stdout. Passwords never stand on a command line, where every user of the machine could
//! read them.

use std::net::{IpAddr, SocketAddr};
use std::process::{ExitStatus, Stdio};
use std::time::{Duration, Instant};

use lightbots_link::{BrokerUrl, random_id};
use serde::{Deserialize, Serialize};
use tokio::io::{AsyncBufReadExt, AsyncWriteExt, BufReader, Lines};
use tokio::process::{Child, ChildStdin, ChildStdout, Command};
use tokio::sync::mpsc;

use super::users::{Role, Users};
use super::{BrokerOptions, Engine};
use crate::failure::{Failure, Outcome};
use crate::own_program::own_program;

/// Longest time for the child to listen, or to report why it cannot.
const START_WITHIN: Duration = Duration::from_secs(20);
/// Pause before the child is started again. It doubles, up to [`LONGEST_PAUSE`], while the child keeps dying. The
/// child's start takes about 10 ms more, so that the broker is usually away for less than one second.
const FIRST_PAUSE: Duration = Duration::from_millis(50);
/// Longest pause before the child is started again.
const LONGEST_PAUSE: Duration = Duration::from_millis(800);
/// Lifetime of a child after which the next pause is `FIRST_PAUSE` again, because its death then has a new reason.
const STABLE: Duration = Duration::from_secs(10);
/// Most lines that wait to be shown; further ones are dropped.
const NOTICES: usize = 64;
/// Arguments that start the child process: the command, and the option that makes it the child.
const COMMAND: [&str; 2] = ["broker", "--child"];

/// Settings that the parent sends to the child.
#[derive(Debug, Serialize, Deserialize)]
pub struct ChildSettings(pub BrokerOptions);

/// A message from the child to the parent.
#[derive(Debug, Serialize, Deserialize)]
pub enum ChildMessage {
    /// The broker listens on these addresses.
    Listening { plain: SocketAddr, tls: Option<SocketAddr> },
    /// The broker cannot start: a line for people and the exit code.
    Failed { line: String, code: i32 },
    /// A line for the screen's log.
    Notice(String),
}

/// A broker in a child process. The child ends when this value is dropped.
#[derive(Debug)]
pub struct EmbeddedBroker {
    address: SocketAddr,
    tls_address: Option<SocketAddr>,
    /// User and password of this program itself; `None` if the broker has no users.
    login: Option<(String, String)>,
    notices: Option<mpsc::Receiver<String>>,
    watch: tokio::task::JoinHandle<()>,
}

impl EmbeddedBroker {
    /// Starts the child and waits until it listens. The failure says why it does not.
    pub async fn start(options: BrokerOptions) -> Result<Self, Failure> {
        let (users, login) = with_this_program(options.users);
        let mut options = BrokerOptions { users, ..options };
        let (running, address, tls_address) = Running::start(&options).await?;
        // A child that is started again must use the same ports.
        options.listen = address;
        if let (Some(tls), Some(address)) = (&mut options.tls, tls_address) {
            tls.listen = address;
        }
        let (sender, notices) = mpsc::channel(NOTICES);
        let watch = tokio::spawn(watch(running, options, sender));
        Ok(Self { address, tls_address, login, notices: Some(notices), watch })
    }

    /// Address and login of the broker for this program's own connections.
    pub fn url(&self) -> BrokerUrl {
        let ip = match self.address.ip() {
            ip if !ip.is_unspecified() => ip.to_string(),
            IpAddr::V4(_) => "127.0.0.1".into(),
            IpAddr::V6(_) => "::1".into(),
        };
        let (user, password) = self.login.clone().unzip();
        BrokerUrl::new(ip, self.address.port()).with_login(user, password)
    }

    /// Address for MQTT with TLS; `None` without TLS.
    pub fn tls_address(&self) -> Option<SocketAddr> {
        self.tls_address
    }

    /// Returns the receiver of lines about refused clients and restarts of the broker. `None` after the first call.
    pub fn notices(&mut self) -> Option<mpsc::Receiver<String>> {
        self.notices.take()
    }
}

impl Drop for EmbeddedBroker {
    fn drop(&mut self) {
        // The task holds the child, which is killed with it.
        self.watch.abort();
    }
}

/// If there are users, adds one for this program itself, a controller. Returns all users, and the name and password of the
/// added one.
fn with_this_program(users: Users) -> (Users, Option<(String, String)>) {
    if users.is_empty() {
        return (users, None);
    }
    let (name, password) = (format!("lightbots-{}", random_id()), random_id().to_string());
    (users.with(&name, &password, Role::Controller), Some((name, password)))
}

/// Passes on the notices of the child, and starts the child again whenever it has died.
async fn watch(mut running: Running, options: BrokerOptions, notices: mpsc::Sender<String>) {
    let mut pause = FIRST_PAUSE;
    loop {
        let began = Instant::now();
        let how = running.relay(&notices).await;
        if began.elapsed() > STABLE {
            pause = FIRST_PAUSE;
        }
        let line = format!("The broker {how}. It is started again; robots reconnect by themselves.");
        tracing::error!("{line}");
        let _ = notices.try_send(line);
        running = loop {
            tokio::time::sleep(pause).await;
            pause = (pause * 2).min(LONGEST_PAUSE);
            match Running::start(&options).await {
                Ok((running, ..)) => break running,
                Err(failure) => {
                    tracing::error!("{}", failure.line);
                    let _ = notices.try_send(format!("The broker does not start again: {}.", failure.line));
                }
            }
        };
    }
}

/// A child process that listens.
struct Running {
    child: Child,
    words: Lines<BufReader<ChildStdout>>,
    /// The child ends when this is dropped.
    _order: ChildStdin,
}

impl Running {
    async fn start(options: &BrokerOptions) -> Result<(Self, SocketAddr, Option<SocketAddr>), Failure> {
        let failed = |why: String| Failure::problem(format!("the broker's process does not start: {why}"));
        let mut child = Command::new(own_program())
            .args(COMMAND)
            .args(["--log", crate::logging::level()])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .kill_on_drop(true)
            .spawn()
            .map_err(|error| failed(error.to_string()))?;
        let (Some(mut order), Some(out)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(failed("it has no pipes".into()));
        };
        let mut line =
            serde_json::to_vec(&ChildSettings(options.clone())).map_err(|error| failed(error.to_string()))?;
        line.push(b'\n');
        order.write_all(&line).await.map_err(|error| failed(error.to_string()))?;
        let mut running = Self { child, words: BufReader::new(out).lines(), _order: order };
        match tokio::time::timeout(START_WITHIN, running.word()).await {
            Ok(Some(ChildMessage::Listening { plain, tls })) => Ok((running, plain, tls)),
            Ok(Some(ChildMessage::Failed { line, code })) => Err(Failure { line, code }),
            Ok(Some(ChildMessage::Notice(line))) => Err(failed(line)),
            Ok(None) => Err(failed(running.end().await)),
            Err(_) => Err(failed(format!("it says nothing for {} s", START_WITHIN.as_secs()))),
        }
    }

    /// Passes on notices until the child's output ends, then ends the child. Returns how it ended.
    async fn relay(&mut self, notices: &mpsc::Sender<String>) -> String {
        while let Some(word) = self.word().await {
            if let ChildMessage::Notice(line) = word {
                // Without a reader the line is dropped.
                let _ = notices.try_send(line);
            }
        }
        self.end().await
    }

    async fn word(&mut self) -> Option<ChildMessage> {
        loop {
            let line = self.words.next_line().await.ok()??;
            match serde_json::from_str(&line) {
                Ok(word) => return Some(word),
                Err(error) => tracing::debug!("the broker's process says '{line}': {error}"),
            }
        }
    }

    async fn end(&mut self) -> String {
        // A child whose output has ended is of no use, even if it still runs.
        let _ = self.child.start_kill();
        self.child.wait().await.map_or_else(|error| error.to_string(), ending)
    }
}

fn ending(status: ExitStatus) -> String {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return format!("was ended by signal {signal}");
    }
    status.code().map_or_else(|| "ended".into(), |code| format!("ended with code {code}"))
}

/// Runs the child process: reads its settings from stdin, then serves until its stdin ends or brings a further line.
pub async fn child() -> Outcome {
    let mut orders = BufReader::new(tokio::io::stdin()).lines();
    let order = orders.next_line().await.ok().flatten().unwrap_or_default();
    let ChildSettings(options) = serde_json::from_str(&order).map_err(|error| {
        Failure::input(format!("--child takes its order from a running lightbots: {error}"))
    })?;
    let mut engine = match Engine::start(options) {
        Ok(engine) => engine,
        Err(Failure { line, code }) => {
            tell(&ChildMessage::Failed { line, code });
            return Ok(false);
        }
    };
    tell(&ChildMessage::Listening { plain: engine.address(), tls: engine.tls_address() });
    let notices = engine.notices();
    let relay = async {
        if let Some(mut notices) = notices {
            while let Some(line) = notices.recv().await {
                tell(&ChildMessage::Notice(line));
            }
        }
        std::future::pending::<()>().await;
    };
    tokio::select! {
        () = relay => {}
        _ = orders.next_line() => {}
    }
    Ok(true)
}

fn tell(word: &ChildMessage) {
    if let Ok(line) = serde_json::to_string(word) {
        crate::say::line(&line);
    }
}
