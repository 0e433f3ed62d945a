//! Tests with whole files: what is drawn, what is noted, and what is refused.

use lightbots_base::random::split_mix;

use super::draw;
use crate::drawing::{DrawingPart, FillRule};
use crate::error::Made;

fn page(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         viewBox='0 0 100 100'>{inside}</svg>"
    )
}

fn made(inside: &str) -> Made {
    draw(page(inside).as_bytes()).expect("it can be drawn")
}

fn part(inside: &str) -> DrawingPart {
    made(inside).drawing.parts.remove(0)
}

/// Areas, as colour and size in square units.
fn areas(inside: &str) -> Vec<(u32, f64)> {
    let size = |ring: &Vec<lightbots_base::Vec2>| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.cross(*b)).sum::<f64>() / 2.0
    };
    let areas = part(inside).areas;
    let sizes = areas.iter().map(|area| {
        assert_eq!(area.rule, FillRule::NonZero);
        (area.ink.color.number(), area.rings.iter().map(size).sum::<f64>().abs().round())
    });
    sizes.collect()
}

fn notes(inside: &str) -> Vec<&'static str> {
    made(inside).notes.into_iter().map(|note| note.code).collect()
}

/// The code of the error. `None` if the file is drawn.
fn refusal(file: &[u8]) -> Option<&'static str> {
    draw(file).err().map(|error| {
        assert!(error.message.ends_with('.'), "{}", error.message);
        error.code
    })
}

#[test]
fn fills_have_their_rules_colours_and_transforms() {
    let square = "<rect width='10' height='10' fill='tomato' transform='translate(5 5) scale(2)'/>";
    assert_eq!(areas(square), [(0xff6347, 400.0)]);
    let part = part(square);
    let corners = part.areas[0].rings[0].iter().map(|at| (at.x, at.y));
    let mut corners: Vec<(f64, f64)> = corners.map(|(x, y)| (x.round(), y.round())).collect();
    corners.sort_by(|a, b| a.partial_cmp(b).expect("they are numbers"));
    assert_eq!(corners, [(5.0, 75.0), (5.0, 95.0), (25.0, 75.0), (25.0, 95.0)]);
    let holed = "<path fill='red' fill-rule='evenodd' d='M0 0h20v20h-20z M5 5h10v10h-10z'/>";
    assert_eq!(areas(holed), [(0xff0000, 300.0)]);
    assert_eq!(areas(&holed.replace("evenodd", "nonzero")), [(0xff0000, 400.0)]);
}

#[test]
fn style_sheets_groups_and_uses_give_colours() {
    let inside = "<style>.a { fill: #00f } g > .b { fill: rgb(0, 128, 0) }</style><g fill='red'>\
                  <rect id='r' width='10' height='10'/><rect class='a' x='20' width='10' height='10'/>\
                  <rect class='b' x='40' width='10' height='10'/></g><use xlink:href='#r' y='50' fill='lime'/>";
    assert_eq!(areas(inside), [(0xff0000, 100.0), (0x0000ff, 100.0), (0x008000, 100.0), (0x00ff00, 100.0)]);
}

#[test]
fn thin_strokes_are_lines_and_wide_ones_areas() {
    let line =
        |width: f64| format!("<path fill='none' stroke='red' stroke-width='{width}' d='M10 10H90V50z'/>");
    let thin = part(&line(4.0));
    let strokes: Vec<(usize, bool, u32)> = thin
        .strokes
        .iter()
        .map(|stroke| (stroke.points.len(), stroke.closed, stroke.ink.color.number()))
        .collect();
    assert_eq!((strokes, thin.areas.len()), (vec![(3, true, 0xff0000)], 0));
    let wide = part(&line(20.0));
    assert_eq!((wide.strokes.len(), wide.areas.len()), (0, 1));
}

#[test]
fn hidden_parts_get_no_robots() {
    let below = "<rect width='20' height='20' fill='red'/>";
    assert_eq!(areas(&format!("{below}<rect width='50' height='50' fill='lime'/>")), [(0x00ff00, 2500.0)]);
    let unseen =
        "<rect width='9' height='9' display='none'/><rect width='9' height='9' visibility='hidden'/>";
    assert_eq!(areas(&format!("{below}{unseen}")), [(0xff0000, 400.0)]);
    let faint = format!("{below}<rect width='9' height='9' fill='blue' opacity='0.01'/>");
    assert_eq!((areas(&faint), notes(&faint)), (vec![(0xff0000, 400.0)], vec!["svg-faint"]));
    let outside = format!("{below}<rect x='200' width='9' height='9' fill='blue'/>");
    assert_eq!((areas(&outside), notes(&outside)), (vec![(0xff0000, 400.0)], vec!["svg-hidden"]));
}

