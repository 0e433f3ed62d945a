//! Limits the number of elements that an SVG has after its references are followed.

use std::collections::HashMap;

use usvg::roxmltree::{Document, Node};

use crate::error::DrawError;
use crate::svg::css::{self, CssRule, Reference};
use crate::svg::scan::{DEPTH_MAX, too_deep, too_large};

/// Largest number of elements after all references are followed. 10⁵ elements took 4.3 s and 170 MB on 2026-11-23.
const EXPANDED_MAX: u64 = 100_000;
/// Largest number of comparisons of elements with the rules of style sheets. 10⁷ comparisons took 0.7 s on 2026-11-23.
const COMPARISONS_MAX: u64 = 10_000_000;
/// Cost of an ordinary element. In this unit, a colour stop of a gradient costs 1, and so do 16 bytes of attributes.
const ELEMENT: u64 = 16;
/// Names of elements that are drawn only where other elements refer to them.
const UNDRAWN: [&str; 11] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "pattern",
    "marker",
    "filter",
    "linearGradient",
    "radialGradient",
    "style",
    "metadata",
];
/// Properties that apply to an element itself. All other properties are inherited by the shapes inside the element.
const NOT_INHERITED: [&str; 3] = ["clip-path", "mask", "filter"];

/// Refuses a document whose nesting, references or style sheets would take too long to process.
pub fn check(document: &Document) -> Result<(), DrawError> {
    let deepest = deepest(document);
    if deepest > DEPTH_MAX as u64 {
        return Err(too_deep());
    }
    let styles = document.descendants().filter(|node| node.tag_name().name() == "style");
    let sheets = styles.flat_map(|style| style.children().filter_map(|child| child.text()));
    let rules: Vec<CssRule> = sheets.flat_map(css::rules).collect();
    let each = rules.iter().fold(0u64, |sum, rule| sum.saturating_add(rule.comparisons(deepest)));
    let elements = document.descendants().filter(Node::is_element).count() as u64;
    compare(each, elements)?;
    let mut expansion = Expansion::new(document, rules);
    let whole = expansion.total(document.root_element(), 0)?;
    let expanded = whole.cost / ELEMENT;
    if expanded > EXPANDED_MAX {
        let reason =
            format!("with its references followed it has {expanded} elements, at most {EXPANDED_MAX}");
        return Err(too_large(reason));
    }
    compare(each, expanded)
}

/// Refuses a document with too many comparisons. `rules`: number of comparisons for each element.
fn compare(rules: u64, elements: u64) -> Result<(), DrawError> {
    if rules.saturating_mul(elements) > COMPARISONS_MAX {
        return Err(too_large(format!(
            "its style sheets take {rules} steps for each of {elements} elements"
        )));
    }
    Ok(())
}

/// Returns the number of levels of nested elements.
fn deepest(document: &Document) -> u64 {
    let mut depths: Vec<u64> = Vec::new();
    for node in document.descendants() {
        let parent = node.parent().and_then(|parent| depths.get(parent.id().get_usize()));
        depths.push(parent.copied().unwrap_or(0) + u64::from(node.is_element()));
    }
    depths.into_iter().max().unwrap_or(0)
}

/// The cost of an element, including everything in it and everything it refers to.
#[derive(Clone, Copy, Debug, Default)]
struct Total {
    /// Cost of all elements, in units of 1/[`ELEMENT`] of an element.
    cost: u64,
    /// Number of shapes, which inherit paint and markers. A shape is an element without elements inside.
    shapes: u64,
    /// Number of points of the shapes' lines. Each point may get a marker.
    points: u64,
    /// Number of levels below the element.
    height: usize,
}

/// Totals of the elements of a document.
struct Expansion<'a, 'input> {
    rules: Vec<CssRule<'a>>,
    /// Total of each node, by the node's number; `None` before its count begins.
    totals: Vec<Option<Total>>,
    ids: HashMap<&'a str, Node<'a, 'input>>,
}

impl<'a, 'input> Expansion<'a, 'input> {
    fn new(document: &'a Document<'input>, mut rules: Vec<CssRule<'a>>) -> Self {
        rules.retain(|rule| !rule.refers.is_empty());
        let nodes = document.descendants();
        let ids = nodes.clone().filter_map(|node| Some((node.attribute("id")?, node))).collect();
        Self { rules, totals: vec![None; nodes.count()], ids }
    }

