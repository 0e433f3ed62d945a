//! `cargo xtask fuzz`: runs coverage-guided fuzzers. They need a nightly compiler and `cargo-fuzz`.

use crate::shell::{self, Outcome};

/// A fuzzer's name, and the folder of its corpus, whose files the usual tests read too.
type Fuzzer = (&'static str, &'static str);

const FUZZERS: [Fuzzer; 4] = [
    ("show", "crates/exchange/tests/corpus/show"),
    ("sequence", "crates/exchange/tests/corpus/sequence"),
    ("wire", "crates/wire/tests/corpus"),
    ("svg", "crates/draw/tests/corpus/svg"),
];

/// How long each fuzzer runs if the command line names no duration, seconds.
const SECONDS: &str = "600";

/// Runs the named fuzzer, or all one after another. The arguments are `[NAME [SECONDS]]`.
pub fn run(arguments: &[String]) -> Outcome {
    let name = arguments.first().map(String::as_str);
    let seconds = arguments.get(1).map_or(SECONDS, String::as_str);
    let chosen: Vec<&Fuzzer> =
        FUZZERS.iter().filter(|fuzzer| name.is_none_or(|name| name == fuzzer.0)).collect();
    if chosen.is_empty() {
        let known: Vec<_> = FUZZERS.iter().map(|fuzzer| fuzzer.0).collect();
        return Err(format!("there is no such fuzzer; there are {}", known.join(", ")));
    }
    for (name, kept) in chosen {
        // The fuzzer writes new inputs into the first folder, which is not in version control.
        let found = format!("fuzz/corpus/{name}");
        std::fs::create_dir_all(shell::root().join(&found)).map_err(|error| format!("{found}: {error}"))?;
        let limit = format!("-max_total_time={seconds}");
        let arguments = [
            "+nightly",
            "fuzz",
            "run",
            name,
            &found,
            kept,
            "--",
            &limit,
            "-timeout=10",
            "-rss_limit_mb=1024",
        ];
        // The toolchain that built this program must not replace the nightly toolchain of the fuzzers.
        let mut command = shell::command(".", "cargo", &arguments);
        command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN");
        shell::run(&mut command).map_err(|message| {
            format!("{message}; bytes that broke it are in fuzz/artifacts/{name}: keep them in {kept}")
        })?;
    }
    Ok(())
}
