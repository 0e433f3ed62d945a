//! From the words and files of the command line to frames that wait for their robots.

use std::path::{Path, PathBuf};

use lightbots_draw::picture::PictureSettings;
use lightbots_draw::text::{self, FONTS};
use lightbots_draw::{DrawError, FileKind, ShapeSettings, shape_named, sniff, unsupported};
use lightbots_make::{Content, Scroll, TextRecipe};
use lightbots_show::{Asset, AssetHash, Frame};

use super::films;
use super::wanted::{Wanted, asset, one};
use crate::cli::MakeArguments;
use crate::failure::Failure;
use crate::progress::Bar;

/// Largest file of a source, bytes.
const FILE_MAX: u64 = 64 << 20;

/// Steps of a scrolling text for each character.
const STEPS_PER_CHARACTER: usize = 1;

/// Width of the window of a scrolling text, cap heights.
const WINDOW: f64 = 3.0;

/// All frames that are wanted.
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

/// The font's name, and its file where it is one.
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
    let content = |words: &str, scroll| {
        Content::Text(TextRecipe {
            font: font.name.clone(),
            wrap: arguments.wrap,
            colors: arguments.color.clone(),
            scroll,
            ..TextRecipe::new(words.replace("\\n", "\n"))
        })
    };
    let file = font.file.as_ref().and_then(|(_, asset)| asset.content.clone());
    let mut contents = Vec::new();
    if arguments.scroll {
        let steps = (words.chars().count() * STEPS_PER_CHARACTER).clamp(2, text::STEPS_MAX);
        contents.extend((0..steps).map(|step| (words, Some(Scroll { window: WINDOW, steps, step }))));
    } else if arguments.per_word {
        contents.extend(words.split_whitespace().map(|word| (word, None)));
    } else {
        contents.push((words, None));
    }
    let series = (contents.len() > 1).then(|| words.to_owned());
    let mut wanted = Vec::new();
    for (words, scroll) in contents {
        let name = words.replace("\\n", " ");
        match one(name, content(words, scroll), file.as_deref(), arguments) {
            Ok(mut one) => {
                one.asset.clone_from(&font.file);
                one.frame.sources[0].series.clone_from(&series);
                wanted.push(one);
            }
            // Steps in which the window is empty are left out, at the end.
            Err(error) if scroll.is_some_and(|scroll| scroll.step > 0) && error.code == "text-settings" => {
                break;
            }
            Err(error) => return Err(error),
        }
    }
    if arguments.scroll {
        let mut frames: Vec<Frame> = wanted.iter().map(|one| one.frame.clone()).collect();
        numbered(&mut frames);
        wanted.iter_mut().zip(frames).for_each(|(one, frame)| one.frame = frame);
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
        FileKind::Webp if !films::moves(bytes) => (Content::Picture(picture), "image/webp"),
        FileKind::Csv => (Content::List, "text/csv"),
        FileKind::Webp | FileKind::Gif => return films::frames(path, bytes, &picture, arguments),
    };
    let name = path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut wanted = one(name, content, Some(bytes), arguments)?;
    wanted.asset = Some(asset(path, bytes, media_type));
    Ok(vec![wanted])
}

/// Frames that share one name are told apart by a number.
fn numbered(frames: &mut [Frame]) {
    let many = frames.len() > 1;
    for (index, frame) in frames.iter_mut().enumerate().filter(|_| many) {
        frame.name = format!("{} {}", frame.name, index + 1);
    }
}
