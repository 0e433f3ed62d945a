//! Writes a text as SVG, with filled areas, and spines as lines:
//! `cargo run -p lightbots-draw --example text -- lato LOVE > love.svg`.

use std::io::{Error, Write};

use lightbots_base::Vec2;
use lightbots_draw::text::{self, Font, TextSettings};

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let (name, words) = (arguments.next().unwrap_or_default(), arguments.next().unwrap_or_default());
    let font = Font::built_in(&name).ok_or_else(|| Error::other(format!("no font is named {name:?}")))?;
    let settings = TextSettings {
        wrap: arguments.next().and_then(|ratio| ratio.parse().ok()),
        colors: text::Colors::Rainbow,
        ..TextSettings::new(&words, &font)
    };
    let made = text::draw(&settings).map_err(Error::other)?;
    let mut err = std::io::stderr();
    for note in &made.notes {
        writeln!(err, "{}", note.message)?;
    }
    let (low, high) = made.drawing.bounds().unwrap_or_default();
    let mut out = std::io::stdout();
    let (width, height) = (high.x - low.x + 0.4, high.y - low.y + 0.4);
    let view = format!("{} {} {width} {height}", low.x - 0.2, -high.y - 0.2);
    writeln!(
        out,
        "<svg xmlns='http://www.w3.org/2000/svg' width='{}' viewBox='{view}'>",
        (width * 120.0).min(1600.0)
    )?;
    for part in &made.drawing.parts {
        for area in &part.areas {
            let rings = area.rings.iter().map(|ring| path(ring, true)).collect::<String>();
            let color = area.ink.color.number();
            writeln!(out, "<path d='{rings}' fill='#{color:06x}' fill-opacity='.5'/>")?;
        }
        for stroke in part.strokes.iter().chain(&part.spine) {
            let points = path(&stroke.points, stroke.closed);
            writeln!(out, "<path d='{points}' fill='none' stroke='#000' stroke-width='.03'/>")?;
            for point in &stroke.points {
                writeln!(out, "<circle cx='{}' cy='{}' r='.025' fill='#c00'/>", point.x, -point.y)?;
            }
        }
    }
    writeln!(out, "</svg>")
}

fn path(points: &[Vec2], closed: bool) -> String {
    let list =
        points.iter().map(|point| format!("{} {}", point.x, -point.y)).collect::<Vec<String>>().join("L");
    format!("M{list}{}", if closed { "Z" } else { "" })
}
