//! `run`: controller, browser app and simulated robots in one process, the embedded broker in another.

use std::net::{Ipv4Addr, SocketAddr};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use lightbots_api::{Level, ShowOrigin};
use lightbots_control::Operation;
use lightbots_lighting::validate;
use lightbots_link::BrokerUrl;
use lightbots_show::Show;
use tokio::sync::mpsc;
use tokio::task::JoinHandle;

use super::{broker, count, first_operator, robots};
use crate::broker_settings::{Settings, other_broker};
use crate::cli::RunArguments;
use crate::data_folder::DataFolder;
use crate::failure::{Failure, Outcome};
use crate::fleet_book::FleetBook;
use crate::library::{Library, name_of_file};
use crate::live::broker::EmbeddedBroker;
use crate::live::cast::Cast;
use crate::live::clock::Clock;
use crate::live::conductor::Handle;
use crate::live::cut_off::CutOffRun;
use crate::live::desk_light::DeskLight;
#[cfg(feature = "sound")]
use crate::live::loudspeaker::Loudspeaker;
use crate::live::osc::OscLink;
use crate::live::recorder::RecordingTarget;
use crate::played_shows::PlayedShows;
use crate::stop::{End, Stop};
use crate::web::{self, Admission, BrokerDesk, Exposure, Planner, Scheme, ScreenLog, Shared, WebCertificate};
use crate::{open_files, playlist_player, say, show_file};

/// Name of the show that is opened if the command line names none and none was open before: an example.
const FIRST: &str = "countdown";
/// Seed of simulated robots on the embedded broker without `--seed`. Fixed, so that robots keep their names between starts.
const USUAL_SEED: u64 = 1;
/// Most errors of the show that are printed at the start. The screen lists all issues.
const ISSUES_SHOWN: usize = 5;
/// Longest time at the end of the program for stopping the robots and disconnecting. After it, connections are cut off.
pub const GOODBYE: Duration = Duration::from_secs(5);

/// The links to a lighting desk and a sound desk; `None` for a link that the command line does not ask for.
type Desks = (Option<DeskLight>, Option<OscLink>);

/// What `run` started, in the order in which it is stopped. The conductor ends first, while the robots can still report to
/// it through the broker that they stand.
#[derive(Default)]
struct Started {
    conductor: Option<JoinHandle<()>>,
    robots: Option<End>,
    tasks: Vec<JoinHandle<()>>,
    broker: Option<EmbeddedBroker>,
    folder: Option<DataFolder>,
}

impl Started {
    /// Waits for the conductor, which ends once a stop is wanted. Then ends the simulated robots and waits for the other
    /// tasks.
    async fn end(&mut self) {
        if let Some(conductor) = self.conductor.take() {
            let _ = conductor.await;
        }
        if let Some(robots) = self.robots.take() {
            robots.now();
        }
        for task in self.tasks.drain(..) {
            let _ = task.await;
        }
    }

    /// Starts the simulated robots.
    fn simulate(&mut self, cast: Cast, shared: &Arc<Shared>, stop: &Stop) {
        let (until, end) = stop.apart();
        self.robots = Some(end);
        self.tasks.push(tokio::spawn(cast.run(shared.handle.clone(), shared.desk.watch(), until)));
    }

    /// Starts the tasks for lighting desk, sound desk, warnings of the broker, and music, as far as `run` has these.
    fn follow(
        &mut self,
        arguments: &RunArguments,
        (light, sound): Desks,
        shared: &Arc<Shared>,
        stop: &Stop,
    ) -> Result<(), Failure> {
        if let Some(light) = light {
            let light = light.run(shared.handle.clone(), shared.log.clone(), stop.clone());
            self.tasks.push(tokio::spawn(light));
        }
        if let Some(sound) = sound {
            let names = shared.clone();
            let name_of = move |frame: usize| {
                names.desk.shown().show.frames.get(frame).map_or(String::new(), |frame| frame.name.clone())
            };
            let sound = sound.run(shared.handle.clone(), shared.log.clone(), stop.clone(), name_of);
            self.tasks.push(tokio::spawn(sound));
        }
        if let Some(lines) = self.broker.as_mut().and_then(EmbeddedBroker::notices) {
            self.tasks.push(tokio::spawn(relay(lines, shared.log.clone(), stop.clone())));
        }
        self.sound(arguments, shared, stop)
    }

