//! The floor on which the lights of a picture may stand.

use lightbots_base::Vec2;
use lightbots_draw::{NoGo, PictureFloor};
use lightbots_show::{Obstacle, Stage};

/// Smallest gap between a robot's rim in a picture and the edge of the floor or of a no-go area, metres. It leaves robots
/// room to turn and to pass.
const ROOM_M: f64 = 0.02;

/// Returns the part of a stage in which the centres of robots in a picture may be.
pub fn picture_floor(stage: &Stage) -> PictureFloor {
    let margin_m = stage.limits.radius_m + ROOM_M;
    let mut floor = PictureFloor::new(stage.width_m, stage.depth_m, margin_m);
    floor.no_go = stage.obstacles.iter().map(|obstacle| no_go(obstacle, margin_m)).collect();
    floor
}

fn no_go(obstacle: &Obstacle, margin_m: f64) -> NoGo {
    match *obstacle {
        Obstacle::Disc { at, radius_m } => NoGo::Disc { at, radius_m: radius_m + margin_m },
        Obstacle::Rect { min, max } => NoGo::Rect { min, max, margin_m },
    }
}

/// Returns the centre of a rectangle, stage metres, and the length of its longer side, metres. `min` and `max` are its
/// corners with the smaller and the larger x and y.
pub(crate) fn middle_and_side(min: Vec2, max: Vec2) -> (Vec2, f64) {
    (min.lerp(max, 0.5), (max.x - min.x).max(max.y - min.y))
}
