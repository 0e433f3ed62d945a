//! Makes videos with the program ffmpeg.

use std::ffi::OsString;
use std::io::{ErrorKind, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use lightbots_api as api;
use lightbots_film::FilmSize;
use lightbots_show::{Issue, Show, excerpt};

use crate::disk::Draft;
use crate::failure::Failure;

/// Container format of a video.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Container {
    /// MP4 with H.264 and AAC.
    Mp4,
    /// WebM with VP9 and Opus.
    Webm,
}

impl Container {
    /// Returns the arguments of ffmpeg for this container: encoders and their settings. They favour quality over a small
    /// file.
    fn settings(self) -> &'static [&'static str] {
        match self {
            Self::Mp4 => &[
                "-c:v",
                "libx264",
                "-crf",
                "18",
                "-preset",
                "medium",
                "-pix_fmt",
                "yuv420p",
                "-c:a",
                "aac",
                "-b:a",
                "192k",
                "-movflags",
                "+faststart",
                "-f",
                "mp4",
            ],
            Self::Webm => &[
                "-c:v",
                "libvpx-vp9",
                "-crf",
                "30",
                "-b:v",
                "0",
                "-deadline",
                "good",
                "-cpu-used",
                "4",
                "-row-mt",
                "1",
                "-pix_fmt",
                "yuv420p",
                "-c:a",
                "libopus",
                "-b:a",
                "128k",
                "-f",
                "webm",
            ],
        }
    }
}

/// The music of a show, as a file that ffmpeg can read.
pub(super) enum Music {
    /// The music file beside the show's file.
    File(PathBuf),
    /// A copy of the music in the show; the copy is removed when this value is dropped.
    Copy(Draft),
}

impl Music {
    fn path(&self) -> &Path {
        match self {
            Self::File(path) => path,
            Self::Copy(copy) => copy.path(),
        }
    }
}

/// Finds the show's music in the show or beside its file. Music in the show is copied to a file beside `out`. `None` if the
/// show names no music, or if the music is missing. Missing music leads to an issue and a silent film.
pub(super) fn music(
    show: &Show,
    (file, out): (&Path, &Path),
    issues: &mut Vec<api::Issue>,
) -> Result<Option<Music>, Failure> {
    let Some(name) = &show.music else { return Ok(None) };
    let inside = show.assets.values().find(|asset| asset.name == *name);
    if let Some(content) = inside.and_then(|asset| asset.content.as_deref()) {
        let copy = Draft::beside(out);
        let cannot = |error| Failure::problem(format!("the music cannot be copied for ffmpeg: {error}"));
        std::fs::write(copy.path(), content).map_err(cannot)?;
        return Ok(Some(Music::Copy(copy)));
    }
    // Only a plain file name is used, because a path could lead out of the folder.
    let plain = Path::new(name).file_name().filter(|plain| *plain == name.as_str());
    let beside = plain.map(|plain| file.parent().unwrap_or(Path::new("")).join(plain));
    let found = beside.and_then(|path| path.canonicalize().ok()).filter(|path| path.is_file());
    if found.is_none() {
        let line = format!("the film is silent: put the music \"{}\" beside the show", excerpt(name));
        issues.push(api::Issue::from(&Issue::warning("music-missing", line)));
    }
    Ok(found.map(Music::File))
}

/// A video to make.
pub(super) struct Video<'a> {
    pub container: Container,
    pub size: FilmSize,
    /// Time at which the music begins, seconds after the start of the film.
    pub music_begins_s: f64,
    pub music: Option<&'a Music>,
}