    /// Does nothing without the feature `sound`.
    #[cfg(not(feature = "sound"))]
    fn sound(&mut self, _: &RunArguments, _: &Arc<Shared>, _: &Stop) -> Result<(), Failure> {
        Ok(())
    }

    /// Starts to play the music of the open show on this machine, if `--sound` is set.
    #[cfg(feature = "sound")]
    fn sound(&mut self, arguments: &RunArguments, shared: &Arc<Shared>, stop: &Stop) -> Result<(), Failure> {
        if !arguments.desk.sound {
            return Ok(());
        }
        let loudspeaker = Loudspeaker::open(arguments.desk.sound_offset_ms)?;
        let opened = shared.clone();
        let music_of = move || {
            let shown = opened.desk.shown();
            let name = shown.show.music.as_ref()?;
            let (hash, _) = shown.show.assets.iter().find(|(_, asset)| asset.name == *name)?;
            let hash = hash.to_string();
            Some((hash.clone(), opened.library.asset(&hash).ok()?))
        };
        self.tasks.push(tokio::spawn(loudspeaker.run(shared.handle.clone(), stop.clone(), music_of)));
        Ok(())
    }
}

pub async fn run(arguments: RunArguments, stop: Stop) -> Outcome {
    stop.take_over();
    let mut started = Started::default();
    let outcome = tokio::select! {
        biased;
        () = stop.wait() => Ok(true),
        outcome = serve(&arguments, &stop, &mut started) => outcome,
    };
    // After a failure nothing is waited for.
    if stop.is_wanted() {
        let _ = tokio::time::timeout(GOODBYE, started.end()).await;
    }
    drop(started);
    outcome
}

async fn serve(arguments: &RunArguments, stop: &Stop, started: &mut Started) -> Outcome {
    let exposure = exposure(arguments)?;
    let mut options = broker::options(&arguments.mqtt, 0)?;
    let other = other_broker(&arguments.broker, &arguments.login)?;
    let data = arguments.data.clone().unwrap_or_else(DataFolder::usual);
    let folder = started.folder.insert(DataFolder::take(&data)?);
    let library = Library::new(data.clone());
    library.tidy_up();
    let cut_off = CutOffRun::find(&data, arguments.on_return);
    let first = first_show(arguments, &library)?;
    let (name, show) = match &cut_off {
        Some(run) => run.show_on_screen(&library, first),
        None => first,
    };
    for issue in validate(&show).iter().filter(|issue| issue.is_error()).take(ISSUES_SHOWN) {
        say::error(&issue.message);
    }
    open_files::raise_limit();
    let certificate = certificate(&exposure, &data)?;
    let desks = open_desks(arguments).await?;
    let (listener, names) = web::listen(&exposure).await?;
    let address = listener.local_addr().unwrap_or(arguments.listen);
    folder.tell_address(&format!("{}://{address}", names.scheme().name()));
    let count = arguments.robots.map(|robots| robots as usize);
    let robots = Cast::robots(count, &show);
    let embedded = if other.is_none() {
        options.robots = robots;
        let broker = EmbeddedBroker::start(options).await?;
        Some(started.broker.insert(broker).url())
    } else {
        None
    };
    let Some(own) = other.clone().or_else(|| embedded.clone()) else { return Ok(false) };
    let seed = robots_seed(arguments.seed, other.is_none());
    let (settings, broker) = chosen(arguments, other, &own, &data);
    let clock = cut_off.as_ref().map_or_else(Clock::start, CutOffRun::clock);
    let (handle, conductor) =
        Handle::start(RecordingTarget::Runs(data.clone()), (clock, arguments.lamps.settings()), stop.clone());
    started.conductor = Some(conductor);
    let (admission, first) = Admission::new(&data, names.is_open()).map_err(Failure::problem)?;
    let planner = Planner::new(Duration::from_secs(arguments.plan_budget.into()));
    let (book, played) = (FleetBook::load(&data), PlayedShows::load(&data));
    if let Some(names) = book.admitted() {
        let _ = handle.operate(Operation::Admit(Some(names))).await;
    }
    let desk = BrokerDesk::new(data, settings, embedded);
    let shared = Shared::new(handle.clone(), library, (book, played), desk, names, admission, planner);
    open(&shared, name).await;
    if let Some(run) = cut_off {
        run.tell(handle.clock().now());
        handle.take_up(run.unfinished, run.on_return).await;
    }
    handle.connect(broker.clone()).await;
    let cast = Cast {
        broker: own,
        count,
        seed,
        conditions: robots::conditions(arguments.ideal),
        simulated: shared.simulated.clone(),
    };
    started.simulate(cast, &shared, stop);
    started.follow(arguments, desks, &shared, stop)?;
    started.tasks.push(tokio::spawn(playlist_player::play(shared.clone(), stop.clone())));
    let scheme = shared.names.scheme().name();
    say::line(&format!("LightBots is at {scheme}://{} (Ctrl-C stops it)", own_address(address)));
    greet(&broker, robots, started.broker.as_ref().and_then(EmbeddedBroker::tls_address));
    invite(arguments, &shared, address, (certificate.as_ref(), first));
    web::serve(listener, certificate.map(|certificate| certificate.acceptor), shared).await;
    Ok(false)
}