    /// Returns the total of an element. `depth`: its level. If this element's total is being computed already, the
    /// element refers to itself. The inner reference then counts as empty, because usvg leaves it out.
    fn total(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<Total, DrawError> {
        let index = node.id().get_usize();
        if let Some(total) = self.totals.get(index).copied().flatten() {
            return if depth + total.height > DEPTH_MAX { Err(too_deep()) } else { Ok(total) };
        }
        if depth > DEPTH_MAX {
            return Err(too_deep());
        }
        self.keep(index, Total::default());
        let inside = self.inside(node, depth)?;
        let total = self.with_references(node, inside, depth)?;
        self.keep(index, total);
        Ok(total)
    }

    fn keep(&mut self, index: usize, total: Total) {
        if let Some(entry) = self.totals.get_mut(index) {
            *entry = Some(total);
        }
    }

    /// Returns the total of an element and the elements inside it, without what this element itself refers to.
    fn inside(&mut self, node: Node<'a, 'input>, depth: usize) -> Result<Total, DrawError> {
        let bytes: usize = node.attributes().map(|attribute| attribute.value().len()).sum();
        let own = if node.tag_name().name() == "stop" { 1 } else { ELEMENT + bytes as u64 / ELEMENT };
        // Each character of a text becomes an area.
        let signs = if node.tag_name().name() == "text" { signs(node) } else { 0 };
        let mut total = Total { cost: own + ELEMENT * signs, ..Total::default() };
        for child in node.children().filter(Node::is_element) {
            if !UNDRAWN.contains(&child.tag_name().name()) {
                let inner = self.total(child, depth + 1)?;
                total.add(inner, 1);
            }
        }
        total.shapes = total.shapes.max(1);
        total.points = total.points.saturating_add(points(node));
        Ok(total)
    }

    fn with_references(
        &mut self,
        node: Node<'a, 'input>,
        mut total: Total,
        depth: usize,
    ) -> Result<Total, DrawError> {
        let linked = node.attributes().find(|attribute| attribute.name() == "href");
        if let Some(target) = linked.and_then(|link| self.by_id(link.value().trim().strip_prefix('#')?)) {
            let inner = self.total(target, depth + 1)?;
            total.add(inner, 1);
        }
        for reference in self.references(node) {
            let Some(target) = self.by_id(reference.id) else { continue };
            let inner = self.total(target, depth + 1)?;
            let times = match reference.property {
                property if NOT_INHERITED.contains(&property) => 1,
                property if property.starts_with("marker") => total.points,
                _ => total.shapes,
            };
            total.add(Total { shapes: 0, points: 0, ..inner }, times);
        }
        Ok(total)
    }

    fn by_id(&self, id: &str) -> Option<Node<'a, 'input>> {
        self.ids.get(id).copied()
    }

    /// Returns the references of an element: in its attributes, in its `style`, and in rules of style sheets that may
    /// match it.
    fn references(&self, node: Node<'a, 'input>) -> Vec<Reference<'a>> {
        let attributes = node.attributes().filter_map(|attribute| {
            css::referred(attribute.value()).map(|id| Reference { property: attribute.name(), id })
        });
        let attributes = attributes.filter(|reference| reference.property != "style");
        let style = css::declared(node.attribute("style").unwrap_or(""));
        let matching = self.rules.iter().filter(|rule| rule.may_match(node));
        let ruled = matching.flat_map(|rule| rule.refers.iter().copied());
        attributes.chain(style).chain(ruled).collect()
    }
}

impl Total {
    fn add(&mut self, inner: Total, times: u64) {
        self.cost = self.cost.saturating_add(inner.cost.saturating_mul(times));
        self.shapes = self.shapes.saturating_add(inner.shapes);
        self.points = self.points.saturating_add(inner.points);
        self.height = self.height.max(inner.height + 1);
    }
}

/// Returns the number of bytes of a text element's text. It is at least the number of characters.
fn signs(node: Node) -> u64 {
    node.descendants().filter_map(|inner| inner.text()).map(|text| text.len() as u64).sum()
}

