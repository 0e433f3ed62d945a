//! Log lines on stderr.

use clap::ValueEnum;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::util::SubscriberInitExt;

/// How much is logged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Log {
    /// Nothing.
    Off,
    /// What failed.
    Error,
    /// What is not as it should be.
    Warn,
    /// What happens.
    Info,
    /// All events, to look for a mistake.
    Debug,
}

/// What was chosen, in the command line's words.
static LEVEL: std::sync::OnceLock<Log> = std::sync::OnceLock::new();

/// How much this program logs, for a program that it starts.
pub fn level() -> &'static str {
    match LEVEL.get() {
        Some(Log::Off) => "off",
        Some(Log::Error) => "error",
        Some(Log::Info) => "info",
        Some(Log::Debug) => "debug",
        Some(Log::Warn) | None => "warn",
    }
}

/// Starts logging to stderr. The broker's own lines count one level less: it calls ordinary departures news.
pub fn start(log: Log) {
    // A second start keeps the first.
    let _ = LEVEL.set(log);
    let (ours, broker) = match log {
        Log::Off => (LevelFilter::OFF, LevelFilter::OFF),
        Log::Error => (LevelFilter::ERROR, LevelFilter::OFF),
        Log::Warn => (LevelFilter::WARN, LevelFilter::OFF),
        Log::Info => (LevelFilter::INFO, LevelFilter::WARN),
        Log::Debug => (LevelFilter::DEBUG, LevelFilter::INFO),
    };
    let targets = Targets::new().with_default(broker).with_target("lightbots", ours);
    let colours = std::io::IsTerminal::is_terminal(&std::io::stderr());
    let lines =
        tracing_subscriber::fmt::layer().with_writer(std::io::stderr).with_target(false).with_ansi(colours);
    // A second start in one process keeps the first, which is as good.
    let _ = tracing_subscriber::registry().with(targets).with(lines).try_init();
}
