//! Fonts and shapes that the settings of a source can name.

use lightbots_api::{MakeChoices, MakeFont, MakeShape};
use lightbots_draw::{SHAPES, ShapeKind, ShapeSettings, text};

/// Returns the built-in fonts that people can choose, and all shapes.
pub fn choices() -> MakeChoices {
    let offered = text::FONTS.iter().filter(|font| font.offered);
    MakeChoices {
        fonts: offered
            .map(|font| MakeFont { name: font.name.to_owned(), title: font.title.to_owned() })
            .collect(),
        shapes: SHAPES.iter().map(|(kind, name)| shape(*kind, name)).collect(),
    }
}

fn shape(kind: ShapeKind, name: &str) -> MakeShape {
    let usual = ShapeSettings::new(kind);
    MakeShape {
        name: name.to_owned(),
        aspect: usual.aspect,
        count: usual.count,
        turns: usual.turns,
        inner: usual.inner,
        span: usual.span,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fonts_that_only_stand_in_for_others_are_not_offered() {
        let choices = choices();
        assert!(choices.fonts.iter().any(|font| font.name == "lato"));
        assert!(choices.fonts.iter().all(|font| font.name != "hebrew"));
        assert_eq!(choices.shapes.len(), 17);
    }
}
