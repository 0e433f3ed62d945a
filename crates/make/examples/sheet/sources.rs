//! The thirty sources: words, drawings, logos, photographs, animations and shapes.

use std::error::Error;

use lightbots_draw::picture::{PictureSettings, PictureWay};
use lightbots_draw::{ShapeKind, ShapeSettings};
use lightbots_make::{Content, Recipe, TextRecipe};

use crate::pictures;

pub struct Source {
    pub name: &'static str,
    pub recipe: Recipe,
    pub asset: Option<Vec<u8>>,
}

/// Words: name, text and font.
const WORDS: [(&str, &str, &str); 7] = [
    ("HI", "HI", "lato"),
    ("LOVE", "LOVE", "lato"),
    ("2027", "2027", "lato"),
    ("HELLO", "HELLO\nWORLD", "league-spartan"),
    ("Grüße", "Grüße", "league-spartan"),
    ("yes?", "yes?", "quicksand"),
    ("single line", "ABC", "hershey-sans"),
];

macro_rules! drawing {
    ($name:literal) => {
        ($name, include_bytes!(concat!("drawings/", $name, ".svg")))
    };
}

/// Drawings: name and SVG file.
const DRAWINGS: [(&str, &[u8]); 14] = [
    drawing!("cat"),
    drawing!("house"),
    drawing!("tree"),
    drawing!("fish"),
    drawing!("rocket"),
    drawing!("smile"),
    drawing!("snowflake"),
    drawing!("lightning"),
    drawing!("note"),
    drawing!("flower"),
    drawing!("key"),
    drawing!("bicycle"),
    drawing!("sun-logo"),
    drawing!("bars-logo"),
];

pub fn all() -> Result<Vec<Source>, Box<dyn Error>> {
    let mut sources: Vec<Source> =
        WORDS.into_iter().map(|(name, text, font)| words(name, text, font)).collect();
    for (name, bytes) in DRAWINGS {
        sources.push(Source { name, recipe: Recipe::new(Content::Svg), asset: Some(bytes.to_vec()) });
    }
    let way = |way| Content::Picture(PictureSettings { way, inverted: false });
    for (name, content, bytes) in [
        ("ball", way(PictureWay::Tones), pictures::ball()?),
        ("mug", way(PictureWay::Silhouette), pictures::mug()?),
        ("hills", way(PictureWay::Tones), pictures::hills()?),
        ("leaf", way(PictureWay::Auto), pictures::leaf()?),
    ] {
        sources.push(Source { name, recipe: Recipe::new(content), asset: Some(bytes) });
    }
    let animation = pictures::turning_heart()?;
    for (name, moment_s) in [("heart at 0 s", 0.0), ("heart at 1 s", 1.0)] {
        let content = Content::Animation { picture: PictureSettings::default(), moment_s };
        sources.push(Source { name, recipe: Recipe::new(content), asset: Some(animation.clone()) });
    }
    for (name, kind) in
        [("star", ShapeKind::Star), ("spiral", ShapeKind::Spiral), ("arrow", ShapeKind::Arrow)]
    {
        let recipe = Recipe::new(Content::Shape(ShapeSettings::new(kind)));
        sources.push(Source { name, recipe, asset: None });
    }
    Ok(sources)
}

fn words(name: &'static str, text: &str, font: &str) -> Source {
    let recipe = TextRecipe { font: font.into(), ..TextRecipe::new(text) };
    Source { name, recipe: Recipe::new(Content::Text(recipe)), asset: None }
}
