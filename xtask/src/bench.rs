//! `cargo xtask bench`: measures, prints tables and writes them to docs/benchmarks.md with machine, date and commit.
//!
//! A part runs a program that prints one JSON object per row. The keys of the first row, in order, are the columns.

use crate::shell::{self, Outcome};
use crate::{demo, tools};
use serde_json::{Map, Value};
use std::fmt::Write as _;
use std::process::Command;

/// The page with all results.
const FILE: &str = "docs/benchmarks.md";
/// Name of the example that times plans in native code.
const NATIVE_PLANS: &str = "native_plans";

struct Part {
    name: &'static str,
    title: &'static str,
    source: Source,
    about: &'static str,
}

/// The program that prints the rows of a part.
enum Source {
    /// An example: its package and its name.
    Example(&'static str, &'static str),
    /// A script of `ui/package.json`, which starts a browser with the built program.
    Browser(&'static str),
    /// A file of `ui/bench`, which runs the WebAssembly module of the browser in Node.js.
    Module(&'static str),
}

/// All parts, in their order on the page.
const PARTS: [Part; 16] = [
    Part {
        name: "plan",
        title: "Planning",
        source: Source::Example("lightbots-plan", "bench"),
        about: "One transition, assignment and proof included, one thread. A ratio is a duration over T_min = \
                bottleneck / 0.27 m/s + 0.62 s; conflicts are pairs that come closer than 57 mm on the way. `capt`: \
                least squared distances, straight synchronised lines, and the proof. `dense`: the assignment alone \
                by the dense solver of the crate `lsap`, judged in the same way; it is not run with ten \
                thousand robots. If all robots are bound to pixels, there is nothing to assign.",
    },
    Part {
        name: "stop-safe",
        title: "Stop-safety",
        source: Source::Example("lightbots-plan", "stop_safe"),
        about: "The share of all moments of a drive, every 50 ms and for each robot, at which that robot may stop dead \
                without a contact, as planned and after robots were delayed for it; one thread. `longer`: the duration \
                after over before. `missing`: distance that a robot behind lacks to stop, at the worst moment. [Places where \
                fixed D of 30 is not stop-safe](stop-safe.svg): all paths, and a dot where a robot must not stop \
                dead, darker for a larger missing distance.",
    },
    Part {
        name: "rehearsal",
        title: "Rehearsal",
        source: Source::Example("lightbots-sim", "speed"),
        about: "A whole show in virtual time with the real controller and robot cores under standard conditions, one \
                thread: seconds of the show per second of the clock, without planning and with it.",
    },
    Part {
        name: "noise",
        title: "Noise",
        source: Source::Example("lightbots-sim", "noise"),
        about: "Distance of driving robots from their own estimates (estimate) and from their routes (tracking), and of \
                standing robots from their pixels, in millimetres: the worst of three seeds of shows/hello.json. \
                Each trouble is added to the standard conditions or replaces one of them. The last rows are other \
                shows under standard conditions, with 3 mm between robots and fixed obstacles.",
    },
    Part {
        name: "round",
        title: "A frame's round",
        source: Source::Example("lightbots-server", "round"),
        about: "From the departure of a frame's first command to the arrival of the last robot's answer, over loopback \
                TCP: the embedded broker, and Mosquitto in the same run.",
    },
    Part {
        name: "light",
        title: "Lights change together",
        source: Source::Example("lightbots-server", "light"),
        about: "From the first robot's light to the last one's, when all change at one moment: robot cores with clocks of \
                their own (up to 50 ppm off), each on its own connection to the embedded broker over loopback TCP. \
                Their lights are sampled every millisecond, all in one pass, so that smaller differences are not \
                visible. `by steps`: the same, sampled only at the robots' steps of 16 ms, which are out of phase.",
    },
    Part {
        name: "light-fit",
        title: "Light as records",
        source: Source::Example("lightbots-lighting", "fit"),
        about: "What a robot's light takes on the wire, per robot and second: eleven effects on 1,000 robots, every \
                hundredth of them for 30 s, in stretches of 10 s. What a robot shows is compared with each sample of 10 ms; \
                it stays within two units of L* (CIE 1976) of each channel's grey, or, where one code is more than that, \
                within one code. `one step`: the same within one code (1/255) of each channel.",
    },
    Part {
        name: "light-step",
        title: "A robot's step with light",
        source: Source::Example("lightbots-robot", "light_step"),
        about: "A step of the robot core on a route with position fixes, without light and with the records of three moving \
                layers (rainbow, chase, twinkle): medians of interleaved runs, and of their ratios.",
    },
    Part {
        name: "light-show",
        title: "A show with light over the broker",
        source: Source::Example("lightbots-server", "light_show"),
        about: "`lightbots play` plays a show with three moving layers (rainbow, chase, twinkle) over the embedded broker on \
                loopback TCP. Simulated robots, each on its own connection, share the cores with them. Each light is \
                compared about six times a second with what the controller wanted (by a replay of its recording); wrong \
                ones show something else than within 25 ms before or after. Messages and bytes (topic and payload) are per \
                robot and second; a broadcast counts once. `cpu s`: processor time of each process.",
    },
    Part {
        name: "siege",
        title: "A show under attack",
        source: Source::Example("lightbots-server", "siege"),
        about: "`lightbots run` plays shows/hello.json with thirty simulated robots repeatedly while its broker and its \
                web server are attacked: packets with changed bytes, topics of ten thousand levels, twenty clients \
                that do not read 10 MB a second, 800 connections without login, 200 messages and 20 uploads that \
                never end, invalid uploads of 60 MB, plans of 3,000 robots. `quiet s`: the show before the attacks; \
                `peak mb`: program and broker together.",
    },
    Part {
        name: "make",
        title: "Frames from words, drawings, pictures and shapes",
        source: Source::Example("lightbots-make", "source_speed"),
        about: "One frame, decoding included, one thread. `full`: what is saved. `preview`: fewer samples and rounds, while a \
                setting changes.",
    },
    Part {
        name: "preview",
        title: "Frames in WebAssembly",
        source: Source::Module("bench/preview.ts"),
        about: "The module of the browser in Node.js, whose engine is Chromium's: a frame while its size changes, with the \
                answer in JSON, the readability and, for `full`, the number of robots that would do.",
    },
    Part {
        name: "browser-plan",
        title: "Plans in WebAssembly",
        source: Source::Module("bench/plan.ts"),
        about: "One transition between random frames, about 30 robots on 9 m², proof included, without the second pass for \
                stop-safety: the module of the browser in Node.js, and the same function natively in the same run. Both \
                read the show from JSON and write the plan as JSON.",
    },
    Part {
        name: "fps",
        title: "Frames a second",
        source: Source::Browser("fps"),
        about: "The built screen in headless Chromium, 1440 × 900, drawn in software, with server, broker and \
                simulated robots on the same cores. Counted are frames in which the stage was drawn, while all pixels \
                are dragged in the editor, and while a show in which all robots drive is watched. In the scenes of the \
                timeline, with 200 frames and 50 layers, those frames count that the browser put on the screen.",
    },
    Part {
        name: "sound",
        title: "Music and the show",
        source: Source::Browser("sound"),
        about: "Five minutes of clicks with 30 simulated robots, a pause of 5 s, and one robot whose process stands still for \
                1.5 s every 17 s, so that all others hold for it: how far music is ahead of the show's position. Told by the audio clock of headless Chromium at \
                each state of the show, and by an outside recording: PulseAudio plays into a device without a loudspeaker \
                and `parec` records it.",
    },
    Part {
        name: "long-run",
        title: "Half an hour",
        source: Source::Browser("long-run"),
        about: "A show with three moving layers is repeated for half an hour with simulated robots, watched in three tabs \
                of headless Chromium, two of them hidden. Memory of the program and its broker is resident; that of the \
                page is what its scripts use after a collection. `report s`: from asking for the report of that run to its \
                heading.",
    },
];

/// Runs the named parts, or all.
pub fn run(names: &[String]) -> Outcome {
    if let Some(unknown) = names.iter().find(|name| PARTS.iter().all(|part| part.name != *name)) {
        let known: Vec<_> = PARTS.iter().map(|part| part.name).collect();
        return Err(format!("there is no bench part '{unknown}'; there are {}", known.join(", ")));
    }
    let mut failures = Vec::new();
    for part in PARTS.iter().filter(|part| names.is_empty() || names.iter().any(|name| name == part.name)) {
        let measured = measure(part)?;
        if let Some(section) = section(part, &measured)? {
            println!("{section}");
            keep(part, &section)?;
        }
        failures.extend(measured.failure.map(|failure| format!("{}: {failure}", part.name)));
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("; ")) }
}

/// The rows that a part printed, and the failure if its program failed.
struct Measured {
    rows: Vec<Map<String, Value>>,
    failure: Option<String>,
}

fn measure(part: &Part) -> Outcome<Measured> {
    eprintln!("measuring {}", part.name);
    let mut command = match part.source {
        Source::Example(package, example) => example_command(part.name, package, example)?,
        Source::Browser(script) => browser_command(script)?,
        Source::Module(file) => module_command(file)?,
    };
    let (printed, failure) = shell::printed(&mut command)?;
    Ok(Measured { rows: rows(&printed), failure })
}

fn rows(printed: &str) -> Vec<Map<String, Value>> {
    printed.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// The part's section of the page. `None` if the program failed without a row, so that the old section stays.
/// An error if the program succeeded without a row.
fn section(part: &Part, measured: &Measured) -> Outcome<Option<String>> {
    if measured.rows.is_empty() {
        return match &measured.failure {
            Some(_) => Ok(None),
            None => Err(format!("the bench of {} printed no rows", part.name)),
        };
    }
    let incomplete = if measured.failure.is_some() { "\n\nNot all of it could be measured." } else { "" };
    let rows = table(&measured.rows);
    Ok(Some(format!("## {}\n\n{}\n\n{}{incomplete}\n\n{rows}", part.title, part.about, machine()?)))
}

fn example_command(part: &str, package: &str, example: &str) -> Outcome<Command> {
    let arguments =
        ["run", "--quiet", "--release", "--package", package, "--example", example, "--", "--json"];
    let mut command = shell::command(".", &shell::cargo_program(), &arguments);
    if package == "lightbots-server" {
        build_server()?;
    }
    if part == "round" {
        command.env("LIGHTBOTS_MOSQUITTO", tools::MOSQUITTO.provide()?);
    }
    Ok(command)
}

fn browser_command(script: &str) -> Outcome<Command> {
    let chromium = tools::CHROMIUM.provide()?;
    demo::install_packages()?;
    demo::build_screen()?;
    build_server()?;
    let program = shell::program("release");
    let mut command = shell::command("ui", demo::NPM, &["run", "--silent", script]);
    command.env("LIGHTBOTS_BIN", program).env("CHROMIUM", chromium);
    Ok(command)
}

fn module_command(file: &str) -> Outcome<Command> {
    demo::install_packages()?;
    demo::build_screen()?;
    let native =
        ["build", "--quiet", "--release", "--package", "lightbots-browser", "--example", NATIVE_PLANS];
    shell::cargo(&native)?;
    let program = shell::target().join("release/examples").join(NATIVE_PLANS);
    let mut command = shell::command("ui", demo::NPM, &["run", "--silent", "module-times", "--", file]);
    command.env("LIGHTBOTS_NATIVE_PLANS", program.with_extension(std::env::consts::EXE_EXTENSION));
    Ok(command)
}

fn build_server() -> Outcome {
    shell::cargo(&["build", "--quiet", "--release", "--package", "lightbots-server"])
}

/// A Markdown table with one column per key of the first row.
fn table(rows: &[Map<String, Value>]) -> String {
    let columns: Vec<&String> = rows.first().into_iter().flat_map(Map::keys).collect();
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let mut text = line(columns.iter().map(|name| name.replace('_', " ")).collect());
    text += &line(columns.iter().map(|_| "---".into()).collect());
    for row in rows {
        text += &line(columns.iter().map(|name| cell(row.get(*name))).collect());
    }
    text
}

fn cell(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "–".into(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Number(number)) => match number.as_f64() {
            Some(value) if number.is_f64() => three_digits(value),
            _ => number.to_string(),
        },
        Some(other) => other.to_string(),
    }
}

fn three_digits(value: f64) -> String {
    let decimals = match value.abs() {
        large if large >= 100.0 => 0,
        medium if medium >= 10.0 => 1,
        small if small >= 1.0 => 2,
        _ => 3,
    };
    format!("{value:.decimals$}")
}

fn machine() -> Outcome<String> {
    let about = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = about.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let now =
        std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let commit =
        shell::output(&mut shell::command(".", "git", &["rev-parse", "--short", "HEAD"])).unwrap_or_default();
    let mut text = String::new();
    let _ = write!(
        text,
        "{} of commit {}: {cores} cores of {}",
        date(now),
        commit.trim(),
        model.unwrap_or("unknown make")
    );
    Ok(text)
}

/// The civil date of a Unix time, by Howard Hinnant's algorithm `civil_from_days`.
fn date(unix_seconds: u64) -> String {
    let days = unix_seconds / 86_400 + 719_468;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let (day, month) =
        (day_of_year - (153 * shifted + 2) / 5 + 1, if shifted < 10 { shifted + 3 } else { shifted - 9 });
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year}-{month:02}-{day:02}")
}

