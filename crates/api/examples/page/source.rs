//! Reads the docs of this crate from its source: requests from the tables in the docs of modules, and types.

use std::path::Path;

use syn::{Attribute, Expr, Fields, GenericArgument, Item, Lit, Meta, PathArguments, Type};

/// Head row of a table of requests in the docs of a module.
const HEAD: &str = "| request | body | answer |";

/// A table of requests.
pub struct RequestTable {
    /// The subject of the requests.
    pub title: String,
    /// Request, body and answer of each row.
    pub rows: Vec<[String; 3]>,
}

/// A type of the messages.
pub struct TypeDoc {
    pub name: String,
    pub docs: String,
    pub shape: Shape,
}

/// The form of a type's values in JSON.
pub enum Shape {
    /// An object.
    Object(Vec<FieldDoc>),
    /// One of several texts, each with its docs.
    Texts(Vec<(String, String)>),
    /// One of several objects, distinguished by the field `tag`.
    Tagged { tag: String, variants: Vec<VariantDoc> },
}

/// A field of a JSON object.
pub struct FieldDoc {
    pub name: String,
    pub docs: String,
    pub value: Type,
    /// Whether the field may be left out although it cannot be null.
    pub is_optional: bool,
    /// The JavaScript array type for this list, if the field is a list of the binary message.
    pub array: Option<String>,
}

/// One of several objects that a tag distinguishes.
pub struct VariantDoc {
    /// The value of the tag.
    pub name: String,
    pub docs: String,
    pub fields: Vec<FieldDoc>,
    /// The type whose fields are added beside the tag.
    pub content: Option<Type>,
}

/// The source file with types of show files instead of messages. It is left out, because docs/show-format.md describes
/// it.
const FILE_TYPES: &str = "document.rs";

/// Reads all tables and types of the source files in a folder, in the order of the file names.
pub fn read(folder: &Path) -> (Vec<RequestTable>, Vec<TypeDoc>) {
    let files = std::fs::read_dir(folder).expect("the crate has sources");
    let mut files: Vec<_> = files.map(|file| file.expect("the folder can be read").path()).collect();
    files.retain(|file| !file.ends_with(FILE_TYPES));
    files.sort();
    let (mut tables, mut types) = (Vec::new(), Vec::new());
    for path in files {
        let text = std::fs::read_to_string(&path).expect("sources are texts");
        let file = syn::parse_file(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        tables.extend(table(&lines(&file.attrs)));
        types.extend(file.items.iter().filter_map(type_doc));
    }
    (tables, types)
}

/// The table in the docs of a module. A row may continue on the next lines.
fn table(docs: &[String]) -> Option<RequestTable> {
    let start = docs.iter().position(|line| line == HEAD)?;
    let title = docs.first()?.trim_end_matches('.').trim_end_matches(" over HTTP").to_owned();
    let rows = docs[start + 2..].iter().take_while(|line| !line.is_empty());
    let mut joined: Vec<String> = Vec::new();
    for line in rows {
        match joined.last_mut().filter(|row| !row.ends_with('|')) {
            Some(row) => *row = format!("{row} {line}"),
            None => joined.push(line.clone()),
        }
    }
    let cells = |row: String| {
        let cells: Vec<String> =
            row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect();
        cells.try_into().unwrap_or_else(|cells| panic!("a row has three cells: {cells:?}"))
    };
    Some(RequestTable { title, rows: joined.into_iter().map(cells).collect() })
}

fn type_doc(item: &Item) -> Option<TypeDoc> {
    let (name, attributes, shape) = match item {
        Item::Struct(item) if is_public(&item.vis) => {
            (&item.ident, &item.attrs, Shape::Object(fields(&item.fields)))
        }
        Item::Enum(item) if is_public(&item.vis) => (&item.ident, &item.attrs, enum_shape(item)),
        _ => return None,
    };
    Some(TypeDoc { name: name.to_string(), docs: lines(attributes).join(" "), shape })
}

fn is_public(visibility: &syn::Visibility) -> bool {
    matches!(visibility, syn::Visibility::Public(_))
}

fn enum_shape(item: &syn::ItemEnum) -> Shape {
    let rule = setting(&item.attrs, "serde", "rename_all").unwrap_or_default();
    let named =
        |variant: &syn::Variant| (rename(&variant.ident.to_string(), &rule), lines(&variant.attrs).join(" "));
    let Some(tag) = setting(&item.attrs, "serde", "tag") else {
        return Shape::Texts(item.variants.iter().map(named).collect());
    };
    let variants = item.variants.iter().map(|variant| {
        let (name, docs) = named(variant);
        let content = match &variant.fields {
            Fields::Unnamed(content) => content.unnamed.first().map(|field| field.ty.clone()),
            _ => None,
        };
        let fields = if content.is_some() { Vec::new() } else { fields(&variant.fields) };
        VariantDoc { name, docs, fields, content }
    });
    Shape::Tagged { tag, variants: variants.collect() }
}

fn fields(fields: &Fields) -> Vec<FieldDoc> {
    let named = fields.iter().filter_map(|field| Some((field.ident.as_ref()?, field)));
    named
        .map(|(name, field)| FieldDoc {
            name: name.to_string(),
            docs: lines(&field.attrs).join(" "),
            value: field.ty.clone(),
            is_optional: has(&field.attrs, "serde", "default") && part(&field.ty, "Option").is_none(),
            array: setting(&field.attrs, "ts", "type"),
        })
        .collect()
}

/// The lines of docs without their leading blank.
fn lines(attributes: &[Attribute]) -> Vec<String> {
    let texts = attributes.iter().filter_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("doc") => text(&pair.value),
        _ => None,
    });
    texts.map(|line| line.trim().to_owned()).collect()
}

