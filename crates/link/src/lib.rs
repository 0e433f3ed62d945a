//! A connection to an MQTT broker that mends itself.
//!
//! It carries topics and payloads and knows nothing of what they mean. [`BrokerUrl`] says where the broker is, at one
//! address or several, and [`Trust`] whom to believe over TLS; [`BrokerArguments`] reads both from a command line.
//! [`Link`] stays connected to it: it reconnects with
//! back-off and jitter, to the next address where there are several, subscribes again on every fresh session,
//! never blocks its user, and drops rather than queues what cannot be sent now: a command that is late is worse than
//! one that is lost, because the protocol repeats what matters.
//!
//! ```
//! use lightbots_link::BrokerUrl;
//! let broker = BrokerUrl::parse("mqtt://default:default@floor.local").unwrap();
//! assert_eq!(broker.to_string(), "mqtt://floor.local:1883");
//! ```

mod arguments;
mod backoff;
mod client_id;
mod link;
mod place;
mod pump;
mod reason;
mod stream;
mod trust;
mod url;

pub use arguments::{ArgumentsError, BrokerArguments};
pub use client_id::{controller_client_id, crowd_client_id, random_id, robot_client_id};
pub use link::{Link, LinkConfig, LinkEvent, Sender};
pub use place::Place;
pub use trust::{Pem, Trust, TrustError};
pub use url::{BrokerUrl, UrlError};
