//! From a drawing and a number of robots to lights on the floor.

use lightbots_base::Vec2;

use crate::arrange::arrange;
use crate::buckets::nearest_distances;
use crate::drawing::Drawing;
use crate::error::{DrawError, Note};
use crate::fit::{PictureFloor, Placement};
use crate::readability::{Readability, readability};
use crate::settings::{PlaceSettings, PlacedLight};

/// How often a picture is made anew at a larger size before it is refused.
const TRIES: usize = 5;

/// A picture of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The lights: the kept ones first, then group by group.
    pub lights: Vec<PlacedLight>,
    /// Larger side of the picture, metres.
    pub size_m: f64,
    /// Distance of the closest two lights, metres.
    pub closest_m: f64,
    /// How well the lights show the drawing.
    pub readability: Readability,
    /// What is different from what was asked for.
    pub notes: Vec<Note>,
}

/// Places lights on a floor.
///
/// # Errors
/// A drawing of nothing, numbers out of range, or more robots than fit on the floor; each with the number that would do.
pub fn place(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Result<Placed, DrawError> {
    settings.check()?;
    let mut placement = Placement::new(drawing, floor, settings)?;
    let mut notes = Vec::new();
    for _ in 0..TRIES {
        let mut scaled = placement.apply(drawing);
        let mut made = arrange(&scaled, floor, settings)?;
        let mut closest = closest(&made, settings.spacing_m);
        let missing = settings.spacing_m / closest;
        if missing > 1.0 && placement.has_room(missing) && floor.no_go.is_empty() && settings.kept.is_empty()
        {
            let factor = placement.enlarge(missing, floor, settings, made.len(), closest)?;
            made.iter_mut()
                .for_each(|light| light.at = settings.center + (light.at - settings.center) * factor);
            scaled = placement.apply(drawing);
            closest *= factor;
        }
        if closest >= settings.spacing_m * (1.0 - 1e-9) {
            if let Some(wanted) = settings.size_m.filter(|wanted| placement.size_m() > 1.001 * wanted) {
                notes.push(enlarged(wanted, placement.size_m(), settings));
            }
            let readability = readability(&scaled, &made);
            return Ok(Placed {
                lights: made,
                size_m: placement.size_m(),
                closest_m: closest,
                readability,
                notes,
            });
        }
        placement.enlarge(settings.spacing_m / closest.max(1e-6), floor, settings, made.len(), closest)?;
    }
    Err(DrawError::new(
        "too-many-robots",
        format!(
            "{} robots do not find room in this picture; use fewer robots or a larger floor",
            settings.robots
        ),
    ))
}

fn enlarged(wanted: f64, size: f64, settings: &PlaceSettings) -> Note {
    let what = format!(
        "the picture is {size:.2} m wide instead of {wanted:.2} m, because {} robots stand at least {:.0} mm apart",
        settings.robots,
        settings.spacing_m * 1_000.0
    );
    Note::new("enlarged", what)
}

/// Distance of the closest pair, metres; infinite for one light.
fn closest(lights: &[PlacedLight], spacing: f64) -> f64 {
    let places: Vec<Vec2> = lights.iter().map(|light| light.at).collect();
    nearest_distances(&places, spacing).into_iter().fold(f64::INFINITY, f64::min)
}
