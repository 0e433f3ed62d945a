//! Allots robots to the parts of a drawing and lays each part out.

use lightbots_base::Vec2;

use crate::allot::{Share, allot, demands};
use crate::colour::Paint;
use crate::drawing::{Drawing, DrawingPart};
use crate::error::DrawError;
use crate::fit::PictureFloor;
use crate::geometry::hexagonal_spacing;
use crate::ground::Ground;
use crate::layout::{Layout, LayoutTask, Style, separate};
use crate::settings::{PlaceSettings, PlacedLight};
use crate::thick::{BandLoad, thickened};

/// In style `Auto`, areas wider than this number of spacings, on average, get robots along the edge and a filling if
/// there are enough robots. In narrower areas that filling would zigzag.
const WIDE: f64 = 2.0;

/// Up to this number of robots for each part with areas, no robots stand along the edge. Too few would be left for the
/// filling. Six shapes of 30 robots reach a readability of 0.86 to 0.96 with an edge, and of 0.99 to 1.00 without. With
/// 60 robots they reach 0.96 to 0.98, and the edge is crisper (`make --style`).
const FEW_FOR_EDGES: usize = 50;

/// Up to this number of robots for each part with areas, a filling is read better than strokes. Measured with 36 signs:
/// the limit is 12 to 13.
const FEW_FOR_LINES: usize = 13;

/// A piece of a drawing: a part, or only the areas or only the lines of a part that has both. `number`: index of the
/// part.
struct Piece {
    number: usize,
    part: DrawingPart,
    ground: Ground,
}

/// Places lights on a drawing whose coordinates are stage metres already. The kept lights of `settings` come first.
///
/// # Errors
/// No part of the drawing is on the floor and outside no-go areas.
pub(crate) fn arrange(
    drawing: &Drawing,
    floor: &PictureFloor,
    settings: &PlaceSettings,
) -> Result<Vec<PlacedLight>, DrawError> {
    let mut pieces = pieces(drawing, floor, settings);
    if settings.style == Style::Filled {
        thicken(&mut pieces, floor, settings);
    }
    let style = style(&pieces, settings);
    let grounds: Vec<&Ground> = pieces.iter().map(|piece| &piece.ground).collect();
    let kept = kept_by_piece(&grounds, settings);
    let demands = demands(&grounds, style, settings.robots);
    let shares: Vec<Share> =
        demands.into_iter().zip(&kept).map(|(demand, kept)| Share { demand, least: kept.len() }).collect();
    let counts = allot(&shares, settings.robots);
    if counts.iter().sum::<usize>() != settings.robots {
        let what = "nothing of the picture is on the floor and outside of no-go areas; move it";
        return Err(DrawError::new("no-room", what));
    }
    let mut layouts: Vec<Layout> = (0..pieces.len())
        .map(|index| layout(grounds[index], &kept[index], counts[index], style, settings))
        .collect();
    separate(&grounds, &mut layouts);
    let mut lights = settings.kept.clone();
    for (index, (piece, layout)) in pieces.iter().zip(layouts).enumerate() {
        let paint = Paint::new(&piece.part);
        let free = layout.places.into_iter().skip(kept[index].len());
        lights.extend(free.map(|at| PlacedLight { at, color: paint.at(at), part: piece.number }));
    }
    Ok(lights)
}

/// Splits all parts into pieces. A part with both areas and strokes gives two pieces.
fn pieces(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Vec<Piece> {
    let allowed = |at: Vec2| floor.allows(at);
    let each = settings.robots / drawing.parts.len().max(1) + 1;
    let mut pieces = Vec::new();
    for (number, part) in drawing.parts.iter().enumerate() {
        let mut add = |part: DrawingPart| {
            let ground = Ground::new(&part, each, settings.quality, &allowed);
            pieces.push(Piece { number, part, ground });
        };
        if part.areas.is_empty() || part.strokes.is_empty() {
            add(part.clone());
            continue;
        }
        add(DrawingPart { strokes: Vec::new(), ..part.clone() });
        add(DrawingPart { areas: Vec::new(), spine: Vec::new(), ..part.clone() });
    }
    pieces
}

/// Gives lines some width, so that they become bands, if the lines have no room for all robots.
fn thicken(pieces: &mut [Piece], floor: &PictureFloor, settings: &PlaceSettings) {
    let is_line = |piece: &Piece| piece.ground.samples.is_empty();
    let sum = |lines: bool, of: fn(&Ground) -> f64, pieces: &[Piece]| -> f64 {
        pieces.iter().filter(|piece| is_line(piece) == lines).map(|piece| of(&piece.ground)).sum()
    };
    let load = BandLoad {
        robots: settings.robots,
        spacing: settings.spacing_m,
        length: sum(true, |ground| ground.lines.length(), pieces),
        area: sum(false, |ground| ground.mass, pieces),
    };
    let Some(width) = load.width() else { return };
    let each = settings.robots / pieces.len().max(1) + 1;
    for piece in pieces.iter_mut().filter(|piece| is_line(piece)) {
        let part = thickened(&piece.part, width);
        piece.ground = Ground::new(&part, each, settings.quality, &|at| floor.allows(at));
    }
}

/// Chooses the style of the areas: that in `settings`, unless it is `Auto`. All areas get the same style, so that the
/// letters of a word look alike.
fn style(pieces: &[Piece], settings: &PlaceSettings) -> Style {
    if settings.style != Style::Auto {
        return settings.style;
    }
    let filled: Vec<&Ground> =
        pieces.iter().map(|piece| &piece.ground).filter(|ground| !ground.samples.is_empty()).collect();
    let area: f64 = filled.iter().map(|ground| ground.mass).sum();
    let edge: f64 = filled.iter().map(|ground| ground.outline.length()).sum();
    if edge == 0.0 {
        return Style::Filled;
    }
    let spacing = hexagonal_spacing(area, settings.robots);
    let have_lines = filled.iter().all(|ground| !ground.lines.lines.is_empty());
    if 2.0 * area / edge > WIDE * spacing && settings.robots > FEW_FOR_EDGES * filled.len() {
        Style::Both
    } else if have_lines && settings.robots > FEW_FOR_LINES * filled.len() {
        Style::Lines
    } else {
        Style::Filled
    }
}

/// `[piece]`: the kept places that are nearer to this piece than to any other, stage metres.
fn kept_by_piece(grounds: &[&Ground], settings: &PlaceSettings) -> Vec<Vec<Vec2>> {
    let mut kept = vec![Vec::new(); grounds.len()];
    for light in &settings.kept {
        let distance = |ground: &Ground| {
            let points = if ground.inside.is_empty() { ground.lines.points() } else { &ground.inside };
            points.iter().map(|point| point.distance(light.at)).fold(f64::INFINITY, f64::min)
        };
        let nearest =
            (0..grounds.len()).min_by(|a, b| distance(grounds[*a]).total_cmp(&distance(grounds[*b])));
        if let Some(index) = nearest {
            kept[index].push(light.at);
        }
    }
    kept
}

fn layout(ground: &Ground, kept: &[Vec2], count: usize, style: Style, settings: &PlaceSettings) -> Layout {
    let task = LayoutTask {
        ground,
        kept,
        count,
        start: &settings.start,
        quality: settings.quality,
        seed: settings.seed,
    };
    task.layout(style)
}