/// Opens the links to lighting and sound desks that the command line asks for.
async fn open_desks(arguments: &RunArguments) -> Result<Desks, Failure> {
    let light = DeskLight::open(&arguments.desk, arguments.lamps.settings()).await?;
    Ok((light, OscLink::open(&arguments.desk).await?))
}

/// If the network reaches the web app, prints that. While there are no accounts, also prints the address at which the first
/// operator chooses a name and a password.
fn invite(
    arguments: &RunArguments,
    shared: &Shared,
    address: SocketAddr,
    (certificate, first): (Option<&WebCertificate>, Option<String>),
) {
    if !shared.names.is_open() {
        return;
    }
    say_open(certificate);
    if let Some(token) = first {
        let name = arguments.host_name.first().map(String::as_str);
        first_operator::invite(&web::url(shared.names.scheme(), address, name), &token);
    }
}

/// Returns the certificate of the web app; `None` if it is served without TLS.
fn certificate(exposure: &Exposure, data: &Path) -> Result<Option<WebCertificate>, Failure> {
    let is_wanted = exposure.scheme() == Scheme::Https;
    is_wanted.then(|| WebCertificate::take(data, &exposure.hosts())).transpose()
}

/// Prints that the network reaches the web app, and the fingerprint by which people recognise its certificate.
fn say_open(certificate: Option<&WebCertificate>) {
    let Some(certificate) = certificate else {
        let line = "Open to the network without TLS: sign-in is required, but passwords can be read on the way, and \
                    browsers refuse film and MIDI. Leave --plain-http out to mend that";
        return say::line(line);
    };
    say::line("Open to the network: sign-in is required");
    say::line(&format!(
        "Certificate {}; its SHA-256 fingerprint, to compare with the browser's:",
        certificate.file.display()
    ));
    say::line(&certificate.fingerprint);
    if let Some(line) = &certificate.key_note {
        say::note(line);
    }
    if !certificate.missing.is_empty() {
        let (names, remedy) = (certificate.missing.join(" and "), certificate.remedy());
        say::note(&format!("The certificate is not for {names}; this makes one that is: {remedy}"));
    }
}

/// Returns the seed of the simulated robots and their names. On the embedded broker, the default is fixed, so that pins of a
/// show still fit. On another broker, the default is random, because other robots there may have these names.
fn robots_seed(asked: Option<u64>, is_own_broker: bool) -> u64 {
    if is_own_broker { asked.unwrap_or(USUAL_SEED) } else { robots::seed(asked) }
}

