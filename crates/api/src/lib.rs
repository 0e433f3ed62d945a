//! What the screen and the server say to each other, over `/ws` and `/api`; the TypeScript types are made from it.
//!
//! It knows nothing of sockets, controllers or plans: only the shape of what is said. [`ToScreen`] is everything a server
//! says on the WebSocket but [`Robots`], which is no JSON, [`FromScreen`] everything a screen says there; [`ShowEntry`],
//! [`BrokerSettings`], [`Problem`] and [`Plan`] are the bodies of HTTP answers. After a change run
//! `cargo run -p lightbots-api --example types`.
//!
//! ```
//! use lightbots_api::{FromScreen, Operation};
//! let said = r#"{"type":"operate","id":7,"operation":{"do":"preview","frame":2}}"#;
//! let FromScreen::Operate(request) = serde_json::from_str(said).unwrap() else { panic!("it is a wish") };
//! assert!(matches!(request.operation, Operation::Preview { frame: 2, .. }));
//! ```

mod broker;
mod fleet;
mod library;
mod operation;
mod plan;
mod robots;
mod screen;
mod state;
mod typescript;

pub use broker::BrokerSettings;
pub use fleet::{Abilities, Fleet, FleetRow, Presence, RobotStatus};
pub use library::{Problem, ShowEntry, ShowOrigin};
pub use operation::{Answer, Choice, FromScreen, Missing, Operation, Request};
pub use plan::{Issue, Path, Plan, Severity, Transition};
pub use robots::Robots;
pub use screen::{Hello, Level, LogLine, OpenShow, ToScreen};
pub use state::{Broker, BrokerPhase, Phase, Playback, State};
pub use typescript::typescript;
