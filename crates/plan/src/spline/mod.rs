//! Uniform cubic B-splines over time: one per robot, all on one clock.

pub(crate) mod hull;
pub(crate) mod limits;
pub(crate) mod retime;
pub(crate) mod set;
pub(crate) mod turn_rate;
pub(crate) mod weights;
