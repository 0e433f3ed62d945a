//! A frame that waits for its robots, and what its source is made of.

use std::path::Path;
use std::sync::Arc;

use lightbots_draw::{DrawError, Drawing};
use lightbots_exchange::asset_of;
use lightbots_make::{Content, Material, Placing, Recipe, material};
use lightbots_show::{Asset, AssetHash, Frame, Stage};

use crate::cli::MakeArguments;

/// A frame that waits for its robots.
pub struct Wanted {
    /// Name, times and source.
    pub frame: Frame,
    /// What the source gives.
    pub material: Material,
    /// The source's file.
    pub asset: Option<(AssetHash, Asset)>,
    /// Whether it is a moment of the film whose moment before is the frame before.
    pub start: bool,
}

impl Wanted {
    /// Its drawing, if it has one.
    pub fn drawing(&self) -> Option<Drawing> {
        match &self.material {
            Material::Drawing { made, .. } => Some(made.drawing.clone()),
            Material::Lights(_) => None,
        }
    }
}

/// A file as an asset of the show, by its hash.
pub fn asset(path: &Path, bytes: &[u8], media_type: &str) -> (AssetHash, Asset) {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    asset_of(&name, media_type, Arc::from(bytes))
}

/// A frame of one source, whose file is given.
pub fn one(
    name: String,
    content: Content,
    file: Option<&[u8]>,
    arguments: &MakeArguments,
) -> Result<Wanted, DrawError> {
    let material = material(&recipe(content.clone(), arguments), file)?;
    Ok(frame_of(name, content, material, arguments))
}

/// A frame of one source that has been read already.
pub fn frame_of(name: String, content: Content, material: Material, arguments: &MakeArguments) -> Wanted {
    let source = recipe(content, arguments).source();
    let frame = Frame { name, air_time_s: arguments.air, sources: vec![source], ..Frame::default() };
    Wanted { frame, material, asset: None, start: false }
}

/// The recipe of a source with what the command line says.
pub fn recipe(content: Content, arguments: &MakeArguments) -> Recipe {
    let usual = Placing::default();
    let placing = Placing {
        style: arguments.style.map(Into::into).unwrap_or(usual.style),
        size_m: arguments.size,
        spacing_m: arguments.spacing,
        ..usual
    };
    Recipe { placing, seed: arguments.seed, ..Recipe::new(content) }
}

/// The floor that the command line asks for.
pub fn stage(arguments: &MakeArguments) -> Stage {
    let (width_m, depth_m) = arguments.floor.unwrap_or((3.0, 3.0));
    Stage { width_m, depth_m, ..Stage::default() }
}
