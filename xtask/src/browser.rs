//! `cargo xtask browser`: builds the WebAssembly module of the screen, in `ui/src/generated`.

use std::path::Path;
use std::time::SystemTime;

use wasm_bindgen_cli_support::Bindgen;

use crate::shell::{self, Outcome};

/// Compilation target of the module.
const TARGET: &str = "wasm32-unknown-unknown";

/// Cargo profile of the module.
const PROFILE: &str = "browser";

/// Folder of the module and its JavaScript bindings, from the root of the workspace. Not in version control.
const FOLDER: &str = "ui/src/generated";

/// Builds the module, and writes it with its bindings unless they are newer than the build.
pub fn build() -> Outcome {
    provide_target()?;
    let package = ["build", "--quiet", "--package", "lightbots-browser"];
    shell::cargo(&[&package[..], &["--profile", PROFILE, "--target", TARGET]].concat())?;
    let module = shell::target().join(TARGET).join(PROFILE).join("lightbots_browser.wasm");
    let folder = shell::root().join(FOLDER);
    if is_newer(&folder.join("browser_bg.wasm"), &module) {
        return Ok(());
    }
    bind(&module, &folder).map_err(|error| format!("no bindings for {}: {error:#}", module.display()))
}

/// Installs the standard library for `TARGET` unless its folder exists. rustup is the last resort, because it needs
/// the network.
fn provide_target() -> Outcome {
    let mut command = shell::command(".", "rustc", &["--print", "target-libdir", "--target", TARGET]);
    if shell::output(&mut command).is_ok_and(|folder| Path::new(folder.trim()).is_dir()) {
        return Ok(());
    }
    shell::run(&mut shell::command(".", "rustup", &["target", "add", TARGET])).map_err(|message| {
        format!("{message}; the screen needs the Rust target {TARGET}: connect to the internet once, or install it")
    })
}

/// Whether `file` exists and is newer than `than`. A missing `than` counts as older.
fn is_newer(file: &Path, than: &Path) -> bool {
    let written = |path: &Path| -> Option<SystemTime> { std::fs::metadata(path).ok()?.modified().ok() };
    written(file) > written(than)
}

fn bind(module: &Path, folder: &Path) -> anyhow::Result<()> {
    let mut bindings = Bindgen::new();
    bindings.input_path(module).out_name("browser").web(true)?.typescript(true);
    // Function names are a fifth of the file's size and only help a debugger.
    bindings.remove_name_section(true).remove_producers_section(true).generate(folder)
}