impl Video<'_> {
    /// Starts ffmpeg, which writes the file `to`. `duration_s` is the length of the film, seconds; longer music is cut.
    pub fn start(&self, to: &Path, duration_s: f64) -> Result<Encoder, Failure> {
        let mut child = Command::new("ffmpeg")
            .args(self.arguments(to, duration_s))
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| match error.kind() {
                ErrorKind::NotFound => Failure::problem(
                    "the program ffmpeg is not on the path: install it, or write a .gif; the browser makes videos without it",
                ),
                _ => Failure::problem(format!("ffmpeg cannot be started: {error}")),
            })?;
        let input = child.stdin.take();
        Ok(Encoder { child, input })
    }

    fn arguments(&self, to: &Path, duration_s: f64) -> Vec<OsString> {
        let FilmSize { width, height, fps } = self.size;
        let words = |text: String| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        let mut all = words(format!(
            "-hide_banner -loglevel error -y -f rawvideo -pix_fmt rgb24 -s {width}x{height} -framerate {fps} -i pipe:0"
        ));
        if let Some(music) = self.music {
            all.extend(words(format!("-itsoffset {:.6} -protocol_whitelist file -i", self.music_begins_s)));
            all.push(music.path().as_os_str().to_owned());
            all.extend(words("-map 0:v:0 -map 1:a:0".into()));
        }
        all.extend(words(format!(
            "-t {duration_s:.6} -map_metadata -1 -fflags +bitexact -flags:v +bitexact -flags:a +bitexact"
        )));
        all.extend(self.container.settings().iter().map(OsString::from));
        all.push(to.as_os_str().to_owned());
        all
    }
}

/// A running ffmpeg, which is killed if this value is dropped before the end.
pub(super) struct Encoder {
    child: Child,
    /// Input of ffmpeg, which takes the pictures; `None` once it is closed.
    input: Option<ChildStdin>,
}

impl Encoder {
    /// Sends a picture to ffmpeg, as RGB bytes. If ffmpeg has ended, the error gives its reason.
    pub fn add(&mut self, picture: &[u8]) -> Result<(), Failure> {
        let written = self.input.as_mut().map(|input| input.write_all(picture));
        match written {
            Some(Ok(())) => Ok(()),
            // ffmpeg has ended, and `end` returns its reason.
            _ => Err(self.end().err().unwrap_or_else(|| Failure::problem("ffmpeg ended too early"))),
        }
    }

    /// Closes the input and waits until ffmpeg has written the video.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.end()
    }

    fn end(&mut self) -> Result<(), Failure> {
        self.input = None;
        let mut said = String::new();
        if let Some(errors) = self.child.stderr.take() {
            // Output that is not text is ignored.
            let _ = errors.take(4096).read_to_string(&mut said);
        }
        let status = self.child.wait().map_err(|error| Failure::problem(format!("ffmpeg: {error}")))?;
        if status.success() {
            return Ok(());
        }
        let last = said.lines().last().unwrap_or("it did not say why");
        Err(Failure::problem(format!("ffmpeg could not make the film: {last}")))
    }
}

impl Drop for Encoder {
    fn drop(&mut self) {
        // Fails if ffmpeg has ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn music_begins_with_the_first_picture_that_stands() {
        let music = Music::File(PathBuf::from("/x/a b.wav"));
        let size = FilmSize { width: 640, height: 360, fps: 30.0 };
        let video = Video { container: Container::Mp4, size, music_begins_s: 1.5, music: Some(&music) };
        let arguments = video.arguments(Path::new("./out.part"), 9.0);
        let has = |words: &[&str]| arguments.windows(words.len()).any(|window| window == words);
        assert!(
            has(&["-itsoffset", "1.500000", "-protocol_whitelist", "file", "-i", "/x/a b.wav"]),
            "{arguments:?}"
        );
        assert!(
            has(&["-s", "640x360", "-framerate", "30", "-i", "pipe:0"]) && has(&["-f", "mp4", "./out.part"])
        );
    }

    #[test]
    fn music_that_is_not_there_is_said() {
        let (mut issues, files) = (Vec::new(), (Path::new("show.json"), Path::new("film.mp4")));
        for name in ["none.wav", "../secret.wav", "/etc/passwd"] {
            let show = Show { music: Some(name.into()), ..Show::default() };
            assert!(music(&show, files, &mut issues).unwrap().is_none());
        }
        assert_eq!(issues.len(), 3);
        assert!(music(&Show::default(), files, &mut issues).unwrap().is_none());
        assert_eq!(issues.len(), 3);
    }
}
