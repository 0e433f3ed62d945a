//! Finds the number of robots with which a source becomes readable.

use lightbots_draw::{DrawError, PlaceSettings, enough_robots};
use lightbots_show::FrameSource;

use crate::material::{Material, exact, material};
use crate::recipe::Recipe;

/// Searches for the smallest number of robots with which a source is readable, as [`enough_robots`] does. `asset` has
/// the bytes of the source's file. `None` if no number that it tries, up to a thousand, is enough. `None` also if the
/// source is itself an arrangement of lights: a grid, random places or a list.
///
/// # Errors
/// If the source cannot be read or drawn.
pub fn enough_for(source: &FrameSource, asset: Option<&[u8]>) -> Result<Option<usize>, DrawError> {
    let recipe = Recipe::read(source)?;
    let made = match (exact(&recipe, 1), material(&recipe, asset)?) {
        (None, Material::Drawing { made, .. }) => made,
        _ => return Ok(None),
    };
    let settings = PlaceSettings {
        spacing_m: recipe.placing.spacing().0,
        least_m: recipe.placing.spacing().1,
        style: recipe.placing.style,
        seed: u64::from(recipe.seed),
        ..PlaceSettings::default()
    };
    Ok(enough_robots(&made.drawing, &settings))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recipe::{Content, TextRecipe};
    use lightbots_draw::{ShapeKind, ShapeSettings};

    #[test]
    fn a_word_needs_robots_for_each_letter_and_a_grid_none() {
        let word = Recipe::new(Content::Text(TextRecipe::new("HI"))).source();
        assert!((8..=30).contains(&enough_for(&word, None).unwrap().unwrap()));
        let grid = Recipe::new(Content::Shape(ShapeSettings::new(ShapeKind::Grid))).source();
        assert_eq!(enough_for(&grid, None), Ok(None));
    }
}
