//! How the link to the broker is.

/// How the link to the broker is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinkState {
    /// The broker's addresses without login; empty: none is wanted.
    pub address: String,
    /// How far it is.
    pub phase: LinkPhase,
    /// Which of the addresses is in use.
    pub node: Option<String>,
    /// Why there is no connection, once that is known.
    pub reason: Option<String>,
}

/// How far a link is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinkPhase {
    /// None is wanted.
    #[default]
    Off,
    /// The first attempt.
    Connecting,
    /// It stands.
    Connected,
    /// It failed, and is tried again and again.
    Retrying,
}

impl LinkState {
    /// Whether messages go to and fro.
    pub fn is_connected(&self) -> bool {
        self.phase == LinkPhase::Connected
    }
}
