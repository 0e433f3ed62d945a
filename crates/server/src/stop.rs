//! Handles Ctrl-C, TERM and HUP, the signal of a closed terminal. The handlers are installed before anything else.
//! Without a handler, a signal would end the program before robots receive STOP.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

use tokio::sync::watch;

/// Phase in which nothing runs that must be stopped: a signal ends the program.
const STARTING: u8 = 0;
/// Phase in which a command without robots computes: a signal ends the program.
const COMPUTING: u8 = 1;
/// Phase in which a command waits by [`Stop::wait`]: the first signal requests a stop.
const RUNNING: u8 = 2;

/// Tells the program, or the part of it that has this value, when to stop. If a signal has requested the stop of the
/// program, a second signal ends it at once.
#[derive(Clone, Debug)]
pub struct Stop {
    wanted: watch::Receiver<bool>,
    phase: Arc<AtomicU8>,
}

impl Stop {
    /// Installs the signal handlers. Must be called in the runtime.
    pub fn install() -> Self {
        let (sender, wanted) = watch::channel(false);
        let phase = Arc::new(AtomicU8::new(STARTING));
        let signals = Signals::install();
        tokio::spawn(listen(signals, sender, phase.clone()));
        Self { wanted, phase }
    }

    /// Runs a computation. From its start until [`Stop::take_over`], a signal ends the program at once.
    pub fn at_once<T>(&self, compute: impl FnOnce() -> T) -> T {
        self.phase.store(COMPUTING, Ordering::Release);
        tokio::task::block_in_place(compute)
    }

    /// From this call on, the first signal does not end the program, but makes [`Stop::wait`] return.
    pub fn take_over(&self) {
        self.phase.store(RUNNING, Ordering::Release);
    }

    /// Waits until a stop is requested: by a signal, or for a [`Stop::child`] or [`Stop::apart`] by its [`End`].
    pub async fn wait(&self) {
        let mut wanted = self.wanted.clone();
        // The sender lives as long as the program.
        let _ = wanted.wait_for(|wanted| *wanted).await;
    }

    /// Returns a `Stop` that is requested when this one is, or earlier by the returned [`End`].
    pub fn child(&self) -> (Self, End) {
        let (child, end) = self.apart();
        let (sender, parent) = (end.0.clone(), self.clone());
        tokio::spawn(async move {
            tokio::select! {
                () = parent.wait() => {
                    sender.send_replace(true);
                }
                () = sender.closed() => {}
            }
        });
        (child, end)
    }

    /// Returns a `Stop` that is requested only by the returned [`End`]. The caller must keep the [`End`], because dropping
    /// it makes [`Stop::wait`] return, too.
    pub fn apart(&self) -> (Self, End) {
        let (sender, wanted) = watch::channel(false);
        (Self { wanted, phase: self.phase.clone() }, End(sender))
    }

    /// Whether a stop has been requested.
    pub fn is_wanted(&self) -> bool {
        *self.wanted.borrow()
    }
}

/// Requests the stop of a [`Stop::child`] or [`Stop::apart`].
#[derive(Debug)]
pub struct End(watch::Sender<bool>);

impl End {
    /// Requests the stop.
    pub fn now(self) {
        self.0.send_replace(true);
    }
}

async fn listen(mut signals: Signals, sender: watch::Sender<bool>, phase: Arc<AtomicU8>) {
    loop {
        signals.next().await;
        match phase.load(Ordering::Acquire) {
            STARTING => std::process::exit(0),
            COMPUTING => std::process::exit(130),
            _ if *sender.borrow() => std::process::exit(130),
            _ => sender.send_replace(true),
        };
    }
}

#[cfg(unix)]
struct Signals {
    interrupt: Option<tokio::signal::unix::Signal>,
    terminate: Option<tokio::signal::unix::Signal>,
    /// The HUP signal. `None` if it cannot be handled, or if Linux reports that the program was started with HUP
    /// ignored, as `nohup` does.
    hang_up: Option<tokio::signal::unix::Signal>,
}

#[cfg(unix)]
impl Signals {
    fn install() -> Self {
        use tokio::signal::unix::{SignalKind, signal};
        let hang_up = if ignores_hang_up() { None } else { signal(SignalKind::hangup()).ok() };
        Self {
            interrupt: signal(SignalKind::interrupt()).ok(),
            terminate: signal(SignalKind::terminate()).ok(),
            hang_up,
        }
    }

    async fn next(&mut self) {
        async fn of(signal: &mut Option<tokio::signal::unix::Signal>) {
            let came = match signal {
                Some(signal) => signal.recv().await.is_some(),
                None => false,
            };
            if !came {
                std::future::pending().await
            }
        }
        tokio::select! {
            () = of(&mut self.interrupt) => {}
            () = of(&mut self.terminate) => {}
            () = of(&mut self.hang_up) => {}
        }
    }
}

/// Whether this process was started with HUP ignored. Only Linux reports that without unsafe code; on other systems, the
/// result is `false`.
#[cfg(unix)]
fn ignores_hang_up() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    // Bit 0 is signal 1, HUP.
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & 1 == 1)
}

#[cfg(not(unix))]
struct Signals;

#[cfg(not(unix))]
impl Signals {
    fn install() -> Self {
        Self
    }

    async fn next(&mut self) {
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    }
}
