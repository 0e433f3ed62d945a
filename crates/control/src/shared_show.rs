//! Serialises a shared show, `Arc<Show>`, as the show itself.

use lightbots_show::Show;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::sync::Arc;

pub(crate) fn serialize<S: Serializer>(show: &Arc<Show>, serializer: S) -> Result<S::Ok, S::Error> {
    show.as_ref().serialize(serializer)
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Arc<Show>, D::Error> {
    Show::deserialize(deserializer).map(Arc::new)
}

/// Serialises an `Option<Arc<Show>>` as an `Option<Show>`.
pub(crate) mod optional {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(
        show: &Option<Arc<Show>>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        show.as_deref().serialize(serializer)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Arc<Show>>, D::Error> {
        Ok(Option::<Show>::deserialize(deserializer)?.map(Arc::new))
    }
}
