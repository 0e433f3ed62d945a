//! Does a robot keep the protocol? Takes one robot through `docs/protocol.md`, rule by rule, from outside.
//!
//! Sans-IO like the controller core: [`Exam`] is told what came and what time it is, and is drained of messages and
//! news. What is done with the robot reads as one script (`script`), written as an `async fn` that waits for messages
//! and moments; `exam` polls it by hand after every input, so there is no runtime, thread or clock behind it, and the
//! same inputs give the same findings. It knows nothing of brokers, terminals or our own robot, and shares only the
//! wire format with the controller.
//!
//! In reading order: [`Exam`], [`Options`], [`News`], [`Finding`] with its [`Verdict`], [`RULES`].
//!
//! ```
//! use lightbots_base::{Instant, Span};
//! use lightbots_exam::{Ending, Exam, News, Options};
//! let mut exam = Exam::new(Options::default());
//! exam.connected(Instant(0));
//! assert_eq!(exam.next_send().unwrap().payload, b"|UUID|");
//! while let Some(at) = exam.wake_at() {
//!     exam.wake(at);
//! }
//! assert_eq!(exam.ending(), Some(&Ending::Nobody));
//! ```

mod desk;
mod exam;
mod finding;
mod heard;
mod ledger;
mod rules;
mod script;
mod sight;

pub use exam::{Ending, Exam, News, Options, Send};
pub use finding::{Finding, Trial, Verdict};
pub use rules::{RULES, Rule, Scope};
pub use sight::{Question, Sight};
