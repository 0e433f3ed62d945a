//! Finds the colours of a fill or stroke.

use lightbots_base::{Rgb, Vec2};
use usvg::tiny_skia_path::Transform;
use usvg::{BaseGradient, Group, LinearGradient, Node, Paint, RadialGradient, SpreadMethod};

use crate::ink::{Gradient, GradientShape, GradientSpread, Ink};

/// Largest number of levels of patterns inside patterns that are followed.
const PATTERNS_MAX: usize = 4;

/// A colour and its opacity, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tint {
    /// The colour.
    color: Rgb,
    /// Its opacity.
    opacity: f64,
}

/// Returns the ink of a paint on the page, and its opacity, 0 to 1. `transform` maps the painted element to the page.
/// `None` for a pattern without colours.
pub fn ink(paint: &Paint, transform: Transform) -> Option<(Ink, f64)> {
    let Tint { color, opacity } = tint(paint)?;
    let gradient = match paint {
        Paint::LinearGradient(gradient) => Some(linear(gradient, transform)),
        Paint::RadialGradient(gradient) => Some(radial(gradient, transform)),
        Paint::Color(_) | Paint::Pattern(_) => None,
    };
    Some((Ink { color, gradient: gradient.filter(|gradient| !gradient.stops.is_empty()) }, opacity))
}

fn linear(of: &LinearGradient, transform: Transform) -> Gradient {
    let shape = GradientShape::Linear { from: vec2(of.x1(), of.y1()), to: vec2(of.x2(), of.y2()) };
    gradient(of, shape, transform)
}

fn radial(of: &RadialGradient, transform: Transform) -> Gradient {
    let (center, focus) = (vec2(of.cx(), of.cy()), vec2(of.fx(), of.fy()));
    gradient(of, GradientShape::Radial { center, radius: f64::from(of.r().get()), focus }, transform)
}

fn gradient(of: &BaseGradient, shape: GradientShape, transform: Transform) -> Gradient {
    let Transform { sx, kx, ky, sy, tx, ty } = transform.pre_concat(of.transform());
    let frame = [vec2(tx, ty), vec2(tx + sx, ty + ky), vec2(tx + kx, ty + sy)];
    let spread = match of.spread_method() {
        SpreadMethod::Pad => GradientSpread::Pad,
        SpreadMethod::Reflect => GradientSpread::Reflect,
        SpreadMethod::Repeat => GradientSpread::Repeat,
    };
    let stops = of.stops().iter().map(|stop| (f64::from(stop.offset().get()), rgb(stop.color())));
    Gradient { frame, shape, spread, stops: stops.collect() }
}

fn vec2(x: f32, y: f32) -> Vec2 {
    Vec2::new(f64::from(x), f64::from(y))
}

/// Returns the colour of a paint: for a gradient the mean of its colours, for a pattern the mean of the areas in it.
/// `None` for a pattern without colours, or with too many levels of patterns inside.
fn tint(paint: &Paint) -> Option<Tint> {
    at_level(paint, 0)
}

fn at_level(paint: &Paint, level: usize) -> Option<Tint> {
    match paint {
        Paint::Color(color) => Some(Tint { color: rgb(*color), opacity: 1.0 }),
        Paint::LinearGradient(gradient) => mean(stops(gradient)),
        Paint::RadialGradient(gradient) => mean(stops(gradient)),
        Paint::Pattern(_) if level == PATTERNS_MAX => None,
        Paint::Pattern(pattern) => {
            let mut found = Vec::new();
            areas(pattern.root(), level, &mut found);
            mean(found.into_iter())
        }
    }
}

fn rgb(color: usvg::Color) -> Rgb {
    Rgb::new(color.red, color.green, color.blue)
}

/// Stops of a gradient. Each has the share of the gradient that is nearer to this stop than to others.
fn stops(gradient: &BaseGradient) -> impl Iterator<Item = (Tint, f64)> + '_ {
    let stops = gradient.stops();
    let offset = |n: usize| stops.get(n).map(|stop| f64::from(stop.offset().get()));
    stops.iter().enumerate().map(move |(n, stop)| {
        let from =
            n.checked_sub(1).and_then(offset).map_or(0.0, |before| (before + offset(n).unwrap_or(0.0)) / 2.0);
        let to = offset(n + 1).map_or(1.0, |after| (after + offset(n).unwrap_or(1.0)) / 2.0);
        let tint = Tint { color: rgb(stop.color()), opacity: f64::from(stop.opacity().get()) };
        (tint, (to - from).max(0.0))
    })
}

/// Adds the paints in a pattern to `found`, each with the size of the box around the painted path.
fn areas(group: &Group, level: usize, found: &mut Vec<(Tint, f64)>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => areas(inner, level, found),
            Node::Path(path) => {
                let paint = path.fill().map(|fill| fill.paint());
                let paint = paint.or(path.stroke().map(|stroke| stroke.paint()));
                let area = f64::from(path.bounding_box().width() * path.bounding_box().height());
                found.extend(
                    paint.and_then(|paint| at_level(paint, level + 1)).map(|tint| (tint, area.max(1e-9))),
                );
            }
            Node::Image(_) | Node::Text(_) => {}
        }
    }
}

/// Returns the mean of colours, weighted by share times opacity, with the mean opacity. `None` if the shares sum to 0.
fn mean(tints: impl Iterator<Item = (Tint, f64)>) -> Option<Tint> {
    let mut sum = [0.0; 3];
    let (mut light, mut weight) = (0.0, 0.0);
    for (tint, share) in tints {
        let visible = share * tint.opacity;
        let channels = [tint.color.r, tint.color.g, tint.color.b];
        sum.iter_mut().zip(channels).for_each(|(sum, channel)| *sum += visible * f64::from(channel));
        light += visible;
        weight += share;
    }
    if weight <= 0.0 || weight.is_nan() {
        return None;
    }
    let channel = |sum: f64| (sum / light + 0.5) as u8;
    let color =
        if light > 0.0 { Rgb::new(channel(sum[0]), channel(sum[1]), channel(sum[2])) } else { Rgb::BLACK };
    Some(Tint { color, opacity: light / weight })
}
