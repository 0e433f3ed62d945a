//! Graphs of free places on the floor, and shortest paths over them.

pub(crate) mod graph;
pub(crate) mod lattice;
pub(crate) mod regions;
pub(crate) mod roadmap;
pub(crate) mod shortest;
pub(crate) mod visibility;
