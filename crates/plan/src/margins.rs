//! All distances that the planner keeps, in one ordered table: what is proven is the least, and what is aimed at first
//! is the most. Distances between robots and from walls are gaps between rims, metres.

/// Proven gap between any two rims, where starts and goals leave it. A path keeps the path error of a robot, 2 mm, and
/// the rounding of the wire. With less, robots touch in rehearsals; with more, narrow gaps close.
pub(crate) const MARGIN_M: f64 = 0.003;
/// Gap that the roadmap keeps from walls: above [`MARGIN_M`] by the rounding of its distances.
pub(crate) const ROADMAP_M: f64 = 0.003_01;
/// Gap that the visibility graph keeps from walls: above [`ROADMAP_M`], because splines round its corners.
pub(crate) const VISIBILITY_M: f64 = 0.003_05;
/// Gap that regions of the floor keep from walls: a region that is open must also be open for every search.
pub(crate) const REGION_M: f64 = MARGIN_M + 0.000_1;
/// Gap that deformed splines keep between robots: above [`MARGIN_M`] by the error of straight stretches, 0.1 mm.
pub(crate) const SPLINE_M: f64 = 0.003_1;
/// Gap from the floor's edge where starts, goals and walls leave it: robots follow their paths within 3 mm.
pub(crate) const EDGE_M: f64 = 0.003_5;
/// Gap that is worth some search: robots follow their paths within 5 mm, most within 2 mm.
pub(crate) const COMFORT_M: f64 = 0.008;
/// Gap between robots of other sizes in the first attempt: as much as [`COMFORT_M`] and the deformation need.
pub(crate) const ROOMY_M: f64 = 0.013_5;

const _: () = assert!(MARGIN_M < ROADMAP_M);
const _: () = assert!(ROADMAP_M < VISIBILITY_M);
const _: () = assert!(VISIBILITY_M < REGION_M);
const _: () = assert!(REGION_M <= SPLINE_M);
const _: () = assert!(SPLINE_M < EDGE_M);
const _: () = assert!(EDGE_M < COMFORT_M);
const _: () = assert!(COMFORT_M < ROOMY_M);
