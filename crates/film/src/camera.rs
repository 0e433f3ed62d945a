//! Projects places of the stage into a picture.

use lightbots_base::Vec2;
use lightbots_show::Stage;

/// Where the audience looks from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FilmView {
    /// From above: the picture shows the floor without perspective.
    #[default]
    Above,
    /// From seats before the front edge.
    Front,
}

/// Projects a stage into a picture of a given size: a pinhole camera. The camera above the floor is infinitely far away,
/// so that its picture has no perspective.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Where the camera's axis meets the picture, pixels from the left and from the top.
    shift: (f64, f64),
    /// Number of pixels per unit of the camera's plane, which is 1 m from the eye; from above, it is the floor in metres.
    scale: f64,
    /// Place and direction of the camera in the view from the front; `None` in the view from above.
    eye: Option<Eye>,
}

/// Position and direction of a camera, stage metres with z up. It is above the y axis and looks along y and down.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Eye {
    y_m: f64,
    z_m: f64,
    /// Components along y and z of the viewing direction, which is a unit vector.
    along_y: f64,
    along_z: f64,
}

/// A place in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnPicture {
    /// Distance from the left edge, pixels.
    pub x: f64,
    /// Distance from the top edge, pixels.
    pub y: f64,
    /// Number of pixels per metre to the left and right of the place.
    pub per_m: f64,
    /// Number of pixels per metre of floor towards the audience, divided by `per_m`. About 1 from above, less from the
    /// front.
    pub flatness: f64,
}

/// Share that the floor fills of the picture's width or height, whichever limits it.
const FILLED: f64 = 0.94;
/// Distance of the seats from the front edge, and height of the seats, as shares of the floor's larger side. Chosen by
/// us. The far edge of a square floor then looks about 0.58 times as wide as its front edge.
const SEATS: (f64, f64) = (1.0, 0.75);

