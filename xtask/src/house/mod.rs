//! `cargo xtask house`: counts that show how easy the source tree is to read.

mod constants;
mod docs;
pub mod functions;
mod measure;
pub mod modules;
mod modules_scope;
pub mod names;
pub mod tree;

use crate::shell::{self, Outcome};
use measure::Measure;
use std::path::PathBuf;
use tree::Source;

/// Most words in a sentence of a doc comment, because a reader should need to read it only once.
const SENTENCE_WORDS_MAX: usize = 25;
/// Most lines of a function that fits on one screen.
const SCREEN_LINES: usize = 40;
/// Most lines of a function. `tidy` reports longer ones as findings.
pub const FUNCTION_LINES_MAX: usize = 70;

/// Text of `--help`.
const HELP: &str = "\
cargo xtask house [--json] [--tree DIR] [--list KEY]

Counts what makes the source tree easy or hard to read, over crates/*/src and xtask/src. Code in
test modules counts for files, lines and doc comments only.

  --json       print JSON instead of a table
  --tree DIR   count in another checkout, to compare with an older commit
  --list KEY   print each place that the row KEY counts
";

#[derive(Debug, Default, PartialEq)]
struct Options {
    json: bool,
    help: bool,
    tree: Option<PathBuf>,
    list: Option<String>,
}

/// Counts, and prints a table, JSON, or the places of one row.
pub fn run(arguments: &[String]) -> Outcome {
    let options = parse(arguments)?;
    if options.help {
        println!("{HELP}");
        return Ok(());
    }
    let root = options.tree.unwrap_or_else(shell::root);
    let (sources, broken) = tree::read(&root);
    for message in broken {
        eprintln!("xtask: not counted: {message}");
    }
    if sources.is_empty() {
        return Err(format!("{} holds no crates/*/src", root.display()));
    }
    let measures = measures(&sources);
    match options.list {
        Some(key) => list(&measures, &key)?,
        None if options.json => println!("{:#}", json(&measures, &sources)),
        None => print_table(&measures, &sources),
    }
    Ok(())
}

fn parse(arguments: &[String]) -> Outcome<Options> {
    let mut options = Options::default();
    let mut left = arguments.iter();
    while let Some(argument) = left.next() {
        let mut value = || left.next().ok_or_else(|| format!("{argument} needs a value"));
        match argument.as_str() {
            "--json" => options.json = true,
            "--help" | "-h" => options.help = true,
            "--tree" => options.tree = Some(value()?.into()),
            "--list" => options.list = Some(value()?.clone()),
            other => return Err(format!("house has no option '{other}'\n\n{HELP}")),
        }
    }
    Ok(options)
}

fn measures(sources: &[Source]) -> Vec<Measure> {
    let mut all = vec![
        Measure::plain("files", "Rust files of crates/*/src and xtask/src", sources.len()),
        Measure::plain(
            "lines",
            "lines in them",
            sources.iter().map(|source| source.text.lines().count()).sum(),
        ),
    ];
    all.extend(constant_measures(sources));
    all.extend(structure_measures(sources));
    all.extend(function_measures(sources));
    all.extend(doc_measures(sources));
    all.push(cache_hooks(sources));
    all
}

fn constant_measures(sources: &[Source]) -> Vec<Measure> {
    let constants: Vec<_> = sources
        .iter()
        .flat_map(|source| {
            constants::constants(&source.syntax).into_iter().map(move |constant| (source, constant))
        })
        .collect();
    let places = |holds: &dyn Fn(&constants::Constant) -> bool| -> Vec<String> {
        let found = constants.iter().filter(|(_, constant)| holds(constant));
        found
            .map(|(source, constant)| format!("{}:{}: {}", source.path, constant.line, constant.name))
            .collect()
    };
    vec![
        Measure::of("constants", "constants", places(&|_| true)),
        Measure::of(
            "constants_numeric",
            "constants that hold a number other than 0",
            places(&|constant| constant.numeric),
        ),
        Measure::of(
            "constants_without_doc",
            "constants without a doc of their own",
            places(&|constant| constant.doc.trim().is_empty()),
        ),
        Measure::of(
            "constants_without_source",
            "numeric constants without a source",
            places(&|constant| constant.numeric && !constant.has_source()),
        ),
    ]
}

fn structure_measures(sources: &[Source]) -> Vec<Measure> {
    let doubled = names::doubled(sources).into_iter();
    let circles = modules::circles(sources);
    let edges = modules::circle_edges(sources, &circles);
    vec![
        Measure::of(
            "type_names_doubled",
            "type names visible outside their file that stand in more than one place",
            doubled.map(|(name, places)| format!("{name}: {}", places.join(", "))).collect(),
        ),
        Measure::of(
            "circles",
            "circles of files inside a crate",
            circles.iter().map(|circle| format!("{} files: {}", circle.len(), circle.join(", "))).collect(),
        ),
        Measure::of("circle_edges", "uses of one file by another inside a circle", edges),
    ]
}

