//! Shows a picture with fewer or more lights. Nothing is known of the picture but the places and colours of its lights.

use lightbots_base::Vec2;
use lightbots_base::shape::point_to_segment;

use crate::buckets::{Buckets, closest_distance, nearest_distances};
use crate::coverage::Sample;
use crate::error::DrawError;
use crate::fit::PictureFloor;
use crate::geometry::{bounds, hexagonal_count, hexagonal_spacing};
use crate::relax::Lloyd;
use crate::seeds::{eliminate, seeds};
use crate::settings::{MAX_ROBOTS, PlacedLight};

/// Number of rounds of relaxation. More rounds move lights farther and hardly make the picture more even (measured).
const ROUNDS: usize = 20;

/// Two lights that are at most this far apart are joined by a line of the picture. Unit: typical distances between
/// lights.
const JOINED: f64 = 1.45;

/// Half the width of the lines that join lights, in typical distances, tried in this order. At the first width, twice
/// as many lights still form a single row. Wider lines hold several rows, for lights that a single row has no room for.
const HALF_WIDTHS: [f64; 8] = [0.22, 0.5, 0.9, 1.4, 2.1, 3.2, 4.8, 7.0];

/// Share of the robots of an ideal filling that fit. After relaxation the closest pair is 0.7 ideal spacings apart
/// (Lloyd without pushing apart, measured).
const RELAXED: f64 = 0.5;

/// Largest number of robots, as a multiple of an ideal filling of the lines. If there are more robots and new lights
/// are needed, lines of this width are not tried. The multiple is above 1 because the picture may grow.
const SPARE: f64 = 1.5;

/// Number of samples along a typical distance.
const FINENESS: f64 = 9.0;

/// A light of the picture after the change of the number of lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RefitLight {
    /// The light.
    pub light: PlacedLight,
    /// Index that the light had before the change; `None` for a new light.
    pub from: Option<usize>,
}

/// Returns the picture of `lights` with `robots` lights at least `spacing_m` metres apart. Lights with `pinned` true
/// are removed last, and move only if the whole picture is scaled or shifted. If `pinned` is shorter than `lights`, the
/// others are not pinned. Each light that stays keeps its colour. A new light takes the colour of the nearest old
/// light.
///
/// # Errors
/// No lights to begin with, no robots or more than [`MAX_ROBOTS`], or more lights than fit on the floor.
pub fn refit(
    lights: &[PlacedLight],
    pinned: &[bool],
    robots: usize,
    spacing_m: f64,
    floor: &PictureFloor,
) -> Result<Vec<RefitLight>, DrawError> {
    if lights.is_empty() {
        return Err(DrawError::new(
            "nothing-to-draw",
            "a frame without pixels cannot be fitted to a fleet; add a pixel",
        ));
    }
    if robots == 0 || robots > MAX_ROBOTS {
        let what = format!("{robots} robots; a picture takes 1 to {MAX_ROBOTS}");
        return Err(DrawError::new("bad-setting", what));
    }
    let task = Refit::new(lights, pinned, robots, spacing_m, floor);
    // If the number of lights does not change, there is no relaxation, and the width does not matter.
    let widths = if robots == lights.len() { &HALF_WIDTHS[..1] } else { &HALF_WIDTHS };
    let mut refusal = None;
    for half_width in widths {
        match task.with_lines(*half_width) {
            Ok(refitted) => return Ok(refitted),
            Err(error) => refusal = Some(error),
        }
    }
    Err(refusal.unwrap_or_else(|| no_room(robots, spacing_m, 0.0)))
}

/// The task of [`refit`], and values that do not depend on the width of the lines.
struct Refit<'a> {
    lights: &'a [PlacedLight],
    places: Vec<Vec2>,
    /// Typical distance: the median of the lights' distances to their nearest neighbours, metres.
    typical: f64,
    /// Indices of the lights that stay, those of the pinned lights first.
    staying: Vec<usize>,
    /// Number of pinned lights among `staying`.
    kept: usize,
    robots: usize,
    spacing_m: f64,
    floor: &'a PictureFloor,
}

impl<'a> Refit<'a> {
    fn new(
        lights: &'a [PlacedLight],
        pinned: &[bool],
        robots: usize,
        spacing_m: f64,
        floor: &'a PictureFloor,
    ) -> Self {
        let places: Vec<Vec2> = lights.iter().map(|light| light.at).collect();
        let is_pinned = |index: usize| pinned.get(index).copied().unwrap_or(false);
        let mut order: Vec<usize> = (0..lights.len()).collect();
        order.sort_by_key(|index| !is_pinned(*index));
        let staying = staying(&places, &order, robots, is_pinned);
        let kept = staying.iter().filter(|index| is_pinned(**index)).count();
        Self { lights, typical: typical_distance(&places), places, staying, kept, robots, spacing_m, floor }
    }

