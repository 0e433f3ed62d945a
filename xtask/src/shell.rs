//! Runs other programs from the root of the workspace.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Result of a task. The error is one line of text for the terminal.
pub type Outcome<T = ()> = Result<T, String>;

/// The root of the workspace.
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_path_buf()
}

/// A command that starts in `folder`, which is relative to the root of the workspace.
pub fn command(folder: &str, program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root().join(folder));
    command
}

/// Runs a command; its output goes to the terminal.
pub fn run(command: &mut Command) -> Outcome {
    let shown = shown(command);
    eprintln!("$ {shown}");
    let status = command.status().map_err(|error| format!("cannot start `{shown}`: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{shown}` failed: {status}")) }
}

/// Runs a command and prints its output when it has ended, so that outputs of simultaneous commands do not mix.
pub fn captured(command: &mut Command) -> Outcome {
    let shown = shown(command);
    let output = command.output().map_err(|error| format!("cannot start `{shown}`: {error}"))?;
    eprintln!("$ {shown}");
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    print!("{}", String::from_utf8_lossy(&output.stdout));
    if output.status.success() { Ok(()) } else { Err(format!("`{shown}` failed: {}", output.status)) }
}

/// Runs a command and returns its stdout.
pub fn output(command: &mut Command) -> Outcome<String> {
    match printed(command)? {
        (printed, None) => Ok(printed),
        (_, Some(failure)) => Err(failure),
    }
}

/// Runs a command and returns its stdout, with the failure if the command failed. An error if it could not start.
pub fn printed(command: &mut Command) -> Outcome<(String, Option<String>)> {
    let shown = shown(command);
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|error| format!("cannot start `{shown}`: {error}"))?;
    let failure = (!output.status.success()).then(|| format!("`{shown}` failed: {}", output.status));
    Ok((String::from_utf8_lossy(&output.stdout).into_owned(), failure))
}

/// Runs cargo from the root.
pub fn cargo(arguments: &[&str]) -> Outcome {
    run(&mut command(".", &cargo_program(), arguments))
}

/// Runs cargo from the root with additional environment variables.
pub fn cargo_with(arguments: &[&str], environment: &[(&str, &str)]) -> Outcome {
    run(command(".", &cargo_program(), arguments).envs(environment.iter().copied()))
}

/// The cargo that started this program, otherwise the one on the `PATH`.
pub fn cargo_program() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".into())
}

/// Folder of cargo's build outputs: `CARGO_TARGET_DIR`, otherwise `target`.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |dir| root().join(dir))
}

/// Path of the program `lightbots` that cargo built with this profile.
pub fn program(profile: &str) -> PathBuf {
    target().join(profile).join(format!("lightbots{}", std::env::consts::EXE_SUFFIX))
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