#[test]
fn clip_paths_and_masks_cut() {
    let big = "width='50' height='50' fill='red'";
    let clip = format!(
        "<clipPath id='c'><circle cx='0' cy='0' r='1'/><rect width='10' height='20'/></clipPath>\
                        <rect {big} clip-path='url(#c)'/>"
    );
    assert_eq!(areas(&clip), [(0xff0000, 200.0)]);
    let mask = format!(
        "<mask id='m' maskUnits='userSpaceOnUse' x='0' y='0' width='100' height='100'>\
                        <rect width='30' height='30' fill='white'/><rect width='10' height='10'/></mask>\
                        <g transform='translate(20)'><rect {big} mask='url(#m)'/></g>"
    );
    assert_eq!(areas(&mask), [(0xff0000, 800.0)]);
}

#[test]
fn gradients_keep_their_colours_at_each_place() {
    let defs = "<linearGradient id='g'><stop offset='0' stop-color='red'/><stop offset='1' stop-color='blue'/>\
                </linearGradient><radialGradient id='r' xlink:href='#g'/>";
    let at = |inside: &str, x: f64, y: f64| {
        let ink = part(&format!("{defs}{inside}")).areas.remove(0).ink;
        ink.at(lightbots_base::Vec2::new(x, y)).number()
    };
    // y goes up in drawings: the square is from (20, 40) to (60, 80).
    let linear = "<g transform='translate(20 20) scale(4)'><rect width='10' height='10' fill='url(#g)'/></g>";
    assert_eq!([20.0, 40.0, 60.0].map(|x| at(linear, x, 50.0)), [0xff0000, 0x800080, 0x0000ff]);
    let radial = "<rect x='20' y='20' width='40' height='40' fill='url(#r)'/>";
    assert_eq!(
        [(40.0, 60.0), (50.0, 60.0), (40.0, 40.0)].map(|(x, y)| at(radial, x, y)),
        [0xff0000, 0x800080, 0x0000ff]
    );
}

#[test]
fn patterns_become_one_colour_and_gradients_have_a_mean() {
    let gradient = "<linearGradient id='g'><stop offset='0' stop-color='red'/><stop offset='1' stop-color='blue'/>\
                    </linearGradient><rect width='10' height='10' fill='url(#g)'/>";
    assert_eq!(areas(gradient), [(0x800080, 100.0)]);
    let pattern = "<pattern id='p' width='4' height='4' patternUnits='userSpaceOnUse'>\
                   <rect width='2' height='4' fill='red'/><rect x='2' width='2' height='4' fill='#ff0'/></pattern>\
                   <rect width='10' height='10' fill='url(#p)'/>";
    assert_eq!(areas(pattern), [(0xff8000, 100.0)]);
}

#[test]
fn backgrounds_and_black_are_not_lit() {
    let paper = "<rect width='100' height='100' fill='white'/>";
    let black = "<rect x='10' y='10' width='50' height='50'/>";
    let hole = "<rect x='20' y='20' width='10' height='10' fill='white'/>";
    let all = format!("{paper}{black}{hole}");
    assert_eq!((areas(&all), notes(&all)), (vec![(0xffffff, 2400.0)], vec!["svg-background"]));
    let ink = format!("{black}{hole}");
    assert_eq!((areas(&ink), notes(&ink)), (vec![(0xffffff, 2400.0)], vec!["svg-white"]));
    let mixed = format!("{black}<rect x='70' width='10' height='10' fill='red'/>");
    assert_eq!(areas(&mixed), [(0xffffff, 2500.0), (0xff0000, 100.0)]);
    assert_eq!(notes(&mixed), ["svg-black"]);
    let night = format!("<rect width='100' height='100' fill='#111'/>{hole}<rect width='9' height='9'/>");
    assert_eq!((areas(&night), notes(&night)), (vec![(0xffffff, 100.0)], vec!["svg-background"]));
    assert_eq!(areas(paper), [(0xffffff, 10000.0)]);
}

