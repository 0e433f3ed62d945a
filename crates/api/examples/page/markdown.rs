//! Writes types as Markdown.

use std::collections::BTreeSet;

use syn::Type;

use super::source::{FieldDoc, Shape, TypeDoc, VariantDoc, part};

/// Names of the types that have a section on the page.
pub struct Links<'a>(pub &'a BTreeSet<String>);

impl Links<'_> {
    /// The docs with links to types as links on the page. Types without a section become plain code.
    pub fn set(&self, docs: &str) -> String {
        let mut text = String::new();
        let mut rest = docs;
        while let Some((before, after)) = rest.split_once("[`") {
            let Some((name, after)) = after.split_once("`]") else { break };
            text.push_str(before);
            text.push_str(&self.to(name));
            // Drops the link's target in the source, such as `(crate::Plan)`.
            let place = after.strip_prefix('(').and_then(|after| after.split_once(')'));
            rest = place.map_or(after, |(_, after)| after);
        }
        text + rest
    }

    fn to(&self, name: &str) -> String {
        match name {
            "Operation" => "[Operation](#operations)".into(),
            _ if self.0.contains(name) => format!("[{name}](#{})", name.to_lowercase()),
            _ => format!("`{name}`"),
        }
    }

    /// Describes a type in the words of JSON.
    fn value(&self, value: &Type) -> String {
        if let Some(inner) = part(value, "Option") {
            return format!("{} or null", self.value(inner));
        }
        if let Some(inner) = part(value, "Vec") {
            let one = self.value(inner);
            return if part(inner, "Option").is_some() {
                format!("list of ({one})")
            } else {
                format!("list of {one}")
            };
        }
        match value {
            Type::Array(array) => match &array.len {
                syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(length), .. }) => {
                    format!("list of {length} {}s", self.value(&array.elem))
                }
                _ => panic!("an array has a plain length"),
            },
            Type::Path(path) => {
                self.plain(&path.path.segments.last().expect("a path has a name").ident.to_string())
            }
            _ => panic!("a field of messages has a plain type"),
        }
    }

    fn plain(&self, name: &str) -> String {
        match name {
            "String" => "text".into(),
            "bool" => "true or false".into(),
            "u8" | "u32" | "u64" | "usize" => "whole number".into(),
            "f32" | "f64" => "number".into(),
            "Value" => "JSON".into(),
            name if self.0.contains(name) => self.to(name),
            name => panic!("the page has no word for the type {name}"),
        }
    }
}

/// A field's name, value and meaning in one line of text.
pub fn in_line(links: &Links<'_>, field: &FieldDoc) -> String {
    format!("`{}` ({}): {}", field.name, worth(links, field), links.set(&field.docs))
}

fn worth(links: &Links<'_>, field: &FieldDoc) -> String {
    let may_be_left_out = if field.is_optional { "; may be left out" } else { "" };
    format!("{}{may_be_left_out}", links.value(&field.value))
}

/// The section of a type.
pub fn section(links: &Links<'_>, one: &TypeDoc) -> String {
    let mut text = format!("\n### {}\n{}\n\n", one.name, links.set(&one.docs));
    match &one.shape {
        Shape::Object(fields) => {
            text.push_str("| field | value | meaning |\n|---|---|---|\n");
            for field in fields {
                let (value, docs) = (worth(links, field), links.set(&field.docs));
                text.push_str(&format!("| `{}` | {value} | {docs} |\n", field.name));
            }
        }
        Shape::Texts(texts) => {
            text.push_str("| text | meaning |\n|---|---|\n");
            for (name, docs) in texts {
                text.push_str(&format!("| `{name}` | {} |\n", links.set(docs)));
            }
        }
        Shape::Tagged { .. } => panic!("{} belongs to the WebSocket: give it a section there", one.name),
    }
    text
}

/// The table of messages that a tag distinguishes.
pub fn messages(links: &Links<'_>, docs: &str, (tag, variants): (String, &[VariantDoc])) -> String {
    let mut text = format!("{}\n\n", links.set(docs));
    text.push_str(&format!("| `{tag}` | meaning | further fields |\n|---|---|---|\n"));
    for variant in variants {
        let content = variant.content.as_ref().map_or_else(|| "none".into(), |content| links.value(content));
        text.push_str(&format!("| `{}` | {} | {content} |\n", variant.name, links.set(&variant.docs)));
    }
    text
}

/// The table of the lists in the binary message.
pub fn binary(links: &Links<'_>, robots: &TypeDoc) -> String {
    let Shape::Object(lists) = &robots.shape else { panic!("the binary message consists of lists") };
    let mut text = format!("{}\n\n", include_str!("robots.md").trim_end());
    text.push_str("| list | number | meaning |\n|---|---|---|\n");
    for list in lists {
        let number = match list.array.as_deref() {
            Some("Float32Array") => "float, 4 bytes",
            Some("Uint32Array") => "unsigned, 4 bytes",
            Some("Uint8Array") => "unsigned, 1 byte",
            other => panic!("the page has no word for the array {other:?}"),
        };
        text.push_str(&format!("| `{}` | {number} | {} |\n", list.name, links.set(&list.docs)));
    }
    text
}

/// The names of all types that occur in a shape.
pub fn used(shape: &Shape) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    match shape {
        Shape::Object(fields) => fields.iter().for_each(|field| add(&mut names, &field.value)),
        Shape::Texts(_) => {}
        Shape::Tagged { variants, .. } => {
            for variant in variants {
                variant.fields.iter().for_each(|field| add(&mut names, &field.value));
                variant.content.iter().for_each(|content| add(&mut names, content));
            }
        }
    }
    names
}

fn add(names: &mut BTreeSet<String>, value: &Type) {
    match (part(value, "Option").or_else(|| part(value, "Vec")), value) {
        (Some(inner), _) => add(names, inner),
        (None, Type::Array(array)) => add(names, &array.elem),
        (None, Type::Path(path)) => {
            names.extend(path.path.segments.last().map(|segment| segment.ident.to_string()));
        }
        _ => {}
    }
}
