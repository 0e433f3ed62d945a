//! Shows for tests, as text or files.

use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The folder of this test process, below cargo's folder for integration tests.
pub fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("program-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Makes a folder that no other part of the tests uses.
pub fn own_folder() -> PathBuf {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let folder = folder().join(COUNT.fetch_add(1, Ordering::Relaxed).to_string());
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes a file in a new folder. Returns its path.
pub fn file(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let path = own_folder().join(name);
    std::fs::write(&path, bytes).unwrap();
    path.to_str().unwrap().to_owned()
}

/// A show with a row of `pixels` pixels, 0.1 m apart. From frame to frame, the row moves by 0.1 m away from the front
/// edge. `air_s[k]` is the air time of frame k, seconds.
pub fn row(pixels: usize, air_s: &[f64]) -> String {
    let mut frames = Vec::new();
    for (index, air_s) in air_s.iter().enumerate() {
        let y = 1.2 - 0.1 * index as f64;
        let mut list = String::new();
        for id in 0..pixels {
            let x = 0.1 * (id as f64 - (pixels - 1) as f64 / 2.0);
            let comma = if id == 0 { "" } else { "," };
            write!(list, r##"{comma}{{"id":{id},"place":[{x:.3},{y:.3}],"color":"#ff8000"}}"##).unwrap();
        }
        frames.push(format!(r#"{{"name":"Row {index}","air_time_s":{air_s},"pixels":[{list}]}}"#));
    }
    format!(r#"{{"lightbots":1,"name":"Rows","frames":[{}]}}"#, frames.join(","))
}

/// Writes the show of [`row`] to a file. Returns its path.
pub fn row_file(pixels: usize, air_s: &[f64]) -> String {
    file("rows.lightbots.json", row(pixels, air_s))
}

/// Path of an example show of the repository.
pub fn example(name: &str) -> String {
    format!("{}/../../shows/{name}", env!("CARGO_MANIFEST_DIR"))
}
