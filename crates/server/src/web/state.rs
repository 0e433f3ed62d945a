//! State of the web server that all requests share.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicUsize};

use super::admission::Admission;
use super::broker_desk::BrokerDesk;
use super::desk::Desk;
use super::incidents::IncidentBoard;
use super::log::ScreenLog;
use super::names::Names;
use super::picture::Pictures;
use super::planner::Planner;
use super::runs::Runs;
use crate::fleet_book::FleetBook;
use crate::library::Library;
use crate::live::conductor::Handle;
use crate::played_shows::PlayedShows;
use crate::playlist::PlaylistStore;

/// State of the web server that all requests share.
#[derive(Debug)]
pub struct Shared {
    pub handle: Handle,
    pub library: Library,
    /// Names that people gave robots, and the list of robots that may take part.
    pub book: FleetBook,
    pub desk: Desk,
    pub log: ScreenLog,
    pub incidents: IncidentBoard,
    pub pictures: Pictures,
    pub broker: BrokerDesk,
    pub runs: Runs,
    pub playlist: PlaylistStore,
    /// Plans shows that clients send.
    pub planner: Planner,
    /// Accounts, sessions and tokens for this server.
    pub admission: Arc<Admission>,
    /// Names under which this server answers requests.
    pub names: Names,
    /// Number of robots that are simulated at present.
    pub simulated: Arc<AtomicUsize>,
    pub screens: AtomicU32,
}

impl Shared {
    /// Creates the state, and starts the tasks that follow the conductor's news.
    pub fn new(
        handle: Handle,
        library: Library,
        (book, played): (FleetBook, PlayedShows),
        broker: BrokerDesk,
        names: Names,
        admission: Admission,
        planner: Planner,
    ) -> Arc<Self> {
        let log = ScreenLog::new();
        tokio::spawn(log.clone().follow(handle.news()));
        let incidents = IncidentBoard::new();
        tokio::spawn(incidents.clone().follow(handle.news()));
        let desk = Desk::new(handle.clone());
        tokio::spawn(desk.clone().follow(handle.news()));
        let pictures = Pictures::new();
        tokio::spawn(played.clone().follow(handle.clone(), desk.clone()));
        tokio::spawn(pictures.clone().follow(handle.clone(), desk.clone(), book.clone(), played));
        let runs = Runs::of(library.folder(), handle.clone());
        let playlist = PlaylistStore::load(library.folder());
        let (screens, simulated) = (AtomicU32::new(0), Arc::default());
        Arc::new(Self {
            handle,
            library,
            book,
            desk,
            log,
            incidents,
            pictures,
            broker,
            runs,
            playlist,
            admission: Arc::new(admission),
            names,
            planner,
            simulated,
            screens,
        })
    }
}
