//! Paints robots' lights, computed in linear light.

use lightbots_lighting::SeenRobot;
use lightbots_show::Stage;

use crate::camera::{Camera, FilmView, OnPicture};
use crate::tone;

/// Red, green and blue of a floor without robots' light, linear light. Just enough to make the floor visible.
const FLOOR: [f32; 3] = [0.0042, 0.0046, 0.0060];
/// Width of the strip inside the floor's edge over which [`FLOOR`] fades to black, metres.
const EDGE_M: f64 = 0.12;
/// Radius of a robot's light in radii of the robot, and its smallest radius in pixels for a picture 720 pixels high. The
/// smallest radius grows with the height of the picture.
const CORE: (f64, f64) = (0.62, 1.7);
/// Height of a robot's light above the floor, metres, as for an Elisa-3.
const LIGHT_M: f64 = 0.03;

/// A spot of light in the picture that fades towards its rim.
struct Spot {
    /// Radius of the spot, in radii of the robot's light, see [`CORE`]; for [`POOL`], in radii of the robot.
    radius: f64,
    /// Strength at the centre of the spot, as a share of the robot's light.
    strength: f32,
}

/// The light scattered in eyes and lenses.
const BLOOM: Spot = Spot { radius: 6.0, strength: 0.2 };
/// The light that falls on the floor, drawn with the floor's perspective. Its radius is in radii of the robot.
const POOL: Spot = Spot { radius: 6.5, strength: 0.055 };
/// The mirror image of the light in the floor, in views from the front.
const MIRRORED: Spot = Spot { radius: 2.2, strength: 0.22 };

/// Paints pictures of one stage from one view.
#[derive(Clone, Debug)]
pub struct Painter {
    width: usize,
    height: usize,
    view: FilmView,
    camera: Camera,
    radius_m: f64,
    /// Linear light of the pixels of a floor without robots, row by row from the top left.
    floor: Vec<[f32; 3]>,
    light: Vec<[f32; 3]>,
    bytes: Vec<u8>,
}

impl Painter {
    /// Prepares pictures of `width` by `height` pixels.
    pub fn new(view: FilmView, stage: &Stage, (width, height): (u32, u32)) -> Self {
        let camera = Camera::new(view, stage, (width, height));
        let half = (stage.width_m / 2.0, stage.depth_m / 2.0);
        let lit = |index: usize| {
            let (x, y) = (index % width as usize, index / width as usize);
            let Some(place) = camera.floor_at(x as f64 + 0.5, y as f64 + 0.5) else { return [0.0; 3] };
            let inside_m = (half.0 - place.x.abs()).min(half.1 - place.y.abs());
            let share = (inside_m / EDGE_M).clamp(0.0, 1.0) as f32;
            FLOOR.map(|channel| channel * share * share * (3.0 - 2.0 * share))
        };
        let floor: Vec<[f32; 3]> = (0..width as usize * height as usize).map(lit).collect();
        Self {
            width: width as usize,
            height: height as usize,
            view,
            camera,
            radius_m: stage.limits.radius_m,
            light: floor.clone(),
            bytes: vec![0; 3 * floor.len()],
            floor,
        }
    }

    /// Paints the robots of a scene. Returns red, green and blue of each pixel, sRGB codes, row by row from the top left.
    pub fn paint(&mut self, scene: &[SeenRobot]) -> &[u8] {
        self.light.copy_from_slice(&self.floor);
        for robot in scene {
            let colour = tone::light(robot.colour);
            if colour != [0.0; 3] {
                self.robot(robot, colour);
            }
        }
        let codes = tone::codes();
        for (bytes, light) in self.bytes.chunks_exact_mut(3).zip(&self.light) {
            bytes.copy_from_slice(&tone::bytes(codes, *light));
        }
        &self.bytes
    }

    fn robot(&mut self, robot: &SeenRobot, colour: [f32; 3]) {
        let floor = self.camera.project(robot.place, 0.0);
        let lamp = self.camera.project(robot.place, LIGHT_M);
        let least = CORE.1 * self.height as f64 / 720.0;
        let core = (CORE.0 * self.radius_m * lamp.per_m).max(least);
        let pool = (POOL.radius * self.radius_m * floor.per_m).max(least);
        self.spot(&floor, (pool, pool * floor.flatness), POOL.strength, colour);
        if self.view == FilmView::Front {
            let mirrored = self.camera.project(robot.place, -LIGHT_M);
            let radius = MIRRORED.radius * core;
            self.spot(&mirrored, (radius, 1.6 * radius), MIRRORED.strength, colour);
        }
        self.spot(&lamp, (BLOOM.radius * core, BLOOM.radius * core), BLOOM.strength, colour);
        self.disc(&lamp, core, colour);
    }

