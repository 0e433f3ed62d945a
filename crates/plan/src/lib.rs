//! Plans shows: finds an assignment and timed paths for each transition, with a proof that no two robots touch.
//!
//! Pure: the same input gives the same bits. The planner reads no messages, clocks or files.
//!
//! In reading order: [`TransitionProblem`] is the drive from one frame to the next. [`Bindings`] bind pixels to robots.
//! [`assignment`] assigns goals to robots. `motion` makes straight lines that all robots drive with the same progress.
//! `prescribed` makes the drives that a show prescribes. `solve` runs a table of solvers if robots on straight lines
//! would touch. [`proof`] checks the paths without relying on the code that made them. [`transition()`] calls these
//! modules for one drive, and [`show()`] plans the drives of all frames one after the other. docs/planner.md explains
//! the methods.
//!
//! ```
//! use lightbots_base::{Limits, Vec2};
//! use lightbots_plan::{TransitionProblem, transition};
//! let problem = TransitionProblem {
//!     starts: vec![Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)],
//!     goals: vec![Vec2::new(0.5, 0.5), Vec2::new(-0.5, 0.5)],
//!     ..TransitionProblem::on_floor(Vec2::new(1.5, 1.5), Limits::default())
//! };
//! let plan = transition(&problem).unwrap();
//! assert_eq!(plan.goal_of, [Some(1), Some(0)]);
//! assert!(plan.closest.unwrap().distance_m > 0.9);
//! ```

pub mod assignment;
mod bindings;
mod cancel;
mod explain;
mod instance;
mod mapf;
mod margins;
mod motion;
mod optimise;
mod order;
mod path;
mod prescribed;
mod problem;
pub mod proof;
mod raise;
mod roads;
#[cfg(test)]
mod seeded;
mod show;
mod solve;
mod spline;
mod transition;
pub mod unsynchronised;
mod workers;

pub use bindings::{BindingIssue, Bindings, BoundFrame, Claims};
pub use cancel::Cancelled;
pub use explain::{ExplainedRow, Explanation, RowOutcome};
pub use motion::turn_time;
pub use path::Path;
pub use prescribed::{PlacesById, Prescribed, moved};
pub use problem::{Infeasible, Meeting, Repaired, Transition, TransitionProblem};
pub use proof::Closest;
pub use raise::{planned_unless, raise, raise_unless};
pub use show::{ShowClosest, ShowOptions, ShowPlan, show, show_unless, show_with};
pub use solve::repair;
pub use transition::{transition, transition_unless};
pub use workers::{OneThread, WorkerTask, Workers};
