//! Access rights of the file of a private key.

use std::path::Path;

/// Makes a key file readable for its owner only, unless it is a link. Returns a line for people if other users of the
/// machine had rights to the file, or still have them.
#[cfg(unix)]
pub fn keep_private(key: &Path) -> Option<String> {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::PermissionsExt;

    let mode = fs::metadata(key).ok()?.permissions().mode() & 0o777;
    if mode & 0o077 == 0 {
        return None;
    }
    let name = key.display();
    // A link is left as it is, because the file behind it belongs to another program.
    let is_link = fs::symlink_metadata(key).is_ok_and(|about| about.is_symlink());
    if !is_link && fs::set_permissions(key, Permissions::from_mode(0o600)).is_ok() {
        return Some(format!(
            "Other users of this machine could use the key {name} (mode {mode:o}); now only its owner can. If one of \
             them may have copied it, make another"
        ));
    }
    Some(format!("Other users of this machine can use the key {name} (mode {mode:o}): chmod 600 {name}"))
}

/// Does nothing, because other systems have other access rights.
#[cfg(not(unix))]
pub fn keep_private(_: &Path) -> Option<String> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs::{self, Permissions};
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    #[test]
    fn a_key_that_others_can_read_is_closed_and_named_once() {
        let folder = std::env::temp_dir().join(format!("lightbots-key-file-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let (key, link) = (folder.join("server.key"), folder.join("link.key"));
        fs::write(&key, b"key").unwrap();
        symlink(&key, &link).unwrap();
        let mode = || fs::metadata(&key).unwrap().permissions().mode() & 0o777;
        fs::set_permissions(&key, Permissions::from_mode(0o640)).unwrap();
        let line = keep_private(&link).unwrap();
        assert!(line.contains("chmod 600") && mode() == 0o640, "{line}");
        let line = keep_private(&key).unwrap();
        assert!(line.contains("server.key (mode 640); now only its owner"), "{line}");
        assert_eq!((mode(), keep_private(&key), keep_private(&link)), (0o600, None, None));
        fs::remove_dir_all(folder).unwrap();
    }
}
