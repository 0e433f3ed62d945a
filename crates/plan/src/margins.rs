//! The margins that the planner keeps, in ascending order: the proof checks the smallest, and solvers aim at larger
//! ones. All are metres between two rims, or between a rim and a wall or the floor's edge.

/// Least gap between rims, and between a rim and a wall, that the proof demands. A robot that starts or ends closer
/// need only keep that smaller gap. The value covers a usual path error, 2 mm, and the rounding of messages. With a
/// smaller gap, robots touch in rehearsals; with a larger one, robots no longer pass narrow gaps.
pub(crate) const MARGIN_M: f64 = 0.003;
/// Gap that the roadmap keeps from walls. It exceeds [`MARGIN_M`] by the rounding error of the roadmap's distances.
pub(crate) const ROADMAP_M: f64 = 0.003_01;
/// Gap that the paths of the visibility graph keep from walls. It exceeds [`ROADMAP_M`], because splines cut the
/// corners of these paths.
pub(crate) const VISIBILITY_M: f64 = 0.003_05;
/// Gap from walls at which a place counts as free when the floor is divided into regions. It exceeds [`VISIBILITY_M`],
/// so that every solver can pass through a free region.
pub(crate) const REGION_M: f64 = MARGIN_M + 0.000_1;
/// Gap that deformed splines keep between robots. The deformation approximates splines by straight stretches; the 0.1
/// mm above [`MARGIN_M`] covers that error.
pub(crate) const SPLINE_M: f64 = 0.003_1;
/// Gap between rims and the floor's edge. The value covers a path error of 3 mm. The gap is smaller where starts, goals
/// or walls force robots closer to the edge.
pub(crate) const EDGE_M: f64 = 0.003_5;
/// Gap that solvers aim at if it costs little time. The value covers a path error of 5 mm, although most path errors
/// are below 2 mm.
pub(crate) const COMFORT_M: f64 = 0.008;
/// Gap between robots that [`Scale`](crate::solve) tries first to keep, if robots do not have the Elisa-3's size. It
/// exceeds [`COMFORT_M`] to leave room for the deformation.
pub(crate) const ROOMY_M: f64 = 0.013_5;

const _: () = assert!(MARGIN_M < ROADMAP_M);
const _: () = assert!(ROADMAP_M < VISIBILITY_M);
const _: () = assert!(VISIBILITY_M < REGION_M);
const _: () = assert!(REGION_M <= SPLINE_M);
const _: () = assert!(SPLINE_M < EDGE_M);
const _: () = assert!(EDGE_M < COMFORT_M);
const _: () = assert!(COMFORT_M < ROOMY_M);
