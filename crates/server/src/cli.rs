//! The command line of the program. Scripts and CI rely on it.

mod backup;
mod certs;
mod desk;
mod lamps;
mod make;
mod passwd;
mod rehearse;
mod render;
mod replay;
mod report;
mod show;

use std::net::SocketAddr;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use lightbots_base::RobotId;
use lightbots_control::OnReturn;
use lightbots_exchange::formats_in_words;
use lightbots_link::BrokerArguments;
use lightbots_show::SPEED_MIN_PERCENT;

use crate::logging::Log;
use crate::numbers::{address, floor, robot, seed};

pub use backup::{BackupArguments, RestoreArguments};
pub use certs::CertsArguments;
pub use desk::DeskArguments;
pub use lamps::LampArguments;
pub use make::MakeArguments;
pub use passwd::PasswdArguments;
pub use rehearse::RehearseArguments;
pub use render::RenderArguments;
pub use replay::ReplayArguments;
pub use report::ReportArguments;
pub use show::ShowArguments;
use show::show_help;

/// Light shows on a floor: every robot is a pixel that drives.
#[derive(Debug, Parser)]
#[command(name = "lightbots", version, about, max_term_width = 100)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// How much is logged to stderr.
    #[arg(long, global = true, value_enum, default_value_t = Log::Warn)]
    pub log: Log,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Start the controller, its browser app, an embedded broker and simulated robots; prints the address
    Run(Box<RunArguments>),
    /// Validate, plan and prove a show; nothing is simulated
    Check(CheckArguments),
    /// Write the timed paths of a show
    Plan(PlanArguments),
    /// Play a whole show in virtual time, with simulated robots, sensors and network
    Rehearse(RehearseArguments),
    /// Play a show once on a live fleet, without a screen; prints a report at the end
    Play(PlayArguments),
    /// Repeat a recorded rehearsal or run in the controller, input by input, and compare the outputs
    Replay(ReplayArguments),
    /// What was planned and what happened in a recorded run or rehearsal
    Report(ReportArguments),
    /// Start simulated robots only, for another machine or another controller
    Robots(RobotsArguments),
    /// Start only the embedded broker, for other controllers and robots; `run` starts one by itself
    Broker(BrokerOnlyArguments),
    /// Make a show of words, shapes, drawings, pictures, lists and animations, for any number of robots
    Make(Box<MakeArguments>),
    /// Make what the audience sees: a film, a contact sheet; or a sheet for the crew
    Render(Box<RenderArguments>),
    /// Convert between show formats, by the files' endings
    Convert(ConvertArguments),
    /// Test whether a robot on a broker keeps the protocol, rule by rule; the robot drives, within half a metre of where it
    /// stands
    RobotCheck(RobotCheckArguments),
    /// Make certificates for a broker and the browser app with TLS: an authority, a server, clients
    Certs(CertsArguments),
    /// Set or reset a password of the web app; from the terminal, or the first line of the input
    Passwd(PasswdArguments),
    /// Save the data folder (shows, earlier saves, runs, accounts, certificates) in one file, also while it is in use
    Backup(BackupArguments),
    /// Make a data folder from a backup
    Restore(RestoreArguments),
    /// Decode a picture of a layer; this program starts it by itself
    #[command(hide = true)]
    Picture,
}

/// `run`
#[derive(Debug, Args)]
pub struct RunArguments {
    /// The show to open; without it, the show that was open last, else an example
    pub show: Option<PathBuf>,
    #[command(flatten)]
    pub reading: ShowArguments,
    /// How many simulated robots to start; 0: none [default: 30, or more where SHOW needs more]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=20_000))]
    pub robots: Option<u32>,
    /// Use this broker instead of the embedded one: mqtt[s]://[user[:password]@]host[:port], further addresses of the same
    /// broker after commas. `embedded` overrules a broker that was chosen on the screen before
    #[arg(long, value_name = "URL")]
    pub broker: Vec<String>,
    #[command(flatten)]
    pub login: BrokerArguments,
    /// Where the browser app is served. On any address except a loopback one, people have to sign in, over TLS
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:8420", value_parser = address)]
    pub listen: SocketAddr,
    /// Serve the browser app without TLS where the network can reach --listen. Passwords can then be read on the way, and
    /// browsers refuse film and MIDI
    #[arg(long)]
    pub plain_http: bool,
    /// A further name of this machine in the browser's address line, such as stage.local; may be repeated
    #[arg(long, value_name = "NAME[:PORT]")]
    pub host_name: Vec<String>,
    /// Longest time for a plan that a program requests from the web app, seconds
    #[arg(long, value_name = "S", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=86_400))]
    pub plan_budget: u32,
    #[command(flatten)]
    pub mqtt: MqttArguments,
    #[command(flatten)]
    pub desk: DeskArguments,
    #[command(flatten)]
    pub lamps: LampArguments,
    /// Folder of the library of shows and of recorded runs [default: lightbots in the user's data folder]
    #[arg(long, value_name = "DIR")]
    pub data: Option<PathBuf>,
    /// What happens to a show that was cut off when this program was killed [default: go if at most 30 s have passed, else
    /// ask]
    #[arg(long, value_name = "WHAT", value_enum)]
    pub on_return: Option<OnReturnArgument>,
    /// Seed of the simulated robots' noise and names. Pins in a show refer to these names. [default: 1; with --broker,
    /// where other robots may have the same names, a random one]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = seed)]
    pub seed: Option<u64>,
    /// Simulated robots without sensor noise and wheel slip
    #[arg(long)]
    pub ideal: bool,
}