impl Camera {
    /// Fits the whole floor of a stage into a picture of `width` by `height` pixels.
    pub fn new(view: FilmView, stage: &Stage, (width, height): (u32, u32)) -> Self {
        let larger_m = stage.width_m.max(stage.depth_m);
        let eye = (view == FilmView::Front).then(|| {
            let (y_m, z_m) = (-stage.depth_m / 2.0 - SEATS.0 * larger_m, SEATS.1 * larger_m);
            let length_m = y_m.hypot(z_m);
            Eye { y_m, z_m, along_y: -y_m / length_m, along_z: -z_m / length_m }
        });
        let unit = Self { shift: (0.0, 0.0), scale: 1.0, eye };
        let (x_m, y_m) = (stage.width_m / 2.0, stage.depth_m / 2.0);
        let corners = [(-x_m, -y_m), (x_m, -y_m), (-x_m, y_m), (x_m, y_m)];
        let corners = corners.map(|(x, y)| unit.plane(Vec2::new(x, y), 0.0));
        let range = |of: fn(&(f64, f64, f64)) -> f64| {
            let values = corners.iter().map(of);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        let ((left, right), (top, bottom)) = (range(|corner| corner.0), range(|corner| corner.1));
        let (width, height) = (f64::from(width), f64::from(height));
        let scale = (FILLED * width / (right - left)).min(FILLED * height / (bottom - top));
        let shift = ((width - scale * (left + right)) / 2.0, (height - scale * (top + bottom)) / 2.0);
        Self { shift, scale, eye }
    }

    /// Projects a point into the picture: `place` on the stage, `height_m` metres above the floor.
    pub fn project(&self, place: Vec2, height_m: f64) -> OnPicture {
        let (x, y, distance) = self.plane(place, height_m);
        let nearer = self.plane(place - Vec2::new(0.0, 0.01), height_m).1;
        let per_m = self.scale / distance;
        OnPicture {
            x: self.shift.0 + self.scale * x,
            y: self.shift.1 + self.scale * y,
            per_m,
            flatness: ((nearer - y) * self.scale / 0.01 / per_m).max(0.01),
        }
    }

    /// Returns the place of the floor that a point of the picture shows: `x` and `y` are pixels from the left and from
    /// the top. `None` for a point on or above the horizon.
    pub fn floor_at(&self, x: f64, y: f64) -> Option<Vec2> {
        let (x, y) = ((x - self.shift.0) / self.scale, (y - self.shift.1) / self.scale);
        let Some(eye) = self.eye else { return Some(Vec2::new(x, -y)) };
        // The ray through the point: forwards, plus x to the right, minus y upwards.
        let down = eye.along_z - y * eye.along_y;
        if down >= -1e-6 {
            return None;
        }
        let length = -eye.z_m / down;
        Some(Vec2::new(x * length, eye.y_m + length * (eye.along_y + y * eye.along_z)))
    }

    /// Projects a point to the camera's plane. Returns x to the right and y downwards on the plane, and the distance of the
    /// point along the viewing direction, metres. From above, x and y are in metres, and the distance is 1.
    fn plane(&self, place: Vec2, height_m: f64) -> (f64, f64, f64) {
        let Some(eye) = self.eye else { return (place.x, -place.y, 1.0) };
        let (y_m, z_m) = (place.y - eye.y_m, height_m - eye.z_m);
        let distance_m = (y_m * eye.along_y + z_m * eye.along_z).max(0.01);
        let up_m = z_m * eye.along_y - y_m * eye.along_z;
        (place.x / distance_m, -up_m / distance_m, distance_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(width_m: f64, depth_m: f64) -> Stage {
        Stage { width_m, depth_m, ..Stage::default() }
    }

    #[test]
    fn the_whole_floor_is_in_the_picture_and_fills_it_in_one_direction() {
        for (width_m, depth_m) in [(3.0, 3.0), (12.0, 4.0), (4.0, 12.0)] {
            for view in [FilmView::Above, FilmView::Front] {
                let camera = Camera::new(view, &stage(width_m, depth_m), (1280, 720));
                let corner =
                    |x: f64, y: f64| camera.project(Vec2::new(x * width_m / 2.0, y * depth_m / 2.0), 0.0);
                let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(x, y)| corner(x, y));
                assert!(
                    corners.iter().all(|at| (0.0..=1280.0).contains(&at.x) && (0.0..=720.0).contains(&at.y))
                );
                let across = corners[1].x - corners[0].x;
                let down = corners[0].y - corners[2].y;
                assert!((across / 1280.0).max(down / 720.0) > 0.93, "{view:?} {across} {down}");
                assert!(corners[0].y > corners[2].y, "the front edge is below");
            }
        }
    }

    #[test]
    fn what_is_further_away_is_smaller_and_flat() {
        let camera = Camera::new(FilmView::Front, &stage(3.0, 3.0), (1280, 720));
        let [near, far] = [-1.5, 1.5].map(|y| camera.project(Vec2::new(0.0, y), 0.0));
        assert!(far.per_m < 0.75 * near.per_m && far.flatness < near.flatness && near.flatness < 0.8);
        let above = Camera::new(FilmView::Above, &stage(3.0, 3.0), (1280, 720));
        let at = above.project(Vec2::new(1.0, 1.0), 0.3);
        assert!((at.flatness - 1.0).abs() < 1e-9 && (at.per_m - 0.94 * 240.0).abs() < 1e-9);
    }

    #[test]
    fn a_point_of_the_picture_leads_back_to_the_floor() {
        for view in [FilmView::Above, FilmView::Front] {
            let camera = Camera::new(view, &stage(4.0, 3.0), (640, 360));
            let place = Vec2::new(1.2, -0.7);
            let at = camera.project(place, 0.0);
            assert!(
                camera.floor_at(at.x, at.y).is_some_and(|found| found.distance(place) < 1e-9),
                "{view:?}"
            );
        }
        let front = Camera::new(FilmView::Front, &stage(4.0, 3.0), (640, 360));
        assert_eq!(front.floor_at(320.0, -9_999.0), None);
    }
}
