//! State of the link to the broker.

/// State of the link to the broker.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LinkState {
    /// The broker's addresses without login; empty if no link is wanted.
    pub address: String,
    /// How far the link has come.
    pub phase: LinkPhase,
    /// The address that is in use; `None` unless connected.
    pub node: Option<String>,
    /// Why there is no connection, once that is known.
    pub reason: Option<String>,
}

/// How far a link has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinkPhase {
    /// No link is wanted.
    #[default]
    Off,
    /// The first attempt to connect is under way.
    Connecting,
    /// The link is up.
    Connected,
    /// An attempt failed or the link broke. Further attempts follow.
    Retrying,
}

impl LinkState {
    /// Whether messages can be sent and received.
    pub fn is_connected(&self) -> bool {
        self.phase == LinkPhase::Connected
    }
}
