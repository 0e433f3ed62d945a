//! A frame whose pixels are not placed yet, and what its source is made of.

use std::path::Path;
use std::sync::Arc;

use lightbots_draw::{DrawError, Drawing};
use lightbots_exchange::asset_of;
use lightbots_make::{Content, Material, Placing, Recipe, material};
use lightbots_show::{Asset, AssetHash, Frame, Stage};

use crate::cli::MakeArguments;

/// A frame whose pixels are not placed yet.
pub struct Wanted {
    /// Name, times and source.
    pub frame: Frame,
    /// What the source was read into: a drawing, or lights.
    pub material: Material,
    /// File of the source or of its font, as an asset of the show.
    pub asset: Option<(AssetHash, Asset)>,
    /// Whether the preceding frame shows an earlier moment of the same animation.
    pub start: bool,
}

impl Wanted {
    /// Returns the drawing that the source was read into; `None` for lights.
    pub fn drawing(&self) -> Option<Drawing> {
        match &self.material {
            Material::Drawing { made, .. } => Some(made.drawing.clone()),
            Material::Lights(_) => None,
        }
    }
}

/// Returns a file as an asset of the show, with its hash.
pub fn asset(path: &Path, bytes: &[u8], media_type: &str) -> (AssetHash, Asset) {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    asset_of(&name, media_type, Arc::from(bytes))
}

/// Makes a frame of one source. `file` is the content of the source's file, if it has one.
pub fn one(
    name: String,
    content: Content,
    file: Option<&[u8]>,
    arguments: &MakeArguments,
) -> Result<Wanted, DrawError> {
    let material = material(&recipe(content.clone(), arguments), file)?;
    Ok(frame_of(name, content, material, arguments))
}

/// Makes a frame of one source that has been read already.
pub fn frame_of(name: String, content: Content, material: Material, arguments: &MakeArguments) -> Wanted {
    let source = recipe(content, arguments).source();
    let frame = Frame { name, air_time_s: arguments.air, sources: vec![source], ..Frame::default() };
    Wanted { frame, material, asset: None, start: false }
}

/// Returns the recipe of a source with the settings of the command line.
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

/// Returns a stage with the floor of the command line, or 3 m by 3 m.
pub fn stage(arguments: &MakeArguments) -> Stage {
    let (width_m, depth_m) = arguments.floor.unwrap_or((3.0, 3.0));
    Stage { width_m, depth_m, ..Stage::default() }
}
