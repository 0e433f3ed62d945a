//! Pictures that layers project on the floor, decoded.

use serde::{Deserialize, Serialize};

/// A small decoded picture, or the decoded pictures of a film.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LayerPicture {
    /// Number of pixels in a row.
    pub width: u32,
    /// Number of rows of one picture.
    pub height: u32,
    /// Red, green and blue of each pixel, sRGB codes from 0 to 255, row by row from the top left. The pictures of a
    /// film follow one another.
    pub codes: Vec<u8>,
}

impl LayerPicture {
    /// Number of pixels of the picture; of a film, of all its pictures together.
    pub fn pixels(&self) -> usize {
        self.codes.len() / 3
    }
}

/// Functions for `#[serde(with)]` that serialise a picture behind an [`Arc`](std::sync::Arc) like the picture itself.
pub(crate) mod shared {
    use super::LayerPicture;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub(crate) fn serialize<S: Serializer>(
        picture: &Option<Arc<LayerPicture>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        picture.as_deref().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<LayerPicture>>, D::Error> {
        Ok(Option::<LayerPicture>::deserialize(deserializer)?.map(Arc::new))
    }
}
