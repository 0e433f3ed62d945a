//! Puts the built screen (`ui/dist`) and the example shows (`shows`) into the program.
//!
//! Without a built screen the program builds all the same and serves a page that says how to build it.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR").unwrap_or_default()).join("../..");
    let out = PathBuf::from(env::var("OUT_DIR").unwrap_or_default());
    let (dist, shows) = (root.join("ui/dist"), root.join("shows"));
    make_watchable(&dist);
    for folder in [&dist, &shows] {
        println!("cargo::rerun-if-changed={}", folder.display());
    }
    println!("cargo::rerun-if-changed=build.rs");
    screen(&dist, &out)?;
    examples(&shows, &out)
}

/// Makes an empty folder for the built screen where none is there. While a watched path is missing, Cargo takes every
/// build for the first one and links the program again, 100 s with optimisation. Errors are ignored: they cost that time.
fn make_watchable(folder: &Path) {
    if folder.is_dir() || fs::create_dir(folder).is_err() {
        return;
    }
    // Cargo runs this program again for a path that is younger than its last run.
    let _ = fs::File::open(folder).and_then(|folder| folder.set_modified(SystemTime::UNIX_EPOCH));
}

/// Writes `screen.rs`: path, content type, entity tag and gzipped bytes of every file.
fn screen(dist: &Path, out: &Path) -> io::Result<()> {
    let mut files = Vec::new();
    collect(dist, &mut files)?;
    files.sort();
    let mut code = String::from("static FILES: &[File] = &[\n");
    for (index, file) in files.iter().enumerate() {
        let bytes = fs::read(file)?;
        let packed = out.join(format!("screen-{index}.gz"));
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        encoder.write_all(&bytes)?;
        fs::write(&packed, encoder.finish()?)?;
        let path = file.strip_prefix(dist).unwrap_or(file).to_string_lossy().replace('\\', "/");
        let (kind, tag) = (content_type(&path), format!("\"{:016x}\"", fnv1a(&bytes)));
        let _ = writeln!(
            code,
            "    File {{ path: {path:?}, kind: {kind:?}, tag: {tag:?}, packed: include_bytes!({packed:?}) }},"
        );
    }
    code.push_str("];\n");
    fs::write(out.join("screen.rs"), code)
}

/// Writes `examples.rs`: file name and bytes of every example show.
fn examples(shows: &Path, out: &Path) -> io::Result<()> {
    let mut files = Vec::new();
    collect(shows, &mut files)?;
    files.sort();
    let mut code = String::from("static EXAMPLES: &[(&str, &[u8])] = &[\n");
    for file in files {
        let file = file.canonicalize()?;
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let _ = writeln!(code, "    ({name:?}, include_bytes!({file:?})),");
    }
    code.push_str("];\n");
    fs::write(out.join("examples.rs"), code)
}

/// Adds every file below a folder to `files`; none if the folder is missing.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !folder.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { collect(&path, files)? } else { files.push(path) }
    }
    Ok(())
}

fn content_type(path: &str) -> &'static str {
    match path.rsplit('.').next().unwrap_or("") {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "map" | "webmanifest" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "ico" => "image/x-icon",
        "wasm" => "application/wasm",
        "woff2" => "font/woff2",
        "mp3" => "audio/mpeg",
        "ogg" => "audio/ogg",
        _ => "application/octet-stream",
    }
}

fn fnv1a(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}
