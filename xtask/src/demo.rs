//! `cargo xtask demo`: from a fresh clone to a show in the browser.

use crate::shell::{self, Outcome};

/// Show that the demo plays if the arguments name none.
const SHOW: &str = "shows/countdown.json";

/// File name of npm on this system.
pub const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

/// Builds the screen and the program, and runs `lightbots run` with these arguments, or with `SHOW` added if all of
/// them are options.
pub fn run(arguments: &[String]) -> Outcome {
    build_screen()?;
    shell::cargo(&["build", "--release", "--package", "lightbots-server"])?;
    let program = shell::program("release");
    let mut command = shell::command(".", &program.to_string_lossy(), &["run"]);
    if !arguments.iter().any(|argument| !argument.starts_with('-')) {
        command.arg(SHOW);
    }
    command.args(arguments);
    shell::run(&mut command)
}

/// Installs the screen's packages and builds the screen.
pub fn build_screen() -> Outcome {
    install_packages()?;
    npm(&["run", "--silent", "build"])
}

/// Installs the screen's packages, unless they are up to date.
pub fn install_packages() -> Outcome {
    let ui = shell::root().join("ui");
    let modified = |file: &str| std::fs::metadata(ui.join(file)).and_then(|data| data.modified()).ok();
    if modified("node_modules/.package-lock.json") >= modified("package-lock.json") {
        return Ok(());
    }
    npm(&["ci", "--no-audit", "--no-fund"])
}

/// Runs npm in `ui/`.
pub fn npm(arguments: &[&str]) -> Outcome {
    shell::run(&mut shell::command("ui", NPM, arguments))
        .map_err(|message| format!("{message} (Node.js 20 or newer with npm is needed)"))
}
