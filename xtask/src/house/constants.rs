//! Constants: whether each has its own doc comment, and whether the doc says where the value comes from.

use super::tree::string;
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Ident, Type};

/// A constant outside tests.
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Line of its name.
    pub line: usize,
    /// Its doc comment, empty if there is none.
    pub doc: String,
    /// Whether its value contains a number other than 0. Strings, characters and booleans never count.
    pub numeric: bool,
    /// Whether its value is calculated from other constants: it mentions an upper-case name.
    pub derived: bool,
}

impl Constant {
    /// Whether the doc names a source of the value, or the value is calculated from other constants.
    pub fn has_source(&self) -> bool {
        self.derived || names_source(&self.doc)
    }
}

/// All constants of a file, including those of `impl` blocks. `const _` is left out, because it is an assertion.
pub fn constants(syntax: &syn::File) -> Vec<Constant> {
    let mut found = Found(Vec::new());
    found.visit_file(syntax);
    found.0
}

struct Found(Vec<Constant>);

impl Found {
    fn add(&mut self, name: &Ident, attributes: &[Attribute], kind: &Type, value: &Expr) {
        if name == "_" {
            return;
        }
        let kind = kind.to_token_stream().to_string();
        self.0.push(Constant {
            name: name.to_string(),
            line: name.span().start().line,
            doc: doc(attributes),
            numeric: !["str", "char", "bool"].iter().any(|text| kind.contains(text))
                && holds_number(value.to_token_stream()),
            derived: words(&value.to_token_stream().to_string()).any(is_capital),
        });
    }
}

impl<'ast> Visit<'ast> for Found {
    fn visit_item_const(&mut self, item: &'ast syn::ItemConst) {
        self.add(&item.ident, &item.attrs, &item.ty, &item.expr);
        visit::visit_item_const(self, item);
    }

    fn visit_impl_item_const(&mut self, item: &'ast syn::ImplItemConst) {
        self.add(&item.ident, &item.attrs, &item.ty, &item.expr);
        visit::visit_impl_item_const(self, item);
    }
}

/// Whether these tokens hold a number literal other than 0.
fn holds_number(tokens: TokenStream) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Group(group) => holds_number(group.stream()),
        TokenTree::Literal(literal) => {
            let text = literal.to_string();
            text.starts_with(|first: char| first.is_ascii_digit())
                && text.contains(|digit| ('1'..='9').contains(&digit))
        }
        _ => false,
    })
}

fn doc(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc"));
    let lines = lines.filter_map(|attribute| match &attribute.meta {
        syn::Meta::NameValue(pair) => string(&pair.value),
        _ => None,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Phrases that name a source: a paper, an equation, a data sheet, a standard, a page, a measurement or a tuning run.
const SOURCES: [&str; 22] = [
    " et al",
    "equation",
    " eq. ",
    "theorem",
    "lemma",
    "chapter",
    "section ",
    "§",
    "rfc ",
    "ieee",
    "mqtt 3",
    "data sheet",
    "reference manual",
    "datasheet",
    "measured",
    "measurement",
    "tuned on",
    "chosen on",
    "by definition",
    "docs/",
    "stated in",
    "protocol",
];

/// Whether a doc names a paper, data sheet, measurement, tuning, rule of the protocol, page, or other constants.
fn names_source(doc: &str) -> bool {
    let lower = doc.to_lowercase().replace("not measured", "").replace("no measurement", "");
    SOURCES.iter().any(|phrase| lower.contains(phrase))
        || words(doc).any(|word| is_rule(word) || is_constant_name(word) || is_year(word))
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
}

/// Whether a word of a doc is the name of a constant, such as `GAP_M`. It is upper-case, has an underscore or at
/// least five letters, and is not a word of the protocol.
fn is_constant_name(word: &str) -> bool {
    is_capital(word)
        && (word.contains('_') || word.len() > 4)
        && !["PROTO", "MQTT", "TARGET", "COLOR", "START", "RESUME", "STATUS", "BLINK"].contains(&word)
}

/// Whether a word consists of at least two upper-case letters, digits and underscores, and begins with a letter.
fn is_capital(word: &str) -> bool {
    let capital = |letter: char| letter.is_ascii_uppercase() || letter.is_ascii_digit() || letter == '_';
    word.len() > 1 && word.starts_with(|first: char| first.is_ascii_uppercase()) && word.chars().all(capital)
}

/// Whether a word names a rule of docs/protocol.md, such as `R49`. Only one or two digits count.
fn is_rule(word: &str) -> bool {
    word.strip_prefix('R').is_some_and(|number| number.len() < 3 && number.parse::<u8>().is_ok())
}

/// Whether a word is a year from 1950 to 2049, such as that of a publication or measurement.
fn is_year(word: &str) -> bool {
    word.len() == 4 && word.parse::<u16>().is_ok_and(|year| (1950..2050).contains(&year))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(text: &str) -> Constant {
        constants(&syn::parse_file(text).expect("Rust")).pop().expect("one constant")
    }

    #[test]
    fn a_source_is_a_paper_a_measurement_a_rule_or_another_constant() {
        assert!(!one("/// Metres: robots nearer than this stop.\nconst A_M: f64 = 1.0;").has_source());
        assert!(
            one("/// Gravity, m/s² (Coulomb friction, Thrun 2005, eq. 5.3).\nconst A: f64 = 1.0;")
                .has_source()
        );
        assert!(one("/// Metres, measured on 2026-11-20.\nconst A_M: f64 = 1.0;").has_source());
        assert!(!one("/// Metres. A choice, not measured.\nconst A_M: f64 = 1.0;").has_source());
        assert!(one("/// Seconds of silence (R43).\nconst A_S: f64 = 2.0;").has_source());
        assert!(one("/// Half of `STEP_US`.\nconst A_US: u64 = 8;").has_source());
        assert!(one("const A_US: u64 = STEP_US / 2;").has_source());
    }

    #[test]
    fn texts_are_not_numeric_and_assertions_are_no_constants() {
        assert!(!one("const HELP: &str = \"help 1\";").numeric);
        assert!(!one("const ZERO: Self = Self(0);").numeric);
        assert!(one("const TABLE: [(f64, f64); 1] = [(1.0, 2.0)];").numeric);
        assert!(constants(&syn::parse_file("const _: () = assert!(true);").expect("Rust")).is_empty());
    }

    #[test]
    fn constants_of_types_count() {
        assert_eq!(one("impl A { const B: u8 = 1; }").name, "B");
    }
}
