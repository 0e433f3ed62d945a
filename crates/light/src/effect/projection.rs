//! Pictures on the floor.

use crate::colour::Linear;
use crate::ease::fraction;
use crate::floor_picture::FloorPicture;
use crate::look::Look;
use crate::palette::Shade;
use lightbots_base::Vec2;

/// The picture with its centre at the place, `size_m` wide, its right along the direction; a film lasts one turn. Outside
/// of the picture nothing shines.
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
