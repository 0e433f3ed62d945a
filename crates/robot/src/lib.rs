//! The firmware core of a LightBot: the same code on a board, in Webots and in the simulator.
//!
//! A [`Robot`] is the core of one robot. Every 16 ms the shell (the program around the core) passes in the readings of
//! the sensors, and gets back the outputs for motors and light. The shell passes in messages as they come, and takes
//! outgoing messages after every step. The core allocates nothing and reads no clock. The same inputs give the same
//! outputs to the last bit.
//!
//! A step: [`Inputs`] → `estimate` (pose) → `routes` with `follow`, or `seek` (setpoint) → `reflex` and `supervise` may
//! override → `drive` (wheel rates) → `light` (colour) → [`Outputs`]. [`Hot`] is the state of an ordinary step. A
//! `PATH` command is decoded on the stack, so the thread that calls [`Robot::receive`] needs 32 KB of stack.
//!
//! ```
//! use lightbots_base::{Instant, RobotId, Vec2};
//! use lightbots_robot::{Config, Fix, Inputs, Message, Robot};
//! use lightbots_wire::Topic;
//! let id = RobotId::new("r1").unwrap();
//! let mut robot = Robot::new(Config::new(id));
//! robot.link(Instant(0), true);
//! robot.receive(Instant(0), Topic::Robot(id), b"|TARGET 1.0 0.0||COLOR 255|");
//! let fix = Fix { at: Vec2::ZERO, heading: Some(0.0) };
//! robot.step(Instant(0), &Inputs { fix: Some(fix), ..Inputs::default() });
//! let outputs = robot.step(Instant(16_000), &Inputs { fix: Some(fix), ..Inputs::default() });
//! assert!(outputs.wheels_radps[0] > 0.0 && outputs.light.b == 255);
//! robot.receive(Instant(17_000), Topic::Robot(id), b"|COLOR 65280|");
//! assert_eq!(robot.light(Instant(18_000)).g, 255); // between steps, too
//! let mut message = Message::new();
//! assert_eq!(robot.outgoing(&mut message), Some(Topic::Uuid));
//! assert!(message.starts_with("r1 0.0 0.0 "));
//! ```
#![no_std]

mod bearing;
mod clock;
mod config;
mod covariance;
mod cursor;
mod drive;
mod estimate;
mod filter;
mod follow;
mod history;
mod hot;
mod kept_route;
mod light;
mod light_ahead;
mod light_piece;
mod live_light;
mod look_ahead;
mod noise;
mod outbox;
mod reflex;
mod robot;
mod routes;
mod seek;
mod slip;
mod stall;
mod steady_time;
mod storage;
mod supervise;
mod timeline;

pub use config::{Config, Fix, Inputs, NeighbourModel, Outputs, ProximitySensors, SENSORS, SafetyPolicy};
pub use hot::Hot;
pub use robot::{Message, Robot};
pub use storage::RouteStorage;
