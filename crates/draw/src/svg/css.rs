//! Estimates the cost of style sheets and finds their references. usvg does the styling itself.

use usvg::roxmltree::Node;

/// Characters between the compound selectors of a selector.
const COMBINATORS: [char; 8] = [' ', '>', '+', '~', '\t', '\n', '\r', '\x0c'];

/// A rule of a style sheet, for one of its selectors.
pub struct CssRule<'a> {
    subject: Subject<'a>,
    /// Number of compound selectors in the selector, such as 3 in `g .a > path`.
    compounds: u32,
    /// References in its declarations.
    pub refers: Vec<Reference<'a>>,
}

/// A property whose value is `url(#…)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reference<'a> {
    /// Name of the property, such as `mask`.
    pub property: &'a str,
    /// Identifier after `#` in the property's value.
    pub id: &'a str,
}

/// The last compound selector of a selector, reduced to one class, identifier or element name.
enum Subject<'a> {
    Class(&'a str),
    Id(&'a str),
    Element(&'a str),
    Any,
}

/// Returns the rules in the text of a style sheet, one for each selector, including rules inside `@media`. A selector
/// that cannot be read counts as `*`, with all words before it as compounds, so that its cost is not underestimated.
pub fn rules(sheet: &str) -> Vec<CssRule<'_>> {
    let mut found = Vec::new();
    // Beginning of the text that may belong to the next selector.
    let (mut from, mut at) = (0, 0);
    while let Some(open) = sheet[at..].find('{').map(|open| at + open) {
        let body = &sheet[open + 1..];
        let end = body.find(['}', '{']).unwrap_or(body.len());
        if !body[end..].starts_with('{') {
            let text = sheet[at..open].rsplit([';', '}']).next().unwrap_or("");
            let unread = || vec![(Subject::Any, words(&sheet[from..open]).count() as u32)];
            let refers = |(subject, compounds)| CssRule {
                subject,
                compounds,
                refers: declared(&body[..end]).collect(),
            };
            found.extend(selectors(text).unwrap_or_else(unread).into_iter().map(refers));
            from = open + 1;
        }
        at = open + 1;
    }
    found
}

/// Splits a text at combinators and returns the parts that are not empty.
fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(COMBINATORS).filter(|part| !part.is_empty())
}

/// Reads selectors separated by commas. Returns the subject of each selector and its number of compounds. `None` if a
/// selector has an attribute selector, a comment or a parenthesis that is not closed.
fn selectors(text: &str) -> Option<Vec<(Subject<'_>, u32)>> {
    let mut found = Vec::new();
    let (mut subject, mut compounds) = (Subject::Any, 0);
    let (mut start, mut at) = (0, 0);
    loop {
        let rest = &text[at..];
        let sign = rest.chars().next();
        let ends = sign.is_none_or(|sign| sign == ',' || COMBINATORS.contains(&sign));
        let compound = &text[start..at];
        if ends && (compound.contains('[') || !plain_parts(compound).all(str::is_empty)) {
            (subject, compounds) = (self::subject(compound), compounds + 1);
        }
        if matches!(sign, None | Some(',')) {
            found.push((std::mem::replace(&mut subject, Subject::Any), std::mem::take(&mut compounds)));
        }
        let Some(sign) = sign else { return Some(found) };
        at += opaque(rest)?.max(sign.len_utf8());
        if ends {
            start = at;
        }
    }
}

/// Length in bytes of the attribute selector, the parenthesis or the comment at the start of a text; 0 if there is
/// none. `None` if it is not closed.
fn opaque(text: &str) -> Option<usize> {
    match text.as_bytes() {
        [b'[', ..] => {
            let stop = text.find([']', '"', '\''])?;
            let quote = text[stop..].chars().next().filter(|stop| *stop != ']');
            let Some(quote) = quote else { return Some(stop + 1) };
            let value = &text[stop + 1..];
            let mut closing = value.match_indices(quote).map(|(at, _)| at);
            let end = closing.find(|&at| !value[..at].ends_with('\\'))?;
            value[end + 1..].starts_with(']').then_some(stop + end + 3)
        }
        [b'(', ..] => text.find(')').map(|end| end + 1),
        [b'/', b'*', ..] => text[2..].find("*/").map(|end| end + 4),
        [b']' | b'"' | b'\'', ..] | [b'*', b'/', ..] => None,
        _ => Some(0),
    }
}

