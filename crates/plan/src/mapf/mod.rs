//! Multi-agent path finding: LaCAM over a configuration generator (PIBT), and the shortening of what it finds.

pub(crate) mod lacam;
pub(crate) mod lattice_pibt;
pub(crate) mod node_assignment;
pub(crate) mod roadmap_pibt;
pub(crate) mod shortening;