/// Returns an upper bound for the number of points of an element's line. The shortest segment, such as `h1`, has two
/// characters.
fn points(node: Node) -> u64 {
    let line = node.attribute("d").or(node.attribute("points"));
    line.map_or(2, |line| line.len() as u64 / 2 + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use usvg::roxmltree::ParsingOptions;

    fn code(svg: &str) -> Option<&'static str> {
        let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
        let document = Document::parse_with_options(svg, options).expect("it is well-formed");
        check(&document).err().map(|error| error.code)
    }

    /// Definitions each of which uses the one before it twice.
    fn doubling(levels: usize, element: &str, property: &str) -> String {
        let level = |n: usize| {
            let rect = format!("<rect width='9' height='9' {property}='url(#e{})'/>", n - 1);
            format!("<{element} id='e{n}'>{rect}{rect}</{element}>")
        };
        let all: String = (1..=levels).map(level).collect();
        format!("<svg><{element} id='e0'><rect/></{element}>{all}<rect {property}='url(#e{levels})'/></svg>")
    }

    #[test]
    fn masks_and_patterns_that_double_are_refused() {
        for (element, property) in [("mask", "mask"), ("pattern", "fill"), ("clipPath", "clip-path")] {
            assert_eq!(code(&doubling(12, element, property)), None);
            assert_eq!(code(&doubling(20, element, property)), Some("svg-too-large"));
            assert_eq!(code(&doubling(100, element, property)), Some("svg-too-large"));
        }
    }

    #[test]
    fn references_in_style_and_style_sheets_count() {
        let sheet = "<style>.a { fill: url(#e17) }</style><rect class='a'/><rect class='b'/>";
        let by_rule = doubling(17, "pattern", "fill").replace("<rect fill='url(#e17)'/>", sheet);
        assert_eq!(code(&by_rule), Some("svg-too-large"));
        assert_eq!(code(&by_rule.replace("class='a'", "")), None);
        let by_attribute =
            by_rule.replace(".a {", "[class='a'][x='1.5'] {").replace("class='a'/", "class='a' x='1.5'/");
        assert_eq!(code(&by_attribute), Some("svg-too-large"));
        let by_style = doubling(17, "pattern", "fill").replace("fill='url(#e17)'", "style='fill:url(#e17)'");
        assert_eq!(code(&by_style), Some("svg-too-large"));
    }

    #[test]
    fn uses_and_markers_count_for_each_place() {
        let uses = |count: usize| {
            let ten = "<rect/>".repeat(1000);
            format!("<svg><g id='a'>{ten}</g>{}</svg>", "<use href='#a'/>".repeat(count))
        };
        assert_eq!(code(&uses(50)), None);
        assert_eq!(code(&uses(150)), Some("svg-too-large"));
        let marked = |steps: usize| {
            let marker = format!("<marker id='m'>{}</marker>", "<rect/>".repeat(1000));
            let line = format!("<path marker-mid='url(#m)' d='M0 0{}'/>", "h1".repeat(steps));
            format!("<svg>{marker}{line}</svg>")
        };
        assert_eq!(code(&marked(50)), None);
        assert_eq!(code(&marked(200)), Some("svg-too-large"));
    }

    #[test]
    fn elements_that_refer_to_themselves_end() {
        assert_eq!(code("<svg><g id='a'><use href='#a'/></g><mask id='m' mask='url(#m)'/></svg>"), None);
    }

    #[test]
    fn long_chains_of_references_are_too_deep() {
        let chain: String =
            (0..300).map(|n| format!("<linearGradient id='g{}' href='#g{n}'/>", n + 1)).collect();
        assert_eq!(code(&format!("<svg>{chain}<rect fill='url(#g300)'/></svg>")), Some("svg-too-deep"));
        assert_eq!(code(&format!("<svg>{chain}<rect fill='url(#g100)'/></svg>")), None);
    }

    #[test]
    fn style_sheets_are_refused_by_rules_times_elements() {
        let document = |rules: usize, elements: usize| {
            let sheet: String = (0..rules).map(|n| format!(".c{n} {{ fill: red }}")).collect();
            format!("<svg><style>{sheet}</style>{}</svg>", "<rect/>".repeat(elements))
        };
        assert_eq!(code(&document(100, 1000)), None);
        assert_eq!(code(&document(4000, 4000)), Some("svg-too-large"));
        let deep = format!(
            "<svg><style>{} x {{}}</style>{}{}</svg>",
            "g ".repeat(12),
            "<g>".repeat(60),
            "</g>".repeat(60)
        );
        assert_eq!(code(&deep), Some("svg-too-large"));
    }
}
