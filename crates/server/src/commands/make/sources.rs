//! Reads the words and files of the command line into frames whose pixels are not placed yet.

use std::path::{Path, PathBuf};

use lightbots_draw::animation::webp_moves;
use lightbots_draw::picture::PictureSettings;
use lightbots_draw::text::{self, FONTS};
use lightbots_draw::{DrawError, FileKind, ShapeSettings, shape_named, sniff, unsupported};
use lightbots_make::{Content, TextPages, TextRecipe, text_pages};
use lightbots_show::{Asset, AssetHash};

use super::films;
use super::wanted::{Wanted, asset, frame_of, one};
use crate::cli::MakeArguments;
use crate::failure::Failure;
use crate::progress::Bar;

/// Largest file of a source or of a font, bytes.
const FILE_MAX: u64 = 64 << 20;

/// Number of steps of a scrolling text for each character of the text. Steps whose window is empty give no frame.
const STEPS_PER_CHARACTER: usize = 1;

/// Width of the part of a scrolling text that one frame shows, in cap heights of the font.
const WINDOW: f64 = 3.0;

/// Reads all sources. Returns the frames of all of them, in order, with pixels not placed yet.
pub fn read(arguments: &MakeArguments, bar: &Bar) -> Result<Vec<Wanted>, Failure> {
    let font = font(arguments)?;
    let mut wanted = Vec::new();
    for (index, source) in arguments.sources.iter().enumerate() {
        bar.set(index as f64 / arguments.sources.len() as f64, format!("reading {source}"));
        let named = |error: DrawError| Failure::input(format!("{source}: {error} [{}]", error.code));
        if let Some(words) = source.strip_prefix("text:") {
            wanted.extend(of_text(words, &font, arguments).map_err(named)?);
        } else if let Some(name) = source.strip_prefix("shape:") {
            wanted.push(of_shape(name, arguments).map_err(named)?);
        } else {
            let bytes = bytes(Path::new(source))?;
            wanted.extend(of_file(source, &bytes, arguments).map_err(named)?);
        }
    }
    Ok(wanted)
}

/// Name of a built-in font, and a font file. If there is a file, the file is used instead of the built-in font.
struct ChosenFont {
    name: String,
    file: Option<(AssetHash, Asset)>,
}

fn font(arguments: &MakeArguments) -> Result<ChosenFont, Failure> {
    let Some(font) = &arguments.font else {
        return Ok(ChosenFont { name: FONTS[0].name.into(), file: None });
    };
    if FONTS.iter().any(|known| known.name == font) {
        return Ok(ChosenFont { name: font.clone(), file: None });
    }
    let path = PathBuf::from(font);
    if !path.exists() {
        let known: Vec<&str> = FONTS.iter().filter(|font| font.offered).map(|font| font.name).collect();
        let line =
            format!("{font}: no font has this name and no file; use {} or a font's file", known.join(", "));
        return Err(Failure::input(line));
    }
    let file = asset(&path, &bytes(&path)?, "font/ttf");
    Ok(ChosenFont { name: FONTS[0].name.into(), file: Some(file) })
}

fn bytes(path: &Path) -> Result<Vec<u8>, Failure> {
    let unreadable = |what: String| Failure::input(format!("{}: {what}", path.display()));
    let about = std::fs::metadata(path).map_err(|error| unreadable(format!("cannot be read: {error}")))?;
    if !about.is_file() {
        return Err(unreadable("this is not a file; name a drawing, picture or list".into()));
    }
    if about.len() > FILE_MAX {
        return Err(unreadable(format!("the file is larger than {} MB; make it smaller", FILE_MAX >> 20)));
    }
    std::fs::read(path).map_err(|error| unreadable(format!("cannot be read: {error}")))
}

fn of_text(words: &str, font: &ChosenFont, arguments: &MakeArguments) -> Result<Vec<Wanted>, DrawError> {
    let recipe = TextRecipe {
        font: font.name.clone(),
        wrap: arguments.wrap,
        colors: arguments.color.clone(),
        ..TextRecipe::new(words.replace("\\n", "\n"))
    };
    let pages = if arguments.scroll {
        let steps = (words.chars().count() * STEPS_PER_CHARACTER).clamp(2, text::STEPS_MAX);
        TextPages::Scroll { window: WINDOW, steps }
    } else if arguments.per_word {
        TextPages::Words
    } else {
        TextPages::Whole
    };
    let file = font.file.as_ref().and_then(|(_, asset)| asset.content.clone());
    let pages = text_pages(&recipe, file.as_deref(), pages)?;
    let is_series = pages.len() > 1;
    let mut wanted = Vec::new();
    for (nth, (recipe, material)) in pages.into_iter().enumerate() {
        let title = recipe.text.replace('\n', " ");
        let name = if arguments.scroll { format!("{title} {}", nth + 1) } else { title };
        let mut one = frame_of(name, Content::Text(recipe), material, arguments);
        one.asset.clone_from(&font.file);
        one.frame.sources[0].series = is_series.then(|| words.to_owned());
        wanted.push(one);
    }
    Ok(wanted)
}

fn of_shape(name: &str, arguments: &MakeArguments) -> Result<Wanted, DrawError> {
    let kind = shape_named(name).ok_or_else(|| lightbots_make::unknown_shape(name))?;
    let mut settings = ShapeSettings::new(kind);
    if let Some(color) = arguments.color.first() {
        settings.color = *color;
    }
    one(name.to_owned(), Content::Shape(settings), None, arguments)
}

fn of_file(source: &str, bytes: &[u8], arguments: &MakeArguments) -> Result<Vec<Wanted>, DrawError> {
    let path = Path::new(source);
    let picture = PictureSettings {
        way: arguments.way.map(Into::into).unwrap_or_default(),
        ..PictureSettings::default()
    };
    let (content, media_type) = match sniff(bytes).ok_or_else(|| unsupported(bytes))? {
        FileKind::Svg => (Content::Svg, "image/svg+xml"),
        FileKind::Png => (Content::Picture(picture), "image/png"),
        FileKind::Jpeg => (Content::Picture(picture), "image/jpeg"),
        FileKind::Webp if !webp_moves(bytes) => (Content::Picture(picture), "image/webp"),
        FileKind::Csv => (Content::List, "text/csv"),
        FileKind::Webp | FileKind::Gif => return films::frames(path, bytes, &picture, arguments),
    };
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut wanted = one(name, content, Some(bytes), arguments)?;
    wanted.asset = Some(asset(path, bytes, media_type));
    Ok(vec![wanted])
}
