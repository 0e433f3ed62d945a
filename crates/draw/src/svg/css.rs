//! Estimates the cost of style sheets and finds their references. usvg does the styling itself.

use usvg::roxmltree::Node;

/// A rule of a style sheet, with one selector.
pub struct CssRule<'a> {
    subject: Subject<'a>,
    /// Number of compound selectors, such as 3 in `g .a > path`.
    compounds: u32,
    /// References in its declarations.
    pub refers: Vec<Reference<'a>>,
}

/// A property whose value is `url(#…)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference<'a> {
    /// Name of the property, such as `mask`.
    pub property: &'a str,
    /// Identifier after `#` in its value.
    pub id: &'a str,
}

/// The last compound of a selector, reduced to one class, identifier or element name.
enum Subject<'a> {
    Class(&'a str),
    Id(&'a str),
    Element(&'a str),
    Any,
}

/// Returns the rules in the text of a style sheet, one for each selector. Rules inside `@media` count too.
pub fn rules(sheet: &str) -> Vec<CssRule<'_>> {
    let mut found = Vec::new();
    let mut rest = sheet;
    while let Some(open) = rest.find('{') {
        let selectors = rest[..open].rsplit([';', '}', '{']).next().unwrap_or("");
        rest = &rest[open + 1..];
        let end = rest.find(['}', '{']).unwrap_or(rest.len());
        if !rest[end..].starts_with('{') {
            found.extend(selectors.split(',').map(|selector| rule(selector, &rest[..end])));
        }
    }
    found
}

fn rule<'a>(selector: &'a str, body: &'a str) -> CssRule<'a> {
    let compounds = selector.split([' ', '>', '+', '~', '\t', '\n', '\r']).filter(|part| !part.is_empty());
    let last = compounds.clone().next_back().unwrap_or("");
    CssRule { subject: subject(last), compounds: compounds.count() as u32, refers: declared(body).collect() }
}

fn subject(compound: &str) -> Subject<'_> {
    let word = |from: usize| {
        let text = &compound[from..];
        &text[..text.find(['.', '#', ':', '[']).unwrap_or(text.len())]
    };
    match (compound.find('.'), compound.find('#')) {
        (Some(at), _) => Subject::Class(word(at + 1)),
        (None, Some(at)) => Subject::Id(word(at + 1)),
        (None, None) if word(0).is_empty() || word(0) == "*" => Subject::Any,
        (None, None) => Subject::Element(word(0)),
    }
}

/// Returns the references in declarations such as `fill: url(#a); mask: url(#b)`.
pub fn declared(body: &str) -> impl Iterator<Item = Reference<'_>> {
    body.split(';').filter_map(|declaration| {
        let (property, value) = declaration.split_once(':')?;
        referred(value).map(|id| Reference { property: property.trim(), id })
    })
}

/// Returns the identifier in a value with `url(#...)`.
pub fn referred(value: &str) -> Option<&str> {
    let after = &value[value.find("url(")? + 4..];
    let inside = after.trim_start().trim_start_matches(['"', '\'']).strip_prefix('#')?;
    Some(inside[..inside.find([')', '"', '\'']).unwrap_or(inside.len())].trim())
}

impl CssRule<'_> {
    /// Whether the rule may apply to an element. Only the rule's `subject` is compared.
    pub fn may_match(&self, element: Node) -> bool {
        match self.subject {
            Subject::Class(class) => element
                .attribute("class")
                .is_some_and(|classes| classes.split_ascii_whitespace().any(|word| word == class)),
            Subject::Id(id) => element.attribute("id") == Some(id),
            Subject::Element(name) => element.tag_name().name() == name,
            Subject::Any => true,
        }
    }

    /// Returns the largest number of comparisons with an element `depth` levels deep. Each `a b` may try every
    /// ancestor.
    pub fn comparisons(&self, depth: u64) -> u64 {
        depth.max(2).saturating_pow(self.compounds.saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use usvg::roxmltree::Document;

    #[test]
    fn rules_are_split_and_matched_by_their_last_compound() {
        let sheet = "@import 'a'; .a, #b { fill: url(#p); mask:url( '#m' ) } g > path{} @media x { * { } }";
        let rules = rules(sheet);
        let document = Document::parse("<path class='x a' id='c'/>").expect("it is well-formed");
        let matching: Vec<bool> = rules.iter().map(|rule| rule.may_match(document.root_element())).collect();
        assert_eq!(matching, [true, false, true, true]);
        let refers = [("fill", "p"), ("mask", "m")].map(|(property, id)| Reference { property, id });
        assert_eq!(rules[0].refers, refers);
        assert_eq!(rules[2].comparisons(10), 10);
    }

    #[test]
    fn cut_off_sheets_have_fewer_rules() {
        let sheet = ".a { fill: url(#p) } .b { x } {{}{ } c {";
        for end in 0..sheet.len() {
            assert!(rules(&sheet[..end]).len() <= rules(sheet).len());
        }
    }
}
