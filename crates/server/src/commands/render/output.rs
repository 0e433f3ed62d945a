//! The kinds of files that `render` writes.

use lightbots_film::FilmSize;

use super::ffmpeg::Container;
use crate::cli::RenderArguments;
use crate::failure::Failure;

/// Kind of file to write.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Output {
    /// A contact sheet.
    Sheet,
    /// A sheet for the crew.
    Crew,
    /// A film as GIF.
    Gif(FilmSize),
    /// A film by ffmpeg.
    Video(Container, FilmSize),
}

impl Output {
    /// Returns the kind of file that the ending of the output file's name stands for. Error if the ending is unknown, or if
    /// the width or height of a video is odd.
    pub fn of(arguments: &RenderArguments) -> Result<Self, Failure> {
        let ending = arguments.out.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
        let film = |(width, height): (u32, u32), fps: f64| {
            let (width, height) = arguments.size.unwrap_or((width, height));
            FilmSize { width, height, fps: arguments.fps.unwrap_or(fps) }
        };
        match ending.to_ascii_lowercase().as_str() {
            "png" => Ok(Self::Sheet),
            "pdf" => Ok(Self::Crew),
            "gif" => Ok(Self::Gif(film((640, 360), 20.0))),
            "mp4" => even(Container::Mp4, film((1280, 720), 30.0)),
            "webm" => even(Container::Webm, film((1280, 720), 30.0)),
            _ => Err(Failure::input(format!(
                "{}: write a film (.gif, .mp4, .webm), a contact sheet (.png) or a crew sheet (.pdf)",
                arguments.out.display()
            ))),
        }
    }
}

/// Returns a video of this size. An odd width or height is an error, because these videos store one colour for each block of
/// 2 × 2 pixels.
fn even(container: Container, size: FilmSize) -> Result<Output, Failure> {
    if size.width % 2 == 1 || size.height % 2 == 1 {
        let line = format!("--size {}x{}: width and height of a video are even", size.width, size.height);
        return Err(Failure::input(line));
    }
    Ok(Output::Video(container, size))
}
