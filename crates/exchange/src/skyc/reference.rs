//! Names of files in the archive, as the document refers to them.

/// The name of the file in the archive to which `reference` refers: `./drones/1/lights.json#` becomes
/// `drones/1/lights.json`.
pub(super) fn file_name(reference: &str) -> &str {
    let name = reference.strip_prefix("./").unwrap_or(reference);
    let name = name.strip_suffix('/').unwrap_or(name);
    name.strip_suffix('#').unwrap_or(name)
}