#[test]
fn everything_that_vanishes_is_noted() {
    let shape = "<rect width='10' height='10' fill='red'/>";
    let inside = format!(
        "{shape}<image xlink:href='data:image/png;base64,AA'/><foreignObject/>\
         <animate/><filter id='f'/><use xlink:href='other.svg#a'/><style>@import 'http://a/b.css';</style>"
    );
    let found = made(&inside).notes;
    let codes: Vec<&str> = found.iter().map(|note| note.code).collect();
    assert_eq!(codes, ["svg-image", "svg-foreign", "svg-animation", "svg-filter", "svg-outside"]);
    assert!(found[4].message.starts_with("2 references to other files"), "{}", found[4].message);
}

#[test]
fn texts_are_drawn_in_fonts_that_are_inside() {
    let text = "<text x='10' y='60' font-size='40' fill='red'>Il</text>";
    let drawn = areas(text);
    assert_eq!(drawn.iter().map(|area| area.0).collect::<Vec<_>>(), [0xff0000]);
    assert_eq!(notes(text), [""; 0]);
    // Two bars that are 0.72 of 40 high, and about an eighth of that wide.
    assert!((150.0..600.0).contains(&drawn[0].1), "{drawn:?}");
    let moved = format!("<g transform='translate(5 20) scale(0.5)'>{text}</g>");
    assert!((areas(&moved)[0].1 * 4.0 - drawn[0].1).abs() < 0.02 * drawn[0].1);
    let foreign = text.replace("<text", "<text font-family='No Such Font'");
    assert_eq!(notes(&foreign), ["svg-font"]);
    assert_eq!(areas(&foreign), drawn);
    for script in ["שלום", "سلام", "★", "ß"] {
        assert!(!areas(&text.replace("Il", script)).is_empty(), "{script}");
    }
}

#[test]
fn a_text_without_end_is_refused() {
    let long = format!("<text x='0' y='50'>{}</text>", "word ".repeat(40_000));
    assert_eq!(refusal(page(&long).as_bytes()), Some("svg-too-large"));
}

#[test]
fn files_without_anything_to_draw_say_why() {
    assert_eq!(refusal(b""), Some("svg-xml"));
    assert_eq!(refusal(page("").as_bytes()), Some("svg-empty"));
    let error = draw(page("<image xlink:href='a.png'/>").as_bytes()).expect_err("nothing is drawn");
    assert!(error.message.contains("A picture inside the SVG is not drawn."), "{}", error.message);
    assert_eq!(refusal(b"<html><body/></html>"), Some("svg-tree"));
    assert_eq!(refusal(&[0x1f, 0x8b, 8, 0]), Some("svg-compressed"));
    assert_eq!(refusal(b"<svg>\xe4</svg>"), Some("svg-text"));
}

#[test]
fn bombs_are_refused() {
    let entities: String =
        (1..12).map(|n| format!("<!ENTITY e{n} \"{}\">", format!("&e{};", n - 1).repeat(10))).collect();
    let bomb = format!(
        "<!DOCTYPE svg [<!ENTITY e0 \"<g/>\">{entities}]><svg xmlns='http://www.w3.org/2000/svg'>&e11;</svg>"
    );
    assert!(matches!(refusal(bomb.as_bytes()), Some("svg-xml" | "svg-too-large")));
    let outside = "<!DOCTYPE svg [<!ENTITY x SYSTEM 'file:///etc/passwd'>]><svg xmlns='http://www.w3.org/2000/svg'>&x;</svg>";
    assert!(refusal(outside.as_bytes()).is_some());
    assert_eq!(refusal(page(&"<g>".repeat(100_000)).as_bytes()), Some("svg-too-deep"));
    assert_eq!(refusal(page(&"<g/>".repeat(200_001)).as_bytes()), Some("svg-too-large"));
    let attributes: String = (0..10_000).map(|n| format!(" a{n}='1'")).collect();
    assert_eq!(refusal(page(&format!("<g{attributes}/>")).as_bytes()), Some("svg-too-large"));
    assert_eq!(refusal(&vec![b' '; 10_000_001]), Some("svg-too-large"));
    let many: String = (0..20_001).map(|n| format!("<path d='M{n} 0h1v1z'/>")).collect();
    assert_eq!(refusal(page(&many).as_bytes()), Some("svg-too-large"));
    let curves = format!("<path d='M0 0{}'/>", "q9 0 9 9t-9-9".repeat(200_000));
    assert_eq!(refusal(page(&curves).as_bytes()), Some("svg-too-large"));
}

