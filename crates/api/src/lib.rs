//! Messages between screen and server on `/ws` and `/api`, and the TypeScript types of these messages.
//!
//! The crate holds types, and turns the result of the planner into a [`Plan`] ([`plan_document()`]). It has no sockets
//! and no controller. [`ToScreen`] and [`FromScreen`] are the JSON messages on the WebSocket, [`Robots`] is the binary
//! message there. [`ShowEntry`], [`ShowState`], [`RunEntry`], [`BrokerSettings`], [`Problem`] and [`Plan`] are bodies
//! of HTTP answers. [`MakeRequest`] and [`MakeAnswer`] go to and from the module in the browser. After a change run
//! `cargo run -p lightbots-api --example types`, `--example page` and `--example schemas`. The page, docs/api.md, is
//! made of the tables of requests in the docs of modules, and of the docs of types.
//!
//! ```
//! use lightbots_api::{FromScreen, Operation};
//! let message = r#"{"type":"operate","id":7,"operation":{"do":"preview","frame":2}}"#;
//! let FromScreen::Operate(request) = serde_json::from_str(message).unwrap() else { panic!("an operation") };
//! assert!(matches!(request.operation, Operation::Preview { frame: 2, .. }));
//! ```

mod account;
mod broker;
mod document;
mod fleet;
mod incident;
mod library;
mod make;
mod operation;
mod plan;
mod plan_document;
mod playlist;
mod robots;
mod runs;
mod schemas;
mod screen;
mod state;
mod typescript;

pub use account::{
    AccountEntry, AccountRole, Credentials, FirstOperator, MadeToken, NewPerson, PersonChange, Whoami,
};
pub use broker::BrokerSettings;
pub use fleet::{Abilities, Fleet, FleetRow, PreflightFault, PreflightResult, Presence, RobotStatus};
pub use incident::{Incident, IncidentTone, Incidents};
pub use library::{Problem, ShowEntry, ShowOrigin, ShowState};
pub use make::{
    BeatsAnswer, FilmAnswer, FilmPicture, FitAnswer, MadePixel, MadeReadability, MakeAnswer, MakeChoices,
    MakeFile, MakeFont, MakeQuality, MakeRemark, MakeRequest, MakeShape, MovedAnswer, MovedPixel,
};
pub use operation::{Answer, Choice, FromScreen, Missing, Operation, RefusedOperation, Request};
pub use plan::{
    Issue, LightAnswer, LightRequest, Path, Plan, PlanAnswer, PlanningRequest, Severity, Transition,
};
pub use plan_document::{plan_document, plan_summary, rounded};
pub use playlist::{
    PlaylistChange, PlaylistDay, PlaylistEntry, PlaylistNext, PlaylistResult, PlaylistState, PlaylistToday,
};
pub use robots::Robots;
pub use runs::{RunEntry, RunEntryKind};
pub use schemas::schemas;
pub use screen::{Hello, Level, LogLine, OpenShow, ToScreen};
pub use state::{Broker, BrokerPhase, Phase, Playback, PreflightState, Repeats, ShowTime, State};
pub use typescript::typescript;
