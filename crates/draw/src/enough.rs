//! Finds the number of robots with which a drawing becomes readable.

use crate::drawing::Drawing;
use crate::fit::PictureFloor;
use crate::ground::Quality;
use crate::place::place;
use crate::readability::READABLE;
use crate::settings::PlaceSettings;

/// Largest number of robots that is tried. A drawing that is not readable with this number is too fine for robots.
const MOST: usize = 1_000;

/// Searches the least number of robots with which a drawing is readable. The number first grows in steps, by a quarter
/// each, until the drawing is readable; then every number within the last step is tried. `None` if no step up to a
/// thousand robots is readable. Number of robots, size, kept lights, start and quality in `settings` are not used.
pub fn enough_robots(drawing: &Drawing, settings: &PlaceSettings) -> Option<usize> {
    // A large floor, because room for the robots is not in question here.
    let floor = PictureFloor::new(1_000.0, 1_000.0, 0.0);
    let reads = |robots: usize| {
        let settings = PlaceSettings {
            robots,
            size_m: None,
            kept: Vec::new(),
            start: Vec::new(),
            quality: Quality::Quick,
            ..settings.clone()
        };
        place(drawing, &floor, &settings).is_ok_and(|placed| placed.readability.correlation >= READABLE)
    };
    let mut low = drawing.parts.len().max(1);
    let mut high = low;
    while !reads(high) {
        low = high + 1;
        high += (high / 4).max(1);
        if high > MOST {
            return None;
        }
    }
    (low..high).find(|robots| reads(*robots)).or(Some(high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Area, DrawingPart, FillRule};
    use lightbots_base::{Rgb, Vec2};

    #[test]
    fn a_bar_needs_a_handful_and_nothing_needs_no_robot() {
        let ring = [(0.0, 0.0), (0.2, 0.0), (0.2, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let area = Area { rings: vec![ring], rule: FillRule::NonZero, ink: Rgb::BLACK.into(), weight: 1.0 };
        let part = DrawingPart { areas: vec![area], letter: Some('I'), ..DrawingPart::default() };
        let bar = Drawing { parts: vec![part] };
        let enough = enough_robots(&bar, &PlaceSettings::default()).unwrap();
        assert!((3..=7).contains(&enough), "{enough}");
        assert_eq!(enough_robots(&Drawing::default(), &PlaceSettings::default()), None);
    }
}
