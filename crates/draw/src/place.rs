//! Places lights on the floor so that a number of robots shows a drawing.

use lightbots_base::Vec2;

use crate::arrange::arrange;
use crate::buckets::closest_distance;
use crate::drawing::Drawing;
use crate::error::{DrawError, Note};
use crate::fit::{PictureFloor, Placement};
use crate::layout::Style;
use crate::readability::{Readability, readability};
use crate::settings::{PlaceSettings, PlacedLight};

/// Largest number of sizes that are tried, each larger than the size before. Then the picture is refused.
const TRIES: usize = 5;

/// A picture of lights.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The lights: the kept lights first, then the new lights of each part in turn.
    pub lights: Vec<PlacedLight>,
    /// Larger side of the picture, metres.
    pub size_m: f64,
    /// Distance between the closest two lights, metres; infinite for a single light.
    pub closest_m: f64,
    /// How well the lights show the drawing.
    pub readability: Readability,
    /// What differs from the settings, such as a larger size or a smaller spacing.
    pub notes: Vec<Note>,
}

/// Why a picture was refused.
struct Refusal {
    error: DrawError,
    /// Distance of the closest pair at the largest size, divided by the wanted spacing. `None` if the picture was
    /// refused for another reason.
    share: Option<f64>,
}

impl From<DrawError> for Refusal {
    fn from(error: DrawError) -> Self {
        Self { error, share: None }
    }
}

/// Places lights on a floor. If [`Style::Auto`] is set and the lights do not fit, areas are filled instead. If the
/// lights still do not fit at `spacing_m`, they are placed closer together, but at least `least_m` apart, and a note
/// says so.
///
/// # Errors
/// An empty drawing, numbers out of range, a picture off the floor, or more robots than fit on the floor.
pub fn place(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Result<Placed, DrawError> {
    settings.check()?;
    let refused = match attempts(drawing, floor, settings) {
        Ok(placed) => return Ok(placed),
        Err(refused) => refused,
    };
    let spacing_m = (0.99 * refused.share.unwrap_or(1.0) * settings.spacing_m).max(settings.least_m);
    if refused.share.is_none() || spacing_m >= settings.spacing_m {
        return Err(refused.error);
    }
    let mut placed = attempts(drawing, floor, &PlaceSettings { spacing_m, ..settings.clone() })
        .map_err(|refused| refused.error)?;
    let what = format!(
        "the robots stand {:.0} mm apart instead of {:.0} mm, because more room is not on the floor",
        placed.closest_m * 1_000.0,
        settings.spacing_m * 1_000.0
    );
    placed.notes.push(Note::new("closer", what));
    Ok(placed)
}

/// Tries the style of the settings. If this is [`Style::Auto`] and lights do not fit, tries [`Style::Filled`] next.
fn attempts(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Result<Placed, Refusal> {
    let first = attempt(drawing, floor, settings);
    let Err(refused) = first else { return first };
    if settings.style != Style::Auto || refused.share.is_none() {
        return Err(refused);
    }
    let filled = attempt(drawing, floor, &PlaceSettings { style: Style::Filled, ..settings.clone() });
    filled.map_err(|other| if other.share > refused.share { other } else { refused })
}

/// Tries one style at one spacing, at growing sizes if needed.
fn attempt(drawing: &Drawing, floor: &PictureFloor, settings: &PlaceSettings) -> Result<Placed, Refusal> {
    let mut placement = Placement::new(drawing, floor, settings)?;
    for _ in 0..TRIES {
        let mut scaled = placement.apply(drawing);
        let mut made = arrange(&scaled, floor, settings)?;
        let mut closest_m = closest_distance(&places_of(&made));
        let missing = settings.spacing_m / closest_m;
        if missing > 1.0 && placement.has_room(missing) && floor.no_go.is_empty() && settings.kept.is_empty()
        {
            let factor = placement.enlarge(missing, floor, settings, made.len(), closest_m)?;
            let spread = |at: Vec2| settings.center + (at - settings.center) * factor;
            made.iter_mut().for_each(|light| light.at = spread(light.at));
            scaled = placement.apply(drawing);
            closest_m *= factor;
        }
        if closest_m >= settings.spacing_m * (1.0 - 1e-9) {
            let size_m = placement.size_m();
            let wanted = settings.size_m.filter(|wanted| size_m > 1.001 * wanted);
            let notes = wanted.map(|wanted| enlarged(wanted, size_m, settings)).into_iter().collect();
            let readability = readability(&scaled, &made);
            return Ok(Placed { lights: made, size_m, closest_m, readability, notes });
        }
        let share = closest_m / settings.spacing_m;
        placement
            .enlarge(1.0 / share.max(1e-6), floor, settings, made.len(), closest_m)
            .map_err(|error| Refusal { error, share: Some(share) })?;
    }
    let what = "these robots do not find room in this picture; use fewer robots or a larger floor";
    Err(DrawError::new("too-many-robots", what).into())
}

fn enlarged(wanted: f64, size: f64, settings: &PlaceSettings) -> Note {
    let what = format!(
        "the picture is {size:.2} m wide instead of {wanted:.2} m, because {} robots stand at least {:.0} mm apart",
        settings.robots,
        settings.spacing_m * 1_000.0
    );
    Note::new("enlarged", what)
}

fn places_of(lights: &[PlacedLight]) -> Vec<Vec2> {
    lights.iter().map(|light| light.at).collect()
}
