//! The list of files that belong to a show. The files themselves are in a `.lightbots.zip` only.

use std::collections::btree_map::Entry;

use lightbots_show::{Asset, AssetHash, Assets, MAX_ASSETS, excerpt};

use super::fields::label;
use crate::error::ReadError;
use crate::json::Json;
use crate::json::frames::{Notes, missing};
use crate::json::text::{lines, quoted};

/// Reads the object of assets. Its keys are hashes; its values have name, media type and length of the file.
pub(super) fn read(json: &mut Json<'_>, notes: &mut Notes) -> Result<Assets, ReadError> {
    let mut assets = Assets::new();
    json.object(|json, key| {
        if assets.len() >= MAX_ASSETS {
            return Err(
                json.fail("too-many-assets", format!("more than {MAX_ASSETS} assets; take some away"))
            );
        }
        let hash = AssetHash::from_hex(key).ok_or_else(|| bad_hash(json, key))?;
        match assets.entry(hash) {
            Entry::Occupied(_) => Err(json.fail("duplicate-field", "an asset stands twice; take one away")),
            Entry::Vacant(place) => {
                place.insert(asset(json, notes)?);
                Ok(())
            }
        }
    })?;
    Ok(assets)
}

/// Reads a text that names an asset by its hash, such as the file of a source. `name` names the field in messages.
pub(super) fn hash(json: &mut Json<'_>, name: &str) -> Result<AssetHash, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text(name)?;
    AssetHash::from_hex(&text).ok_or_else(|| bad_hash(&before, &text))
}

fn bad_hash(json: &Json<'_>, text: &str) -> ReadError {
    let what = format!(
        "\"{}\" is not the hash of an asset; write its SHA-256 with 64 digits from 0 to 9 and a to f",
        excerpt(text)
    );
    json.fail("bad-hash", what)
}

fn asset(json: &mut Json<'_>, notes: &mut Notes) -> Result<Asset, ReadError> {
    let (mut name, mut media_type, mut bytes) = (String::new(), None, None);
    json.object(|json, key| {
        match key {
            "name" => name = label(json, key)?,
            "media_type" => media_type = Some(label(json, key)?),
            "bytes" => bytes = Some(json.whole(key)?),
            _ => notes.unknown(json, "asset", key)?,
        }
        Ok(())
    })?;
    Ok(Asset {
        name,
        media_type: media_type.ok_or_else(|| missing(json, "the media_type of the asset"))?,
        bytes: u64::from(bytes.ok_or_else(|| missing(json, "the number of bytes of the asset"))?),
        content: None,
        picture: None,
    })
}

/// Writes the object of assets, one per line.
pub(super) fn text(assets: &Assets) -> String {
    let rows = assets.iter().map(|(hash, asset)| {
        let (name, media_type) = (quoted(&asset.name), quoted(&asset.media_type));
        let bytes = asset.bytes;
        format!("\"{hash}\": {{ \"name\": {name}, \"media_type\": {media_type}, \"bytes\": {bytes} }}")
    });
    let list = lines(rows, "  ");
    // The same layout as a list, in other brackets.
    format!("{{{}}}", &list[1..list.len() - 1])
}
