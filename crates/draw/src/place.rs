//! From a drawing and a number of robots to lights on the floor.

use lightbots_base::Vec2;

use crate::allot::{Share, allot};
use crate::buckets::nearest_distances;
use crate::colour::Paint;
use crate::drawing::Drawing;
use crate::error::{DrawError, Note};
use crate::fit::{PictureFloor, Placement};
use crate::ground::Ground;
use crate::layout::{Layout, LayoutTask};
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

/// Lights on a drawing that is in stage metres already.
fn arrange(
    drawing: &Drawing,
    floor: &PictureFloor,
    settings: &PlaceSettings,
) -> Result<Vec<PlacedLight>, DrawError> {
    let allowed = |at: Vec2| floor.allows(at);
    let each = settings.robots / drawing.groups.len().max(1) + 1;
    let grounds: Vec<Ground> =
        drawing.groups.iter().map(|group| Ground::new(group, each, settings.quality, &allowed)).collect();
    let kept = kept_by_group(&grounds, settings);
    let shares: Vec<Share> =
        grounds.iter().zip(&kept).map(|(ground, kept)| Share::new(ground, settings, kept.len())).collect();
    let counts = allot(&shares, settings.robots);
    if counts.iter().sum::<usize>() != settings.robots {
        return Err(DrawError::new(
            "no-room",
            "nothing of the picture is on the floor and outside of no-go areas; move it",
        ));
    }
    let mut lights = settings.kept.clone();
    for (index, ground) in grounds.iter().enumerate() {
        let paint = Paint::new(&drawing.groups[index]);
        let layout = layout_of(ground, &kept[index], counts[index], settings);
        let free = layout.places.into_iter().skip(kept[index].len());
        lights.extend(free.map(|at| PlacedLight { at, color: paint.at(at), group: index }));
    }
    Ok(lights)
}

/// Kept places, by the group that each is nearest to.
fn kept_by_group(grounds: &[Ground], settings: &PlaceSettings) -> Vec<Vec<Vec2>> {
    let mut kept = vec![Vec::new(); grounds.len()];
    for light in &settings.kept {
        let distance = |ground: &Ground| {
            let points = if ground.inside.is_empty() { ground.lines.points() } else { &ground.inside };
            points.iter().map(|point| point.distance(light.at)).fold(f64::INFINITY, f64::min)
        };
        let nearest =
            (0..grounds.len()).min_by(|a, b| distance(&grounds[*a]).total_cmp(&distance(&grounds[*b])));
        if let Some(index) = nearest {
            kept[index].push(light.at);
        }
    }
    kept
}

fn layout_of(ground: &Ground, kept: &[Vec2], count: usize, settings: &PlaceSettings) -> Layout {
    let task = LayoutTask {
        ground,
        kept,
        count,
        start: &settings.start,
        quality: settings.quality,
        seed: settings.seed,
    };
    task.layout(settings.style)
}
