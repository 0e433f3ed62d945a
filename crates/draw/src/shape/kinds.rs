//! Kinds of shapes and their settings.

use lightbots_base::{Rgb, Vec2};

use crate::error::DrawError;

/// Largest number of points in [`ShapeSettings::points`].
pub const MAX_SHAPE_POINTS: usize = 10_000;

/// A kind of shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ShapeKind {
    /// A straight line.
    Line,
    /// Straight lines from point to point.
    Polyline,
    /// A smooth line through points.
    Curve,
    /// A line drawn by hand, smoothed a little.
    Freehand,
    /// A rectangle.
    Rectangle,
    /// A polygon with equal sides.
    Polygon,
    /// A circle.
    Circle,
    /// A part of a circle.
    Arc,
    /// Concentric circles.
    Rings,
    /// A spiral with equal distances between its turns.
    Spiral,
    /// A star.
    Star,
    /// A heart.
    Heart,
    /// A wave.
    Wave,
    /// An arrow.
    Arrow,
    /// A square grid.
    Grid,
    /// A hexagonal grid.
    Hexagons,
    /// Random places, apart from each other.
    Random,
}

/// All kinds, with the names that files and commands use.
pub const SHAPES: [(ShapeKind, &str); 17] = [
    (ShapeKind::Line, "line"),
    (ShapeKind::Polyline, "polyline"),
    (ShapeKind::Curve, "curve"),
    (ShapeKind::Freehand, "freehand"),
    (ShapeKind::Rectangle, "rectangle"),
    (ShapeKind::Polygon, "polygon"),
    (ShapeKind::Circle, "circle"),
    (ShapeKind::Arc, "arc"),
    (ShapeKind::Rings, "rings"),
    (ShapeKind::Spiral, "spiral"),
    (ShapeKind::Star, "star"),
    (ShapeKind::Heart, "heart"),
    (ShapeKind::Wave, "wave"),
    (ShapeKind::Arrow, "arrow"),
    (ShapeKind::Grid, "grid"),
    (ShapeKind::Hexagons, "hexagons"),
    (ShapeKind::Random, "random"),
];

/// A shape and its settings. Each kind uses only some of them.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeSettings {
    /// The kind of shape.
    pub kind: ShapeKind,
    /// Width divided by height. Used for all closed shapes, waves, grids and random places.
    pub aspect: f64,
    /// Number of corners of a polygon, of tips of a star, or of circles of rings.
    pub count: usize,
    /// Number of turns of a spiral, or of periods of a wave.
    pub turns: f64,
    /// Inner radius of a star, of rings or of a spiral, as a share of the outer radius.
    pub inner: f64,
    /// Angle of an arc, radians.
    pub span: f64,
    /// Points of a line, polyline, curve or freehand line. Unit of length: any; y upwards.
    pub points: Vec<Vec2>,
    /// Whether a polyline, curve or freehand line joins its last point to its first.
    pub closed: bool,
    /// Colour of the lights.
    pub color: Rgb,
}

impl ShapeKind {
    /// The name of the kind in files and commands.
    pub fn name(self) -> &'static str {
        SHAPES.into_iter().find(|(known, _)| *known == self).map_or("shape", |(_, name)| name)
    }
}

impl ShapeSettings {
    /// Returns the default settings for a kind of shape.
    pub fn new(kind: ShapeKind) -> Self {
        let (count, turns, inner) = match kind {
            ShapeKind::Star => (5, 1.0, 0.4),
            ShapeKind::Rings => (3, 1.0, 0.3),
            ShapeKind::Spiral => (1, 3.0, 0.1),
            ShapeKind::Wave => (1, 2.0, 0.4),
            _ => (6, 1.0, 0.4),
        };
        Self {
            kind,
            aspect: if kind == ShapeKind::Wave { 3.0 } else { 1.0 },
            count,
            turns,
            inner,
            span: core::f64::consts::PI,
            points: Vec::new(),
            closed: false,
            color: Rgb::new(255, 165, 0),
        }
    }

    /// Checks that the settings are in range.
    pub(super) fn check(&self) -> Result<(), DrawError> {
        let fail = |what: &str| Err(DrawError::new("bad-shape", what));
        if !(0.01..=100.0).contains(&self.aspect) {
            return fail("the width of a shape is 0.01 to 100 times its height");
        }
        if !(1..=200).contains(&self.count) {
            return fail("a shape has 1 to 200 corners, tips or circles");
        }
        if !(0.05..=50.0).contains(&self.turns) || !(0.0..=0.99).contains(&self.inner) {
            return fail("a shape has 0.05 to 50 turns and an inner radius of 0 to 0.99");
        }
        if !(0.01..=core::f64::consts::TAU).contains(&self.span) {
            return fail("an arc has an angle of 0.01 to 2π");
        }
        if self.points.len() > MAX_SHAPE_POINTS || !self.points.iter().all(|point| point.is_finite()) {
            return fail("a drawn line has at most 10000 points, all of them numbers");
        }
        Ok(())
    }
}

/// Returns the kind of shape with this name in files and commands; `None` if there is none.
pub fn shape_named(name: &str) -> Option<ShapeKind> {
    SHAPES.into_iter().find(|(_, known)| *known == name).map(|(kind, _)| kind)
}
