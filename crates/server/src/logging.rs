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

/// The level that was chosen on the command line.
static LEVEL: std::sync::OnceLock<Log> = std::sync::OnceLock::new();

/// Returns the log level as an argument for a program that this one starts.
pub fn level() -> &'static str {
    match LEVEL.get() {
        Some(Log::Off) => "off",
        Some(Log::Error) => "error",
        Some(Log::Info) => "info",
        Some(Log::Debug) => "debug",
        Some(Log::Warn) | None => "warn",
    }
}

/// Starts logging to stderr. Of the broker and other libraries, less is logged than of this program, because the broker
/// reports ordinary disconnects as important.
pub fn start(log: Log) {
    // A second call keeps the first level.
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
    // A second call in one process keeps the first logger.
    let _ = tracing_subscriber::registry().with(targets).with(lines).try_init();
}
