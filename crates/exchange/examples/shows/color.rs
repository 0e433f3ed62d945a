//! Colours that glow on a dark floor.

use lightbots_base::Rgb;

pub const WHITE: Rgb = Rgb::new(255, 255, 255);
pub const RED: Rgb = Rgb::new(255, 45, 45);
pub const ROSE: Rgb = Rgb::new(255, 60, 140);
pub const ORANGE: Rgb = Rgb::new(255, 140, 20);
pub const GOLD: Rgb = Rgb::new(255, 205, 60);
pub const GREEN: Rgb = Rgb::new(40, 230, 110);
pub const CYAN: Rgb = Rgb::new(30, 220, 255);
pub const BLUE: Rgb = Rgb::new(50, 100, 255);
pub const VIOLET: Rgb = Rgb::new(160, 70, 255);
pub const DUSK: Rgb = Rgb::new(20, 36, 110);
pub const EMBER: Rgb = Rgb::new(110, 24, 8);

/// The colour at `share` (0 to 1) along evenly spaced stops.
pub fn gradient(stops: &[Rgb], share: f64) -> Rgb {
    let along = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let first = (along as usize).min(stops.len() - 2);
    stops[first].mixed(stops[first + 1], along - first as f64)
}

/// The colour on a circle of vivid colours. `share` is in turns, so that 0 and 1 give the same colour.
pub fn rainbow(share: f64) -> Rgb {
    gradient(&[RED, ORANGE, GOLD, GREEN, CYAN, BLUE, VIOLET, ROSE, RED], share - share.floor())
}