fn exposure(arguments: &RunArguments) -> Result<Exposure, Failure> {
    Exposure::new(arguments.listen, arguments.plain_http, arguments.host_name.clone())
}

/// Shows the warnings of the embedded broker on the screens.
async fn relay(mut lines: mpsc::Receiver<String>, log: ScreenLog, stop: Stop) {
    loop {
        let line = tokio::select! {
            () = stop.wait() => return,
            line = lines.recv() => line,
        };
        let Some(line) = line else { return };
        log.say(Level::Warn, line);
    }
}

/// Returns the settings for the screen's form, and the broker for the controller. The broker is that of the command
/// line, else the one that was chosen on the screen, else the embedded one (`own`). The one from the screen is not used
/// with `--broker embedded`, after a disconnection on the screen, or if its settings are wrong.
fn chosen(
    arguments: &RunArguments,
    other: Option<BrokerUrl>,
    own: &BrokerUrl,
    data: &Path,
) -> (Settings, BrokerUrl) {
    if let Some(broker) = other {
        return (Settings::of(&broker, &arguments.login), broker);
    }
    let kept = Settings::load(data).filter(|_| arguments.broker.is_empty());
    let Some(mut settings) = kept.filter(|settings| !settings.is_embedded()) else {
        return (Settings::embedded(), own.clone());
    };
    if !settings.connect {
        return (settings, own.clone());
    }
    match settings.broker() {
        Ok(broker) => (settings, broker),
        Err(line) => {
            tracing::warn!("the broker that was chosen on the screen cannot be used: {line}");
            (settings, own.clone())
        }
    }
}

/// Returns the show that is opened at the start, and its name in the library. The show is the file of the command line, else
/// the one that was open last, else an example, else any show of the library. Without any: `None` and an empty show.
fn first_show(arguments: &RunArguments, library: &Library) -> Result<(Option<String>, Show), Failure> {
    if let Some(file) = &arguments.show {
        let opened = show_file::open(file, &arguments.reading)?;
        for issue in opened.issues.iter().filter(|issue| issue.code == show_file::FLOOR_IGNORED) {
            // The screen shows all other issues; it does not know this command line.
            tracing::warn!("{}", issue.message);
        }
        let name = library.give(&name_of_file(file), ShowOrigin::StartFile, &opened.show, opened.unread);
        return Ok((Some(name), opened.show));
    }
    let named = |name: String| library.get(&name).ok().map(|kept| (name, kept));
    let before = library.remembered().and_then(named);
    let other = || {
        library
            .list()
            .into_iter()
            .find_map(|entry| Some((entry.name.clone(), library.get(&entry.name).ok()?)))
    };
    Ok(before
        .or_else(|| named(FIRST.to_owned()))
        .or_else(other)
        .map_or((None, Show::default()), |(name, kept)| (Some(name), kept.show)))
}

async fn open(shared: &Arc<Shared>, name: Option<String>) {
    let Some(name) = name else { return };
    let (library, wanted) = (shared.library.clone(), name.clone());
    let opened =
        tokio::task::spawn_blocking(move || library.get(&wanted).map(|kept| library.with_pictures(kept)));
    match opened.await {
        Ok(Ok(kept)) => shared.desk.open(name, kept).await,
        Ok(Err(error)) => tracing::error!("{}", error.line()),
        Err(error) => tracing::error!("{error}"),
    }
}

/// Returns the address of the web app for this machine: 127.0.0.1 if the app listens on all addresses.
fn own_address(address: SocketAddr) -> SocketAddr {
    if address.ip().is_unspecified() {
        return SocketAddr::new(Ipv4Addr::LOCALHOST.into(), address.port());
    }
    address
}

fn greet(broker: &BrokerUrl, robots: usize, tls: Option<SocketAddr>) {
    let fleet = if robots == 0 { "no simulated robots".into() } else { count(robots, "simulated robot") };
    say::line(&format!("Broker {broker}, {fleet}"));
    if let Some(tls) = tls {
        say::line(&format!("Broker with TLS mqtts://{tls}"));
    }
}
