//! Generates the page `docs/api.md`: an introduction, and tables of requests, messages and types from this crate's
//! source.

mod markdown;
mod roles;
mod source;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lightbots_exchange::FORMATS;

use markdown::Links;
use roles::Roles;
use source::{RequestTable, Shape, TypeDoc, VariantDoc};

/// Types of the WebSocket, which have their own sections.
const WEBSOCKET: [&str; 4] = ["ToScreen", "FromScreen", "Operation", "Robots"];
/// Requests that are no part of the API: the screen's page, its WebSocket, and unknown addresses, which get a 404.
const NOT_OF_THE_API: [&str; 3] = ["GET /", "GET /ws", "GET /api/{*rest}"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Path of the page.
pub fn file() -> PathBuf {
    root().join("docs/api.md")
}

/// The text of the page.
///
/// # Panics
/// If a request has no role in SECURITY.md, or no row in the docs of a module.
pub fn page() -> String {
    let (tables, types) = source::read(&root().join("crates/api/src"));
    let security = std::fs::read_to_string(root().join("SECURITY.md")).expect("there is a SECURITY.md");
    let roles = Roles::read(&security);
    check(&tables, &roles);
    let wanted = reachable(&tables, &types);
    let links = Links(&wanted);
    let find = |name: &str| types.iter().find(|one| one.name == name).expect("it is a type of this crate");
    let variants = |name: &str| match &find(name).shape {
        Shape::Tagged { tag, variants } => (tag.clone(), &variants[..]),
        _ => panic!("{name} has a tag"),
    };
    let mut text = include_str!("introduction.md").to_owned();
    text.push_str("\n## Requests\n");
    for table in &tables {
        text.push_str(&format!("\n### {}\n", table.title));
        text.push_str("| request | role | body | answer |\n|---|---|---|---|\n");
        for [request, body, answer] in &table.rows {
            let role = roles.of(bare(request));
            text.push_str(&format!("| {request} | {role} | {} | {} |\n", links.set(body), links.set(answer)));
        }
    }
    text.push_str("\n### Formats of show files\n");
    text.push_str("The server recognises a format by the bytes of a file.\n\n");
    text.push_str("| name | program | endings | media type |\n|---|---|---|---|\n");
    for format in FORMATS {
        let endings = format.endings.join("` `");
        text.push_str(&format!(
            "| `{}` | {} | `{endings}` | `{}` |\n",
            format.name, format.program, format.media_type
        ));
    }
    text.push('\n');
    text.push_str(include_str!("websocket.md"));
    text.push_str("\n### Messages from the server\n");
    text.push_str(&markdown::messages(&links, &find("ToScreen").docs, variants("ToScreen")));
    text.push_str("\n### Messages to the server\n");
    text.push_str(&markdown::messages(&links, &find("FromScreen").docs, variants("FromScreen")));
    text.push_str("\n### Operations\n");
    let (_, operations) = variants("Operation");
    text.push_str(&operation_table(&links, &roles, &find("Operation").docs, operations));
    text.push_str("\n### Robots\n");
    text.push_str(&markdown::binary(&links, find("Robots")));
    text.push_str("\n## Types\n");
    for one in types.iter().filter(|one| wanted.contains(&one.name) && !WEBSOCKET.contains(&&*one.name)) {
        text.push_str(&markdown::section(&links, one));
    }
    text
}

/// A request without backticks and query, such as `GET /api/shows`.
fn bare(request: &str) -> &str {
    let text = request.trim_matches('`');
    text.split_once('?').map_or(text, |(path, _)| path)
}

/// Checks that each route of the table in SECURITY.md has exactly one row in the docs, and each row a route. A test
/// compares that table with the server.
fn check(tables: &[RequestTable], roles: &Roles) {
    let rows: Vec<&str> =
        tables.iter().flat_map(|table| table.rows.iter().map(|row| bare(&row[0]))).collect();
    for route in roles.routes().filter(|route| !NOT_OF_THE_API.contains(route)) {
        let count = rows.iter().filter(|row| **row == route).count();
        assert_eq!(
            count, 1,
            "{route} needs one row in a table of crates/api/src; see the module `library` for one"
        );
    }
    for row in rows {
        assert!(roles.routes().any(|route| route == row), "{row} is missing in the table of SECURITY.md");
    }
}

fn operation_table(links: &Links<'_>, roles: &Roles, docs: &str, operations: &[VariantDoc]) -> String {
    let mut text = format!("{}\n\n", links.set(docs));
    text.push_str("| `do` | role | what it does | further fields |\n|---|---|---|---|\n");
    for operation in operations {
        let fields: Vec<String> =
            operation.fields.iter().map(|field| markdown::in_line(links, field)).collect();
        text.push_str(&format!(
            "| `{}` | {} | {} | {} |\n",
            operation.name,
            roles.of(&operation.name),
            links.set(&operation.docs),
            fields.join("<br>")
        ));
    }
    text
}

/// Names of the types that a client meets: those of requests and of the WebSocket, and all types in them.
fn reachable(tables: &[RequestTable], types: &[TypeDoc]) -> BTreeSet<String> {
    let texts: String = tables.iter().flat_map(|table| table.rows.concat()).collect();
    let mut open: Vec<&TypeDoc> = types
        .iter()
        .filter(|one| {
            let is_named = texts.contains(&format!("[`{}`]", one.name));
            // `Problem` is the body of every refusal.
            is_named || WEBSOCKET.contains(&&*one.name) || one.name == "Problem"
        })
        .collect();
    let mut found = BTreeSet::new();
    while let Some(one) = open.pop() {
        if found.insert(one.name.clone()) {
            let used = markdown::used(&one.shape);
            open.extend(types.iter().filter(|other| used.contains(&other.name)));
        }
    }
    found
}