/// What happens to a show that was cut off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OnReturnArgument {
    /// The show goes on from where the robots stand, once they report.
    Go,
    /// The robots stand until Go on or Stop is pressed on the screen.
    Ask,
    /// The robots are told to stop, and the show is over.
    Stop,
}

impl From<OnReturnArgument> for OnReturn {
    fn from(argument: OnReturnArgument) -> Self {
        match argument {
            OnReturnArgument::Go => Self::Go,
            OnReturnArgument::Ask => Self::Ask,
            OnReturnArgument::Stop => Self::Stop,
        }
    }
}

/// The embedded broker, of `run` and `broker`
#[derive(Debug, Args)]
pub struct MqttArguments {
    /// Where the embedded broker listens
    #[arg(long, value_name = "HOST:PORT", default_value = "127.0.0.1:1883", value_parser = address)]
    pub mqtt_listen: SocketAddr,
    /// A further address at which the embedded broker speaks TLS; `lightbots certs` makes the files for it
    #[arg(long, value_name = "HOST:PORT", requires_all = ["cert", "key"], value_parser = address)]
    pub mqtt_tls_listen: Option<SocketAddr>,
    /// The embedded broker's certificate with the chain, PEM
    #[arg(long, value_name = "FILE", requires = "mqtt_tls_listen")]
    pub cert: Option<PathBuf>,
    /// The certificate's key, PEM
    #[arg(long, value_name = "FILE", requires = "mqtt_tls_listen")]
    pub key: Option<PathBuf>,
    /// Over TLS, accept only clients with a certificate of this authority, PEM
    #[arg(long, value_name = "FILE", requires = "mqtt_tls_listen")]
    pub client_ca: Option<PathBuf>,
    /// A user of the embedded broker; if any is given, other users are refused. ROLE is robot (whose name is USER),
    /// any-robot, fleet, controller or cue. Without ROLE, the client id decides: LightBot/NAME is a robot, BotControl/NAME a
    /// controller, any other fleet. May be repeated
    #[arg(long, value_name = "USER:PASSWORD[:ROLE]")]
    pub mqtt_user: Vec<String>,
    /// File of such users, one a line
    #[arg(long, value_name = "FILE")]
    pub mqtt_users: Option<PathBuf>,
}

/// `broker`
#[derive(Debug, Args)]
pub struct BrokerOnlyArguments {
    #[command(flatten)]
    pub mqtt: MqttArguments,
    /// Number of robots that will connect; the broker's queues are sized for them
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=20_000))]
    pub robots: u32,
    /// Be the child process of a running lightbots: orders come on stdin
    #[arg(long, hide = true)]
    pub child: bool,
}

