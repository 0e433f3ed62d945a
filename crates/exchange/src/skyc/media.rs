//! The music of a Skybrush show: `media.audio` of the document. Its sound is base64, or a file of the archive.

use std::collections::BTreeMap;
use std::sync::Arc;

use lightbots_show::{Asset, Issue, Show, excerpt};

use super::encoded::encoded;
use super::reference::file_name;
use crate::error::ReadError;
use crate::json::text::{exact, quoted};
use crate::json::{Json, Scalar};
use crate::limits::LONGEST_S;
use crate::timed::music::TimedMusic;

/// The media type of a sound whose own type is missing or unusable. It is the only one that Skybrush's source names.
const MPEG: &str = "audio/mpeg";
/// Name that music gets if the file does not name it.
const NAME: &str = "music.mp3";
/// Longest media type that is kept, bytes. A longer one is replaced by [`MPEG`].
const MEDIA_TYPE_MAX: usize = 60;

/// The contents of `media`.
#[derive(Default)]
pub(super) struct Media {
    pub music: Option<TimedMusic>,
    /// What is left out of the show, in words for people; empty if nothing is left out.
    pub left_out: &'static str,
}

/// Reads the field `media` of the document. Removes the file of the music from `files`, the files of the archive.
pub(super) fn read(json: &mut Json<'_>, files: &mut BTreeMap<String, Vec<u8>>) -> Result<Media, ReadError> {
    let mut media = Media::default();
    json.object(|json, key| {
        match key {
            "audio" => {
                media.music = audio(json, files)?;
                if media.music.is_none() {
                    media.left_out = "music without a sound";
                }
            }
            _ => {
                media.left_out = "media besides music";
                json.skip()?;
            }
        }
        Ok(())
    })?;
    Ok(media)
}

/// Reads the field `audio`. `None` if the bytes of the sound are neither in the document nor in the archive.
fn audio(
    json: &mut Json<'_>,
    files: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Option<TimedMusic>, ReadError> {
    let (mut name, mut media_type, mut start_s) = (String::new(), String::new(), 0.0);
    let mut content = Vec::new();
    json.object(|json, key| {
        match key {
            "data" => content = sound(json, files, &mut name)?,
            "filename" => name = json.text(key)?.into_owned(),
            "mediaType" => media_type = json.text(key)?.into_owned(),
            "startTime" => start_s = start(json)?,
            _ => json.skip()?,
        }
        Ok(())
    })?;
    if content.is_empty() {
        return Ok(None);
    }
    let name = name.rsplit(['/', '\\']).next().unwrap_or_default().trim();
    let name = if name.is_empty() { NAME } else { name };
    let is_sound =
        media_type.starts_with("audio/") && media_type.len() <= MEDIA_TYPE_MAX && media_type.is_ascii();
    let media_type = if is_sound { media_type } else { MPEG.to_owned() };
    Ok(Some(TimedMusic { name: name.to_owned(), media_type, start_s, content: content.into() }))
}

/// Reads the bytes of a sound: base64, or a reference to a file of the archive. Empty if the archive lacks that file. An
/// empty `name` is replaced by the name of the file that is referred to.
fn sound(
    json: &mut Json<'_>,
    files: &mut BTreeMap<String, Vec<u8>>,
    name: &mut String,
) -> Result<Vec<u8>, ReadError> {
    if json.peek()? == b'{' {
        let reference = json.ahead("$ref");
        json.skip()?;
        let Some(Scalar::Text(reference)) = reference else { return Ok(Vec::new()) };
        let file = file_name(&reference);
        if name.is_empty() {
            file.clone_into(name);
        }
        return Ok(files.remove(file).unwrap_or_default());
    }
    encoded(json, "the sound of the music", "export the show again")
}

/// Reads when the music begins, seconds from the start of the show; negative: before it.
fn start(json: &mut Json<'_>) -> Result<f64, ReadError> {
    json.peek()?;
    let begin = json.clone();
    let start_s = json.number("the start of the music")?;
    if (-LONGEST_S..=LONGEST_S).contains(&start_s) {
        return Ok(start_s);
    }
    Err(begin.fail("bad-time", format!("the music starts at {start_s} s; it must start within a day")))
}

/// Music for an archive. `file` is its name in the archive, `content` its sound. `words` is the JSON of the field
/// `media`, with a comma at its end, for the document.
pub(super) struct WrittenMusic {
    pub file: String,
    pub content: Arc<[u8]>,
    pub words: String,
}

/// The music of a show for an archive. It begins `start_s` seconds after the start of the first drive. `None` if the show
/// has no music. Fails if the show names music whose bytes it does not hold.
pub(super) fn written(show: &Show, start_s: f64) -> Result<Option<WrittenMusic>, Issue> {
    let Some(name) = &show.music else { return Ok(None) };
    let own = |asset: &&Asset| asset.name == *name && asset.content.is_some();
    let found = show.assets.values().find(own).and_then(|asset| Some((asset, asset.content.clone()?)));
    let Some((asset, content)) = found else {
        let what = format!(
            "a file for Skybrush keeps the music itself, and the show does not hold \"{}\"; add it to the show",
            excerpt(name)
        );
        return Err(Issue::warning("lost-in-format", what));
    };
    let file = format!("assets/music.{}", ending(name));
    let words = format!(
        "\"media\":{{\"audio\":{{\"data\":{{\"$ref\":\"./{file}\"}},\"filename\":{},\"mediaType\":{},\
         \"startTime\":{}}}}},",
        quoted(name),
        quoted(&asset.media_type),
        exact(start_s)
    );
    Ok(Some(WrittenMusic { file, content, words }))
}

/// The ending of a file's name in lower case, without the dot. `bin` if the ending is missing or is not 1 to 8 ASCII
/// letters and digits. Also `bin` for `json` and `yaml`, because Skybrush reads files with these endings as documents.
fn ending(name: &str) -> String {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_lowercase();
    let is_plain = (1..=8).contains(&ending.len()) && ending.bytes().all(|byte| byte.is_ascii_alphanumeric());
    if is_plain && ending != "json" && ending != "yaml" { ending } else { "bin".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_are_those_of_sounds() {
        let endings = ["a.MP3", "march", "x.json", "y.o g", "z.", "b.tar.ogg"].map(ending);
        assert_eq!(endings, ["mp3", "bin", "bin", "bin", "bin", "ogg"]);
    }
}
