//! One row of the table: a count and the places that were counted.

/// A count over the source tree.
pub struct Measure {
    /// Name in JSON and for `--list`.
    pub key: &'static str,
    /// What is counted.
    pub about: &'static str,
    /// The count.
    pub count: usize,
    /// One line per counted thing, `path:line: text`. Empty if the measure lists no places.
    pub places: Vec<String>,
}

impl Measure {
    /// A count of these places.
    pub fn of(key: &'static str, about: &'static str, places: Vec<String>) -> Self {
        Self { key, about, count: places.len(), places }
    }

    /// A count without places.
    pub fn plain(key: &'static str, about: &'static str, count: usize) -> Self {
        Self { key, about, count, places: Vec::new() }
    }
}
