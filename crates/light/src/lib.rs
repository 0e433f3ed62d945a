//! Layers of light: (show time, robot, place, context) -> colour.
//!
//! The crate knows nothing of shows, messages or screens, and reads no clock and no file. It keeps no state between two
//! colours: everything random is a hash of (seed, robot or cell, moment). docs/light.md has the formula of each effect.
//! Reading order: [`Linear`], [`Palette`], [`Look`], [`LightEffect`], [`LightMask`], [`BlendMode`], [`LightLayer`],
//! [`Layers`], [`LampSettings`].
//!
//! ```
//! use lightbots_base::{Rgb, Vec2};
//! use lightbots_light::*;
//! let red = Look { palette: Palette::plain(Rgb::new(255, 0, 0)), ..Look::default() };
//! let layers = Layers::new(vec![LightLayer::new(LightEffect::Solid, red)]).expect("the layer is valid");
//! let robot = LitRobot { place: Vec2::ZERO, ..LitRobot::default() };
//! assert_eq!(layers.colour(2.0, &robot, &LightContext::default()).to_rgb(), Rgb::new(255, 0, 0));
//! ```

mod blend;
mod colour;
mod ease;
mod effect;
mod floor_picture;
mod lamp;
mod layer;
mod layers;
mod lit_robot;
mod look;
mod mask;
mod noise;
mod palette;
mod validate;

pub use blend::BlendMode;
pub use colour::{Linear, lightness};
pub use ease::{Ease, OpacityCurve, Wrap};
pub use effect::{Coordinate, LightEffect};
pub use floor_picture::{FloorPicture, PICTURE_PIXELS_MAX};
pub use lamp::LampSettings;
pub use layer::LightLayer;
pub use layers::Layers;
pub use lit_robot::{LightContext, LitRobot};
pub use look::Look;
pub use mask::{LightMask, MaskShape};
pub use palette::{Palette, PaletteStop};
pub use validate::*;
