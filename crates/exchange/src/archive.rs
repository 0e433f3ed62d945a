//! `.lightbots.zip`: a show and the files that belong to it. The document lies in `show.lightbots.json`, each file in
//! `assets/HASH`.

mod read;
mod write;

pub(crate) use crate::zip_files::is_zip as sniff;
pub(crate) use read::read;
pub(crate) use write::encode;

use std::sync::Arc;

use lightbots_show::{Asset, AssetHash};
use sha2::{Digest, Sha256};

/// Name of the document in an archive.
pub(crate) const DOCUMENT: &str = "show.lightbots.json";
/// Folder of the assets in an archive.
const ASSETS: &str = "assets/";
/// Largest number of files in an archive: the document and as many assets as a show may have.
const ENTRIES_MAX: usize = 1 + lightbots_show::MAX_ASSETS;

/// The SHA-256 of a file's bytes, by which a show names the file.
pub fn hash_of(content: &[u8]) -> AssetHash {
    AssetHash(Sha256::digest(content).into())
}

/// Makes an asset from the bytes of a file. Returns its hash and the asset.
pub fn asset_of(name: &str, media_type: &str, content: Arc<[u8]>) -> (AssetHash, Asset) {
    let hash = hash_of(&content);
    let asset = Asset {
        name: name.to_owned(),
        media_type: media_type.to_owned(),
        bytes: content.len() as u64,
        content: Some(content),
        picture: None,
    };
    (hash, asset)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_that_of_the_standard() {
        // FIPS 180-4, example of one block.
        let expected = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(hash_of(b"abc").to_string(), expected);
    }
}
