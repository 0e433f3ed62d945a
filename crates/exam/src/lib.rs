//! Tests from outside whether a robot keeps the rules of `docs/protocol.md`: by messages, and for the light by the
//! answers of a person.
//!
//! The crate is sans-IO like the controller core: [`Exam`] takes messages and the time, and returns messages and
//! events. The test is one script (`script`), an `async fn` that waits for messages and moments. `exam` polls the
//! script after each input. There is no runtime, thread or clock behind it, and equal inputs give equal findings. The
//! crate has no code for brokers, terminals or our own robot.
//!
//! In reading order: [`Exam`], [`Options`], [`ExamEvent`], [`Finding`] with its [`RuleVerdict`], [`RULES`].
//!
//! ```
//! use lightbots_base::{Instant, Span};
//! use lightbots_exam::{Ending, Exam, Options};
//! let mut exam = Exam::new(Options::default());
//! exam.connected(Instant(0));
//! assert_eq!(exam.next_publish().unwrap().payload, b"|UUID|");
//! while let Some(at) = exam.wake_at() {
//!     exam.wake(at);
//! }
//! assert_eq!(exam.ending(), Some(&Ending::NoRobot));
//! ```

mod exam;
mod finding;
mod interface;
mod ledger;
mod received;
mod rules;
mod script;
mod session;
mod sight;

pub use exam::Exam;
pub use finding::{Finding, RuleTest, RuleVerdict};
pub use interface::{Ending, ExamEvent, Options, Publish};
pub use rules::{RULES, Rule, Scope};
pub use sight::{Question, Sight};
