//! Makes frames of the animations on the command line.

use std::path::Path;

use lightbots_draw::DrawError;
use lightbots_draw::picture::PictureSettings;
use lightbots_make::{Content, FilmFrame, Material, film, picture_floor};

use super::wanted::{Wanted, asset, recipe, stage};
use crate::cli::MakeArguments;

/// Makes the frames of an animation file. Their moments are far enough apart for robots to move from frame to frame.
pub fn frames(
    path: &Path,
    bytes: &[u8],
    picture: &PictureSettings,
    arguments: &MakeArguments,
) -> Result<Vec<Wanted>, DrawError> {
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let recipe = recipe(Content::Animation { picture: *picture, moment_s: 0.0 }, arguments);
    let floor = picture_floor(&stage(arguments));
    let film = film(&name, bytes, &recipe, &floor, arguments.robots as usize)?;
    let media_type = if bytes.starts_with(b"GIF8") { "image/gif" } else { "image/webp" };
    let asset = asset(path, bytes, media_type);
    let wanted = |(nth, FilmFrame { frame, material }): (usize, FilmFrame)| Wanted {
        frame,
        material,
        asset: Some(asset.clone()),
        start: nth > 0,
    };
    let mut all: Vec<Wanted> = film.frames.into_iter().enumerate().map(wanted).collect();
    if let Some(Wanted { material: Material::Drawing { made, .. }, .. }) = all.first_mut() {
        made.notes = film.notes;
    }
    Ok(all)
}