/// Returns the parts of a compound selector between its attribute selectors, parentheses and comments.
fn plain_parts(compound: &str) -> impl Iterator<Item = &str> {
    let mut rest = compound;
    std::iter::from_fn(move || {
        let end = (0..rest.len()).find(|&at| rest.is_char_boundary(at) && opaque(&rest[at..]) != Some(0));
        let (part, after) = rest.split_at(end.unwrap_or(rest.len()));
        let is_over = rest.is_empty();
        rest = &after[opaque(after).unwrap_or(after.len())..];
        (!is_over).then_some(part)
    })
}

fn subject(compound: &str) -> Subject<'_> {
    let word = |text: &'_ str| text.find(['.', '#', ':']).unwrap_or(text.len());
    let after = |sign: char| {
        plain_parts(compound).find_map(|part| part.split_once(sign)).map(|(_, text)| &text[..word(text)])
    };
    let name = plain_parts(compound).find(|part| !part.is_empty()).map_or("", |part| &part[..word(part)]);
    match (after('.'), after('#')) {
        (Some(class), _) => Subject::Class(class),
        (None, Some(id)) => Subject::Id(id),
        (None, None) if name.is_empty() || name == "*" => Subject::Any,
        (None, None) => Subject::Element(name),
    }
}

/// Returns the references in a list of declarations, such as `fill: url(#a); mask: url(#b)`.
pub fn declared(body: &str) -> impl Iterator<Item = Reference<'_>> {
    body.split(';').filter_map(|declaration| {
        let (property, value) = declaration.split_once(':')?;
        referred(value).map(|id| Reference { property: property.trim(), id })
    })
}

/// Returns the identifier in a value that contains `url(#...)`; `None` if the value refers to nothing.
pub fn referred(value: &str) -> Option<&str> {
    let after = &value[value.find("url(")? + 4..];
    let inside = after.trim_start().trim_start_matches(['"', '\'']).strip_prefix('#')?;
    Some(inside[..inside.find([')', '"', '\'']).unwrap_or(inside.len())].trim())
}

impl CssRule<'_> {
    /// Whether the rule may apply to an element. Only the last compound selector is compared.
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

    /// Returns the largest number of comparisons that matching an element at the level `depth` may take. Each `a b` in
    /// the selector may try every ancestor.
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

    /// For each selector: whether it may match `<path class='a' id='b' d='M 0,0'/>`, and its number of compounds.
    fn read(selectors: &str) -> Vec<(bool, u32)> {
        let document = Document::parse("<path class='a' id='b' d='M 0,0'/>").expect("it is well-formed");
        let sheet = format!("{selectors} {{ fill: url(#p) }}");
        let element = document.root_element();
        rules(&sheet).iter().map(|rule| (rule.may_match(element), rule.compounds)).collect()
    }

    #[test]
    fn attribute_selectors_do_not_hide_the_subject() {
        for selector in [
            "[d='M 0,0']",
            "path[href=\"#x\"]",
            "path[x='1.5']",
            "*[x='a,b > c']",
            "[x='1.5'].a",
            "[x='#y']#b",
            "path[x='\\'']",
            "path[x|=y]",
            "path:not(.b)",
            "/* fig. 1, #2 */path",
        ] {
            assert_eq!(read(selector), [(true, 1)], "{selector}");
        }
        assert_eq!(read("g[x='a b'] > path, .c[d='.a'], #c[x=y]"), [(true, 2), (false, 1), (false, 1)]);
    }

    #[test]
    fn selectors_that_cannot_be_read_count_as_any_element_with_all_words_before() {
        for (selector, compounds) in [
            ("g g .c[x='{'] .d", 4),
            ("g g .c[x=';'] .d", 4),
            ("g g .c[x='}'] .d", 4),
            (".c[x", 1),
            (".c[x='] .d", 2),
            (".c] .d", 2),
            ("/* { */ .c", 3),
        ] {
            let most = read(selector).into_iter().max();
            assert!(
                most.is_some_and(|(matches, words)| matches && words >= compounds),
                "{selector}: {most:?}"
            );
        }
    }

    #[test]
    fn cut_off_sheets_have_fewer_rules() {
        let sheet = ".a { fill: url(#p) } .b { x } {{}{ } c {";
        for end in 0..sheet.len() {
            assert!(rules(&sheet[..end]).len() <= rules(sheet).len());
        }
    }
}
