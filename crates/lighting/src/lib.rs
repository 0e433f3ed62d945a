//! Light of a show: its layers, when each shines, and a robot's colours as a light track.
//!
//! `lightbots_light` computes colours of layers and knows no show. Here layers are read from a show, placed on its
//! timeline and turned into the records that robots play. No IO, and no state between two calls. Reading order:
//! [`ShowLight`], [`FrameTimes`], [`DrivenLight`], [`fit`](fit()), [`flashes`](flashes()), [`validate`],
//! [`attach_pictures`].

mod driven;
mod fit;
mod flashes;
mod issues;
mod layer_settings;
mod live;
mod masks;
mod pictures;
mod planned;
mod planned_show;
mod settings;
mod show_light;
mod times;

pub use driven::{DrivenLight, LightMoment, changed, fade_of};
pub use fit::{LightFit, Tolerance, fit, is_seen_apart};
pub use flashes::{FlashWarning, LitFrame, flashes};
pub use issues::{flash_issue, flashes_of, validate};
pub use lightbots_light::LampSettings;
pub use live::LiveLayers;
pub use pictures::{LAYER_PICTURES_MAX, attach_pictures, floor_picture};
pub use planned::{PlannedDrive, lit_frame, numbers, numbers_of, planned};
pub use planned_show::{PlannedScenes, PlannedShow, SeenRobot};
pub use settings::LAYER_KINDS;
pub use show_light::{FrameLight, ShowLight};
pub use times::FrameTimes;
