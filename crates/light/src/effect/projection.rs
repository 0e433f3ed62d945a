//! Pictures on the floor.

use crate::colour::Linear;
use crate::ease::fraction;
use crate::floor_picture::FloorPicture;
use crate::look::Look;
use crate::palette::Shade;
use lightbots_base::Vec2;

/// How long before the start of a row a moment already counts as in that row, as a share of the time between two rows.
/// Needed because moments are inexact sums of seconds.
const EARLY_ROWS: f64 = 1e-6;

/// Returns the light of a picture at a place of the floor. The picture's centre is at the effect's place, and the picture
/// is `size_m` wide. Its right side lies in the effect's direction. A film lasts one cycle; `turns`: cycles since the
/// effect began. Outside of the picture, opacity is 0.
pub(super) fn picture(look: &Look, turns: f64, place: Vec2, film: Option<&FloorPicture>) -> Shade {
    let Some(film) = film else { return (Linear::BLACK, 0.0) };
    let right = Vec2::unit(look.angle);
    let from_centre = place - look.place;
    let across = 0.5 + right.dot(from_centre) / look.size_m;
    let down = 0.5 - right.cross(from_centre) / (look.size_m * film.aspect());
    if !(0.0..=1.0).contains(&across) || !(0.0..=1.0).contains(&down) {
        return (Linear::BLACK, 0.0);
    }
    let frame = (fraction(turns) * film.frames() as f64) as usize;
    (film.at(frame, across, down), 1.0)
}

/// Returns the light of a robot in a sequence. `rows` is the time since the start of the first row, in units of the time
/// between two rows. Opacity is 0 before the first row, after the last one, and for robots without a column.
pub(super) fn sequence(rows: f64, robot: u32, colours: Option<&FloorPicture>) -> Shade {
    let row = libm::floor(rows + EARLY_ROWS);
    if row.is_nan() || row < 0.0 {
        return (Linear::BLACK, 0.0);
    }
    let colour = colours.and_then(|colours| colours.pixel(robot as usize, row as usize));
    colour.map_or((Linear::BLACK, 0.0), |colour| (colour, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    #[test]
    fn each_robot_shows_its_pixel_of_the_row() {
        let codes = [10, 20, 30, 40].map(|code| Rgb::new(code, 0, 0)).to_vec();
        let colours = FloorPicture::new(2, 2, codes).expect("it is whole");
        let shown = |rows: f64, robot: u32| {
            let (light, opacity) = sequence(rows, robot, Some(&colours));
            (opacity > 0.0).then(|| light.to_rgb().r)
        };
        assert_eq!(
            [shown(0.0, 0), shown(0.9, 1), shown(1.0 - 1e-9, 0), shown(1.5, 1)],
            [10, 20, 30, 40].map(Some)
        );
        assert_eq!([shown(-0.5, 0), shown(2.0, 0), shown(0.0, 2), shown(f64::NAN, 0)], [None; 4]);
        assert_eq!(sequence(0.0, 0, None).1, 0.0);
    }
}
