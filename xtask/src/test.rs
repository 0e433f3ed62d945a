//! `cargo xtask test`: runs all tests, part by part. A failed part does not stop the next ones.

use crate::shell::{self, Outcome};
use crate::{demo, tidy, tools};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Compiler target of the firmware: a Cortex-M4 with floating point.
const FIRMWARE_TARGET: &str = "thumbv7em-none-eabihf";

/// Name of a part, and the function that runs it.
type Part = (&'static str, fn() -> Outcome);

/// All parts, in order.
const PARTS: [Part; 7] = [
    ("tidy", tidy::run),
    ("ui", ui),
    ("lint", lint),
    ("rust", rust),
    ("firmware", firmware),
    ("e2e", e2e),
    ("licences", licences),
];

/// Runs the named parts, or all.
pub fn run(names: &[String]) -> Outcome {
    if let Some(unknown) = names.iter().find(|name| PARTS.iter().all(|part| part.0 != *name)) {
        let known: Vec<_> = PARTS.iter().map(|part| part.0).collect();
        return Err(format!("there is no test part '{unknown}'; there are {}", known.join(", ")));
    }
    let chosen = PARTS.iter().filter(|part| names.is_empty() || names.iter().any(|name| name == part.0));
    let mut failed = Vec::new();
    let mut lines = Vec::new();
    for (name, part) in chosen {
        let began = Instant::now();
        eprintln!("\n=== {name} ===");
        let outcome = part();
        let seconds = began.elapsed().as_secs();
        match outcome {
            Ok(()) => lines.push(format!("{name}: ok ({seconds} s)")),
            Err(message) => {
                eprintln!("xtask: {message}");
                lines.push(format!("{name}: FAILED ({seconds} s): {message}"));
                failed.push(*name);
            }
        }
    }
    println!("\n{}", lines.join("\n"));
    if failed.is_empty() { Ok(()) } else { Err(format!("failed: {}", failed.join(", "))) }
}

fn ui() -> Outcome {
    demo::install_packages()?;
    demo::npm(&["run", "--silent", "lint"])?;
    demo::npm(&["run", "--silent", "test"])?;
    demo::npm(&["run", "--silent", "build"])
}

fn lint() -> Outcome {
    shell::cargo(&["fmt", "--all", "--check"])?;
    shell::cargo(&["clippy", "--quiet", "--workspace", "--all-targets", "--", "-D", "warnings"])
}

/// Name of the integration test with real processes and sockets. It mostly waits, so the other tests run at the same
/// time.
const REAL_TIME: &str = "program";

/// Builds all tests of the workspace at once and runs them. Examples are only linted, because linking them all takes
/// minutes.
fn rust() -> Outcome {
    let mosquitto = tools::MOSQUITTO.provide()?;
    if let Err(message) = tools::RABBITMQ.provide() {
        println!("NOT TESTED: a show on a cluster of brokers of which one dies: {message}");
    }
    shell::run(&mut cargo_test(&["--tests", "--no-run"]))?;
    let mut real_time = cargo_test(&["--test", REAL_TIME]);
    real_time.env("LIGHTBOTS_MOSQUITTO", mosquitto);
    let beside = std::thread::spawn(move || shell::captured(&mut real_time));
    let names = test_programs()?;
    let others = names.iter().filter(|name| *name != REAL_TIME).flat_map(|name| ["--test", name]);
    let others: Vec<&str> = ["--lib", "--bins", "--no-fail-fast"].into_iter().chain(others).collect();
    let tests = shell::run(&mut cargo_test(&others));
    let docs = shell::run(&mut cargo_test(&["--doc", "--no-fail-fast"]));
    let real_time = beside.join().map_err(|_| "the real-time tests were not run".to_owned())?;
    tests.and(docs).and(real_time)
}

/// Names of all integration tests: files in `crates/*/tests`, and folders with a `main.rs` there.
fn test_programs() -> Outcome<BTreeSet<String>> {
    let list =
        |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let crates = shell::root().join("crates");
    let entries = list(&crates).flat_map(|package| list(&package.join("tests")).collect::<Vec<_>>());
    let programs = entries.filter(|path| {
        path.join("main.rs").is_file() || path.extension().is_some_and(|extension| extension == "rs")
    });
    let names: BTreeSet<String> =
        programs.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned())).collect();
    if names.contains(REAL_TIME) { Ok(names) } else { Err(format!("{} has no tests", crates.display())) }
}

/// A `cargo test` command for the whole workspace. A build of single packages would choose other features of
/// dependencies and compile them again.
fn cargo_test(arguments: &[&str]) -> Command {
    let arguments = [&["test", "--workspace"], arguments].concat();
    let mut command = shell::command(".", &shell::cargo_program(), &arguments);
    if std::env::var_os("CI").is_some() {
        // A CI machine builds only once, so incremental files would only cost time.
        command.env("CARGO_INCREMENTAL", "0");
    }
    command
}

fn firmware() -> Outcome {
    let installed = shell::run(&mut shell::command(".", "rustup", &["target", "add", FIRMWARE_TARGET]));
    if let Err(message) = installed {
        println!("NOT TESTED: the robot core for {FIRMWARE_TARGET}: {message}");
        return Ok(());
    }
    shell::cargo(&["build", "--package", "lightbots-robot", "--target", FIRMWARE_TARGET])
}

fn e2e() -> Outcome {
    let chromium = tools::CHROMIUM.provide()?;
    demo::install_packages()?;
    if !shell::root().join("ui/dist/index.html").is_file() {
        demo::build_screen()?;
    }
    shell::run(&mut cargo_test(&["--tests", "--no-run"]))?;
    let program = shell::program("debug");
    let mut command = shell::command("ui", demo::NPM, &["run", "--silent", "e2e"]);
    shell::run(command.env("LIGHTBOTS_BIN", program).env("CHROMIUM", chromium))
}

fn licences() -> Outcome {
    let there = shell::output(&mut shell::command(".", &shell::cargo_program(), &["deny", "--version"]));
    if there.is_err() {
        println!(
            "NOT TESTED: licences and bans of dependencies: `cargo install cargo-deny --locked` brings the tool"
        );
        return Ok(());
    }
    shell::cargo(&["deny", "--offline", "check", "bans", "licenses", "sources"])
}
