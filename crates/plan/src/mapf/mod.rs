//! Multi-agent path finding: LaCAM over the steps of PIBT, and the shortening of what it finds.

pub(crate) mod lacam;
pub(crate) mod lattice_rule;
pub(crate) mod node_assignment;
pub(crate) mod pibt;
pub(crate) mod roadmap_rule;
pub(crate) mod shortening;