    /// Makes the picture with lines of this half width, in typical distances between lights.
    fn with_lines(&self, half_width: f64) -> Result<Vec<RefitLight>, DrawError> {
        let Self { lights, places, typical, staying, kept, robots, spacing_m, floor } = self;
        let samples: Vec<Sample> = samples(places, *typical, half_width)
            .into_iter()
            .filter(|sample| floor.allows(sample.at))
            .collect();
        let mut now: Vec<Vec2> = staying.iter().map(|index| places[*index]).collect();
        let mass: f64 = samples.iter().map(|sample| sample.mass).sum();
        let spacing = hexagonal_spacing(mass, *robots);
        // An estimate, because a trial takes seconds for thousands of robots.
        let rows = mass / (2.0 * half_width * typical * spacing_m);
        let fitting = hexagonal_count(mass, *spacing_m).max(rows);
        if *robots > staying.len() && *robots as f64 > SPARE * fitting {
            return Err(no_room(*robots, *spacing_m, RELAXED * fitting));
        }
        now.extend(seeds(&samples, &now, robots - staying.len(), spacing, 1));
        if *robots != places.len() {
            Lloyd { samples: &samples, kept: *kept, spacing, rounds: ROUNDS, pairing: None }.run(&mut now);
        }
        spread(&mut now, *spacing_m, floor)?;
        let nearest = Buckets::new(places, typical.max(1e-6));
        let refitted = now.iter().enumerate().map(|(index, at)| {
            let from = staying.get(index).copied();
            let source = from.or(nearest.nearest(*at).map(|(near, _)| near)).unwrap_or(0);
            RefitLight { light: PlacedLight { at: *at, ..lights[source] }, from }
        });
        Ok(refitted.collect())
    }
}

/// Returns the indices of at most `robots` lights that stay, those of the pinned lights first. Of the others, the most
/// crowded are removed. `order`: all indices, those of the pinned lights first.
fn staying(places: &[Vec2], order: &[usize], robots: usize, is_pinned: impl Fn(usize) -> bool) -> Vec<usize> {
    if robots >= places.len() {
        return order.to_vec();
    }
    let sorted: Vec<Vec2> = order.iter().map(|index| places[*index]).collect();
    let pins = order.iter().filter(|index| is_pinned(**index)).count().min(robots);
    let spacing = typical_distance(places) * (places.len() as f64 / robots as f64).sqrt();
    let mut staying = order[..pins].to_vec();
    staying.extend(eliminate(&sorted, pins, robots - pins, spacing).into_iter().map(|index| order[index]));
    staying
}

/// Returns the median of the places' distances to their nearest neighbours, metres, but at least 1 mm; 0.3 m for a
/// single place.
fn typical_distance(places: &[Vec2]) -> f64 {
    let mut distances = nearest_distances(places, 0.1);
    distances.retain(|distance| distance.is_finite());
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 2).copied().unwrap_or(0.3).max(1e-3)
}

/// Samples the picture that lights make: lines between neighbouring lights. Where lights fill an area, these lines
/// merge into the area.
fn samples(places: &[Vec2], typical: f64, half_width: f64) -> Vec<Sample> {
    let mut lines: Vec<(Vec2, Vec2)> = places.iter().map(|at| (*at, *at)).collect();
    Buckets::new(places, typical).pairs(JOINED * typical, |a, b, _| lines.push((places[a], places[b])));
    let pitch = typical / FINENESS;
    let half = half_width * typical;
    let mut cells: std::collections::BTreeSet<(i64, i64)> = std::collections::BTreeSet::new();
    for (a, b) in lines {
        let cell = |value: f64| (value / pitch).floor() as i64;
        for x in cell(a.x.min(b.x) - half)..=cell(a.x.max(b.x) + half) {
            for y in cell(a.y.min(b.y) - half)..=cell(a.y.max(b.y) + half) {
                if point_to_segment(center(x, y, pitch), a, b) <= half {
                    cells.insert((x, y));
                }
            }
        }
    }
    cells.into_iter().map(|(x, y)| Sample { at: center(x, y, pitch), mass: pitch * pitch }).collect()
}

fn center(x: i64, y: i64, pitch: f64) -> Vec2 {
    Vec2::new((x as f64 + 0.5) * pitch, (y as f64 + 0.5) * pitch)
}

/// Returns the shortest shift that brings the box from `low` to `high` onto the floor, if the box fits there.
fn onto_floor(low: Vec2, high: Vec2, floor: &PictureFloor) -> Vec2 {
    let shift = |low: f64, high: f64, min: f64, max: f64| (min - low).max(0.0) - (high - max).max(0.0);
    Vec2::new(shift(low.x, high.x, floor.min.x, floor.max.x), shift(low.y, high.y, floor.min.y, floor.max.y))
}