/// `check`
#[derive(Debug, Args)]
pub struct CheckArguments {
    #[arg(help = show_help())]
    pub show: PathBuf,
    #[command(flatten)]
    pub reading: ShowArguments,
    /// Print for each transition which solvers ran and why its plan was chosen
    #[arg(long)]
    pub explain: bool,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// `plan`
#[derive(Debug, Args)]
pub struct PlanArguments {
    #[arg(help = show_help())]
    pub show: PathBuf,
    /// Where the timed paths are written, as JSON
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    #[command(flatten)]
    pub reading: ShowArguments,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// `play`
#[derive(Debug, Args)]
pub struct PlayArguments {
    #[arg(help = show_help())]
    pub show: PathBuf,
    /// The broker of the fleet: mqtt[s]://[user[:password]@]host[:port], further addresses of the same broker after commas
    #[arg(long, value_name = "URL", required = true)]
    pub broker: Vec<String>,
    #[command(flatten)]
    pub login: BrokerArguments,
    /// Number of robots that must be ready before the show starts. With fewer robots than pixels, some pixels stay dark.
    /// [default: as many as pixels, or those that are ready once no further robot has come for ten seconds]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub wait: Option<u32>,
    /// Longest wait for the broker and the robots, seconds
    #[arg(long, value_name = "S", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=86_400))]
    pub patience: u32,
    /// Record the inputs of the controller, for `replay`
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Speed of drives, percent of the usual speed; 50 is good for a first run
    #[arg(long, value_name = "PERCENT", default_value_t = 100, value_parser = clap::value_parser!(u32).range(i64::from(SPEED_MIN_PERCENT)..=100))]
    pub speed: u32,
    #[command(flatten)]
    pub lamps: LampArguments,
    #[command(flatten)]
    pub reading: ShowArguments,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}

/// `robots`
#[derive(Debug, Args)]
pub struct RobotsArguments {
    /// Number of simulated robots
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=20_000))]
    pub count: u32,
    /// The broker of the robots: mqtt[s]://[user[:password]@]host[:port], further addresses of the same broker after commas
    #[arg(long, value_name = "URL", required = true)]
    pub broker: Vec<String>,
    #[command(flatten)]
    pub login: BrokerArguments,
    /// How many robots share a connection; use 1 if the broker gives each robot rights of its own
    #[arg(long, value_name = "N", default_value_t = 50, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub together: u32,
    /// Seed of the robots' noise and names [default: another one each time]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = seed)]
    pub seed: Option<u64>,
    /// Width and depth of the floor in metres; with `--start rows`, the robots stand in rows at its back edge
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = floor, default_value = "3x3")]
    pub floor: (f64, f64),
    /// Where the robots stand at first: `rows` along the back edge, a SHOW's first frame, or one place X,Y in metres for
    /// each robot. Places are separated by blanks; may be repeated
    #[arg(long, value_name = "WHERE", allow_hyphen_values = true, default_value = "rows")]
    pub start: Vec<String>,
    /// Without sensor noise and wheel slip
    #[arg(long)]
    pub ideal: bool,
    /// Faults to add, such as slip=10%,gps=5mm
    #[arg(long, value_name = "SPEC")]
    pub faults: Option<String>,
}

/// `convert`
#[derive(Debug, Args)]
pub struct ConvertArguments {
    #[arg(value_name = "IN", help = show_help())]
    pub input: PathBuf,
    #[arg(value_name = "OUT", help = format!("The file to write: a {}", formats_in_words()))]
    pub output: PathBuf,
    /// Fit every frame to this number of robots
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub robots: Option<u32>,
    /// Leave out the paths that IN prescribes, so that drives are planned between its pictures
    #[arg(long)]
    pub replan: bool,
    /// IN is an FSEQ file: put its colours onto this show
    #[arg(long, value_name = "SHOW")]
    pub onto: Option<PathBuf>,
}

/// `robot-check`
#[derive(Debug, Args)]
pub struct RobotCheckArguments {
    /// The robot's broker: mqtt[s]://[user[:password]@]host[:port], further addresses of the same broker after commas
    #[arg(long, value_name = "URL", required = true)]
    pub broker: Vec<String>,
    #[command(flatten)]
    pub login: BrokerArguments,
    /// Name of the robot to test; needed if several are on the broker
    #[arg(long, value_name = "ID", value_parser = robot)]
    pub robot: Option<RobotId>,
    /// Width and depth of the floor in metres. The robot is not sent off the floor, and a reported place off the floor
    /// breaks a rule
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = floor, default_value = "3x3")]
    pub floor: (f64, f64),
    /// Drive without asking first
    #[arg(long)]
    pub yes: bool,
    /// Ask questions about the robot's light, to be answered with y or n
    #[arg(long)]
    pub look: bool,
    /// Longest wait for the broker, seconds
    #[arg(long, value_name = "S", default_value_t = 30, value_parser = clap::value_parser!(u32).range(1..=86_400))]
    pub patience: u32,
    /// One JSON object on stdout
    #[arg(long)]
    pub json: bool,
}
