//! Trajectory optimisation: robots that come too close to each other or to walls are displaced. Then limits of their
//! motion are restored. Both steps are repeated until neither is needed, or the work is used up.

pub(crate) mod cells;
pub(crate) mod contacts;
pub(crate) mod displacement;
pub(crate) mod left_over;
pub(crate) mod neighbours;
pub(crate) mod relaxation;
pub(crate) mod stagnation;