/// If the closest pair is closer than `spacing_m`, scales places about their centroid until it is `spacing_m` apart,
/// and shifts them back onto the floor.
///
/// # Errors
/// The floor does not allow all scaled places.
fn spread(places: &mut [Vec2], spacing_m: f64, floor: &PictureFloor) -> Result<(), DrawError> {
    let closest = closest_distance(places);
    if closest >= spacing_m {
        return Ok(());
    }
    let middle = places.iter().fold(Vec2::ZERO, |sum, at| sum + *at) * (1.0 / places.len() as f64);
    let factor = spacing_m / closest * 1.001;
    let mut wider: Vec<Vec2> = places.iter().map(|at| middle + (*at - middle) * factor).collect();
    if let Some((low, high)) = bounds(&wider) {
        let shift = onto_floor(low, high, floor);
        wider.iter_mut().for_each(|at| *at += shift);
    }
    if !wider.iter().all(|at| floor.allows(*at)) {
        return Err(no_room(places.len(), spacing_m, places.len() as f64 / (factor * factor)));
    }
    places.copy_from_slice(&wider);
    Ok(())
}

fn no_room(robots: usize, spacing_m: f64, fitting: f64) -> DrawError {
    let what = format!(
        "{robots} robots at least {:.0} mm apart do not find room in this picture; about {} do, or a larger floor",
        spacing_m * 1_000.0,
        fitting.floor().max(1.0)
    );
    DrawError::new("too-many-robots", what)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn row(count: usize) -> Vec<PlacedLight> {
        let light = |index| PlacedLight {
            at: Vec2::new(index as f64 * 0.3 - 1.5, 0.0),
            color: Rgb::new(index as u8, 0, 0),
            part: 0,
        };
        (0..count).map(light).collect()
    }

    fn lattice() -> Vec<PlacedLight> {
        let light = |index: i32| PlacedLight {
            at: Vec2::new(f64::from(index % 10) * 0.2 - 0.9, f64::from(index / 10) * 0.2 - 0.9),
            color: Rgb::BLACK,
            part: 0,
        };
        (0..100).map(light).collect()
    }

    fn floor() -> PictureFloor {
        PictureFloor::new(4.0, 4.0, 0.1)
    }

    #[test]
    fn a_row_stays_a_row_with_twice_and_with_half_the_lights() {
        for robots in [5, 8, 11, 15, 21] {
            let lights = refit(&row(11), &[], robots, 0.08, &floor()).unwrap();
            assert_eq!(lights.len(), robots);
            assert!(lights.iter().all(|light| light.light.at.y.abs() < 0.03), "{robots}: {lights:?}");
        }
    }

    #[test]
    fn a_row_without_room_becomes_several_rows() {
        let light = |index: i32| PlacedLight {
            at: Vec2::new(f64::from(index) * 0.13 - 1.885, -1.9),
            color: Rgb::BLACK,
            part: 0,
        };
        let full: Vec<PlacedLight> = (0..30).map(light).collect();
        for robots in [45, 60, 100, 150] {
            let places: Vec<Vec2> = refit(&full, &[], robots, 0.08, &floor())
                .unwrap()
                .iter()
                .map(|light| light.light.at)
                .collect();
            assert_eq!(places.len(), robots);
            assert!(places.iter().all(|at| floor().allows(*at) && at.y < -1.0), "{robots}: {places:?}");
            assert!(closest_distance(&places) >= 0.08);
        }
    }

    #[test]
    fn lights_that_stay_keep_their_colour_and_move_little() {
        let before = lattice();
        let after = refit(&before, &[], 90, 0.08, &floor()).unwrap();
        let mut seen = std::collections::BTreeSet::new();
        for light in after {
            let from = light.from.unwrap();
            assert!(seen.insert(from));
            assert_eq!(light.light.color, before[from].color);
            assert!(light.light.at.distance(before[from].at) < 0.2);
        }
    }

    #[test]
    fn new_lights_fill_the_area_at_its_spacing() {
        let after = refit(&lattice(), &[], 200, 0.08, &floor()).unwrap();
        assert_eq!(after.len(), 200);
        assert_eq!(after.iter().filter(|light| light.from.is_none()).count(), 100);
        let places: Vec<Vec2> = after.iter().map(|light| light.light.at).collect();
        let closest = nearest_distances(&places, 0.1).into_iter().fold(f64::MAX, f64::min);
        assert!(closest >= 0.08, "{closest}");
    }

    #[test]
    fn pinned_lights_stay_longest_and_where_they_are() {
        let before = lattice();
        let mut pinned = vec![false; 100];
        pinned[37] = true;
        pinned[99] = true;
        for robots in [2, 30, 99, 150] {
            let after = refit(&before, &pinned, robots, 0.08, &floor()).unwrap();
            for index in [37, 99] {
                assert!(
                    after.iter().any(|l| l.from == Some(index) && l.light.at == before[index].at),
                    "{robots}"
                );
            }
        }
    }

    #[test]
    fn the_same_number_changes_nothing_and_too_many_are_refused() {
        let before = lattice();
        let after = refit(&before, &[], 100, 0.08, &floor()).unwrap();
        assert!(after.iter().zip(&before).all(|(after, before)| after.light == *before));
        assert_eq!(refit(&before, &[], 9_000, 0.08, &floor()).unwrap_err().code, "too-many-robots");
        assert_eq!(refit(&[], &[], 9, 0.08, &floor()).unwrap_err().code, "nothing-to-draw");
    }
}