    /// Adds an ellipse of light that fades towards its rim. `across` and `down` are half of its width and height, pixels.
    fn spot(&mut self, at: &OnPicture, (across, down): (f64, f64), strength: f32, colour: [f32; 3]) {
        let (rows, columns) = (rows(at.y, down, self.height), rows(at.x, across, self.width));
        let scale = (1.0 / across, 1.0 / down);
        for row in rows {
            let y = (row as f64 + 0.5 - at.y) * scale.1;
            for column in columns.clone() {
                let x = (column as f64 + 0.5 - at.x) * scale.0;
                let inside = (1.0 - x * x - y * y) as f32;
                if inside > 0.0 {
                    self.add(row * self.width + column, strength * inside * inside * inside, colour);
                }
            }
        }
    }

    /// Adds a disc of light. A pixel at its rim gets the share of light that corresponds to its covered area.
    fn disc(&mut self, at: &OnPicture, radius: f64, colour: [f32; 3]) {
        for row in rows(at.y, radius + 0.5, self.height) {
            let y = row as f64 + 0.5 - at.y;
            for column in rows(at.x, radius + 0.5, self.width) {
                let x = column as f64 + 0.5 - at.x;
                let covered = (radius + 0.5 - (x * x + y * y).sqrt()).clamp(0.0, 1.0);
                if covered > 0.0 {
                    self.add(row * self.width + column, covered as f32, colour);
                }
            }
        }
    }

    fn add(&mut self, index: usize, share: f32, colour: [f32; 3]) {
        for (channel, more) in self.light[index].iter_mut().zip(colour) {
            *channel += share * more;
        }
    }
}

/// Returns the indices of the rows, or columns, of pixels that are within `reach` of the position `at`, both in pixels.
/// `count` is the number of all rows or columns.
fn rows(at: f64, reach: f64, count: usize) -> std::ops::Range<usize> {
    let first = (at - reach).floor().max(0.0) as usize;
    let end = (at + reach).ceil().max(0.0) as usize;
    first.min(count)..end.min(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::{Rgb, Vec2};

    fn robot(x: f64, y: f64, colour: Rgb) -> SeenRobot {
        SeenRobot { place: Vec2::new(x, y), colour }
    }

    fn pixel(bytes: &[u8], at: &OnPicture, width: usize) -> [u8; 3] {
        let index = 3 * (at.y as usize * width + at.x as usize);
        [bytes[index], bytes[index + 1], bytes[index + 2]]
    }

    #[test]
    fn a_robot_has_its_own_colour_and_lights_the_floor_around_it() {
        let stage = Stage::default();
        for view in [FilmView::Above, FilmView::Front] {
            let mut painter = Painter::new(view, &stage, (640, 360));
            let orange = Rgb::new(255, 136, 0);
            let at = painter.camera.project(Vec2::new(0.5, -0.4), LIGHT_M);
            let bytes = painter.paint(&[robot(0.5, -0.4, orange)]).to_vec();
            let shown = pixel(&bytes, &at, 640);
            // Bloom and pool add to the light.
            let off = |a: u8, b: u8| a.abs_diff(b);
            assert!(shown[0] == 255 && off(shown[1], 136) < 12 && shown[2] < 60, "{view:?} {shown:?}");
            let beside = pixel(&bytes, &OnPicture { x: at.x + 4.0, ..at }, 640);
            assert!(beside[0] > beside[1] && beside[1] > 8, "{beside:?}");
        }
    }

    #[test]
    fn a_dark_robot_is_not_seen_and_the_same_robots_give_the_same_bytes() {
        let mut painter = Painter::new(FilmView::Front, &Stage::default(), (320, 180));
        let dark = painter.paint(&[]).to_vec();
        assert_eq!(painter.paint(&[robot(0.0, 0.0, Rgb::BLACK)]), dark);
        assert!(dark.iter().any(|byte| *byte > 8), "the floor is seen");
        let lit = painter.paint(&[robot(0.0, 0.0, Rgb::new(0, 200, 9))]).to_vec();
        painter.paint(&[robot(1.0, 0.0, Rgb::new(255, 255, 255))]);
        assert_eq!(painter.paint(&[robot(0.0, 0.0, Rgb::new(0, 200, 9))]), lit);
    }

    #[test]
    fn robots_outside_the_picture_and_places_without_sense_do_nothing() {
        let mut painter = Painter::new(FilmView::Front, &Stage::default(), (64, 36));
        let white = Rgb::new(255, 255, 255);
        let dark = painter.paint(&[]).to_vec();
        for place in [(1e9, 0.0), (0.0, -1e9), (f64::NAN, 0.0)] {
            assert_eq!(painter.paint(&[robot(place.0, place.1, white)]), dark, "{place:?}");
        }
    }
}
