//! Pictures that layers project on the floor, decoded.

use serde::{Deserialize, Serialize};

/// A small picture or film in memory. Files are decoded in a process of their own, so that the program that plays a
/// show never reads them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LayerPicture {
    /// Pixels in a row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Red, green and blue of each pixel, sRGB codes: pictures one after another, each row by row from the top left.
    pub codes: Vec<u8>,
}

impl LayerPicture {
    /// Number of pixels, all pictures of a film together.
    pub fn pixels(&self) -> usize {
        self.codes.len() / 3
    }
}

/// Serialises a shared picture as the picture itself.
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
