//! What a processor can be asked for that changes nothing but how long things take.

/// A processor that can fetch things from memory before they are looked at.
pub trait Processor {
    /// Begins to fetch the cache line in which this begins.
    fn fetch<T>(&self, what: &T);
}
