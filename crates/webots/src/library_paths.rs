//! Paths at which libController may be.

use std::path::{Path, PathBuf};

/// File name of the library on this system.
const NAME: &str = if cfg!(windows) {
    "Controller.dll"
} else if cfg!(target_os = "macos") {
    "libController.dylib"
} else {
    "libController.so"
};

/// Folders in which Webots is installed by default.
const INSTALLATIONS: [&str; 4] = [
    "/usr/local/webots",
    "/snap/webots/current/usr/share/webots",
    "/Applications/Webots.app",
    "C:\\Program Files\\Webots",
];

/// Returns all paths to try, in order: the bare name, paths below `home` (the value of `WEBOTS_HOME`), and the default
/// installations. The bare name works because Webots sets the library path of its controllers.
pub(crate) fn candidates(home: Option<&Path>) -> Vec<PathBuf> {
    let homes = home.into_iter().chain(INSTALLATIONS.iter().map(Path::new));
    std::iter::once(PathBuf::from(NAME)).chain(homes.map(inside)).collect()
}

fn inside(home: &Path) -> PathBuf {
    let contents = if cfg!(target_os = "macos") { home.join("Contents") } else { home.to_path_buf() };
    contents.join("lib").join("controller").join(NAME)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bare_name_comes_first_and_the_home_next() {
        let found = candidates(Some(Path::new("/somewhere")));
        assert_eq!(found[0], Path::new(NAME));
        assert!(found[1].starts_with("/somewhere"));
        assert_eq!(found.len(), 2 + INSTALLATIONS.len());
    }
}