#[test]
fn elements_that_refer_to_themselves_are_left_out() {
    let shape = "<rect width='10' height='10' fill='red'/>";
    for inside in [
        "<g id='a'><use xlink:href='#a'/></g>",
        "<clipPath id='a'><rect width='9' height='9' clip-path='url(#a)'/></clipPath><g clip-path='url(#a)'><rect/></g>",
        "<pattern id='a'><rect width='9' height='9' fill='url(#a)'/></pattern><rect width='9' fill='url(#a)'/>",
        "<mask id='a' mask='url(#a)'><rect mask='url(#a)'/></mask><rect mask='url(#a)'/>",
    ] {
        assert_eq!(areas(&format!("{shape}{inside}")), [(0xff0000, 100.0)], "{inside}");
    }
}

#[test]
fn numbers_that_are_none_are_left_out() {
    let shape = "<rect width='10' height='10' fill='red'/>";
    for inside in [
        "<rect width='9' height='9' transform='scale(NaN)'/>",
        "<path d='M0 0H1e308V1e308z'/>",
        "<rect width='9' height='9' transform='scale(1e30)'/>",
        "<path d='M0 0h-9e6v9e6z'/>",
        "<rect width='1e39' height='9'/>",
    ] {
        let made = made(&format!("{shape}{inside}"));
        let (low, high) = made.drawing.bounds().expect("the square is drawn");
        assert!(
            low.x >= -1.0 && high.x <= 101.0 && low.y >= -1.0 && high.y <= 101.0,
            "{inside}: {low:?} {high:?}"
        );
    }
    for view in ["0 0 0 0", "0 0 -5 5", "0 0 1e39 1e39", "0 0 1e30 1e30", "a b c d", "0 0 NaN 1"] {
        let file = page(shape).replace("0 0 100 100", view);
        match draw(file.as_bytes()) {
            Ok(made) => {
                let finite = made.drawing.points().all(|at| at.is_finite() && at.length() < 1e7);
                assert!(finite, "{view}");
            }
            Err(error) => {
                assert!(matches!(error.code, "svg-page" | "svg-empty" | "svg-tree"), "{view}: {error}")
            }
        }
    }
}

/// A file with most features of SVG.
fn rich() -> String {
    page(
        "<style>.a > path, #b { fill: url(#g) } @media x { * { stroke: red } }</style><defs><linearGradient id='g' \
         x1='0'><stop offset='0' stop-color='red'/><stop offset='1' stop-color='#00f8'/></linearGradient>\
         <radialGradient id='r' xlink:href='#g' fx='0.2'/><pattern id='p' width='4' height='4' \
         patternUnits='userSpaceOnUse'><circle r='2' fill='#0f0'/></pattern><clipPath id='c'><rect width='50' \
         height='50'/></clipPath><mask id='m'><rect width='60' height='60' fill='white'/></mask><filter id='f'>\
         <feGaussianBlur stdDeviation='2'/><feImage xlink:href='#b'/></filter><marker id='k' markerWidth='3'><path \
         d='M0 0L3 3'/></marker><symbol id='s' viewBox='0 0 9 9'><ellipse rx='4' ry='3'/></symbol></defs><g class='a' \
         transform='rotate(5) matrix(1 0 0 1 2 3)' clip-path='url(#c)'><path id='b' d='M1 1c5 5,9 0 9 9S3 4 5 6q1 2 3 \
         4t5 6a5 6 7 1 0 8 9z'/></g><rect width='30' height='30' rx='3' fill='url(#p)' mask='url(#m)' \
         filter='url(#f)'/><polyline points='0 0 9 9 18 0' fill='none' stroke='url(#r)' stroke-dasharray='3 1' \
         marker-mid='url(#k)'/><use xlink:href='#s' width='20' height='20' opacity='.5'/><switch><g \
         systemLanguage='en'><line x2='9' y2='9' stroke='hsl(120, 50%, 50%)' stroke-width='20'/></g></switch>",
    )
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    let file = rich();
    assert_eq!(refusal(file.as_bytes()), None);
    for end in 0..file.len() {
        assert!(refusal(&file.as_bytes()[..end]).is_some(), "{end}");
    }
}

#[test]
fn damaged_files_are_drawn_or_refused() {
    let file = rich();
    let mut state = 25;
    let mut below = |count: usize| (split_mix(&mut state) % count as u64) as usize;
    for _ in 0..1_000 {
        let mut bytes = file.clone().into_bytes();
        for _ in 0..1 + below(4) {
            let at = below(bytes.len());
            bytes[at] = if below(2) == 0 { below(256) as u8 } else { b"0 9e-.#<>'/=&;(){}"[below(18)] };
        }
        if let Ok(made) = draw(&bytes) {
            assert!(made.drawing.points().all(|at| at.is_finite()));
        }
    }
}