fn function_measures(sources: &[Source]) -> Vec<Measure> {
    let functions: Vec<_> = sources
        .iter()
        .flat_map(|source| {
            functions::functions(&source.syntax).into_iter().map(move |function| (source, function))
        })
        .collect();
    let longer = |most: usize| -> Vec<String> {
        let found = functions.iter().filter(|(_, function)| function.lines > most);
        found
            .map(|(source, f)| format!("{}:{}: {}, {} lines", source.path, f.line, f.name, f.lines))
            .collect()
    };
    vec![
        Measure::plain("functions", "functions with a body", functions.len()),
        Measure::of("functions_above_screen", "functions above 40 lines", longer(SCREEN_LINES)),
        Measure::of("functions_above_max", "functions above 70 lines", longer(FUNCTION_LINES_MAX)),
    ]
}

fn doc_measures(sources: &[Source]) -> Vec<Measure> {
    let places = |find: &dyn Fn(&str) -> Vec<docs::Place>| -> Vec<String> {
        let found = sources
            .iter()
            .flat_map(|source| find(&source.text).into_iter().map(move |place| (source, place)));
        found.map(|(source, place)| format!("{}:{}: {}", source.path, place.line, place.text)).collect()
    };
    vec![
        Measure::of(
            "sentences_long",
            "doc sentences above 25 words",
            places(&|text| docs::long_sentences(text, SENTENCE_WORDS_MAX)),
        ),
        Measure::of(
            "persons",
            "doc lines with who, whom, whoever, nobody, everybody or somebody",
            places(&docs::persons),
        ),
        Measure::of(
            "vague",
            "doc lines with \"so\" before many, much, far, often, long, near or badly",
            places(&docs::vague),
        ),
    ]
}

/// Counts code in the robot core that serves only the simulator's cache: `fetch` functions and `repr(C)`.
fn cache_hooks(sources: &[Source]) -> Measure {
    let robot = sources.iter().filter(|source| source.krate() == "crates/robot");
    let lines = robot
        .flat_map(|source| source.text.lines().enumerate().map(move |(number, line)| (source, number, line)));
    let hooks = lines.filter(|(_, _, line)| {
        line.contains("repr(C")
            || line
                .split_once("fn ")
                .is_some_and(|(_, name)| name.split('(').next().is_some_and(|name| name.contains("fetch")))
    });
    let places =
        hooks.map(|(source, number, line)| format!("{}:{}: {}", source.path, number + 1, line.trim()));
    Measure::of(
        "cache_hooks",
        "cache hooks (`fetch` functions and `repr(C)`) in the robot core",
        places.collect(),
    )
}

fn list(measures: &[Measure], key: &str) -> Outcome {
    let Some(measure) = measures.iter().find(|measure| measure.key == key) else {
        let keys: Vec<_> = measures.iter().map(|measure| measure.key).collect();
        return Err(format!("no row is called '{key}'; there are {}", keys.join(", ")));
    };
    measure.places.iter().for_each(|place| println!("{place}"));
    Ok(())
}

fn json(measures: &[Measure], sources: &[Source]) -> serde_json::Value {
    let counts: serde_json::Map<String, serde_json::Value> =
        measures.iter().map(|measure| (measure.key.to_owned(), measure.count.into())).collect();
    let structs: serde_json::Map<String, serde_json::Value> = names::largest_structs(sources)
        .into_iter()
        .map(|(krate, name, fields)| (krate, serde_json::json!({ "struct": name, "public_fields": fields })))
        .collect();
    serde_json::json!({
        "counts": counts,
        "circles": modules::circles(sources),
        "type_names_doubled": names::doubled(sources),
        "largest_structs": structs,
    })
}

fn print_table(measures: &[Measure], sources: &[Source]) {
    for measure in measures {
        println!("{:>6}  {:<28} {}", measure.count, measure.key, measure.about);
    }
    println!("\nPublic fields of the largest struct of each crate:");
    for (krate, name, fields) in names::largest_structs(sources) {
        println!("{fields:>6}  {krate:<28} {name}");
    }
    for key in ["circles", "type_names_doubled", "functions_above_max"] {
        let measure = measures.iter().find(|measure| measure.key == key && measure.count > 0);
        if let Some(measure) = measure {
            println!("\n{}:", measure.about);
            measure.places.iter().for_each(|place| println!("  {place}"));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_read_in_any_order() {
        let words = ["--list", "circles", "--json", "--tree", "old"].map(str::to_owned);
        let expected =
            Options { json: true, help: false, tree: Some("old".into()), list: Some("circles".to_owned()) };
        assert_eq!(parse(&words), Ok(expected));
        assert!(parse(&["--tree".to_owned()]).is_err());
        assert!(parse(&["--wide".to_owned()]).is_err());
    }

    #[test]
    fn every_row_is_counted_on_a_small_tree() {
        let text = "#[repr(C)] pub struct A { pub b: u8 }\n/// Whoever is so near.\nconst C: u8 = 1;\nfn prefetch() {}\n";
        let sources = [tree::parsed("crates/robot/src/lib.rs", text)];
        let counts: Vec<_> = measures(&sources).iter().map(|measure| (measure.key, measure.count)).collect();
        let expected = [
            ("files", 1),
            ("lines", 4),
            ("constants", 1),
            ("constants_numeric", 1),
            ("constants_without_doc", 0),
            ("constants_without_source", 1),
            ("type_names_doubled", 0),
            ("circles", 0),
            ("circle_edges", 0),
            ("functions", 1),
            ("functions_above_screen", 0),
            ("functions_above_max", 0),
            ("sentences_long", 0),
            ("persons", 1),
            ("vague", 1),
            ("cache_hooks", 2),
        ];
        assert_eq!(counts, expected);
    }
}