fn text(value: &Expr) -> Option<String> {
    match value {
        Expr::Lit(literal) => match &literal.lit {
            Lit::Str(text) => Some(text.value()),
            _ => None,
        },
        _ => None,
    }
}

/// The text of `key = "…"` in an attribute such as `#[serde(…)]`.
fn setting(attributes: &[Attribute], name: &str, key: &str) -> Option<String> {
    find(attributes, name, key).flatten()
}

fn has(attributes: &[Attribute], name: &str, key: &str) -> bool {
    find(attributes, name, key).is_some()
}

fn find(attributes: &[Attribute], name: &str, key: &str) -> Option<Option<String>> {
    let mut found = None;
    for attribute in attributes.iter().filter(|attribute| attribute.path().is_ident(name)) {
        let read = attribute.parse_nested_meta(|meta| {
            let value = if meta.input.peek(syn::Token![=]) { text(&meta.value()?.parse()?) } else { None };
            if meta.path.is_ident(key) {
                found = Some(value);
            }
            Ok(())
        });
        read.expect("attributes are lists of words and settings");
    }
    found
}

/// A variant's name in JSON, by the rule of `rename_all`.
fn rename(variant: &str, rule: &str) -> String {
    let separated = |(index, letter): (usize, char)| {
        let blank = if index > 0 && letter.is_uppercase() && rule == "snake_case" { "_" } else { "" };
        format!("{blank}{}", letter.to_lowercase())
    };
    assert!(
        ["snake_case", "lowercase"].contains(&rule),
        "{variant} is renamed by a rule that is not known: {rule}"
    );
    variant.char_indices().map(separated).collect()
}

/// The type argument of `value` if its type has this name, such as `T` in `Option<T>`.
pub fn part<'a>(value: &'a Type, name: &str) -> Option<&'a Type> {
    let Type::Path(path) = value else { return None };
    let last = path.path.segments.last().filter(|segment| segment.ident == name)?;
    let PathArguments::AngleBracketed(arguments) = &last.arguments else { return None };
    arguments.args.iter().find_map(|argument| match argument {
        GenericArgument::Type(inner) => Some(inner),
        _ => None,
    })
}
