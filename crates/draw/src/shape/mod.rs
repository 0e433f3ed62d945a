//! Ready-made shapes with a few settings each.

mod closed;
mod curves;
mod exact;
mod kinds;

use lightbots_base::{Rgb, Vec2};

use crate::drawing::{Area, Drawing, DrawingPart, FillRule, Stroke};
use crate::error::DrawError;

pub use exact::exact_places;
pub use kinds::{MAX_SHAPE_POINTS, SHAPES, ShapeKind, ShapeSettings, shape_named};

/// Returns the drawing of a shape. Shapes without points of their own are about one unit in size, and some are `aspect`
/// times as wide. Grids and random places have no drawing, because they depend on the number of robots: use
/// [`exact_places`] for them.
///
/// # Errors
/// Settings out of range, a line of fewer than two points, a grid, or random places.
pub fn draw_shape(settings: &ShapeSettings) -> Result<Drawing, DrawError> {
    settings.check()?;
    let mut part = DrawingPart { name: settings.kind.name().into(), ..DrawingPart::default() };
    if let Some(rings) = closed::rings(settings) {
        // If there are not enough robots for edge and filling, the edge can stand for the area.
        part.spine = rings.iter().map(|ring| stroke(ring.clone(), true, settings.color)).collect();
        part.areas = vec![Area { rings, rule: FillRule::EvenOdd, ink: settings.color.into(), weight: 1.0 }];
    } else {
        part.strokes = curves::lines(settings)
            .into_iter()
            .map(|(points, closed)| stroke(points, closed, settings.color))
            .collect();
    }
    if part.strokes.iter().any(|stroke| stroke.points.len() < 2) {
        return Err(DrawError::new("bad-shape", "a line needs at least two points; draw a longer one"));
    }
    Ok(Drawing { parts: vec![part] })
}

fn stroke(points: Vec<Vec2>, closed: bool, color: Rgb) -> Stroke {
    Stroke { points, closed, ink: color.into(), weight: 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PictureFloor, PlaceSettings, place};

    #[test]
    fn every_shape_has_a_name_of_its_own_and_can_be_shown() {
        for (kind, name) in SHAPES {
            assert_eq!(shape_named(name), Some(kind));
            let points =
                [(0.0, 0.0), (0.5, 1.0), (1.0, 0.0), (1.5, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
            let settings = ShapeSettings { points, ..ShapeSettings::new(kind) };
            let wanted = PlaceSettings { robots: 37, ..PlaceSettings::default() };
            let floor = PictureFloor::new(5.0, 5.0, 0.1);
            if let Some(exact) = exact_places(&settings, 37, 1) {
                assert_eq!(exact.len(), 37, "{name}");
                continue;
            }
            let placed = place(&draw_shape(&settings).unwrap(), &floor, &wanted).unwrap();
            assert_eq!(placed.lights.len(), 37, "{name}");
        }
        assert_eq!(shape_named("blob"), None);
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        let star = ShapeSettings::new(ShapeKind::Star);
        let refused = |settings: ShapeSettings| draw_shape(&settings).unwrap_err().code == "bad-shape";
        assert!(refused(ShapeSettings { count: 0, ..star.clone() }));
        assert!(refused(ShapeSettings { inner: f64::NAN, ..star.clone() }));
        assert!(refused(ShapeSettings { aspect: -1.0, ..star }));
        assert!(refused(ShapeSettings::new(ShapeKind::Polyline)));
    }

    #[test]
    fn a_star_of_thirty_lights_is_symmetric_and_readable() {
        let star = draw_shape(&ShapeSettings::new(ShapeKind::Star)).unwrap();
        let placed = place(&star, &PictureFloor::new(3.0, 3.0, 0.1), &PlaceSettings::default()).unwrap();
        assert!(placed.readability.symmetry > 0.99, "{:?}", placed.readability);
        assert!(placed.readability.correlation > crate::READABLE, "{:?}", placed.readability);
    }
}
