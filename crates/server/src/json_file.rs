//! Small JSON files in the data folder that only this program writes.

use std::io::{Error, ErrorKind};
use std::path::Path;

use serde::de::DeserializeOwned;

use crate::disk;

/// Reads a file of at most `most` bytes. The result is the default value if the file is missing, cannot be read or is
/// invalid. In the last two cases the file is renamed first, if that is possible, so that no later save replaces it. An
/// earlier file that was renamed so is replaced.
pub fn load<T: DeserializeOwned + Default>(path: &Path, most: u64) -> T {
    let read =
        disk::read_regular(path, most).and_then(|bytes| serde_json::from_slice(&bytes).map_err(Error::from));
    read.unwrap_or_else(|error| {
        if error.kind() != ErrorKind::NotFound {
            keep_aside(path, &error);
        }
        T::default()
    })
}

fn keep_aside(path: &Path, why: &Error) {
    let aside = path.with_extension("json.unreadable");
    tracing::warn!("{} cannot be used: {why}. It is kept as {}.", path.display(), aside.display());
    if let Err(error) = disk::rename(path, &aside) {
        tracing::warn!("{} cannot be renamed: {error}", path.display());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_cannot_be_used_is_kept_aside() {
        let folder = std::env::temp_dir().join(format!("lightbots-json-file-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (path, aside) = (folder.join("a.json"), folder.join("a.json.unreadable"));
        assert_eq!(load::<Vec<u8>>(&path, 9), Vec::<u8>::new());
        assert!(!aside.exists(), "a missing file is no error");
        for (text, most, expected) in [("[1,2]", 5, vec![1, 2]), ("[1,2]", 4, vec![]), ("[1,", 9, vec![])] {
            std::fs::write(&path, text).unwrap();
            assert_eq!(load::<Vec<u8>>(&path, most), expected);
            assert_eq!(path.exists(), !expected.is_empty());
            assert_eq!(aside.exists(), expected.is_empty());
        }
        std::fs::remove_dir_all(folder).unwrap();
    }
}