/// Replaces the section of this part in `FILE`, or appends it, and leaves the other sections.
fn keep(part: &Part, section: &str) -> Outcome {
    let path = shell::root().join(FILE);
    let old = std::fs::read_to_string(&path).unwrap_or_default();
    std::fs::write(&path, replaced(&old, &format!("## {}", part.title), section))
        .map_err(|error| format!("cannot write {FILE}: {error}"))
}

fn replaced(old: &str, heading: &str, section: &str) -> String {
    let mut sections: Vec<String> = Vec::new();
    for line in old.lines() {
        if line.starts_with("## ") || sections.is_empty() {
            sections.push(String::new());
        }
        if let Some(last) = sections.last_mut() {
            last.push_str(line);
            last.push('\n');
        }
    }
    if sections.is_empty() {
        sections
            .push("# Benchmarks\n\nMeasured by `cargo xtask bench` in a release build; medians.\n".into());
    }
    match sections.iter_mut().find(|found| found.lines().next() == Some(heading)) {
        Some(found) => *found = section.to_owned(),
        None => sections.push(section.to_owned()),
    }
    sections.iter().map(|section| section.trim_end()).collect::<Vec<_>>().join("\n\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_civil() {
        assert_eq!(date(0), "1970-01-01");
        assert_eq!(date(1_795_305_600), "2026-11-22");
        assert_eq!(date(951_782_400), "2000-02-29");
    }

    #[test]
    fn what_was_measured_before_a_failure_is_kept() {
        let measured = |printed: &str, failure: Option<&str>| {
            let measured = Measured { rows: rows(printed), failure: failure.map(str::to_owned) };
            section(&PARTS[0], &measured)
        };
        let half = measured("some words\n{\"robots\":30}\nand more", Some("it broke")).unwrap().unwrap();
        assert!(half.contains("| 30 |") && half.contains("Not all of it could be measured."), "{half}");
        assert!(!measured("{\"robots\":30}", None).unwrap().unwrap().contains("Not all"));
        assert_eq!(measured("nothing", Some("it broke")), Ok(None));
        assert!(measured("nothing", None).is_err());
    }

    #[test]
    fn a_section_is_replaced_and_others_stay() {
        let old = "# T\n\n## A\n\nold\n\n## B\n\nstays\n";
        assert_eq!(replaced(old, "## A", "## A\n\nnew\n"), "# T\n\n## A\n\nnew\n\n## B\n\nstays\n");
        assert!(replaced(old, "## C", "## C\n\nmore").ends_with("stays\n\n## C\n\nmore\n"));
    }
}
