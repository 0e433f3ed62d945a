//! A connection to an MQTT broker that reconnects by itself.
//!
//! The crate carries topics and payloads and does not know their meaning. In reading order: [`BrokerUrl`] holds the
//! addresses and the login of a broker, and [`TlsTrust`] the certificates for TLS. [`BrokerArguments`] reads both from
//! a command line. [`Link`] is the connection.
//!
//! A link reconnects with back-off and jitter, to the next address if there are several, and subscribes again in each
//! new session. Sending never blocks. A message that cannot be sent now is dropped, because a late command is worse
//! than a lost one.
//!
//! ```
//! use lightbots_link::BrokerUrl;
//! let broker = BrokerUrl::parse("mqtt://default:default@floor.local").unwrap();
//! assert_eq!(broker.to_string(), "mqtt://floor.local:1883");
//! ```

mod address;
mod arguments;
mod backoff;
mod client_id;
mod connection;
mod detached_writer;
mod interface;
mod link;
mod reason;
mod tls_trust;
mod url;

pub use address::BrokerAddress;
pub use arguments::{ArgumentsError, BrokerArguments};
pub use client_id::{controller_client_id, crowd_client_id, random_id, robot_client_id};
pub use interface::{LinkConfig, LinkEvent};
pub use link::{Link, Sender};
pub use tls_trust::{Pem, TlsTrust, TlsTrustError};
pub use url::{BrokerUrl, UrlError};
