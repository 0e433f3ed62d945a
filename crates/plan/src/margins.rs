//! All distances that the planner keeps, in ascending order: the proof checks the smallest, and solvers first aim at
//! the largest. Distances between robots and from walls are gaps between rims, metres.

/// Gap between any two rims that the proof checks, unless starts or goals are closer. It covers the path error of a
/// robot, 2 mm, and the rounding of messages. With a smaller gap, robots touch in rehearsals; with a larger one, narrow
/// gaps are closed.
pub(crate) const MARGIN_M: f64 = 0.003;
/// Gap that the roadmap keeps from walls: above [`MARGIN_M`] by the rounding of its distances.
pub(crate) const ROADMAP_M: f64 = 0.003_01;
/// Gap that the visibility graph keeps from walls: above [`ROADMAP_M`], because splines round its corners.
pub(crate) const VISIBILITY_M: f64 = 0.003_05;
/// Gap that regions of the floor keep from walls. It exceeds [`VISIBILITY_M`], so that every search can pass through
/// what counts as open.
pub(crate) const REGION_M: f64 = MARGIN_M + 0.000_1;
/// Gap that deformed splines keep between robots: above [`MARGIN_M`] by the error of straight stretches, 0.1 mm.
pub(crate) const SPLINE_M: f64 = 0.003_1;
/// Gap between rims and the floor's edge, unless starts, goals or walls force robots closer: robots follow their paths
/// within 3 mm.
pub(crate) const EDGE_M: f64 = 0.003_5;
/// Comfortable gap, which solvers aim at where it costs little: robots follow their paths within 5 mm, most within 2
/// mm.
pub(crate) const COMFORT_M: f64 = 0.008;
/// Gap between robots at the first attempt if they are not of the Elisa-3's size: it leaves room for [`COMFORT_M`] and
/// the deformation.
pub(crate) const ROOMY_M: f64 = 0.013_5;

const _: () = assert!(MARGIN_M < ROADMAP_M);
const _: () = assert!(ROADMAP_M < VISIBILITY_M);
const _: () = assert!(VISIBILITY_M < REGION_M);
const _: () = assert!(REGION_M <= SPLINE_M);
const _: () = assert!(SPLINE_M < EDGE_M);
const _: () = assert!(EDGE_M < COMFORT_M);
const _: () = assert!(COMFORT_M < ROOMY_M);
